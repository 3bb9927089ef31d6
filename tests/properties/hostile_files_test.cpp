// Files are data: none that liecheck reads starts a program, writes or reads another file, or controls the terminal.
// Each row is a hostile file and the command that reads it.

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <fmt/format.h>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <reports/record.hpp>
#include <store/row_seal.hpp>
#include <string>
#include <support/json.hpp>
#include <vector>

#include "../reports/sample_record.hpp"
#include "../scratch.hpp"

namespace liecheck::properties {
namespace {

namespace fs = std::filesystem;

/// "@" in a text is the folder of the test. The command runs in its folder project/scenes; beside that are project/robots
/// and outside. A content that begins with "-> " is a link, with "store: " the SQL that changes a store, and with
/// "sealed: " the SQL after which all rows are sealed again.
struct Hostile {
  std::string name, command, says;
  std::map<std::string, std::string> files;
  int code = 2;
};
void PrintTo(const Hostile& h, std::ostream* out) {
  *out << h.name;
}

const std::string end = "\nintegrator: {name: rkmk4, step: 1 ms}\nduration: 2 ms\n",
                  ball = "robot: {body: ball, mass: 1, radius: 0.1}\n", run = "$L scene run s.yaml",
                  elsewhere = "is outside of the scene's folder",
                  link_body =
                      "<link name='a'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' "
                      "ixz='0' iyz='0'/></inertial></link>",
                  campaign = "campaign --no-hard-cases --property twist --scalar double --cases 3 -j 1 ",
                  one_adapter = R"({"name": "x", "language": "C", "adapter": "false", "get": "", "run": ""})",
                  with_store = "$L export s.db", merged = "$L merge m.db s.db",
                  replayed = "$L " + campaign + "--seed 2 --store s.db";

Hostile scene(const std::string& name, const std::string& text, const std::string& says,
              std::map<std::string, std::string> more = {}, const std::string& command = run) {
  more["s.yaml"] = text + end;
  return {name, command, "s.yaml:" + says, more};
}
Hostile ground(const std::string& name, const std::string& keys, const std::string& says,
               std::map<std::string, std::string> more = {}) {
  return scene(name, ball + "ground: {" + keys + "}", "2: " + says, std::move(more));
}
Hostile table(const std::string& name, const std::string& file,
              std::map<std::string, std::string> more = {}) {
  return scene(name, ball + "effects: [wrench: {frame: body, rows: {file: '" + file + "'}}]",
               "2: wrench.rows.file", std::move(more));
}
Hostile robot(const std::string& name, const std::string& urdf,
              std::map<std::string, std::string> more = {}) {
  return scene(name, "robot: {urdf: '" + urdf + "'}", "1: robot.urdf", std::move(more));
}
Hostile output(const std::string& name, const std::string& keys, const std::string& says,
               std::map<std::string, std::string> more = {}) {
  return scene(name, ball + "output: {" + keys + "}", " output." + says, std::move(more));
}
Hostile store(const std::string& name, const std::string& command, const std::string& says,
              const std::string& content) {
  return {name, command, "s.db: " + says, {{"s.db", content}}};
}
Hostile urdf(const std::string& name, const std::string& text, const std::string& says, int code = 2) {
  return {name, "$L robot r.urdf", says, {{"r.urdf", text}}, code};
}
Hostile record(const std::string& name, const std::string& text, const std::string& says) {
  return {name, "$L report r.json --out o", "r.json: " + says, {{"r.json", text}}};
}
Hostile into(const std::string& name, const std::string& command, const std::string& link,
             const std::string& to = "-> @/outside/keep") {
  return {name, command, link + ": is a link out of the folder", {{link, to}}};
}
Hostile limits(const std::string& name, const std::string& text, const std::string& says) {
  return {name, "$L " + campaign + "--limits l.limits", "l.limits:" + says, {{"l.limits", text}}};
}

std::string league(const std::string& change, const std::string& value) {
  nlohmann::json all = parsed(R"({"league": 1, "date": "d", "libraries": [{"name": "x", "version": "1",
 "language": "Python", "adapter": "echo", "run": "touch ran", "cells": [{"operation": "exp6", "scalar": "double",
 "grade": "F", "ns": 1, "cases": 1, "worst_eps": 1, "bands": [], "failure": {"what": "", "where": "", "guess": "",
 "text": "  as x's own program:\n\nx\n\n", "failed": 1, "cases": 1}}]}]})");
  all[nlohmann::json::json_pointer(change)] = parsed(value);
  return dumped(all);
}
std::string times(std::size_t n, const char* part = "[") {
  std::string text;
  for (std::size_t i = 0; i < n; ++i) text += part;
  return text;
}
/// A thousand numbers, a hundred thousand times.
std::string bomb() {
  std::string text = "[&r [" + times(999, "0, ") + "0]";
  return text + times(100'000, ", *r") + "]";
}
/// Twenty thousand triangles that overlap.
std::string pile() {
  std::string obj = "v 1 0 0\nv 0 1 0\n";
  for (int k = 1; k <= 20'000; ++k) obj += fmt::format("v 0 0 {}e-7\nf 1 2 {}\n", k, k + 2);
  return obj;
}
/// A robot of n joints on one link.
std::string star(int n) {
  std::string text = "<robot name='r'>" + link_body;
  for (int k = 0; k < n; ++k)
    text += fmt::format(
        "<link name='l{0}'/><joint name='j{0}' type='revolute'><parent link='a'/><child link='l{0}'/>"
        "<axis xyz='1 0 0'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint>",
        k);
  return text + "</robot>";
}
/// A rollback journal that names a second journal, which SQLite would delete.
std::string journal_naming(const std::string& file) {
  const auto number = [](std::uint32_t n) {
    std::string four;
    for (int k = 3; k >= 0; --k) four += static_cast<char>(n >> (8 * k) & 0xff);
    return four;
  };
  const std::string magic = "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
  std::string text = magic + number(0) + number(1) + number(1) + number(512) + number(4096);
  text.resize(512, '\0');
  std::uint32_t sum = 0;
  for (const char c : file) sum += static_cast<std::uint32_t>(static_cast<signed char>(c));
  return text + number((1U << 30) / 4096 + 1) + file + number(static_cast<std::uint32_t>(file.size())) +
         number(sum) + magic;
}

std::vector<Hostile> all() {
  const std::string esc = "\x1b[2J", c1 = "\xc2\x9b[2J", obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::vector<Hostile> h = {
      // scenes that read other files
      ground("MeshAbove", "mesh: ../../outside/m.obj", "ground.mesh: '../../outside/m.obj' " + elsewhere),
      ground("MeshBeside", "mesh: ../robots/m.obj", "ground.mesh: '../robots/m.obj' " + elsewhere,
             {{"../robots/m.obj", obj}}),
      ground("MeshAbsolute", "mesh: '@/outside/m.obj'", "ground.mesh: "),
      ground("MeshLinked", "mesh: m.obj", "ground.mesh: 'm.obj' " + elsewhere,
             {{"m.obj", "-> @/outside/m.obj"}}),
      ground("MeshInALinkedFolder", "mesh: d/m.obj", "ground.mesh: 'd/m.obj' " + elsewhere,
             {{"d", "-> @/outside"}}),
      ground("MeshDownAndUp", "mesh: d/../../../outside/m.obj", "ground.mesh: ", {{"d/x", ""}}),
      ground("HeightsAbove", "heights: ../../outside/secret.csv, spacing: [1, 1]", "ground.heights: "),
      ground("HeightsOfThePasswords", "heights: /etc/passwd, spacing: [1, 1]",
             "ground.heights: '/etc/passwd' " + elsewhere),
      ground("HeightsOfTheEnvironment", "heights: /proc/self/environ, spacing: [1, 1]", "ground.heights: "),
      ground("HeightsOfStandardInput", "heights: /dev/stdin, spacing: [1, 1]", "ground.heights: "),
      ground("HeightsLinked", "heights: h.csv, spacing: [1, 1]",
             "ground.heights: ", {{"h.csv", "-> @/outside/secret.csv"}}),
      table("TableAbove", "../../outside/secret.csv"),
      table("TableAbsolute", "@/outside/secret.csv"),
      table("TableLinked", "t.csv", {{"t.csv", "-> @/outside/secret.csv"}}),
      table("TableNamedLikeARobot", "../robots/t.csv", {{"../robots/t.csv", "0, 1\n1, 2\n"}}),
      robot("RobotAbsolute", "@/outside/r.urdf"),
      robot("RobotTwoAbove", "../../outside/r.urdf"),
      robot("RobotLinked", "r.urdf", {{"r.urdf", "-> @/outside/r.urdf"}}),
      robot("RobotBesideLinked", "../robots/r.urdf", {{"../robots/r.urdf", "-> @/outside/r.urdf"}}),
      robot("RobotBelowAFolderBeside", "../a/b/r.urdf", {{"../a/b/r.urdf", "SECRET"}}),
      robot("RobotAbove", "../r.urdf", {{"../r.urdf", "SECRET"}}),
      robot("RobotOfAnotherKind", "../robots/secret.txt", {{"../robots/secret.txt", "SECRET"}}),
      robot("RobotLinkedToAnotherKind", "r.urdf",
            {{"r.urdf", "-> @/project/secret.txt"}, {"../secret.txt", "SECRET"}}),
      {"SceneExplained",
       "$L scene explain s.yaml",
       "s.yaml:2: ground.mesh: ",
       {{"s.yaml", ball + "ground: {mesh: ../../outside/m.obj}" + end}}},
      {"SceneSwept",
       "$L scene sweep s.yaml --no-peers",
       "s.yaml:2: ground.mesh: ",
       {{"s.yaml", ball + "ground: {mesh: ../../outside/m.obj}" + end}}},
      {"MeshOfAnAllowedFolder",
       run + " --read-outside ../../outside",
       "s: 0.002 s",
       {{"s.yaml", ball + "ground: {mesh: ../../outside/m.obj}" + end}},
       0},
      {"MeshOfTrianglesThatOverlap",
       run,
       "s: 0.002 s",
       {{"s.yaml", ball +
                       "ground: {mesh: m.obj}\ninitial: {position: [0.2, 0.2, 1]}\n"
                       "effects: [gravity, contact: {bodies: all, stiffness: 1}]" +
                       end},
        {"m.obj", pile()}},
       0},
      {"RobotBeside",
       run,
       "s: 0.002 s",
       {{"s.yaml", "robot: {urdf: ../robots/r.urdf}" + end},
        {"../robots/r.urdf", "<robot name='r'>" + link_body + "</robot>"}},
       0},
      // scenes that write
      output("CsvAbove", "csv: ../ran.csv", "csv: '../ran.csv' is outside of the working folder"),
      output("CsvAbsolute", "csv: '@/outside/ran.csv'", "csv: "),
      output("CsvLinked", "csv: r.csv", "csv: 'r.csv' is outside", {{"r.csv", "-> @/outside/keep.csv"}}),
      output("CsvLinkedToNothing", "csv: r.csv", "csv: 'r.csv' is outside",
             {{"r.csv", "-> @/outside/ran.csv"}}),
      output("CsvInALinkedFolder", "csv: d/ran.csv", "csv: ", {{"d", "-> @/outside"}}),
      output("CsvHidden", "csv: .ran.csv", "csv: '.ran.csv' is hidden"),
      output("CsvInAHiddenFolder", "csv: .git/ran.csv", "csv: '.git/ran.csv' is hidden", {{".git/x", ""}}),
      output("CsvOfAnotherKind", "csv: Makefile", "csv: 'Makefile' has another ending"),
      output("CsvInPlaceOfAnother", "csv: mine.csv", "csv: 'mine.csv' exists, and no run",
             {{"mine.csv", "a,b\n"}}),
      output("CsvInPlaceOfATable", "csv: mine.csv", "csv: 'mine.csv' exists, and no run",
             {{"mine.csv", "t [s],x [m]\n0,1\n"}}),
      output("JsonInPlaceOfAnother", "json: package.json", "json: 'package.json' exists, and no run",
             {{"package.json", "{}"}}),
      output("JsonAbove", "json: ../ran.json", "json: '../ran.json' is outside of the working folder"),
      // scenes that exhaust or confuse
      ground("SceneOfAliases", "heights: " + bomb() + ", spacing: [1, 1]",
             "is not YAML: aliases repeat too many values"),
      scene("SceneThatHoldsItself", ball + "ground: {heights: &a [*a]}",
            "2: is not YAML: an alias stands inside"),
      scene("SceneNestedDeeply", ball + "ground: " + times(100000), "", {}),
      scene("SceneGivenTwice", ball + "duration: 1 s", ""),
      scene("SceneWithANumberBeyondDouble", "robot: {body: ball, mass: 1e999, radius: 1}", "1: robot.mass"),
      scene("SceneWithNan", "robot: {body: ball, mass: nan, radius: 1}", "1: robot.mass"),
      scene("SceneNamedWithEscapes", "scene: \"a\\e[2J\"\n" + ball, "1: scene holds a control character"),
      scene("SceneWithAKeyOfEscapes", "\"\\e[2J\": 1\n" + ball, "1: "),
      scene("SceneWithAKeyOfC1", "\"\\x9b[2J\": 1\n" + ball, "1: "),
      ground("HeightsInOneLine", "heights: h.csv, spacing: [1, 1]",
             "ground.heights: h.csv: line 1 is longer than", {{"h.csv", std::string(5 << 20, ',')}}),
      ground("MeshWithNan", "mesh: m.obj", "ground.mesh: m.obj: line 1: 'nan' is not a number",
             {{"m.obj", "v nan 0 0\n"}}),
      ground("MeshWithNoSuchVertex", "mesh: m.obj", "ground.mesh: m.obj: line 5: there is no vertex",
             {{"m.obj", obj + "f 1 2 1e300\n"}}),
      ground("MeshThatCountsTooMany", "mesh: m.stl",
             "ground.mesh: m.stl: 4294967295 triangles in 84 bytes: the STL file is cut off",
             {{"m.stl", std::string(80, ' ') + "\xff\xff\xff\xff"}}),
      {"SceneOfABillionSamples",
       run,
       "s.yaml:4: the run would keep 2e+09 samples of 1 numbers, of which memory has room for 5e+07: take an "
       "output.every of 4e-11 s or more",
       {{"s.yaml",
         ball + "integrator: {name: dopri5, tolerance: 1e-9}\nduration: 2 ms\noutput: {every: 1e-12}\n"}}},
      {"SceneNamedWithInvisibleLetters",
       run,
       "a\\xd8\\x9cb\\xc2\\xadc\\xe2\\x80\\x8bd\\xf3\\xa0\\x81\\x81e\u0416: 0.002 s",
       {{"s.yaml", "scene: \"a\u061cb\u00adc\u200bd\U000e0041e\u0416\"\n" + ball + end}},
       0},
      {"SceneNamedLikeAFlag",
       "$L scene run -x.yaml",
       "run: '-x.yaml' is none of its options; a file of this name is ./-x.yaml",
       {}},
      {"SceneNamedWithC1", run, "a\\x9b[2J: 0.002 s", {{"s.yaml", "scene: \"a\\x9b[2J\"\n" + ball + end}}, 0},
      {"CheckpointOfHugeCounts",
       run + " --resume c",
       "c: is ",
       {{"s.yaml", ball + end}, {"c", "liecheck checkpoint 3\n0 999999999999 "}}},
      {"CheckpointOfEscapes", run + " --resume c", "c: is ", {{"s.yaml", ball + end}, {"c", esc}}},
      // robots
      urdf("RobotOfEntities",
           "<!DOCTYPE r [<!ENTITY s SYSTEM 'file://@/outside/secret.csv'>]><robot name='&s;'>" + link_body +
               "</robot>",
           "r.urdf"),
      urdf("RobotNestedDeeply", "<robot name='r'>" + times(100000, "<a>"),
           "r.urdf:1: elements nested too deep"),
      urdf("RobotNamedWithEscapes", "<robot name='&#27;[2J'>" + link_body + "</robot>",
           "r.urdf:1: malformed XML, or cut off (reference to invalid character number: &#27;"),
      urdf("RobotNamedWithC1", "<robot name='&#155;[2J'>" + link_body + "</robot>", "\\x9b[2J: nq", 0),
      urdf("RobotWithALinkOfEscapes",
           "<robot name='r'><link name='&#27;[2J'/><link name='&#27;[2J'/></robot>", "r.urdf:1: "),
      {"RobotWhoseMeshIsASecret",
       run,
       "s.yaml",
       {{"s.yaml",
         "robot: {urdf: r.urdf}\nground: {height: 0}\neffects: [gravity, contact: {bodies: all, stiffness: 1 "
         "kN/m}]" +
             end},
        {"r.urdf", "<robot name='r'>" + link_body.substr(0, link_body.size() - 7) +
                       "<collision><geometry><mesh "
                       "filename='file://@/outside/m.obj'/></geometry></collision></link></robot>"}}},
      {"RobotOfManyJoints",
       "$L campaign --no-hard-cases --property mass_matrix --cases 1 -j 1 --robot r.urdf",
       "r.urdf: too large for the laws, which take at most 1000 velocities (1006 velocities)",
       {{"r.urdf", star(1000)}}},
      {"RobotOfManyJointsTold",
       "$L adapter tellings --cases 1 --robot r.urdf",
       "r.urdf: too large for the laws",
       {{"r.urdf", star(1000)}}},
      {"RobotNamedLikeACommand",
       "$L campaign --no-hard-cases --property robot_configuration --scalar double --cases 2 -j 1 --seed 1 "
       "--all --robot r.urdf --json j.json",
       "robot a;touch ran",
       {{"r.urdf", "<robot name='a;touch ran;$(touch ran)`touch ran`'>" + link_body + "</robot>"}},
       0},
      // records
      record("RecordNestedDeeply", times(200000), "nested more deeply than 100 levels"),
      record("RecordGivenTwice", "{\"version\": 1, \"version\": 2}", "the member 'version' is given twice"),
      record("RecordGivenTwiceWithEscapes", "{\"\\u001b[2J\": 1, \"\\u001b[2J\": 2}", "the member '"),
      record("RecordBeyondDouble", "{\"version\": 1e999}", "line 1, column 13: a number beyond double"),
      record("RecordWithNan", "{\"version\": NaN}", "not JSON: line 1, column 13"),
      record("RecordOfTooManyValues", "[" + times(1'500'001, "[],") + "1]", "more than 3000000 values"),
      {"RecordOfHoles",
       "truncate -s 99G r.json; $L report r.json; rm r.json; touch r.json",
       "r.json: cannot be read: longer than 67108864 bytes",
       {{"r.json", ""}},
       0},
      record("RecordThatIsNoObject", "[1]", ""),
      record("RecordWithMarks", "\xff\xfe{}", "not JSON"),
      record("RecordWithAStar", dumped(reports::with(reports::record(), "/*keys", 1)),
             "a member may not begin with a star"),
      record("RecordWithAnAddressOfACommand",
             dumped(reports::with(reports::full_record(), "/results/0/worst/id", "g4.1.x;touch ran")),
             "field results[0].worst.id: expected the address of a case"),
      record("RecordWithAReplayOfACommand",
             dumped(reports::with(reports::full_record(), "/hard_cases/0/cells/0/replay",
                                  "liecheck replay raw.x; touch ran")),
             "field hard_cases[0].cells[0].replay: expected a line of liecheck replay"),
      record("RecordWithAReplayOfTwoLines",
             dumped(reports::with(reports::full_record(), "/hard_cases/0/cells/0/replay",
                                  "liecheck replay raw.x 'a\nb'")),
             "field hard_cases[0].cells[0].replay: expected a line of liecheck replay"),
      {"TellingsOfMarks",
       "$L adapter tellings --cases 1 --robot r.urdf --out o >log && $L robot o/plain.urdf",
       "j\"><b>: nq",
       {{"r.urdf", "<robot name='j&quot;&gt;&lt;b&gt;'>" + link_body +
                       "<link name='&quot;/&gt;'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' "
                       "ixy='0' ixz='0' iyz='0'/></inertial></link>"
                       "<joint name='&quot;&gt;&lt;c' type='continuous'><parent link='a'/><child "
                       "link='&quot;/&gt;'/></joint></robot>"}},
       0},
      record("RecordOfTheLeague", league("/date", "\"d\""), ""),
      {"CostOfAnotherKind",
       "$L compare s.db s.db --cost r.json --cost r.json",
       "r.json: is no record of 'liecheck cost --json': ",
       {{"r.json", "{\"cost\": {\"rows\": [{\"sets\": [{\"latency\": 3}]}]}}"}}},
      {"CostNestedDeeply",
       "$L compare s.db s.db --cost r.json --cost r.json",
       "r.json: nested more deeply",
       {{"r.json", times(200000)}}},
      {"LeagueWithCommands",
       "$L lab league findings r.json --out o --adapters a.json",
       "r.json: the library 'x' has commands",
       {{"r.json", league("/date", "\"d\"")}, {"a.json", "[]"}}},
      {"LeagueOfNoCommands",
       "$L lab league findings r.json --out o --adapters a.json",
       "a.json: is no list of adapters: ",
       {{"r.json", league("/date", "\"d\"")}, {"a.json", "[{\"name\": \"x\"}]"}}},
      {"ListOfAdaptersNestedDeeply",
       "$L lab league --adapters a.json",
       "a.json: nested more deeply",
       {{"a.json", times(200000)}}},
      {"ListOfAdaptersThatIsAText",
       "$L lab league --adapters a.json",
       "a.json: is no list of adapters: ",
       {{"a.json", "\"x\""}}},
      {"ListOfAdaptersThatIsNull",
       "$L lab league --adapters a.json",
       "a.json: is no list of adapters: ",
       {{"a.json", "null"}}},
      {"ListOfAnAdapterTwice",
       "$L lab league --adapters a.json",
       "a.json: has 'x' twice",
       {{"a.json", "[" + one_adapter + ", " + one_adapter + "]"}}},
      {"LeagueOfAnotherKind",
       "$L lab league changes r.json r.json",
       "r.json: is no record of the league",
       {{"r.json", league("/league", "\"1\"")}}},
      {"LeagueOfALibraryTwice",
       "$L lab league changes r.json r.json",
       "r.json: the record has 'x' twice",
       {{"r.json",
         league(
             "/libraries/1",
             R"({"name": "x", "version": "1", "language": "C", "adapter": "", "run": "", "cells": []})")}}},
      {"LeagueRepairedByAText",
       "$L lab league changes r.json r.json",
       "r.json: x has no true or false 'repaired'",
       {{"r.json", league("/libraries/0/repaired", "\"x\"")}}},
      {"LeagueOfNegativeCounts",
       "$L lab league changes r.json r.json",
       "r.json: exp6 of x has no count 'cases'",
       {{"r.json", league("/libraries/0/cells/0/cases", "-1")}}},
      {"LeagueOfAnotherGrade",
       "$L lab league changes r.json r.json",
       "r.json: exp6 of x has no known word 'grade'",
       {{"r.json", league("/libraries/0/cells/0/grade", "\"A+++ best\"")}}},
      {"LeagueOfANegativeError",
       "$L lab league changes r.json r.json",
       "r.json: exp6 of x has no error 'worst_eps'",
       {{"r.json", league("/libraries/0/cells/0/worst_eps", "-1")}}},
      {"LeagueOfAnotherReplay",
       "$L lab league changes r.json r.json",
       "r.json: exp6 of x has no line of liecheck replay 'replay'",
       {{"r.json", league("/libraries/0/cells/0/replay", "\"liecheck replay x; touch ran\"")}}},
      {"HardCasesSharedOfASubject",
       "$L hard-cases --share o --subject nosuch",
       "--subject excludes --share",
       {}},
      {"LeagueNamedWithEscapes",
       "$L lab league changes r.json r.json",
       "r.json: \\x1b[2J has no list 'cells'",
       {{"r.json",
         "{\"league\": 1, \"date\": \"\", \"libraries\": [{\"name\": \"\\u001b[2J\", \"version\": \"\", "
         "\"language\": \"\", "
         "\"adapter\": \"\", \"run\": \"\"}]}"}}},
      {"StateOfAnotherRun",
       "$L lab bounds --state b.json --boxes 1",
       "b.json: is no state of a run",
       {{"b.json", "{\"options\": \"\\u001b\"}"}}},
      {"StateNestedDeeply",
       "$L lab bounds --state b.json --boxes 1",
       "b.json: nested more deeply",
       {{"b.json", times(200000)}}},
      // folders
      into("ReportInALinkToNothing", "$L report r.json --out o", "o/report.csv", "-> @/outside/ran"),
      into("ReportInALink", "$L report r.json --out o", "o/report.html"),
      into("RecordOfAStoreInALink", "$L report s.db --out o", "o/s.json"),
      into("SharedCasesInALink", "$L hard-cases --share o", "o/exp3_quaternion.json"),
      into("LimitsInALink",
           "$L lab limits --subject textbook --property exp_oracle --scalar double --cases 2 --check-cases 2 "
           "--tree-cases 2 -j 1 --out o",
           "o/textbook.limits"),
      into("TellingsInALink", "$L adapter tellings --cases 1 --out o", "o/plain.urdf"),
      // stores
      store("StoreWithATrigger", replayed, "corrupt: its trigger t is none of a store",
            "store: CREATE TRIGGER t AFTER INSERT ON campaigns BEGIN DELETE FROM limits; END"),
      store("StoreWithAView", with_store, "corrupt: its view v is none of a store",
            "store: DROP TABLE limits; CREATE VIEW v AS SELECT 1"),
      store("StoreWithAViewOfATable", with_store, "corrupt: its table x is none of a store",
            "store: ALTER TABLE limits RENAME TO x; CREATE VIEW limits AS SELECT * FROM x"),
      store("StoreWithATable", with_store, "corrupt: its table x is none of a store",
            "store: CREATE TABLE x(y)"),
      store("StoreWithAnIndex", with_store, "corrupt: its index x is none of a store",
            "store: CREATE INDEX x ON series(abs(cases))"),
      store("StoreWithAColumn", with_store, "corrupt: its table limits is none of a store",
            "store: ALTER TABLE limits ADD COLUMN y"),
      store("StoreWithoutATable", with_store, "corrupt: its table counterexamples is missing",
            "store: DROP TABLE counterexamples"),
      store("StoreWithoutItsCampaign", with_store,
            "corrupt: its table series has rows of a campaign that is missing",
            "store: DELETE FROM campaigns"),
      store("StoreWithLimitsOfNoCampaign", with_store,
            "corrupt: its table limits has rows of a campaign that is missing",
            "store: INSERT INTO limits VALUES(7, 'a', 'b', 'c', 0)"),
      store("StoreOfAnEarlierVersion", with_store, "a store of version 4", "store: PRAGMA user_version = 4"),
      store("StoreWithACounterexample", replayed, "corrupt: a row of its table counterexamples was changed",
            "store: INSERT INTO counterexamples VALUES('twist', 'liecheck', 'double', 'none', 'x', 'y', '1', "
            "0)"),
      store("StoreWithACounterexampleToMerge", merged,
            "corrupt: a row of its table counterexamples was changed",
            "store: INSERT INTO counterexamples VALUES('twist', 'liecheck', 'double', 'none', 'x', 'y', '1', "
            "0)"),
      store("StoreWithOtherRanges", with_store, "corrupt: a row of its table done was changed",
            "store: UPDATE done SET first = first + 1, last = last + 1"),
      store("StoreOfACommand", "$L compare s.db s.db --markdown m.md", "corrupt: a name is no word",
            "sealed: UPDATE series SET subject = 'x;touch ran;$(touch ran)'"),
      store("StoreOfARobotOfACommand", "$L compare s.db s.db", "corrupt: a name is no word",
            "sealed: UPDATE series SET robot = '`touch ran`'"),
      store("StoreOfAnOperationOfMarks", "$L compare s.db s.db", "corrupt: a name is no word",
            "sealed: UPDATE cells SET operation = '![x](http://x)'"),
      store("StoreOfNoText", with_store,
            "corrupt: ", "sealed: UPDATE series SET subject_version = CAST(x'ff9b' AS TEXT)"),
      store("StoreOfNoEnvironment", "$L report s.db --out o", "corrupt: its environment",
            "sealed: UPDATE campaigns SET environment = '{'"),
      store("StoreOfADeepEnvironment", "$L report s.db --out o", "corrupt: its environment",
            "sealed: UPDATE campaigns SET environment = '" + times(200000) + "'"),
      store("StoreOfEndlessCases", "$L report s.db --out o", "written by",
            "sealed: UPDATE campaigns SET cases = 9000000000000000000, last = 9000000000000000000, generator "
            "= 1"),
      store("StoreOfTextForACount", with_store,
            "corrupt: the column fast of its table series holds a value of another type than INTEGER",
            "sealed: UPDATE series SET fast = 'no number'"),
      store("StoreOfTextForARange", with_store,
            "corrupt: the column first of its table done holds a value of another type than INTEGER",
            "sealed: UPDATE done SET first = 'zero'"),
      store("StoreOfAWordAmongCases", with_store, "corrupt: a list of cases is malformed",
            "sealed: UPDATE series SET disagreed = 'neither a list'"),
      store("StoreOfALongText", with_store, "corrupt: a value is longer than 68157440 bytes",
            "store: UPDATE campaigns SET urdf = printf('%.*c', 70000000, 'x')"),
      store("StoreOfManyBins", with_store, "corrupt: a histogram is malformed",
            "sealed: UPDATE cells SET histogram = '2:1 1:1'"),
      store("StoreOfABinBeyondAll", with_store, "corrupt: a histogram is malformed",
            "sealed: UPDATE cells SET histogram = '2000000000:1'"),
      store("StoreOfLimitsOfEscapes", with_store, "its limits: ",
            "sealed: INSERT INTO limits VALUES(1, 'liecheck', 'x" + esc + "', '" + esc + "', 0)"),
      store("StoreOfNoRobot", "$L report s.db --out o",
            "its robot, subjects or limits: ", "sealed: UPDATE campaigns SET urdf = '<robot>" + esc + "'"),
      {"StoreWithAJournalThatDeletes",
       with_store,
       "s.db-journal: names another file",
       {{"s.db", "store: "}, {"s.db-journal", "journal"}}},
      {"LinkToAStoreWithAJournalThatDeletes",
       with_store,
       "s.db-journal: names another file",
       {{"real/s.db", "store: "}, {"real/s.db-journal", "journal"}, {"s.db", "-> real/s.db"}}},
      {"StoreWithALinkedJournal",
       replayed,
       "s.db-journal: is a link, a pipe or a folder beside a store",
       {{"s.db", "store: "}, {"s.db-journal", "-> @/outside/ran"}}},
      {"StoreWithAPipeForAJournal",
       with_store,
       "s.db-journal: is a link, a pipe or a folder beside a store",
       {{"s.db", "store: "}, {"s.db-journal", "pipe"}}},
      {"StoreWithALinkedLog",
       with_store,
       "s.db-wal: is a link, a pipe or a folder beside a store",
       {{"s.db", "store: "}, {"s.db-wal", "-> @/outside/keep"}}},
      {"StoreOfAHugeNumber",
       "$L export s.db@99999999999999999999",
       "s.db@99999999999999999999: no such store",
       {{"s.db", "store: "}}},
      {"StoreOfANegativeNumber", "$L export s.db@-1", "s.db@-1: ", {{"s.db", "store: "}}},
      {"StoreThatIsAFolder", with_store, "s.db: not a store", {{"s.db/x", ""}}},
      // lines and names
      {"LimitsWithAMark",
       "$L " + campaign + "--limits l.limits",
       "verdict pass",
       {{"l.limits", "\xef\xbb\xbfversion = 1\nsubject = liecheck\n"}},
       0},
      {"HardCasesWithAMark",
       "$L hard-cases --property exp_oracle --scalar double --file h.txt",
       "h.txt:1: name 'A B'",
       {{"h.txt",
         "\xef\xbb\xbf"
         "A B | exp_oracle | 0, 0, 0 | c | d | e\n"}}},
      ground("HeightsWithAMark", "heights: h.csv, spacing: [1, 1]",
             "ground.heights: h.csv: line 1: 'x' is not a number", {{"h.csv", "\xef\xbb\xbfx, 0\n0, 0\n"}}),
      limits("LimitsOfEscapes", "version = 2\nsubject = a" + esc + "\n", "2: a control character in"),
      limits("LimitsOfC1", "version = 2\nsubject = a" + c1 + "\n" + "x", "3: "),
      limits("LimitsWithoutAnEnd", "version = 2\nsubject = liecheck\n" + std::string(5 << 20, '#'),
             " cannot be read: longer than 4194304 bytes"),
      limits("LimitsOfNan", "version = 2\nsubject = liecheck\n[limits]\nexp6, *, any, forward = nan\n",
             "4: limit 'nan' is not"),
      limits("LimitsGivenTwice", "version = 2\nsubject = liecheck\nsubject = liecheck\n",
             "3: 'subject' is already in line 2"),
      {"HardCasesOfEscapes",
       "$L hard-cases --file h.txt",
       "h.txt:1: control character 0x1b",
       {{"h.txt", "a | b | " + esc + " | c | d | e\n"}}},
      {"HardCasesNestedDeeply",
       "$L hard-cases --property exp_oracle --file h.txt",
       "h.txt:1: ",
       {{"h.txt", "a | exp_oracle | " + times(100000, "(") + " | c | d | e\n"}}},
      {"HardCasesOfTowers",
       "$L hard-cases --property exp_oracle --file h.txt",
       "h.txt:1: ",
       {{"h.txt", "a | exp_oracle | 9^9^9^9^9, 0, 0 | c | d | e\n"}}},
      {"HardCasesNamedLikeAPath",
       "$L hard-cases --share o --file h.txt",
       "h.txt:1: name '../../ran'",
       {{"h.txt", "../../ran | exp_oracle | 0, 0, 0 | c | d | e\n"}}},
      {"AddressOfACommand", "$L replay 'g4.1.exp_oracle.liecheck.double.$(touch ran).1'", "$(touch ran)", {}},
      {"AddressOfEscapes",
       "$L replay \"$(printf 'g4.1.exp_oracle.\\033[2J.double.none.1')\"",
       "\\x1b[2J",
       {}},
      {"AdapterNestedDeeply",
       "$L adapter check \"sh a.sh\"",
       "is no JSON",
       {{"a.sh", "head -c 60000 /dev/zero | tr '\\000' '['; echo\n"}}},
      {"AdapterOfEscapes",
       "$L campaign --adapter \"sh a.sh\" --cases 1",
       "its name",
       {{"a.sh",
         "printf '{\"protocol\": 1, \"name\": \"\\\\u001b[2J\", \"version\": \"\", \"operations\": "
         "{\"exp6\": [\"double\"]}}\\n'; cat >/dev/null\n"}}},
      {"AdapterOfALongDescription",
       "$L adapter check \"sh a.sh\"",
       "a line has at most 65536 bytes",
       {{"a.sh", "head -c 300000 /dev/zero | tr '\\000' 'v'; cat\n"}}},
      {"CheckedAdapterOfEscapes",
       "$L adapter check \"sh a.sh\"",
       "its name",
       {{"a.sh",
         "printf '{\"protocol\": 1, \"name\": \"\\\\u001b[2J\", \"version\": \"\", \"operations\": "
         "{\"exp6\": [\"double\"]}}\\n'; cat >/dev/null\n"}}},
  };
  return h;
}

class HostileFile : public testing::TestWithParam<Hostile> {
 protected:
  std::string placed(std::string text) const {
    for (auto at = text.find('@'); at != text.npos; at = text.find('@', at + 1))
      if (text.compare(at, 2, "@/") == 0) text.replace(at, 1, root);
    return text;
  }
  static std::string read(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& file, const std::string& content) const {
    fs::create_directories(fs::path(file).parent_path());
    if (content.starts_with("-> "))
      fs::create_symlink(placed(content.substr(3)), file);
    else if (content == "pipe")
      ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
    else if (content.starts_with("store: ") || content.starts_with("sealed: "))
      make_store(file, content);
    else
      std::ofstream(file, std::ios::binary)
          << (content == "journal" ? journal_naming(root + "/outside/keep") : placed(content));
  }
  static void make_store(const std::string& file, const std::string& content) {
    ASSERT_EQ(
        std::system(fmt::format("{} {} --store {} >/dev/null", LIECHECK_PROGRAM, campaign, file).c_str()), 0);
    SQLite::Database database(file, SQLite::OPEN_READWRITE);
    database.exec(content.substr(content.find(' ') + 1));
    if (content.starts_with("sealed: "))
      for (const std::string table : {"campaigns", "series", "done", "cells", "limits"})
        seal(database, table);
  }
  /// Seals the rows of a table again.
  static void seal(SQLite::Database& database, const std::string& table) {
    const auto seals = [](sqlite3_context* context, int n, sqlite3_value** values) {
      std::string texts;
      for (int i = 0; i < n; ++i) {
        const int type = sqlite3_value_type(values[i]);
        const auto bytes = [&] { return reinterpret_cast<const char*>(sqlite3_value_text(values[i])); };
        texts += type == SQLITE_INTEGER ? sealed_text(std::int64_t(sqlite3_value_int64(values[i])))
                 : type == SQLITE_TEXT
                     ? sealed_text(std::string(bytes(), std::size_t(sqlite3_value_bytes(values[i]))))
                 : type == SQLITE_FLOAT ? sealed_text(sqlite3_value_double(values[i]))
                                        : ";";
      }
      sqlite3_result_int64(context, seal_of(texts));
    };
    sqlite3_create_function(database.getHandle(), "seals", -1, SQLITE_UTF8, nullptr, seals, nullptr, nullptr);
    std::string columns;
    SQLite::Statement names(database,
                            "SELECT name FROM pragma_table_info(?) WHERE name <> 'seal' ORDER BY cid");
    for (names.bind(1, table); names.executeStep();)
      columns += (columns.empty() ? "" : ", ") + names.getColumn(0).getString();
    database.exec(fmt::format("UPDATE {} SET seal = seals({})", table, columns));
  }
  /// Every file and link below the folder of the test, with what it holds.
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(root))
      if (entry.is_symlink())
        all[entry.path().string()] = "-> " + fs::read_symlink(entry.path()).string();
      else if (entry.is_regular_file())
        all[entry.path().string()] = read(entry.path());
    return all;
  }
  void SetUp() override {
    fs::create_directories(here);
    write(root + "/outside/secret.csv", "SECRET, SECRET\n");
    write(root + "/outside/m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write(root + "/outside/keep", "kept"), write(root + "/outside/keep.csv", "t [s],kept\n");
    write(root + "/outside/r.urdf", "<robot name='SECRET'>" + link_body + "</robot>");
    write(here + "r.json", dumped(reports::record()));
    if (GetParam().command.find("s.db") != std::string::npos && !GetParam().files.contains("s.db") &&
        !GetParam().files.contains("s.db/x"))
      write(here + "s.db", "store: ");
    for (const auto& [name, content] : GetParam().files) {
      if (name == "r.json") fs::remove(here + name);
      write(here + name, content);
    }
  }
  void TearDown() override { fs::remove_all(root); }

  const std::string root = scratch() + "hostile", here = root + "/project/scenes/";
};

TEST_P(HostileFile, IsData) {
  const auto before = files();
  const std::string log = scratch() + "said";
  const int status = std::system(
      fmt::format("cd {}; SECRET=SECRET; export SECRET; L='timeout 20 {}'; {{ {}; }} >{} 2>&1 </dev/null",
                  here, LIECHECK_PROGRAM, placed(GetParam().command), log)
          .c_str());
  const std::string text = read(log);
  EXPECT_EQ(WEXITSTATUS(status), GetParam().code) << text;
  EXPECT_NE(text.find(GetParam().says), text.npos) << text;
  EXPECT_EQ(text.find("SECRET"), text.npos) << text;
  EXPECT_EQ(text.find("json.exception"), text.npos) << text;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    EXPECT_FALSE((byte < 0x20 && byte != '\n') || byte == 0x7f) << int(byte);
    if (byte == 0xc2 && i + 1 < text.size()) {
      EXPECT_GE(static_cast<unsigned char>(text[i + 1]), 0xa0);
    }
  }
  auto after = files();
  if (GetParam().code == 0)
    std::erase_if(after, [&](const auto& f) {
      return f.first.starts_with(here) && !before.contains(f.first) && f.first.find("ran") == f.first.npos;
    });
  for (const auto& [name, content] : after)
    EXPECT_TRUE(before.contains(name) && before.at(name) == content) << name;
  for (const auto& [name, content] : before) EXPECT_TRUE(after.contains(name)) << name;
  if (GetParam().code == 2) {
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  }
}

TEST(OutputsOfAScene, ReplaceThoseOfAnEarlierRun) {
  const std::string folder = scratch() + "own";
  fs::create_directories(folder);
  std::ofstream(folder + "/s.yaml") << ball << "output: {csv: s.csv, json: s.json}" << end;
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(std::system(("cd " + folder + " && " LIECHECK_PROGRAM " scene run s.yaml >log 2>&1").c_str()),
              0)
        << i;
  EXPECT_TRUE(fs::exists(folder + "/s.csv") && fs::exists(folder + "/s.json"));
}

INSTANTIATE_TEST_SUITE_P(Of, HostileFile, testing::ValuesIn(all()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace liecheck::properties
