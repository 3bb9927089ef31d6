#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <reports/html.hpp>

namespace liecheck::reports {
namespace {

std::string number(const Json& x, const char* unit = "") {
  if (x.is_null()) return "—";
  if (x.is_string()) return text_of(Json{{"x", x}}, "x");
  const double v = x.get<double>();
  return v == 0 ? "0" : fmt::format("{:.2g}{}", v, unit);
}

std::string verdict(const Json& s) {
  if (s["verdict"] == "incomplete")
    return "<p class=\"note\"><b>The run was interrupted: these are the results so far.</b></p>\n";
  std::size_t orders = 0;
  for (const Json& scene : s["scenes"]) orders += scene["orders"].size();
  if (orders == 0) return "";
  if (s["wrong_orders"].empty())
    return "<p>The observed order of every integrator is within 0.1 of its theoretical order, over five "
           "halvings of the step, on every scene below on which the integrator is not exact.</p>\n";
  std::string out =
      "<p class=\"verdict fail\"><strong>ORDER</strong> The observed order of some integrators is "
      "wrong:</p>\n"
      "<ul>\n";
  for (const Json& line : s["wrong_orders"]) out += "<li>" + escaped(line.get<std::string>()) + "</li>\n";
  return out + "</ul>\n";
}

/// A table of integrators by scenes: observed order, number of halvings, scalar, smallest error in double.
std::string orders(const Json& s) {
  Cells heads = {"integrator", "order"};
  Distinct<std::string> names;
  for (const Json& scene : s["scenes"]) {
    if (scene["orders"].empty()) continue;
    heads.push_back(text_of(scene, "scene") + (scene["closed"] ? "" : " (reference)"));
    for (const Json& row : scene["orders"]) names.add(row["integrator"]);
  }
  std::vector<Cells> rows;
  for (const std::string& name : names) {
    Cells cells = {code(name), "—"};
    for (const Json& scene : s["scenes"]) {
      if (scene["orders"].empty()) continue;
      std::string cell = "—";
      for (const Json& row : scene["orders"]) {
        if (row["integrator"] != name) continue;
        cells[1] = dumped(row["promised"]);
        cell = row["exact"] ? "exact"
                            : fmt::format("{:.3f}{} over {}, {}", row["observed"].get<double>(),
                                          row["settled"] ? "" : " (not settled)", dumped(row["halvings"]),
                                          text_of(row, "scalar"));
      }
      for (const Json& series : scene["series"])
        if (series["subject"] == "liecheck" && series["integrator"] == name)
          cell +=
              fmt::format("; {} {}", series["at_floor"] ? "floor" : "down to", number(series["smallest"]));
      cells.push_back(cell);
    }
    rows.push_back(cells);
  }
  if (rows.empty()) return "";
  return table(
      "The observed order of each integrator, with the number of halvings of the step and the scalar of the "
      "runs; then its smallest error in double, called its floor if smaller steps did not lower it",
      heads, rows, true);
}

/// A table of the drift of each method, in its coarsest run with an error of at most 1e-3.
std::string drifts(const Json& s) {
  std::vector<Cells> rows;
  for (const Json& scene : s["scenes"])
    for (const Json& series : scene["series"]) {
      const char* block = "attitude";
      for (const Json& p : series["points"]) {
        if (p["attitude"].is_null()) block = "position";
        if (!p[block].is_number() || p[block] > 1e-3 || (p["energy"].is_null() && p["momentum"].is_null()))
          continue;
        Cells cells = {text_of(scene, "scene"),
                       series["subject"] == "liecheck"
                           ? code(series["integrator"])
                           : text_of(series, "subject") + " " + text_of(series, "integrator"),
                       dumped(p["steps"]), number(p[block])};
        for (const char* name : {"energy", "momentum"})
          for (const char* part : {"slope", "oscillation"})
            cells.push_back(p[name].is_null() ? "—" : number(p[name][part]));
        rows.push_back(cells);
        break;
      }
    }
  if (rows.empty()) return "";
  return "<details><summary>Drift of energy and momentum: slope and oscillation</summary>\n" +
         table(
             "Drift over time, in the coarsest run with an error of at most 1e-3: the slope of the "
             "least-squares line and the largest distance from that line, relative to the value at the "
             "start. The momentum is the angular momentum vector of scenes without external forces",
             {"scene", "method", "steps", "error", "energy: slope [1/s]", "oscillation",
              "momentum: slope [1/s]", "oscillation"},
             rows, true) +
         "</details>\n";
}

std::string spins(const Json& s) {
  std::vector<Cells> rows;
  for (const Json& r : s["spins"])
    rows.push_back({code(r["integrator"]), dumped(r["order"]), dumped(r["turns"]),
                    dumped(r["steps_per_turn"]), number(r["error"]), number(r["limit"]),
                    r["error"].is_number()
                        ? fmt::format("{:.2f}", r["error"].get<double>() / r["limit"].get<double>())
                        : "—",
                    fmt::format("{:.2f} s", r["seconds"].get<double>())});
  std::string out;
  if (!rows.empty())
    out += table(
        "A triaxial body without torque over many turns: the error of its attitude against the closed form. "
        "The limit, turns · 2π · eps, is the effect of an error of eps in the angular velocity",
        {"integrator", "order", "turns", "steps a turn", "error [rad]", "limit [rad]", "error / limit",
         "time"},
        rows, true);
  rows.clear();
  for (const Json& f : s["flips"]) {
    std::string errors;
    for (const Json& e : f["relative"])
      errors += (errors.empty() ? "" : ", ") + (e == "inf" ? "lost" : number(e));
    rows.push_back({number(f["perturbation"]), text_of(f, "scalar"), number(f["exact"].front()), errors,
                    fmt::format("{} of {}", dumped(f["predicted"]), f["relative"].size()),
                    fmt::format("{:.1f} s", f["horizon"].get<double>())});
  }
  if (!rows.empty())
    out += table(
               "Dzhanibekov effect, ω₀ = (d, 1, d) rad/s, moments of inertia 1, 2, 3 kg m², by gauss12: "
               "relative error of the time of each flip, and the horizon up to which all flips are right to "
               "1e-6",
               {"d", "scalar", "first flip [s]", "relative error of each flip", "right to 1e-6", "horizon"},
               rows, true) +
           "<p class=\"note\">Near the axis, rounding errors in the unstable direction grow by 1/d². The "
           "time of a second flip therefore has a relative error of about eps/d² or more, with any "
           "integrator whose state is in that scalar.</p>\n";
  return out;
}

std::string peers(const Json& s) {
  std::vector<Cells> rows;
  for (const Json& p : s["peers"]) {
    const bool any = p["ours"] != "";
    rows.push_back({text_of(p, "scene"), text_of(p, "peer"), text_of(p, "integrator"), text_of(p, "measure"),
                    dumped(p["points"]), dumped(p["behind"]),
                    any ? fmt::format("<b>{:.3f}</b> [{:.3f}, {:.3f}]", figure(p["ratio"]), figure(p["low"]),
                                      figure(p["high"]))
                        : "—",
                    any ? number(p["error"]) : "—", any ? code(p["ours"]) : "—",
                    p["unmatched"] ? "one of its points is more accurate than any of liecheck’s" : ""});
  }
  for (const Json& name : s["absent"])
    rows.push_back({"all", escaped(name.get<std::string>()), "—", "—", "0", "—", "—", "—", "—",
                    "absent from this build"});
  for (const Json& scene : s["scenes"])
    for (const Json& l : scene["left_out"])
      rows.push_back({text_of(scene, "scene"), text_of(l, "peer"), "—", "—", "0", "—", "—", "—", "—",
                      "cannot run it: " + text_of(l, "why")});
  if (rows.empty()) return "";
  return table(
      "Comparison with other simulators: liecheck’s time divided by the simulator’s time, where liecheck’s "
      "error of "
      "the named quantity is no larger. The largest ratio over all points of the simulator is shown, with "
      "its 95 % "
      "confidence interval. Below 1, liecheck is faster at every point; “behind” counts those where it is "
      "not",
      {"scene", "simulator", "its method", "error of", "points", "behind", "liecheck’s time / its time",
       "at error", "liecheck’s method", "remark"},
      rows, true);
}

std::string costs(const Json& s) {
  std::vector<Cells> rows;
  for (const Json& c : list_in(s, "costs"))
    rows.push_back({text_of(c, "scene"), code(c["stage"]), text_of(c, "when"),
                    c["instructions"].is_null() ? "—" : std::to_string(c["instructions"].get<long>()),
                    c["nanoseconds"].is_null() ? "—" : time_text(c["nanoseconds"]), text_of(c, "equation"),
                    text_of(c, "energy"), text_of(c, "why")});
  if (rows.empty()) return "";
  return "<details open><summary>What each effect costs</summary>\n" +
         table(
             "The stages of three plans, as liecheck scene explain measures them. A plan has only the stages "
             "of the effects that its scene names",
             {"scene", "stage", "runs each", "instructions", "time", "equation", "energy",
              "why the plan has it"},
             rows, true) +
         "</details>\n";
}

}  // namespace

std::string scenes_section(const Merged& merged) {
  std::string out;
  std::size_t film = 0;
  for (const Json& record : merged.records) {
    if (!record.contains("scenes")) continue;
    const Json& s = record["scenes"];
    out += verdict(s);
    Json own = Json::array();
    for (std::size_t i = 0; i < list_in(s, "films").size(); ++i) own.push_back(film++);
    if (!own.empty()) out += fmt::format("<div class=\"films\" data-films=\"{}\"></div>\n", dumped(own));
    out += fmt::format(
        "<p class=\"note\">Each method runs a scene with smaller and smaller steps; an adaptive method runs "
        "it with smaller and smaller tolerances. The error is the largest difference from the exact motion "
        "at the four quarters of the duration; for attitudes it is the angle between the two. The time is "
        "the median of the processor time of a whole run, divided by the duration; the runs of all points of "
        "a scene are interleaved. Lower and further left is better. Dashed lines are other simulators, with "
        "contact and damping off. All runs together took {:.0f} s.</p>\n"
        "<form class=\"scene-controls\" aria-label=\"Which scenes are drawn\"></form>\n"
        "<div class=\"scene-charts\"></div>\n",
        s["elapsed"].get<double>());
    out += peers(s) + orders(s) + spins(s) + drifts(s) + costs(s);
  }
  return out;
}

}  // namespace liecheck::reports
