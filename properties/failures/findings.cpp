#include <failures/findings.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <failures/calls.hpp>
#include <failures/causes.hpp>
#include <failures/result.hpp>
#include <failures/tree_causes.hpp>
#include <functional>
#include <invariants/tree_laws.hpp>
#include <map>
#include <set>
#include <support/stop.hpp>
#include <tuple>

namespace liecheck::properties {

namespace {

/// Blocks of one operation in every scalar, with what they come from.
struct Group {
  std::vector<FailedBlock*> blocks;                       ///< by scalar
  std::optional<std::size_t> cause;                       ///< another group
  std::map<std::size_t, std::set<std::size_t>> of_bands;  ///< bands that another group's operation explains
  std::vector<Beside> beside;
};
using BlockKey = std::tuple<std::string, std::string, std::string>;  ///< subject, operation, block

/// Whether a band of ordinary angles fails.
bool fails_ordinarily(const BandOf& b) {
  return b.fails && is_ordinary(b.series->bands()[b.band]);
}

/// Up to three failing bands, from the first to the last, whose worst case has a result: those of ordinary angles if there
/// are any.
std::vector<const BandOf*> examples_of(const FailedBlock& f) {
  std::vector<const BandOf*> all;
  const bool ordinary = std::ranges::any_of(f.bands, fails_ordinarily);
  for (const BandOf& b : f.bands)
    if ((ordinary ? fails_ordinarily(b) : b.fails) && b.row->crashed == 0 && b.row->refused == 0)
      all.push_back(&b);
  if (all.size() <= 3) return all;
  return {all.front(), all[all.size() / 2], all.back()};
}

/// The largest error of a number of a call's result, over the largest number; 0 if the call has no result that is known.
double relative_error(const NotedCall& call) {
  const auto exact = expected_of(call);
  if (!call.thrown.empty() || exact.size() != call.result.size()) return 0;
  double error = 0, largest = std::numeric_limits<double>::min();
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const auto right = static_cast<double>(exact[i]);
    if (!std::isfinite(call.result[i])) return std::numeric_limits<double>::infinity();
    error = std::max(error, std::fabs(call.result[i] - right)), largest = std::max(largest, std::fabs(right));
  }
  return error / largest;
}

/// The operations whose own errors explain the worst case of a band, or of the calls of which a result is formed those that are
/// wrong; none if the band has no such case.
std::optional<std::vector<std::string_view>> causes_in(const BandOf& b, std::uint64_t seed,
                                                       const std::set<std::string_view>& wrong) try {
  const Output& output = b.series->outputs.at(b.output);
  const NotedCase all = noted(*b.series, b.series->id(seed, b.row->worst_index), b.output);
  const NotedCall* call = worst_call(output, all);
  if (!call || !call->thrown.empty() || !all.compared.exact.empty()) return std::nullopt;
  std::vector<std::string_view> parts;
  if (call->operation == output.record)
    parts = explained_by(*b.series, output, *call);
  else
    for (const NotedCall& one : all.calls)
      if (relative_error(one) > 100 * b.series->eps) parts.push_back(one.operation->name);
  std::erase_if(parts, [&](std::string_view part) { return !wrong.contains(part); });
  return parts;
} catch (const GivenUp&) {  // a signal ended a call
  return std::nullopt;
}

/// The operations whose own errors explain those of a block, with the number of its examples that each explains, if
/// together they explain two examples of three.
std::map<std::string_view, std::size_t> causes_of(const FailedBlock& f, std::uint64_t seed,
                                                  const std::set<std::string_view>& wrong) {
  std::map<std::string_view, std::size_t> votes;
  if (f.block == "sign") return votes;  // which compares with the call before
  std::size_t explained = 0, examples = 0;
  for (const BandOf* b : examples_of(f)) {
    const auto parts = stop_requested ? std::nullopt : causes_in(*b, seed, wrong);
    if (!parts) return {};
    ++examples, explained += !parts->empty();
    for (const std::string_view part : *parts) ++votes[part];
  }
  return 3 * explained >= 2 * examples ? votes : std::map<std::string_view, std::size_t>();
}

/// Whether a block follows from another one of its operation: the linear part of a logarithm from the angular one.
bool follows_within(const std::string& block) {
  return block == "linear" || block == "translation" || block == "coupling";
}

/// Whether a block says how a result is wrong of which another block judges the value.
bool is_symptom(const std::string& block) {
  return block == "jump" || block == "twist" || block.ends_with("defect");
}

/// Adds each hard case that fails to the finding of its block or operation; returns the findings of the others.
std::map<BlockKey, Finding> add_hard_cases(const std::vector<HardRow>& hard_cases,
                                           std::map<std::size_t, Finding>& by_root) {
  std::map<BlockKey, Finding*> of_block;
  std::map<BlockKey, Finding> hard_only;
  for (auto& [first, finding] : by_root)
    for (const auto* list : {&finding.own, &finding.others})
      for (const FailedBlock* f : *list) of_block[{f->subject, f->operation, f->block}] = &finding;
  for (const HardRow& row : hard_cases)
    for (const HardCell& cell : row.cells) {
      if (!cell.failed) continue;
      const BlockKey key{cell.subject, cell.operation, cell.block};
      auto at = of_block.find(key);
      if (at == of_block.end())  // another block of the operation
        at = std::ranges::find_if(of_block, [&](const auto& one) {
          return std::get<0>(one.first) == cell.subject && std::get<1>(one.first) == cell.operation;
        });
      Finding& finding = at != of_block.end() ? *at->second : hard_only[key];
      if (finding.subject.empty()) finding.subject = cell.subject, finding.operation = cell.operation;
      finding.hard_rows.push_back(&row), finding.hard_cells.push_back(&cell);
    }
  return hard_only;
}

/// The failed blocks of a campaign in groups, and which group causes which.
class Groups {
 public:
  Groups(std::vector<FailedBlock>& failed, std::uint64_t seed) : seed_(seed) {
    for (FailedBlock& f : failed) {
      const BlockKey key{f.subject, f.operation, f.block};
      const auto at = static_cast<std::size_t>(std::ranges::find(keys_, key) - keys_.begin());
      if (at == keys_.size()) keys_.push_back(key), groups_.emplace_back();
      groups_[at].blocks.push_back(&f);
      wrong_[f.subject].insert(f.operation);
    }
    find_causes(), find_bands_beside_causes(), join_trees(), join_symptoms(), leave_bands_to_their_causes(),
        join_blocks();
  }

