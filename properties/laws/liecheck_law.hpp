#pragma once
// One law of liecheck on one library, for the tests of that library: inputs, simpler inputs, and a judgement of
// each. The class needs no header of liecheck, of RapidCheck or of GoogleTest. liecheck_laws.hpp makes tests of it.
//
// CMake: find_package(liecheck COMPONENTS laws), then target_link_libraries(my_tests PRIVATE liecheck::laws).
// The library is called in this process, by one thread, and judged by the profile `careful` (docs/limits.md).

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

struct liecheck_adapter;  // liecheck_adapter.h

namespace liecheck::laws {

/// An input of a law in one of the scalars that the library offers. A float is kept exactly.
struct Input {
  bool is_double = true;
  std::vector<double> numbers;  ///< in the order of the fields of the law (liecheck list)
  std::string text;             ///< fields, decimal and hexadecimal
};
std::ostream& operator<<(std::ostream& out, const Input& input);

struct Judgement {
  std::string band;  ///< of the angle, such as "theta 1e-8..1e-7"; "all" for a law without angles
  /// Why the law does not hold: operation, block, error and limit, or an outcome such as NaN. Empty if it holds. An
  /// input on which the oracles reach no verdict is a failure.
  std::string failure;
};

/// The names of the laws, or of those of which the library offers an operation. Not before main().
std::vector<std::string> names();
std::vector<std::string> offered(const liecheck_adapter& library);

class Law {
 public:
  /// Registers the library when it is first named; a program may name four. Throws std::invalid_argument if the
  /// law does not exist, if the library offers none of its operations, or if it has other conventions than
  /// liecheck; the message names them (docs/conventions.md). Not before main().
  Law(const liecheck_adapter& library, const std::string& name);
  ~Law();
  Law(const Law&) = delete;
  Law& operator=(const Law&) = delete;

  /// A valid input, biased towards the angles, scales and axes at which code breaks. The same bits give the same
  /// input on every machine. The scalars take turns by the last bit of the last word.
  Input generate(const std::uint64_t (&bits)[4]) const;
  /// Valid inputs that are simpler, simplest first.
  std::vector<Input> simpler(const Input& input) const;
  Judgement judge(const Input& input) const;
  /// A campaign and the hard cases of the law, in each scalar. Returns what `liecheck campaign` prints about the
  /// failures, shrunk, and about what was not measured; empty if the law passes.
  std::string campaign(std::uint64_t seed = 42, std::uint64_t cases = 1000) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace liecheck::laws
