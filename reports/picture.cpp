#include <reports/picture.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <reports/html.hpp>
#include <reports/summary.hpp>
#include <set>
#include <tuple>

namespace liecheck::reports {
namespace {

constexpr double width = 320, height = 236, left = 30, right = 312, top = 12, bottom = 196;

/// Outlines around a point, in the order of the looks.
constexpr auto circle = "m-3.5 0a3.5 3.5 0 1 0 7 0a3.5 3.5 0 1 0-7 0z", triangle = "m0-4l4 7h-8z",
               square = "m-3-3h6v6h-6z", diamond = "m0-4.2l4.2 4.2l-4.2 4.2l-4.2-4.2z",
               star = "m-3-3l6 6m0-6l-6 6m3-7v8m-4-4h8", cross = "m0-4v8m-4-4h8",
               saltire = "m-3-3l6 6m0-6l-6 6";
constexpr std::array markers = {circle, triangle, square,   diamond, circle, star,
                                cross,  saltire,  triangle, square,  diamond};
static_assert(markers.size() == look_count);

std::string text(double x, double y, const std::string& words, const char* anchor = "middle",
                 const char* kind = "") {
  return fmt::format("<text x=\"{:.4g}\" y=\"{:.4g}\" text-anchor=\"{}\"{}>{}</text>", x, y, anchor,
                     *kind ? fmt::format(" class=\"{}\"", kind) : "", escaped(words));
}

std::string line(double x0, double y0, double x1, double y1, const char* kind) {
  return fmt::format("<path class=\"{}\" d=\"M{:.4g} {:.4g}L{:.4g} {:.4g}\"/>", kind, x0, y0, x1, y1);
}

std::string marker(double x, double y, std::size_t shape, const std::string& title,
                   const char* kind = "mark") {
  return fmt::format("<path class=\"{}\" d=\"M{:.4g} {:.4g}{}\"><title>{}</title></path>", kind, x, y,
                     markers[shape % look_count], escaped(title));
}

/// The elements of a library, in its colour.
std::string in_look(std::size_t look, const std::string& elements) {
  return fmt::format("<g style=\"--c:var(--look-{})\">{}</g>", look % look_count, elements);
}

std::string drawn(const std::string& label, const std::string& elements, double high = height) {
  return fmt::format(
      "<svg class=\"picture\" viewBox=\"0 0 {} {:.4g}\" role=\"img\" aria-label=\"{}\">{}</svg>\n", width,
      high, escaped(label), elements);
}

std::string power(int e) {
  if (e == 0) return "1";
  constexpr std::array digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = "10";
  for (const char c : std::to_string(e)) out += c == '-' ? "⁻" : digits[static_cast<std::size_t>(c - '0')];
  return out;
}

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

std::string error_frame(const Bands& bands, double all, bool outcomes) {
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
  if (outcomes) out += text(left - 4, top + 6, "NaN", "end");
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
    const bool fails = row["status"] == "fail";
    marks += marker(x, worst, look,
                    fmt::format("{}, {}: {}{}", text_of(row, "subject"), text_of(row, "band"),
                                looks.digits.words(row), fails ? ", over budget" : ""),
                    fails ? "mark bad" : "mark");
  }
  return in_look(look, fmt::format("<path class=\"line\" d=\"{}\"/>{}", path, marks));
}

/// Names beside points, the first ones first; a name that would cover a point or another name is left out.
class Names {
 public:
  struct Box {
    double x0, y0, x1, y1;
  };
  void keep_free(const Box& box) { taken_.push_back(box); }
  std::string name(double x, double y, const std::string& words, const char* kind) {
    const double wide = 5.7 * static_cast<double>(words.size());
    for (const auto& [from, down] : {std::pair(x + 7, y + 3.5),
                                     {x - 7 - wide, y + 3.5},
                                     {x - wide / 2, y - 8},
                                     {x - wide / 2, y + 15},
                                     {x + 6, y - 5},
                                     {x + 6, y + 12},
                                     {x - 6 - wide, y - 5}}) {
      const Box box{from, down - 9, from + wide, down + 2};
      if (box.x0 < left + 1 || box.x1 > right + 6 || box.y0 < 0 || box.y1 > bottom) continue;
      if (std::ranges::any_of(taken_, [&](const Box& b) {
            return b.x0 < box.x1 && box.x0 < b.x1 && b.y0 < box.y1 && box.y0 < b.y1;
          }))
        continue;
      taken_.push_back(box);
      return text(from, down, words, "start", kind);
    }
    return "";
  }

