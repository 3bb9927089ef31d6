#include <fmt/format.h>
#include <app/command.hpp>
#include <campaign/robots.hpp>
#include <campaign/selection.hpp>
#include <operations/operations.hpp>
#include <rules/rules.hpp>
#include <set>

namespace liecheck::properties {

namespace {

void print_subjects(const std::vector<std::unique_ptr<Series>>& all) {
  fmt::print("subjects\n");
  for (const std::string& name : subject_names()) {
    std::set<std::string> scalars;
    std::string version;
    for (const auto& s : all)
      if (s->subject == name) scalars.insert(s->scalar), version = s->subject_version;
    if (!scalars.empty()) fmt::print("  {:<12}{} in {}\n", name, version, fmt::join(scalars, ", "));
  }
  fmt::print(
      "  textbook:1e-1 ... textbook:1e-12: textbook with this cutoff; they run only if named\n"
      "  bug:NAME, alike:NAME: known bugs and look-alikes of 'liecheck bench bugs', run only if named\n"
      "  history:NAME, history:NAME:fixed: bugs of real libraries, of 'liecheck bench history', run only if "
      "named\n");
}

struct Flags {
  bool operations = false, laws = false;
  std::string rules;
};

int run(const Flags& f) {
  if (f.operations) {
    fmt::print("{}", operations_table());
    return within_budget;
  }
  if (!f.rules.empty()) {
    const Rules& rules = rules_named(f.rules);
    fmt::print("{}", f.laws ? fmt::format("{}\n", fmt::join(rules.names("law"), "\n")) : rules.text());
    return within_budget;
  }
  const auto all = select({}, built_in_robot());
  if (!f.laws) {
    print_subjects(all);
    fmt::print("properties\n");
  }
  std::set<std::string> seen;
  for (const auto& s : all) {
    if (!seen.insert(s->property).second) continue;
    if (f.laws)
      fmt::print("{}\n", s->property);
    else
      fmt::print("  {:<24}{}\n  {:<24}{}\n", s->property, s->law, "", s->equation);
  }
  return within_budget;
}

}  // namespace

Command list_command(CLI::App& program) {
  CommandWith<Flags> a(program, "list", "the subjects and properties");
  a.toggle("--operations", a->operations,
           "list the operations instead: definitions, arguments, results and blocks, in Markdown");
  a.toggle("--laws", a->laws, "list only the names of the properties, one a line");
  a.text("--rules", a->rules, "VERSION",
         "list the digests of a version of the rules instead, or of \"present\"; with --laws, its laws");
  return a.runs(run);
}

}  // namespace liecheck::properties
