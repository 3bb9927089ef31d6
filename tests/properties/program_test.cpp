// The program's command line: its error messages, its exit codes, and that no output is lost.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <support/text.hpp>
#include <utility>
#include <vector>

#include "../scratch.hpp"

namespace {

namespace fs = std::filesystem;

class Program : public testing::Test {
 protected:
  struct Run {
    int code;  ///< -1 if a signal or the time limit ended it
    std::string out, err;
  };
  fs::path dir = fs::path(liecheck::scratch()) / ("liecheck_program_" + std::to_string(::getpid()));
  const std::string quick = "campaign --property exp_oracle --scalar double --cases 2 -j 1 --no-hard-cases ";
  const std::string robot =
      "campaign --property robot_configuration --scalar double --cases 2 -j 1 --no-hard-cases ";

  void SetUp() override { fs::create_directories(dir); }
  void TearDown() override { fs::remove_all(dir); }

  static std::string read(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path store(const std::string& name, const std::string& text) const {
    std::ofstream(dir / name, std::ios::binary) << text;
    return dir / name;
  }
  /// Runs a shell line in the test's folder. $L is the program.
  Run shell(const std::string& line) const {
    const std::string whole = "cd '" + dir.string() + "'; L='timeout 60 " + LIECHECK_PROGRAM + "'; { " +
                              line + "; } >out 2>err </dev/null";
    const int status = std::system(whole.c_str());
    return {WIFEXITED(status) && WEXITSTATUS(status) < 124 ? WEXITSTATUS(status) : -1, read(dir / "out"),
            read(dir / "err")};
  }
  Run run(const std::string& arguments) const { return shell("$L " + arguments); }
  /// Expects exit code 2, an error of one line that contains `words`, and no output.
  void refused(const std::string& arguments, const std::string& words) const {
    const Run r = run(arguments);
    EXPECT_EQ(r.code, 2) << arguments << "\n" << r.err;
    EXPECT_EQ(r.err.rfind("liecheck: ", 0), 0U) << r.err;
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r.err;
    EXPECT_NE(r.err.find(words), std::string::npos) << arguments << "\n" << r.err;
    EXPECT_EQ(r.out, "");
  }
};

TEST_F(Program, NumbersArePlainDecimalAndInRange) {
  for (const char* bad : {"-1", "99999999999999999999", "''", "010", "0x10", "' 7'", "+7", "1e3", "7.0"})
    refused("campaign --seed " + std::string(bad), "--seed: '");
  for (const char* bad : {"0", "-5", "1099511627777"})
    refused("campaign --cases " + std::string(bad), "--cases: '");
  for (const char* bad : {"0", "1025", "two"}) refused("campaign -j " + std::string(bad), "--jobs: '");
  refused("campaign -j 1 --jobs 0", "--jobs: given more than once");
  for (const char* bad : {"5x", "0x10", "inf", "nan", "-1", "1e9h", "m", "1e-400s", "1e400", "0.0"})
    refused("campaign --for " + std::string(bad), "--for: not a duration");
  refused("campaign --for 0." + std::string(400, '0') + "1s", "--for: not a duration");
  refused("campaign --for " + std::string(400, '9') + "s", "--for: not a duration");
  EXPECT_EQ(run(quick + "--seed 18446744073709551615").code, 0);
}

TEST_F(Program, EmptyValuesAndUnknownWordsAreNamed) {
  for (const char* flag : {"--for", "--robot", "--json", "--subject", "--property", "--scalar"})
    refused("campaign " + std::string(flag) + " ''", std::string(flag) + ": may not be empty");
  refused("report --out ''", "--out: may not be empty");
  refused("nope", "unknown command 'nope'; commands: test, list, ");
  refused("--frob", "unknown option '--frob'");
  refused(quick + "--subject all --subject nope", "unknown subject 'nope'");
  refused(quick + "--subject 'a\nb'", "unknown subject 'a\\nb'");
  refused("scene nope", "unknown command 'nope'; commands of scene: run, explain, sweep, keys");
  refused("scene", "scene: which one? run, explain, sweep, keys");
  refused(
      "lab nope",
      "unknown command 'nope'; commands: list, campaign, replay, hard-cases, hunt, promise, completion, ");
  refused("lab league --for nowhere", "--for: nowhere not in {near-zero,near-pi,1e-8,off-unit,1kHz}");
  refused("lab league --only nope", "--only: unknown library 'nope'; known: ");
  refused("lab league nope", "unknown command 'nope'; commands of league: findings, changes, measure");
  refused("lab league measure x --cases 0", "--cases: '0' is not a decimal number");
  store("l.json", "{}");
  refused("lab league --record l.json", "l.json: is no record of the league");
  refused("lab league changes l.json l.json", "l.json: is no record of the league");
  refused("lab league findings none.json --out d", "none.json");
  refused("campaign --for 1s --shard 1/2", "--for: a shard is a part of a fixed number");
  refused("campaign --subject eigen --scalar float128", "--scalar: unknown scalar 'float128'");
  refused("report r.json --seed 3", "excludes");
}

TEST_F(Program, AReportNamesThePartsThatTheLaboratoryDidNotWrite) {
  const std::string copied = "cp \"${L##* }\" liecheck; rm -f liecheck-lab; ",
                    report = "timeout 100 ./liecheck report --cases 1 --no-cost -j 1 --out page";
  const Run absent = shell(copied + report);
  EXPECT_EQ(absent.code, 0) << absent.err;
  EXPECT_NE(absent.err.find("liecheck-lab, is not built"), std::string::npos) << absent.err;
  const Run broken =
      shell(copied + "printf '#!/bin/sh\\nexit 1\\n' >liecheck-lab; chmod +x liecheck-lab; " + report);
  EXPECT_EQ(broken.code, 0) << broken.err;
  for (const std::string part : {"sweep", "bounds", "scenes"})
    EXPECT_NE(broken.err.find("no part '" + part + "': liecheck-lab ended without a record"),
              std::string::npos)
        << broken.err;
}

TEST_F(Program, HelpFitsOneScreenWithoutExitCodes) {
  for (const std::string program : {"", "lab "}) {
    const std::string help = run(program + "--help").out;
    std::istringstream lines(help);
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count) EXPECT_LE(line.size(), 100U) << line;
    EXPECT_GE(count, 20) << help;
    EXPECT_LE(count, 30) << help;
    EXPECT_EQ(help.find("xit code "), std::string::npos) << help;
  }
  const std::string help = run("--help").out;
  for (const char* group : {"test your library", "look closer", "in CI", "robots and scenes",
                            "campaigns on many machines", "laboratory"})
    EXPECT_NE(help.find("\n" + std::string(group) + "\n"), std::string::npos) << group;
  EXPECT_NE(run("campaign --help").out.find("Exit code 0 if every error is within its limit"),
            std::string::npos);
}

TEST_F(Program, StartsTheLaboratoryBesideItOrSaysHowToBuildIt) {
  EXPECT_EQ(run("lab --version").out, run("--version").out);
  EXPECT_EQ(run("lab history --list").code, 0);
  // The same arguments and exit code.
  EXPECT_EQ(shell("$L lab limits 'a b'").code, 2);
  EXPECT_NE(read(dir / "err").find("a b"), std::string::npos) << read(dir / "err");
  // A subject of the laboratory is tested there.
  const std::string bug = " --subject bug:exp_nan_at_zero --property exp_oracle --scalar double --cases 50";
  EXPECT_EQ(run("campaign --no-hard-cases" + bug).code, 1) << read(dir / "err");
  EXPECT_EQ(run("replay raw.exp_oracle.bug:exp_nan_at_zero.double.none.1,0,0,0,0,0").code, 1);
  fs::copy_file(fs::canonical(LIECHECK_PROGRAM), dir / "liecheck");
  for (const std::string& command : {std::string("lab history"), "campaign" + bug}) {
    const Run alone = shell("./liecheck " + command);
    EXPECT_EQ(alone.code, 2);
    EXPECT_NE(alone.err.find("--target liecheck-lab"), std::string::npos) << alone.err;
  }
}

TEST_F(Program, ASweepRefusesBadArgumentsAndSaysWhichBoundItGives) {
  refused("lab sweep --coefficient c9", "--coefficient: unknown coefficient 'c9'; known: c0, c1, ");
  refused("lab sweep --coefficient ''", "--coefficient: may not be empty");
  refused("lab sweep --stride 0", "--stride: '0'");
  refused("lab sweep --json none/s.json", "none/s.json: cannot be written");
  const Run sample = run("lab sweep -j 1 --stride 10007 --coefficient c2 --json s.json");
  EXPECT_EQ(sample.code, 0) << sample.err;
  EXPECT_NE(sample.out.find("a lower bound of the maximum"), std::string::npos);
  EXPECT_EQ(sample.out.find("upper bound"), std::string::npos);
  const auto record = nlohmann::json::parse(read(dir / "s.json"));
  EXPECT_EQ(record["bound"], "lower");
  EXPECT_TRUE(record["coefficients"][0]["bound_eps"].is_null());
  EXPECT_EQ(record["coefficients"][0]["status"], "sampled");
  const Run whole = run("lab sweep -j 1 --coefficient c4_minus_3c5");
  EXPECT_EQ(whole.code, 0) << whole.err;
  EXPECT_NE(whole.out.find("an upper bound of the error in float over every argument"), std::string::npos);
  EXPECT_EQ(shell("timeout --preserve-status -s INT 1 $L lab sweep -j 1 --coefficient alpha").code, 3);
}

TEST_F(Program, AHuntAppendsToACorpusAndRefusesAnyOtherFile) {
  const std::string hunt =
      "hunt --subject textbook --op exp6 --property exp_oracle --evaluations 400 --corpus ";
  store("notes.txt", "a list\nof mine\n");
  refused(hunt + "notes.txt", "notes.txt:1: ");
  EXPECT_EQ(read(dir / "notes.txt"), "a list\nof mine\n");
  const std::string mine = "mine | exp_oracle | 1, 2, 3, 0, 0, 1 | generic | reason | origin";
  store("cases.txt", mine);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(run(hunt + "cases.txt").code, 1);
  const std::string found = read(dir / "cases.txt");
  EXPECT_EQ(found.rfind(mine + "\nhunted_exp6_", 0), 0u) << found;
  EXPECT_EQ(std::count(found.begin(), found.end(), '\n'), 4) << found;
  EXPECT_EQ(run("hard-cases --file cases.txt --property exp_oracle").code, 0);
}

TEST_F(Program, CostRefusesBadArgumentsAndRecordsAnInterruptedRun) {
  refused("cost --op exp7", "--op: unknown operation 'exp7'; known: exp3_quaternion, ");
  refused("cost --subject nope", "--subject: unknown subject 'nope'; known: ");
  refused("cost --scalar half", "--scalar: unknown scalar 'half'; known: float, double");
  refused("cost --op ''", "--op: may not be empty");
  refused("cost --for 0", "--for: not a duration");
  refused("cost --json none/c.json", "none/c.json: cannot be written");
  refused("cost --subject ceres --op exp6", "nothing to time");
  const std::string quick = "cost --op exp6 --op inverse --scalar double --for ";
  const Run r = run(quick + "0.5 --json c.json");
  EXPECT_EQ(r.code, 0) << r.err;
  const auto record = nlohmann::json::parse(read(dir / "c.json"));
  EXPECT_EQ(record["verdict"], "pass");
  std::size_t scored = 0;
  for (const auto& row : record["rows"]) {
    const auto& all = row["sets"].back();
    EXPECT_EQ(all["set"], "mixed");
    if (row["subject"] == "liecheck:batch") {  // a batch has a throughput only
      EXPECT_TRUE(all["latency"].is_null());
      EXPECT_LT(all["throughput"]["ratio"], 100);
      continue;
    }
    EXPECT_LE(all["latency"]["low"], all["latency"]["ratio"]);
    EXPECT_LE(all["latency"]["ratio"], all["latency"]["high"]);
    EXPECT_GE(all["latency"]["processes"], 1);  // more on a machine that is not disturbed
    EXPECT_EQ(all["latency"]["ns"],
              all["latency"]["ratio"].get<double>() * record["reference_ns"].get<double>());
    EXPECT_NE(r.out.find(row["subject"].get<std::string>()), std::string::npos);
    if (row["subject"] == "liecheck") {
      ++scored;
      EXPECT_LT(row["error"], 1e-14);
    }
    if (row["subject"] == "textbook" && row["operation"] == "exp6") {
      ++scored;
      EXPECT_GT(row["error"], 1e-10);
    }
  }
  EXPECT_EQ(scored, 3U);
  EXPECT_EQ(shell("timeout --preserve-status -s INT 2 $L " + quick + "40 --json i.json").code, 3);
  EXPECT_EQ(nlohmann::json::parse(read(dir / "i.json"))["verdict"], "incomplete");
}

TEST_F(Program, LabSpeedPrintsTheRowInWhichItWasStopped) {
  const Run r = shell("timeout --preserve-status -s INT 1 $L lab speed --for-each 60s --json s.json");
  EXPECT_EQ(r.code, 3);
  EXPECT_NE(r.out.find("exp6 double"), std::string::npos) << r.out;
  const auto record = nlohmann::json::parse(read(dir / "s.json"));
  EXPECT_EQ(record["verdict"], "incomplete");
  EXPECT_EQ(record["rows"].size(), 1U);
}

TEST_F(Program, InvalidCaseIdsAreRefusedWithThePosition) {
  const std::string id = "raw.exp_oracle.liecheck.double.none.";
  refused("replay " + id + "1,a,2", "'" + id + "1,a,2': number 2 is not a number: 'a'");
  refused("replay " + id + "1,2,3,", "number 4 is not a number: ''");
  refused("replay " + id + "'1, 2,3'", "number 2 is not a number: ' 2'");
  refused("replay " + id + "1,2,3,1e-400,0,0", "number 4 is rounded to zero in double: '1e-400'");
  refused("replay " + id + "1,2,3,0x1p+1024,0,0", "number 4 is beyond the range of double: '0x1p+1024'");
  refused("replay raw.exp_oracle.liecheck.double.nope.1,2,3", "exp_oracle takes no robot: expected none");
}

TEST_F(Program, ARobotIsReadOnceAndNamedAsTheXmlParserReadsIt) {
  ASSERT_EQ(::mkfifo((dir / "fifo").c_str(), 0600), 0);
  refused(robot + "--robot fifo", "fifo: cannot be read (a pipe without a writer)");
  refused(robot + "--robot none.urdf", "liecheck: none.urdf: cannot be opened (No such file or directory)");
  store("bad.urdf", "<robot name='r\xff'>\n<link name='a'/></robot>");
  refused(robot + "--robot bad.urdf --json r.json", "bad.urdf:1: not UTF-8");
  store("n.urdf",
        "<!-- <robot name=\"wrong\"> -->\n<robot name='a&amp;b&#10;c&#155;[31m'>\n<link name='a'/></robot>");
  for (const char* how : {"$L ", "cat n.urdf | $L "}) {
    const Run r = shell(how + robot + "--robot " + (how[0] == '$' ? "n.urdf" : "/dev/stdin"));
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_NE(r.out.find("robot a&b\\nc\\x9b[31m ("), std::string::npos) << r.out;
    EXPECT_NE(r.err.find(":2: the link of a moving joint and the links fixed to it have no mass"),
              std::string::npos)
        << r.err;
  }
}

TEST_F(Program, TextIsQuotedForAShellAndEscapedForATerminal) {
  using liecheck::properties::printable, liecheck::properties::shell_quoted;
  for (const char* word : {"it's x.urdf", "", "a\nb", "$(echo x)", "*", "plain.urdf", "~", "-n"})
    EXPECT_EQ(shell("printf %s " + shell_quoted(word)).out, word);
  EXPECT_EQ(shell_quoted("a/b-c_1.urdf"), "a/b-c_1.urdf");
  EXPECT_EQ(printable("\xe6\x9c\xba a\xff\x80 \xe6\x9c"), "\xe6\x9c\xba a\\xff\\x80 \\xe6\\x9c");
  // Marks that turn the direction of a line are no letters.
  EXPECT_EQ(printable("a\xe2\x80\xae-\xe2\x81\xa6 \xe2\x80\xa6"),
            "a\\xe2\\x80\\xae-\\xe2\\x81\\xa6 \xe2\x80\xa6");
  for (const char* formula : {"=1+1", "@a", "-2+cmd|x", "-1p-3"})
    EXPECT_EQ(liecheck::properties::csv_field(formula)[0] == '\'', formula != std::string("-1p-3"))
        << formula;
  EXPECT_EQ(printable("a\n\t\x1b[31m\x7f\xc2\x9b\xc3\xa9"), "a\\n\\t\\x1b[31m\\x7f\\x9b\xc3\xa9");
}

TEST_F(Program, AReplayIsPrintedAsItsUserTypesIt) {
  const std::string adapter = LIECHECK_FIXTURES "/adapters/rotations.py";
  const std::string campaign =
      "campaign --no-hard-cases --cases 200 --property log_oracle --scalar double --adapter "
      "'/usr/bin/python3 " +
      adapter + "'";
  EXPECT_NE(run(campaign).out.find("   replay   liecheck replay "), std::string::npos);
  const std::string called =
      shell("LIECHECK_CALLED_AS='npx liecheck' LIECHECK_SERVES='/usr/bin/python3 ' $L " + campaign).out;
  EXPECT_NE(called.find("   replay   npx liecheck replay "), std::string::npos) << called;
  EXPECT_NE(called.find(" --adapter " + adapter + "\n"), std::string::npos) << called;
}

TEST_F(Program, LostOutputIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP();
  for (const std::string& what : {std::string("list"), std::string("--help"), quick}) {
    const Run full = shell("$L " + what + " >/dev/full");
    EXPECT_EQ(full.code, 2) << what;
    EXPECT_NE(full.err.find("standard output: cannot be written"), std::string::npos) << full.err;
    EXPECT_EQ(shell("$L " + what + " >&-").code, 2) << what;
  }
  EXPECT_EQ(shell("$L nope 2>/dev/full").code, 2);
}

TEST_F(Program, TheTableSurvivesTheLossOfTheRecordAndTheRecordThatOfTheTable) {
  store("r.json.part", "of the user");
  shell("$L " + quick + "--json r.json >&-");
  EXPECT_EQ(nlohmann::json::parse(read(dir / "r.json"))["verdict"], "pass");
  EXPECT_EQ(read(dir / "r.json.part"), "of the user");
  fs::create_directory(dir / "gone");
  const Run r = shell(
      "($L campaign --property exp_oracle --for 3 -j 1 --json gone/r.json) & sleep 1; rmdir gone; wait $!");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.out.find("verdict pass"), std::string::npos) << r.out;
  EXPECT_NE(r.err.find("liecheck: gone/r.json: cannot be written: "), std::string::npos) << r.err;
  refused(quick + "--json gone/r.json", "gone/r.json: cannot be written: No such file");
  if (!fs::exists("/dev/full")) return;
  EXPECT_EQ(
      run("scene run " LIECHECK_FIXTURES "/scenes/damped_spring.yaml --csv /dev/full --json s.json").code, 2);
  EXPECT_EQ(nlohmann::json::parse(read(dir / "s.json"))["verdict"], "complete");
}

