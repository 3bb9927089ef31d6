// Boxes, capsules, cylinders and the collision elements of URDFs on the plane, beside closed forms.

#include <gtest/gtest.h>

#include <numbers>

#include "contact_run.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

const std::string law = "stiffness: 1e5, friction: 0.6, slip: 1e-5";

/// It rolls down the slope without slipping, with g sin(a)/(1 + I/(m r^2)) about the axis y, if friction
/// suffices.
TEST(Shapes, CapsulesCylindersAndBallsRollDownASlopeAsTheirInertiaSays) {
  const double angle = 0.3, r = 0.1, I = 0.012, m = 2, t = 0.5;
  const V3 n(std::sin(angle), 0, std::cos(angle));
  for (const std::string shape : {"sphere", "capsule, length: 0.4", "cylinder, length: 0.4"}) {
    const bool one = shape == "sphere";
    const double depth = m * g * n[2] / 1e5 / (one ? 1 : 2);  // each end carries a half
    const scene::Run run =
        runOf("robot: {body: body, mass: 2, moments: [0.03, 0.012, 0.03]}\nground: {normal: " + vector(n) +
              "}\nshapes: [{shape: " + shape + ", on: body, radius: 0.1, attitude: [90 deg, 0, 0]}]\n" +
              "initial: {position: " + vector(V3((r - depth) * n)) +
              "}\neffects: [gravity, contact: {bodies: all, " + law + "}]\n" + radau(t));
    // 2e-4: the creep of 1e-5 m/s, and the time of a slip at the start. A cylinder's rims bulge by 5e-7 r.
    EXPECT_NEAR(velocity(run).norm(), t * g * std::sin(angle) / (1 + I / (m * r * r)), 2e-4) << shape;
    EXPECT_NEAR(run.q[1], 0, 1e-9) << shape;
  }
}

/// A disk whose centre is at rest rolls on its edge with the precession O^2 = m g R/(I sin(a)) = 4 g/(R
/// sin(a)), a its angle with the ground: d/dt (I O sin(a) e) = m g R cos(a) across (Euler's disk; Moffatt
/// 2000).
TEST(Shapes, ADiskRollsOnItsRimWithThePrecessionOfEulersDisk) {
  const double a = 0.6, R = 0.1, m = 0.5, k = 1e5, precession = std::sqrt(4 * g / (R * std::sin(a)));
  const double t = 2 * std::numbers::pi / precession;
  const scene::Run run = runOf(
      "robot: {body: body, mass: 0.5, moments: [1.25e-3, 1.25e-3, 2.5e-3]}\nground: {height: 0}\n"
      "shapes: [{shape: cylinder, on: body, radius: 0.1, length: 1e-9}]\ninitial: {position: [0, 0, " +
      number(R * std::sin(a) - m * g / (2 * k)) + "], attitude: [" + number(a) +
      ", 0, 0], angular_velocity: [0, " + number(precession * std::sin(a)) +
      ", 0]}\neffects: [gravity, contact: {bodies: all, " + law + "}]\n" + radau(0.25 * t, "1e-9"));
  // After a quarter of a turn the axis has turned by 90 degrees about z. The contact yields by m g/(2 k) =
  // 2.5e-5 m, which is 4e-4 of the height, and so do angles and places differ.
  const V3 axis = attitude(run.q).act(V3(0, 0, 1));
  EXPECT_NEAR(axis[0], std::sin(a), 2e-3);
  EXPECT_NEAR(axis[1], 0, 2e-3);
  EXPECT_NEAR(axis[2], std::cos(a), 2e-3);
  EXPECT_NEAR(run.q[0], 0, 5e-3 * R);
  EXPECT_NEAR(run.q[1], 0, 5e-3 * R);
}

