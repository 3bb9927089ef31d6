#include <fmt/format.h>
#include <algorithm>
#include <app/command.hpp>
#include <campaign/robots.hpp>
#include <campaign/selection.hpp>
#include <filesystem>
#include <hard_cases/corpus.hpp>
#include <memory>
#include <search/hunt.hpp>
#include <set>
#include <support/files.hpp>
#include <support/progress.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>

namespace liecheck::properties {

namespace {

struct HuntFlags {
  HuntOptions options;
  std::string subject, scalar = "double", property, corpus;
  bool versus_random = false;
  RobotFlags robot;
  AdapterFlags adapters;
  LimitsFlags limits;
};

std::function<void(std::uint64_t, double, double)> progress_of(const std::string& what) {
  return [line = std::make_shared<Progress>(what)](std::uint64_t n, double share, double worst) {
    line->show(share, [&](double elapsed) {
      return fmt::format("{} evaluations  {:.0f}/s  worst {:.3g}", n,
                         elapsed > 0 ? static_cast<double>(n) / elapsed : 0, std::max(0.0, worst));
    });
  };
}

/// The text as a name in the corpus: lower-case letters, digits and '_'.
std::string corpus_name(std::string text) {
  for (char& c : text)
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : (std::isalnum(c) ? c : '_');
  return text;
}

/// A line of fixtures/hard_cases: name | property in scalar | numbers | class | reason | origin.
std::string corpus_line(const Series& series, const Worst& w, const std::string& origin) {
  const Output& o = series.outputs.at(static_cast<std::size_t>(w.output));
  const CaseId& id = w.broken ? w.first_broken_id : w.id;
  const std::string digest = hexadecimal(sha256(id.text())).substr(0, 8);
  const std::string what = w.broken
                               ? fmt::format("{} {} of {} is broken", o.operation, o.block, series.subject)
                               : fmt::format("{} {} of {} errs by {:.3g} {}", o.operation, o.block,
                                             series.subject, w.score, w.by_kappa ? "eps kappa" : "eps");
  return fmt::format("hunted_{}_{} | {} in {} | {} | hunted | {} | {}\n",
                     corpus_name(fmt::format("{}_{}", o.operation, o.block)), digest, series.property,
                     series.scalar, fmt::join(id.input, ", "), what, origin);
}

/// The exit code of two searches: a failure counts more than a case without a verdict.
int both(int a, int b) {
  return a == within_budget || b == property_failed ? b : a;
}

/// Prints the worst case of one output. Returns property_failed if it exceeds its budget, and incomplete if
/// an evaluation has no verdict or no error could be measured.
int print_worst(const Series& series, const Worst& w, const std::string& replay_flags) {
  const Output& o = series.outputs.at(static_cast<std::size_t>(w.output));
  say("\n{}: {}, {}\n", series.property, o.operation, o.block);
  bool failed = w.broken > 0;
  if (w.open)
    say("  no verdict on {} of the evaluations\n  replay    {}\n", w.open,
        replay_words(w.first_open_id.text(), replay_flags));
  if (w.broken)
    say("  broken    {} of the evaluations: {}\n  replay    {}\n", w.broken,
        outcome_words[static_cast<int>(w.first_broken.residual.outcome)],
        replay_words(w.first_broken_id.text(), replay_flags));
  if (w.score < 0) {
    say("  worst     no error could be measured\n");
    return failed ? property_failed : incomplete;
  }
  const std::string band = series.bands()[w.judged.residual.band].name;
  const char* unit = w.by_kappa ? "eps kappa" : "eps";
  std::string verdict = "within budget";
  try {
    for (const Judged& j : series.replay(w.id)) {
      if (j.residual.output != w.output) continue;
      if (j.failed) failed = true, verdict = "FAIL";
      const bool one_rule = w.by_kappa == (j.budget->rule == Rule::excess);
      if (is_misuse(j.residual.outcome))
        verdict = fmt::format("FAIL: {}", outcome_words[static_cast<int>(j.residual.outcome)]);
      else if (one_rule && w.score > j.budget->limit && !j.failed)
        failed = true, verdict = "FAIL: not repeatable, since it passes if measured again";
      verdict = fmt::format("budget {} {}: {}", j.budget->limit,
                            j.budget->rule == Rule::forward ? "eps" : "eps kappa", verdict);
      break;
    }
  } catch (const GivenUp&) {
    verdict = "not measured again";
  }
  say("  worst     {:.4g} {}, a lower bound of the maximum; {}\n", w.score, unit, verdict);
  say("  error     {:.4g} eps", w.judged.residual.error);
  if (w.by_kappa) say(", kappa {:.3g}", w.judged.residual.kappa);
  say(", band {}\n  found     at evaluation {}, half this error at {}\n", band, w.at, w.half_at);
  say("  decimal   {}\n  hexadecimal {}\n  replay    {}\n", fmt::join(w.decimal, ", "),
      fmt::join(w.id.input, ", "), replay_words(w.id.text(), replay_flags));
  return failed ? property_failed : w.open ? incomplete : within_budget;
}

void print_comparison(const Worst& hunted, const Worst& random, std::uint64_t evaluations) {
  if (random.score < 0)
    say("  random    nothing measured in {} uniform samples\n", evaluations);
  else
    say("  random    {:.4g} in {} uniform samples (angles on [0, pi], any axis): hunted / random = {:.3g}\n",
        random.score, evaluations, hunted.score / random.score);
}

/// The selected series that measure the operation and its block. Throws if there is none. The message names
/// the operations or blocks that are known.
std::vector<std::unique_ptr<Series>> series_of(const HuntFlags& f, const Robot& robot) {
  const std::string &op = f.options.operation, &block = f.options.block;
  Selection selection = f.limits.judging({{f.subject}, {}, {f.scalar}});
  if (!f.property.empty()) selection.properties = {f.property};
  auto all = select(selection, robot);
  if (all.empty()) throw std::invalid_argument(fmt::format("{} is not offered in {}", f.subject, f.scalar));
  std::set<std::string_view> operations, offered, blocks;
  std::erase_if(all, [&](const auto& s) {
    bool measured = false;
    for (std::size_t i = 0; i < s->outputs.size(); ++i) {
      const Output& o = s->outputs[i];
      operations.insert(o.operation);
      if (!(s->due >> i & 1)) continue;
      offered.insert(o.operation);
      if (o.operation == op) blocks.insert(o.block);
      measured = measured || (o.operation == op && (block.empty() || o.block == block));
    }
    return !measured;
  });
  if (!offered.count(op))
    throw std::invalid_argument(
        fmt::format("--op: {} '{}' in {}; it is measured on: {}",
                    operations.count(op) ? f.subject + " does not offer" : "unknown operation", op, f.scalar,
                    fmt::join(offered, ", ")));
  if (!block.empty() && !blocks.count(block))
    throw std::invalid_argument(
        fmt::format("--block: {} has no block '{}'; known: {}", op, block, fmt::join(blocks, ", ")));
  return all;
}

/// The file that --corpus names. Throws if it is not a regular file that can be written.
class CorpusFile {
 public:
  explicit CorpusFile(std::string path) : path_(std::move(path)) {
    if (path_.empty()) return;
    std::error_code error;
    const bool existed = std::filesystem::exists(path_, error);
    if (existed && !std::filesystem::is_regular_file(path_, error))
      throw std::invalid_argument(fmt::format("--corpus: {}: not a regular file", path_));
    if (existed && std::filesystem::file_size(path_, error) > 0)
      for (const HardCase& c : read_corpus(path_)) names_.insert(c.name);
    check_writable(path_);
  }
  void add(const std::string& line) {
    if (names_.insert(line.substr(0, line.find(" | "))).second) lines_ += line;
  }
  /// Appends the added lines to the file, which is replaced as a whole.
  void close() const {
    if (path_.empty() || lines_.empty()) return;
    std::error_code error;
    std::string text = std::filesystem::exists(path_, error) ? read_whole(path_) : "";
    if (text.empty())
      text = "# name | property | input | class | reason | origin\n";
    else if (text.back() != '\n')
      text += '\n';
    write_whole(path_, text + lines_);
  }

