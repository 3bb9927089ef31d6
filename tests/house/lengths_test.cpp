// In lib, properties and adapters a file has at most 400 lines and a function at most 80, unless a comment gives the
// reason. No file cites a document that is not in the repository, and no type has two definitions.

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "source_files.hpp"

namespace liecheck::house {
namespace {

constexpr int longest_file = 400, longest_function = 80;

/// The end of the string, character or raw string literal that starts at `from`.
std::size_t end_of_literal(const std::string& text, std::size_t from) {
  if (text[from] == 'R') {
    const std::string close = ")" + text.substr(from + 2, text.find('(', from) - from - 2) + "\"";
    return text.find(close, from) + close.size();
  }
  std::size_t i = from + 1;
  while (i < text.size() && text[i] != text[from]) i += text[i] == '\\' ? 2 : 1;
  return i + 1;
}

/// The text without comments, literals and preprocessor lines; line breaks stay.
std::string code_of(const std::string& text) {
  std::string code;
  const auto skip = [&](std::size_t from, std::size_t end) {
    end = std::min(end, text.size());
    code.append(static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(from),
                                                    text.begin() + static_cast<std::ptrdiff_t>(end), '\n')),
                '\n');
    return end;
  };
  bool line_start = true;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (line_start && c == '#') {
      std::size_t end = text.find('\n', i);
      while (end != text.npos && text[end - 1] == '\\') end = text.find('\n', end + 1);
      i = skip(i, end);
    } else if (text.compare(i, 2, "//") == 0) {
      i = skip(i, text.find('\n', i));
    } else if (text.compare(i, 2, "/*") == 0) {
      i = skip(i, text.find("*/", i) + 2);
    } else if (c == '"' || text.compare(i, 2, "R\"") == 0 ||
               (c == '\'' && !(i > 0 && std::isalnum(static_cast<unsigned char>(text[i - 1]))))) {
      code += "''";
      i = skip(i, end_of_literal(text, i));
    } else {
      code += c;
      ++i;
    }
    line_start = c == '\n' || (line_start && (c == ' ' || c == '\t'));
  }
  return code;
}

struct Function {
  std::string name;
  int first, last;  ///< lines, from 1
};

/// A file's functions that are not inside another function, and lambdas that are constants of a namespace.
std::vector<Function> functions_of(const std::string& text) {
  enum class Block { scope, function, initializer };
  static const std::regex scope(
      R"(\b(namespace|class|struct|union|enum)\b[^()]*(<.*>)?[^()]*$|extern\s*''\s*$)");
  static const std::regex member_initializer(R"(\)\s*(noexcept\s*)?:[^:].*[\w>]\s*$)");
  const std::string code = code_of(text);
  std::vector<std::size_t> breaks;
  for (auto at = code.find('\n'); at != code.npos; at = code.find('\n', at + 1)) breaks.push_back(at);
  const auto line_of = [&](std::size_t at) {
    return static_cast<int>(std::lower_bound(breaks.begin(), breaks.end(), at) - breaks.begin()) + 1;
  };
  std::vector<Function> all;
  std::vector<Block> open;
  std::size_t header = 0;  // where the declaration of the next block starts
  const auto outside = [&] { return open.empty() || open.back() == Block::scope; };
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (code[i] == '{') {
      if (!outside()) {
        open.push_back(open.back());
        continue;
      }
      std::string head = code.substr(header, i - header);
      std::replace(head.begin(), head.end(), '\n', ' ');
      const bool has_parameters = head.find(')') != head.npos;
      if (std::regex_search(head, scope)) {
        open.push_back(Block::scope);
        header = i + 1;
      } else if (!has_parameters || std::regex_search(head, member_initializer)) {
        open.push_back(Block::initializer);
      } else {
        const auto first = header + std::min(code.find_first_not_of(" \n", header), i) - header;
        const auto name_end = head.find('(');
        const auto name = head.find_last_of(" &*", name_end > 0 ? name_end - 1 : 0);
        all.push_back({head.substr(name + 1, name_end - name - 1), line_of(first), 0});
        open.push_back(Block::function);
      }
    } else if (code[i] == '}') {
      if (open.empty()) return {{"braces that do not match", line_of(i), 1 << 20}};
      const Block closed = open.back();
      open.pop_back();
      if (closed == Block::function && outside()) all.back().last = line_of(i);
      if (closed != Block::initializer) header = i + 1;
    } else if (code[i] == ';' && outside()) {
      header = i + 1;
    }
  }
  if (!open.empty()) return {{"braces that do not match", 1, 1 << 20}};
  return all;
}

