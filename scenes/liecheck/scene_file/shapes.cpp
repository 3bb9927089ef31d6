#include <algorithm>
#include <liecheck/scene_file/shapes.hpp>
#include <liecheck/urdf/attributes.hpp>

namespace liecheck::scene_file_detail {
namespace {

using scene::Key;
using scene::Kind;
using scene::Shape;
using urdf_detail::Element;
using V3 = Vector3<double>;

SE3<double> turnedAndMoved(const scene::Parameters& p, const char* attitude, const char* position) {
  const auto &phi = p.numbers(attitude), &x = p.numbers(position);
  return {exp3<double>(V3(phi[0], phi[1], phi[2])), V3(x[0], x[1], x[2])};
}

/// The numbers of an attribute; none if there are not `count`, or one of them is not above 0.
std::vector<double> sizes(const Element& e, const char* attribute, std::size_t count) {
  const char* text = e.attribute(attribute);
  const auto x = urdf_detail::numbersIn(text ? text : "");
  const auto positive = [](double value) { return value > 0; };
  return x && x->size() == count && std::all_of(x->begin(), x->end(), positive) ? *x : std::vector<double>();
}

/// The pose of <origin>, R = R_z(yaw) R_y(pitch) R_x(roll); none if its numbers cannot be read.
std::optional<SE3<double>> origin(const Element& collision) {
  const Element* e = collision.first("origin");
  const auto read = [&](const char* name) {
    const char* text = e ? e->attribute(name) : nullptr;
    return urdf_detail::numbersIn(text ? text : "0 0 0");
  };
  const auto x = read("xyz"), rpy = read("rpy");
  if (!x || !rpy || x->size() != 3 || rpy->size() != 3) return {};
  const Matrix3<double> R = exp3<double>(V3(0, 0, (*rpy)[2])) * exp3<double>(V3(0, (*rpy)[1], 0)) *
                            exp3<double>(V3((*rpy)[0], 0, 0));
  return SE3<double>(R, V3((*x)[0], (*x)[1], (*x)[2]));
}

Shape shapeOf(const Element& collision, const std::string& link, int frame) {
  using Type = Shape::Type;
  const std::string line = " in line " + std::to_string(collision.line) + " of the URDF";
  Shape shape{Type::Unusable, {}, link, frame, SE3<double>::Identity(), "has no geometry" + line};
  const Element* geometry = collision.first("geometry");
  if (!geometry || geometry->children.empty()) return shape;
  const Element& e = geometry->children[0];
  const std::string& kind = e.name;
  shape.why = "is a " + kind + line;
  const bool round = kind == "cylinder" || kind == "capsule";
  if (kind != "sphere" && kind != "box" && !round) return shape;
  shape.why += " whose sizes or origin cannot be read";
  const auto X = origin(collision);
  const std::vector<double> first = kind == "box" ? sizes(e, "size", 3) : sizes(e, "radius", 1),
                            second = round ? sizes(e, "length", 1) : std::vector{0.0};
  if (!X || first.empty() || second.empty()) return shape;
  std::copy(first.begin(), first.end(), shape.size.begin());
  if (round) shape.size[1] = second[0];
  shape.X_FS = *X, shape.why.clear();
  shape.type = kind == "box"        ? Type::Box
               : kind == "sphere"   ? Type::Sphere
               : kind == "cylinder" ? Type::Cylinder
                                    : Type::Capsule;
  return shape;
}

/// Replaces each cylinder with spheres of its radius about both ends by a capsule. Positions and radii may
/// differ by 1 % of the radius.
void joinCapsules(std::vector<Shape>& link) {
  for (std::size_t i = 0; i < link.size(); ++i) {
    if (link[i].type != Shape::Type::Cylinder) continue;
    const double r = link[i].size[0];
    const auto endAt = [&](double z) {
      const V3 end = link[i].X_FS.act(V3(0, 0, z));
      return std::find_if(link.begin(), link.end(), [&](const Shape& s) {
        return s.type == Shape::Type::Sphere && std::abs(s.size[0] - r) <= 0.01 * r &&
               (s.X_FS.translation() - end).norm() <= 0.01 * r;
      });
    };
    const auto top = endAt(link[i].size[1] / 2), bottom = endAt(-link[i].size[1] / 2);
    if (top == link.end() || bottom == link.end()) continue;
    link[i].type = Shape::Type::Capsule;
    const auto first = std::min(top, bottom) - link.begin(), last = std::max(top, bottom) - link.begin();
    link.erase(link.begin() + last), link.erase(link.begin() + first);
    i = std::size_t(-1);  // the indices have changed
  }
}

}  // namespace

const std::vector<scene::PartInfo>& shapeInfos() {
  static const auto keys = [](std::vector<Key> own) {
    own.insert(own.begin(),
               {"on", Kind::Frame, "", nullptr, "a frame of the body, by which effects name it"});
    own.push_back({"position", Kind::Vector, "m", "[0, 0, 0]", "of the shape's centre, in that frame"});
    own.push_back({"attitude", Kind::Vector, "rad", "[0, 0, 0]", "rotation vector, in that frame"});
    return own;
  };
  static const Key radius = {"radius", Kind::Positive, "m", nullptr, "r"};
  static const std::vector<scene::PartInfo> all = {
      {"sphere", "|x| <= r", "", "", keys({radius})},
      {"capsule", "a sphere about each point of a segment of the z axis", "", "",
       keys({radius, {"length", Kind::Positive, "m", nullptr, "of the segment"}})},
      {"cylinder", "about the z axis", "", "",
       keys({radius, {"length", Kind::Positive, "m", nullptr, "along z"}})},
      {"box", "|x_i| <= s_i/2", "", "",
       keys({{"size", Kind::Vector, "m", nullptr, "s, the side lengths; one may be 0"}})}};
  return all;
}

std::vector<Shape> shapeOfBody(const std::string& kind, const scene::Parameters& p, const std::string& body,
                               int frame) {
  using Type = Shape::Type;
  Shape shape{Type::Box, {}, body, frame, turnedAndMoved(p, "turned", "centre")};
  if (kind == "box")
    std::copy_n(p.numbers("size").begin(), 3, shape.size.begin());
  else if (kind == "plate")
    shape.size = {p.number("length"), p.number("width"), 0};
  else if (kind == "needle")
    shape.type = Type::Cylinder, shape.size = {p.number("radius"), p.number("length"), 0};
  else if (kind == "ball")
    shape.type = Type::Sphere, shape.size = {p.number("radius"), 0, 0};
  else
    return {};
  return {shape};
}

std::vector<Shape> shapesOfUrdf(const std::string& urdf, const Model<double>& model) {
  std::vector<Shape> all;
  for (const Element& link : urdf_detail::parseXml(urdf, urdf_detail::Messages("URDF text")).children) {
    if (link.name != "link") continue;
    const std::string name = link.attribute("name");
    std::vector<Shape> own;
    for (const Element& e : link.children)
      if (e.name == "collision") own.push_back(shapeOf(e, name, model.getFrameId(name, FrameType::BODY)));
    joinCapsules(own);
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

void readShapes(const Text& text, const YAML::Node& shapes, scene::Scene& scene) {
  if (!shapes.IsDefined() || shapes.IsNull()) return;
  if (!shapes.IsSequence())
    text.refuse(shapes, "shapes is a list: [{shape: sphere, on: FRAME, radius: 0.1}]");
  std::vector<std::string> kinds;
  for (const scene::PartInfo& info : shapeInfos()) kinds.emplace_back(info.name);
  std::vector<Shape> own;
  for (const auto& node : shapes) {
    if (!node.IsMap() || !node["shape"].IsDefined())
      text.refuse(node, "a shape needs 'shape': sphere, capsule, cylinder or box");
    const std::string kind = text.word(node["shape"], "shape");
    const std::size_t i = text.place(node["shape"], kind, kinds, "no shape is named '" + kind + "'");
    const auto p =
        text.parameters(node, Text::lineOf(node), kind, shapeInfos()[i].keys, &scene.model, {"shape"});
    Shape shape{Shape::Type(i),
                {},
                p.word("on"),
                scene.model.requireFrameId(p.word("on")),
                turnedAndMoved(p, "attitude", "position")};
    if (kind == "box") {
      std::copy_n(p.numbers("size").begin(), 3, shape.size.begin());
      const auto zeros = std::count(shape.size.begin(), shape.size.end(), 0.0);
      if (zeros > 1 || *std::min_element(shape.size.begin(), shape.size.end()) < 0)
        text.refuse(node, "box.size must be above 0; one side may be 0");
    } else {
      shape.size = {p.number("radius"), kind == "sphere" ? 0 : p.number("length"), 0};
    }
    own.push_back(shape);
  }
  std::erase_if(scene.around.shapes, [&](const Shape& old) {
    return std::any_of(own.begin(), own.end(), [&](const Shape& s) { return s.body == old.body; });
  });
  scene.around.shapes.insert(scene.around.shapes.end(), own.begin(), own.end());
}

}  // namespace liecheck::scene_file_detail
