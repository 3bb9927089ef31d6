#pragma once
// The ground as a surface of triangles: signed distance and normal at a point, by the closest point of the
// surface (Ericson 2005, Real-Time Collision Detection, 5.1.5). The sign is that of (p - closest point) . m
// with the normal m of the triangle, the sum of both normals at an edge, and the sum weighted by angles at a
// vertex (Baerentzen & Aanaes 2005). A point beyond the border of an open surface is above it. The distance
// is continuous elsewhere, and so is the potential of a force that depends on it. Its gradient, the normal,
// jumps below a ridge and above a valley, where two points of the surface are equally close; there, steps of
// a simulation do not end.
//
// A grid over x and y holds the triangles above each cell. Cells are searched in rings about p until none can
// be closer, so that a query near the surface costs the same for any number of triangles.

#include <cmath>
#include <liecheck/scene/shapes.hpp>
#include <liecheck/spatial/types.hpp>
#include <map>

namespace liecheck::scene {

/// Distance of a point from the ground, below 0 inside it, and the unit normal n = grad distance.
template <Scalar S>
struct Near {
  S distance;
  Vector3<S> n;
};

template <Scalar S>
class Terrain {
 public:
  explicit Terrain(const TriangleMesh& mesh) {
    for (const auto& t : mesh.triangles) addTriangle(mesh, t);
    addPseudonormals(mesh);
    addGrid(mesh);
  }

  /// Exact if the distance is below `reach`; otherwise some distance of at least `reach`.
  Near<S> near(const Vector3<S>& p, const S& reach) const {
    Near<S> best{std::numeric_limits<S>::max(), Vector3<S>(S(0), S(0), S(1))};
    const double x = double(p[0]) - low_[0], y = double(p[1]) - low_[1];
    const int i = place(x, 0), j = place(y, 1);
    const double to_border = std::max(0.0, std::min(std::min(x - i * cell_, (i + 1) * cell_ - x),
                                                    std::min(y - j * cell_, (j + 1) * cell_ - y)));
    for (int ring = 0; ring < std::max(count_[0], count_[1]); ++ring) {
      if (ring > 0) {
        const S far = best.distance < S(0) ? S(-best.distance) : std::min(best.distance, reach);
        if (S(to_border + (ring - 1) * cell_) > far) break;
      }
      for (int b = j - ring; b <= j + ring; ++b) {
        if (b < 0 || b >= count_[1]) continue;
        const int step = ring == 0 || b == j - ring || b == j + ring ? 1 : 2 * ring;
        for (int a = i - ring; a <= i + ring; a += step)
          if (a >= 0 && a < count_[0]) searchCell(std::size_t(b * count_[0] + a), p, best);
      }
    }
    best.distance = std::min(best.distance, S(reach + S(cell_)));
    return best;
  }

 private:
  /// Normals 0: of the triangle; 1 to 3: of the edges 01, 12, 20; 4 to 6: of the vertices. Those of edges and
  /// vertices are not normalised, and are zero at the border of the surface.
  struct Triangle {
    std::array<Vector3<S>, 3> x;
    std::array<Vector3<S>, 7> normal;
  };
  using Point = std::array<double, 3>;

  static Vector3<S> vectorOf(const Point& x) { return {S(x[0]), S(x[1]), S(x[2])}; }

