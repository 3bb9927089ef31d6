// A guess at the cause of a failure. Errors of formulas have shapes over the angle theta (shapes.hpp). A result that is
// wrong everywhere may be right in another convention. Where no shape fits, there is no guess.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <conventions/probe.hpp>
#include <conventions/values.hpp>
#include <failures/alternatives.hpp>
#include <failures/blocks.hpp>
#include <failures/calls.hpp>
#include <failures/lost_digits.hpp>
#include <failures/shapes.hpp>
#include <failures/single_numbers.hpp>
#include <failures/terms.hpp>
#include <failures/tree_substitutions.hpp>
#include <invariants/tree_laws.hpp>
#include <map>
#include <numbers>
#include <optional>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

/// What results tell that are others when a call is made again, after other calls.
constexpr const char* kept_state =
    "something is kept from one call to the next, such as a static variable, or read before it is written";

constexpr const char* kept_positions =
    "something is kept from one call to the next, such as what was computed for q, or for its first number, "
    "while that is the same";

/// What the failure of a relation alone tells, where the operation itself is right on other trees.
constexpr std::pair<std::string_view, const char*> of_relations[]{
    {"rnea_of_split_bodies",
     "several bodies on one joint: one of them is not turned or moved into the joint's axes, or replaces "
     "another"},
    {"rnea_of_reordered_joints", "the result depends on the order in which joints are numbered"}};

/// What failures only at tiny angles tell.
std::string of_underflow(const FailedBlock& f) {
  for (const BandOf& b : f.bands) {
    const Band& band = b.series->bands()[b.band];
    if ((b.fails || b.expected) && (b.row->not_finite || band.axis != Axis::theta || band.high > 1e-100))
      return "";
  }
  return "theta^2 underflows: std::hypot and a norm of scaled numbers do not";
}

/// What results on another branch tell, if there are some only near pi.
std::string of_branch_near_pi(const FailedBlock& f) {
  bool any = false;
  for (const BandOf& b : f.bands) {
    if (b.row->wrong_branch == 0) continue;
    const Band& band = b.series->bands()[b.band];
    if (band.axis != Axis::pi_minus_theta || band.high >= 1) return "";
    if (b.row->failed > b.row->wrong_branch) return "";  // something else is wrong there
    any = true;
  }
  if (!any || operation_of(f) != "log3_quaternion") return "";
  return "the sign of w near pi: where w is just below 0, the shorter rotation is about the opposite axis";
}

/// Whether the result of the rotation by 0, as a quaternion, a matrix or a rotation vector, is NaN or infinite, or is refused.
bool is_nan_at_identity(const FailedBlock& f) {
  const Operation& operation = *f.worst->series->outputs.at(f.worst->output).record;
  std::size_t size = 0;
  for (const Layout* l : operation.arguments) size += static_cast<std::size_t>(conventions::size_of(*l));
  std::vector<double> identity(size, 0);
  if (size == 4) identity[3] = 1;
  if (size == 9) identity[0] = identity[4] = identity[8] = 1;
  const std::vector<double> result = result_of(*f.worst->series, operation, identity);
  return result.empty() || std::ranges::any_of(result, [](double x) { return !std::isfinite(x); });
}

/// What NaN and infinite results tell.
std::string of_not_finite(const FailedBlock& f) {
  double largest = -1;
  std::uint64_t elsewhere = 0;  // failures where no result is NaN or infinite
  bool zero = false, at_zero = false, beyond = false, near_pi = false, other = false;
  for (const BandOf& b : f.bands) {
    if (b.row->not_finite == 0) {
      elsewhere += b.fails ? b.row->failed : 0;
      continue;
    }
    const Band& band = b.series->bands()[b.band];
    if (band.axis == Axis::theta)
      largest = std::max(largest, band.high), zero = zero || band.high == 0,
      at_zero = at_zero || (band.high == 0 && 4 * b.row->not_finite >= 3 * b.row->inside());
    else if (band.axis == Axis::pi_minus_theta && band.high < 1)
      near_pi = true;
    else if (band.region == Region::beyond_pi)
      beyond = true;
    else
      other = true;
  }
  if (operation_of(f).starts_with("axis_angle") && at_zero && largest > 0 && is_nan_at_identity(f))
    return fmt::format("0/0 for theta < {}: the vector part has length 0", power_of_ten(largest));
  if (has_angle(f) && !other && !beyond && near_pi && largest > 1e-100)
    return "acos of a number beyond 1 or -1";
  if (operation_of(f) == "log3_matrix" && largest < 0 && !beyond && other)
    return "the root of a negative number: of the formulas for a negative trace, that of the largest entry "
           "of the diagonal must "
           "be taken";
  if (elsewhere * 10 > f.failed && !has_angle(f) && (beyond || other || near_pi)) return "";
  if (other || near_pi || (largest < 0 && !beyond)) return "";
  if (largest < 0) return "theta^2 or a power of it overflows";
  if (beyond) return "";
  if (largest == 0) return elsewhere * 4 > f.failed ? "" : "0/0 at theta = 0";
  if (operation_of(f) == "relative_angle") return "acos of a number above 1";
  if (operation_of(f).starts_with("axis_angle") || (has_angle(f) && largest > 1e-100))
    return is_nan_at_identity(f) ? "0/0 at small theta, or acos of a number above 1"
                                 : "acos of a number w above 1, or the root of 1 - w^2";
  if (elsewhere * 4 > f.failed * 3) return "";  // NaN in less than a quarter of the failures
  return zero ? fmt::format("0/0 for theta < {}", power_of_ten(largest))
              : "theta^2 underflows to 0, and then something is divided by it";
}

