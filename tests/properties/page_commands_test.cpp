// Every command on the pages runs and has its exit code. What is not run as it stands there is listed here.

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <utility>

#include "../scratch.hpp"
#include "pages.hpp"

namespace liecheck::properties {
namespace {

namespace fs = std::filesystem;

const std::string compiler = replaced(LIECHECK_SYNTAX_CHECK, " -fsyntax-only", "") + " " LIECHECK_LINK;

/// What stands in a command of a page, and in its place here; a command with `by` null is not run at all. The flags of
/// each command of liecheck are compared with its help (pages_test.cpp), also where it is not run.
struct Replacement {
  const char *what, *by, *why;
};
const Replacement changes[] = {
    {"apt-get update", nullptr, "installs packages and builds everything; these lines are what CI runs"},
    {"house_tests --gtest_filter='BuildTimes", nullptr, "ctest runs it"},
    {"g++ -std=c++20 -I lib -I /usr/include/eigen3 free_fall.cpp", nullptr,
     "the test of the README's program runs it"},
    {"g++ -std=c++20 -I lib -I /usr/include/eigen3 program.cpp", nullptr,
     "the README's line for another file"},
    {"campaign --cases 200 ", "campaign --no-hard-cases --cases 5 ",
     "the preset nightly runs 1000 cases of it as property_fixed_seed"},
    {"--for 5s", "--for 0.2s", "the length of a search"},
    {"lab sweep --coefficient c3", "lab sweep --stride 997 --coefficient c3",
     "the preset nightly sweeps all as property_every_float"},
    {"lab bugs --for-each 10s", nullptr, "ctest runs it as property_known_bugs"},
    {"lab history   ", nullptr, "its output is on the page, so pages_test.cpp runs it"},
    {"--cases 1000000", "--property exp_oracle --no-hard-cases --cases 50", "a night"},
    {"--cases 100000", "--cases 500", "a search in pieces of minutes"},
    {"--profile careful --cases 20000", "--profile careful --cases 500", "minutes"},
    {"lab league --record", "lab league --only eigen --cases 20 --record", "all libraries take minutes"},
    {"--only scipy --only glm", nullptr, "these libraries come with the packages of the fourth line"},
    {"changes old.json", "changes league.json", "an older record is the reader's"},
    {"build/release/adapters/kdl.so", nullptr, "comes with the packages of the fourth line, which checks it"},
    {"adapters/python/scipy_adapter.py", nullptr,
     "comes with the packages of the fourth line, which checks it"},
    {"build/release/adapters/three.js", nullptr,
     "comes with the packages of the fourth line, which checks it"},
    {"--subject mylib --limits mylib.limits",
     "--property exp_oracle --cases 50 --subject textbook --limits mylib.limits",
     "the page's mylib is the reader's; its file is judged here with the name textbook"},
    {"$SLURM_ARRAY_TASK_ID/100", "$SLURM_ARRAY_TASK_ID/1", "a hundred shards"},
    {"scene explain fixtures/scenes/quadruped_drop.yaml", "scene explain fixtures/scenes/free_fall.yaml",
     "seconds"},
    {"mpirun -n 32", nullptr, "MPI is optional, and the machine may have fewer cores"},
    {"compare last_night.db", "compare night.db", "an older store is the reader's"},
    {"lab rounding", "lab rounding --inputs 1 --samples 2", "minutes"},
    {"lab bounds --boxes 1000000", "lab bounds --boxes 100", "minutes"},
    {"lab bounds    ", "lab bounds --boxes 1000", "a minute"},
    {"liecheck environments", nullptr,
     "compiles the library in every environment that is installed: minutes"},
    {"lab horizons", nullptr, "a million calls and more of each row: minutes to hours"},
    {"adapter tellings", nullptr, "the libraries that read robots come with the packages of the fourth line"},
    {"lab limits --cases 100000", nullptr, "hours; it writes fixtures/limits"},
    {"campaign --adapter 'python3 fixtures/adapters/trees/adapter.py'",
     "campaign --cases 3 --scalar double --property lagrange --property frame_motion --no-hard-cases "
     "--adapter "
     "'python3 fixtures/adapters/trees/adapter.py'",
     "minutes in Python"},
};

/// Commands that find failures, and so return 1. All others return 0.
bool fails(const std::string& command) {
  for (const char* part :
       {"campaign --subject textbook", "--subject textbook --limits", "replay raw.exp_oracle.textbook",
        "hunt --subject textbook", "test 'python3 fixtures/adapters/rotations.py'",
        "campaign --cases 1000 --adapter 'python3 fixtures/adapters/rotations.py'",
        "campaign --subject history:gtsam_1233 "})
    if (command.find(part) != command.npos) return true;
  return false;
}

/// A folder with what the commands of the pages use in a clone. The program and g++ are first in PATH; g++ has the flags
/// of the library, for example sanitizers.
class Clone {
 public:
  Clone() {
    fs::remove_all(folder);
    fs::create_directories(folder / "build/release/bin");
    fs::copy(root + "fixtures", folder / "fixtures",
             fs::copy_options::recursive);  // some commands write there
    for (const char* name : {"lib", "properties"})
      fs::create_symlink(fs::canonical(root + name), folder / name);
    fs::create_symlink(LIECHECK_PROGRAM, folder / "build/release/bin/liecheck");
    const std::string library = LIECHECK_LIBRARY;
    fs::create_directories(folder / "build/release/lib");
    fs::create_symlink(library.substr(0, library.find(' ')), folder / "build/release/lib/libliecheck_lib.a");
    write("build/release/bin/g++", "#!/bin/sh\nexec " + compiler + " \"$@\"\n");
    fs::permissions(folder / "build/release/bin/g++", fs::perms::owner_all);
  }
  /// The exit code of a line of a shell in the folder `in` of the clone, and what it printed.
  std::pair<int, std::string> run(const std::string& in, const std::string& line) const {
    const std::string environment = "export SLURM_ARRAY_TASK_ID=1 PATH='" +
                                    (folder / "build/release/bin").string() + "':/usr/bin:\"$PATH\"; cd '" +
                                    (folder / in).string() + "' && ";
    FILE* const out = popen((environment + "{ " + line + "\n} 2>&1 </dev/null").c_str(), "r");
    std::string text;
    for (int c = fgetc(out); c != EOF; c = fgetc(out)) text += static_cast<char>(c);
    return {WEXITSTATUS(pclose(out)), text};
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }

