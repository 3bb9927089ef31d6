#include <app/campaign_run.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <campaign/digest.hpp>
#include <cstdlib>
#include <record/record.hpp>
#include <stdexcept>
#include <store/merge.hpp>
#include <store/ranks.hpp>
#include <store/store_path.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>

namespace liecheck::properties {

namespace {

/// Parses "I/N" with I in 1..N.
void parse_shard(const std::string& text, CampaignOptions& o) {
  const auto slash = text.find('/');
  const auto number = [&](const std::string& part) {
    const bool digits = !part.empty() && part.size() < 7 && part.find_first_not_of("0123456789") == part.npos;
    return digits ? static_cast<unsigned>(std::stoul(part)) : 0u;
  };
  const unsigned i = number(text.substr(0, slash)),
                 n = slash == text.npos ? 0 : number(text.substr(slash + 1));
  if (i < 1 || i > n)
    throw std::invalid_argument(fmt::format("--shard: '{}' is not I/N with 1 <= I <= N < 1000000", text));
  o.shard = i, o.shards = n;
}

/// The rank that mpirun gave this process, or null.
const char* rank_of_mpirun() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"})
    if (const char* rank = std::getenv(name)) return rank;
  return nullptr;
}

std::string rank_file(const std::string& store, int rank, int size) {
  return fmt::format("{}.{}-of-{}", store, rank + 1, size);
}

/// Runs one rank's part into a separate file. The first rank merges these files.
std::optional<StoredRun> run_rank(const Ranks& ranks, CampaignOptions o, const Robot& robot,
                                  const StoreFlags& f) {
  if (f.store.empty()) throw std::invalid_argument("under mpirun a campaign needs --store FILE");
  if (!f.shard.empty()) throw std::invalid_argument("--shard: mpirun already divides the cases into shards");
  if (o.seconds) throw std::invalid_argument("--for: mpirun divides a fixed number of cases: give --cases");
  const int me = ranks.rank(), n = ranks.size();
  o.shard = static_cast<unsigned>(me + 1), o.shards = static_cast<unsigned>(n);
  o.quiet = o.quiet || me > 0;
  const std::string file = rank_file(f.store, me, n);
  const auto how_to_resume = [&] {
    if (me == 0) say("to resume:\n  mpirun -n {} {}{}\n", n, f.typed_line, f.resume ? "" : " --resume");
    std::fflush(stdout);
  };
  std::optional<StoredRun> run;
  int state = within_budget;
  try {
    Store store(file, Store::Open::create);
    if (me == 0 && is_store(f.store)) store.adopt(Store(f.store, Store::Open::existing).counterexamples());
    run = run_stored(o, robot, store, f.resume);
    // The first rank prints this at once, because an interrupted mpirun ends its ranks after about a second.
    if (run->result.incomplete) state = incomplete, how_to_resume();
  } catch (const std::exception& e) {
    warn(fmt::format("liecheck: rank {} of {}: {}\n", me + 1, n, e.what()));
    state = bad_input;
  }
  // Only the first rank returns the verdict, because mpirun ends all ranks if one reports failure.
  state = ranks.largest(state == incomplete ? 1 : state == bad_input ? 2 : 0);
  if (me > 0) return std::nullopt;
  if (state == 2) throw std::runtime_error(fmt::format("{}: not merged: a rank failed", f.store));
  CampaignResult& mine = run->result;
  if (state == 1 && !mine.incomplete) mine.incomplete = true, how_to_resume();  // another rank was stopped
  if (mine.incomplete || mine.series.empty()) return run;
  std::vector<std::string> files;
  for (int k = 0; k < n; ++k) files.push_back(rank_file(f.store, k, n));
  merge_into(f.store, files, false);
  StoredRun all = result_of(load_campaign(f.store), f.store);
  all.counterexamples = run->counterexamples;
  all.result.elapsed = mine.elapsed;
  all.result.options.shards = o.shards;
  all.result.failed = all.result.failed || !all.counterexamples.failing.empty();
  return all;
}

}  // namespace

