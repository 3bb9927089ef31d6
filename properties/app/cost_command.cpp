#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <adapters/subjects.hpp>
#include <algorithm>
#include <app/cost_batches.hpp>
#include <cmath>
#include <record/record.hpp>
#include <subjects/subject_names.hpp>
#include <support/environment.hpp>
#include <support/own_process.hpp>
#include <support/progress.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>
#include <timing/cost.hpp>
#include <tuple>

namespace liecheck::properties {

namespace {

struct CostFlags {
  CostOptions options;
  AdapterFlags adapters;
  BatchFlags batch;
  bool batches = false, times_only = false;
  std::string json;
};

std::string number_text(double x) {
  return x < 1000 ? fmt::format("{:.3g}", x) : fmt::format("{:.0f}", x);
}
std::string ratio_text(const Ratio& r) {
  if (r.processes == 0) return "-";
  return fmt::format("{} [{}, {}]", number_text(r.median), number_text(r.low), number_text(r.high));
}

/// How an adapter was timed, and what its interface costs; "" of a subject of the program.
std::string way_of(const CostRow& row, double reference_ns) {
  const CostSet& all = row.sets.back();
  const std::string interface = number_text(all.interface.median * reference_ns);
  const auto says = [&](const char* word) { return row.timed.find(word) != std::string::npos; };
  const char* const types = says("own types") ? "the library's own types" : "numbers";
  if (row.timed.empty()) return "";
  if (row.timed == "calls")
    return "timed by calls through the interface: it is in C, or built with an older header";
  if (!row.timed.starts_with("one"))
    return fmt::format("timed by its own loops on {}; through the interface, a call takes {} ns", types,
                       interface);
  return fmt::format("timed in its own process on {}, one at a time{}; its loop alone takes {} ns", types,
                     says("many") ? fmt::format(", and as throughput {} at once", all.inputs) : "",
                     interface);
}

void print_row(const CostRow& row, double reference_ns, const std::string& dominator) {
  const CostSet& all = row.sets.back();
  say("{:<24}{:<11}{:<22}{:>9}  {:<22}{:>10}", row.subject, row.scalar, ratio_text(all.latency),
      all.latency.processes ? number_text(all.latency.median * reference_ns) : "-",
      ratio_text(all.throughput),
      all.instructions > 0 ? fmt::format("{:.0f}/{:.0f}", all.instructions, all.cycles) : "-");
  const std::string worst = worst_block(row);
  for (const BlockErrors& b : all.blocks)
    if (b.block == worst)
      say("{:>10}{:>10.3g}{:>10.3g}  {:<18}{}",
          std::isinf(error_of(row)) ? "no result" : fmt::format("{:.3g}", b.largest()), b.quantile(0.99),
          b.quantile(0.5), worst, dominator);
  say("\n");
  if (const std::string how = way_of(row, reference_ns); !how.empty()) say("  {}\n", how);
}

void print_rows(const CostResult& r) {
  const auto by = dominators(r.rows, &CostSet::latency);
  std::string operation;
  for (std::size_t i = 0; i < r.rows.size(); ++i) {
    if (r.rows[i].operation != operation) {
      operation = r.rows[i].operation;
      say("\n{:<24}{:<11}{:<22}{:>9}  {:<22}{:>10}{:>10}{:>10}{:>10}  {:<18}{}\n", operation, "", "latency",
          "[ns]", "throughput", "instr/cyc", "max", "p99", "median", "block [eps]", "dominated by");
    }
    print_row(r.rows[i], r.machine.reference_ns,
              by[i] < 0 ? "" : implementation_of(r.rows[static_cast<std::size_t>(by[i])]));
  }
}

/// series:2 stands before series:10.
bool is_before(const CostRow& a, const CostRow& b) {
  const auto key = [](const CostRow& r) {
    return std::tuple(r.subject.substr(0, r.subject.find(':')), r.subject.size(), r.subject);
  };
  return key(a) < key(b);
}

void print_curves(const CostResult& r) {
  say("{}\nCorrect digits of the largest error found at angles below the head's [rad], a lower bound of the "
      "error;\n"
      "time of one call that waits for the one before, at all these angles.\n",
      environment_line());
  std::map<std::pair<std::string, std::string>, std::vector<CostRow>> curves;
  for (const CostRow& row : r.rows)
    if (row.subject != "call") curves[{row.operation, row.scalar}].push_back(row);
  for (auto& [curve, rows] : curves) {
    say("\n{:<32}{:>9}", fmt::format("{} {}", curve.first, curve.second), "[ns]");
    for (const CostBand& b : r.options.bands()) say("{:>7g}", b.high);
    say("\n");
    std::ranges::sort(rows, is_before);
    for (const CostRow& row : rows) {
      const Ratio& time = row.sets.back().latency;
      say("{:<32}{:>9}", row.subject,
          time.processes ? number_text(time.median * r.machine.reference_ns) : "-");
      for (std::size_t b = 0; b < r.options.bands().size(); ++b) {
        const double error = error_of(row, row.sets[b]);
        say("{:>7}", error > 0 ? fmt::format("{:.1f}", std::max(0.0, -std::log10(error))) : "all");
      }
      say("\n");
    }
  }
}

void print_header(const CostResult& r) {
  say("{}\n"
      "latency, throughput: processor time of a call in times of a reference loop, {:.4g} ns: the median\n"
      "  of short repetitions in {} processes, and its spread from run to run. The row call is the shortest\n"
      "  operation of the signature. Its time is not subtracted.\n"
      "error: largest found (a lower bound), 99 % quantile and median, for the worst block, in eps of the\n"
      "  scalar, over the timed inputs. Dominated: another row has a lower latency and no larger error.\n"
      "instructions: {}\n",
      environment_line(), r.machine.reference_ns, r.options.processes,
      r.no_counter.empty() ? "and cycles in user space, per call" : "not counted, " + r.no_counter);
}

std::string steadiness(const Machine& m) {
  return fmt::format(
      "spread {:.1f} %, half of the times have less; {:.0f} % of the repetitions were left out{}",
      100 * m.spread, 100 * m.disturbed, m.steady() ? "" : ": UNSTEADY, another run may give other ratios");
}

/// While it is silent, standard output is lost: what the code of an adapter prints there must not get between the times.
class SilentOutput {
 public:
  SilentOutput() : kept_(::dup(STDOUT_FILENO)) {
    const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    ::dup2(nothing, STDOUT_FILENO);
    ::close(nothing);
  }
  SilentOutput(const SilentOutput&) = delete;
  SilentOutput& operator=(const SilentOutput&) = delete;
  ~SilentOutput() { ::close(kept_); }
  void end() const {
    std::fflush(stdout);
    ::dup2(kept_, STDOUT_FILENO);
  }

