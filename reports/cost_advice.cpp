#include <reports/cost_advice.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <reports/drawing.hpp>
#include <reports/html.hpp>

namespace liecheck::reports {

namespace {

/// What liecheck measures to show what a formula can reach: its name where coefficients of the angle decide, where a product
/// of stored poses does, and in other operations.
const std::map<std::string, std::array<const char*, 3>> forms = {
    {"textbook", {"the closed form with a cutoff", "the textbook's form", "the textbook's form"}},
    {"textbook:half_angles",
     {"half angles", "the textbook's form in half angles", "the textbook's form in half angles"}},
    {"liecheck:fast",
     {"a series", "liecheck's form without compensation", "liecheck's form without compensation"}},
    {"liecheck", {"a compensated series", "a compensated product", "liecheck's form"}},
    {"liecheck:tight",
     {"a series in double words", "a product in double words", "liecheck's form in double words"}}};

std::size_t kind_of(const std::string& operation) {
  const auto is_in = [&](const char* part) { return operation.find(part) != std::string::npos; };
  if (operation == "difference") return 1;
  return is_in("exp") || is_in("log") || is_in("jacobian") || is_in("integrate") || is_in("difference") ? 0
                                                                                                        : 2;
}

constexpr const char* within_budget = "within budget";

/// "pi-theta 1e-5..0.1" as "π − θ 1e-5…0.1".
std::string band_words(std::string name) {
  for (const auto& [from, to] : {std::pair("pi-theta", "π − θ"), {"theta", "θ"}, {"..", "…"}, {"pi", "π"}})
    if (const auto at = name.find(from); at != std::string::npos)
      name.replace(at, std::string_view(from).size(), to);
  return name;
}

/// Not slower within the spreads of both.
bool is_as_fast(const RegionPoint& a, const RegionPoint& b) {
  return a.low <= b.high;
}

/// How many of `best` digits are lost, and where.
std::string lost_text(const RegionPoint& p, double best) {
  if (std::isinf(p.error)) return "has inputs without a result, at " + escaped(p.where);
  return fmt::format("loses {:.0f} digits, at {}", best - shown_digits(p), escaped(p.where));
}

/// The fastest row that has all digits of the most accurate one but the last: sampled maxima tell less of less.
const RegionPoint& fastest_accurate(const std::vector<RegionPoint>& points) {
  const double most = shown_digits(*std::ranges::max_element(points, {}, shown_digits));
  return *std::ranges::find_if(points, [&](const RegionPoint& p) { return shown_digits(p) >= most - 1; });
}

/// What calls with many inputs take, where it is less and loses nothing.
std::string many_text(const std::vector<RegionPoint>& many, const RegionPoint& one, const std::string& name) {
  const auto best = std::ranges::find_if(many, [&](const RegionPoint& p) {
    return (name.empty() || p.subject == name) && p.scalar == one.scalar &&
           shown_digits(p) >= shown_digits(one) - 1 && p.high < one.low;
  });
  return best == many.end()
             ? ""
             : fmt::format("; {} at once: {}{} each", best->batch,
                           name.empty() ? escaped(best->subject) + ", " : "", time_text(best->latency));
}

std::string among_libraries(const std::vector<RegionPoint>& points, const std::vector<RegionPoint>& many,
                            const JudgedIn& judged) {
  std::vector<RegionPoint> advised, advised_many;
  const auto may_be_advised = [&](const RegionPoint& p) { return judged.may_be_advised(p.subject); };
  std::ranges::copy_if(points, std::back_inserter(advised), may_be_advised);
  std::ranges::copy_if(many, std::back_inserter(advised_many), may_be_advised);
  if (advised.empty()) return "None that was timed is right.";
  const RegionPoint& take = fastest_accurate(advised);
  const double whole = std::floor(shown_digits(take));
  const std::string text = fmt::format("For {:.0f} digits take <b>{}</b> ({}{})", whole, escaped(take.name()),
                                       time_text(take.latency), many_text(advised_many, take, ""));
  for (const RegionPoint& p : points)
    if (p.subject != take.subject && p.scalar == take.scalar && is_as_fast(p, take) &&
        shown_digits(p) <= whole - 2)
      return text +
             fmt::format("; {} ({}) {}", escaped(p.subject), time_text(p.latency), lost_text(p, whole)) + ".";
  return text + ".";
}

/// What one takes more or less time than another.
std::string price_text(const RegionPoint& from, const RegionPoint& to) {
  if (from.high < to.low) return "for " + time_text(to.latency - from.latency) + " more";
  return to.high < from.low ? "for " + time_text(from.latency - to.latency) + " less" : "in the same time";
}

std::string of_one_library(const RegionPoint& own, const std::vector<RegionPoint>& forms_of_it,
                           const std::vector<RegionPoint>& many, bool is_right) {
  const auto named = [](const RegionPoint& p) {
    return fmt::format("{} ({})", forms.at(p.subject)[kind_of(p.operation)], escaped(p.subject));
  };
  const std::string text = fmt::format("{}: {:.1f} digits, {}{}", escaped(own.scalar), shown_digits(own),
                                       time_text(own.latency), many_text(many, own, own.subject));
  if (forms_of_it.empty()) return text;
  const RegionPoint& more = fastest_accurate(forms_of_it);
  if (const double won = shown_digits(more) - shown_digits(own); won > 1) {
    if (is_right)
      return text + fmt::format(", {}; {} keeps {:.1f} {}", within_budget, named(more), shown_digits(more),
                                price_text(own, more));
    return text + fmt::format("; {} wins <b>{:.1f} digits {}</b>, at {}", named(more), won,
                              price_text(own, more), escaped(own.where));
  }
  const auto faster = std::ranges::find_if(forms_of_it, [&](const RegionPoint& p) {
    return shown_digits(p) >= shown_digits(own) && p.high < own.low;
  });
  if (faster == forms_of_it.end()) return text;
  return text + fmt::format("; {} has no fewer in {} instead of {}", named(*faster),
                            time_text(faster->latency), time_text(own.latency));
}

}  // namespace

JudgedIn::JudgedIn(const Looks& looks, const std::string& operation) {
  for (const Json& row : looks.merged.results)
    if (row["operation"] == operation && row["status"] != "empty")
      (looks.wrong.contains({row["subject"], operation}) ? wrong : right).insert(row["subject"]);
}

bool JudgedIn::may_be_advised(const std::string& subject) const {
  return !wrong.contains(subject) && (right.contains(subject) || !subject.starts_with("textbook"));
}

std::string timed_inputs(const Json& cost) {
  double least = 1;
  bool near_pi = false;
  for (const Json& band : list_in(cost, "bands")) {
    near_pi = near_pi || band["axis"] == "pi_minus_theta";
    if (band["axis"] == "theta") least = std::min(least, band["low"].get<double>());
  }
  const std::string inputs = "on random inputs";
  return least >= 1 || least <= 0
             ? inputs
             : inputs + fmt::format(" with angles from {} rad{}",
                                    power(static_cast<int>(std::lround(std::log10(least)))),
                                    near_pi ? " to near π" : "");
}

std::vector<CostRegion> cost_regions(const Json& cost) {
  std::vector<CostRegion> all = {{"near 0", {}}, {"moderate", {}}, {"near π", {}}};
  for (const Json& band : list_in(cost, "bands")) {
    const std::size_t region = band["axis"] == "pi_minus_theta"    ? 2
                               : band["high"].get<double>() <= 0.1 ? 0
                                                                   : 1;
    all[region].bands.push_back(band["band"]);
  }
  std::erase_if(all, [](const CostRegion& r) { return r.bands.empty(); });
  return all;
}

CostRegion every_angle() {
  return {"every angle", {"mixed"}};
}

std::vector<RegionPoint> region_points(const Json& cost, const std::string& operation,
                                       const CostRegion& region) {
  std::vector<RegionPoint> points;
  for (const Json& row : cost["rows"]) {
    if (row["operation"] != operation || row["error"].is_null() || other_flags(row)) continue;
    for (const char* what : {"latency", "throughput"}) {
      const bool many = what == std::string_view("throughput");
      if (many && !takes_many(row)) continue;
      RegionPoint p;
      p.subject = row["subject"], p.scalar = row["scalar"], p.operation = operation, p.eps = row["eps"];
      double sets = 0, worst = -1;
      for (const Json& set : row["sets"]) {
        const std::string name = set["set"];
        const bool timed = std::ranges::count(region.bands, name) > 0 && !set[what].is_null();
        if (timed) {
          const Json& time = set[what];
          const double unit = time["ns"].get<double>() / time["ratio"].get<double>();
          ++sets, p.latency += time["ns"].get<double>();
          p.low += unit * time["low"].get<double>(), p.high += unit * time["high"].get<double>();
          if (many) p.batch = set["inputs"];
        }
        if (!timed && region.bands.front() != "mixed") continue;
        const double error =
            error_of_set(set, row["eps"]);  // of all inputs, the first band with the worst error is named
        if (error > worst) worst = error, p.where = band_words(name);
      }
      if (sets == 0 || worst < 0) continue;
      p.latency /= sets, p.low /= sets, p.high /= sets;
      p.error = worst;
      points.push_back(p);
    }
  }
  std::ranges::sort(points, {}, &RegionPoint::latency);
  return points;
}

std::string only_library(const Merged& merged) {
  Distinct<std::string> all;
  for (const Json& row : merged.results) all.add(row["subject"]);
  return std::distance(all.begin(), all.end()) == 1 ? *all.begin() : std::string();
}

std::string cost_sentence(const std::vector<RegionPoint>& all, const std::string& own_library,
                          const JudgedIn& judged) {
  std::vector<RegionPoint> points, many;
  std::ranges::partition_copy(all, std::back_inserter(many), std::back_inserter(points),
                              [](const RegionPoint& p) { return p.batch > 1; });
  if (own_library.empty()) return points.empty() ? "" : among_libraries(points, many, judged);
  std::string text;
  for (const char* scalar : {"double", "float"}) {
    const RegionPoint* own = nullptr;
    std::vector<RegionPoint> forms_of_it;
    for (const RegionPoint& p : points) {
      if (p.scalar != scalar) continue;
      if (p.subject == own_library)
        own = &p;
      else if (forms.contains(p.subject) && judged.may_be_advised(p.subject))
        forms_of_it.push_back(p);
    }
    if (own)
      text += (text.empty() ? "" : "<br>") +
              of_one_library(*own, forms_of_it, many, judged.right.contains(own_library)) + ".";
  }
  return text;
}

std::string cost_advice(const Json& cost, const Looks& looks) {
  const std::string own_library = only_library(looks.merged);
  const auto regions = cost_regions(cost);
  Distinct<std::string> operations;
  for (const Json& row : cost["rows"]) operations.add(row["operation"]);
  Cells heads = {"operation"};
  for (const CostRegion& r : regions) heads.push_back(r.name);
  std::vector<Cells> rows;
  for (const std::string& operation : operations) {
    Cells row = {code(operation)};
    for (const CostRegion& r : regions)
      row.push_back(
          cost_sentence(region_points(cost, operation, r), own_library, JudgedIn(looks, operation)));
    if (std::any_of(row.begin() + 1, row.end(), [](const std::string& s) { return !s.empty(); }))
      rows.push_back(row);
  }
  if (rows.empty()) return "";
  std::string out =
      table(!own_library.empty() ? "What another form of the formula would win, as measured here; "
                                   "nothing where none wins more than one digit"
                                 : "What to take, and what a faster choice loses",
            heads, rows);
  if (std::ranges::any_of(cost["rows"], [&](const Json& row) {
        const std::string timed = row.value("timed", "");
        return row["subject"] == own_library && !timed.empty() && timed.find("own types") == timed.npos;
      }))
    out += fmt::format(
        "<p class=\"note\">The times of {} are those of calls with numbers: what its adapter converts is in "
        "them, and none of it "
        "in those of the forms.</p>\n",
        escaped(own_library));
  if (std::ranges::any_of(rows, [](const Cells& row) {
        return std::ranges::any_of(row, [](const std::string& s) { return s.find(within_budget) != s.npos; });
      }))
    out += fmt::format(
        "<p class=\"note\">Digits are those of the exact result of the numbers as stored. An operation that "
        "is "
        "{} needs no repair: its budget grants what rounded inputs leave undetermined.</p>\n",
        within_budget);
  return out;
}

}  // namespace liecheck::reports
