#pragma once
// The entrances of the program: every kind of text that a user or foreign code gives it.

#include <functional>
#include <string>
#include <vector>

namespace liecheck::test {

struct Entrance {
  std::vector<std::string> corpus;  ///< texts to mutate
  std::vector<std::string> words;   ///< to insert
  /// True if the text is accepted. Throws std::exception with a short message if it is refused, and Broken if the
  /// reader breaks its promise.
  std::function<bool(const std::string&)> feed;
  std::string name = "";
};

/// A promise that was not kept.
struct Broken {
  std::string what;
};

std::vector<std::string> entrance_names();
/// `folder` is fixtures; throws std::invalid_argument for an unknown name. Files are written to `scratch`.
Entrance entrance(const std::string& name, const std::string& folder, const std::string& scratch);

}  // namespace liecheck::test
