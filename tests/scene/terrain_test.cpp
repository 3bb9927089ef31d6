// The ground as heights and as a mesh: beside the plane, and beside closed forms of curved ground.

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <liecheck/scene/effects/terrain.hpp>
#include <random>

#include "contact_run.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

/// Heights z(x, y) on an n x n grid of the given spacing about the origin.
std::string heights(const std::function<double(double, double)>& z, int n, double spacing) {
  std::string text = "ground: {spacing: [" + number(spacing) + ", " + number(spacing) + "], corner: [" +
                     number(-spacing * (n - 1) / 2) + ", " + number(-spacing * (n - 1) / 2) + "], heights: [";
  for (int i = 0; i < n; ++i) {
    text += i ? ",\n  [" : "[";
    for (int j = 0; j < n; ++j)
      text += (j ? ", " : "") + number(z(spacing * (j - 0.5 * (n - 1)), spacing * (i - 0.5 * (n - 1))));
    text += "]";
  }
  return text + "]}\n";
}

const std::string parts[] = {"frames: [c1, c2, c3, c4]", "bodies: all", "frames: [body], radius: 0.12"};
/// A box, by corners or as a ball, thrown onto the ground.
scene::Run thrown(const std::string& ground, const std::string& by, double slope) {
  return runOf("robot: {body: box, mass: 2 kg, size: [0.4, 0.4, 0.2]}\n" + corners(0.2, 0.2, -0.1) + ground +
               "initial: {position: [0.03, 0.02, 0.3], velocity: [0.3, 0.2, 0], angular_velocity: [1, 2, "
               "0.5], attitude: [0, " +
               number(slope) +
               ", 0]}\neffects: [gravity, contact: {stiffness: 1e4, dissipation: 0.4, friction: 0.5, " + by +
               "}]\nintegrator: {name: rkmk4, step: 0.1 ms}\nduration: 0.8 s\n");
}

/// The same motion on the plane, and on flat ground of triangles, whose edges the contacts cross. 1e-8:
/// rounding errors, amplified by several impacts.
TEST(Terrain, FlatHeightsAndAFlatMeshGiveTheMotionOfThePlane) {
  file("flat.obj", "# two triangles\nv -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nf 1 2 3 4\n");
  const std::string flat = heights([](double, double) { return 0.1; }, 12, 0.17);
  for (const std::string& by : parts) {
    const scene::Run plane = thrown("ground: {height: 0.1}\n", by, 0);
    EXPECT_LT((thrown(flat, by, 0).q - plane.q).norm(), 1e-8) << by;
    EXPECT_LT((thrown("ground: {mesh: flat.obj, height: 0.1}\n", by, 0).q - plane.q).norm(), 1e-8) << by;
    EXPECT_GT(plane.outcome.events, 3);
  }
}

TEST(Terrain, TiltedHeightsGiveTheMotionOfTheSlope) {
  const double angle = 0.3;
  const std::string tilted =
      heights([&](double x, double y) { return -std::tan(angle) * x + 0.1 * y; }, 30, 0.11);
  const V3 n = V3(std::tan(angle), -0.1, 1);
  for (const std::string& by : parts) {
    const scene::Run plane = thrown("ground: {normal: " + vector(n) + "}\n", by, angle);
    EXPECT_LT((thrown(tilted, by, angle).q - plane.q).norm(), 1e-8) << by;
  }
}

/// On a ridge, the closest point is the ridge itself, and the ball rolls about it as an inverted pendulum of
/// length r.
TEST(Terrain, ABallPivotsAboutARidge) {
  const double r = 0.1, k = 1e7, m = 2, phi0 = 0.1;
  file("ridge.obj", "v -1 -3 -1\nv -1 3 -1\nv 0 3 0\nv 0 -3 0\nv 1 3 -1\nv 1 -3 -1\nf 1 4 3 2\nf 4 6 5 3\n");
  const double depth = m * g * std::cos(phi0) / k, t = 0.15;
  const scene::Run run =
      runOf("robot: {body: ball, mass: 2, radius: 0.1}\nground: {mesh: ridge.obj}\ninitial: {position: [" +
            number((r - depth) * std::sin(phi0)) + ", 0, " + number((r - depth) * std::cos(phi0)) +
            "]}\neffects: [gravity, contact: {bodies: all, stiffness: 1e7, friction: 2, slip: 1e-6}]\n" +
            radau(t, "1e-9"));
  // I phi'' = m g r sin(phi), I = 7/5 m r^2: the ball is rigid and rolls about the edge
  Eigen::Vector2d phi(phi0, 0);
  rungeKutta(phi, t / 1500, 1500,
             [&](const auto& x) { return Eigen::Vector2d(x[1], g / (1.4 * r) * std::sin(x[0])); });
  EXPECT_GT(phi[0], 1.5 * phi0);
  EXPECT_NEAR(std::atan2(run.q[0], run.q[2]), phi[0], 1e-3);
  EXPECT_NEAR(std::hypot(run.q[0], run.q[2]), r, 1e-5);
}

