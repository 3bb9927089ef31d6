#include <failures/tree_causes.hpp>

#include <algorithm>
#include <array>
#include <invariants/property.hpp>
#include <invariants/tree_laws.hpp>
#include <optional>
#include <set>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

/// From kinematics to forward dynamics: what comes later needs more of a library.
constexpr std::array<std::string_view, 18> simplest_first{"frame_pose",
                                                          "tree_potential_energy",
                                                          "frame_velocity",
                                                          "frame_jacobian",
                                                          "tree_gravity",
                                                          "tree_kinetic_energy",
                                                          "tree_momentum",
                                                          "tree_crba",
                                                          "tree_momentum_map",
                                                          "frame_acceleration",
                                                          "frame_classical_acceleration",
                                                          "frame_jacobian_rate",
                                                          "tree_nonlinear_effects",
                                                          "tree_rnea",
                                                          "tree_mass_inverse",
                                                          "tree_aba",
                                                          "rnea_derivatives",
                                                          "aba_derivatives"};

std::size_t place_of(std::string_view operation) {
  return static_cast<std::size_t>(std::ranges::find(simplest_first, operation) - simplest_first.begin());
}

/// The operations of which a law forms a quantity; none of one that is measured itself.
Few<const Operation*, 3> parts_of(const FailedBlock& f) {
  for (const Formed& formed : f.worst->series->tested_law().statement().formed)
    if (formed.quantity->name == f.operation) return formed.from;
  return {};
}

/// What an operation does on each of some trees: it fails, passes, or is not judged.
using Verdicts = std::vector<std::optional<bool>>;

/// Whether a call gave another result when it was repeated.
bool is_kept(const FailedBlock& f) {
  return std::ranges::any_of(f.bands, [](const BandOf& b) { return b.row->not_repeatable > 0; });
}

/// The trees of the first cases of a law.
void add_trees(std::vector<std::vector<double>>& to, const Series& series, std::uint64_t seed) {
  constexpr std::uint64_t each = 50;
  for (std::uint64_t i = 0; i < each; ++i) to.push_back(series.numbers(series.id(seed, i)));
}

/// What each operation of a law does on the trees.
std::map<std::string_view, Verdicts> verdicts_of(const Series& series,
                                                 const std::vector<std::vector<double>>& trees) {
  std::map<std::string_view, Verdicts> all;
  for (const Output& o : series.outputs) all[o.operation].resize(trees.size());
  for (std::size_t i = 0; i < trees.size() && !stop_requested; ++i) {
    if (!series.tested_law().valid(trees[i])) continue;
    for (const Judged& j : series.measure(trees[i])) {
      if (j.ill_posed || leaves_open(j.residual.outcome) || j.residual.outcome == Outcome::outside_domain)
        continue;
      std::optional<bool>& fails = all[series.outputs[j.residual.output].operation][i];
      fails = fails.value_or(false) || j.failed;
    }
  }
  return all;
}

bool passes_all(const Verdicts& verdicts) {
  return std::ranges::none_of(verdicts,
                              [](const std::optional<bool>& fails) { return fails.value_or(false); });
}

/// Whether two operations fail on the same trees: nine of ten trees on which the one fails that does so less often are trees
/// on which both do, and they are most of the others', too, or the other one seldom fails where the first passes.
bool fail_on_the_same(const Verdicts& a, const Verdicts& b) {
  double measured = 0, of_a = 0, of_b = 0, both = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!a[i] || !b[i]) continue;
    ++measured, of_a += *a[i], of_b += *b[i], both += *a[i] && *b[i];
  }
  if (std::min(of_a, of_b) < 3 || both < 0.9 * std::min(of_a, of_b)) return false;
  if (both >= 0.8 * (of_a + of_b - both)) return true;
  const double passes = measured - of_a, shared = both / of_a;
  const double elsewhere = passes > 0 ? (of_b - both) / passes : 0;
  return shared - elsewhere >= 0.5 || (shared >= 0.2 && elsewhere == 0 && passes >= 0.3 * measured);
}

}  // namespace

std::map<std::string_view, std::string_view> tree_causes(const std::vector<const FailedBlock*>& blocks,
                                                         std::uint64_t seed) {
  std::map<std::string_view, std::string_view> causes;
  std::map<std::string_view, const FailedBlock*> measured;
  std::set<const Series*> laws;
  for (const FailedBlock* f : blocks)
    if (is_tree_law(f->worst->series->property) && !f->worst->series->on_robot && parts_of(*f).size() == 0)
      measured.emplace(f->operation, f), laws.insert(f->worst->series);
  for (const FailedBlock* f : blocks) {
    std::string_view simplest;
    for (const Operation* part : parts_of(*f))
      if (measured.contains(part->name) && (simplest.empty() || place_of(part->name) < place_of(simplest)))
        simplest = part->name;
    if (!simplest.empty() && is_tree_law(f->worst->series->property)) causes[f->operation] = simplest;
  }
  if (measured.size() < 2) return causes;
  std::vector<std::vector<double>> trees;
  for (const Series* law : laws) add_trees(trees, *law, seed);
  if (trees.size() > 100) {  // of laws with a floating base, too
    std::vector<std::vector<double>> some;
    for (std::size_t i = 0; i < 100; ++i) some.push_back(trees[i * trees.size() / 100]);
    trees = some;
  }
  std::map<std::string_view, Verdicts> verdicts;
  for (const Series* law : laws)
    for (auto& [operation, all] : verdicts_of(*law, trees))
      verdicts.insert_or_assign(operation, std::move(all));
  std::vector<std::string_view> order;
  for (const auto& [operation, block] : measured) order.push_back(operation);
  std::ranges::stable_sort(order, {}, place_of);
  // Calls are repeated in few cases, so what keeps a state need not fail on the same trees. An operation that
  // passes on all of these trees, which are measured anew, fails after other calls alone.
  const auto kept = std::ranges::find_if(order, [&](std::string_view operation) {
    return worst_outcome(*measured.at(operation)->worst->row) == "not repeatable";
  });
  for (const std::string_view operation : order)
    if (kept != order.end() && operation != *kept &&
        (is_kept(*measured.at(operation)) || passes_all(verdicts[operation])))
      causes.emplace(operation, *kept);
  for (std::size_t i = 1; i < order.size(); ++i)
    for (std::size_t k = 0; k < i && !causes.contains(order[i]); ++k)
      if (fail_on_the_same(verdicts[order[k]], verdicts[order[i]])) causes[order[i]] = order[k];
  return causes;
}

bool serves_trees(std::string_view operation) {
  static constexpr std::array<std::string_view, 12> all{
      "act_motion",          "act_inverse_motion", "act_force",   "act_inverse_force",
      "cross_motion",        "cross_force",        "act_inertia", "momentum",
      "act_inverse_inertia", "kinetic_energy",     "compose",     "inertia_matrix"};
  return std::ranges::find(all, operation) != all.end();
}

}  // namespace liecheck::properties