TEST_F(Program, NoRecordReplacesAnotherFileOfTheCommand) {
  store("r.urdf", "<robot name='r'/>");
  store("cases.txt", "# no case");
  refused("campaign --robot r.urdf --json ./r.urdf", "would replace the file of --robot");
  refused("campaign --json s.db --store s.db", "would replace the file of --store");
  refused("hard-cases --file cases.txt --json cases.txt", "would replace the file of --file");
  EXPECT_EQ(read(dir / "r.urdf"), "<robot name='r'/>");
  EXPECT_FALSE(fs::exists(dir / "s.db"));
  EXPECT_EQ(run(quick + "--store s.db").code, 0);
  refused("export s.db@1 --out s.db", "would replace the file of STORE");
  EXPECT_EQ(run("export s.db").code, 0);
}

TEST_F(Program, NoOutputReplacesWhatTheCommandReads) {
  const std::string badge = quick + "--subject liecheck --badge ", twice = ": would replace ",
                    scene =
                        "robot: {urdf: plain.urdf, root: free_flyer}\neffects: [gravity]\nduration: 2 ms\n"
                        "integrator: {name: rkmk4, step: 1 ms}\n";
  fs::copy_file(LIECHECK_FIXTURES "/robots/quadruped.urdf", dir / "plain.urdf");
  fs::create_symlink("plain.urdf", dir / "link");
  fs::create_directory(dir / "page");
  store("m.limits", "version = 1\nsubject = liecheck\n"), store("u.yaml", scene);
  store("list.json", R"([{"name": "x", "language": "C", "adapter": "python3 a.py", "get": "", "run": ""}])");
  store("a.py", "import sys\n");
  fs::copy_file(LIECHECK_C_ADAPTER, dir / "r.so");
  ASSERT_EQ(run(quick + "--subject liecheck --store s.db --json page/report.json").code, 0);
  ASSERT_EQ(run("scene run u.yaml --checkpoint d.ck").code, 0) << read(dir / "err");
  std::map<std::string, std::string> before;
  for (const auto& file : fs::directory_iterator(dir))
    if (const fs::path name = file.path().filename();
        file.is_regular_file() && name != "out" && name != "err")
      before[name] = read(file.path());
  for (const auto& [arguments, of] : std::vector<std::pair<std::string, std::string>>{
           {"compare s.db s.db --markdown s.db", "A"},
           {"compare s.db s.db@1 --picture s.db", "A"},
           {badge + "m.limits --limits m.limits", "--limits"},
           {badge + "s.db --store s.db", "--store"},
           {badge + "link --robot plain.urdf", "--robot"},
           {badge + "plain.urdf --robot link", "--robot"},
           {badge + "z --json z", "--json"},
           {badge + "a.py --adapter 'python3 a.py'", "--adapter"},
           {"test ./r.so --cases 3 --property exp_oracle --no-hard-cases --badge r.so", "ADAPTER"},
           {"cost --adapter ./r.so --op exp3_quaternion --for 1s --json r.so", "--adapter"},
           {"scene run u.yaml --resume d.ck --csv d.ck", "--resume"},
           {"scene run u.yaml --csv plain.urdf", "a file that the scene names"},
           {"scene run u.yaml --checkpoint u.yaml", "FILE"},
           {"scene run u.yaml --checkpoint plain.urdf", "a file that the scene names"},
           {"scene sweep u.yaml --no-peers --json plain.urdf", "a file that a scene names"},
           {"adapter tellings --robot plain.urdf --out . --cases 1", "--robot"},
           {"report page/report.json --out page", "RECORD"},
           {"lab league --adapters list.json --out list.json", "--adapters"},
           {"lab league --adapters list.json --out a.py", "a file that the list of adapters names"},
           {"lab league --adapters list.json --record a.py", "a file that the list of adapters names"}})
    refused(arguments, twice + (of.starts_with("a ") ? of : "the file of " + of) + ": give it another name");
  for (const auto& [name, text] : before) EXPECT_EQ(read(dir / name), text) << name;
  EXPECT_FALSE(fs::exists(dir / "z"));
  EXPECT_EQ(run("scene run u.yaml --resume d.ck --checkpoint d.ck").code, 0) << read(dir / "err");
}