/// On its end, at the height l/2 + b R - m g/k with b = 1/1000, a cylinder is at rest. Tilted less than its
/// angle of balance atan(2 R/l) it falls back; tilted more, it falls over.
TEST(Shapes, ACylinderStandsOnItsEndAndFallsBeyondItsAngleOfBalance) {
  const double R = 0.1, l = 0.4, m = 3, k = 1e5;
  const auto at = [&](double tilt, double t) {
    return runOf(
        "robot: {body: needle, mass: 3, radius: 0.1, length: 0.4}\nground: {height: 0}\n"
        "initial: {position: [0, 0, " +
        number(l / 2 * std::cos(tilt) + R * std::hypot(std::sin(tilt), 1e-3) - m * g / k) +
        "], attitude: [0, " + number(tilt) +
        ", 0]}\neffects: [gravity, contact: {bodies: body, stiffness: 1e5, friction: 0.6, slip: 0.01, "
        "dissipation: 2}]\n"
        "integrator: {name: rkmk4, step: 0.2 ms}\nduration: " +
        number(t) + " s\n");
  };
  EXPECT_NEAR(at(0, 1).q[2], l / 2 + 1e-3 * R - m * g / k, 1e-9);
  const double balance = std::atan(2 * R / l);
  const auto upright = [&](const scene::Run& run) { return attitude(run.q).act(V3(0, 0, 1))[2]; };
  EXPECT_GT(upright(at(0.95 * balance, 1)), std::cos(0.95 * balance));
  EXPECT_LT(upright(at(1.05 * balance, 1)), std::cos(1.2 * balance));
}

/// The box of a built-in body moves as points at its eight corners do, to the last bit.
TEST(Shapes, ABoxIsItsEightCorners) {
  std::string corners, names;
  for (int k = 0; k < 8; ++k) {
    const std::string name = "c" + std::to_string(k);
    corners += "  - {name: " + name + ", on: body, position: " +
               vector(V3(k & 4 ? 0.2 : -0.2, k & 2 ? 0.15 : -0.15, k & 1 ? 0.1 : -0.1)) + "}\n";
    names += (k ? ", " : "") + name;
  }
  const auto run = [&](const std::string& of) {
    return runOf("robot: {body: box, mass: 2, size: [0.4, 0.3, 0.2]}\nground: {height: 0}\nframes:\n" +
                 corners +
                 "initial: {position: [0, 0, 0.5], velocity: [1, 0, 0], angular_velocity: [3, 4, "
                 "5]}\neffects: [gravity, contact: {" +
                 of +
                 ", stiffness: 1e4, dissipation: 0.5, friction: 0.5}]\n"
                 "integrator: {name: rkmk4, step: 0.5 ms}\nduration: 1 s\n");
  };
  const scene::Run box = run("bodies: all"), points = run("frames: [" + names + "]");
  EXPECT_EQ(box.q, points.q);
  EXPECT_GT(box.outcome.events, 3);
}

/// A plate of thickness 0 has four corners, not eight: it rests on the compression m g/(4 k).
TEST(Shapes, APlateRestsOnFourCorners) {
  const double rest = -2 * g / (4 * 1e4);
  const scene::Run run = runOf(
      "robot: {body: plate, mass: 2, length: 0.4, width: 0.2}\nground: {height: 0}\ninitial: {position: [0, "
      "0, " +
      number(rest) + "]}\neffects: [gravity, contact: {bodies: all, stiffness: 1e4}]\n" + radau(1));
  EXPECT_NEAR(run.q[2], rest, 1e-9);
}

