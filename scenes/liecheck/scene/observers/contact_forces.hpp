#pragma once
// The force of the ground on each frame or body that an effect `contact` names, and on all of them: its normal part
// f_n = n . f and its tangential part f - f_n n, in the world's axes. n is the normal of the plane; (0, 0, 1) on heights
// and meshes.

#include <algorithm>
#include <liecheck/scene/observers/observer.hpp>
#include <liecheck/scene/scene.hpp>

namespace liecheck::scene {

inline const PartInfo contact_forces_info{"contact_forces",
                                          "f_n = n . f,  f_t = f - f_n n, of each point and of all of them",
                                          "",
                                          "poses and velocities at samples, and the forces of contact",
                                          {}};

class ContactForcesObserver final : public Observer {
 public:
  ContactForcesObserver(const Parameters&, const Watched& watched)
      : n_(watched.scene->around.normal.data()),
        tau_(std::size_t(watched.model->nv)),
        f_(watched.model->inertias.size(), Force<double>::Zero()) {
    for (const Request& request : watched.scene->effects)
      if (request.name == "contact")
        for (const auto& [key, other] : {std::pair("frames", "bodies"), std::pair("bodies", "frames")})
          if (request.parameters.has(key))
            for (const std::string& name : namesOf(request.parameters.names(key), *watched.scene)) {
              Request one = request;
              one.parameters.values[key].names = {name}, one.parameters.values.erase(other);
              const auto before = std::ranges::count(points_, name, &Point::frame);
              points_.push_back({"contact." + name + (before ? "_" + std::to_string(before + 1) : ""), name,
                                 makeEffect<double>(one, *watched.model, watched.scene->around)});
            }
    if (points_.empty())
      throw std::invalid_argument("contact_forces needs the effect 'contact' in the scene");
  }
  Kinematics needs() const override { return Kinematics::Velocities; }
  std::vector<Column> columns() const override {
    std::vector<Column> all;
    const auto add = [&](const std::string& name) {
      for (const char* part : {".normal", ".tx", ".ty", ".tz"}) all.push_back({name + part, "N"});
    };
    for (const Point& point : points_) add(point.name);
    add("contacts");
    return all;
  }
  void sample(const Now<double>& now, std::span<double> row) override {
    Now<double> free = now;
    free.switches = nullptr;
    std::ranges::fill(row, 0.0);
    const std::size_t sum = row.size() - 4;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      std::ranges::fill(f_, Force<double>::Zero());
      points_[k].contact->add(free, {tau_, f_});
      Vector3<double> f = Vector3<double>::Zero();
      for (std::size_t i = 1; i < f_.size(); ++i) f += f_[i].linear();
      const double normal = n_.dot(f);
      const Vector3<double> tangential = f - normal * n_;
      row[4 * k] = normal, row[sum] += normal;
      for (std::size_t i = 0; i < 3; ++i)
        row[4 * k + 1 + i] = tangential[int(i)], row[sum + 1 + i] += tangential[int(i)];
    }
    largest_ = std::max(largest_, row[sum]);
  }
  std::vector<Figure> figures() const override {
    return {{"largest normal force of all contacts", "N", largest_}};
  }

 private:
  /// The names, or those of all bodies with shapes that move for "all".
  static std::vector<std::string> namesOf(const std::vector<std::string>& names, const Scene& scene) {
    if (names.size() != 1 || names[0] != "all") return names;
    std::vector<std::string> all;
    for (const Shape& s : scene.around.shapes)
      if (scene.model.frames[std::size_t(s.frame)].parentJoint != 0 && !std::ranges::count(all, s.body))
        all.push_back(s.body);
    return all;
  }
  struct Point {
    std::string name, frame;
    std::shared_ptr<const Effect<double>> contact;
  };
  Vector3<double> n_;
  std::vector<Point> points_;
  std::vector<double> tau_;
  std::vector<Force<double>> f_;
  double largest_ = 0;
};

}  // namespace liecheck::scene