TEST_F(Program, AReportShowsWhatOtherCommandsMeasured) {
  for (const std::string& command :
       {quick + "--subject liecheck --json campaign.json",
        std::string("environments --only up --cases 1 --no-hard-cases --json environments.json"),
        std::string("lab horizons --steps 64 --paths 1 --json horizons.json"),
        std::string("lab rounding --inputs 1 --samples 2 --operation exp3_matrix --json rounding.json"),
        std::string("lab rounding --inputs 1 --samples 2 --subject textbook --operation exp3_matrix "
                    "--where 'theta 1e-5..1e-3' --json where.json"),
        std::string(
            "report campaign.json environments.json horizons.json rounding.json where.json --out page")})
    EXPECT_EQ(run(command).code, 0) << command << "\n" << read(dir / "err");
  const std::string page = read(dir / "page/report.html");
  for (const char* text :
       {"accuracy report: pass", "<td>up</td>", "<td>back_repeated</td>", "random rounding deceives"})
    EXPECT_NE(page.find(text), page.npos) << text;
}

TEST_F(Program, EnvironmentsRefuseASourceThatIsNotThere) {
  store("eigen.c", ""), store("textbook.c", "");
  const std::pair<const char*, const char*> all[] = {
      {"--source nowhere.c", "--source: nowhere.c: is no file"},
      {"--source eigen.c", "a subject is named 'eigen' already"},
      {"--source textbook.c", "a subject is named 'textbook' already"},
      {"--link -lm", "--compile and --link need --source"}};
  for (const auto& [flags, words] : all) refused(std::string("environments ") + flags, words);
  store("a.py", "");
  refused("environments --source a.py", "is no source in C or C++");
  store("broken.c", "int f(void) { return unknown; }\n");
  const Run r = run("environments --source broken.c --only gcc-O0 --dir builds");
  EXPECT_EQ(r.code, 3) << r.err;
  EXPECT_NE(r.out.find("not measured: broken in this program: "), r.out.npos) << r.out;
}