/// The power of the force is the loss of its potential, in poses where a shape is below the ground.
TEST(Shapes, TheForceOnEachShapeIsTheGradientOfItsPotential) {
  for (const std::string shape :
       {"sphere, radius: 0.3", "capsule, radius: 0.1, length: 0.8", "cylinder, radius: 0.3, length: 0.8",
        "cylinder, radius: 0.6, length: 0.001", "box, size: [0.6, 0.7, 0.8]"})
    for (const char* exponent : {"1", "1.5"})
      for (const char* tilt : {"[0.4, -0.7, 0.3]", "[2e-4, 3e-4, 1]", "[1.2, 0.4, 0]"}) {
        const scene::Scene s = loadSceneText(
            "robot: {body: body, moments: [1, 1, 1]}\nground: {height: 0.1, normal: [0.2, -0.1, 1]}\nshapes: "
            "[{shape: " +
            shape +
            ", on: body, position: [0.1, 0.2, 0], attitude: [0.2, 0, 0.1]}]\ninitial: {position: [0, 0, "
            "0.1], attitude: " +
            tilt + "}\neffects: [contact: {bodies: all, stiffness: 40, exponent: " + exponent +
            "}]\nintegrator: {name: rkmk4, step: 1 ms}\nduration: 1 s\n");
        auto system = scene::makeSystem<Body>(s);
        Vector6<double> v;
        v << 0.3, -0.2, 0.9, 0.5, -0.4, 0.7;
        const double h =
            1e-5;  // truncation h^2, rounding eps/h: at most 1e-9 with the curvature of 1e3 of an end
        const auto V = [&](double t) {
          const Vec q = integrate(s.model, s.q, Vec(t * v));
          return system.effects()[0]->potential(
              system.here(scene::State<Body>(system, q, Vec(v)), scene::Kinematics::Poses));
        };
        const scene::State<Body> at(system, s.q, Vec(v));
        system.load(0, at.q, at.v);
        const double power =
            system.force(at.v).dot(V3(at.v.head<3>())) + system.moment(at.v).dot(V3(at.v.tail<3>()));
        EXPECT_NEAR(power, -(V(h) - V(-h)) / (2 * h), 1e-6 * (1 + std::abs(power))) << shape << tilt;
        EXPECT_GT(std::abs(power), 1e-2) << shape << tilt;
      }
}

const std::string urdf_head =
    "<robot name='r'><link name='foot'><inertial><mass value='2'/><inertia ixx='0.02' iyy='0.02' "
    "izz='0.02' ixy='0' ixz='0' iyz='0'/></inertial>";
std::string collision(const std::string& geometry, const std::string& origin = "") {
  return "<collision>" + origin + "<geometry>" + geometry + "</geometry></collision>";
}

/// A foot of a URDF: a cylinder whose ends are spheres is a capsule, and it rests at r - m g/(2 k).
TEST(Shapes, TheCollisionElementsOfAUrdfTouchTheGround) {
  const std::string lying = " rpy='1.5707963267948966 0 0'";
  file("foot.urdf",
       urdf_head +
           collision("<cylinder radius='0.05' length='0.3'/>", "<origin xyz='0 0 0.2'" + lying + "/>") +
           collision("<sphere radius='0.05'/>", "<origin xyz='0 0.15 0.2'/>") +
           collision("<sphere radius='0.05'/>", "<origin xyz='0 -0.15 0.2'/>") + "</link></robot>");
  const double rest = 0.05 - 2 * g / (2 * 1e4);
  const std::string scene =
      "robot: {urdf: foot.urdf}\nground: {height: 0}\ninitial: {position: [0, 0, " + number(rest - 0.2) +
      "]}\neffects: [gravity, contact: {bodies: [foot], stiffness: 1e4}]\n" + radau(0.5);
  EXPECT_NEAR(runOf(scene).q[2], rest - 0.2, 1e-9);
  const scene::Scene s = loadSceneText(scene, "s", testing::TempDir());
  ASSERT_EQ(s.around.shapes.size(), 1);
  EXPECT_EQ(s.around.shapes[0].type, scene::Shape::Type::Capsule);
}

