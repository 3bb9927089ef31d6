#pragma once
// The league: libraries side by side. Its record is JSON; docs/laboratory.md has the fields.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace liecheck::properties::league {

/// A library that has an adapter.
struct Entry {
  std::string name, language;
  std::string adapter;    ///< as `--adapter` takes it; empty if the library was not found
  std::string get;        ///< a command that installs the library
  std::string run;        ///< how a shell runs a program in {file}
  std::string robot;      ///< the URDF that its operations on trees are judged on; empty if it has none
  std::string root;       ///< of the robot: fixed or free-flyer
  bool repaired = false;  ///< no library, but the forms that findings propose
  std::string limits;     ///< a limits file of what the library documents; empty if there is none
};

/// The list of adapters that the build wrote. Throws std::runtime_error or std::invalid_argument naming the file.
std::vector<Entry> read_roster(const std::string& file);

/// The list beside this program: ../adapters/league.json.
std::string built_in_roster();

/// What a reader asks: which library may I use there?
inline const std::vector<std::string> questions = {"near-zero", "near-pi", "1e-8", "off-unit", "1kHz"};

/// What one library answers to a question in one scalar.
struct Answer {
  std::string library, version, language, scalar, grade, worst_operation;
  double eps = 0;      ///< the largest error of its operations there
  double ns = 0;       ///< the mean time of its operations
  int operations = 0;  ///< that were measured there
};

/// The best first: by the grade, then by the error; for 1kHz by the time, after those with an F.
/// `question` is one of `questions`, or empty: everywhere.
std::vector<Answer> answers(const nlohmann::json& record, const std::string& question);

/// Reads a record of the league. Throws std::invalid_argument naming the file and what is missing.
nlohmann::json read_league(const std::string& file);

/// Markdown: what changed between two records, for each library that both have, and the libraries that one has.
std::string changes(const nlohmann::json& before, const nlohmann::json& after);

}  // namespace liecheck::properties::league
