#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <campaign/case_id.hpp>
#include <campaign/robots.hpp>
#include <campaign/selection.hpp>
#include <cmath>
#include <cstdlib>
#include <set>
#include <stdexcept>
#include <store/merge.hpp>
#include <store/sampling.hpp>
#include <support/markdown.hpp>
#include <support/progress.hpp>

namespace liecheck::properties {

namespace {

using Name = std::array<std::string, 6>;

struct Measured {
  const StoredSeries* series;
  const Row* row;
};

std::map<Name, Measured> by_name(const StoredCampaign& c, Counted& cells) {
  std::map<Name, Measured> all;
  for (const StoredSeries& s : c.series)
    for (const auto& [cell, row] : s.tally.rows) {
      const Label& l = s.labels.at(cell);
      all[{s.subject, s.scalar, s.property, l.operation, l.block, l.band}] = {&s, &row};
      cells.next();
    }
  return all;
}

/// The ID of the worst case of a cell, or "" if the case cannot be replayed without more flags.
std::string worst_case(const StoredCampaign& c, const Measured& m) {
  const StoredSeries& s = *m.series;
  if (m.row->judged() == 0 || !c.spec.robot.path.empty()) return "";
  return CaseId{false, c.spec.seed, s.property, s.subject, s.scalar, s.robot, m.row->worst_index, {}}.text();
}

/// Whether the operation's block is measured in any band.
bool measured(const std::map<Name, Measured>& all, const Name& n) {
  Name first = n;
  first[5] = "";
  const auto at = all.lower_bound(first);
  return at != all.end() && std::equal(n.begin(), n.begin() + 5, at->first.begin());
}

/// The bands of one block together: a change that is too small for the few cases of a band may show here.
struct Pooled {
  Measured worst;  ///< with the row of the worst band
  Row row;
};
std::map<Name, Pooled> pooled(const std::map<Name, Measured>& cells, Counted& shown) {
  std::map<Name, Pooled> all;
  for (const auto& [name, m] : cells) {
    shown.next();
    Name block = name;
    block[5] = "all bands";
    Pooled& p = all[block];
    if (!p.worst.row || m.row->worst_score > p.worst.row->worst_score) p.worst = m;
    p.row.merge(*m.row);
  }
  return all;
}

/// Adds the blocks that are worse in all bands together, but in none of them alone.
void add_pooled(std::vector<Change>& all, const StoredCampaign& b, const std::map<Name, Measured>& before,
                const std::map<Name, Measured>& after, Counted& cells) {
  std::set<Name> alone;
  for (Change c : all) c.name[5] = "all bands", alone.insert(c.name);
  const auto was = pooled(before, cells);
  for (const auto& [name, is] : pooled(after, cells)) {
    const auto old = was.find(name);
    if (old == was.end() || alone.contains(name) ||
        old->second.worst.series->tally.inputs.sum() == is.worst.series->tally.inputs.sum())
      continue;
    for (const std::string& what : worse_by_more_than_chance(old->second.row, is.row))
      all.push_back({name, what, worst_case(b, is.worst)});
  }
}

}  // namespace

std::size_t cells_in_both(const StoredCampaign& a, const StoredCampaign& b) {
  Counted cells("comparing", "cells");
  const auto after = by_name(b, cells);
  std::size_t n = 0;
  for (const auto& [name, old] : by_name(a, cells)) {
    cells.next();
    const auto found = after.find(name);
    n += found != after.end() && old.row->judged() > 0 && found->second.row->judged() > 0;
  }
  return n;
}

std::vector<Change> changes(const StoredCampaign& a, const StoredCampaign& b) {
  if (const std::string limits = differences_of_limits(a.spec, b.spec); !limits.empty())
    throw std::invalid_argument("verdicts by different limits cannot be compared: " + limits);
  if (const std::string profiles = differences_of_profiles(a, b); !profiles.empty())
    throw std::invalid_argument("verdicts by different profiles cannot be compared: " + profiles);
  Counted cells("comparing", "cells");
  const auto before = by_name(a, cells), after = by_name(b, cells);
  std::vector<Change> all;
  for (const StoredSeries& s : b.series) {
    const auto same = std::find_if(a.series.begin(), a.series.end(), [&](const StoredSeries& o) {
      return o.subject == s.subject && o.scalar == s.scalar && o.property == s.property;
    });
    const std::size_t was = same == a.series.end() ? 0 : same->tally.disagreed.size();
    if (s.tally.disagreed.size() > was)
      all.push_back({{s.subject, s.scalar, s.property},
                     fmt::format("the fast oracle disagrees with the slow one in {} cases, was {}",
                                 s.tally.disagreed.size(), was),
                     ""});
  }
  for (const auto& [name, old] : before) {
    cells.next();
    const auto found = after.find(name);
    const auto say = [&, &n = name](const std::string& what) {
      all.push_back({n, what, found == after.end() ? "" : worst_case(b, found->second)});
    };
    if (found == after.end()) {
      const bool same = std::any_of(b.series.begin(), b.series.end(), [&](const StoredSeries& s) {
        return s.subject == old.series->subject && s.scalar == old.series->scalar &&
               s.property == old.series->property && s.tally.inputs.sum() == old.series->tally.inputs.sum();
      });
      if (same || !measured(after, name)) say("no longer measured");
      continue;
    }
    const Row &was = *old.row, &is = *found->second.row;
    const bool same_inputs = old.series->tally.inputs.sum() == found->second.series->tally.inputs.sum();
    if (!same_inputs) {  // these may be the reason for a difference
      for (const std::string& what : worse_by_more_than_chance(was, is)) say(what);
      continue;
    }
    const auto grew = [&](const char* what, std::uint64_t from, std::uint64_t to) {
      if (to > from)
        say(fmt::format("{} {} of {} cases, were {} of {}", what, to, is.count, from, was.count));
    };
    grew("failed", was.failed, is.failed);
    grew("outside the domain", was.outside_domain, is.outside_domain);
    grew("unresolved", was.unresolved, is.unresolved);
    grew("unmeasured", was.unmeasured, is.unmeasured);
    grew("ill-posed", was.ill_posed, is.ill_posed);
    if (is.count < was.count) say(fmt::format("measured {} times, were {}", is.count, was.count));
    // Under the excess rule only error / kappa is comparable.
    const bool excess = was.max_excess > 0 || is.max_excess > 0;
    const double from = excess ? was.max_excess : was.max_error, to = excess ? is.max_excess : is.max_error;
    if (grown(from, to))
      say(fmt::format("largest {} {:.4g} (case {}), was {:.4g} (case {})",
                      excess ? "excess [eps kappa]" : "error [eps]", to, is.worst_index, from,
                      was.worst_index));
  }
  add_pooled(all, b, before, after, cells);
  return all;
}

std::string Change::text() const {
  std::string cell = fmt::format("{} {} {}", name[0], name[1], name[2]);
  if (!name[3].empty()) cell += fmt::format(": {}, {}, {}", name[3], name[4], name[5]);
  return cell + ": " + what;
}

std::vector<std::string> worse(const StoredCampaign& a, const StoredCampaign& b) {
  std::vector<std::string> lines;
  for (const Change& c : changes(a, b)) lines.push_back(c.text());
  return lines;
}

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

}  // namespace