/// R = R_z(yaw) R_y(pitch) R_x(roll): a box turned by rpy has its corners there.
TEST(Shapes, TheOriginOfAUrdfTurnsItsBox) {
  file("box.urdf", urdf_head +
                       collision("<box size='0.2 0.4 0.6'/>", "<origin xyz='1 2 3' rpy='0.3 -0.5 0.7'/>") +
                       "</link></robot>");
  const scene::Scene s =
      loadSceneText("robot: {urdf: box.urdf}\nintegrator: {name: rkmk4, step: 1 ms}\nduration: 1 s\n", "s",
                    testing::TempDir());
  ASSERT_EQ(s.around.shapes.size(), 1);
  const double a = 0.3, b = -0.5, c = 0.7, x = 0.1, y = 0.2, z = 0.3;
  // each axis by hand: first about x, then y, then z
  const double y1 = std::cos(a) * y - std::sin(a) * z, z1 = std::sin(a) * y + std::cos(a) * z;
  const double x2 = std::cos(b) * x + std::sin(b) * z1, z2 = -std::sin(b) * x + std::cos(b) * z1;
  const V3 corner(1 + std::cos(c) * x2 - std::sin(c) * y1, 2 + std::sin(c) * x2 + std::cos(c) * y1, 3 + z2);
  EXPECT_LT((s.around.shapes[0].X_FS.act(V3(x, y, z)) - corner).norm(), 1e-15);
  EXPECT_EQ(s.around.shapes[0].size, (std::array<double, 3>{0.2, 0.4, 0.6}));
}

TEST(Shapes, BadShapesAreRefusedWithARemedy) {
  file("mesh.urdf", urdf_head + collision("<mesh filename='a.stl'/>") + "</link></robot>");
  const std::string end = "\nintegrator: {name: rkmk4, step: 1 ms}\nduration: 1 s\n";
  const auto contact = [&](const std::string& robot, const std::string& keys) {
    return refusal("robot: " + robot + "\nground: {height: 0}\neffects: [contact: {stiffness: 1" + keys +
                   "}]" + end);
  };
  EXPECT_EQ(contact("{urdf: mesh.urdf}", ", bodies: all"),
            "s.yaml:3: the collision shape of 'foot' is a mesh in line 1 of the URDF: name the bodies "
            "without it, or give the body other shapes: 'shapes: [{shape: box, on: foot, size: [1, 1, 1]}]'");
  EXPECT_EQ(
      refusal(
          "robot: {urdf: mesh.urdf}\nground: {height: 0}\nshapes: [{shape: box, on: foot, size: [1, 1, 1]}]\n"
          "effects: [contact: {stiffness: 1, bodies: all}]" +
          end),
      "accepted");
  EXPECT_EQ(contact("{body: ball, radius: 1}", ""),
            "s.yaml:3: contact needs 'bodies: all', or 'frames' whose origins touch the ground");
  EXPECT_EQ(contact("{body: ball, radius: 1}", ", bodies: [bdy]"),
            "s.yaml:3: no body named 'bdy' has a collision shape, the nearest is 'body'");
  EXPECT_EQ(contact("{body: top, transverse: 1, axial: 1}", ", bodies: all"),
            "s.yaml:3: the robot has no collision shapes: write 'shapes: [{shape: sphere, on: FRAME, radius: "
            "0.1}]' in the scene");
  EXPECT_EQ(contact("{body: ball, radius: 1}", ", bodies: all, exponent: 0.5"),
            "s.yaml:3: the exponent is below 1: the stiffness would be infinite at first touch");
  const auto shapes = [&](const std::string& list) {
    return refusal("robot: {body: ball, radius: 1}\nshapes: " + list + end);
  };
  EXPECT_EQ(shapes("[{shape: ball, on: body}]"),
            "s.yaml:2: no shape is named 'ball', the nearest are 'box', 'capsule' and 'sphere'");
  EXPECT_EQ(shapes("[{on: body}]"), "s.yaml:2: a shape needs 'shape': sphere, capsule, cylinder or box");
  EXPECT_EQ(shapes("[{shape: box, on: body, size: [1, 0, 0]}]"),
            "s.yaml:2: box.size must be above 0; one side may be 0");
  EXPECT_EQ(shapes("[{shape: sphere, on: bdy, radius: 1}]").substr(0, 40),
            "s.yaml:2: no frame is named 'bdy', the n");
}

}  // namespace
