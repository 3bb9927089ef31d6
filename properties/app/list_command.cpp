#include <fmt/format.h>
#include <algorithm>
#include <app/command.hpp>
#include <campaign/robots.hpp>
#include <campaign/selection.hpp>
#include <operations/list.hpp>
#include <rules/rules.hpp>
#include <set>
#include <subjects/subject_names.hpp>
#include <support/say.hpp>

namespace liecheck::properties {

namespace {

void print_subjects(const std::vector<std::unique_ptr<Series>>& all) {
  say("subjects\n");
  for (const std::string& name : subject_names()) {
    std::set<std::string> scalars;
    std::string version;
    for (const auto& s : all)
      if (s->subject == name) scalars.insert(s->scalar), version = s->subject_version;
    if (!scalars.empty()) say("  {:<12}{} in {}\n", name, version, fmt::join(scalars, ", "));
  }
  say("  textbook:1e-1 ... textbook:1e-12: textbook with this cutoff; they run only if named\n"
      "  textbook:half_angles: textbook in half angles, without a cutoff; it runs only if named\n"
      "  series:1 ... series:12: the same with series of this number of terms; they run only if named\n"
      "  of the laboratory (liecheck-lab), run only if named:\n"
      "  bug:NAME, alike:NAME: known bugs and look-alikes of 'liecheck lab bugs'\n"
      "  history:NAME, history:NAME:fixed: bugs of real libraries, of 'liecheck lab history'\n"
      "  correct:NAME: correct implementations\n");
}

void print_absent() {
  say("absent from this build\n");
  for (const std::string& name : absent_subjects()) say("  {:<12}{}\n", name, how_to_get(name));
}

/// Prints each operation with the blocks in which its error is measured.
void print_operations() {
  say("operations and their blocks; --operations describes them\n");
  for (const Operation* o : all_operations()) {
    std::vector<std::string_view> blocks;
    for (const Block& b : o->blocks) blocks.push_back(b.name.text);
    say("  {:<32}{}\n", o->name, fmt::join(blocks, ", "));
  }
}

struct ListFlags {
  bool operations = false, laws = false;
  std::string rules;
  AdapterFlags adapters;
};

int run(const ListFlags& f) {
  if (f.operations) {
    say("{}", operations_table());
    return within_budget;
  }
  if (!f.rules.empty() && !f.laws) {
    say("{}", rules_named(f.rules).text());
    return within_budget;
  }
  Selection selection{f.adapters.start(), {}, {}};
  if (!f.rules.empty()) selection.properties = rules_named(f.rules).names("law");
  const auto all = select(selection, built_in_robot());
  if (!f.laws) {
    print_subjects(all);
    print_absent();
    print_operations();
    say("properties\n");
  }
  std::set<std::string> seen;
  for (const auto& s : all) {
    if (!seen.insert(s->property).second) continue;
    if (f.laws)
      say("{}\n", s->property);
    else
      say("  {:<24}{}\n  {:<24}{}\n", s->property, s->law, "", s->equation);
  }
  return within_budget;
}

}  // namespace

Command list_command(CLI::App& program) {
  CommandWith<ListFlags> a(
      program, "list",
      "list the subjects, operations and laws. Also the subjects that are absent, and the "
      "blocks of each operation. Exit code 0");
  a.toggle("--operations", a->operations,
           "list the operations instead: definitions, arguments, results and blocks, in Markdown");
  const Flag laws = a.toggle("--laws", a->laws, "list only the names of the laws, one a line");
  a.text("--rules", a->rules, "VERSION",
         "list the digests of a version of the rules instead, \"present\" for this liecheck's; with --laws, "
         "its laws");
  a->adapters.add(a).needs(laws);
  return a.runs(run);
}

}  // namespace liecheck::properties