TEST_F(Program, EnvironmentsSurviveAnAdapterThatCrashesAndSayWhatFailsAnyway) {
  const auto adapter = [&](const std::string& name, const std::string& body) {
    store(name,
          "#include <liecheck_adapter.h>\n#include <math.h>\n#include <stdlib.h>\n"
          "static void f(size_t n, const void* x, void* y, unsigned char* s) {\n"
          "  double* q = y; (void)x, (void)s;\n  for (; n > 0; --n, q += 4) {" +
              body +
              "}\n}\n"
              "static liecheck_function find(const char* o, const char* t) {\n"
              "  const char* a = \"exp3_quaternion\"; while (*a && *a == *o) ++a, ++o;\n"
              "  return *a == *o && t[0] == 'd' ? f : 0;\n}\n"
              "static const struct liecheck_adapter all = {LIECHECK_ADAPTER_VERSION, \"mine\", \"1\", 1, "
              "find};\n"
              "const struct liecheck_adapter* liecheck_get_adapter(void) { return &all; }\n");
    return run("environments --source " + name +
               " --link -lm --only up --only gcc-O0 --cases 2 --no-hard-cases --dir builds --json r.json");
  };
  const Run crash = adapter("crash.c", "abort();");
  EXPECT_EQ(crash.code, 3) << crash.out << crash.err;
  EXPECT_NE(crash.out.find("not measured: crash in up: it crashes or hangs"), crash.out.npos) << crash.out;
  const Run leaves = adapter("leaves.c", "exit(0);");
  EXPECT_EQ(leaves.code, 3) << leaves.out << leaves.err;
  const Run nan = adapter("gives_nan.c", "q[0] = q[1] = q[2] = q[3] = NAN;");
  EXPECT_EQ(nan.code, 3) << nan.out << nan.err;
  EXPECT_NE(nan.out.find("checks fail or have no verdict in its own build"), nan.out.npos) << nan.out;
}