 private:
  int kept_;
};

/// Runs the program again, to measure the times in a process of its own.
std::optional<std::string> times_in_a_process(const CostOptions& o, double seconds) {
  std::vector<std::string> arguments = {
      "cost", "--times-only", "--seed", fmt::format("{}", o.seed), "--for", fmt::format("{:.9f}", seconds)};
  const auto add = [&](const char* flag, const std::vector<std::string>& values) {
    for (const std::string& value : values) arguments.insert(arguments.end(), {flag, value});
  };
  add("--op", o.operations), add("--subject", o.subjects), add("--scalar", o.scalars);
  add("--adapter", o.adapters);
  if (o.flags) arguments.push_back("--flags");
  if (o.curve) arguments.push_back("--curve");
  // An adapter that hangs must not hang this program. A machine under load takes a few times as long.
  return output_of_own_process(std::move(arguments), stop_requested, 10 * seconds + 30);
}

/// The options with the adapters, which are compared with liecheck unless other subjects are given.
CostOptions with_adapters(CostOptions o, const AdapterFlags& adapters, bool probe) {
  o.adapters = adapters.adapters;
  add_subjects(o, adapters.start());
  for (const std::string& text : o.adapters) {
    if (!adapters::can_be_timed(text))
      throw std::invalid_argument(
          fmt::format("--adapter: '{}' is a command that does not time itself, as docs/adapters.md says: its "
                      "time would be that of its pipe",
                      text));
    if (probe) check_conventions(text);
  }
  return o;
}

int run(const CostFlags& f) {
  if (f.batches) return run_batches(f.batch, f.options.operations);
  const CostOptions options = with_adapters(f.options, f.adapters, !f.times_only);
  if (f.times_only) {
    const SilentOutput library;
    const std::string times = times_in_this_process(options);
    library.end();
    say("{}", times);
    return within_budget;
  }
  stop_on_signals();
  const CostResult r = run_cost(options);
  do_both([&] { write_record_of(f.json, r); },
          [&] {
            if (r.options.curve) {
              print_curves(r);
            } else {
              print_header(r);
              print_rows(r);
            }
            say("\n{} rows in {:.1f} s, seed {}; {}{}\n", r.rows.size(), r.elapsed, r.options.seed,
                steadiness(r.machine), r.complete ? "" : "; interrupted: only what was done");
          });
  return r.complete ? within_budget : incomplete;
}

}  // namespace

void add_subjects(CostOptions& o, const std::vector<std::string>& adapters) {
  if (adapters.empty()) return;
  const bool all = o.subjects.empty();
  o.subjects.insert(o.subjects.end(), adapters.begin(), adapters.end());
  if (all) add_forms(o);
}

void add_forms(CostOptions& o) {
  if (o.operations.empty()) o.operations = cost_operations_of(o.subjects);
  for (const std::string& name : subject_names())
    if ((name == "liecheck" || name == "textbook" || name == "textbook:half_angles" ||
         name.starts_with("liecheck:")) &&
        std::ranges::count(o.subjects, name) == 0)
      o.subjects.push_back(name);
}

CostResult run_cost(CostOptions options) {
  options.stop = &stop_requested;
  Progress progress("cost");
  options.progress = [&](double share) { progress.show(share, "of the processes"); };
  options.times_in_a_process = [&](double seconds) { return times_in_a_process(options, seconds); };
  CostResult r = measure_cost(options);
  // Sorts by operation, in the order of their table. The rows of an operation stay sorted by digits.
  const auto names = cost_operations();
  std::stable_sort(r.rows.begin(), r.rows.end(), [&](const CostRow& a, const CostRow& b) {
    return std::find(names.begin(), names.end(), a.operation) <
           std::find(names.begin(), names.end(), b.operation);
  });
  return r;
}

Command cost_command(CLI::App& program) {
  CommandWith<CostFlags> a(program, "cost",
                           "measure time and error of each operation. Every subject gets the same inputs. "
                           "Exit code 0; 2 for bad input; 3 if stopped");
  CostOptions& o = a->options;
  const Flag operation = a.list("--op", o.operations, "NAME", "an operation, repeatable; default all");
  const Flag subject = a.list(
                 "--subject", o.subjects, "NAME",
                 "a subject, repeatable; default those of a campaign and liecheck's own variants, or the "
                 "adapters and liecheck"),
             adapter = a->adapters.add(a),
             scalar = a.list("--scalar", o.scalars, "SCALAR",
                             fmt::format("{}, repeatable; default all", fmt::join(cost_scalars(), ", "))),
             flags = a.toggle("--flags", o.flags, "also liecheck in double with other compilers and flags"),
             seed = a.seed(o.seed, "seed of the inputs"),
             whole = a.duration("--for", o.seconds, "about how long all timing takes: 30s, 5m; default 60s");
  const Flag curve = a.toggle("--curve", o.curve,
                              "instead: error over the angle, and time, of textbook:CUTOFF, "
                              "textbook:half_angles, series:TERMS and liecheck");
  curve.needs(operation);
  a.hidden_toggle("--times-only", a->times_only);
  const Flag json = a.json(a->json, "write times and errors to FILE");
  const Flag batches =
      a.toggle("--batches", a->batches,
               "instead: time batches of poses, and of states of the built-in quadruped, beside the loop "
               "over single ones "
               "and a copy of memory, in each set of instructions of the processor, in float and double");
  for (const Flag& other : {subject, adapter, scalar, flags, curve, seed, whole, json})
    batches.excludes(other);
  for (const Flag& flag : a->batch.add(a)) flag.needs(batches);
  return a.runs(run);
}

}  // namespace liecheck::properties