 private:
  std::string path_, lines_;
  std::set<std::string> names_;
};

/// Hunts on one series, and samples as many random inputs if asked. Returns the exit code.
int hunt_on(const Series& series, HuntOptions options, const HuntFlags& f, const std::string& robot_flag,
            CorpusFile& corpus) {
  const auto search = [&](const char* how) {
    options.progress = progress_of(fmt::format("{} {} {}", how, series.property, options.operation));
    const HuntResult result = hunt(series, options);
    options.progress = nullptr;  // clears its line
    return result;
  };
  const HuntResult hunted = search("hunt");
  HuntResult random;
  if (f.versus_random && !hunted.stopped) {
    options.evaluations = hunted.evaluations;
    options.random = true;
    random = search("random");
  }
  say("hunt of {} on {} {} in {}, seed {}: {} evaluations in {:.1f} s\n", options.operation, series.subject,
      series.subject_version, series.scalar, options.seed, hunted.evaluations, hunted.elapsed);
  const std::string origin = fmt::format("liecheck hunt --subject {} --op {} --seed {}, {} evaluations",
                                         series.subject, options.operation, options.seed, hunted.evaluations);
  int code = within_budget;
  for (std::size_t i = 0; i < hunted.worst.size(); ++i) {
    const Worst& w = hunted.worst[i];
    code = both(code, print_worst(series, w, (series.on_robot ? robot_flag : "") + subject_flags(series)));
    if (i < random.worst.size()) print_comparison(w, random.worst[i], random.evaluations);
    if (w.score >= 0 || w.broken) corpus.add(corpus_line(series, w, origin));
  }
  return code;
}

int run(const HuntFlags& f) {
  f.adapters.start();
  const Robot robot = f.robot.read();
  const auto all = series_of(f, robot);
  stop_on_signals();
  CorpusFile corpus(f.corpus);
  const std::string robot_flag = robot.path.empty() ? "" : robot_flags(robot);
  // Laws that measure the operation share the number of evaluations or the time.
  HuntOptions options = f.options;
  options.seconds /= static_cast<double>(all.size());
  if (options.evaluations) options.evaluations = std::max<std::uint64_t>(1, options.evaluations / all.size());
  int code = within_budget;
  const auto search = [&] {
    for (std::size_t k = 0; k < all.size() && !(k > 0 && stop_requested); ++k) {
      if (k > 0) say("\n");
      code = both(code, hunt_on(*all[k], options, f, robot_flag, corpus));
    }
  };
  do_both(search, [&] { corpus.close(); });  // lines of the corpus survive the loss of the output
  if (stop_requested) say("\ninterrupted: these are the worst cases so far\n");
  return stop_requested ? incomplete : code;
}

}  // namespace

Command hunt_command(CLI::App& program) {
  CommandWith<HuntFlags> a(
      program, "hunt",
      "search for the worst input of an operation. Exit code 0 if every error found is within "
      "its limit; 1 if one is not; 2 for bad input; 3 if stopped, or if an evaluation has "
      "no verdict");
  HuntOptions& o = a->options;
  a.text("--subject", a->subject, "NAME", "the library under test, as 'liecheck list' names it").required();
  a.text("--op", o.operation, "NAME", "the operation, as failures and reports name it").required();
  a.text("--block", o.block, "NAME",
         "one block of its result, as 'liecheck list' names it; default each of them");
  a.text("--property", a->property, "NAME", "one law that measures it; default all laws");
  a.text("--scalar", a->scalar, "SCALAR", "float or double").with_default_in_help();
  a.toggle("--excess", o.excess, "maximise error / kappa, also beyond theta = pi");
  a.seed(o.seed, "seed of the search");
  const Flag evaluations =
      a.number("--evaluations", o.evaluations, 1, std::uint64_t(1) << 40,
               "stop after N measurements instead of a time: the same search on every machine");
  a.duration("--for", o.seconds, "stop after this time: 30s, 5m, 1h; default 30s").excludes(evaluations);
  a.toggle("--versus-random", a->versus_random, "also measure as many uniformly random inputs, and compare");
  a.updated("--corpus", a->corpus, "FILE", "append what is found to FILE, as lines of fixtures/hard_cases");
  a->robot.add(a);
  a->adapters.add(a);
  a->limits.add(a);
  return a.runs(run);
}

}  // namespace liecheck::properties