TEST_F(Program, AHangUpSignalStillWritesTheRecord) {
  const Run r =
      shell("timeout -s HUP 2 $L campaign --no-hard-cases --property exp_oracle --for 50 -j 1 --json r.json");
  EXPECT_EQ(nlohmann::json::parse(read(dir / "r.json"))["verdict"], "incomplete") << r.err;
}

// `timeout` signals the program and then its process group, so that the program receives two signals.
TEST_F(Program, TwoSignalsAtOnceCountAsOne) {
  const Run r = shell(
      "${L#timeout 60 } campaign --no-hard-cases --property exp_oracle --for 50 -j 1 --json r.json & "
      "sleep 2; kill -TERM $!; kill -HUP $!; wait $!");
  EXPECT_EQ(r.code, 3) << r.err;
  EXPECT_EQ(nlohmann::json::parse(read(dir / "r.json"))["verdict"], "incomplete") << r.err;
}

// The program is blocked here: it writes its record to a pipe that is not read.
TEST_F(Program, ALaterSecondSignalStopsTheProgramAtOnce) {
  const Run r = shell(
      "mkfifo unread; sleep 9 <unread & "
      "${L#timeout 60 } campaign --no-hard-cases --cases 20 -j 1 --json /dev/stdout >unread & "
      "sleep 3; kill -TERM $!; sleep 0.5; kill -TERM $!; wait $!; test $? = 143");
  EXPECT_EQ(r.code, 0) << r.err;
}

TEST_F(Program, ThreadsThatCannotBeStartedAreAnErrorOfOneLine) {
  const Run r = shell("ulimit -v 400000; $L campaign --property exp_oracle --cases 2 -j 1024");
  if (r.code == 0) GTEST_SKIP() << "the memory limit has no effect here";
  EXPECT_EQ(r.code, 2) << r.err;
  EXPECT_NE(r.err.find("--jobs 1024: only "), std::string::npos) << r.err;
}

}  // namespace