std::string replay_of(const Change& change) {
  if (change.worst_case.empty()) return "";
  const std::string input = input_in_words(CaseId::parse(change.worst_case));
  return fmt::format("liecheck replay {}{}\n{}", change.worst_case,
                     is_of_the_program(change.name[0]) ? "" : " --adapter ADAPTER",
                     input.empty() ? "" : fmt::format("# {}\n", input));
}

std::string in_markdown(const StoredCampaign& a, const StoredCampaign& b, const std::string& picture) {
  const auto got_worse = changes(a, b), got_better = changes(b, a);
  const auto count = [](const std::vector<Change>& all) {
    std::set<Name> cells;
    for (const Change& c : all) cells.insert(c.name);
    const std::size_t n = cells.size();
    return n == 0 ? std::string("nothing") : fmt::format("{} {}", n, n == 1 ? "cell" : "cells");
  };
  std::string text =
      fmt::format("### liecheck: {} worse, {} better\n\n", count(got_worse), count(got_better));
  if (!picture.empty()) text += fmt::format("![what got worse and better](<{}>)\n\n", picture);
  const auto table = [&](const char* title, const std::vector<Change>& all) {
    if (all.empty()) return;
    text += fmt::format("| {} | operation, block, band | law | what |\n|---|---|---|---|\n", title);
    for (const Change& c : all)
      text += fmt::format("| `{}` {} | {} | {} | {} |\n", c.name[0], c.name[1],
                          c.name[3].empty() ? ""
                                            : fmt::format("`{}`, {}, {}", c.name[3], markdown(c.name[4]),
                                                          markdown(c.name[5])),
                          c.name[2], markdown(c.what));
    text += "\n";
  };
  table("worse", got_worse);
  std::string replays;
  std::set<std::string> known = {""};
  Counted cells("drawing the worst cases", "cells", 16);
  for (const Change& c : got_worse) {
    cells.next();
    if (const std::string replay = replay_of(c); known.insert(replay).second) replays += replay;
  }
  if (!replays.empty())
    text += fmt::format("The worst cases of these cells now:\n\n```sh\n{}```\n\n", replays);
  if (!got_better.empty()) {
    text += "<details><summary>What got better, with before and after exchanged</summary>\n\n";
    table("better", got_better);
    text += "</details>\n\n";
  }
  return text + fmt::format("Compared in {} cells; errors in eps of the scalar.\n", cells_in_both(a, b));
}

}  // namespace liecheck::properties