/// Distance and normal beside a search over all triangles, each by its own least squares over a fine set of
/// points, for points near a rough surface; the sign is that of z - z(x, y).
TEST(Terrain, TheDistanceIsThatOfTheClosestPointOfAllTriangles) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const int n = 9;
  const double spacing = 0.25;
  scene::TriangleMesh mesh;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) mesh.vertices.push_back({j * spacing, i * spacing, 0.5 * uniform(random)});
  for (std::size_t i = 0; i + 1 < n; ++i)
    for (std::size_t j = 0; j + 1 < n; ++j) {
      mesh.triangles.push_back({i * n + j, i * n + j + 1, (i + 1) * n + j + 1});
      mesh.triangles.push_back({i * n + j, (i + 1) * n + j + 1, (i + 1) * n + j});
    }
  const scene::Terrain<double> terrain(mesh);
  const auto vertex = [&](std::size_t k) { return V3(mesh.vertices[k].data()); };
  const auto height = [&](double x, double y) {  // of the triangle whose projection contains (x, y)
    for (const auto& t : mesh.triangles) {
      const V3 a = vertex(t[0]), b = vertex(t[1]) - a, c = vertex(t[2]) - a;
      const double D = b[0] * c[1] - b[1] * c[0], u = ((x - a[0]) * c[1] - (y - a[1]) * c[0]) / D,
                   w = (b[0] * (y - a[1]) - b[1] * (x - a[0])) / D;
      if (u >= 0 && w >= 0 && u + w <= 1) return a[2] + u * b[2] + w * c[2];
    }
    return 0.0;
  };
  for (int k = 0; k < 300; ++k) {
    const V3 p(1 + 0.6 * uniform(random), 1 + 0.6 * uniform(random), 0.6 * uniform(random));
    double closest = 1e9;
    for (const auto& t : mesh.triangles)
      for (int i = 0; i <= 40; ++i)
        for (int j = 0; i + j <= 40; ++j)
          closest = std::min(closest, (p - vertex(t[0]) - i / 40. * (vertex(t[1]) - vertex(t[0])) -
                                       j / 40. * (vertex(t[2]) - vertex(t[0])))
                                          .norm());
    const auto near = terrain.near(p, 1);
    // The best of points 0.01 apart is at most (0.01)^2/(2 d) further, and 0.01 if it is at the surface.
    EXPECT_LE(std::abs(near.distance), closest + 1e-12);
    EXPECT_GE(std::abs(near.distance), closest - std::min(0.01, 1e-4 / std::max(closest, 1e-9)));
    EXPECT_EQ(near.distance > 0, p[2] > height(p[0], p[1])) << p.transpose();
    EXPECT_NEAR(near.n.norm(), 1, 1e-12);
    const double h = 1e-6;
    for (int d = 0; d < 3; ++d) {  // the gradient, except where the closest point jumps
      V3 q = p;
      q[d] += h;
      const auto next = terrain.near(q, 1);
      if ((next.n - near.n).norm() > 1e-3) continue;
      EXPECT_NEAR((next.distance - near.distance) / h, near.n[d], 1e-4);
    }
  }
}

/// A ball that falls beside the ground falls on.
TEST(Terrain, BeyondItsBorderThereIsNoGround) {
  const scene::Run run = runOf(
      "robot: {body: ball, mass: 2, radius: 0.1}\n" + heights([](double, double) { return 0; }, 3, 1.0) +
      "initial: {position: [1.2, 0, 0.5]}\neffects: [gravity, contact: {bodies: all, stiffness: 1e5}]\n" +
      radau(1));
  EXPECT_NEAR(run.q[2], 0.5 - g / 2, 1e-8);
}