/// The cases at moderate angles: those on another branch, those that fail by a thousandth or more, those that lose
/// four digits and keep four, and all.
struct Moderate {
  std::uint64_t other_branch = 0, wrong = 0, coarse = 0, all = 0;
  double largest = 0;                 ///< relative error of a coarse case
  std::map<int, std::uint64_t> bins;  ///< of the coarse cases
  /// Whether 19 coarse cases of 20 err by the same, but for a factor of 2, as a wrong constant does.
  bool same() const {
    std::uint64_t like = 0;
    for (const auto& [bin, count] : bins) like += bins.rbegin()->first - bin <= 32 ? count : 0;
    return 20 * like >= 19 * coarse;
  }
};
Moderate at_moderate_angles(const FailedBlock& f, double eps) {
  Moderate m;
  for (const BandOf& b : f.bands) {
    const Band& band = b.series->bands()[b.band];
    const bool moderate = (band.axis == Axis::theta && band.high == 1) ||
                          (band.axis == Axis::none && band.region == Region::to_pi);
    if (!moderate) continue;
    m.all += b.row->inside(), m.other_branch += b.row->wrong_branch, m.wrong += b.row->not_finite;
    for (const auto& [bin, count] : b.row->errors.bins())
      if (const double error = std::exp2(bin / 32.0); error > 1e-3 / eps)
        m.wrong += count;
      else if (error > 1e4 && error < 1e-4 / eps)
        m.coarse += count, m.largest = std::max(m.largest, error * eps), m.bins[bin] += count;
  }
  return m;
}

bool fails_at_zero(const FailedBlock& f) {
  return std::ranges::any_of(f.bands, [](const BandOf& b) {
    const Band& band = b.series->bands()[b.band];
    return band.axis == Axis::theta && band.high == 0 && b.row->failed > 0;
  });
}

/// Whether the cases have an angle.
bool has_bands_of_angles(const FailedBlock& f) {
  return std::ranges::any_of(f.bands,
                             [](const BandOf& b) { return b.series->bands()[b.band].axis != Axis::none; });
}

/// The convention in which the results at moderate arguments would be right, or "".
std::string convention(const FailedBlock& f) {
  const Series& series = *f.worst->series;
  const Operation& operation = *series.outputs.at(f.worst->output).record;
  conventions::Probed probed{&operation, {}};
  try {
    for (const conventions::Numbers& x : conventions::probe_arguments<double>(operation))
      if (auto result = result_of(series, operation, x); !result.empty())
        probed.answers.push_back({x, result});
    if (probed.answers.empty()) return "";
    const auto findings = conventions::explain({probed});
    if (findings.empty() || !findings.front().named) return "";
    const std::string& sentence = findings.front().sentence;
    std::string text = sentence.substr(0, sentence.find(" in " + std::string(operation.name)));
    if (const auto note = text.find(" (these operations do not tell which)"); note != text.npos)
      text.erase(note);
    if (text.ends_with(",")) text.pop_back();
    return text;
  } catch (const std::exception&) {  // not an operation on fixed-size values
    return "";
  } catch (const GivenUp&) {
    return "";
  }
}

