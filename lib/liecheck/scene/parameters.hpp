#pragma once
// What a part of a scene (an effect, an observer, a named start) may be told, and what one scene tells it. The keys are
// data: the reader of scene files checks and documents with them, and knows no effect by name.

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
  Times,      ///< a list that grows
  Frame,      ///< a name of the robot's
  Frames,
  Joints,  ///< names of the robot's, or "all": every joint but a free-flyer
  Choice,  ///< one of the words in `unit`, separated by |
  Flag     ///< true or false
};

/// Without a default the key must be given; with "" it may be missing and then nothing takes its place.
struct Key {
  const char* name;
  Kind kind;
  const char* unit;      ///< SI; "1" without
  const char* fallback;  ///< as a scene would write it, or null
  const char* meaning;
};

struct Value {
  std::vector<double> numbers;     ///< in SI units
  std::vector<std::string> names;  ///< of frames or joints, or the word of a choice
  bool operator==(const Value&) const = default;
};

/// What a scene says, every key checked, defaults filled in.
class Parameters {
 public:
  std::map<std::string, Value> values;

  bool has(const std::string& key) const { return values.contains(key); }
  double number(const std::string& key) const { return at(key).numbers.at(0); }
  double number(const std::string& key, double otherwise) const { return has(key) ? number(key) : otherwise; }
  const std::vector<double>& numbers(const std::string& key) const { return at(key).numbers; }
  const std::string& word(const std::string& key) const { return at(key).names.at(0); }
  const std::vector<std::string>& names(const std::string& key) const { return at(key).names; }
  bool flag(const std::string& key) const { return word(key) == "true"; }
  bool operator==(const Parameters&) const = default;

 private:
  const Value& at(const std::string& key) const {
    const auto found = values.find(key);
    if (found == values.end()) throw std::logic_error("key '" + key + "' was read, and is not in the schema");
    return found->second;
  }
};

/// A named part of a scene, and where it stands in its file (0 where it came from nowhere).
struct Request {
  std::string name;
  Parameters parameters;
  int line = 0;
};

/// What a part is: its schema and its words for the plan.
struct PartInfo {
  const char* name;
  const char* equation;
  const char* energy;  ///< of effects: conserves, adds, takes
  const char* cost;    ///< what it makes a plan hold
  std::vector<Key> keys;
};

}  // namespace liecheck::scene