  /// The findings by the group that causes them.
  std::map<std::size_t, Finding> by_root() const {
    std::map<std::size_t, Finding> all;
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      // With an outcome in place of an error, or on a tree, the blocks of an operation fail together.
      std::size_t first = root(i);
      const FailedBlock& f = *groups_[first].blocks.front();
      const bool together = is_tree_law(f.worst->series->property) || !worst_outcome(*f.worst->row).empty();
      for (std::size_t k = 0; together && k < first; ++k)  // but for those that follow from another operation
        if (of_one_operation(k, first) && of_one_operation(root(k), first)) first = root(k);
      Finding& finding = all[first];
      finding.subject = std::get<0>(keys_[first]), finding.operation = std::get<1>(keys_[first]);
      auto& list = of_one_operation(first, i) ? finding.own : finding.others;
      list.insert(i == first ? list.begin() : list.end(), groups_[i].blocks.begin(), groups_[i].blocks.end());
      finding.beside.insert(finding.beside.end(), groups_[i].beside.begin(), groups_[i].beside.end());
      for (const FailedBlock* block : groups_[i].blocks)
        finding.ordinary = std::max(finding.ordinary, ordinary_loss(*block));
    }
    for (std::size_t i = 0; i < groups_.size(); ++i)
      for (const std::size_t k : causes_from(i))  // what fails as log6 does has its two causes
        for (const auto& [of_bands, bands] : groups_[k].of_bands)
          if (const std::size_t by = root(of_bands);
              by != root(i) && all.contains(by) && fails_in(i, bands) && (k == i || groups_[k].cause))
            all[by].partly.push_back(std::get<1>(keys_[i]));
    // Of two scalars with errors, the reader's is the wider one, if it loses two digits.
    for (auto& [first, finding] : all)
      std::ranges::stable_sort(finding.own, std::greater(), [&](const FailedBlock* f) {
        return f->operation == finding.operation && f->scalar == "double" && f->score > 100;
      });
    return all;
  }

