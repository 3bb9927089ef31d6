#include <invariants/property.hpp>

#include <algorithm>
#include <oracles/error.hpp>

namespace liecheck::properties {

bool Property::offers(const Subject& subject, const Output& output) const {
  for (const Formed& f : statement().formed)
    if (f.quantity == output.record)
      return std::all_of(f.from.begin(), f.from.end(),
                         [&](const Operation* operation) { return has(subject, *operation); });
  return has(subject, *output.record);
}
bool Property::offered(const Subject& subject) const {
  const auto all = outputs();
  return std::any_of(all.begin(), all.end(), [&](const Output& o) { return offers(subject, o); });
}
std::vector<Field> Property::fields() const {
  std::vector<Field> all;
  for (const ConstantField& f : statement().fields) all.push_back({f.name, f.kind, f.size, f.unit, f.reach});
  return all;
}
bool Property::takes(std::size_t numbers) const {
  std::size_t all = 0;
  for (const Field& f : fields()) all += static_cast<std::size_t>(f.size);
  return numbers == all;
}
bool Property::valid(const std::vector<double>& input) const {
  if (!oracles::all_finite(input)) return false;
  std::size_t at = 0;
  const auto is_of = [&](const Field& f) {
    const double* const x = input.data() + at;
    const auto each = [&](const auto& holds) { return std::all_of(x, x + f.size, holds); };
    switch (f.kind) {
      case Kind::quaternion:
        return oracles::norm_defect(scalar(), oracles::exact_vector<4>(x)) <= 8;
      case Kind::any_quaternion:
        return !each([](double a) { return a == 0; });
      case Kind::rotation_matrix:
        return oracles::orthogonality_defect(scalar(), {oracles::exact_vector<9>(x).x}) <= 8;
      case Kind::near_rotation: {
        const oracles::Mat3<> A{oracles::exact_vector<9>(x).x};
        return oracles::orthogonality_distance(A) <= oracles::Real(2) / 5 &&
               determinant(A, cofactors(A)) > 0;
      }
      case Kind::fraction:
        return each([](double a) { return a >= 0 && a <= 1; });
      case Kind::angle:
        return each([&](double a) { return std::fabs(a) <= scalar().pi; });
      default:
        return true;
    }
  };
  for (const Field& f : fields()) {
    if (!is_of(f)) return false;
    at += static_cast<std::size_t>(f.size);
  }
  return true;
}

std::vector<std::unique_ptr<Property>> make_properties(const oracles::Scalar& scalar) {
  std::vector<std::unique_ptr<Property>> all;
  for (auto* make : property_makers) {
    all.push_back(make());
    all.back()->scalar_ = &oracles::scalar_named(scalar.name);  // of static storage
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a->name() < b->name(); });
  return all;
}

}  // namespace liecheck::properties