  const fs::path folder = fs::path(liecheck::scratch()) / "liecheck_page_commands";
};

/// The commands of the blocks "sh" of a page, each with the folder in which it runs.
std::vector<std::pair<std::string, std::string>> commands_of(const std::string& page) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const CodeBlock& b : blocks_of(page)) {
    if (b.language != "sh") continue;
    std::string in = ".";
    std::istringstream lines(replaced(b.text, "\\\n", ""));
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("cd "))
        in = line.substr(3);
      else if (!line.empty() && line[0] != '#')
        all.emplace_back(in, line);
  }
  return all;
}

/// The commands of a page that have another exit code than they must; `used` gets the changes that apply.
std::vector<std::string> wrong_commands(const Clone& clone, const std::string& page,
                                        std::set<std::string>& used, int& run) {
  std::vector<std::string> wrong;
  for (const auto& [in, original] : commands_of(page)) {
    std::string line = original;
    bool left_out = false;
    for (const Replacement& c : changes) {
      if (original.find(c.what) == original.npos) continue;
      used.insert(c.what);
      left_out = left_out || !c.by;
      if (c.by) line = replaced(line, c.what, c.by);
    }
    if (left_out) continue;
    const auto [code, text] = clone.run(in, line);
    if (code != (fails(line) ? 1 : 0))
      wrong.push_back(line + ": exit code " + std::to_string(code) + "\n" + text);
    ++run;
  }
  return wrong;
}