std::vector<Flag> CaseFlags::add(Arguments& a) {
  const Flag count = a.number("--cases", options.cases, 1, std::uint64_t(1) << 40,
                              "cases of each law on each subject in each scalar");
  const Flag robot_flag = robot.add(a), seed_flag = a.seed(options.seed, "seed of the campaign");
  const Flag time = a.duration("--for", options.seconds, "run for this time instead of --cases: 30s, 5m, 1h")
                        .excludes(count);
  jobs_flag = a.jobs(options.jobs);
  return {robot_flag, seed_flag, count, time, jobs_flag};
}

void StoreFlags::add(Arguments& a) {
  const Flag file = a.updated("--store", store, "FILE",
                              "keep all results in FILE (SQLite), so that the campaign can be continued");
  a.toggle("--resume", resume, "continue the campaign in the store").needs(file);
  a.text("--shard", shard, "I/N", "run only part I of N; 'liecheck merge' joins the parts");
}

bool StoreFlags::first_shard() const {
  if (const char* rank = rank_of_mpirun()) return std::atoi(rank) == 0;
  return shard.empty() || std::atoi(shard.c_str()) == 1;
}

void StoreFlags::check(bool timed) const {
  CampaignOptions o;
  if (!shard.empty()) {
    parse_shard(shard, o);
    if (timed)
      throw std::invalid_argument("--for: a shard is a part of a fixed number of cases: give --cases");
  }
  if (!store.empty() && !rank_of_mpirun()) Store(store, Store::Open::create);
}

BesideCases beside_of(const std::vector<ProbedOperation>& probed, const std::vector<HardRow>& hard_cases) {
  BesideCases all{probed};
  if (hard_cases.empty() || stop_requested) return all;
  std::string corpus;
  for (const HardRow& row : hard_cases) {
    corpus += row.entry->name + "|" + row.entry->input + "\n";
    for (const HardCell& c : row.cells)
      if (c.failed)
        all.failed.push_back(
            {c.subject, c.scalar, row.entry->name, c.operation, c.block, name_of(c.verdict)});
  }
  all.corpus = hexadecimal(sha256(corpus)).substr(0, 16);
  return all;
}

std::optional<StoredRun> run_stored_campaign(const Selection& selection, const Robot& robot,
                                             const CaseFlags& cases, const StoreFlags& f,
                                             const BesideCases& beside) {
  CampaignOptions o = cases.options;
  o.selection = selection, o.beside = beside;
  if (!f.shard.empty()) parse_shard(f.shard, o);
  const Ranks ranks;
  if (ranks.size() > 1) {
    if (!cases.jobs_flag.given()) o.jobs = 1;
    return run_rank(ranks, o, robot, f);
  }
  if (f.store.empty()) return StoredRun{run_campaign(o, robot), {}, {}};
  Store store(f.store, Store::Open::create);
  return run_stored(o, robot, store, f.resume);
}

void print_counterexamples(const Counterexamples& c, bool all) {
  if (c.replayed + c.skipped == 0) return;
  const std::size_t shown = all ? c.failing.size() : 6;
  say("counterexamples of earlier runs: {} replayed, {} still fail, {} skipped\n", c.replayed,
      c.failing.size(), c.skipped);
  for (std::size_t i = 0; i < std::min(shown, c.failing.size()); ++i)
    say("  {}, {}: {}\n", c.failing[i].operation, c.failing[i].block, replay_words(c.failing[i].id));
  if (c.failing.size() > shown) say("  and {} more: --all prints them\n", c.failing.size() - shown);
  say("\n");
}

void print_how_to_resume(const CampaignResult& r, const StoreFlags& f) {
  const bool ranks = r.options.shards > 1 && f.shard.empty();  // the first rank has printed how to resume
  if (!r.incomplete || ranks) return;
  if (f.store.empty())
    say("interrupted: no case was saved; --store FILE saves them\n");
  else
    say("to resume:\n  {}{}\n", f.typed_line, f.resume ? "" : " --resume");
}

}  // namespace liecheck::properties
