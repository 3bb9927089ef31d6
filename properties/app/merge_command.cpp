#include <fmt/format.h>
#include <app/command.hpp>
#include <store/merge.hpp>
#include <store/store_path.hpp>

namespace liecheck::properties {

namespace {

struct Flags {
  std::string out;
  std::vector<std::string> in;
  bool partial = false;
};

int run(const Flags& f) {
  merge_into(f.out, f.in, f.partial);
  const StoredCampaign c = load_campaign(f.out);
  const std::string open = c.not_measured();
  const bool complete = c.complete() && open.empty();
  fmt::print("{}: cases {}..{} of {} series, {}{}{}\n", f.out, c.spec.first, c.spec.last, c.series.size(),
             complete ? "complete" : "incomplete", open.empty() ? "" : ": ", open);
  return complete ? within_budget : incomplete;
}

}  // namespace

Command merge_command(CLI::App& program) {
  CommandWith<Flags> a(
      program, "merge",
      "merge the shards of a campaign; FILE@N is campaign N of a store. Exit code 0 if it has "
      "every case and verdict; 2 for bad input; 3 if not");
  a.text("OUT", a->out, "", "the store to write; its other campaigns stay").required();
  a.list("IN", a->in, "", "the shards' stores, in any order").required();
  a.toggle("--partial", a->partial, "allow missing cases: then OUT is unfinished, and --resume runs them");
  return a.runs(run);
}

}  // namespace liecheck::properties
