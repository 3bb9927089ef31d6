#include <store/picture.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <support/svg.hpp>
#include <vector>

namespace liecheck::properties {
namespace {

using Name = std::array<std::string, 6>;

constexpr std::size_t most_worse = 30, most_better = 12;
constexpr double line_height = 20, plot_width = 300, margin = 14;

struct Drawn {
  const StoredSeries* series = nullptr;  ///< null: not measured
  const Row* row = nullptr;
};

Drawn find(const StoredCampaign& c, const Name& n) {
  for (const StoredSeries& s : c.series)
    if (s.subject == n[0] && s.scalar == n[1] && s.property == n[2])
      for (const auto& [cell, row] : s.tally.rows)
        if (const Label& l = s.labels.at(cell); l.operation == n[3] && l.block == n[4] && l.band == n[5])
          return {&s, &row};
  return {};
}

/// One line of the picture.
struct Line {
  std::string group, label, figures;  ///< "textbook double, exp_oracle"; operation, block, band; "1 -> 30"
  std::optional<double> before, after;
};

/// The errors that are compared.
Line line_of(const StoredCampaign& a, const StoredCampaign& b, const Change& c) {
  const Name& n = c.name;
  Line line{fmt::format("{} {}, {}", n[0], n[1], n[2].empty() ? "beside the random cases" : n[2]),
            n[3].empty() ? "the oracles disagree" : c.place(),
            "",
            {},
            {}};
  const Drawn was = find(a, n), is = find(b, n);
  const bool same = was.row && is.row && was.series->tally.inputs.sum() == is.series->tally.inputs.sum();
  const bool excess = (was.row && was.row->max_excess > 0) || (is.row && is.row->max_excess > 0);
  const auto error = [&](const Drawn& m) -> std::optional<double> {
    if (!m.row || m.row->errors.count() == 0) return std::nullopt;
    return !same ? m.row->errors.quantile(0.99) : excess ? m.row->max_excess : m.row->max_error;
  };
  const auto words = [](const std::optional<double>& x) { return x ? fmt::format("{:.3g}", *x) : "none"; };
  line.before = error(was), line.after = error(is);
  if (was.row || is.row) line.figures = fmt::format("{} → {}", words(line.before), words(line.after));
  const auto fails = [](const Drawn& m) { return m.row ? m.row->failed : 0; };
  if (fails(was) + fails(is) > 0) line.figures += fmt::format(", {} → {} fail", fails(was), fails(is));
  return line;
}

/// The lines of one direction, at most `most` of the most important cells.
std::vector<Line> lines_of(const StoredCampaign& a, const StoredCampaign& b,
                           const std::vector<Change>& changes, std::size_t most) {
  std::vector<Line> lines;
  for (const Change& c : std::span(changes).first(std::min(most, changes.size())))
    lines.push_back(line_of(a, b, c));
  // In groups, of which the one with the most important line is the first.
  for (auto at = lines.begin(); at != lines.end();)
    at = std::stable_partition(at, lines.end(),
                               [group = at->group](const Line& l) { return l.group == group; });
  return lines;
}

/// A logarithmic axis of whole decades. What is below or above is drawn at its ends.
struct Scale {
  int low = 0, high = 1;
  double left = 0;

  Scale(const std::vector<Line>& lines) {
    for (const Line& l : lines)
      for (const auto& x : {l.before, l.after})
        if (x && *x > 0 && std::isfinite(*x)) {
          low = std::min(low, std::max(-3, static_cast<int>(std::floor(std::log10(*x)))));
          high = std::max(high, static_cast<int>(std::ceil(std::log10(*x))));
        }
  }
  double at(double error) const {
    const double decades = error > 0 ? std::log10(error) : low;
    return left + plot_width * (std::clamp<double>(decades, low, high) - low) / (high - low);
  }
  std::string drawn(double top, double bottom) const {
    std::string text;
    const int step = (high - low + 5) / 6;  // at most seven labels
    for (int d = low; d <= high; ++d) {
      const double x = left + plot_width * (d - low) / (high - low);
      text += fmt::format("<path class=\"line\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>\n", x, top, bottom);
      if ((d - low) % step == 0)
        text += svg_text(x, top - 5,
                         d == 0   ? "1"
                         : d == 1 ? "10"
                                  : fmt::format("1e{}", d),
                         "faint", "middle");
    }
    return text;
  }
};

std::string dots(const Scale& axis, const Line& l, double y, const char* kind) {
  std::string text;
  if (l.before && l.after)
    text += fmt::format("<path class=\"{}\" stroke-width=\"2\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n", kind,
                        axis.at(*l.before), y, axis.at(*l.after));
  const auto dot = [&](double error, const char* classes) {
    text += fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" stroke-width=\"2\"/>\n",
                        classes, axis.at(error), y);
  };
  if (l.before) dot(*l.before, fmt::format("{} hollow", kind).c_str());
  if (l.after) dot(*l.after, kind);
  return text;
}

/// The lines of one direction below y, with a heading for each group. Moves y.
std::string section(const std::vector<Line>& lines, std::size_t cells, const char* kind, const Scale& axis,
                    double& y) {
  std::string text, group;
  for (const Line& l : lines) {
    if (l.group != group)
      text += svg_text(margin, y += line_height, l.group + ": " + kind, std::string("strong ") + kind);
    group = l.group;
    y += line_height;
    text += svg_text(axis.left - 16, y, l.label, "", "end");
    text += dots(axis, l, y - 4, kind);
    text += svg_text(axis.left + plot_width + 16, y, l.figures);
  }
  if (cells > lines.size())
    text += svg_text(margin, y += line_height, fmt::format("and {} more {}", cells - lines.size(), kind),
                     "faint");
  return text;
}

}  // namespace

std::string picture_of(const Comparison& comparison, const StoredCampaign& a, const StoredCampaign& b) {
  const auto worse = lines_of(a, b, comparison.worse, most_worse),
             better = lines_of(a, b, comparison.better, most_better);
  const std::string title =
      fmt::format("liecheck: {} cells worse, {} better, of {} compared", comparison.worse.size(),
                  comparison.better.size(), cells_in_both(a, b));
  std::vector<Line> all = worse;
  all.insert(all.end(), better.begin(), better.end());
  if (all.empty())
    return svg(static_cast<int>(svg_width(title) + 2 * margin), 36, title, svg_text(margin, 23, title));
  Scale axis(all);
  double label = 0, figures = 0;
  for (const Line& l : all)
    label = std::max(label, svg_width(l.label)), figures = std::max(figures, svg_width(l.figures));
  axis.left = margin + label + 16;
  double y = 62;
  const double top = y + 8;
  std::string lines = section(worse, comparison.worse.size(), "worse", axis, y);
  lines += section(better, comparison.better.size(), "better", axis, y);
  const double width = std::max(axis.left + plot_width + 16 + figures, svg_width(title)) + margin;
  return svg(static_cast<int>(width), static_cast<int>(y + margin), title,
             svg_text(margin, 24, title, "strong") +
                 svg_text(margin, 42, "error in eps: ○ before, ● after", "faint") + axis.drawn(top, y + 6) +
                 lines);
}

}  // namespace liecheck::properties