/// Whether most numbers of wrong results are right in some of them and wrong in others, by chance. What is calculated with
/// too few digits makes the same numbers wrong.
bool is_scattered(const std::vector<JudgedCall>& calls) {
  // Rounding in double leaves an error below 1e-13 of such numbers, and a step in float one above 1e-10.
  constexpr double right = 1e-13, wrong = 1e-10;
  std::map<std::size_t, std::pair<int, int>> counts;  // right and wrong, of each number of a result
  for (const auto& [call, exact] : calls) {
    const auto error = [&](std::size_t i) { return std::fabs(call.result[i] / exact[i] - 1); };
    std::vector<std::size_t> general;  // numbers that formulas round
    for (std::size_t i = 0; i < exact.size(); ++i)
      if (std::fabs(exact[i]) > 1e-3 && std::fabs(std::fabs(exact[i]) - 1) > 1e-3) general.push_back(i);
    if (std::ranges::none_of(general, [&](std::size_t i) { return error(i) > wrong; })) continue;
    for (const std::size_t i : general)
      error(i) > wrong ? ++counts[i].second : counts[i].first += error(i) < right;
  }
  const auto varies = std::ranges::count_if(counts, [](const auto& c) {
    const auto& [right_ones, wrong_ones] = c.second;
    return right_ones > 3 && wrong_ones > 3 && right_ones * 5 > wrong_ones && wrong_ones * 5 > right_ones;
  });
  return 2 * varies > std::ssize(counts);
}

/// A cutoff where the result jumps, which is measured beside common cutoffs only. Where it jumps in many bands, or at angles
/// far from each other, no cutoff is the cause.
std::string of_jump(const FailedBlock& f) try {
  const Series& series = *f.worst->series;
  if (series.bands()[f.worst->band].axis != Axis::theta || std::ranges::count_if(f.bands, &BandOf::fails) > 2)
    return "";
  constexpr std::uint64_t any_seed = 42, cases = 1000;
  std::size_t at_theta = 0;
  for (const Field& field : series.fields)
    if (field.name == "theta")
      break;
    else
      at_theta += static_cast<std::size_t>(field.size);
  std::vector<double> angles;
  for (std::uint64_t i = 0; i < cases && !stop_requested; ++i) {
    const std::vector<double> x = series.numbers(series.id(any_seed, i));
    for (const Judged& j : series.measure(x))
      if (j.failed && j.residual.output == f.worst->output) angles.push_back(x.at(at_theta));
  }
  if (angles.empty()) return "";
  const auto [low, high] = std::ranges::minmax(angles);
  return high > 2 * low
             ? ""
             : fmt::format("a cutoff at theta about {}, at which the result jumps", short_angle(low));
} catch (const GivenUp&) {  // a signal ended a call
  return "";
}

/// What errors over the angles and the outcomes tell, the worst first. A formula that cancels is told in place of a shape of
/// errors, and 1 - cos, which is 0, in place of a division by 0.
std::string of_errors_over_angles(const FailedBlock& f, const std::string& lost_digits) {
  const bool near_pi_first = f.worst->series->bands()[f.worst->band].axis == Axis::pi_minus_theta;
  std::vector<std::string> guesses{of_branch_near_pi(f), lost_digits};
  if (lost_digits.empty()) {
    guesses.push_back(shape_at_small_angles(f)), guesses.push_back(shape_near_pi(f));
    if (near_pi_first) std::swap(guesses[2], guesses[3]);
    guesses.push_back(of_underflow(f));
  }
  if (!lost_digits.starts_with("1 - cos"))
    guesses.insert(worst_outcome(*f.worst->row).starts_with("NaN") ? guesses.begin() : guesses.end(),
                   of_not_finite(f));
  std::string all;
  for (const std::string& guess : guesses)
    if (!guess.empty()) all += (all.empty() ? "" : "; and ") + guess;
  return all;
}

}  // namespace

