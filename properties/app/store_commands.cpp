#include <app/store_commands.hpp>

#include <fmt/format.h>
#include <app/arguments.hpp>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <record/campaign.hpp>
#include <set>
#include <stdexcept>
#include <store/merge.hpp>
#include <store/ranks.hpp>
#include <store/store_path.hpp>
#include <support/files.hpp>
#include <support/text.hpp>

namespace liecheck::properties {

namespace {

/// "I/N" with I in 1..N.
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

/// This process's rank, if it has one.
const char* rank_of_mpirun() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"})
    if (const char* rank = std::getenv(name)) return rank;
  return nullptr;
}

std::string rank_file(const std::string& store, int rank, int size) {
  return fmt::format("{}.{}-of-{}", store, rank + 1, size);
}

/// One rank of several: its part into a file of its own; the first one merges.
std::optional<StoredRun> run_rank(const Ranks& ranks, CampaignOptions o, const Robot& robot,
                                  const StoreFlags& f) {
  if (f.store.empty()) throw std::invalid_argument("under mpirun a campaign needs --store FILE");
  if (!f.shard.empty()) throw std::invalid_argument("--shard: mpirun shares the cases out already");
  if (o.seconds) throw std::invalid_argument("--for: under mpirun the cases are shared out: give --cases");
  const int me = ranks.rank(), n = ranks.size();
  o.shard = static_cast<unsigned>(me + 1), o.shards = static_cast<unsigned>(n);
  o.quiet = o.quiet || me > 0;
  if (!f.jobs || f.jobs->count() == 0) o.jobs = 1;
  const std::string file = rank_file(f.store, me, n);
  std::optional<StoredRun> run;
  int state = within_budget;
  try {
    Store store(file, Store::Open::create);
    if (me == 0 && is_store(f.store)) store.adopt(Store(f.store, Store::Open::existing).counterexamples());
    run = run_stored(o, robot, store, f.resume);
    if (run->result.incomplete) {
      state = incomplete;
      // At once: an interrupted mpirun gives its ranks about a second.
      if (me == 0) fmt::print("to go on:\n  mpirun -n {} {}{}\n", n, f.command, f.resume ? "" : " --resume");
      std::fflush(stdout);
    }
  } catch (const std::exception& e) {
    fmt::print(stderr, "liecheck: rank {} of {}: {}\n", me + 1, n, e.what());
    state = bad_input;
  }
  // Only the first one ends with the verdict: mpirun ends the others where one of them reports failure.
  state = ranks.largest(state == incomplete ? 1 : state == bad_input ? 2 : 0);
  if (me > 0) return std::nullopt;
  if (state == 2) throw std::runtime_error(fmt::format("{}: not merged: a rank failed", f.store));
  CampaignResult& mine = run->result;
  mine.incomplete = mine.incomplete || state == 1;
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

bool StoreFlags::first_shard() const {
  if (const char* rank = rank_of_mpirun()) return std::atoi(rank) == 0;
  return shard.empty() || std::atoi(shard.c_str()) == 1;
}

void add_store_flags(CLI::App& campaign, StoreFlags& f) {
  auto* store = filled(
      campaign.add_option("--store", f.store, "keep everything in FILE (SQLite), chunk by chunk"), "FILE");
  campaign.add_flag("--resume", f.resume, "go on with the campaign that the store holds")->needs(store);
  filled(
      campaign.add_option("--shard", f.shard, "only part I of N of every series; merge puts them together"),
      "I/N");
}

std::string command_line(int argc, char** argv) {
  std::string line;
  for (int i = 0; i < argc; ++i) {
    line += (i ? " " : "") + shell_quoted(argv[i]);
  }
  return line;
}

void check_store_flags(const StoreFlags& f, bool timed) {
  CampaignOptions o;
  if (!f.shard.empty()) {
    parse_shard(f.shard, o);
    if (timed) throw std::invalid_argument("--for: a shard is a part of a count: give --cases");
  }
  if (!f.store.empty() && !rank_of_mpirun()) Store(f.store, Store::Open::create);
}

std::optional<StoredRun> run_stored_campaign(CampaignOptions o, const Robot& robot, const StoreFlags& f) {
  if (!f.shard.empty()) parse_shard(f.shard, o);
  const Ranks ranks;
  if (ranks.size() > 1) return run_rank(ranks, o, robot, f);
  if (f.store.empty()) return StoredRun{run_campaign(o, robot), {}, {}};
  Store store(f.store, Store::Open::create);
  return run_stored(o, robot, store, f.resume);
}

void print_counterexamples(const Counterexamples& c) {
  if (c.replayed + c.skipped == 0) return;
  constexpr std::size_t shown = 6;
  fmt::print("counterexamples of earlier runs: {} replayed, {} still fail, {} outside the selection\n",
             c.replayed, c.failing.size(), c.skipped);
  for (std::size_t i = 0; i < std::min(shown, c.failing.size()); ++i)
    fmt::print("  {}, {}: liecheck replay {}\n", c.failing[i].operation, c.failing[i].block, c.failing[i].id);
  if (c.failing.size() > shown) fmt::print("  and {} more\n", c.failing.size() - shown);
  fmt::print("\n");
}

void print_how_to_go_on(const CampaignResult& r, const StoreFlags& f) {
  const bool ranks = r.options.shards > 1 && f.shard.empty();  // they have said it
  if (!r.incomplete || ranks) return;
  if (f.store.empty())
    fmt::print("interrupted: nothing was kept; --store FILE keeps what is done\n");
  else
    fmt::print("to go on:\n  {}{}\n", f.command, f.resume ? "" : " --resume");
}

StoreCommands::StoreCommands(CLI::App& app) {
  merge_ =
      app.add_subcommand("merge", "put the shards of a campaign together; FILE@N is campaign N of a store");
  merge_->add_option("OUT", out_, "the store to write; its other campaigns are kept")->required();
  merge_->add_option("IN", in_, "the shards' stores, in any order")->required();
  merge_->add_flag("--partial", partial_,
                   "let cases be missing: OUT is unfinished then, and --resume goes on");
  export_ =
      app.add_subcommand("export", "the canonical text of a store: the same however the cases were run");
  export_->add_option("STORE", store_, "a store, or STORE@N for its Nth campaign")->required();
  filled(export_->add_option("--out", export_out_, "write to FILE instead of the standard output"), "FILE");
  compare_ = app.add_subcommand("compare", "what got worse from store A to store B. Exit 1 if anything did");
  compare_->add_option("A", before_, "the store before")->required();
  compare_->add_option("B", after_, "the store after")->required();
}

std::optional<int> StoreCommands::run() const {
  if (merge_->parsed()) {
    merge_into(out_, in_, partial_);
    const StoredCampaign c = load_campaign(out_);
    fmt::print("{}: cases {}..{} of {} series, {}\n", out_, c.spec.first, c.spec.last, c.series.size(),
               c.complete() ? "complete" : "incomplete");
    return c.complete() ? within_budget : incomplete;
  }
  if (export_->parsed()) {
    const std::string text = export_text(load_campaign(store_));
    if (!export_out_.empty()) {
      write_whole(export_out_, text);
    } else if (!(std::cout << text << std::flush)) {
      throw std::runtime_error("standard output: cannot be written");
    }
    return within_budget;
  }
  if (compare_->parsed()) {
    const StoredCampaign a = load_campaign(before_), b = load_campaign(after_);
    for (const auto& [name, c] : {std::pair(&before_, &a), std::pair(&after_, &b)})
      if (!c->complete() && c->spec.cases > 0) {
        fmt::print(stderr, "liecheck: {}: unfinished\n", *name);
      } else if (c->spec.cases > 0 && c->spec.last - c->spec.first < c->spec.cases) {
        fmt::print(stderr, "liecheck: {}: a shard, cases {} to {} of {} in each series\n", *name,
                   c->spec.first, c->spec.last - 1, c->spec.cases);
      }
    const auto lines = worse(a, b);
    for (const std::string& line : lines) fmt::print("{}\n", line);
    fmt::print("{} worse\n", lines.empty() ? "nothing is" : fmt::format("{} cells are", lines.size()));
    return lines.empty() ? within_budget : property_failed;
  }
  return std::nullopt;
}

std::vector<std::string> with_records_of_stores(const std::vector<std::string>& records,
                                                const std::string& folder) {
  std::vector<std::string> all;
  std::set<std::string> names;
  for (const std::string& record : records) {
    if (!is_store(stored_file(record))) {
      all.push_back(record);
      continue;
    }
    const StoredRun run = result_of(load_campaign(record), record);
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
      throw std::runtime_error(fmt::format("--out {}: cannot be created: {}", folder, error.message()));
    std::string name = std::filesystem::path(record).stem().string();
    while (!names.insert(name).second) name += "_";
    all.push_back((std::filesystem::path(folder) / (name + ".json")).string());
    write_whole(all.back(), record_of(run.result, run.counterexamples, run.environment).dump(1) + "\n");
  }
  return all;
}

}  // namespace liecheck::properties
