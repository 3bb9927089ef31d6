#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <liecheck/scene_file/shapes.hpp>
#include <liecheck/text/text_file.hpp>
#include <liecheck/text/utf8.hpp>
#include <liecheck/urdf/attributes.hpp>
#include <map>
#include <set>
#include <sstream>

namespace liecheck::scene_file_detail {
namespace {

using scene::Kind;
using scene::TriangleMesh;
using Point = std::array<double, 3>;

constexpr std::size_t max_file_bytes = std::size_t(64) << 20, max_triangles = 200'000,
                      max_line_bytes = std::size_t(4) << 20;

/// Collects triangles. Those without area and repetitions are left out; vertices with the same numbers are one.
class Triangles {
 public:
  void add(const Point& a, const Point& b, const Point& c) {
    const Vector3<double> x(a.data()), y(b.data()), z(c.data());
    const Vector3<double> across = (y - x).cross(z - x);
    if (!std::isfinite(across.squaredNorm())) throw std::invalid_argument("a vertex is not finite");
    if (!(across.squaredNorm() > 0)) return;
    std::array<std::size_t, 3> t{index(a), index(b), index(c)}, first = t;
    std::ranges::rotate(first, std::ranges::min_element(first));
    if (!seen_.insert(first).second) return;
    mesh.triangles.push_back(t);
    if (mesh.triangles.size() > max_triangles)
      throw std::invalid_argument("more than " + std::to_string(max_triangles) +
                                  " triangles: take a coarser one");
  }
  TriangleMesh mesh;

 private:
  std::size_t index(const Point& p) {
    const auto [found, is_new] = indices_.try_emplace(p, mesh.vertices.size());
    if (is_new) mesh.vertices.push_back(p);
    return found->second;
  }
  std::map<Point, std::size_t> indices_;
  std::set<std::array<std::size_t, 3>> seen_;  // each with its smallest index first
};

/// The words of a line.
std::vector<std::string> words(const std::string& line) {
  std::istringstream stream(line);
  return {std::istream_iterator<std::string>(stream), {}};
}
double numberOf(const std::string& word, int line) {
  const auto x = urdf_detail::numbersIn(word);
  if (!x || x->size() != 1)
    throw std::invalid_argument("line " + std::to_string(line) + ": '" + word.substr(0, 60) +
                                "' is not a number");
  return x->front();
}
/// Calls f(words, number) for each line.
template <class F>
void forEachLine(const std::string& content, F f) {
  std::istringstream stream{std::string(withoutByteOrderMark(content))};
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (line.size() > max_line_bytes)  // its words take twenty times as much memory
      throw std::invalid_argument("line " + std::to_string(number) + " is longer than " +
                                  std::to_string(max_line_bytes) + " bytes");
    f(words(line), number);
  }
}

/// An STL file, text or binary (3D Systems 1988).
void readStl(const std::string& content, Triangles& to) {
  std::uint32_t count = 0;
  if (content.size() >= 84) std::memcpy(&count, content.data() + 80, 4);
  if (content.size() == 84 + 50 * std::size_t(count)) {
    for (std::size_t k = 0; k < count; ++k) {
      float x[9];
      std::memcpy(x, content.data() + 84 + 50 * k + 12, sizeof x);
      to.add({x[0], x[1], x[2]}, {x[3], x[4], x[5]}, {x[6], x[7], x[8]});
    }
    return;
  }
  std::vector<Point> corners;
  forEachLine(content, [&](const std::vector<std::string>& w, int line) {
    if (w.size() != 4 || w[0] != "vertex") return;
    corners.push_back({numberOf(w[1], line), numberOf(w[2], line), numberOf(w[3], line)});
    if (corners.size() % 3 == 0) to.add(corners.end()[-3], corners.end()[-2], corners.end()[-1]);
  });
  if (corners.empty())
    throw std::invalid_argument(std::to_string(count) + " triangles in " + std::to_string(content.size()) +
                                " bytes: the STL file is cut off, or is none");
}

/// The vertices and faces of an OBJ file. A face of more than three vertices is a fan.
void readObj(const std::string& content, Triangles& to) {
  std::vector<Point> points;
  forEachLine(content, [&](const std::vector<std::string>& w, int line) {
    if (w.size() >= 4 && w[0] == "v")
      points.push_back({numberOf(w[1], line), numberOf(w[2], line), numberOf(w[3], line)});
    if (w.empty() || w[0] != "f") return;
    std::vector<Point> face;
    for (std::size_t k = 1; k < w.size(); ++k) {
      const double i = numberOf(w[k].substr(0, w[k].find('/')), line);
      const double at = i < 0 ? double(points.size()) + i : i - 1;
      if (!(at >= 0 && at < double(points.size())))
        throw std::invalid_argument("line " + std::to_string(line) + ": there is no vertex " + w[k]);
      face.push_back(points[std::size_t(at)]);
    }
    for (std::size_t k = 2; k < face.size(); ++k) to.add(face[0], face[k - 1], face[k]);
  });
}

/// Two triangles for each cell of a grid, split along the diagonal of growing x and y.
void addHeights(const std::vector<std::vector<double>>& rows, const std::vector<double>& spacing,
                const std::vector<double>& corner, Triangles& to) {
  const auto at = [&](std::size_t row, std::size_t column) -> Point {
    return {corner[0] + double(column) * spacing[0], corner[1] + double(row) * spacing[1], rows[row][column]};
  };
  if (rows.size() < 2 || rows[0].size() < 2)
    throw std::invalid_argument("ground.heights needs at least two rows of two numbers");
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].size() != rows[0].size())
      throw std::invalid_argument("ground.heights has " + std::to_string(rows[i].size()) +
                                  " numbers in row " + std::to_string(i + 1) + " and " +
                                  std::to_string(rows[0].size()) +
                                  " in row 1: rows must have the same length");
  for (std::size_t i = 0; i + 1 < rows.size(); ++i)
    for (std::size_t j = 0; j + 1 < rows[0].size(); ++j) {
      to.add(at(i, j), at(i, j + 1), at(i + 1, j + 1));
      to.add(at(i, j), at(i + 1, j + 1), at(i + 1, j));
    }
}

