#pragma once
// Built-in bodies. By default the centre of mass is at the origin and the principal axes are x, y and z.

#include <liecheck/scene/parameters.hpp>
#include <liecheck/spatial/exp_log.hpp>
#include <liecheck/spatial/inertia.hpp>

namespace liecheck::scene {

struct BodyEntry {
  PartInfo info;
  double (*mass)(const Parameters&);
  Vector3<double> (*moments)(const Parameters&);  ///< principal, about the centre of mass
};

inline const std::vector<BodyEntry>& bodyEntries() {
  using P = const Parameters&;
  using V = Vector3<double>;
  static const auto mass = [](P p) { return p.number("mass"); };
  static const auto keys = [](std::vector<Key> own) {
    own.insert(own.begin(), {"mass", Kind::Positive, "kg", "1", "m"});
    own.push_back({"centre", Kind::Vector, "m", "[0, 0, 0]", "centre of mass in the body's frame"});
    own.push_back({"turned", Kind::Vector, "rad", "[0, 0, 0]", "rotation vector of the principal axes"});
    return own;
  };
  static const std::vector<BodyEntry> all = {
      {{"box", "I = m/12 (b^2 + c^2)", "", "", keys({{"size", Kind::Vector, "m", nullptr, "side lengths"}})},
       +mass,
       [](P p) {
         const auto& s = p.numbers("size");
         if (s[0] < 0 || s[1] < 0 || s[2] < 0) throw std::invalid_argument("a side of a box is below 0");
         const double k = p.number("mass") / 12;
         return V(k * (s[1] * s[1] + s[2] * s[2]), k * (s[0] * s[0] + s[2] * s[2]),
                  k * (s[0] * s[0] + s[1] * s[1]));
       }},
      {{"plate", "a box without thickness, I_z = I_x + I_y", "", "",
        keys({{"length", Kind::Positive, "m", nullptr, "along x"},
              {"width", Kind::Positive, "m", nullptr, "along y"}})},
       +mass,
       [](P p) {
         const double k = p.number("mass") / 12, a = p.number("length"), b = p.number("width");
         return V(k * b * b, k * a * a, k * b * b + k * a * a);
       }},
      {{"needle", "a cylinder along z, I_x = m (l^2/12 + r^2/4), I_z = m r^2/2", "", "",
        keys({{"length", Kind::Positive, "m", nullptr, "l"}, {"radius", Kind::Positive, "m", nullptr, "r"}})},
       +mass,
       [](P p) {
         const double m = p.number("mass"), l = p.number("length"), r = p.number("radius");
         const double across = m * (l * l / 12 + r * r / 4);
         return V(across, across, m * r * r / 2);
       }},
      {{"ball", "I = 2/5 m r^2", "", "", keys({{"radius", Kind::Positive, "m", nullptr, "r"}})},
       +mass,
       [](P p) {
         const double r = p.number("radius");
         return V(V::Constant(p.number("mass") * 2 / 5 * r * r));
       }},
      {{"top", "I_x = I_y transverse, I_z axial, about the centre of mass", "", "",
        keys({{"transverse", Kind::Positive, "kg m^2", nullptr, "I_x = I_y"},
              {"axial", Kind::Positive, "kg m^2", nullptr, "I_z"}})},
       +mass,
       [](P p) { return V(p.number("transverse"), p.number("transverse"), p.number("axial")); }},
      {{"body", "I = diag(moments) about the centre of mass", "", "",
        keys({{"moments", Kind::Vector, "kg m^2", nullptr, "principal moments"}})},
       +mass,
       [](P p) { return V(p.numbers("moments")[0], p.numbers("moments")[1], p.numbers("moments")[2]); }}};
  return all;
}

/// Throws std::invalid_argument if no real body can have such moments.
inline Inertia<double> inertiaOf(const BodyEntry& body, const Parameters& p) {
  const auto vector = [&](const char* key) {
    return Vector3<double>(p.numbers(key)[0], p.numbers(key)[1], p.numbers(key)[2]);
  };
  const Vector3<double> moments = body.moments(p), turned = vector("turned");
  if (!moments.allFinite())
    throw std::invalid_argument("the moments of inertia overflow: take a smaller mass or size");
  Matrix3<double> I = moments.asDiagonal();
  if (!turned.isZero(0)) {
    const Matrix3<double> R = exp3<double>(turned), RI = R * I;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) I(i, j) = I(j, i) = RI.row(i).dot(R.row(j));
  }
  const Inertia<double> inertia(body.mass(p), vector("centre"), I);
  if (!inertia.isValid() || !(moments.minCoeff() > 0))
    throw std::invalid_argument(
        "no body can have these moments of inertia: each must be above 0 and no larger than the sum of the "
        "other two");
  return inertia;
}

}  // namespace liecheck::scene
