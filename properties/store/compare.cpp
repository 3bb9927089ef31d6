#include <store/compare.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <campaign/case_id.hpp>
#include <campaign/cliffs.hpp>
#include <set>
#include <stdexcept>
#include <store/row_changes.hpp>
#include <support/progress.hpp>
#include <tuple>

namespace liecheck::properties {

namespace {

using Name = std::array<std::string, 6>;
using BlockName = std::array<std::string, 5>;

BlockName block_of(const Name& n) {
  return {n[0], n[1], n[2], n[3], n[4]};
}

/// What judges the rows of a stored series. The program need not have its subject.
class Terms {
 public:
  Terms(const StoredCampaign& c, const StoredSeries& s)
      : bands_(Bands::of(oracles::scalar_named(s.scalar))),
        eps_(oracles::scalar_named(s.scalar).epsilon),
        table_(budgets(s.subject, profile_named(s.profile).value_or(Profile::careful), eps_)) {
    for (const auto& limits : c.spec.limits)
      if (limits->subject == s.subject) own_ = limits.get(), table_ = with_own_limits(table_, limits->lines);
  }
  const Bands& bands() const { return bands_; }

  /// Null if the budget table has no such line.
  const Budget* budget(const Label& l, Region region) const {
    const char* const name = region == Region::to_pi ? "to_pi" : "beyond_pi";
    const auto at = std::ranges::find_if(table_, [&](const Budget& b) {
      return b.operation == l.operation && b.block == l.block && (b.region == "any" || b.region == name);
    });
    return at == table_.end() ? nullptr : &*at;
  }
  bool expects(const Label& l, const Band& band) const {
    return own_ && std::ranges::any_of(own_->expected, [&](const ExpectedFailure& e) {
             return e.operation == l.operation && e.block == l.block && e.inputs.has(band);
           });
  }
  RowTerms of(const Label& l) const {
    const auto band = std::ranges::find(bands_.all(), l.band, &Band::name);
    RowTerms terms{.eps = eps_};
    if (band == bands_.all().end()) return terms;
    if (const Budget* b = budget(l, band->region)) terms.limit = b->limit, terms.rule = b->rule;
    terms.expected = expects(l, *band);
    return terms;
  }

 private:
  const Bands& bands_;
  double eps_;
  std::vector<Budget> table_;
  const SubjectLimits* own_ = nullptr;
};

struct Measured {
  const StoredSeries* series = nullptr;
  const Row* row = nullptr;
};

/// The bands of one block together: a change that is too small for the few cases of a band may show here.
struct Pooled {
  Measured worst;  ///< with the row of the worst band
  std::string band;
  Row row;  ///< of the bands where no failure is expected
};

/// A campaign by the names of its cells.
struct Side {
  const StoredCampaign& campaign;
  std::map<Name, Measured> cells;
  std::map<BlockName, Pooled> blocks;
  std::map<const StoredSeries*, Terms> terms;
  std::map<Name, double> cliffs;  ///< how many times the reference; none that is expected

  Side(const StoredCampaign& c, Counted& shown) : campaign(c) {
    for (const StoredSeries& s : c.series) {
      const Terms& t = terms.try_emplace(&s, c, s).first->second;
      for (const auto& [cell, row] : s.tally.rows) {
        shown.next();
        const Label& l = s.labels.at(cell);
        const Name name{s.subject, s.scalar, s.property, l.operation, l.block, l.band};
        cells[name] = {&s, &row};
        Pooled& p = blocks[block_of(name)];
        const bool counts = !t.of(l).expected;
        if (!p.worst.row || (counts && row.worst_score > p.worst.row->worst_score))
          p.worst = {&s, &row}, p.band = l.band;
        if (counts) p.row.merge(row);
      }
      add_cliffs(s, t);
    }
  }
  /// Whether it has a cell of this subject, scalar and operation; "" stands for any.
  bool offers(const std::string& subject, const std::string& scalar, const std::string& operation) const {
    return std::ranges::any_of(blocks, [&](const auto& one) {
      const BlockName& b = one.first;
      return b[0] == subject && (scalar.empty() || b[1] == scalar) &&
             (operation.empty() || b[3] == operation);
    });
  }
  std::uint64_t failed_in(const Name& name) const {
    const auto at = blocks.find(block_of(name));
    return at == blocks.end() ? 0 : at->second.row.failed;
  }