 private:
  std::vector<Box> taken_;
};

/// Logarithmic ticks of times [ns]: 1, 2 and 5 in each decade, or 1 alone if there are many decades.
std::vector<double> time_ticks(double low, double high) {
  std::vector<double> all;
  for (int e = static_cast<int>(std::floor(std::log10(low))); e <= std::log10(high); ++e)
    for (const double m : {1.0, 2.0, 5.0})
      if (const double t = m * std::pow(10, e); t >= low && t <= high && (m == 1 || high / low < 300))
        all.push_back(t);
  return all;
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
    if (row["status"] == "fail") wrong.emplace(row["subject"], row["operation"]);
}

std::string swatch(std::size_t look) {
  return fmt::format(
      "<svg class=\"swatch\" width=\"26\" height=\"12\" viewBox=\"0 0 26 12\" aria-hidden=\"true\" "
      "style=\"--c:var(--look-{})\"><path class=\"line\" d=\"M0 6h26\"/><path class=\"mark bad\" d=\"M13 "
      "6{}\"/></svg>",
      look % look_count, markers[look % look_count]);
}

std::string error_picture(const Looks& looks, const std::vector<const Json*>& rows, const std::string& axis) {
  std::vector<const Json*> own;
  for (const Json* r : rows)
    if ((*r)["axis"] == axis && (*r)["count"] > 0) own.push_back(r);
  if (own.empty()) return "";
  const Bands bands(own, axis != "theta");
  std::ranges::stable_sort(own, {}, [&](const Json* r) { return bands.place.at((*r)["band"]); });
  const bool outcomes = std::ranges::any_of(own, [](const Json* r) { return !outcome_of(*r).empty(); });
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

std::string cost_picture(const Looks& looks, const std::vector<CostPoint>& points,
                         const std::string& operation) {
  std::vector<const CostPoint*> own;
  for (const CostPoint& p : points)
    if (p.operation == operation && p.latency > 0 && (p.scalar == "float" || p.scalar == "double"))
      own.push_back(&p);
  if (own.empty()) return "";
  const auto digits = [](const CostPoint* p) { return shown_digits(*p); };
  std::ranges::stable_sort(own, {}, [](const CostPoint* p) { return p->latency; });
  const double low = own.front()->latency / 1.5, high = own.back()->latency * 1.7;
  double least = 16, most = 0;
  for (const CostPoint* p : own) least = std::min(least, digits(p)), most = std::max(most, digits(p));
  least = std::floor(least) - (least < 1 ? 0 : 1), most = std::ceil(most + .3);
  const auto x = [&](double ns) { return left + (right - left) * std::log(ns / low) / std::log(high / low); };
  const auto y = [&](double d) { return bottom - 4 - (bottom - 4 - top) * (d - least) / (most - least); };
  std::string out;
  for (const double t : time_ticks(low, high))
    out += line(x(t), top, x(t), bottom, "grid") + text(x(t), bottom + 13, fmt::format("{:g}", t));
  const double step = most - least > 8 ? 4 : most - least > 4 ? 2 : 1;
  for (double d = std::ceil(least / step) * step; d <= most; d += step)
    out += line(left, y(d), right, y(d), "grid") + text(left - 4, y(d) + 3.5, fmt::format("{:g}", d), "end");
  out += text((left + right) / 2, height - 12, "latency of a call [ns]");
  std::vector<const CostPoint*> front;  // of calls with one input
  for (const CostPoint* p : own)
    if (p->batch == 1 && !p->dominated && (front.empty() || digits(p) > digits(front.back())))
      front.push_back(p);
  std::string stairs, spoken, marks, names;
  for (const CostPoint* p : front) {
    const double px = x(p->latency), py = y(digits(p));
    stairs += stairs.empty() ? fmt::format("M{:.4g} {}V{:.4g}", px, bottom, py)
                             : fmt::format("H{:.4g}V{:.4g}", px, py);
    spoken += fmt::format("{}{}, {:.3g} ns, {:.1f} digits", spoken.empty() ? "" : "; ", p->name(), p->latency,
                          digits(p));
  }
  if (!front.empty()) out += fmt::format("<path class=\"front\" d=\"{}H{}\"/>", stairs, right);
  Names placed;
  for (std::size_t i = 0; i < front.size(); ++i) {
    const double px = x(front[i]->latency), py = y(digits(front[i]));
    placed.keep_free({px - 1, py, px + 1, i ? y(digits(front[i - 1])) : bottom});
    placed.keep_free({px, py - 1, i + 1 < front.size() ? x(front[i + 1]->latency) : right, py + 1});
  }
  for (const CostPoint* p : own)
    placed.keep_free({x(p->latency) - 5, y(digits(p)) - 5, x(p->latency) + 5, y(digits(p)) + 5});
  for (const bool of_front : {true, false})
    for (const CostPoint* p : own) {
      const bool on_front = std::ranges::find(front, p) != front.end();
      if (on_front != of_front) continue;
      const auto look = looks.of.find(p->subject);
      marks += in_look(
          look == looks.of.end() ? 0 : look->second,
          marker(x(p->latency), y(digits(p)), look == looks.of.end() ? 0 : look->second,
                 fmt::format("{}: {:.1f} correct digits, {:.3g} ns", p->name(), digits(p), p->latency),
                 on_front ? "mark bad" : "mark"));
      names += placed.name(x(p->latency), y(digits(p)),
                           p->subject + (p->scalar == "float" ? " float" : "") +
                               (p->batch > 1 ? fmt::format(" × {}", p->batch) : ""),
                           of_front ? "strong" : "");
    }
  return drawn(
      fmt::format("Correct digits of {} over the time of a call. Pareto front: {}.", operation, spoken),
      out + marks + names);
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
