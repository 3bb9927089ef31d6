#pragma once
// What a generator must cover: the classes of inputs on which code breaks, by the kind of a group of numbers, each
// with how rare the generator may make it. A campaign counts them and fails where one that must have come up
// never did: then the generator is defective, or somebody narrowed it.

#include <array>
#include <cstdint>
#include <generators/field.hpp>
#include <span>
#include <string>
#include <vector>

namespace liecheck::properties {

/// A class of one kind's inputs. The generator gives it to at least one case in `one_in`, by statement; a test
/// measures it.
struct InputClass {
  std::string name;
  std::uint64_t one_in;
  Reach reach =
      Reach::limited;  ///< required of fields that reach this far; beside: of those with a neighbour
};

/// The classes of a kind; bit i of a mask is entry i. Empty for what has no structure of its own.
const std::vector<InputClass>& classes_of(Kind kind);
bool requires_class(const Field& field, const InputClass& c);

/// The classes that the numbers of a field belong to. `earlier` is the field's neighbour, or empty.
template <class S>
std::uint32_t classify(Kind kind, std::span<const S> x, std::span<const S> earlier);

/// How often each class of each field came up.
class Coverage {
 public:
  template <class S>
  void add(const std::vector<Field>& fields, const std::vector<S>& input);
  void merge(const Coverage& o);
  /// "CASES;N,N,...;N,...": the counts of every field, and back. False where it is not that.
  std::string text() const;
  bool parse(const std::string& text);
  std::uint64_t cases() const { return cases_; }
  std::uint64_t count(std::size_t field, std::size_t c) const {
    return field < counts_.size() ? counts_[field][c] : 0;
  }

 private:
  std::uint64_t cases_ = 0;
  std::vector<std::array<std::uint64_t, 24>> counts_;
};

/// A class is required once its expected count is this: missing it by chance has probability e^-30.
inline constexpr std::uint64_t expected_at_least = 30;

}  // namespace liecheck::properties
