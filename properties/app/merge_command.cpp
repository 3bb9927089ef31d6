#include <fmt/format.h>
#include <app/command.hpp>
#include <campaign/coverage_report.hpp>
#include <store/merge.hpp>
#include <store/store_path.hpp>
#include <store/stored_run.hpp>
#include <support/say.hpp>

namespace liecheck::properties {

namespace {

struct MergeFlags {
  std::string out;
  std::vector<std::string> in;
  bool partial = false;
};

/// What a merged campaign with all cases still lacks: "" or a text. The classes and bands that a law must reach
/// follow from all shards together, so no shard could check them.
std::string lacking(const StoredCampaign& c, const std::string& name) {
  const std::string open = c.not_measured();
  if (!open.empty() || !c.complete()) return open;
  try {
    for (const auto& [series, tally] : result_of(c, name).result.series)
      if (const auto lines = not_measured(*series, tally); !lines.empty())
        return fmt::format("{} of {} in {}: {}", series->property, series->subject, series->scalar, lines[0]);
  } catch (const std::runtime_error& e) {  // another version wrote it
    return fmt::format("which classes of inputs it measured is unknown: {}", e.what());
  }
  return "";
}

int run(const MergeFlags& f) {
  merge_into(f.out, f.in, f.partial);
  const StoredCampaign c = load_campaign(f.out);
  const std::string open = lacking(c, f.out);
  const bool complete = c.complete() && open.empty();
  say("{}: cases {}..{} of {} series, {}{}{}\n", f.out, c.spec.first, c.spec.last, c.series.size(),
      complete ? "complete" : "incomplete", open.empty() ? "" : ": ", open);
  return complete ? within_budget : incomplete;
}

}  // namespace

Command merge_command(CLI::App& program) {
  CommandWith<MergeFlags> a(
      program, "merge",
      "merge the shards of a campaign; FILE@N is campaign N of a store. Exit code 0 if it has "
      "every case and verdict; 2 for bad input; 3 if not");
  a.updated("OUT", a->out, "", "the store to write; its other campaigns stay").required();
  a.list("IN", a->in, "", "the shards' stores, in any order").required();
  a.toggle("--partial", a->partial, "allow missing cases: then OUT is unfinished, and --resume runs them");
  return a.runs(run);
}

}  // namespace liecheck::properties
