#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <reports/cost_points.hpp>
#include <reports/html.hpp>

namespace liecheck::reports {

namespace {

/// What a tracker or controller calls; the advice is for all of them together.
const std::vector<std::string> core = {"exp6", "log6", "integrate", "difference"};

std::string time_text(double ns) {
  if (ns < 1000) return fmt::format("{:.3g} ns", ns);
  if (ns < 1e6) return fmt::format("{:.3g} µs", ns / 1e3);
  return ns < 1e9 ? fmt::format("{:.3g} ms", ns / 1e6) : fmt::format("{:.3g} s", ns / 1e9);
}

std::string digits(double error) {
  return std::isinf(error) ? "no digit"
         : error > 0       ? fmt::format("{:.1f} digits", -std::log10(error))
                           : "every digit";
}

/// For a 1 kHz controller and for an offline calibration, each with the rule by which the figures choose.
std::string advice(const std::vector<CostPoint>& points) {
  const auto all = cost_candidates(points, core);
  if (all.empty())
    return "<p>No advice: it takes a subject that offers exp6, log6, integrate and difference.</p>\n";
  constexpr double hour = 3.6e6, encoder = 1e-7, calls = 100, tick = 1e6;
  std::string out = "<dl class=\"advice\">\n";
  const auto item = [&](const char* what, const std::string& text) {
    out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", what, text);
  };
  const std::string rule = fmt::format(
      "The rule: an hour is {:.1e} ticks; should every tick’s error add to the last, their sum stays below "
      "1e-7, "
      "which is finer than an encoder of 24 bits. Of those that keep it, the fastest.",
      hour);
  if (const auto* c = fastest_within(all, encoder / hour)) {
    const double share = calls * c->latency / tick;
    item("For a 1 kHz controller",
         fmt::format(
             "take <b>{}</b>: {} of each of exp6, log6, integrate and difference wait {} in all, {:.2g} % of "
             "a tick of 1 ms{}, and keep {}. {}",
             escaped(c->name()), calls, time_text(calls * c->latency), share * 100,
             share > 1 ? " (too much: call fewer)" : "", digits(c->error), rule));
  } else {
    item("For a 1 kHz controller", "nothing measured here is accurate enough. " + rule);
  }
  const std::string offline =
      "The rule: finite differences and normal equations square a condition number of up to 1e8 and so take "
      "16 "
      "digits; six are to be left. Of those that keep 22 digits, the fastest.";
  const auto* wide = fastest_within(all, 1e-22);
  const auto* in_double = most_accurate(all, "double");
  const std::string narrow = in_double ? fmt::format(" Where all must stay in double: <b>{}</b>, {}.",
                                                     escaped(in_double->name()), digits(in_double->error))
                                       : "";
  item("For an offline calibration",
       (wide ? fmt::format("take <b>{}</b>: {} at {} for one call of each of the four, {} for a million. {}",
                           escaped(wide->name()), digits(wide->error), time_text(wide->latency),
                           time_text(wide->latency * 1e6), offline)
             : "nothing measured here keeps 22 digits. " + offline) +
           narrow);
  return out + "</dl>\n";
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
      "The price of each further digit: from one point of the front to the next that at least halves the "
      "error, by latency",
      {"operation", "from", "to", "correct digits", "digits gained, time added", "time", "a digit costs"},
      rows, true);
}

std::string spread_text(const Json& s) {
  if (s.is_null()) return "—";
  return fmt::format("{:.4g} [{:.4g}, {:.4g}]", s["median"].get<double>(), s["low"].get<double>(),
                     s["high"].get<double>());
}

/// Operations by compilers and flags: latency, and the largest error in eps.
std::string flags_table(const Json& cost) {
  std::vector<std::string> modules, flags, operations;
  std::map<std::pair<std::string, std::string>, std::string> cells;
  for (const Json& row : cost["rows"]) {
    if (!other_flags(row)) continue;
    const std::string subject = row["subject"], operation = row["operation"];
    if (std::find(modules.begin(), modules.end(), subject) == modules.end())
      modules.push_back(subject), flags.push_back(row["version"]);
    if (operations.empty() || operations.back() != operation) operations.push_back(operation);
    const Json& all = row["sets"].back();
    const double error = figure(row["error"]) / row["eps"].get<double>();
    cells[{operation, subject}] =
        fmt::format("{}, {}", all["latency_ns"].is_null() ? "—" : time_text(all["latency_ns"]["median"]),
                    std::isinf(error) ? "<b>no result</b>" : eps_text(error) + " eps");
  }
  if (modules.empty()) return "";
  Cells heads = {"operation"};
  for (std::size_t i = 0; i < modules.size(); ++i)
    heads.push_back(escaped(modules[i].substr(modules[i].find('@') + 1)) + "<br>" + code(flags[i]));
  std::vector<Cells> rows;
  for (const std::string& operation : operations) {
    Cells row = {code(operation)};
    for (const std::string& module : modules) row.push_back(cells[{operation, module}]);
    rows.push_back(row);
  }
  return table("Compilers and flags: liecheck in double, latency and the largest error found", heads, rows,
               true) +
         "<p class=\"note\">Each column is the same source in a module of its own, called as the others are. "
         "<code>-ffast-math</code> lets a compiler reorder sums, so that what compensates roundings is lost, "
         "and take "
         "NaN and infinity for impossible.</p>\n";
}

/// Every row and block, folded.
std::string all_points(const Json& cost) {
  std::vector<Cells> rows;
  for (const Json& row : cost["rows"])
    for (const Json& set : row["sets"]) {
      const bool mixed = &set == &row["sets"].back();
      Cells errors;
      for (const Json& b : set["blocks"]) {
        const int bad = b["not_finite"].get<int>() + b["wrong_branch"].get<int>() + b["refused"].get<int>() +
                        b["unresolved"].get<int>();
        errors.push_back(fmt::format("{}: {}, {}, {}{}", text_of(b, "block"), eps_text(figure(b["max_eps"])),
                                     eps_text(figure(b["p99_eps"])), eps_text(figure(b["median_eps"])),
                                     bad ? fmt::format(" (<b>{} without a result</b>)", bad) : ""));
      }
      rows.push_back(
          {code(row["operation"]), text_of(row, "subject"), text_of(row, "scalar"), text_of(set, "set"),
           spread_text(set["latency_ns"]), spread_text(set["throughput_ns"]),
           set["instructions"].is_null() ? "—" : fmt::format("{:.0f}", set["instructions"].get<double>()),
           fmt::format("{}", fmt::join(errors, "; ")),
           mixed && row["dominated_latency"].is_string() ? text_of(row, "dominated_latency") : ""});
    }
  return "<details><summary>Every figure: each operation, subject and scalar, over all inputs and band by "
         "band</summary>\n" +
         table("Time and error on the same inputs",
               {"operation", "subject", "scalar", "inputs", "latency [ns]", "throughput [ns]", "instructions",
                "error of each block: max, p99, median [eps]", "dominated, by latency, by"},
               rows, true) +
         "</details>\n";
}

}  // namespace