/// STL as text and binary, OBJ, and heights of a file give the same ground.
TEST(Terrain, FilesOfTheSameGroundGiveTheSameMotion) {
  file("g.csv", "0, 0.25, 0.125\n0.125, 0, 0.375\n0.25, 0.125, 0\n");
  const double z[3][3] = {{0, 0.25, 0.125}, {0.125, 0, 0.375}, {0.25, 0.125, 0}};
  std::string obj, stl = "solid g\n", binary(84, ' ');
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      obj += "v " + number(j - 1) + " " + number(i - 1) + " " + number(z[i][j]) + "\n";
  const std::uint32_t count = 8;
  std::memcpy(binary.data() + 80, &count, 4);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      for (const auto& t : {std::array{0, 1, 4}, std::array{0, 4, 3}}) {
        obj += "f";
        stl += "facet normal 0 0 1\nouter loop\n";
        binary += std::string(12, '\0');
        for (const int k : t) {
          const int row = i + k / 3, column = j + k % 3;
          obj += " " + std::to_string(3 * row + column + 1) + "//1";
          stl += "vertex " + number(column - 1) + " " + number(row - 1) + " " + number(z[row][column]) + "\n";
          const float x[] = {float(column - 1), float(row - 1), float(z[row][column])};
          binary.append(reinterpret_cast<const char*>(x), 12);
        }
        obj += "\n", stl += "endloop\nendfacet\n", binary += std::string(2, '\0');
      }
  file("g.obj", obj), file("g.stl", stl), file("b.stl", binary);
  const auto motion = [](const std::string& ground) {
    return runOf(
        "robot: {body: ball, mass: 2, radius: 0.1}\nground: {" + ground +
        "}\ninitial: {position: [0.1, -0.2, 0.4]}\neffects: [gravity, contact: {bodies: all, stiffness: 1e4, "
        "dissipation: 0.5, friction: 0.3}]\nintegrator: {name: rkmk4, step: 1 ms}\nduration: 0.5 s\n");
  };
  const Vec heights = motion("heights: g.csv, spacing: [1, 1], corner: [-1, -1]").q;
  EXPECT_EQ(motion("mesh: g.obj").q, heights);
  EXPECT_EQ(motion("mesh: g.stl").q, heights);
  EXPECT_EQ(motion("mesh: b.stl").q, heights);
  EXPECT_GT(std::abs(heights[0] - 0.1), 0.01);
}

TEST(Terrain, BadGroundIsRefusedWithARemedy) {
  const auto ground = [](const std::string& keys) {
    return refusal("robot: {body: needle, radius: 0.1, length: 1}\nground: {" + keys +
                   "}\neffects: [contact: {bodies: all, stiffness: 1}]\nintegrator: {name: rkmk4, step: 1 "
                   "ms}\nduration: 1 s\n");
  };
  file("bad.csv", "0, 1\n2, x\n"), file("empty.obj", "v 0 0 0\n"), file("bad.obj", "v 0 0 0\nf 1 2 3\n");
  EXPECT_EQ(ground("heights: [[0, 0], [0, 0]], spacing: [1, 1]"),
            "s.yaml:3: contact of a cylinder needs a plane as the ground: on heights and meshes take a "
            "capsule instead");
  EXPECT_EQ(ground("heights: [[0, 0], [0]], spacing: [1, 1]"),
            "s.yaml:2: ground.heights has 1 numbers in row 2 and 2 in row 1: rows must have the same length");
  EXPECT_EQ(ground("heights: [[0, 0]], spacing: [1, 1]"),
            "s.yaml:2: ground.heights needs at least two rows of two numbers");
  for (const char* flat : {"spacing: [1, 1], corner: [1e16, 0]", "spacing: [1e-300, 1]"})
    EXPECT_EQ(ground(std::string("heights: [[0, 0], [0, 0]], ") + flat),
              "s.yaml:2: ground.heights: no triangle has an area: 'spacing' vanishes beside 'corner'");
  EXPECT_EQ(ground("heights: bad.csv, spacing: [1, 1]"),
            "s.yaml:2: ground.heights: " + testing::TempDir() + "bad.csv: line 2: 'x' is not a number");
  EXPECT_EQ(ground("heights: [[0, 0], [0, 0]]"),
            "s.yaml:2: ground.heights needs 'spacing: [dx, dy]', the distances of columns and rows");
  EXPECT_EQ(ground("mesh: empty.obj"),
            "s.yaml:2: ground.mesh: " + testing::TempDir() + "empty.obj: no triangle has an area");
  EXPECT_EQ(ground("mesh: bad.obj"),
            "s.yaml:2: ground.mesh: " + testing::TempDir() + "bad.obj: line 2: there is no vertex 2");
  EXPECT_EQ(ground("mesh: bad.csv"), "s.yaml:2: ground.mesh is the name of an .stl or .obj file");
  EXPECT_EQ(ground("normal: [0, 0, 1], mesh: empty.obj"),
            "s.yaml:2: ground has more than one of 'normal', 'heights' and 'mesh': keep one");
}

}  // namespace
