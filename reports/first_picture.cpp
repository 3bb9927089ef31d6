#include <fmt/format.h>

#include <algorithm>
#include <reports/drawing.hpp>
#include <reports/html.hpp>
#include <reports/picture.hpp>

namespace liecheck::reports {
namespace {

constexpr double wide = 1372, margin = 20, panel_wide = 312, panel_gap = 16;

/// The text of HTML without its elements; what stands between <span class="where"> and </span> is left out.
std::string without_elements(std::string html) {
  if (const auto from = html.find("<span class=\"where\">"); from != html.npos)
    html.erase(from, html.find("</span>") - from);
  for (auto from = html.find('<'); from != html.npos; from = html.find('<', from))
    html.erase(from, html.find('>', from) + 1 - from);
  return html;
}

/// Lines of at most `most` characters.
std::vector<std::string> lines_of(const std::string& text, std::size_t most) {
  std::vector<std::string> lines(1);
  for (std::size_t from = 0; from < text.size();) {
    const auto to = std::min(text.find(' ', from), text.size());
    if (!lines.back().empty() && lines.back().size() + 1 + to - from > most) lines.emplace_back();
    if (!lines.back().empty()) lines.back() += ' ';
    lines.back() += text.substr(from, to - from);
    from = to + 1;
  }
  return lines;
}

std::string label(double x, double y, const std::string& html, const char* kind) {
  return fmt::format("<text x=\"{:.4g}\" y=\"{:.4g}\" class=\"{}\">{}</text>\n", x, y, kind, html);
}

/// The height at which a picture is as wide as a panel.
double high_of(const std::string& picture) {
  const auto at = picture.find("viewBox=\"0 0 ");
  return at == picture.npos ? 0 : std::stod(picture.substr(picture.find(' ', at + 13))) * panel_wide / width;
}

/// A picture at a place of another one.
std::string placed(std::string picture, double x, double y) {
  const std::string start = "<svg class=\"picture\"";
  const double high = high_of(picture);
  picture.replace(
      0, start.size(),
      fmt::format("<svg class=\"picture\" x=\"{:.4g}\" y=\"{:.4g}\" width=\"{}\" height=\"{:.4g}\"", x, y,
                  panel_wide, high));
  return picture;
}

constexpr const char* style = R"(
text { font: 13px system-ui, "DejaVu Sans", Helvetica, sans-serif; fill: var(--ink); } .paper { fill: var(--paper); stroke: var(--rule); }
.title { font-size: 24px; font-weight: 700; } .head { font-size: 16px; font-weight: 600; } .note { font-size: 12px; fill: var(--soft); }
.caption { font-size: 12px; font-weight: 600; } .fail { fill: var(--bad); } .edge { fill: var(--edge); } .pass { fill: var(--good); })";

}  // namespace

std::string first_picture(const Merged& merged) {
  const Looks looks(merged);
  const FirstScreen screen = first_screen(looks);
  double y = 40;
  std::string out = label(margin, y, screen.title, fmt::format("title {}", screen.kind).c_str());
  for (const auto& [subject, kind, mark, words, headline] : screen.lines) {
    y += 24;
    out += label(margin, y, mark, kind.c_str());
    std::string look = swatch(looks.of.at(subject));
    look.replace(0, 4, fmt::format("<svg x=\"{}\" y=\"{:.4g}\"", margin + 18, y - 10));
    out += look + label(margin + 54, y, fmt::format("{} {}", escaped(subject), without_elements(words)), "");
  }
  y += 36;
  const auto across = [](const FirstScreen::Question& q) {
    return static_cast<double>(q.pictures.size()) * (panel_wide + panel_gap);
  };
  std::vector<std::vector<std::string>> answers;
  std::size_t most = 0;
  for (const auto& q : screen.questions) {
    answers.push_back(lines_of(without_elements(q.answer), static_cast<std::size_t>(across(q) / 6.7)));
    most = std::max(most, answers.back().size());
  }
  const double pictures = y + 36 + 16 * static_cast<double>(most);
  double x = margin, end = y;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const auto& q = screen.questions[i];
    out += label(x, y, q.words, "head");
    double down = y + 4, at = x;
    for (const std::string& line : answers[i]) out += label(x, down += 16, line, "note");
    for (const auto& [head, picture] : q.pictures) {
      if (picture.empty()) continue;
      out += label(at + 8, pictures - 8, head, "caption") + placed(picture, at, pictures);
      end = std::max(end, pictures + high_of(picture));
      at += panel_wide + panel_gap;
    }
    x += across(q) + panel_gap;
  }
  const double high = end + margin;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1:.0f}\" viewBox=\"0 0 {0} "
      "{1:.0f}\" role=\"img\">\n"
      "<title>The first screen of a report: {2}</title>\n<desc>Digest of the inputs: "
      "{3}</desc>\n<style>{4}{5}</style>\n"
      "<rect class=\"paper\" x=\".5\" y=\".5\" width=\"{6}\" height=\"{7:.0f}\" rx=\"6\"/>\n{8}</svg>\n",
      wide, high, screen.title, text_of(merged.records.front()["digest"], "inputs"),
      embedded_file("picture.css"), style, wide - 1, high - 1, out);
}

}  // namespace liecheck::reports