/// Does line `number` (from 1), or one of the five lines before it, say why `limit` is exceeded?
bool says_why(const std::vector<std::string>& file, int number, int limit) {
  const std::string reason = "// Longer than " + std::to_string(limit) + " lines: ";
  for (int i = number - 1; i >= std::max(0, number - 6); --i)
    if (file[static_cast<std::size_t>(i)].find(reason) != std::string::npos) return true;
  return false;
}

/// The file and its functions that are too long and give no reason.
std::vector<std::string> too_long(const std::string& path, const std::string& text) {
  std::vector<std::string> file, bad;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) file.push_back(line);
  const int size = static_cast<int>(file.size());
  if (size > longest_file && !says_why(file, std::min(size, 6), longest_file))
    bad.push_back(path + " has " + std::to_string(size) + " lines");
  for (const Function& f : functions_of(text))
    if (const int length = f.last - f.first + 1; length > longest_function)
      if (!says_why(file, std::min(f.first, size), longest_function))
        bad.push_back(path + ":" + std::to_string(f.first) + ": " + f.name + " has " +
                      std::to_string(length) + " lines");
  return bad;
}

TEST(Lengths, AreWithinTheLimitsOrExplained) {
  int functions = 0;
  for (const auto& [path, text] : sources({"lib", "scenes", "properties", "adapters", "lab"})) {
    functions += static_cast<int>(functions_of(text).size());
    for (const std::string& b : too_long(path, text)) ADD_FAILURE() << b;
  }
  EXPECT_GT(functions, 1500);
}

TEST(Lengths, ThatAreTooLongAreFound) {
  const auto times = [](int n, const std::string& line) {
    std::string all;
    for (int i = 0; i < n; ++i) all += line;
    return all;
  };
  const auto found = [](const std::string& text) { return too_long("a.cpp", text).size(); };
  EXPECT_EQ(found(times(400, "int x;\n")), 0u);
  EXPECT_EQ(found(times(401, "int x;\n")), 1u);
  EXPECT_EQ(found("// Longer than 400 lines: a table.\n" + times(401, "int x;\n")), 0u);
  const std::string body = " {\n" + times(79, "  g(\"}{\");  // }\n") + "}\n";  // 81 lines
  EXPECT_EQ(found("void f()" + body), 1u);
  EXPECT_EQ(found("/// f.\n// Longer than 80 lines: a switch.\nvoid f()" + body), 0u);
  EXPECT_EQ(found("void f() {\n" + times(78, "  g();\n") + "}\n"), 0u);
  EXPECT_EQ(found("struct A : B<C> {\n  explicit A(int x) : x_{x}, y_(x)" + body + "};\n"), 1u);
  EXPECT_EQ(found("namespace a {\ntemplate <class T>\nauto f(T x) -> std::vector<T>" + body + "}\n"), 1u);
  EXPECT_EQ(found("const auto f = [](int x)" + body), 1u);
  EXPECT_EQ(found("const std::vector<A> table = {\n" + times(100, "  {f(1), {2}},\n") + "};\n"), 0u);
  EXPECT_EQ(found("enum class E {\n" + times(100, "  a,\n") + "};\n"), 0u);
  EXPECT_EQ(found("#define A {\\\n{\nconst char* s = R\"x({)\" {)x\"; char c = '{'; int i = 1'000;\n"), 0u);
  EXPECT_EQ(found("void f() {\n"), 1u);
}

TEST(Functions, AreFoundWithTheirNames) {
  const auto all = functions_of(
      "namespace a {\nint f(int x) {\n  if (x) { return 1; }\n  return 0;\n}\nstruct B {\n  B() : x{1} {}\n"
      "  int g() const { return x; }\n  int x{2};\n};\n}\n");
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].name, "f");
  EXPECT_EQ(all[0].first, 2);
  EXPECT_EQ(all[0].last, 5);
  EXPECT_EQ(all[1].name, "B");
  EXPECT_EQ(all[2].name, "g");
}

