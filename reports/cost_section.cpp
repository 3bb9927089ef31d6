#include <fmt/format.h>

#include <cmath>
#include <map>
#include <reports/cost_advice.hpp>
#include <reports/cost_points.hpp>
#include <reports/html.hpp>
#include <reports/picture.hpp>

namespace liecheck::reports {

namespace {

/// Operations that a tracker or controller calls.
const std::vector<std::string> core = {"exp6", "log6", "integrate", "difference"};

/// Of each operation of `core`, the error against time near 0, at moderate angles and near pi.
std::string fronts(const Looks& looks, const Json& cost) {
  std::string out;
  for (const std::string& operation : core) {
    std::string panels;
    for (const CostRegion& region : cost_regions(cost)) {
      const std::string picture = cost_picture(looks, cost_points(cost, region.bands.front()), operation);
      if (!picture.empty())
        panels +=
            fmt::format("<figure><figcaption>{}</figcaption><p class=\"note\">{}</p>{}</figure>", region.name,
                        cost_sentence(region_points(cost, operation, region), only_library(looks.merged),
                                      JudgedIn(looks, operation)),
                        picture);
    }
    if (!panels.empty())
      out += fmt::format(
          "<h3>{}: correct digits over the latency of a call</h3>\n<div class=\"panels\">{}</div>\n",
          operation, panels);
  }
  return out;
}

std::string price_table(const std::vector<CostPoint>& points, const std::vector<std::string>& operations) {
  std::vector<Cells> rows;
  for (const std::string& operation : operations)
    for (const CostStep& s : cost_steps(points, operation)) {
      const double more = digits_of(*s.to) - digits_of(*s.from), ns = s.to->latency - s.from->latency;
      const auto name = [](double n) {
        return std::isinf(n) ? std::string("exact") : fmt::format("{:.1f}", n);
      };
      rows.push_back(
          {code(operation), escaped(s.from->name()), escaped(s.to->name()),
           name(digits_of(*s.from)) + " → " + name(digits_of(*s.to)),
           fmt::format("<b>{} for +{}</b>", std::isinf(more) ? "the rest" : fmt::format("+{:.1f}", more),
                       time_text(ns)),
           fmt::format("× {:.2f}", s.to->latency / s.from->latency),
           std::isinf(more) ? "—" : time_text(ns / more)});
    }
  return table(
      "The price of each further digit, by latency: each step goes from one undominated row to the next "
      "slower row with at most half the error",
      {"operation", "from", "to", "correct digits", "digits gained, time added", "time", "a digit costs"},
      rows, true);
}

/// A table of operations by compilers and flags: latency, and the largest error in eps.
std::string flags_table(const Json& cost) {
  Distinct<std::pair<std::string, std::string>> modules;  // subjects and their flags
  Distinct<std::string> operations;
  std::map<std::pair<std::string, std::string>, std::string> cells;
  for (const Json& row : cost["rows"]) {
    if (!other_flags(row)) continue;
    const std::string subject = row["subject"], operation = row["operation"];
    modules.add({subject, row["version"].get<std::string>()});
    operations.add(operation);
    const Json& all = row["sets"].back();
    const double error = figure(row["error"]) / row["eps"].get<double>();
    cells[{operation, subject}] =
        fmt::format("{}, {}", all["latency"].is_null() ? "—" : time_text(all["latency"]["ns"]),
                    std::isinf(error) ? "<b>no result</b>" : eps_text(error) + " eps");
  }
  if (modules.empty()) return "";
  Cells heads = {"operation"};
  for (const auto& [module, flags] : modules)
    heads.push_back(escaped(module.substr(module.find('@') + 1)) + "<br>" + code(flags));
  std::vector<Cells> rows;
  for (const std::string& operation : operations) {
    Cells row = {code(operation)};
    for (const auto& [module, flags] : modules) row.push_back(cells[{operation, module}]);
    rows.push_back(row);
  }
  return table("Compilers and flags: liecheck in double, latency and the largest error found", heads, rows,
               true) +
         "<p class=\"note\">Each column is the same source, compiled to a separate module and called in the "
         "same way. With <code>-ffast-math</code> a compiler may reorder sums, which disables compensated "
         "summation, and may assume that NaN and infinity do not occur.</p>\n";
}

}  // namespace

std::string cost_section(const Looks& looks) {
  std::string out;
  for (const Json& record : looks.merged.records) {
    if (!record.contains("cost")) continue;
    const Json &cost = record["cost"], &e = cost["environment"];
    const auto points = cost_points(cost);
    Distinct<std::string> operations;
    for (const CostPoint& p : points) operations.add(p.operation);
    const std::string counter = cost["no_counter"];
    out += fronts(looks, cost) + cost_advice(cost, looks);
    out += fmt::format(
        "<p class=\"note\">Subjects of the program are called through a function pointer. All of a scalar "
        "get the same inputs, which are drawn from five bands of angles, and their errors are measured on "
        "these inputs; a maximum is a <b>lower bound</b>. A time is processor time, as a multiple of that "
        "of a reference loop beside it: the median of short repetitions in {} processes. In each process all "
        "rows are repeated in random order, and repetitions during which the machine was slower are left "
        "out. Brackets hold the spread from run to run: that of 99 of 100 other runs is in it. An adapter's "
        "time is that of loops that are compiled with it, or run in its process. A time in "
        "ns is the multiple of {:.4g} ns, the median of the reference loop, which depends on the speed of "
        "the machine during the run. Latency: each call waits for the result of the one before. "
        "Throughput: no call waits. The row <code>call</code> is the shortest operation of the same "
        "signature; its time is included in every other time. A row is <b>dominated</b> if another row is "
        "faster (disjoint spreads) and has no larger error, or has a smaller error and is not slower. The "
        "error is the largest of any block except the defects of norm and orthogonality. Scalars wider "
        "than double get inputs in double and are compared with closed forms at 100 digits.</p>\n",
        dumped(cost["processes"]), cost["reference_ns"].get<double>());
    if (!cost["steady"])
      out += fmt::format(
          "<p><b>The times are unsteady</b>: half of them spread by more than 15 %, and another run may give "
          "other times. {:.0f} % of the repetitions were disturbed and left out.</p>\n",
          100 * cost["disturbed"].get<double>());
    out += fmt::format(
        "<p class=\"note\">Machine: {}, governor {}, {}; {}, <code>{}</code>; instructions {}. Seed {}; "
        "{:.0f} s{}.</p>\n",
        text_of(e, "cpu"), text_of(e, "governor"), text_of(e, "os"), text_of(e, "compiler"),
        text_of(e, "flags"), counter.empty() ? "counted" : "not counted (" + escaped(counter) + ")",
        dumped(cost["seed"]), cost["elapsed"].get<double>(),
        cost["verdict"] == "incomplete" ? "; <b>interrupted: these are the results so far</b>" : "");
    out +=
        "<form class=\"cost-controls\" aria-label=\"Which times are drawn\"></form>\n"
        "<div class=\"cost-charts\"></div>\n";
    out += price_table(points, operations) + flags_table(cost) +
           "<p class=\"note\">report.json has the times and errors for each band of angles.</p>\n";
  }
  return out.empty()
             ? "<p>These records hold no times: <code>liecheck report</code> without a record measures "
               "them, as does <code>liecheck cost</code>.</p>\n"
             : out;
}

}  // namespace liecheck::reports
