#include <store/comment.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <campaign/case_id.hpp>
#include <campaign/robots.hpp>
#include <campaign/selection.hpp>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <support/markdown.hpp>

namespace liecheck::properties {

namespace {

/// "phi = 0.1, 0, 0 [rad]; ..." of a generated case, whose input does not depend on the subject. Returns "" if the law is
/// not one of liecheck's, or has an input of many numbers.
std::string input_in_words(CaseId id) try {
  id.subject = "liecheck";
  const auto all = select({{id.subject}, {id.property}, {id.scalar}}, built_in_robot());
  if (all.empty() || all[0]->robot != id.robot) return "";
  const std::vector<std::string> numbers = all[0]->input(id);
  std::string text;
  std::size_t at = 0;
  for (const Field& f : all[0]->fields) {
    text += fmt::format("{}{} =", at == 0 ? "" : "; ", f.name);
    for (int i = 0; i < f.size; ++i, ++at)
      text += fmt::format("{} {:.6g}", i == 0 ? "" : ",", std::strtod(numbers.at(at).c_str(), nullptr));
    text += f.unit.empty() ? "" : fmt::format(" [{}]", f.unit);
  }
  return at == numbers.size() && at <= 24 ? text : "";
} catch (const std::exception&) {
  return "";
}

bool is_of_the_program(const std::string& subject) try {
  check_subjects({subject});
  return true;
} catch (const std::invalid_argument&) {
  return false;
}

/// A text that stops growing at a length.
class Comment {
 public:
  static constexpr std::size_t most = 60000;

  void line(const std::string& line) { text_ += line; }
  /// As many items as fit in a share of the length, between a head and a foot; "" if there are none.
  void list(const std::string& head, const std::vector<std::string>& items, const std::string& foot,
            double share, const char* and_more = "| and {} more | | | |\n") {
    constexpr std::size_t reserve = 400;  // of the words below
    const auto room = static_cast<std::size_t>(share * most) - reserve - foot.size();
    if (items.empty() || text_.size() + head.size() > room) return;
    text_ += head;
    std::size_t n = 0;
    while (n < items.size() && text_.size() + items[n].size() <= room) text_ += items[n++];
    if (n < items.size()) text_ += fmt::format(fmt::runtime(and_more), items.size() - n);
    text_ += foot;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string row_of(const Change& c) {
  return fmt::format("| `{}` {} | {} | {} | {} |\n", c.name[0], c.name[1], markdown(c.place()), c.name[2],
                     markdown(c.what));
}

std::string head_of(const char* title) {
  return fmt::format("| {} | operation, block, band | law | before → after |\n|---|---|---|---|\n", title);
}

std::vector<std::string> rows_of(const std::vector<Change>& all) {
  std::vector<std::string> rows;
  for (const Change& c : by_block(all)) rows.push_back(row_of(c));
  return rows;
}

std::string folded(const char* summary) {
  return fmt::format("<details><summary>{}</summary>\n\n", summary);
}

std::string cells(std::size_t n) {
  return n == 0 ? "nothing" : fmt::format("{} {}", n, n == 1 ? "cell" : "cells");
}

}  // namespace

std::string replay_of(const Change& change) {
  if (change.worst_case.empty()) return "";
  const std::string input = input_in_words(CaseId::parse(change.worst_case));
  return fmt::format("liecheck replay {}{}\n{}", change.worst_case,
                     is_of_the_program(change.name[0]) ? "" : " --adapter ADAPTER",
                     input.empty() ? "" : fmt::format("# {}\n", input));
}

std::vector<Change> by_block(const std::vector<Change>& changes) {
  std::vector<Change> all;
  std::vector<std::size_t> more;
  for (const Change& c : changes) {
    const auto at = std::ranges::find_if(all, [&](const Change& other) {
      return std::equal(c.name.begin(), c.name.end() - 1, other.name.begin());
    });
    if (at == all.end())
      all.push_back(c), more.push_back(0);
    else
      ++more[static_cast<std::size_t>(at - all.begin())];
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    if (more[i] > 0 && !all[i].name[5].empty()) all[i].name[5] += fmt::format(" and {} more", more[i]);
  return all;
}

std::string summary_of(const Comparison& all, std::size_t compared_cells,
                       const std::vector<std::string>& open) {
  const auto verb = [](std::size_t n, const char* one, const char* many) {
    return fmt::format("{} {}", cells(n), n < 2 ? one : many);
  };
  std::string text;
  for (const std::string& reason : open) text += fmt::format("incomplete: {}; ", reason);
  if (compared_cells == 0) return text + "nothing was compared";
  text += verb(all.worse.size(), "is worse", "are worse");
  if (!all.lost.empty()) text += fmt::format(", no longer measured: {}", fmt::join(all.lost, ", "));
  if (!all.gained.empty())
    text += fmt::format(", measured for the first time: {}", fmt::join(all.gained, ", "));
  if (!all.better.empty()) text += ", " + verb(all.better.size(), "is better", "are better");
  if (!all.other.empty()) text += ", " + verb(all.other.size(), "differs by less", "differ by less");
  return text;
}

std::string in_markdown(const Comparison& all, const CommentParts& parts) {
  Comment comment;
  comment.line(fmt::format("### liecheck: {}\n\n", markdown(summary_of(all, parts.cells, parts.open))));
  if (!parts.picture.empty())
    comment.line(fmt::format("![what got worse and better](<{}>)\n\n", parts.picture));
  comment.list(head_of("worse"), rows_of(all.worse), "\n", 0.6);
  constexpr std::size_t most_replays = 20;  // which are of the most important cells
  std::vector<std::string> replays;
  for (const Change& c : by_block(all.worse)) {
    if (replays.size() == most_replays) break;
    if (const std::string replay = replay_of(c); !replay.empty() && !std::ranges::count(replays, replay))
      replays.push_back(replay);
  }
  comment.list("The worst cases of these cells now:\n\n```sh\n", replays, "```\n\n", 0.7, "# and {} more\n");
  if (parts.times) {
    std::istringstream lines(in_markdown(*parts.times));
    std::vector<std::string> rows;
    for (std::string line; std::getline(lines, line);) rows.push_back(line + "\n");
    comment.list("", rows, "\n", 0.8, "| and {} more | | | | |\n");
  }
  const std::string end = "\n</details>\n\n";
  comment.list(folded("What got better") + head_of("better"), rows_of(all.better), end, 0.9);
  comment.list(folded("What differs by less, which fails nothing") + head_of("differs"), rows_of(all.other),
               end, 1);
  comment.line(fmt::format("Compared in {}; errors in eps of the scalar.\n", cells(parts.cells)));
  return comment.text();
}

}  // namespace liecheck::properties
