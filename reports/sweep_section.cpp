#include <fmt/format.h>

#include <cmath>
#include <reports/html.hpp>

namespace liecheck::reports {

std::string sweep_section(const Merged& merged) {
  std::string out;
  for (const Json& record : merged.records) {
    if (!record.contains("sweep")) continue;
    const Json& sweep = record["sweep"];
    const bool upper = sweep["bound"] == "upper";
    std::vector<Cells> rows;
    for (const Json& c : sweep["coefficients"]) {
      const double bound = figure(c["bound_eps"].is_null() ? c["max_eps"] : c["bound_eps"]);
      const auto evaluated = c["evaluated"].get<std::uint64_t>();
      rows.push_back(
          {text_of(c, "name"), text_of(c, "equation"), text_of(c, "kind"), fmt::format("{}", evaluated),
           std::isfinite(bound) ? fmt::format("<b>{:.4f}</b>", upper ? std::ceil(bound * 1e4) / 1e4 : bound)
                                : "<b>NaN or Inf</b>",
           eps_text(c["documented_eps"]), status_text(c["status"]), text_of(c, "argument"), code(c["max_at"]),
           fmt::format("{:.9g}", c["max_at_decimal"].get<double>()),
           c["square_eps"] > 0 ? fmt::format("{:.2f}", c["square_eps"].get<double>()) : "—",
           text_of(c, "reason")});
    }
    out += table(
        upper ? fmt::format("Every float, in {:.0f} s: an upper bound of the error in {}, which includes the "
                            "error of the oracle",
                            sweep["elapsed"].get<double>(), sweep["scalar"].get<std::string>())
              : fmt::format("{}: the largest error found, a lower bound",
                            sweep["stride"] == 1 ? std::string("Interrupted")
                                                 : fmt::format("Every {}th float", dumped(sweep["stride"]))),
        {"coefficient", "equation", "error", "floats",
         upper ? "true upper bound [eps]" : "largest found [eps]", "documented [eps]", "status", "x", "at",
         "decimal", "from θ [eps]", "reason of the documented bound"},
        rows, true);
  }
  return out;
}

std::string bounds_section(const Merged& merged) {
  std::string out;
  for (const Json& record : merged.records) {
    if (!record.contains("bounds")) continue;
    std::vector<Cells> rows;
    for (const Json& b : record["bounds"]["operations"]) {
      const double proved = figure(b["bound_eps"]), hunted = b["hunted_eps"].get<double>();
      rows.push_back({text_of(b, "operation"), text_of(b, "block"), fmt::format("{:.2f}", hunted),
                      std::isfinite(proved) ? fmt::format("<b>{:.2f}</b>", std::ceil(proved * 100) / 100)
                                            : "<b>none yet</b>",
                      std::isfinite(proved) ? fmt::format("{:.2f}", proved / hunted) : "—",
                      eps_text(b["limit_eps"].get<double>()),
                      status_text(proved < hunted         ? "fail"
                                  : std::isfinite(proved) ? "pass"
                                                          : "incomplete"),
                      text_of(b, "inputs"), text_of(b, "widest"), dumped(b["boxes"])});
    }
    out += table("The largest error of whole operations in double [eps]",
                 {"operation", "block", "hunted: at least", "proved: at most", "proved / hunted", "limit",
                  "status", "proved for", "largest bound at", "boxes"},
                 rows, true);
  }
  return out;
}

}  // namespace liecheck::reports
