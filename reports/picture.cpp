#include <reports/picture.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <reports/drawing.hpp>
#include <reports/html.hpp>
#include <reports/summary.hpp>
#include <set>
#include <tuple>

namespace liecheck::reports {
namespace {

/// A band without a place on a logarithmic axis: 0, and bands of many decades. They share the columns beyond its end.
bool is_slot(const Json& row) {
  const double low = row["low"].get<double>(), high = row["high"].get<double>();
  return !(low > 0) || !(high > 0) || std::log10(high / low) > 2.5;
}

/// The horizontal places [px] of bands: decades on a logarithmic axis, and a narrow column for each other band.
struct Bands {
  std::map<std::string, double> place;
  double low = 0, slots_from = left, slots_to = left;
  bool reverse;

  Bands(const std::vector<const Json*>& rows, bool near_pi) : reverse(near_pi) {
    std::set<std::tuple<double, double, std::string>> slots;  // from the smallest angle
    for (const Json* r : rows)
      if (is_slot(*r))
        slots.emplace((*r)["high"].get<double>(), (*r)["low"].get<double>(), (*r)["band"]);
      else
        low = std::min(low, std::round(std::log10((*r)["low"].get<double>())));
    const double column = 10, all = column * static_cast<double>(slots.size());
    reverse ? (slots_from = right - all, slots_to = right) : (slots_to = left + all);
    double x = reverse ? right - column / 2 : left + column / 2;
    for (const auto& [high, low_, band] : slots) place[band] = x, x += reverse ? -column : column;
    for (const Json* r : rows)
      if (!is_slot(*r))
        place[(*r)["band"]] =
            at((std::log10((*r)["low"].get<double>()) + std::log10((*r)["high"].get<double>())) / 2);
  }
  double at(double log) const {
    const double gap = slots_to > slots_from ? 6 : 0;
    const double share = low < 0 ? log / low : 0;  // 0 at an angle of 1
    return reverse ? left + share * (slots_from - gap - left) : right - share * (right - slots_to - gap);
  }
};

double y_of_digits(double lost, double all) {
  return bottom - 4 - (bottom - 4 - top - 16) * lost / all;
}

/// `outcome`: the name of the level above all digits, or "".
std::string error_frame(const Bands& bands, double all, const std::string& outcome) {
  std::string out;
  if (bands.slots_to > bands.slots_from) {
    out += fmt::format("<rect class=\"slot\" x=\"{:.4g}\" y=\"{}\" width=\"{:.4g}\" height=\"{}\"/>",
                       bands.slots_from, top, bands.slots_to - bands.slots_from, bottom - top);
    const double middle = (bands.slots_from + bands.slots_to) / 2;
    out += text(bands.reverse ? right : middle, bottom + 13, bands.reverse ? "π" : "0, tiny",
                bands.reverse ? "end" : "middle");
  }
  for (int e = 0; e >= bands.low; --e) {
    const bool named = e % (bands.low < -10 ? 5 : 2) == 0;
    if (!named) continue;
    const bool close = bands.reverse ? bands.at(e) > right - 24 : bands.at(e) < bands.slots_to + 18;
    out += line(bands.at(e), top, bands.at(e), bottom, "grid");
    if (!close || bands.slots_to <= bands.slots_from)
      out += text(bands.at(e), bottom + 13, power(e), e == 0 ? (bands.reverse ? "start" : "end") : "middle");
  }
  const double step = all > 10 ? 4 : 2;
  for (double d = 0; d < all - 1; d += step)
    out += line(left, y_of_digits(d, all), right, y_of_digits(d, all), "grid") +
           text(left - 4, y_of_digits(d, all) + 3.5, fmt::format("{}", d), "end");
  out += line(left, y_of_digits(all, all), right, y_of_digits(all, all), "rim") +
         text(left - 4, y_of_digits(all, all) + 3.5, "all", "end");
  if (!outcome.empty()) out += text(left - 4, top + 6, outcome, "end");
  out += text((left + right) / 2, height - 12,
              bands.reverse ? "π − θ [rad]: θ grows to the right" : "angle θ [rad]");
  return out;
}

/// The line and the marks of one library.
std::string error_line(const Looks& looks, const std::vector<const Json*>& own, const Bands& bands,
                       std::size_t look) {
  std::string path, marks;
  bool was_slot = true;
  for (const Json* r : own) {
    const Json& row = *r;
    const double all = looks.digits.all(row), x = bands.place.at(row["band"]), p99 = figure(row["p99_eps"]);
    const bool slot = is_slot(row);
    const bool drawn_line =
        std::isfinite(p99) && row["rule"] != "excess";  // p99 counts what the problem amplifies
    if (drawn_line) {
      const double y = y_of_digits(std::clamp(std::log10(std::max(p99, 1.0)), 0.0, all), all);
      path += slot ? fmt::format("M{:.4g} {:.4g}h7", x - 3.5, y)
                   : fmt::format("{}{:.4g} {:.4g}", was_slot ? 'M' : 'L', x, y);
    }
    was_slot = slot || !drawn_line;
    const std::string outcome = outcome_of(row);
    const double worst = outcome.empty() ? y_of_digits(looks.digits.lost(row), all) : top + 3;
    const bool fails = is_over_budget(row);
    marks += marker(x, worst, look,
                    fmt::format("{}, {}: {}{}", text_of(row, "subject"), text_of(row, "band"),
                                looks.digits.words(row), fails ? ", over budget" : ""),
                    fails ? "mark bad" : "mark");
  }
  return in_look(look, fmt::format("<path class=\"line\" d=\"{}\"/>{}", path, marks));
}

}  // namespace

std::map<std::string, std::size_t> looks_of(const Merged& merged) {
  std::map<std::string, std::size_t> looks = {{"liecheck", 0}, {"textbook", 1}, {"eigen", 2}, {"ceres", 3}};
  const auto add = [&](const std::string& subject) { looks.try_emplace(subject, looks.size()); };
  for (const Json& row : merged.results) add(row["subject"]);
  for (const Json& record : merged.records)
    if (record.contains("cost"))
      for (const Json& row : record["cost"]["rows"])
        if (row["subject"] != "call" && !other_flags(row)) add(row["subject"]);
  return looks;
}

Looks::Looks(const Merged& all) : merged(all), digits(all), of(looks_of(all)) {
  for (const Json& row : all.results)
    if (is_over_budget(row)) wrong.emplace(row["subject"], row["operation"]);
}

std::string swatch(std::size_t look) {
  return fmt::format(
      "<svg class=\"swatch\" width=\"26\" height=\"12\" viewBox=\"0 0 26 12\" aria-hidden=\"true\" "
      "style=\"--c:var(--look-{})\"><path class=\"line\" d=\"M0 6h26\"/><path class=\"mark bad\" d=\"M13 "
      "6{}\"/></svg>",
      look % look_count, outline(look));
}

std::string error_picture(const Looks& looks, const std::vector<const Json*>& rows, const std::string& axis) {
  std::vector<const Json*> own;
  for (const Json* r : rows)
    if ((*r)["axis"] == axis && (*r)["count"] > 0) own.push_back(r);
  if (own.empty()) return "";
  const Bands bands(own, axis != "theta");
  std::ranges::stable_sort(own, {}, [&](const Json* r) { return bands.place.at((*r)["band"]); });
  std::string outcomes;
  for (const Json* r : own)
    if (const std::string outcome = outcome_of(*r); !outcome.empty() && outcomes != "NaN")
      outcomes = *mark_of(outcome) == 'N' ? "NaN" : mark_of(outcome);
  std::string out = error_frame(bands, looks.digits.all(*own.front()), outcomes), spoken;
  for (const auto& [subject, look] : looks.of) {
    std::vector<const Json*> mine;
    for (const Json* r : own)
      if ((*r)["subject"] == subject) mine.push_back(r);
    if (mine.empty()) continue;
    const Json* worst = *std::ranges::max_element(mine, {}, [](const Json* r) { return severity(*r); });
    spoken +=
        fmt::format(" {}: worst {}, in {}.", subject, looks.digits.words(*worst), text_of(*worst, "band"));
    out += error_line(looks, mine, bands, look);
  }
  return drawn(fmt::format("Digits lost {}.{}", axis == "theta" ? "near 0" : "near π", spoken), out);
}

std::string hard_picture(const Looks& looks, const std::vector<HardCase>& cases) {
  struct Cell {
    int all = 0, failed = 0;
  };
  std::map<std::string, std::map<std::string, Cell>> classes;  // class, subject
  std::map<std::string, Cell> sums;
  Distinct<std::string> subjects;
  for (const HardCase& c : cases)
    for (Cell* cell : {&classes[c.of_class][c.subject], &sums[c.of_class]})
      ++cell->all, cell->failed += c.failed, subjects.add(c.subject);
  std::vector<std::string> order;
  for (const auto& [name, cell] : sums) order.push_back(name);
  std::ranges::stable_sort(order, std::greater(), [&](const std::string& name) {
    return std::pair(sums[name].failed, sums[name].all);
  });
  constexpr std::size_t shown = 12;
  const double names = 124, high = 15, wide = (width - names) / static_cast<double>(subjects.size());
  std::string out, spoken;
  double x = names;
  for (const std::string& subject : subjects) {
    const std::size_t look = looks.of.contains(subject) ? looks.of.at(subject) : 0;
    if (subjects.size() > 1) out += in_look(look, marker(x + wide / 2, 6, look, subject, "mark bad"));
    x += wide;
  }
  for (std::size_t i = 0; i < std::min(order.size(), shown); ++i) {
    const double y = 14 + high * static_cast<double>(i);
    out += text(names - 6, y + 11, order[i], "end");
    double x0 = names;
    for (const std::string& subject : subjects) {
      const Cell& cell = classes[order[i]][subject];
      const double share = cell.all ? double(cell.failed) / cell.all : 0, full = wide - 2;
      const bool bar = wide > 60;  // of the share that fails; a narrow cell is the darker, the more fail
      const auto area = [&](const char* kind, double long_, double opacity) {
        return fmt::format(
            "<rect class=\"{}\" fill-opacity=\"{:.2g}\" x=\"{:.4g}\" y=\"{:.4g}\" width=\"{:.4g}\" "
            "height=\"{}\"/>",
            kind, opacity, x0, y, long_, high - 2);
      };
      out += fmt::format("<g><title>{}: {} of {} fail</title>", escaped(subject + ", " + order[i]),
                         cell.failed, cell.all);
      out += area(cell.all ? "good" : "none", full, 1);
      if (cell.failed) out += area("bad", bar ? full * share : full, bar ? .5 : .2 + .4 * share);
      if (cell.all)
        out += text(x0 + full / 2, y + 10.5,
                    bar ? fmt::format("{} of {}", cell.failed, cell.all) : std::to_string(cell.failed),
                    "middle", cell.failed ? "strong" : "");
      out += "</g>";
      x0 += wide;
    }
    if (sums[order[i]].failed)
      spoken += fmt::format(" {}: {} of {}.", order[i], sums[order[i]].failed, sums[order[i]].all);
  }
  const double end = 14 + high * static_cast<double>(std::min(order.size(), shown));
  if (order.size() > shown) {
    int failed = 0, all = 0;
    for (std::size_t i = shown; i < order.size(); ++i)
      failed += sums[order[i]].failed, all += sums[order[i]].all;
    out += text(0, end + 12,
                fmt::format("and {} further classes: {} of {} cases fail", order.size() - shown, failed, all),
                "start");
  }
  return drawn("Hard cases that fail, by class." + (spoken.empty() ? std::string(" None.") : spoken), out);
}

}  // namespace liecheck::reports
