#include "entrances.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>
#include <adapters/child.hpp>
#include <app/command_line.hpp>
#include <app/programs.hpp>
#include <budgets/limits.hpp>
#include <campaign/case_id.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <hard_cases/corpus.hpp>
#include <iostream>
#include <iterator>
#include <liecheck/scene_file/csv_table.hpp>
#include <liecheck/scene_file/scene_file.hpp>
#include <map>
#include <reports/record.hpp>
#include <rules/rules.hpp>
#include <sstream>
#include <store/store_path.hpp>

#include "mutator.hpp"
#include "urdf_input.hpp"

namespace liecheck::test {
namespace {

namespace fs = std::filesystem;
using namespace properties;

std::string read(const fs::path& p) {
  std::ifstream file(p, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
void write(const fs::path& p, const std::string& text) {
  std::ofstream(p, std::ios::binary) << text;
}

/// The texts of the files below a folder whose names end so, the shortest first, at most 60 of them.
std::vector<std::string> texts(const fs::path& folder, const std::string& ending,
                               std::size_t longest = 40000) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().string().ends_with(ending) && entry.file_size() <= longest)
      files.push_back(entry.path());
  std::sort(files.begin(), files.end(),
            [](auto& a, auto& b) { return std::pair(fs::file_size(a), a) < std::pair(fs::file_size(b), b); });
  if (files.size() > 60) files.resize(60);
  std::vector<std::string> all;
  for (const auto& f : files) all.push_back(read(f));
  return all;
}

/// The lines of the texts, but the longest ones: a reader of lines is faster with one at a time.
std::vector<std::string> lines(const std::vector<std::string>& texts, std::size_t longest) {
  std::vector<std::string> all;
  for (const std::string& text : texts) {
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
      if (line.size() < longest) all.push_back(line + "\n");
  }
  return all;
}

/// Runs the program. Throws std::runtime_error with its output if it fails.
void program(const std::string& arguments, const fs::path& folder) {
  const std::string log = (folder / "log").string();
  if (std::system(
          fmt::format("cd '{}' && '{}' {} >'{}' 2>&1", folder.string(), LIECHECK_PROGRAM, arguments, log)
              .c_str()) != 0)
    throw std::runtime_error(fmt::format("liecheck {}: {}", arguments, read(log)));
}

constexpr const char* small_campaign =
    "campaign --no-hard-cases --property twist --cases 3 -j 1 --store s.db --json r.json";

/// The commands of the documents, an argument a line.
std::vector<std::string> documented_commands(const fs::path& docs) {
  std::vector<std::string> all;
  for (const std::string& page : texts(docs, ".md", 400000)) {
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
      const auto at = line.find("liecheck ");
      if (at == line.npos || at > 22 || line.find('`') < at || line.starts_with('|')) continue;
      std::istringstream words(line.substr(at + 9, line.find("  #", at) - at - 9));
      std::string text;
      for (std::string word; words >> word;) text += word + "\n";
      all.push_back(text);
    }
  }
  return all;
}

/// A reader that accepts what it does not refuse.
template <class F>
std::function<bool(const std::string&)> accepts(F read) {
  return [read](const std::string& text) { return read(text), true; };
}

using Maker = std::function<Entrance(const fs::path& fixtures, const fs::path& scratch)>;

const std::map<std::string, Maker>& makers() {
  static const std::map<std::string, Maker> all{
      {"urdf",
       [](const fs::path& fixtures, const fs::path&) {
         return Entrance{texts(fixtures, ".urdf"), urdf_words, [](const std::string& text) {
                           try {
                             return try_urdf(text);
                           } catch (const std::logic_error& e) {
                             throw Broken{e.what()};
                           }
                         }};
       }},
      {"scene",
       [](const fs::path& fixtures, const fs::path&) {
         const std::string folder = (fixtures / "scenes").string();
         return Entrance{
             texts(folder, ".yaml"),
             words_in("bodies:@effects:@type: @- @  @kg@m/s@{}@[]@[1, 2, 3]@&a @*a@!!int @? @|@>@integrator: "
                      "dopri5@step: 1e-3@duration: 1@~@<<: *a@robot: ../robots/quadruped.urdf"),
             [folder](const std::string& text) {
               try {
                 loadSceneText(text, "fuzz", folder);
                 return true;
               } catch (const SceneError& e) {
                 if (std::string(e.what()).find('\n') != std::string::npos) throw Broken{e.what()};
                 throw;
               }
             }};
       }},
      {"table",
       [](const fs::path& fixtures, const fs::path& scratch) {
         auto corpus = texts(fixtures, ".csv");
         corpus.push_back("t [s],a [m],b [rad]\n0,1,2\n1,2,3\n2,3,4\n");
         return Entrance{corpus,
                         {",", "\n", "[m]", "[mm]", "t [s]", ";"},
                         accepts([file = (scratch / "t.csv").string()](const std::string& text) {
                           write(file, text);
                           scene_file_detail::readCsvTable(file, {}, "m");
                         })};
       }},
      {"hard_cases",
       [](const fs::path& fixtures, const fs::path&) {
         return Entrance{lines(texts(fixtures / "hard_cases", ".txt", 200000), 3000),
                         {" | ", "pi", "eps", "sqrt(", "min", "max", "+ ulp", "exp_oracle", "in double",
                          "in float", "0x1p-1074"},
                         [](const std::string& text) {
                           for (const HardCase& c : parse_corpus("fuzz", text)) {
                             for (const char* scalar : {"float", "double"}) try {
                                 evaluate(c.input, oracles::scalar_named(scalar));
                               } catch (const std::invalid_argument&) {
                               }
                           }
                           return true;
                         }};
       }},
      {"expression",
       [](const fs::path&, const fs::path&) {
         return Entrance{{"pi - 3 eps, 0, 1/3", "sqrt(eps), -2^-30, 1e-8", "next(pi, 2), 0x1.8p-3",
                          "max, min, sqrt(2) / 2", "(1 + 2) * -3, sin(1), cos(pi / 4)"},
                         {"pi", "eps", "sqrt(", "next(", "max", "min", "(", ")", "^", "*", "/", "+", "-", ",",
                          "ulp", "sin(", "cos(", "tan(", "2^2^2^9"},
                         [](const std::string& text) {
                           for (const char* scalar : {"float", "double"})
                             for (const std::string& n : evaluate(text, oracles::scalar_named(scalar)))
                               if (n.empty()) throw Broken{"an empty number"};
                           return true;
                         }};
       }},
      {"case_id",
       [](const fs::path&, const fs::path&) {
         return Entrance{
             {"raw.exp_oracle.textbook.double.none.1,0,0,0,0,1e-5", "42.exp_oracle.liecheck.float.none.17",
              "raw.log_oracle.bug:x.float.mixed_joints.0x1p-3,nan", "v4.7.compose.eigen.double.none.3"},
             {".", ",", "raw", "none", "double", "float", "0x1.8p-3", "/", ":"},
             [](const std::string& text) {
               const CaseId id = CaseId::parse(text);
               for (const std::string& number : id.input) parse_float(number, oracles::scalar_of<double>);
               if (CaseId::parse(id.text()).text() != id.text())
                 throw Broken{"its own text reads differently: " + id.text()};
               return true;
             }};
       }},
      {"rules",
       [](const fs::path& fixtures, const fs::path&) {
         return Entrance{texts(fixtures / "rules", ".txt", 100000),
                         {"law ", "hard case ", "limits ", " "},
                         accepts([](const std::string& text) { parse_rules("fuzz", text); })};
       }},
      {"limits",
       [](const fs::path& fixtures, const fs::path&) {
         auto corpus = texts(fixtures, ".limits");
         for (const std::string& one : texts(fixtures.parent_path() / "adapters", ".limits"))
           corpus.push_back(one);
         corpus.push_back(
             "subject mylib\nprofile careful\nlimit exp6 translation to_pi forward 20 its document says "
             "so\n");
         return Entrance{corpus,
                         {"subject ", "limit ", "domain ", "expect ", "profile careful", "forward", "excess",
                          "to_pi", "beyond_pi", "theta < 1", "*"},
                         accepts([](const std::string& text) { parse_limits("fuzz", text); })};
       }},
      {"record",
       [](const fs::path&, const fs::path& scratch) {
         program(small_campaign, scratch);
         return Entrance{{read(scratch / "r.json")},
                         {"{", "}", "[", "]", "null", "true", "\"inf\"", "\"nan\"", ":", "\\u0000", "1e400"},
                         accepts([file = scratch / "fuzz.json"](const std::string& text) {
                           write(file, text);
                           reports::merge_records({file});
                         })};
       }},
      {"store",
       [](const fs::path&, const fs::path& scratch) {
         program(small_campaign, scratch);
         return Entrance{{read(scratch / "s.db")},
                         {},
                         accepts([file = (scratch / "fuzz.db").string()](const std::string& text) {
                           write(file, text);
                           load_campaign(file);
                         })};
       }},
      {"flags",
       [](const fs::path& fixtures, const fs::path&) {
         std::cout.rdbuf(nullptr);  // the help
         auto line = std::make_shared<CommandLine>(liecheck_program, "liecheck");
         return Entrance{documented_commands(fixtures.parent_path() / "docs"),
                         {"--json\n", "--help\n", "-j\n", "--", "-", "=", "--seed=", "--cases\n", "--for\n",
                          "1h\n", "\n", "@", "--subject\n", "all\n"},
                         [line](const std::string& text) {
                           std::vector<std::string> words{"liecheck"};
                           std::istringstream in(text);
                           for (std::string word; std::getline(in, word);)
                             words.push_back(word.c_str());  // to the first \0
                           std::vector<const char*> argv;
                           for (const std::string& w : words) argv.push_back(w.c_str());
                           line->read(static_cast<int>(argv.size()), argv.data());
                           return true;
                         }};
       }},
      {"wire", [](const fs::path&, const fs::path&) {
         const std::string hello =
             "{\"protocol\": 1, \"name\": \"mylib\", \"version\": \"2.1\", \"operations\": "
             "{\"exp3_quaternion\": [\"double\"]}}\n";
         const std::string bytes(1 + 4 * 8, '\0');
         return Entrance{
             {hello + "done 1\n" + bytes, hello + "done 1 because\n" + bytes, hello + "refused\n",
              hello + "done\ndone 1\n" + bytes, hello + "refused too many joints\n"},
             {"done 1\n", "done 2\n", "done\n", "refused\n", "\n", "\"protocol\": 2", "\"float\"", "{}", "[]",
              "\"conventions\": {}", "\"source\": {}", "\"trees\": {\"models\": [\"urdf\"]}"},
             [](const std::string& text) {
               // The adapter says the text and ends, whatever it is asked.
               const auto adapter = adapters::start_with(
                   [&](double timeout_s) {
                     const int from = ::memfd_create("answers", MFD_CLOEXEC);
                     if (::pwrite(from, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
                       throw std::runtime_error("no memory for a file");
                     return std::make_unique<adapters::Child>(::open("/dev/null", O_WRONLY | O_CLOEXEC), from,
                                                              timeout_s);
                   },
                   0.5);
               const auto& sizes = adapters::operation_sizes();
               const auto at = std::find_if(sizes.begin(), sizes.end(),
                                            [](auto& s) { return s.operation == "exp3_quaternion"; });
               const std::array<double, 3> in{};
               std::array<double, 4> out{};
               std::array<adapters::Status, 1> status{};
               adapter->call({*at, true, 1, std::as_bytes(std::span(in)),
                              std::as_writable_bytes(std::span(out)), status,
                              text.size() % 2 ? "a model" : ""});
               return true;
             }};
       }}};
  return all;
}

}  // namespace

std::vector<std::string> entrance_names() {
  std::vector<std::string> names;
  for (const auto& [name, make] : makers()) names.push_back(name);
  return names;
}

Entrance entrance(const std::string& name, const std::string& folder, const std::string& scratch) {
  if (!makers().count(name))
    throw std::invalid_argument(
        fmt::format("no entrance '{}'; known: all, {}", name, fmt::join(entrance_names(), ", ")));
  const fs::path own = fs::path(scratch) / name;
  fs::create_directories(own);
  Entrance e = makers().at(name)(fs::absolute(folder), own);
  e.name = name;
  return e;
}

}  // namespace liecheck::test