/// Calls f(content) with the content of the file that `node` names. Errors of both name the file.
template <class F>
void readFile(const Text& text, const YAML::Node& node, const std::string& what, F f) {
  const std::string path = text.path(node, what);
  try {
    std::string content = readTextFile(path, max_file_bytes);
    if (content.size() > max_file_bytes)
      throw std::invalid_argument("longer than " + std::to_string(max_file_bytes) + " bytes");
    f(content);
  } catch (const FileError& e) {
    text.refuse(node, what + ": " + path + ": " + e.what());
  } catch (const std::invalid_argument& e) {
    text.refuse(node, what + ": " + path + ": " + e.what());
  }
}

std::vector<std::vector<double>> readHeights(const Text& text, const YAML::Node& node) {
  std::vector<std::vector<double>> rows;
  if (node.IsSequence()) {
    for (const auto& row : node) rows.push_back(text.numbers(row, "ground.heights", "m"));
    return rows;
  }
  readFile(text, node, "ground.heights", [&](std::string& content) {
    for (char& c : content)
      if (c == ',' || c == ';') c = ' ';
    forEachLine(content, [&](const std::vector<std::string>& line, int number) {
      if (line.empty()) return;
      rows.emplace_back();
      for (const std::string& word : line) rows.back().push_back(numberOf(word, number));
    });
  });
  return rows;
}

void readMesh(const Text& text, const YAML::Node& node, Triangles& to) {
  readFile(text, node, "ground.mesh", [&](const std::string& content) {
    const std::string& path = node.Scalar();
    if (path.ends_with(".stl") || path.ends_with(".STL"))
      readStl(content, to);
    else if (path.ends_with(".obj") || path.ends_with(".OBJ"))
      readObj(content, to);
    else
      text.refuse(node, "ground.mesh is the name of an .stl or .obj file");
    if (to.mesh.triangles.empty()) throw std::invalid_argument("no triangle has an area");
  });
}

}  // namespace

void readGround(const Text& text, const YAML::Node& ground, scene::Scene& scene) {
  if (!ground.IsDefined() || ground.IsNull()) return;
  text.checkKeys(ground, "ground", {"height", "normal", "heights", "spacing", "corner", "mesh"});
  scene.around.ground = true;
  if (ground["height"].IsDefined()) scene.around.height = text.number(ground["height"], "ground.height", "m");
  const YAML::Node normal = ground["normal"], heights = ground["heights"], mesh = ground["mesh"];
  if (int(normal.IsDefined()) + int(heights.IsDefined()) + int(mesh.IsDefined()) > 1)
    text.refuse(ground, "ground has more than one of 'normal', 'heights' and 'mesh': keep one");
  for (const char* key : {"spacing", "corner"})
    if (ground[key].IsDefined() && !heights.IsDefined())
      text.refuse(ground[key], std::string("ground.") + key + " needs 'heights'");
  if (normal.IsDefined()) {
    const auto n = text.numbers(normal, "ground.normal", "1", 3);
    const double length = std::hypot(n[0], n[1], n[2]);
    if (!(n[2] > 0) || !std::isfinite(length))
      text.refuse(normal, "ground.normal must point upwards: its third number must be above 0");
    scene.around.normal = {n[0] / length, n[1] / length, n[2] / length};
  }
  if (!heights.IsDefined() && !mesh.IsDefined()) return;
  text.at(Text::lineOf(heights.IsDefined() ? heights : mesh), [&] {
    Triangles all;
    if (heights.IsDefined()) {
      if (!ground["spacing"].IsDefined())
        text.refuse(ground, "ground.heights needs 'spacing: [dx, dy]', the distances of columns and rows");
      const auto spacing = text.numbers(ground["spacing"], "ground.spacing", "m", 2);
      if (!(spacing[0] > 0 && spacing[1] > 0))
        text.refuse(ground["spacing"], "ground.spacing must be above 0");
      const auto corner = ground["corner"].IsDefined()
                              ? text.numbers(ground["corner"], "ground.corner", "m", 2)
                              : std::vector<double>{0, 0};
      addHeights(readHeights(text, heights), spacing, corner, all);
      if (all.mesh.triangles.empty())
        text.refuse(heights, "ground.heights: no triangle has an area: 'spacing' vanishes beside 'corner'");
    } else {
      readMesh(text, mesh, all);
    }
    for (Point& p : all.mesh.vertices) p[2] += scene.around.height;
    scene.around.mesh = std::make_shared<const TriangleMesh>(std::move(all.mesh));
  });
}

}  // namespace liecheck::scene_file_detail
