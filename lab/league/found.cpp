#include <league/found.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <adapters/adapter.hpp>
#include <adapters/subjects.hpp>
#include <algorithm>
#include <campaign/robots.hpp>
#include <cmath>
#include <cstdlib>
#include <failures/calls.hpp>
#include <failures/program.hpp>
#include <failures/result.hpp>
#include <hard_cases/attempt.hpp>
#include <invariants/property.hpp>
#include <league/programs.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <subjects/number_function.hpp>
#include <subjects/subject.hpp>
#include <support/folder.hpp>
#include <support/json.hpp>
#include <support/own_process.hpp>
#include <support/read_json.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>

namespace liecheck::properties::league {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

const Scalar& scalar_of(const json& defect) {
  return defect["scalar"] == "float" ? oracles::scalar_of<float> : oracles::scalar_of<double>;
}

/// "found.json, three, Quaternion.angleTo"
std::string place(const std::string& file, const json& library, const json& defect) {
  return fmt::format("{}, {}, {}", file, library["adapter"].get<std::string>(),
                     printable(defect["function"]));
}

std::unique_ptr<Series> series_on(const Subject& subject, const std::string& law) {
  for (auto& p : make_properties(*subject.scalar))
    if (p->name() == law)
      return std::make_unique<Series>(std::move(p), subject, built_in_robot(), nullptr, Profile::careful);
  return nullptr;
}

/// The numbers of a result in decimals that read back as the same numbers.
json texts_of(const std::vector<double>& numbers, const Scalar& scalar) {
  json all = json::array();
  for (const double x : numbers)
    all.push_back(std::isfinite(x) ? decimal_float(x, scalar)
                  : std::isnan(x)  ? "nan"
                  : x > 0          ? "inf"
                                   : "-inf");
  return all;
}
std::vector<double> numbers_of_texts(const json& texts) {
  std::vector<double> all;
  for (const json& x : texts) all.push_back(std::strtod(x.get<std::string>().c_str(), nullptr));
  return all;
}

double score_of(const Judged& j) {
  if (j.residual.outcome != Outcome::measured) return std::numeric_limits<double>::infinity();
  return j.budget && j.budget->rule == Rule::excess ? j.excess : j.residual.error;
}

/// The failing measurement of the defect's operation and, if the record has it, block; the worst one.
const Judged* judged_of(const Series& series, const Trial& trial, const json& defect) {
  const Judged* worst = nullptr;
  for (const Judged& j : trial.judged) {
    const properties::Output& o = series.outputs.at(j.residual.output);
    if (o.operation != defect["operation"].get<std::string>() || !j.failed) continue;
    if (defect.contains("block") && o.block != defect["block"].get<std::string>()) continue;
    if (!worst || score_of(j) > score_of(*worst)) worst = &j;
  }
  return worst;
}

/// Fills what a measurement on this subject says of the defect. `where` is for messages.
void judge(json& defect, const Subject& subject, const std::string& where) {
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument(fmt::format("{}: {}", where, why));
  };
  const std::string law = defect["law"], operation = defect["operation"];
  const auto series = series_on(subject, law);
  if (!series) refuse(fmt::format("there is no law '{}'", law));
  if (std::ranges::find(series->outputs, operation, &properties::Output::operation) == series->outputs.end())
    refuse(fmt::format("the law '{}' does not measure {}", law, operation));
  const HardCase input{where, 0, operation, defect["input"], "", "", "", {law}, {}};
  const CaseId id = raw_case(*series, input);
  const Trial trial = attempt(*series, id);
  const Judged* const j = judged_of(*series, trial, defect);
  if (!j) refuse(fmt::format("{} is within its limit for this input", operation));
  const auto at = static_cast<std::size_t>(j->residual.output);
  const properties::Output& output = series->outputs[at];
  const NotedCase all = noted(*series, id, at);
  const auto call = std::ranges::find_if(
      all.calls, [&](const NotedCall& c) { return c.operation->name == operation && c.thrown.empty(); });
  if (call == all.calls.end()) refuse(fmt::format("{} returned nothing", operation));
  std::vector<double> right;
  for (const oracles::Real& x : expected_of(*call)) right.push_back(static_cast<double>(x));
  defect["block"] = output.block;
  defect["call"] = called_with(*series, *call);
  defect["got"] = texts_of(call->result, *subject.scalar);
  for (double& x : right) x = subject.scalar->rounded(x) + 0.0;  // -0 is not another number
  defect["right"] = texts_of(right, *subject.scalar);
  const bool measured = j->residual.outcome == Outcome::measured;
  defect["lost"] = measured ? digits_lost(score_of(*j), series->eps)
                            : outcome_words[static_cast<int>(j->residual.outcome)];
  defect["shows"] = worst_number_text(*series, output, all);
  if (subject.adapter.empty()) return;
  const std::string program = program_of_template(*series, output, all);
  const auto from = program.find("\n\n");  // after a heading
  defect["program"] = from == program.npos ? "" : program.substr(from + 2, program.size() - from - 3);
}

