#include <bugs/causes.hpp>

#include <bit>
#include <bugs/cause_forms.hpp>
#include <bugs/known_bugs.hpp>
#include <campaign/robots.hpp>
#include <cmath>
#include <failures/findings.hpp>
#include <numbers>
#include <regex>
#include <support/stop.hpp>

namespace liecheck::properties {
namespace {

void add_series(CauseForms& f) {
  for (const double x : {0.3, 0.1, 0.03, 0.01, 2e-3, 5e-4, 1e-4}) {
    f.add("cutoff", cutoff, x, op::exp3_quaternion, below(x),
          [](V4, const V3& phi) { return quaternion(phi / 2, 1 - phi.squaredNorm() / 8); });
    f.add("cutoff", cutoff, x, op::exp3_matrix, below(x),
          [](M3, const V3& phi) -> M3 { return M3::Identity() + hat(phi) + hat(phi) * hat(phi) / 2; });
    f.add("cutoff", cutoff, x, op::left_jacobian3, below(x),
          [](M3, const V3& phi) -> M3 { return M3::Identity() + hat(phi) / 2 + hat(phi) * hat(phi) / 6; });
    f.add("cutoff", cutoff, x, op::log3_quaternion, below(x),
          [](V3, const V4& Q) -> V3 { return 2 / Q[3] * vector(Q); });
    f.add("cutoff", cutoff, x, op::log3_matrix, below(x),
          [](V3, const M3& R) -> V3 { return vee(R - R.transpose()) / 2; });
  }
  for (const double x : {0.1, 0.01, 1e-3}) {
    f.add("coefficient", coefficient, x, op::exp3_quaternion, below(x), [](V4, const V3& phi) -> V4 {
      const double t = phi.squaredNorm();
      return quaternion((0.5 + t / 48) * phi, 1 - t / 8 + t * t / 384);
    });
    f.add("coefficient", coefficient, x, op::left_jacobian3, below(x), [](M3, const V3& phi) -> M3 {
      const double t = phi.squaredNorm();
      return M3::Identity() + (0.5 - t / 12) * hat(phi) + (1. / 6 - t / 120) * hat(phi) * hat(phi);
    });
    f.add("coefficient", coefficient, x, op::left_jacobian3_inverse, below(x), [](M3, const V3& phi) -> M3 {
      return M3::Identity() - hat(phi) / 2 + (1. / 12 + phi.squaredNorm() / 360) * hat(phi) * hat(phi);
    });
  }
}

void add_cancelling(CauseForms& f) {
  for (const double x : {0.0, 1e-7, 1e-6, 1e-5, 1e-4}) {
    const auto above = [x](const V3& phi) { return theta_of(phi) > x && theta_of(phi) < 1; };
    f.add("cancels", cancels, x, op::left_jacobian3, above, [](M3, const V3& phi) -> M3 {
      const double t = theta_of(phi);
      return M3::Identity() + (1 - std::cos(t)) / (t * t) * hat(phi) +
             (t - std::sin(t)) / (t * t * t) * hat(phi) * hat(phi);
    });
  }
  f.add(
      "acos", acos_one, 0, op::log3_quaternion, [](const V4& Q) { return vector(Q).norm() > 0; },
      [](V3, const V4& Q) -> V3 {
        return std::copysign(2 * std::acos(std::min(std::fabs(Q[3]), 1.0)) / vector(Q).norm(), Q[3]) *
               vector(Q);
      });
  f.add(
      "acos_above_1", acos_one, 0, op::log3_quaternion, [](const V4& Q) { return vector(Q).norm() > 0; },
      [](V3, const V4& Q) -> V3 {
        return std::copysign(2 * std::acos(std::fabs(Q[3])) / vector(Q).norm(), Q[3]) * vector(Q);
      });
  f.add(
      "acos", acos_one, 0, op::log3_matrix, [](const M3& R) { return theta_of(R) > 0 && theta_of(R) < 3; },
      [](V3, const M3& R) -> V3 {
        return std::acos(std::clamp((R.trace() - 1) / 2, -1.0, 1.0)) * vee(R - R.transpose()).normalized();
      });
  f.add("acos", acos_one, 0, op::relative_angle, always,
        [](double, const V4& Q, const V4& P) { return 2 * std::acos(std::min(std::fabs(Q.dot(P)), 1.0)); });
  const auto near_pi = [](const M3& R) { return theta_of(R) > 1; };
  f.add("sin_pi", sin_pi, 0, op::log3_matrix, near_pi, [](V3, const M3& R) -> V3 {
    const double t = theta_of(R);
    return t / (2 * std::sin(t)) * vee(R - R.transpose());
  });
  f.add("acos_pi", sin_pi, 0, op::log3_matrix, near_pi, [](V3, const M3& R) -> V3 {
    const double t = std::acos(std::clamp((R.trace() - 1) / 2, -1.0, 1.0));
    return t / (2 * std::sin(t)) * vee(R - R.transpose());
  });
  f.add("trace", trace, 0, op::log3_matrix, near_pi, [](V3, const M3& R) -> V3 {
    const double w = std::sqrt(std::max(0.0, 1 + R.trace())) / 2;
    return right()[op::log3_quaternion](quaternion(vee(R - R.transpose()) / (4 * w), w).normalized());
  });
  f.add(
      "cos_pi", sin_pi, 0, op::left_jacobian3_inverse,
      [](const V3& phi) { return theta_of(phi) > 1 && theta_of(phi) < 3.2; },
      [](M3, const V3& phi) -> M3 {
        const double t = theta_of(phi);
        return M3::Identity() - hat(phi) / 2 +
               (1 / (t * t) - (1 + std::cos(t)) / (2 * t * std::sin(t))) * hat(phi) * hat(phi);
      });
}

void add_branches(CauseForms& f) {
  const auto negative = [](const V4& Q, const auto&...) { return Q[3] < 0; };
  const auto long_way = [](V3, const V4& Q) -> V3 {
    const double s = vector(Q).norm();
    return 2 * std::atan2(s, Q[3]) / s * vector(Q);
  };
  f.add("long_way", sign_of_w, 0, op::log3_quaternion, negative, long_way);
  f.add("long_way", sign_of_w, 0, op::log3_any_norm, negative, long_way);
  f.add("negative_w", sign_of_w, 0, op::rotate_point, negative,
        [](const V3& x, const V4&, const V3&) -> V3 { return -x; });
  f.add("negative_w", sign_of_w, 0, op::normalize, negative,
        [](const V4& Q, const V4&) -> V4 { return 1.001 * Q; });
  f.add("negative_w", sign_of_w, 0, op::matrix_from_quaternion_any_norm, negative,
        [](const M3& R, const V4&) -> M3 { return R.transpose(); });
  f.add(
      "negative_w", sign_of_w, 0, op::relative_angle, [](const V4& Q, const V4& P) { return Q.dot(P) < 0; },
      [](double, const V4& Q, const V4& P) { return 2 * std::acos(std::max(Q.dot(P), -1.0)); });
  f.add(
      "negative_w", sign_of_w, 0, op::slerp, [](const V4& Q, const V4& P, double) { return Q.dot(P) < 0; },
      [](const V4&, const V4& Q, const V4& P, double t) -> V4 { return right()[op::slerp](Q, P, t / 2); });
  for (const double x : {1e-2, 1e-3, 1e-5, 1e-7, 1e-9}) {
    f.add("zero", zero, x, op::exp3_quaternion, below(x), [](V4, const V3&) { return V4(0, 0, 0, 1); });
    f.add("zero", zero, x, op::exp3_matrix, below(x), [](M3, const V3&) -> M3 { return M3::Identity(); });
    f.add("zero", zero, x, op::log3_quaternion, below(x), [](V3, const V4&) -> V3 { return V3::Zero(); });
    f.add("zero", zero, x, op::log3_matrix, below(x), [](V3, const M3&) -> V3 { return V3::Zero(); });
    f.add("zero", cutoff, x, op::left_jacobian3, below(x),
          [](M3, const V3&) -> M3 { return M3::Identity(); });
    f.add(
        "zero", zero, x, op::relative_angle,
        [x](const V4& Q, const V4& P) { return right()[op::relative_angle](Q, P) < x; },
        [](double, const V4&, const V4&) { return 0.0; });
  }
}

/// Every number of a result.
template <class R, class Change>
R each(R result, Change change) {
  if constexpr (std::is_same_v<R, double>) {
    change(result, 0);
  } else if constexpr (requires { result.size(); }) {
    for (Eigen::Index i = 0; i < result.size(); ++i) change(result.data()[i], i);
  } else {
    for (Eigen::Index i = 0; i < 9; ++i) change(result.R.data()[i], i);
    for (Eigen::Index i = 0; i < 3; ++i) change(result.p[i], 9 + i);
  }
  return result;
}

template <class O>
void add_general(CauseForms& f, const O& operation) {
  f.add("float", single, 0, operation, always, [](const auto& r, const auto&...) {
    return each(r, [](double& x, Eigen::Index) { x = oracles::rounded_to_float(x); });
  });
  f.add("sign_of_first", swapped, 0, operation, always, [](const auto& r, const auto&...) {
    return each(r, [](double& x, Eigen::Index i) { x = i == 1 ? -x : x; });
  });
  f.add("factor", swapped, 0, operation, always, [](const auto& r, const auto&...) {
    return each(r, [](double& x, Eigen::Index i) { x = i == 2 ? 1.5 * x : x; });
  });
  f.add("noise", nothing, 0, operation, always, [](const auto& r, const auto&...) {
    return each(r, [](double& x, Eigen::Index) {
      if (std::bit_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15 >> 62 == 0) x += 1e-6 * x;
    });
  });
}

void add_conventions(CauseForms& f) {
  const auto transpose = [](const M3& R, const auto&...) -> M3 { return R.transpose(); };
  f.add("transposed", transposed, 0, op::exp3_matrix, always, transpose);
  f.add("transposed", transposed, 0, op::left_jacobian3, always, transpose);
  f.add("transposed", transposed, 0, op::left_jacobian3_inverse, always, transpose);
  f.add("transposed", transposed, 0, op::matrix_from_quaternion_any_norm, always, transpose);
  f.add("inverse", transposed, 0, op::left_jacobian3, always,
        [](const M3& J, const V3&) -> M3 { return J.inverse(); });
  f.add("inverse", transposed, 0, op::log3_quaternion, always,
        [](const V3& phi, const V4&) -> V3 { return -phi; });
  f.add("inverse", transposed, 0, op::log3_matrix, always,
        [](const V3& phi, const M3&) -> V3 { return -phi; });
  f.add("inverse", transposed, 0, op::exp6, always,
        [](const auto& X, const auto&) { return right()[op::inverse](X); });
  f.add("inverse", transposed, 0, op::rotate_point, always, [](const V3&, const V4& Q, const V3& p) -> V3 {
    return right()[op::rotate_point](quaternion(-vector(Q), Q[3]), p);
  });
  f.add("reversed", transposed, 0, op::compose, always,
        [](const auto&, const auto& X, const auto& Y) { return right()[op::compose](Y, X); });
  f.add("reversed", transposed, 0, op::difference, always,
        [](const auto&, const auto& q0, const auto& q1) { return right()[op::difference](q1, q0); });
  f.add("after_rotation", swapped, 0, op::inverse, always, [](auto Y, const auto& X) {
    Y.p = -X.p;
    return Y;
  });
  const auto tiny = [](const V3& phi) { return phi != V3::Zero() && phi.cwiseAbs().maxCoeff() < 1e-160; };
  f.add("underflow", overflow, 0, op::exp3_quaternion, tiny, [](V4, const V3& phi) -> V4 {
    const double t = std::sqrt(phi.dot(phi));
    return quaternion(std::sin(t / 2) / t * phi, 1);
  });
  f.add("underflow", overflow, 0, op::left_jacobian3, tiny, [](M3, const V3& phi) -> M3 {
    const double t = phi.dot(phi);
    return M3::Identity() + hat(phi) * (1 - std::cos(std::sqrt(t))) / t;
  });
}

std::vector<Form> forms() {
  CauseForms f;
  add_series(f), add_cancelling(f), add_branches(f), add_conventions(f), add_styles(f);
  add_general(f, op::exp3_quaternion), add_general(f, op::exp3_matrix), add_general(f, op::log3_quaternion);
  add_general(f, op::log3_matrix), add_general(f, op::left_jacobian3), add_general(f, op::compose);
  add_general(f, op::rotate_point), add_general(f, op::matrix_from_quaternion_any_norm),
      add_general(f, op::exp6);
  add_general(f, op::left_jacobian3_inverse), add_general(f, op::log3_any_norm),
      add_general(f, op::normalize);
  return f.all;
}

/// Whether the guess names a number within a factor of 2 of the threshold; true if it has none to name.
bool names_threshold(const std::string& guess, double threshold) {
  if (threshold == 0) return true;
  static const std::regex number("about ([0-9.]+(e-?[0-9]+)?)");
  for (std::sregex_iterator at(guess.begin(), guess.end(), number), end; at != end; ++at)
    if (std::fabs(std::log2(std::stod((*at)[1]) / threshold)) <= 1.01) return true;
  return false;
}

Named judged_guess(const Form& form, const std::string& guess, const std::string& where) {
  const auto says = [](const std::string& text, const char* words) {
    return std::regex_search(text, std::regex(words));
  };
  if (form.cause.name == nothing.name)
    return guess.empty() ? Named::right : says(guess, form.cause.near) ? Named::near : Named::wrong;
  const bool told = form.cause.name == sign_of_w.name && says(where, "w < 0|Q0 . Q1 < 0");
  if (!told && guess.empty()) return Named::silent;
  if (says(guess, form.cause.right))
    return names_threshold(guess, form.threshold) ? Named::right : Named::near;
  if (told) return Named::where;
  return says(guess, form.cause.near) ? Named::near : Named::wrong;
}

}  // namespace

std::vector<CauseRow> bench_of_causes(std::uint64_t seed, std::size_t every) {
  std::vector<CauseRow> rows;
  const std::vector<Form> all = forms();
  for (std::size_t i = 0; i < all.size() && !stop_requested; i += every) {
    const Form& form = all[i];
    Subject s{"cause:" + form.name, "", "", &oracles::scalar_of<double>, right()};
    s.operations.tree = nullptr, s.operations.robot = nullptr;
    // No form is planted in these, and their laws take half of the time.
    const auto without = [&s](const auto&... operations) { ((s.operations[operations] = nullptr), ...); };
    without(op::mean_rotation, op::geodesic_mean, op::mean_pose, op::interpolate, op::preintegrate_forster,
            op::preintegrate_brossard, op::forster_bias_jacobians, op::brossard_bias_jacobians, op::se23_exp,
            op::se23_log, op::se23_left_jacobian, op::se23_right_jacobian, op::se23_adjoint);
    form.plant(s.operations);
    register_subject(s);
    CampaignOptions options;
    options.selection = {{s.name}, {}, {"double"}};
    options.selection.profiles = {{"", Profile::careful}};  // as an adapter's
    options.cases = 1000, options.jobs = 1, options.quiet = true, options.seed = seed;
    const CampaignResult r = run_campaign(options, built_in_robot());
    std::vector<FailedBlock> failed = failed_blocks(r);
    const std::vector<Finding> findings = findings_of(r, failed, {});
    CauseRow row{form.name, form.cause.name, form.threshold, Named::not_found, "", ""};
    for (const Finding& finding : findings)
      if (!finding.own.empty() && form.name.find(finding.operation) != std::string::npos) {
        row.guess = guess_of(*finding.own.front()), row.where = where_and_how_often(*finding.own.front(), r);
        row.named = judged_guess(form, row.guess, row.where);
        break;
      }
    forget_subject(s.name);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace liecheck::properties
