#include <reports/league.hpp>

#include <reports/record.hpp>

namespace liecheck::reports {

namespace {

/// Puts `with` where the page has the slot.
void fill(std::string& page, const std::string& slot, const std::string& with) {
  const auto at = page.find(slot);
  if (at == page.npos) throw std::logic_error("league.html has no slot " + slot);
  page.replace(at, slot.size(), with);
}

}  // namespace

std::string league_page(nlohmann::json record) {
  escape_texts(record);
  std::string page(embedded_file("league.html")), numbers = dumped(record);
  for (auto at = numbers.find('<'); at != numbers.npos; at = numbers.find('<', at + 6))
    numbers.replace(at, 1, "\\u003c");  // no text of a library ends the script
  fill(page, "{{style}}", std::string(embedded_file("league.css")));
  fill(page, "{{script}}", std::string(embedded_file("league.js")));
  fill(page, "{{numbers}}", numbers);
  return page;
}

}  // namespace liecheck::reports