/// Names of documents that are not in the repository, in two parts so that this file does not contain them.
const std::string design = std::string("DES") + "IGN", rows = std::string("RO") + "WS";

/// Lines of a text that cite such a document.
std::vector<std::string> foreign_citations(const std::string& path, const std::string& text) {
  static const std::regex citation("\\b" + design + "\\b|\\b" + rows + "(\\.md| [A-Z]?[0-9])|\\.\\./shared/");
  std::vector<std::string> bad;
  if (text.find(design) == text.npos && text.find(rows) == text.npos && text.find("/shared/") == text.npos)
    return bad;
  std::istringstream stream(text);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (std::regex_search(line, citation)) bad.push_back(path + ":" + std::to_string(number) + ": " + line);
  }
  return bad;
}

TEST(Citations, AreOnlyOfDocumentsInTheRepository) {
  for (const char* folder : {"lib", "properties", "lab", "reports", "tests", "fixtures", "adapters", "docs"})
    if (fs::exists(top() / folder))
      for (const auto& entry : fs::recursive_directory_iterator(top() / folder))
        if (entry.is_regular_file())
          for (const std::string& c :
               foreign_citations(fs::relative(entry.path(), top()).string(), read(entry.path())))
            ADD_FAILURE() << c;
  for (const auto& c : foreign_citations("README.md", read(top() / "README.md"))) ADD_FAILURE() << c;
}

TEST(Citations, OfOtherDocumentsAreFound) {
  const auto found = [](const std::string& text) { return foreign_citations("a.cpp", text).size(); };
  EXPECT_EQ(found("// see " + design + " 3\n"), 1u);
  EXPECT_EQ(found("return \"" + rows + " S17\";\n"), 1u);
  EXPECT_EQ(found("see ..") + found("/shared/x.md\n"), 0u);
  EXPECT_EQ(found(std::string("see ..") + "/shared/x.md\n"), 1u);
  EXPECT_EQ(found("template <int " + rows + ">  // the design of rows\n"), 0u);
}

/// The types that files define in named namespaces, with the files, where these are several: programs that link two of them have
/// one type with two meanings.
std::map<std::string, std::set<std::string>> types_of_several(const Files& files) {
  static const std::regex space(R"(^namespace ?([\w:]*) ?\{$)"),
      type(R"(^(?:struct|class) (\w+)(?: final)?(?: :.*)? \{)");
  std::map<std::string, std::set<std::string>> all;
  for (const auto& [path, text] : files) {
    std::vector<std::string> spaces;
    std::istringstream lines(text);
    std::smatch found;
    for (std::string line, before; std::getline(lines, line); before = line) {
      if (std::regex_match(line, found, space)) spaces.push_back(found[1]);
      if (line.starts_with("}  // namespace") && !spaces.empty()) spaces.pop_back();
      if (!std::regex_search(line, found, type) || std::ranges::count(spaces, "") ||
          before.starts_with("template"))
        continue;
      std::string name;
      for (const std::string& one : spaces) name += one + "::";
      all[name + found[1].str()].insert(path);
    }
  }
  std::erase_if(all, [](const auto& one) { return one.second.size() < 2; });
  return all;
}

TEST(Types, AreDefinedOnce) {
  for (const auto& [name, files] :
       types_of_several(sources({"lib", "scenes", "properties", "reports", "lab"})))
    ADD_FAILURE() << name << " is defined in " << *files.begin() << " and in " << *files.rbegin();
}

TEST(Types, ThatAreDefinedTwiceAreFound) {
  const std::string hidden = "namespace a {\nnamespace {\nstruct B {};\n}  // namespace\n}  // namespace a\n";
  const Files files{
      {"b.hpp", "namespace a {\nstruct B {\n};\nclass C : D {\n};\n}  // namespace a\n"},
      {"c.cpp", hidden},
      {"d.hpp",
       "namespace a {\nstruct B final : E {\n};\ntemplate <class T>\nclass C {\n};\n}  // namespace a\n"}};
  EXPECT_EQ(types_of_several(files),
            (std::map<std::string, std::set<std::string>>{{"a::B", {"b.hpp", "d.hpp"}}}));
}

}  // namespace
}  // namespace liecheck::house
