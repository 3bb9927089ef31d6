#pragma once
// The keys of a part of a scene (an effect, an observer, a named start), and their values in one scene. The
// reader of scene files checks and documents all parts by their keys, without knowing any effect by name.

#include <compare>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace liecheck::scene {

enum class Kind {
  Number,
  Positive,
  NotNegative,
  Vector,     ///< three numbers
  Direction,  ///< three numbers, not all zero
  Numbers,    ///< a list of numbers
  Times,      ///< a strictly increasing list
  Table,      ///< rows [t, x1, ...] with increasing times t [s], or a CSV file: {file: FILE, columns: [...]}
  Frame,      ///< the name of a frame of the robot
  Frames,
  Bodies,  ///< names of bodies with shapes, or "all"
  Joints,  ///< names of joints of the robot, or "all": every joint except free-flyers
  Choice   ///< one of the words in `unit`, separated by |
};

/// One key. It is required if fallback is null. If fallback is "", it is optional and has no default.
struct Key {
  const char* name;
  Kind kind;
  const char* unit;      ///< SI; "1" for a plain number
  const char* fallback;  ///< as written in a scene, or null
  const char* meaning;
};

struct Value {
  std::vector<double> numbers;     ///< in SI units
  std::vector<std::string> names;  ///< of frames or joints, or the word of a choice
  std::size_t width = 1;           ///< numbers in each row of a table
  auto operator<=>(const Value&) const = default;
};

/// The values of a part's keys, checked, with defaults filled in.
class Parameters {
 public:
  std::map<std::string, Value> values;

  bool has(const std::string& key) const { return values.contains(key); }
  double number(const std::string& key) const { return at(key).numbers.at(0); }
  double number(const std::string& key, double otherwise) const { return has(key) ? number(key) : otherwise; }
  const std::vector<double>& numbers(const std::string& key) const { return at(key).numbers; }
  const Value& table(const std::string& key) const { return at(key); }
  const std::string& word(const std::string& key) const { return at(key).names.at(0); }
  const std::vector<std::string>& names(const std::string& key) const { return at(key).names; }
  bool operator==(const Parameters&) const = default;

 private:
  const Value& at(const std::string& key) const {
    const auto found = values.find(key);
    if (found == values.end()) throw std::logic_error("key '" + key + "' was read but is not in the schema");
    return found->second;
  }
};

/// A named part of a scene and its line in the scene file (0 if it is not from a file).
struct Request {
  std::string name;
  Parameters parameters;
  int line = 0;
};

/// The schema of a part and the texts that a plan shows.
struct PartInfo {
  const char* name;
  const char* equation;
  const char* energy;  ///< of effects: whether they conserve, add or dissipate energy
  const char* cost;    ///< the computations that the part adds to a plan
  std::vector<Key> keys;
};

}  // namespace liecheck::scene