std::string guess_of(const FailedBlock& f) {
  if (worst_outcome(*f.worst->row) == "not repeatable")
    return is_tree_law(f.worst->series->property) ? kept_positions : kept_state;
  if (f.block == "jump") return of_jump(f);
  const double eps = f.worst->series->eps;
  const Moderate m = at_moderate_angles(f, eps);
  if (m.other_branch * 5 > m.all && f.block == "rotation vector")
    return "the sign of w is not looked at: Q and -Q, the same rotation, give different results";
  if (operation_of(f).starts_with("euler_from"))
    if (std::string guess = near_gimbal_lock(f); !guess.empty()) return guess;
  if (std::string guess = tree_substitution_of(*f.worst->series, f.worst->output); !guess.empty())
    return guess;
  for (const auto& [operation, guess] : of_relations)
    if (operation_of(f) == operation) return guess;
  std::optional<std::vector<JudgedCall>> calls;  // measured when they are needed
  const auto of_calls = [&](auto cause) {
    if (!calls) calls = judged_calls(*f.worst->series, f.worst->output);
    return calls->empty() ? std::string()
                          : cause(*f.worst->series->outputs.at(f.worst->output).record, *calls);
  };
  // A result in float is rounded to float anyway, and a NaN is no rounding.
  const bool of_double = eps < 1e-10 && !worst_outcome(*f.worst->row).starts_with("NaN");
  if (has_alternatives(operation_of(f)))
    if (std::string guess = of_calls(alternative_of); !guess.empty()) return guess;
  if (m.wrong * 10 > m.all) {
    std::string other = m.wrong * 3 > m.all ? convention(f) : "";
    // Several conventions change a derivative, and one change of its arguments may tell more.
    if (operation_of(f).starts_with("d_") && other.find(", or ") != other.npos)
      if (std::string one = of_calls(substitution_of); !one.empty()) return one;
    if (other.empty() && of_double) other = of_calls(float_of);
    // A term of the other sign can be what a vector in another frame would give: R p in J_l^-1 p is J_r^-1 p.
    if (other.empty()) other = of_calls(substitution_of);
    if (other.find("another frame") != other.npos)
      if (std::string term = of_calls(wrong_term_of); !term.empty()) return term;
    for (const auto cause : {other_order_of, norm_power_of, in_place_of, wrong_term_of, wrong_numbers_of})
      if (other.empty()) other = of_calls(cause);
    if (other.empty()) other = of_calls(substitution_of_one_kind);
    if (!other.empty() || operation_of(f).starts_with("euler_from")) return other;
    if (f.worst->series->on_robot || is_tree_law(f.worst->series->property)) return "";
    if (m.wrong * 3 > m.all) {
      other = of_calls(approximation_of);
      // Most inputs of Euler angles are near gimbal lock, not moderate.
      return !other.empty() ? other
             : has_bands_of_angles(f)
                 ? "a wrong term, factor or sign: moderate angles fail, too, and no other "
                   "convention explains the results"
                 : "a wrong term, factor or sign: no other convention explains the results";
    }
  }
  const auto lost_digits = [&](const Operation& operation, const std::vector<JudgedCall>& all) {
    return lost_digits_of(operation, all, f.worst->series->format().is_float());
  };
  const std::string lost = has_lost_digits(operation_of(f)) ? of_calls(lost_digits) : "";
  if (std::string guess = of_errors_over_angles(f, lost); !guess.empty()) return guess;
  if (std::string guess = of_double ? of_calls(float_of) : ""; !guess.empty()) return guess;
  const bool of_value = !f.block.ends_with("defect");  // a change of the arguments leaves a norm as it is
  for (const auto cause :
       {substitution_of, other_order_of, substitution_of_one_kind, norm_power_of, in_place_of, constant_of})
    if (std::string guess = of_value || cause == norm_power_of ? of_calls(cause) : ""; !guess.empty())
      return guess;
  if (std::string guess = of_value ? "" : of_calls(wrong_length_of); !guess.empty()) return guess;
  // A float rounds by 2^-24, and a formula may do so a dozen times. At zero there is nothing to round.
  // A constant that is cut has nine digits at most, and an iteration that ends too early gives four at least.
  const bool few_digits = m.largest > 0x1p-30 && m.largest < 0x1p-14;
  const auto scattered = [](const Operation&, const std::vector<JudgedCall>& all) {
    return std::string(is_scattered(all) ? "scattered" : "");
  };
  if (m.coarse * 2 > m.all && !operation_of(f).starts_with("euler_from") && (few_digits || m.same()) &&
      !fails_at_zero(f) && of_calls(scattered).empty())
    return "a constant or a step of the calculation has too few digits, such as one in float, or a series or "
           "iteration ends too early: most cases at moderate angles fail, too";
  // What has no angle loses the same digits wherever it fails, and a step in float leaves seven.
  if (of_double && !has_bands_of_angles(f) && 4 * f.failed > f.cases)
    if (std::string guess = of_calls(approximation_of); guess.find(" in float") != guess.npos) return guess;
  return of_value ? of_calls(wrong_numbers_of) : "";
}

}  // namespace liecheck::properties