/// A subject whose only operation returns what the record says that a library returned. `where` is for messages.
Subject recorded(const json& defect, const std::string& where) {
  Subject s{"recorded", "1", "", &scalar_of(defect)};
  const auto got = numbers_of_texts(defect["got"]);
  const Scalar& scalar = *s.scalar;
  fill_slots(s.operations, [&](const Operation& o) {
    NumberFunction f{&o, &scalar};
    if (o.name != defect["operation"].get<std::string>()) return f;
    if (const auto size = count_numbers(o.results); got.size() != size)
      throw std::invalid_argument(
          fmt::format("{}: 'got' has {} numbers: expected {}", where, got.size(), size));
    f.compute = [got, &scalar](void*, void* to) {
      scalar.with([&]<class S>() {
        std::ranges::transform(got, static_cast<S*>(to), [](double x) { return static_cast<S>(x); });
      });
    };
    return f;
  });
  return s;
}

/// The members of the two that differ, in words; "" if none does.
std::string differs(const json& before, const json& after) {
  std::string all;
  for (const auto& [name, value] : after.items())
    if (name != "defects" && before.value(name, json()) != value)
      all += fmt::format("    {} is {}, and the record has {}\n", name, dumped(value),
                         dumped(before.value(name, json())));
  return all;
}

/// How a reader runs a program of a library: without the folders of this machine, and with -l for a library of the system.
std::string readers_command(const std::string& run, const std::string& file) {
  const std::string shown = commands(run, file).second;
  if (shown.starts_with("cd ")) return "node " + file;
  std::vector<std::string> words;
  std::istringstream in(shown);
  for (std::string word; in >> word;) {
    const fs::path path = word;
    if (path.extension() == ".so") word = "-l" + path.stem().string().substr(3);
    if (path.parent_path() == "/usr/bin") word = path.filename();
    words.push_back(word);
    const std::size_t n = words.size();
    if (n > 3 && word == words[n - 3] && words[n - 2] == "-isystem") words.resize(n - 2);  // given twice
    if (word == "./a.out" && words[n - 2] == "-o") words.resize(n - 2);  // where it is anyway
  }
  return fmt::format("{}", fmt::join(words, " "));
}

/// Runs the program of each defect of a measured library; says which print other numbers.
std::string run_programs(const json& library, const Entry& entry, const std::string& folder) {
  std::string text;
  for (const json& d : library["defects"]) {
    if (stop_requested) break;
    const std::string name = file_name(fmt::format("{}_{}", library["adapter"].get<std::string>(),
                                                   d["function"].get<std::string>())) +
                             suffix(library["language"]);
    const Output out = run_program(entry.run, file_in(folder, name), d["program"]);
    if (out.code != 0 || !confirms(out.text, numbers_of_texts(d["got"]), d["scalar"] == "float"))
      text += fmt::format("    {}: its program {}\n", d["function"].get<std::string>(),
                          out.code ? "ends with an error" : "prints other numbers: " + printable(out.text));
  }
  return text;
}

}  // namespace

json measured_found(const std::string& file, const std::string& name, const std::string& text) {
  json record = read_found(file);
  for (json& library : record["libraries"]) {
    if (library["adapter"] != name) continue;
    const std::string subject = adapters::register_adapter(text);
    library["version"] = adapters::description_of(text)->version;
    for (json& defect : library["defects"]) {
      const auto all = subjects(scalar_of(defect));
      const auto at = std::ranges::find(all, subject, &Subject::name);
      const std::string where = place(file, library, defect);
      if (at == all.end())
        throw std::invalid_argument(fmt::format("{}: is not offered in {}", where, dumped(defect["scalar"])));
      defect.erase("block");
      judge(defect, **at, where);
    }
    return library;
  }
  throw std::invalid_argument(fmt::format("{}: has no library '{}'", file, name));
}

FoundAgain found_again(const json& record, const Trust& trust, const std::string& folder) {
  make_folder("--out", folder);
  FoundAgain all{record, "", true};
  for (json& library : all.record["libraries"]) {
    if (stop_requested) return all;
    const std::string name = library["adapter"], version = library.value("version", "");
    const auto entry = std::ranges::find(trust.adapters, name, &Entry::name);
    json now = library;
    std::string text, why = "is absent";
    bool here = entry != trust.adapters.end() && !entry->adapter.empty();
    if (here) {
      const auto out = output_of_own_process(
          {"league", "measure", entry->adapter, "--found", trust.file, "--library", name}, stop_requested);
      if (!out) return all;
      now = parsed(*out);
      if (here = version.empty() || now["version"] == version; !here)
        why = fmt::format("has version {} here", now["version"].get<std::string>()), now = library;
    }
    if (here) {
      now["language"] = entry->language, now["get"] = entry->get;
      now["run"] = readers_command(entry->run, "found" + suffix(entry->language));
      text += differs(library, now) + run_programs(now, *entry, folder);
    } else {
      for (json& defect : now["defects"]) {
        const std::string where = place(trust.file, library, defect);
        if (!defect.contains("got"))
          throw std::invalid_argument(where + ": is not measured, and the library " + why);
        judge(defect, recorded(defect, where), where);
      }
    }
    for (std::size_t i = 0; i < now["defects"].size(); ++i)
      if (const std::string how = differs(library["defects"][i], now["defects"][i]); !how.empty())
        text += fmt::format("  {}:\n{}", now["defects"][i]["function"].get<std::string>(), how);
    all.text +=
        fmt::format("{} {}: {} defects, {}{}\n", name, now.value("version", ""), now["defects"].size(),
                    here ? "measured again, each program run" : why + ": judged as recorded",
                    text.empty() ? "" : "; what differs:");
    all.text += text;
    all.same = all.same && text.empty();
    library = now;
  }
  return all;
}

}  // namespace liecheck::properties::league
