#include <adapters/noise.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <cstdio>
#include <map>
#include <mutex>
#include <sstream>
#include <support/text.hpp>
#include <vector>

namespace liecheck::properties::adapters {
namespace {

constexpr int most_lines = 20;

std::mutex mutex;
std::map<std::string, int> failures;  ///< by "subject: operation: how"
int lines = 0;

void say(const std::string& line) {
  std::fputs((printable(line) + "\n").c_str(), stderr);
}

std::string last_line(const std::string& text) {
  const auto end = text.find_last_not_of("\n ");
  if (end == text.npos) return "";
  const auto start = text.rfind('\n', end);
  return text.substr(start == text.npos ? 0 : start + 1, end - (start == text.npos ? 0 : start + 1) + 1);
}

}  // namespace

void say_failed(const std::string& subject, std::string_view operation, const std::string& how,
                const std::string& errors) {
  const std::lock_guard lock(mutex);
  const std::string kind = fmt::format("{}: {}: {}", subject, operation, how);
  if (++failures[kind] > 1) return;
  const std::string last = last_line(errors);
  say(last.empty() ? kind : fmt::format("{}; its last words: {}", kind, last.substr(0, 200)));
}

void say_not_repeatable(const std::string& subject, std::string_view operation, const std::string& which) {
  const std::lock_guard lock(mutex);
  const std::string kind = fmt::format("{}: {}: not repeatable", subject, operation);
  if (++failures[kind] == 1) say(fmt::format("{}: {}", kind, which));
}

void pass_on(const std::string& errors) {
  const std::lock_guard lock(mutex);
  std::istringstream text(errors);
  std::vector<std::string> all;
  for (std::string line; std::getline(text, line);) all.push_back(line);
  const int left = std::max(0, most_lines - lines), own = static_cast<int>(all.size());
  for (int i = std::max(0, own - left); i < own; ++i) say(all[static_cast<std::size_t>(i)]);
  lines += own;
}

void say_counts() {
  const std::lock_guard lock(mutex);
  for (const auto& [kind, count] : failures)
    if (count > 1) say(fmt::format("{}: {} times", kind, count));
  if (lines > most_lines) say(fmt::format("and {} more lines of adapters", lines - most_lines));
  failures.clear(), lines = 0;
}

}  // namespace liecheck::properties::adapters
