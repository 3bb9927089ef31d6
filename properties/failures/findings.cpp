#include <failures/findings.hpp>

#include <algorithm>
#include <cmath>
#include <failures/calls.hpp>
#include <failures/causes.hpp>
#include <failures/result.hpp>
#include <invariants/tree_laws.hpp>
#include <map>
#include <set>
#include <support/stop.hpp>
#include <tuple>

namespace liecheck::properties {

namespace {

/// Blocks of one operation in every scalar, with what they come from.
struct Group {
  std::vector<FailedBlock*> blocks;  ///< by scalar
  std::optional<std::size_t> cause;  ///< another group
};
using BlockKey = std::tuple<std::string, std::string, std::string>;  ///< subject, operation, block

/// The share of ordinary inputs that fail, times the share of digits that they lose.
double ordinary_loss(const FailedBlock& f) {
  double failed = 0, cases = 0, digits = 0;
  const double eps = f.worst->series->eps;
  for (const BandOf& b : f.bands) {
    if (!is_ordinary(b.series->bands()[b.band])) continue;
    cases += static_cast<double>(b.row->inside());
    if (!b.fails) continue;
    failed += static_cast<double>(b.row->failed);
    const double score = std::clamp(b.row->worst_score, 1.0, 1 / eps);
    digits = std::max(digits, std::log(score) / -std::log(eps));
  }
  return cases > 0 ? failed / cases * digits : 0;
}

/// Up to three failing bands, from the first to the last, whose worst case has a result.
std::vector<const BandOf*> examples_of(const FailedBlock& f) {
  std::vector<const BandOf*> all;
  for (const BandOf& b : f.bands)
    if (b.fails && b.row->crashed == 0 && b.row->refused == 0) all.push_back(&b);
  if (all.size() <= 3) return all;
  return {all.front(), all[all.size() / 2], all.back()};
}

/// The operations whose own errors explain the worst case of a band; none if the band has no such case.
std::optional<std::vector<std::string_view>> causes_in(const BandOf& b, std::uint64_t seed,
                                                       const std::set<std::string_view>& wrong) try {
  const Output& output = b.series->outputs.at(b.output);
  const NotedCase all = noted(*b.series, b.series->id(seed, b.row->worst_index), b.output);
  const NotedCall* call = worst_call(output, all);
  if (!call || !call->thrown.empty() || !all.compared.exact.empty()) return std::nullopt;
  std::vector<std::string_view> parts;
  if (call->operation != output.record)
    parts.push_back(call->operation->name);
  else
    parts = explained_by(*b.series, output, *call);
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

}  // namespace

bool is_ordinary(const Band& b) {
  constexpr double near = 0.99e-8;  // below the edge of a band at 1e-8, which is rounded
  if (b.axis == Axis::none) return b.region == Region::to_pi || (b.high > 0 && b.high < 10);
  return b.axis == Axis::theta ? b.low >= near || b.high == 0 : b.low >= near;
}

std::vector<Finding> findings_of(const CampaignResult& campaign, std::vector<FailedBlock>& failed,
                                 const std::vector<HardRow>& hard_cases) {
  std::vector<BlockKey> keys;
  std::vector<Group> groups;
  std::map<std::string, std::set<std::string_view>> wrong;  // operations by subject
  for (FailedBlock& f : failed) {
    const BlockKey key{f.subject, f.operation, f.block};
    const auto at = static_cast<std::size_t>(std::ranges::find(keys, key) - keys.begin());
    if (at == keys.size()) keys.push_back(key), groups.emplace_back();
    groups[at].blocks.push_back(&f);
    wrong[f.subject].insert(f.operation);
  }
  // The cause of a group is a block of the operation that explains the most, preferably one that follows from no other.
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const auto& [subject, operation, block] = keys[i];
    std::size_t most = 0;
    for (const auto& [part, votes] :
         causes_of(*groups[i].blocks.front(), campaign.options.seed, wrong[subject]))
      for (std::size_t k = 0; k < groups.size(); ++k) {
        const auto& [other_subject, other_operation, other_block] = keys[k];
        if (k == i || other_subject != subject || other_operation != part) continue;
        if (part == operation && (!follows_within(block) || follows_within(other_block))) continue;
        const std::size_t rank = 2 * votes + (follows_within(other_block) == follows_within(block));
        if (rank > most) most = rank, groups[i].cause = k;
      }
  }
  // A block may have several causes: the bands that another operation explains are that one's alone.
  for (std::size_t i = 0; i < groups.size(); ++i)
    for (FailedBlock* f : groups[i].blocks) {
      if (groups[i].cause || f->block == "sign") continue;
      const auto before = f->bands;
      for (BandOf& b : f->bands) {
        if (!b.fails || stop_requested) continue;
        const auto parts = causes_in(b, campaign.options.seed, wrong[f->subject]);
        b.fails = !parts ||
                  std::ranges::all_of(*parts, [&](std::string_view part) { return part == f->operation; });
      }
      if (std::ranges::none_of(f->bands, &BandOf::fails)) f->bands = before;
      find_worst(*f);
    }
  const auto root = [&](std::size_t i) {
    for (std::size_t steps = 0; groups[i].cause && steps < groups.size(); ++steps) i = *groups[i].cause;
    return i;
  };
  std::map<std::size_t, Finding> by_root;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    // With an outcome in place of an error, or on a tree, the blocks of an operation fail together.
    std::size_t first = root(i);
    const FailedBlock& f = *groups[first].blocks.front();
    const bool together = is_tree_law(f.worst->series->property) || !worst_outcome(*f.worst->row).empty();
    for (std::size_t k = 0; together && k < first; ++k)
      if (std::get<0>(keys[k]) == f.subject && std::get<1>(keys[k]) == f.operation) first = root(k);
    Finding& finding = by_root[first];
    finding.subject = std::get<0>(keys[first]), finding.operation = std::get<1>(keys[first]);
    auto& list = first == i || std::get<1>(keys[i]) == finding.operation ? finding.own : finding.others;
    list.insert(list.end(), groups[i].blocks.begin(), groups[i].blocks.end());
    for (const FailedBlock* block : groups[i].blocks)
      finding.ordinary = std::max(finding.ordinary, ordinary_loss(*block));
  }
  std::map<BlockKey, Finding> hard_only = add_hard_cases(hard_cases, by_root);
  std::vector<Finding> all;
  for (auto& [first, finding] : by_root) all.push_back(std::move(finding));
  for (auto& [key, finding] : hard_only) all.push_back(std::move(finding));
  std::ranges::stable_sort(all, std::greater(), &Finding::ordinary);
  return all;
}

}  // namespace liecheck::properties