 private:
  bool of_one_operation(std::size_t a, std::size_t b) const {
    return std::get<0>(keys_[a]) == std::get<0>(keys_[b]) && std::get<1>(keys_[a]) == std::get<1>(keys_[b]);
  }
  bool fails_in(std::size_t i, const std::set<std::size_t>& bands) const {
    return std::ranges::any_of(groups_[i].blocks, [&](const FailedBlock* f) {
      return std::ranges::any_of(
          f->bands, [&](const BandOf& b) { return b.row->failed > 0 && bands.contains(b.band); });
    });
  }
  const std::string& block_of(std::size_t i) const { return std::get<2>(keys_[i]); }
  const FailedBlock& worst_of(std::size_t i) const { return *groups_[i].blocks.front(); }

  /// The cause of a group is a block of the operation that explains the most, preferably one that follows from no other.
  void find_causes() {
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      const auto& [subject, operation, block] = keys_[i];
      std::size_t most = 0;
      for (const auto& [part, votes] : causes_of(worst_of(i), seed_, wrong_[subject]))
        for (std::size_t k = 0; k < groups_.size(); ++k) {
          const auto& [other_subject, other_operation, other_block] = keys_[k];
          if (k == i || other_subject != subject || other_operation != part) continue;
          if (part == operation && (!follows_within(block) || follows_within(other_block))) continue;
          if (part != operation && passes_where_most_fail(worst_of(i), worst_of(k))) continue;
          const std::size_t rank = 2 * votes + (follows_within(other_block) == follows_within(block));
          if (rank > most) most = rank, groups_[i].cause = k;
        }
    }
  }
  /// Of a group with a cause, the bands in which no other wrong operation explains its worst case, and it loses four digits more than
  /// the cause, or has an outcome that the cause has not.
  void find_bands_beside_causes() {
    using Outcomes = std::array<std::uint64_t, 4>;
    const auto outcomes_of = [](const Row& r) -> Outcomes {
      return {r.crashed, r.not_finite, r.wrong_branch, r.refused};
    };
    for (Group& g : groups_) {
      if (!g.cause) continue;
      struct OfCause {
        double score = 0;
        Outcomes outcomes = {};
      };
      std::map<std::pair<std::string, std::size_t>, OfCause> of_cause;
      for (std::size_t k = 0; k < groups_.size(); ++k)
        for (const FailedBlock* f : groups_[k].blocks)
          for (const BandOf& b : f->bands)
            if (of_one_operation(k, *g.cause)) {
              auto& [score, outcomes] = of_cause[{f->scalar, b.band}];
              score = std::max(score, b.row->failed > 0 ? b.row->worst_score : 0);
              std::ranges::transform(outcomes, outcomes_of(*b.row), outcomes.begin(), std::plus());
            }
      for (const FailedBlock* f : g.blocks) {
        if (f->block == "jump" || f->block == "twist") continue;
        Beside digits{f, {}, false}, outcome{f, {}, true};
        for (const BandOf& b : f->bands) {
          if (!b.fails || b.band == 0 || stop_requested) continue;
          const auto& [score, outcomes] = of_cause[{f->scalar, b.band}];
          const Outcomes own = outcomes_of(*b.row);
          bool other = false;
          for (std::size_t i = 0; i < own.size(); ++i) other |= own[i] > 0 && outcomes[i] == 0;
          if (!other && b.row->worst_score < 1e4 * std::max(score, 1.0)) continue;
          auto parts = causes_in(b, seed_, wrong_[f->subject]);
          if (parts && other) std::erase(*parts, f->operation);
          if (parts && parts->empty()) (other ? outcome : digits).bands.insert(b.band);
          if (parts && std::ranges::find(*parts, std::get<1>(keys_[*g.cause])) == parts->end())
            for (std::size_t k = 0; k < groups_.size(); ++k)  // which have another cause
              if (std::get<0>(keys_[k]) == f->subject && std::ranges::count(*parts, std::get<1>(keys_[k])))
                g.of_bands[k].insert(b.band);
        }
        for (const Beside& one : {outcome, digits}) g.beside.push_back(one);
      }
    }
  }
  /// What fails on the same trees as a simpler operation, or is formed from one, has its cause.
  void join_trees() {
    std::map<std::pair<std::string, std::string>, std::vector<const FailedBlock*>> all;
    for (const Group& g : groups_)
      for (const FailedBlock* f : g.blocks) all[{f->subject, f->scalar}].push_back(f);
    for (const auto& [key, blocks] : all)
      for (const auto& [operation, cause] : tree_causes(blocks, seed_))
        for (std::size_t i = 0; i < groups_.size(); ++i)
          for (std::size_t k = 0; k < groups_.size() && !groups_[i].cause; ++k)
            if (std::get<0>(keys_[i]) == key.first && std::get<1>(keys_[i]) == operation &&
                std::get<0>(keys_[k]) == key.first && std::get<1>(keys_[k]) == cause)
              groups_[i].cause = k;
  }
  void join_symptoms() {
    for (std::size_t i = 0; i < groups_.size(); ++i)
      for (std::size_t k = 0; is_symptom(block_of(i)) && !groups_[i].cause && k < groups_.size(); ++k)
        if (of_one_operation(i, k) && !is_symptom(block_of(k)) && fail_together(worst_of(i), worst_of(k)))
          groups_[i].cause = k;
  }
  /// The failing bands of a block that follow each other on one axis: first and behind the last.
  static std::vector<std::pair<std::size_t, std::size_t>> runs_of(const FailedBlock& f) {
    std::vector<std::pair<std::size_t, std::size_t>> all;
    for (std::size_t i = 0; i < f.bands.size(); ++i) {
      if (!f.bands[i].fails) continue;
      const auto follows = [&](const BandOf& before) {
        return f.bands[i].band <= before.band + 1 &&
               before.series->bands()[before.band].axis == f.bands[i].series->bands()[f.bands[i].band].axis;
      };
      if (!all.empty() && follows(f.bands[all.back().second - 1]))
        all.back().second = i + 1;
      else
        all.emplace_back(i, i + 1);
    }
    return all;
  }
  /// Whether an operation errs in a band by all but four digits of what a block does.
  bool loses_as_much(const FailedBlock& f, const BandOf& band, std::string_view operation) const {
    double most = 0;
    for (const Group& g : groups_)
      for (const FailedBlock* other : g.blocks)
        for (const BandOf& b : other->bands)
          if (other->subject == f.subject && other->scalar == f.scalar && other->operation == operation &&
              b.band == band.band && b.row->failed > 0)
            most = std::max(most, b.row->worst_score);
    return band.row->worst_score <= 1e4 * std::max(most, 1.0);
  }
  /// A block may have several causes: of bands that follow each other, those that another operation explains are that one's
  /// alone, and if it explains two of three all in which it errs nearly as much. If these are all of the ordinary angles, the others are, too.
  void leave_bands_to_their_causes() {
    for (std::size_t i = 0; i < groups_.size(); ++i)
      for (FailedBlock* f : groups_[i].blocks) {
        if (groups_[i].cause || f->block == "sign") continue;
        const auto before = f->bands;
        std::string_view other;
        for (const auto& [first, last] : runs_of(*f)) {
          std::vector<std::size_t> explained;
          std::string_view by;
          for (std::size_t i = first; i < last && !stop_requested; ++i) {
            const auto parts = causes_in(f->bands[i], seed_, wrong_[f->subject]);
            if (!parts) continue;
            const auto at = std::ranges::find_if(*parts, [&](auto part) {
              return part != f->operation && loses_as_much(*f, f->bands[i], part);
            });
            if (at != parts->end()) explained.push_back(i), by = *at;
          }
          if (3 * explained.size() < 2 * (last - first)) continue;
          std::set<std::size_t> bands;
          for (std::size_t i = first; i < last; ++i) {
            if (!std::ranges::count(explained, i) && !loses_as_much(*f, f->bands[i], by)) continue;
            f->bands[i].fails = false, bands.insert(f->bands[i].band);
            if (is_ordinary(f->bands[i].series->bands()[f->bands[i].band])) other = by;
          }
          for (std::size_t k = 0; k < groups_.size(); ++k)
            if (std::get<0>(keys_[k]) == f->subject && std::get<1>(keys_[k]) == by)
              groups_[i].of_bands[k].insert(bands.begin(), bands.end());
        }
        if (!other.empty() && std::ranges::none_of(f->bands, fails_ordinarily)) {
          f->bands = before;
          for (std::size_t k = 0; k < groups_.size(); ++k)
            if (std::get<0>(keys_[k]) == f->subject && std::get<1>(keys_[k]) == other) groups_[i].cause = k;
        } else if (std::ranges::none_of(f->bands, &BandOf::fails)) {
          f->bands = before;
        }
        find_worst(*f);
      }
  }
  /// Blocks of one operation that fail in the same bands are one finding.
  void join_blocks() {
    for (std::size_t i = 0; i < groups_.size(); ++i)
      for (std::size_t k = 0; k < i && !groups_[i].cause; ++k)
        if (!groups_[k].cause && of_one_operation(i, k) && share_bands(worst_of(i), worst_of(k)))
          groups_[i].cause = k;
  }
  /// The group i, its cause, the cause of that, and so on.
  std::vector<std::size_t> causes_from(std::size_t i) const {
    std::vector<std::size_t> seen{i};
    while (groups_[i].cause && !std::ranges::count(seen, *groups_[i].cause))
      seen.push_back(i = *groups_[i].cause);
    return seen;
  }
  /// The group at the end of the causes of i; of groups that cause each other, the first.
  std::size_t root(std::size_t i) const {
    const std::vector<std::size_t> seen = causes_from(i);
    const auto& cause = groups_[seen.back()].cause;
    return cause ? *std::min_element(std::ranges::find(seen, *cause), seen.end()) : seen.back();
  }

  std::uint64_t seed_;
  std::vector<BlockKey> keys_;
  std::vector<Group> groups_;
  std::map<std::string, std::set<std::string_view>> wrong_;  ///< operations by subject
};