std::string cost_section(const Merged& merged) {
  std::string out;
  for (const Json& record : merged.records) {
    if (!record.contains("cost")) continue;
    const Json &cost = record["cost"], &e = cost["environment"];
    const auto points = cost_points(cost);
    std::vector<std::string> operations;
    for (const CostPoint& p : points)
      if (operations.empty() || operations.back() != p.operation) operations.push_back(p.operation);
    const std::string counter = cost["no_counter"];
    out += advice(points);
    out += fmt::format(
        "<p class=\"note\">Every subject was called through a pointer to a function on the same inputs of "
        "its "
        "scalar, drawn from five bands of angles, and its error measured on them: a maximum is a <b>lower "
        "bound</b>. A time is processor time: the median of at most {} repetitions, of all rows in random "
        "order "
        "in one run, without those during which another program shared the core; in brackets the interval "
        "that "
        "holds it with 95 %. Latency: each call waits for the one before. Throughput: none waits. The row "
        "<code>call</code> is the shortest operation of the same signature; it is in every time. "
        "<b>Dominated</b>: another is faster for certain and errs no more, or errs less and is not slower. "
        "The "
        "error is the largest of any block but defects of norm or orthogonality. Scalars wider than double "
        "take "
        "inputs in double, against closed forms at 100 digits.</p>\n",
        cost["repetitions"].dump());
    out += fmt::format(
        "<p class=\"note\">Machine: {}, governor {}, {}; {}, <code>{}</code>; instructions {}. Seed {}; "
        "{:.0f} s{}.</p>\n",
        text_of(e, "cpu"), text_of(e, "governor"), text_of(e, "os"), text_of(e, "compiler"),
        text_of(e, "flags"), counter.empty() ? "counted" : "not counted (" + escaped(counter) + ")",
        cost["seed"].dump(), cost["elapsed"].get<double>(),
        cost["verdict"] == "incomplete" ? "; <b>interrupted: what was done</b>" : "");
    out +=
        "<form class=\"cost-controls\" aria-label=\"Which times are drawn\"></form>\n"
        "<div class=\"cost-charts\"></div>\n";
    out += price_table(points, operations) + flags_table(cost) + all_points(cost);
  }
  return out.empty()
             ? "<p>These records hold no times; <code>liecheck report</code> without a record measures "
               "them, as does <code>liecheck cost</code>.</p>\n"
             : out;
}

}  // namespace liecheck::reports