TEST(PageCommands, RunAndHaveTheirExitCode) {
  const Clone clone;
  for (const CodeBlock& b : blocks_of(read("docs/limits.md")))
    if (b.text.starts_with("# mylib.limits"))
      clone.write("mylib.limits", replaced(b.text, "= mylib", "= textbook"));
  std::set<std::string> used;
  int run = 0;
  for (const std::string& page : pages())
    for (const std::string& wrong : wrong_commands(clone, read(page), used, run))
      ADD_FAILURE() << page << ": " << wrong;
  for (const Replacement& c : changes)
    EXPECT_TRUE(used.contains(c.what)) << "on no page: " << c.what << " (" << c.why << ")";
  EXPECT_GE(run, 30);
}

TEST(PageCommands, ThatFailAreFound) {
  const Clone clone;
  std::set<std::string> used;
  int run = 0;
  const std::string page =
      "```sh\ncd build/release/bin\n./liecheck list --laws   # all\n./liecheck list --lawz\n```\n"
      "```sh\nliecheck replay raw.exp_oracle.textbook.double.none.1,0,0,0,0,1\n```\n";
  const auto wrong = wrong_commands(clone, page, used, run);
  EXPECT_EQ(run, 3);
  ASSERT_EQ(wrong.size(), 2u);
  EXPECT_TRUE(wrong[0].starts_with("./liecheck list --lawz: exit code 2")) << wrong[0];
  EXPECT_NE(wrong[1].find("textbook.double.none.1,0,0,0,0,1: exit code 0"), std::string::npos) << wrong[1];
}

TEST(PageCommands, TheReadmesProgramIsCompiledByItsLineAndPrintsWhatItShows) {
  const Clone clone;
  const std::vector<CodeBlock> all = blocks_of(read("README.md"));
  const auto at = std::ranges::find(all, "cpp", &CodeBlock::language);
  ASSERT_GE(all.end() - at, 3);
  clone.write("free_fall.cpp", at[0].text);
  EXPECT_EQ(clone.run(".", at[1].text), std::pair(0, at[2].text));
  const auto line_of = [](const std::string& page, const std::string& what) {
    for (const auto& [in, line] : commands_of(read(page)))
      if (line.find(what) != line.npos) return line;
    return std::string();
  };
  const std::string line = line_of("README.md", "free_fall.cpp");
  EXPECT_EQ(replaced(line.substr(0, line.find(" &&")), "free_fall", "program"),
            line_of("docs/tutorial.md", "program.cpp"));
}

/// Programs without a main compile, with what they take for granted declared here.
TEST(PageCommands, PartsOfProgramsCompile) {
  const Clone clone;
  const auto block = [](const std::string& page, const std::string& begin) {
    for (const CodeBlock& b : blocks_of(read(page)))
      if (b.language == "cpp" && b.text.starts_with(begin)) return b.text;
    ADD_FAILURE() << page;
    return std::string();
  };
  const std::string adapter = "#include <liecheck_adapter.hpp>\n",
                    batch = "#include <liecheck/batch/poses.hpp>\n";
  fs::create_directory(clone.folder / "mylib");
  clone.write("mylib/rotation.h",
              "#include <array>\nnamespace mylib {\nstruct Quaternion {\n  double x, y, z, w;\n};\n"
              "struct Vector {\n  double x, y, z;\n};\nQuaternion exp(const std::array<double, 3>& phi);\n"
              "Vector rotate(const Quaternion& Q, const Vector& p);\n}\n");
  clone.write("parts.cpp",
              block("docs/start.md", adapter) + batch +
                  "using namespace liecheck;\nbatch::Rows<double, 6> f(int n, batch::Rows<double, 7> q0, "
                  "batch::Rows<double, 6> result) {\n" +
                  replaced(block("docs/library.md", batch), batch, "") + "return result; }\n");
  EXPECT_EQ(clone.run(".", "g++ -fsyntax-only -I . -I properties/adapters parts.cpp"),
            std::pair(0, std::string()));
}

}  // namespace
}  // namespace liecheck::properties