/// Spatial operations of which functions on trees are made stand before these, which say so.
void put_spatial_first(std::vector<Finding>& all) {
  const auto is_of_trees = [](const Finding& f) {
    return !f.own.empty() && is_tree_law(f.own.front()->worst->series->property);
  };
  for (auto at = std::ranges::find_if(all, is_of_trees); at != all.end(); ++at) {
    if (!is_of_trees(*at)) continue;
    const auto serves = [subject = at->subject](const Finding& f) {
      return f.subject == subject && serves_trees(f.operation) && f.ordinary > 0;
    };
    const auto moved = std::stable_partition(at, all.end(), serves);
    at = moved;
    for (auto before = all.begin(); before != at; ++before)
      if (serves(*before)) at->used.push_back(before->operation);
  }
}

}  // namespace

std::vector<Finding> findings_of(const CampaignResult& campaign, std::vector<FailedBlock>& failed,
                                 const std::vector<HardRow>& hard_cases) {
  std::map<std::size_t, Finding> by_root = Groups(failed, campaign.options.seed).by_root();
  std::map<BlockKey, Finding> hard_only = add_hard_cases(hard_cases, by_root);
  std::vector<Finding> all;
  for (auto& [first, finding] : by_root) all.push_back(std::move(finding));
  for (auto& [key, finding] : hard_only) all.push_back(std::move(finding));
  std::ranges::stable_sort(all, std::greater(), &Finding::ordinary);
  // What is refused is not wrong.
  const auto answers = [](const FailedBlock* f) { return worst_outcome(*f->worst->row) != "refused"; };
  std::ranges::stable_partition(
      all, [&](const Finding& f) { return f.own.empty() || std::ranges::any_of(f.own, answers); });
  put_spatial_first(all);
  return all;
}

}  // namespace liecheck::properties
