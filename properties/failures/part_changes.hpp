#pragma once
// Parts of the arguments and of the result of an operation, and what libraries take for them by mistake.

#include <failures/relations.hpp>
#include <functional>
#include <operations/description.hpp>
#include <span>
#include <string>
#include <vector>

namespace liecheck::properties {

using Span = std::span<double>;

/// A part of the arguments or of the result: its numbers start at `from`.
struct PartPlace {
  const Layout* layout;
  const Part* part;
  std::size_t from, size;
  Span in(Numbers& x) const { return Span(x).subspan(from, size); }
  std::span<const double> in(const Numbers& x) const { return std::span(x).subspan(from, size); }
};
std::vector<PartPlace> places_of(std::span<const Layout* const> layouts);

/// A change of some numbers, in words.
struct PartChange {
  std::string text;
  std::function<void(Numbers&)> apply;
};

/// The name of a part among all: with its argument's name if another argument has a part of this name.
std::string name_of(const PartPlace& place, const std::vector<PartPlace>& all);
/// The name of number i of a part.
std::string number_of(const PartPlace& place, std::size_t i, const std::vector<PartPlace>& all);
bool is_quaternion(const PartPlace& p);

/// Adds the changes of one part alone. Of a result, the text says what the part is; of an argument, what takes its place.
void add_changes(const PartPlace& at, const std::vector<PartPlace>& all, bool of_result,
                 std::vector<PartChange>& changes);
/// Adds those of two parts of one size.
void add_exchanges(const std::vector<PartPlace>& all, std::vector<PartChange>& changes);

}  // namespace liecheck::properties
