#include <fmt/format.h>

#include <cmath>
#include <reports/html.hpp>
#include <support/text.hpp>

namespace liecheck::reports {

std::string escaped(const std::string& text) {
  return properties::xml_escaped(text);
}

std::string eps_text(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return "Inf";
  return fmt::format("{:.3g}", value);
}

std::string time_text(double ns) {
  if (ns < 1000) return fmt::format("{:.3g} ns", ns);
  if (ns < 1e6) return fmt::format("{:.3g} µs", ns / 1e3);
  return ns < 1e9 ? fmt::format("{:.3g} ms", ns / 1e6) : fmt::format("{:.3g} s", ns / 1e9);
}

std::string table(const std::string& caption, const Cells& heads, const std::vector<Cells>& rows,
                  bool dense) {
  std::string out = fmt::format(
      "<div class=\"scroll{1}\" tabindex=\"0\" role=\"region\" aria-label=\"{0}\"><table>"
      "<caption>{0}</caption>\n<thead><tr>",
      escaped(caption), dense ? " dense" : "");
  for (const auto& head : heads) out += "<th scope=\"col\">" + head + "</th>";
  out += "</tr></thead>\n<tbody>\n";
  for (const Cells& row : rows) {
    out += "<tr><th scope=\"row\">" + row.front() + "</th>";
    for (std::size_t i = 1; i < row.size(); ++i) out += "<td>" + row[i] + "</td>";
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string code(const std::string& text) {
  return "<code>" + escaped(text) + "</code>";
}

std::string text_of(const Json& row, const char* name) {
  return escaped(row[name].get<std::string>());
}

std::string status_text(const std::string& status) {
  const bool colored = status == "pass" || status == "fail";
  return fmt::format("<span class=\"status{}\">{}</span>", colored ? " " + status : "", status);
}

}  // namespace liecheck::reports
