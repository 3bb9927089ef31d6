#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <reports/drawing.hpp>
#include <reports/picture.hpp>

namespace liecheck::reports {
namespace {

/// Logarithmic ticks of times [ns]: 1, 2 and 5 in each decade, or 1 alone if there are many decades.
std::vector<double> time_ticks(double low, double high) {
  std::vector<double> all;
  for (int e = static_cast<int>(std::floor(std::log10(low))); e <= std::log10(high); ++e)
    for (const double m : {1.0, 2.0, 5.0})
      if (const double t = m * std::pow(10, e); t >= low && t <= high && (m == 1 || high / low < 300))
        all.push_back(t);
  return all;
}

/// Where the points of a picture are [px].
struct CostAxes {
  double low, high, least = 16, most = 0;  ///< latency [ns], and correct digits

  explicit CostAxes(const std::vector<const CostPoint*>& points)  // the fastest first
      : low(points.front()->latency / 1.5), high(points.back()->latency * 1.7) {
    for (const CostPoint* p : points)
      least = std::min(least, shown_digits(*p)), most = std::max(most, shown_digits(*p));
    least = std::floor(least) - (least < 1 ? 0 : 1), most = std::ceil(most + .3);
  }
  double x(double ns) const { return left + (right - left) * std::log(ns / low) / std::log(high / low); }
  double y(double digits) const {
    return bottom - 4 - (bottom - 4 - top) * (digits - least) / (most - least);
  }
  double x(const CostPoint& p) const { return x(p.latency); }
  double y(const CostPoint& p) const { return y(shown_digits(p)); }

  std::string drawn_axes() const {
    std::string out;
    for (const double t : time_ticks(low, high))
      out += line(x(t), top, x(t), bottom, "grid") + text(x(t), bottom + 13, fmt::format("{:g}", t));
    const double step = most - least > 8 ? 4 : most - least > 4 ? 2 : 1;
    for (double d = std::ceil(least / step) * step; d <= most; d += step)
      out +=
          line(left, y(d), right, y(d), "grid") + text(left - 4, y(d) + 3.5, fmt::format("{:g}", d), "end");
    return out + text((left + right) / 2, bottom + 28, "latency of a call [ns]");
  }
};

/// " × 1280" of a batch, or "".
std::string times_text(std::size_t batch) {
  return batch > 1 ? fmt::format(" × {}", batch) : "";
}

/// The looks of the libraries whose marks have no name, and what the marks say.
std::string legend(const Looks& looks, const std::vector<std::pair<std::string, std::size_t>>& unnamed,
                   bool has_small, bool has_many, double& high) {
  std::string out;
  double x = left, y = height + 4;
  for (const auto& [subject, batch] : unnamed) {
    const std::string name = subject + times_text(batch);
    const double wide = 18 + 5.7 * static_cast<double>(name.size());
    if (x + wide > right + 6) x = left, y += 14;
    const std::size_t look = looks.of.at(subject);
    out += in_look(look, marker(x + 4, y - 3.5, look, subject)) + text(x + 12, y, name, "start");
    x += wide;
  }
  if (!unnamed.empty()) y += 14;
  out += text(left, y,
              has_many ? "filled, dashed: no single call is faster and as accurate"
                       : "filled, dashed: none is faster and as accurate",
              "start");
  const std::string rest = fmt::format("{}{}{}", has_many ? "× n: n inputs in one call, apart" : "",
                                       has_many && has_small ? "; " : "", has_small ? "small: float" : "");
  if (!rest.empty()) out += text(left, y += 13, rest, "start");
  high = y + 5;
  return out;
}

}  // namespace

std::string cost_picture(const Looks& looks, const std::vector<CostPoint>& points,
                         const std::string& operation) {
  std::vector<const CostPoint*> own;
  for (const CostPoint& p : points)
    if (p.operation == operation && p.latency > 0 && (p.scalar == "float" || p.scalar == "double"))
      own.push_back(&p);
  if (own.empty()) return "";
  std::ranges::stable_sort(own, {}, [](const CostPoint* p) { return p->latency; });
  const CostAxes axes(own);
  std::vector<const CostPoint*> front;  // of calls with one input
  for (const CostPoint* p : own)
    if (p->batch == 1 && !p->dominated && (front.empty() || shown_digits(*p) > shown_digits(*front.back())))
      front.push_back(p);
  std::string stairs, spoken, marks, names;
  Names placed;
  double from = bottom;  // the height of the step before
  for (std::size_t i = 0; i < front.size(); ++i) {
    const CostPoint& p = *front[i];
    const double x = axes.x(p), y = axes.y(p), to = i + 1 < front.size() ? axes.x(*front[i + 1]) : right;
    stairs += i ? fmt::format("H{:.4g}V{:.4g}", x, y) : fmt::format("M{:.4g} {}V{:.4g}", x, bottom, y);
    spoken += fmt::format("{}{}, {:.3g} ns, {:.1f} digits", spoken.empty() ? "" : "; ", p.name(), p.latency,
                          shown_digits(p));
    placed.keep_free({x - 1, y, x + 1, from}), placed.keep_free({x, y - 1, to, y + 1});
    from = y;
  }
  std::string out = axes.drawn_axes();
  if (!front.empty()) out += fmt::format("<path class=\"front\" d=\"{}H{}\"/>", stairs, right);
  for (const CostPoint* p : own) placed.keep_mark(axes.x(*p), axes.y(*p));
  Distinct<std::pair<std::string, std::size_t>> unnamed;
  for (const bool of_front : {true, false})
    for (const CostPoint* p : own) {
      const bool on_front = std::ranges::find(front, p) != front.end(), is_float = p->scalar == "float";
      if (on_front != of_front) continue;
      const std::size_t look = looks.of.at(p->subject);
      marks += in_look(look, marker(axes.x(*p), axes.y(*p), look,
                                    fmt::format("{}: {:.1f} correct digits, {:.3g} ns", p->name(),
                                                shown_digits(*p), p->latency),
                                    on_front ? "mark bad" : "mark", is_float));
      const std::string name =
          placed.name(axes.x(*p), axes.y(*p), p->subject + (is_float ? " float" : "") + times_text(p->batch),
                      on_front ? "strong" : "");
      if (name.empty()) unnamed.add({p->subject, p->batch});
      names += name;
    }
  double high = height;
  out += legend(looks, unnamed,
                std::ranges::any_of(own, [](const CostPoint* p) { return p->scalar == "float"; }),
                std::ranges::any_of(own, [](const CostPoint* p) { return p->batch > 1; }), high);
  return drawn(
      fmt::format("Correct digits of {} over the time of a call. Pareto front: {}.", operation, spoken),
      out + marks + names, high);
}

}  // namespace liecheck::reports