 private:
  void add_cliffs(const StoredSeries& s, const Terms& t) {
    std::map<std::size_t, Label> outputs;
    std::size_t count = 0;
    for (const auto& [cell, label] : s.labels) {
      const auto output = static_cast<std::size_t>(cell.first), band = static_cast<std::size_t>(cell.second);
      if (band >= t.bands().all().size()) return;  // of another generator
      outputs[output] = label, count = std::max(count, output + 1);
    }
    const CliffTerms rules{count, t.bands(),
                           [&](std::size_t output, Region region) {
                             const Budget* b = t.budget(outputs.at(output), region);
                             return b ? b->rule : Rule::forward;
                           },
                           [&](std::size_t output, std::size_t band) {
                             const auto at = outputs.find(output);
                             return at != outputs.end() && t.expects(at->second, t.bands()[band]);
                           }};
    for (const Cliff& c : cliffs_of(rules, s.tally.rows))
      if (!c.expected)
        cliffs[{s.subject, s.scalar, s.property, outputs[c.output].operation, outputs[c.output].block,
                t.bands()[c.band].name}] = c.ratio();
  }
};

/// The ID of the worst case of a cell, or "" if the case cannot be replayed without more flags.
std::string worst_case(const StoredCampaign& c, const Measured& m) {
  if (!m.row || m.row->judged() == 0 || !c.spec.robot.path.empty()) return "";
  const StoredSeries& s = *m.series;
  return CaseId{false, c.spec.seed, s.property, s.subject, s.scalar, s.robot, m.row->worst_index, {}}.text();
}

bool same_inputs(const Measured& a, const Measured& b) {
  return a.series->tally.inputs.sum() == b.series->tally.inputs.sum();
}

/// By cell.
using Differences = std::map<Name, std::vector<Difference>>;

bool in_own_terms(const Difference& d) {
  return d.gravity != Gravity::by_little;
}

/// The new cliff of a block. Where a band had too few cases for a verdict, there is none that is new.
void add_cliffs(const Side& from, const Side& to, bool back, Differences& all) {
  for (const auto& [name, ratio] : to.cliffs) {
    const bool known = std::ranges::any_of(
        from.cliffs, [&, &n = name](const auto& cliff) { return block_of(cliff.first) == block_of(n); });
    const auto was = from.cells.find(name);
    if (known || was == from.cells.end()) continue;
    const Measured &old = was->second, &now = to.cells.at(name);
    const Rule rule = to.terms.at(now.series).of({name[3], name[4], name[5]}).rule;
    const double before = cliff_figure(*old.row, rule);
    if (before > 0 && cliff_figure(*now.row, rule) > 2 * before)
      all[name].push_back(
          {before_after("cliff", "none", fmt::format("{:.1g} times its error elsewhere", ratio), back),
           Gravity::cliff, ratio});
  }
}

/// What is worse in `to` than in `from`, of which `to` is the earlier one if `back`.
Differences differences(const Side& from, const Side& to, bool back) {
  Differences all;
  const char* const gone = back ? "measured for the first time" : "no longer measured";
  for (const auto& [name, old] : from.cells) {
    const auto found = to.cells.find(name);
    const bool known = to.blocks.contains(block_of(name));
    if (found == to.cells.end()) {
      if (known && same_inputs(old, to.blocks.at(block_of(name)).worst)) all[name].push_back({gone});
      continue;
    }
    RowTerms terms = to.terms.at(found->second.series).of({name[3], name[4], name[5]});
    terms.failed_before = from.failed_in(name) > 0;
    const auto worse = worse_rows(*old.row, *found->second.row, terms, same_inputs(old, found->second), back);
    if (!worse.empty()) all[name] = worse;
  }
  add_cliffs(from, to, back, all);
  for (const auto& [block, is] : to.blocks) {
    const auto old = from.blocks.find(block);
    Name name{block[0], block[1], block[2], block[3], block[4], "all bands"};
    if (old == from.blocks.end()) {
      if (!back && is.row.failed > 0)
        all[name].push_back({fmt::format("failed: not measured → {} of {}", is.row.failed, is.row.judged()),
                             Gravity::crossed, 0});
      continue;
    }
    if (same_inputs(old->second.worst, is.worst)) continue;
    // What the bands alone show is not said again.
    Gravity seen = Gravity::by_little;
    bool any = false;
    for (auto at = all.lower_bound({block[0], block[1], block[2], block[3], block[4], ""});
         at != all.end() && block_of(at->first) == block; ++at)
      for (const Difference& d : at->second) any = true, seen = std::max(seen, d.gravity);
    RowTerms terms = to.terms.at(is.worst.series).of({block[3], block[4], is.band});
    terms.failed_before = old->second.row.failed > 0, terms.expected = false;
    for (const Difference& d : worse_rows(old->second.row, is.row, terms, false, back))
      if (!any || d.gravity > seen) all[name].push_back(d);
  }
  for (const auto& [block, old] : from.blocks)
    if (!to.blocks.contains(block) && (!back || old.row.failed == 0))
      all[{block[0], block[1], block[2], block[3], block[4], "all bands"}].push_back({gone});
  return all;
}

/// Cases in which the fast oracle disagrees with the slow one fail a campaign.
void add_disagreements(const Side& from, const Side& to, bool back, Differences& all) {
  std::map<Name, std::size_t> before;
  for (const StoredSeries& s : from.campaign.series)
    before[{s.subject, s.scalar, s.property}] = s.tally.disagreed.size();
  for (const StoredSeries& s : to.campaign.series) {
    const Name name{s.subject, s.scalar, s.property};
    const std::size_t was = before[name], is = s.tally.disagreed.size();
    if (std::ranges::any_of(s.tally.rows, [](const auto& cell) { return cell.second.not_repeatable > 0; }))
      continue;  // the two oracles were given different results
    if (is > was)
      all[name].push_back({before_after("cases in which the fast oracle disagrees with the slow one",
                                        fmt::format("{}", was), fmt::format("{}", is), back),
                           was == 0 ? Gravity::crossed : Gravity::by_little, 0});
  }
}

/// What was found beside the cases in `to` and not in `from`.
void add_beside_cases(const Side& from, const Side& to, bool back, Differences& all) {
  const BesideCases &was = from.campaign.spec.beside, &is = to.campaign.spec.beside;
  constexpr double before_all_cells = 2;
  for (const ProbedOperation& o : is.probed) {
    const auto same = [&](const ProbedOperation& p) {
      return p.subject == o.subject && p.operation == o.operation;
    };
    if (!from.offers(o.subject, "", o.operation) || std::ranges::any_of(was.probed, same)) continue;
    all[{o.subject, "", "", o.operation}].push_back(
        {before_after(o.wrong ? "probe" : "judged", o.wrong ? "right" : "yes",
                      (o.wrong ? "wrong: " : "no: ") + o.sentence, back),
         Gravity::broken, before_all_cells});
  }
  if (was.corpus.empty() || was.corpus != is.corpus) return;
  for (const FailedHardCase& f : is.failed) {
    const auto same = [&](const FailedHardCase& h) {
      return h.subject == f.subject && h.scalar == f.scalar && h.name == f.name && h.operation == f.operation;
    };
    if (from.offers(f.subject, f.scalar, "") && std::ranges::none_of(was.failed, same))
      all[{f.subject, f.scalar, "", f.operation, f.block, "hard case " + f.name}].push_back(
          {before_after("verdict", "passed", f.verdict, back), Gravity::crossed, 0});
  }
}

/// What `from` measures and `to` does not, in words.
std::vector<std::string> only_in(const Side& from, const Side& to) {
  std::vector<std::string> all;
  for (const auto& [block, pooled] : from.blocks) {
    const auto& [subject, scalar, property, operation, name] = block;
    const std::string what = !to.offers(subject, "", "")          ? subject
                             : !to.offers(subject, scalar, "")    ? scalar
                             : !to.offers(subject, "", operation) ? operation
                                                                  : "";
    if (!what.empty() && std::ranges::find(all, what) == all.end()) all.push_back(what);
  }
  return all;
}

/// Sorts the differences of each cell and the cells, the most important first.
std::vector<Change> listed(const Differences& all, const Side& after) {
  struct Listed {
    std::vector<Difference> differences;
    Change change;
    const Difference& first() const { return differences.front(); }
  };
  const auto before = [](const Difference& a, const Difference& b) {
    return std::tuple(b.gravity, b.size) < std::tuple(a.gravity, a.size);
  };
  std::vector<Listed> cells;
  for (const auto& [name, differences] : all) {
    Listed& l = cells.emplace_back(Listed{differences, {name, "", ""}});
    std::ranges::stable_sort(l.differences, before);
    for (const Difference& d : l.differences) l.change.what += (l.change.what.empty() ? "" : "; ") + d.what;
    if (const auto cell = after.cells.find(name); cell != after.cells.end())
      l.change.worst_case = worst_case(after.campaign, cell->second);
    else if (const auto block = after.blocks.find(block_of(name)); block != after.blocks.end())
      l.change.worst_case = worst_case(after.campaign, block->second.worst);
  }
  std::ranges::stable_sort(cells,
                           [&](const Listed& a, const Listed& b) { return before(a.first(), b.first()); });
  std::vector<Change> changes;
  for (Listed& l : cells) changes.push_back(std::move(l.change));
  return changes;
}

}  // namespace

std::size_t cells_in_both(const StoredCampaign& a, const StoredCampaign& b) {
  const auto judged = [](const StoredCampaign& c) {
    std::set<Name> names;
    for (const StoredSeries& s : c.series)
      for (const auto& [cell, row] : s.tally.rows)
        if (const Label& l = s.labels.at(cell); row.judged() > 0)
          names.insert({s.subject, s.scalar, s.property, l.operation, l.block, l.band});
    return names;
  };
  const std::set<Name> before = judged(a);
  return static_cast<std::size_t>(
      std::ranges::count_if(judged(b), [&](const Name& name) { return before.contains(name); }));
}

std::string Change::place() const {
  std::vector<std::string> all(name.begin() + 3, name.end());
  std::erase(all, "");
  return fmt::format("{}", fmt::join(all, ", "));
}

std::string Change::text() const {
  std::vector<std::string> all(name.begin(), name.begin() + 3);
  std::erase(all, "");
  return fmt::format("{}{}{}: {}", fmt::join(all, " "), name[3].empty() ? "" : ": ", place(), what);
}

Comparison compared(const StoredCampaign& a, const StoredCampaign& b, bool strict) {
  if (const std::string limits = differences_of_limits(a.spec, b.spec); !limits.empty())
    throw std::invalid_argument("verdicts by different limits cannot be compared: " + limits);
  if (const std::string profiles = differences_of_profiles(a, b); !profiles.empty())
    throw std::invalid_argument("verdicts by different profiles cannot be compared: " + profiles);
  Counted shown("comparing", "cells");
  const Side before(a, shown), after(b, shown);
  Differences worse, better, other;
  for (const bool back : {false, true}) {
    const Side &from = back ? after : before, &to = back ? before : after;
    Differences all = differences(from, to, back);
    add_disagreements(from, to, back, all);
    add_beside_cases(from, to, back, all);
    for (auto& [name, some] : all) {
      const bool counts = strict || std::ranges::any_of(some, in_own_terms);
      auto& list = (!counts ? other : back ? better : worse)[name];
      list.insert(list.end(), some.begin(), some.end());
    }
  }
  Comparison result{listed(worse, after),   listed(better, after),  listed(other, after),
                    only_in(before, after), only_in(after, before), {}};
  for (const ProbedOperation& o : b.spec.beside.probed)
    if (!o.wrong && !before.offers(o.subject, "", o.operation) &&
        std::ranges::find(result.unjudged, o.sentence) == result.unjudged.end())
      result.unjudged.push_back(o.sentence);
  return result;
}

}  // namespace liecheck::properties
