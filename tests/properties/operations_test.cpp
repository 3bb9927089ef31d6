// The list of operations: each is complete and measured by a law, and docs/operations.md shows the same list.

#include <gtest/gtest.h>

#include <algorithm>
#include <campaign/robots.hpp>
#include <campaign/selection.hpp>
#include <operations/operations.hpp>
#include <set>

#include "pages.hpp"

namespace liecheck::properties {
namespace {

TEST(Operations, AreMeasuredByALawInEveryBlock) {
  std::set<std::pair<std::string_view, std::string_view>> measured;
  for (const auto& s : select({{"liecheck"}, {}, {"double"}}, built_in_robot()))
    for (const Output& o : s->outputs) {
      EXPECT_EQ(std::ranges::count(all_operations(), o.record), 1) << o.operation << " is not in the list";
      measured.emplace(o.operation, o.block);
    }
  for (const Operation* o : all_operations())
    for (const Block& b : o->blocks)
      EXPECT_TRUE(measured.count({o->name, b.name.text})) << o->name << " " << b.name.text;
}

TEST(Operations, HaveUniqueNamesAndBlocksWithUnits) {
  std::set<std::string_view> names;
  for (const Operation* o : all_operations()) {
    EXPECT_TRUE(names.insert(o->name).second) << o->name;
    EXPECT_GT(o->blocks.size(), 0u) << o->name;
    EXPECT_GT(o->results.size(), 0u) << o->name;
    for (const Block& b : o->blocks) EXPECT_FALSE(b.unit.empty()) << o->name << " " << b.name.text;
    for (const std::string_view text : {o->definition, o->source, o->call.header, o->call.expression})
      EXPECT_FALSE(text.empty()) << o->name;
  }
}

template <class M>
int numbers_in(const M& m) {
  return static_cast<int>(m.size());
}
int numbers_in(const Pose<double>&) {
  return 12;
}
int numbers_in(const Body<double>&) {
  return 13;
}
int numbers_in(double) {
  return 1;
}

template <class Id, bool Bound, class Result, class... Arguments>
void check_sizes(const Typed<Id, Bound, Result, Arguments...>& o) {
  const std::vector<int> sizes{numbers_in(typename Arguments::template of<double>())...};
  const auto parts = [](const Layout& l) {
    int n = 0;
    for (const Part& p : l.parts) n += p.size;
    return n;
  };
  for (std::size_t i = 0; i < sizes.size(); ++i)
    EXPECT_EQ(parts(*o.arguments[i]), sizes[i]) << o.name << " " << i;
  EXPECT_EQ(parts(*o.results[0]), numbers_in(typename Result::template of<double>())) << o.name;
}

TEST(Operations, LayoutsHaveTheSizesOfTheirTypes) {
  SpatialSlots<double>::for_each([](const auto& o) { check_sizes(o); });
}

TEST(Operations, DocumentationShowsTheSameList) {
  EXPECT_EQ(read("docs/operations.md"), operations_table())
      << "regenerate: liecheck list --operations > docs/operations.md";
}

}  // namespace
}  // namespace liecheck::properties
