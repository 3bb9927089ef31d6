#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <league/found.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <support/json.hpp>
#include <support/markdown.hpp>
#include <support/read_json.hpp>
#include <support/text.hpp>

namespace liecheck::properties::league {

namespace {

using nlohmann::json;

std::string text(const json& of, const char* name) {
  return of.value(name, "");
}
/// As prose, as a sentence, and as code within prose.
std::string prose(const json& of, const char* name) {
  return markdown(text(of, name));
}
std::string sentence(const json& of, const char* name) {
  std::string words = text(of, name);
  if (!words.empty()) words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
  return markdown(words);
}
std::string code(const std::string& words) {
  return "<code>" + markdown(words) + "</code>";
}

/// "three.js 0.187.0"
std::string title(const json& library) {
  return markdown(text(library, "name") + " " + text(library, "version"));
}

/// The anchor of a heading: in lower case, without punctuation, with hyphens for spaces.
std::string anchor(const std::string& heading) {
  std::string all;
  for (const char c : heading)
    if (c == ' ')
      all += '-';
    else if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_')
      all += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return all;
}

/// "7.0 of 15.7", "NaN or Inf"
std::string short_loss(const json& defect) {
  const std::string lost = text(defect, "lost");
  return markdown(lost.substr(0, lost.find(" digits lost")));
}

/// "a, b, c" of a list of texts.
std::string listed(const json& texts) {
  std::string all;
  for (const json& t : texts) all += (all.empty() ? "" : ", ") + t.get<std::string>();
  return all;
}

/// A block of code in a language, whose name Markdown takes after the fence.
std::string block(const std::string& language, const std::string& code) {
  static const std::map<std::string, std::string> names = {
      {"C++", "cpp"}, {"JavaScript", "js"}, {"Python", "python"}, {"Octave", "matlab"}, {"Perl", "perl"}};
  const auto at = names.find(language);
  std::string all = markdown_block(code);
  all.insert(all.find('\n'), at == names.end() ? language : at->second);
  return all;
}

/// What installs the library in its version.
std::string installation(const json& library) {
  const std::string get = text(library, "get");
  return get.starts_with("npm") ? get + "@" + text(library, "version") : get;
}

std::string section(const json& library) {
  std::string all = fmt::format("\n## {}\n\n{} installs it, and {} runs a program.{}\n", title(library),
                                code(installation(library)), code(text(library, "run")),
                                library.contains("note") ? " " + prose(library, "note") : "");
  for (const json& d : library["defects"]) {
    all += fmt::format("\n<details><summary>{}: {}</summary>\n\n{}.{}\n\n{}\n", code(text(d, "function")),
                       prose(d, "lost"), sentence(d, "what"),
                       d.contains("known") ? fmt::format(" Reported by others: {}.", prose(d, "known")) : "",
                       block(text(library, "language"), text(d, "program")));
    all += block("text", fmt::format("got    {}\nright  {}\n", listed(d["got"]), listed(d["right"])));
    all += fmt::format("\n{} in {}: {}.\n\n</details>\n", code(text(d, "call")), prose(d, "scalar"),
                       prose(d, "shows"));
  }
  return all;
}

}  // namespace

std::string found_page(const json& record) {
  std::size_t defects = 0, known = 0;
  std::string table, sections;
  for (const json& library : record["libraries"]) {
    bool first = true;
    for (const json& d : library["defects"]) {
      table += fmt::format("| {} | {} | {} | {} |\n",
                           first ? fmt::format("[{}](#{})", title(library), anchor(title(library))) : "",
                           code(text(d, "function")), prose(d, "what"), short_loss(d));
      first = false, ++defects, known += d.contains("known");
    }
    sections += section(library);
  }
  return fmt::format(
             R"(# What liecheck found in today's releases

These are {} defects in {} releases that Debian 12 and npm distribute. Each is a cause in a function of a library: for
inputs that its documentation allows, it gives a wrong result, or one with fewer digits than its scalar and the condition
of the problem allow. What a library documents is left out, and so are losses that a maintainer may have chosen, such as
linear interpolation in place of `slerp`, or a threshold of about 1e-6 rad where directions are opposite. From here, none of
them has been reported; others have reported {}, as far as we know, and their details say where.

*Digits lost* is log10 of the error in eps of the scalar, as [measured](measuring.md), for the input of one program, out of
15.7 digits in double and 6.9 in float; other inputs lose more or fewer. The program is below, folded, as a user of the
library would write it, and prints the numbers that stand after *got*. What is *right* is computed with 50 and 100 digits from the
numbers that the function was given. The last line of each has the call in the terms of [operations.md](operations.md).

`build/release/bin/liecheck lab league findings fixtures/league/found.json --out found` measures all of them again, runs each
program where the library is installed, and writes this page. [The laboratory](laboratory.md#the-league-of-libraries) has
the inputs and laws by which they were found, and libraries and functions that have none.

| library | function | what goes wrong | digits lost |
|---|---|---|---|
{})",
             defects, record["libraries"].size(), known, table) +
         sections;
}

bool is_found(const std::string& file) {
  const json record = read_json(file);
  return record.is_object() && record.contains("found");
}

json read_found(const std::string& file) {
  json record = read_json(file);
  const auto refuse = [&](const std::string& why) { throw std::invalid_argument(file + ": " + why); };
  const auto texts = [&](const json& of, const std::string& where, std::initializer_list<const char*> needed,
                         std::initializer_list<const char*> others) {
    if (!of.is_object()) refuse(where + " is no object");
    for (const auto& names : {needed, others})
      for (const char* name : names)
        if (of.contains(name) ? !of[name].is_string() : std::ranges::count(needed, std::string(name)) > 0)
          refuse(fmt::format("{} has no text '{}'", where, name));
  };
  const auto list = [&](const json& of, const std::string& where, const char* name) {
    if (!of.contains(name) || !of[name].is_array()) refuse(fmt::format("{} has no list '{}'", where, name));
  };
  if (!record.is_object() || record.value("found", json()) != 1)
    refuse("is no record of defects of version 1");
  list(record, "the record", "libraries");
  std::set<std::string> adapters;
  for (const json& library : record["libraries"]) {
    texts(library, "a library", {"name", "adapter"}, {"version", "get", "run", "language", "note"});
    const std::string name = printable(library["name"]);
    if (!adapters.insert(library["adapter"]).second)
      refuse(fmt::format("the adapter of {} is there twice", name));
    list(library, name, "defects");
    for (const json& d : library["defects"]) {
      texts(d, "a defect of " + name, {"function", "what", "operation", "scalar", "law", "input"},
            {"block", "call", "lost", "shows", "program", "known"});
      const std::string function = printable(d["function"]);
      if (d["scalar"] != "float" && d["scalar"] != "double")
        refuse(fmt::format("{} has the scalar {}: expected float or double", function, dumped(d["scalar"])));
      if (!d.contains("got")) continue;  // not measured yet
      for (const char* numbers : {"got", "right"}) {
        list(d, function, numbers);
        for (const json& x : d[numbers])
          if (!x.is_string())
            refuse(fmt::format("{} has a number in '{}' that is no text", function, numbers));
      }
    }
  }
  return record;
}

}  // namespace liecheck::properties::league