  void addTriangle(const TriangleMesh& mesh, const std::array<std::size_t, 3>& t) {
    Triangle own;
    for (std::size_t k = 0; k < 3; ++k) own.x[k] = vectorOf(mesh.vertices[t[k]]);
    using std::sqrt;
    const Vector3<S> m = cross<S>(Vector3<S>(own.x[1] - own.x[0]), Vector3<S>(own.x[2] - own.x[0]));
    own.normal[0] = m / S(sqrt(m.squaredNorm()));
    triangles_.push_back(own);
  }
  void addPseudonormals(const TriangleMesh& mesh) {
    struct Edge {
      Vector3<S> normal = Vector3<S>::Zero();
      int triangles = 0;
    };
    std::map<std::pair<std::size_t, std::size_t>, Edge> edges;
    std::vector<Vector3<S>> vertices(mesh.vertices.size(), Vector3<S>::Zero());
    const auto forEachCorner = [&](auto f) {
      for (std::size_t i = 0; i < triangles_.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t a = mesh.triangles[i][k], b = mesh.triangles[i][(k + 1) % 3];
          f(triangles_[i], k, a, b, edges[std::minmax(a, b)]);
        }
    };
    forEachCorner([&](const Triangle& t, std::size_t k, std::size_t a, std::size_t, Edge& edge) {
      const Vector3<S> e = t.x[(k + 1) % 3] - t.x[k], f = t.x[(k + 2) % 3] - t.x[k];
      using std::sqrt, std::atan2;
      const S angle = atan2(S(sqrt(cross<S>(e, f).squaredNorm())), S(e.dot(f)));
      vertices[a] += angle * t.normal[0];
      edge.normal += t.normal[0], ++edge.triangles;
    });
    forEachCorner([&](const Triangle&, std::size_t, std::size_t a, std::size_t b, Edge& edge) {
      if (edge.triangles == 1) edge.normal.setZero(), vertices[a].setZero(), vertices[b].setZero();
    });
    forEachCorner([&](Triangle& t, std::size_t k, std::size_t a, std::size_t, const Edge& edge) {
      t.normal[1 + k] = edge.normal, t.normal[4 + k] = vertices[a];
    });
  }
  /// About one cell for each pair of triangles, that is, one for each cell of a grid of heights; larger cells if
  /// many triangles overlap, so that the grid takes at most 32 MB.
  void addGrid(const TriangleMesh& mesh) {
    Point high = mesh.vertices[mesh.triangles[0][0]];
    low_ = high;
    for (const auto& t : mesh.triangles)
      for (const std::size_t v : t)
        for (std::size_t d = 0; d < 3; ++d)
          low_[d] = std::min(low_[d], mesh.vertices[v][d]), high[d] = std::max(high[d], mesh.vertices[v][d]);
    const double wide = high[0] - low_[0], deep = high[1] - low_[1];
    cell_ = std::max({std::sqrt(2 * wide * deep / double(triangles_.size())), wide / 1000, deep / 1000});
    constexpr std::size_t most_entries = 4'000'000;
    for (std::size_t entries = most_entries + 1; entries > most_entries; cell_ *= 2) {
      count_ = {int(wide / cell_) + 1, int(deep / cell_) + 1};
      entries = 0;
      for (const auto& t : mesh.triangles) {
        const auto [from, to] = cellsOf(mesh, t);
        entries += std::size_t(to[0] - from[0] + 1) * std::size_t(to[1] - from[1] + 1);
      }
    }
    cell_ /= 2;
    cells_.resize(std::size_t(count_[0]) * std::size_t(count_[1]));
    for (std::size_t k = 0; k < triangles_.size(); ++k) {
      const auto [from, to] = cellsOf(mesh, mesh.triangles[k]);
      for (int b = from[1]; b <= to[1]; ++b)
        for (int a = from[0]; a <= to[0]; ++a) cells_[std::size_t(b * count_[0] + a)].push_back(k);
    }
  }
  /// The first and last column and row of cells that a triangle may touch.
  std::pair<std::array<int, 2>, std::array<int, 2>> cellsOf(const TriangleMesh& mesh,
                                                            const std::array<std::size_t, 3>& t) const {
    std::array<int, 2> from = count_, to = {0, 0};
    for (const std::size_t v : t)
      for (std::size_t d = 0; d < 2; ++d) {
        const int at = place(mesh.vertices[v][d] - low_[d], d);
        from[d] = std::min(from[d], at), to[d] = std::max(to[d], at);
      }
    return {from, to};
  }
  /// The row or column of a coordinate, of the nearest cell if it is outside the grid.
  int place(double x, std::size_t d) const { return int(std::clamp(x / cell_, 0.0, double(count_[d] - 1))); }

  void searchCell(std::size_t cell, const Vector3<S>& p, Near<S>& best) const {
    using std::sqrt, std::abs;
    for (const std::size_t k : cells_[cell]) {
      const Triangle& t = triangles_[k];
      const auto [closest, part] = closestOn(t, p);
      const Vector3<S> away = p - closest;
      // Above the interior of the triangle, `away` is parallel to its normal, which has fewer rounding
      // errors.
      S distance = part == 0 ? S(t.normal[0].dot(away)) : S(sqrt(away.squaredNorm()));
      if (part != 0 && t.normal[part].dot(away) < S(0)) distance = -distance;
      if (!(S(abs(distance)) < S(abs(best.distance)))) continue;
      best = {distance, part == 0 || distance == S(0) ? t.normal[0] : Vector3<S>(away / distance)};
    }
  }
  /// The closest point of a triangle, and the part of it where it lies, as in Triangle::normal.
  static std::pair<Vector3<S>, std::size_t> closestOn(const Triangle& t, const Vector3<S>& p) {
    const auto& [a, b, c] = t.x;
    const Vector3<S> ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const S d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp),
            d6 = ac.dot(cp);
    const S zero(0);
    if (d1 <= zero && d2 <= zero) return {a, 4};
    if (d3 >= zero && d4 <= d3) return {b, 5};
    if (d6 >= zero && d5 <= d6) return {c, 6};
    const S vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= zero && d1 >= zero && d3 <= zero) return {Vector3<S>(a + S(d1 / (d1 - d3)) * ab), 1};
    if (vb <= zero && d2 >= zero && d6 <= zero) return {Vector3<S>(a + S(d2 / (d2 - d6)) * ac), 3};
    const S d43 = d4 - d3, d56 = d5 - d6;
    if (va <= zero && d43 >= zero && d56 >= zero)
      return {Vector3<S>(b + S(d43 / (d43 + d56)) * Vector3<S>(c - b)), 2};
    const S all = va + vb + vc;
    return {Vector3<S>(a + S(vb / all) * ab + S(vc / all) * ac), 0};
  }

  std::vector<Triangle> triangles_;
  std::vector<std::vector<std::size_t>> cells_;
  Point low_;
  std::array<int, 2> count_;
  double cell_;
};

}  // namespace liecheck::scene
