#include <fmt/format.h>
#include <app/command.hpp>
#include <store/merge.hpp>
#include <store/store_path.hpp>

namespace liecheck::properties {

namespace {

struct Flags {
  std::string before, after;
};

/// Prints on stderr if a store lacks cases of its campaign, because then the comparison is partial, too.
void print_if_partial(const std::string& name, const StoredCampaign& c) {
  if (c.spec.cases == 0) return;
  if (!c.complete())
    warn(fmt::format("liecheck: {}: unfinished\n", name));
  else if (c.spec.last - c.spec.first < c.spec.cases)
    warn(fmt::format("liecheck: {}: a shard, cases {} to {} of {} in each series\n", name, c.spec.first,
                     c.spec.last - 1, c.spec.cases));
}

int run(const Flags& f) {
  const StoredCampaign a = load_campaign(f.before), b = load_campaign(f.after);
  print_if_partial(f.before, a);
  print_if_partial(f.after, b);
  const auto lines = worse(a, b);
  for (const std::string& line : lines) fmt::print("{}\n", line);
  fmt::print("{} worse\n", lines.empty() ? "nothing is" : fmt::format("{} cells are", lines.size()));
  return lines.empty() ? within_budget : property_failed;
}

}  // namespace

Command compare_command(CLI::App& program) {
  CommandWith<Flags> a(program, "compare",
                       "what got worse from store A to store B. Exit code 0 if nothing did; 1 if anything "
                       "did; 2 for bad input");
  a.text("A", a->before, "", "the earlier store").required();
  a.text("B", a->after, "", "the later store").required();
  return a.runs(run);
}

}  // namespace liecheck::properties
