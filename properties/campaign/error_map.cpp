#include <campaign/error_map.hpp>

#include <algorithm>
#include <cmath>
#include <generators/random_bits.hpp>
#include <invariants/property.hpp>
#include <numbers>
#include <support/progress.hpp>
#include <support/stop.hpp>
#include <support/threads.hpp>

namespace liecheck::properties {

namespace {

constexpr int decades = 16, samples = 4;
constexpr double first_row = 1e-8, last_row = 1e6;

/// Whether the input is one rotation, in one or more forms, and one translation.
bool has_map(const Series& series) {
  int translations = 0, rotations = 0;
  for (const Field& f : series.fields) {
    const bool translation = f.kind == Kind::vector && f.unit == "m";
    if (!translation && f.kind != Kind::rotation_vector && f.kind != Kind::quaternion &&
        f.kind != Kind::rotation_matrix)
      return false;
    // Two groups of a kind are two poses.
    for (const Field& other : series.fields)
      if (&other != &f && other.kind == f.kind) return false;
    ++(translation ? translations : rotations);
  }
  return translations == 1 && rotations > 0;
}

bool has_length(const Output& output) {
  return output.definition->unit == "m";
}

using Vector = Vec<long double, 3>;

/// The scalar's number nearest to x.
double nearest(const Scalar& scalar, long double x) {
  return scalar.is_float() ? static_cast<float>(x) : static_cast<double>(x);
}

/// The rotation by `phi` in the form of the field; the scalar's numbers nearest to the exact ones.
void append_rotation(const Scalar& scalar, std::vector<double>& to, Kind kind, const Vector& phi) {
  const long double theta = phi.norm();
  const Vector axis = phi / theta;
  const auto add = [&](long double x) { to.push_back(nearest(scalar, x)); };
  if (kind == Kind::rotation_vector) {
    for (const long double x : phi) add(x);
    return;
  }
  if (kind == Kind::quaternion) {
    for (int i = 0; i < 3; ++i) add(std::sin(theta / 2) * axis[i]);
    return add(std::cos(theta / 2));
  }
  const long double s = std::sin(theta), versine = 2 * std::sin(theta / 2) * std::sin(theta / 2);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const long double cross = i == j ? 0 : ((j - i + 3) % 3 == 1 ? -s : s) * axis[3 - i - j];
      add((i == j) + cross + versine * (axis[i] * axis[j] - (i == j)));
    }
}

/// A unit vector; coordinate axes in every second sample, because pi - theta can be small only there.
Vector direction(Source& source, int sample) {
  Vector v;
  for (auto& x : v) x = 2 * source.unit<double>() - 1;
  if (sample % 2 == 0) v = Vector::Unit(static_cast<Eigen::Index>(sample / 2 % 3));
  return v / v.norm();
}

/// Adds what one input shows to the maps of the outputs.
void measure(const Series& series, const Vector& rho, const Vector& phi, std::vector<double>& worst) {
  std::vector<double> x;
  for (const Field& f : series.fields)
    if (f.kind == Kind::vector)
      for (const long double v : rho) x.push_back(nearest(series.format(), v));
    else
      append_rotation(series.format(), x, f.kind, phi);
  for (const Judged& j : series.measure(x)) {
    const Outcome o = j.residual.outcome;
    if (j.ill_posed || leaves_open(o) || o == Outcome::outside_domain) continue;
    double& error = worst[j.residual.output];
    const double found = o != Outcome::measured            ? std::numeric_limits<double>::infinity()
                         : j.budget->rule == Rule::forward ? j.residual.error
                                                           : j.excess;
    error = std::isnan(error) ? found : std::max(error, found);
  }
}

/// A norm of the rotation in a column that the scalar can represent.
bool in_column(const Scalar& scalar, const AngleColumn& column, const Vector& phi) {
  const Vector stored = phi.unaryExpr([&](long double x) -> long double { return nearest(scalar, x); });
  const long double theta = stored.norm();
  const long double at = column.axis == Axis::theta ? theta : std::numbers::pi_v<long double> - theta;
  return at >= column.low * .999L && at <= 10 * column.low * 1.001L;
}

std::vector<ErrorMap> maps_of(const Series& series, std::uint64_t seed) try {
  const auto columns = map_columns();
  const auto rows = map_rows();
  const double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<ErrorMap> all(series.outputs.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = {&series, i, std::vector(rows.size(), std::vector<double>(columns.size(), none))};
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (stop_requested) return {};
      Source source(CaseId::key_of(series.id(seed, 0).series_key(), r * columns.size() + c));
      std::vector<double> worst(all.size(), none);
      for (int sample = 0; sample < samples; ++sample) {
        const long double at = columns[c].low * std::pow(10.0L, source.unit<double>());
        const long double theta = columns[c].axis == Axis::theta ? at : std::numbers::pi_v<long double> - at;
        const Vector phi = theta * direction(source, sample);
        const Vector rho = rows[r] * std::pow(100.0L, source.unit<double>()) * direction(source, 1);
        if (in_column(series.format(), columns[c], phi)) measure(series, rho, phi, worst);
      }
      for (std::size_t i = 0; i < all.size(); ++i) all[i].errors[r][c] = worst[i];
    }
  std::erase_if(all, [&](const ErrorMap& m) {
    return !has_length(series.outputs[m.output]) || !(series.due >> m.output & 1);
  });
  return all;
} catch (const GivenUp&) {
  return {};
}

}  // namespace

std::vector<AngleColumn> map_columns() {
  std::vector<AngleColumn> all;
  for (int d = -decades; d < 0; ++d) all.push_back({Axis::theta, std::pow(10.0, d)});
  for (int d = -1; d >= -decades; --d) all.push_back({Axis::pi_minus_theta, std::pow(10.0, d)});
  return all;
}

std::vector<double> map_rows() {
  std::vector<double> all;
  for (double low = first_row; low < last_row * 10; low *= 100) all.push_back(low);
  return all;
}

std::vector<ErrorMap> error_maps(const CampaignResult& campaign) {
  std::vector<const Series*> series;
  for (const SeriesResult& s : campaign.series)
    if (has_map(*s.series)) series.push_back(s.series.get());
  std::vector<std::vector<ErrorMap>> found(series.size());
  std::atomic<std::size_t> next{0};
  Steps steps("maps of errors", series.size());
  run_on_threads(std::max(campaign.options.jobs, 1u), stop_requested, [&] {
    for (std::size_t i; (i = next++) < series.size() && !stop_requested;) {
      found[i] = maps_of(*series[i], campaign.options.seed);
      steps.done(series[i]->property);
    }
  });
  std::vector<ErrorMap> all;
  for (auto& maps : found) std::ranges::move(maps, std::back_inserter(all));
  return all;
}

}  // namespace liecheck::properties
