#pragma once
// Scenes for every effect and actuation: on a tree that carries a prismatic joint on a revolute one and a
// continuous one, with generic placements, on a lone body, and on two free bodies that meet. Every key of an
// effect has a value that matters in one of its scenes.

#include <liecheck/scene_file/scene_file.hpp>
#include <scenes/benchmark.hpp>

#include <fstream>

#include "../scratch.hpp"

namespace liecheck::test {

inline const std::string effect_tree = R"(<robot name="tree">
  <link name="base"><inertial><origin xyz="0.05 -0.02 0.03" rpy="0.2 0.1 0.4"/><mass value="2"/>
    <inertia ixx="0.05" ixy="0.004" ixz="-0.003" iyy="0.07" iyz="0.002" izz="0.06"/></inertial></link>
  <link name="arm"><inertial><origin xyz="0.1 0.04 0.2" rpy="0.3 -0.2 0.1"/><mass value="1"/>
    <inertia ixx="0.02" ixy="0.001" ixz="0.002" iyy="0.03" iyz="-0.001" izz="0.015"/></inertial></link>
  <link name="sledge"><inertial><origin xyz="-0.05 0.1 0.05" rpy="0.5 0.2 -0.3"/><mass value="0.6"/>
    <inertia ixx="0.008" ixy="0" ixz="0.001" iyy="0.006" iyz="0" izz="0.009"/></inertial></link>
  <link name="wheel"><inertial><origin xyz="0.02 0.01 0.03" rpy="0.1 0.7 0.2"/><mass value="0.8"/>
    <inertia ixx="0.01" ixy="0.001" ixz="0" iyy="0.012" iyz="0.002" izz="0.016"/></inertial></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="arm"/>
    <origin xyz="0.3 0.1 -0.2" rpy="0.4 -0.6 0.9"/><axis xyz="1 2 -2"/>
    <limit lower="-0.4" upper="0.5" effort="6" velocity="10"/><dynamics damping="0.2" friction="0.3"/></joint>
  <joint name="slide" type="prismatic"><parent link="arm"/><child link="sledge"/>
    <origin xyz="0.1 0.2 0.3" rpy="-0.3 0.5 0.2"/><axis xyz="2 -1 2"/>
    <limit lower="0.15" upper="0.3" effort="5" velocity="10"/><dynamics damping="0.5" friction="0.6"/></joint>
  <joint name="spin" type="continuous"><parent link="base"/><child link="wheel"/>
    <origin xyz="-0.2 0.3 0.1" rpy="0.8 0.3 -0.5"/><axis xyz="0.6 0 0.8"/>
    <limit effort="4" velocity="20"/><dynamics damping="0.1" friction="0.2"/></joint>
</robot>
)";

struct EffectScene {
  std::string effect;  ///< its name in the registry
  std::string keys;    ///< with their values
  bool actuation = false;
  bool lone = false;                ///< on a lone body
  std::string root = "free_flyer";  ///< or "bodies", "linkage" instead of the tree
  std::string ground = "{height: -0.1}";
  std::string shapes = "[]";
  double duration = 0.3;  ///< [s]
};

inline const std::vector<EffectScene>& effect_scenes() {
  static const std::string place = "frame: tool, ", on_root = "joints: root_joint, ",
                           touch = "stiffness: 300, dissipation: 0.4, friction: 0.5, slip: 0.3",
                           turn = ", rolling: 0.05, torsion: 0.04, angular_slip: 0.5",
                           points = ", radius: 0.2", cubic = "interpolation: cubic, ",
                           flat = "{height: -0.1}";
  static const std::vector<EffectScene> all = [] {
    std::vector<EffectScene> both = {
        {"gravity", "acceleration: [1, -2, -9]"},
        {"wrench", place + "force: [3, -1, 2], moment: [0.2, 0.5, -0.3], from: 0.05, until: 0.25"},
        {"wrench", place + "force: [3, -1, 2], moment: [0.2, 0.5, -0.3], axes: world"},
        {"drag", place + "linear: 0.5, quadratic: 0.7, angular_linear: 0.03, angular_quadratic: 0.02, "
                         "current: [0.4, -0.7, 0.3]"},
        {"buoyancy", place + "volume: 2 l, density: 900, acceleration: [1, 2, -9]"},
        {"thruster", place + "thrust: 4, direction: [1, 2, 3], moment_ratio: 0.1, from: 0.05, until: 0.25"},
        {"contact", "frames: [tool, fin], " + touch + turn + points}};
    std::vector<EffectScene> scenes = both;
    for (EffectScene& s : both) s.lone = true, scenes.push_back(s);
    const auto add = [&](const std::vector<EffectScene>& more) {
      scenes.insert(scenes.end(), more.begin(), more.end());
    };
    for (const bool lone : {false, true}) {
      const std::string where = lone ? on_root : "", two = lone ? on_root : "joints: [shoulder, spin], ",
                        other = lone ? on_root : "joints: [shoulder, slide], ";
      add({{"joint_damping", where + "coefficient: 0.3", false, lone},
           {"joint_friction", where + "force: 0.4, slip: 0.5", false, lone},
           {"constant", two + "force: 0.8", true, lone},
           {"table", other + "times: [0.05, 0.1, 0.25], forces: [0.5, 3, -2]", true, lone}});
    }
    add({{"joint_damping", ""},
         {"joint_friction", "slip: 0.4"},
         {"joint_spring", "stiffness: 5, rest: 0.3"},
         {"joint_limits", "stiffness: 60, dissipation: 0.9", false, false, "free_flyer", flat, "[]", 0.2},
         {"joint_limits", "stiffness: 60, dissipation: 1.5", false, false, "free_flyer", flat, "[]",
          0.1},  // the slide leaves its limit faster than 1/c
         {"armature", "inertia: 0.05"},
         {"armature", on_root + "inertia: 0.3"},
         {"pd", "stiffness: 30, damping: 0.5, target: [0.2, 0.05]", true},
         {"wrench", place + cubic +
                        "axes: world, rows: [[0, 1, 2, 0.5, 0.2, -0.1, 0.3], [0.1, -1, 0.5, 2, 0, 0.3, 0.1], "
                        "[0.15, 2, -1, 1, -0.3, 0.2, 0], [0.25, 0, 1, -1, 0.1, 0.1, -0.2]]"},
         {"wrench", place + "rows: [[0.05, 1, 2, 0.5], [0.15, -1, 0.5, 2]], force: [0.3, 0, 1]"},
         {"pd",
          "joints: shoulder, stiffness: 30, damping: 0.5, " + cubic +
              "rows: [[0, 0.3], [0.1, 0.35], [0.25, 0.2], [0.4, 0.3]]",
          true},
         {"pd", "stiffness: 30, damping: 0.5, rows: [[0.05, 0.2, 0.1], [0.2, 0.25, 0.15]]", true},
         {"table", cubic + "joints: [shoulder, slide], rows: [[0.05, 0.5, 1], [0.1, 3, -1], [0.25, -2, 0.5]]",
          true},
         {"motor",
          "joints: [shoulder, slide], ratio: 2, rotor_inertia: 0.01, efficiency: 0.8, slip: 0.5, "
          "stall_torque: 1.2, force: 0.4, stiffness: 30, damping: 0.5, target: [0.2, 0.05]",
          true},
         {"motor",
          "joints: [shoulder, spin], ratio: 2, rotor_inertia: 0.01, efficiency: 0.8, slip: 0.5, "
          "stall_torque: 1, no_load_speed: 8, force: 5",
          true},
         {"motor",
          "joints: [shoulder, slide], rotor_inertia: 0.02, stiffness: 30, damping: 0.5, " + cubic +
              "rows: [[0, 0.3, 0.1], [0.1, 0.35, 0.2], [0.3, 0.2, 0.1]]",
          true},
         {"motor",
          "joints: [shoulder, spin], ratio: 3, efficiency: 0.7, slip: 0.5, forces: [[0.05, 0.5, 1], [0.2, 1, "
          "0.3]]",
          true},
         {"added_mass", "masses: [0.5, 0.8, 0.3], inertias: [0.02, 0.01, 0.03]"},
         {"added_mass", "masses: [0.5, 0.8, 0.3], inertias: [0.02, 0.01, 0.03]", false, true},
         {"added_mass", "joint: a_joint, masses: [0.5, 0.8, 0.3], inertias: [0.02, 0.01, 0.03]", false, false,
          "bodies"},
         {"closed_loops", "frames: [tool, hook], rate: 15", false, false, "free_flyer", flat, "[]", 0.15},
         {"closed_loops", "frames: [tool, hook], type: weld", false, false, "free_flyer", flat, "[]", 0.15},
         {"closed_loops", "frames: [tool, fin], rate: 10", false, false, "bodies"}});
    const std::string balls =
        "[{shape: sphere, on: tool, radius: 0.15}, {shape: sphere, on: fin, radius: 0.12}]";
    add({{"collisions", touch + turn, false, false, "bodies", flat, balls},
         {"collisions", "bodies: [tool, fin], exponent: 2, " + touch, false, false, "bodies", flat, balls},
         {"collisions", touch, false, false, "bodies", flat,
          "[{shape: capsule, on: tool, radius: 0.12, length: 0.8}, {shape: capsule, on: fin, radius: 0.1, "
          "length: 0.7}]"},
         {"collisions", touch, false, false, "bodies", flat,
          "[{shape: box, on: universe, position: [0.45, 0.1, -0.25], size: [0.3, 1, 1]}, {shape: sphere, on: "
          "tool, radius: 0.15}]"},
         {"contact", "bodies: all, exponent: 2, " + touch, false, true, "free_flyer", flat,
          "[{shape: sphere, on: tool, radius: 0.2}, {shape: capsule, on: fin, position: [0.1, 0, 0], radius: "
          "0.1, length: 0.3}]"},
         {"contact", "bodies: fin, " + touch, false, true, "free_flyer", "{height: 0.1}",
          "[{shape: box, on: fin, position: [0.1, 0, 0], size: [0.2, 0.3, 0.25]}]", 0.1},
         {"gravity", "", false, false, "spherical"},
         {"gravity", "", false, false, "planar"},
         {"gravity", "", false, false, "translation"},
         {"contact", "frames: [tool, fin], " + touch + points, false, false, "free_flyer",
          "{height: 0, normal: [0.1, -0.2, 1]}"}});
    return scenes;
  }();
  return all;
}

inline scene::Scene scene_of(const EffectScene& s) {
  static const bool written = [] {
    std::ofstream(scratch() + "tree.urdf") << effect_tree;
    return true;
  }();
  static_cast<void>(written);
  const std::string part = "[" + s.effect + (s.keys.empty() ? "" : ": {" + s.keys + "}") + "]\n";
  const bool linkage = s.root == "linkage", tree = !s.lone && s.root != "bodies" && !linkage,
             flies = s.lone || s.root == "free_flyer";
  const std::string body =
      "body: body, mass: 2, moments: [0.05, 0.07, 0.06], centre: [0.05, -0.02, 0.03], turned: [0.2, 0.1, "
      "0.4]";
  const std::string two = "bodies: [{name: a, " + body +
                          ", attitude: [0.4, 0.3, -0.6], velocity: [0.5, 0.2, -0.3], angular_velocity: [0.7, "
                          "-1.1, 0.9]}, {name: b, " +
                          body +
                          ", position: [0, 0.1, 0.1], attitude: [-0.4, -0.2, -0.1], velocity: [1.2, 0.3, "
                          "-0.6], angular_velocity: [-0.6, -0.2, -0.5]}]";
  const std::string bars = "urdf: " LIECHECK_FIXTURES "/scenes/four_bar.urdf, root: fixed",
                    robot = s.lone    ? body
                            : linkage ? bars
                            : tree    ? "urdf: tree.urdf, root: " + s.root
                                      : two,
                    first = s.lone    ? "body"
                            : linkage ? "crank"
                            : tree    ? "sledge"
                                      : "a",
                    second = s.lone    ? "body"
                             : linkage ? "coupler"
                             : tree    ? "base"
                                       : "b";
  std::string start;
  if (flies)
    start =
        "position: [0.1, -0.2, 0.3], attitude: [0.4, 0.3, -0.6], velocity: [0.5, -0.3, -1.2], "
        "angular_velocity: [0.7, -1.1, 0.9]";
  if (tree)
    start += std::string(flies ? ", " : "") +
             "joints: {shoulder: 0.3, slide: 0.1, spin: 3}, joint_velocities: {shoulder: 1.5, slide: 0.8, "
             "spin: 2}";
  if (linkage)
    start =
        "joints: {crank_joint: 1, coupler_joint: -0.575, rocker_joint: 1.625}, joint_velocities: "
        "{crank_joint: 5}";
  return loadSceneText(
      "robot: {" + robot + "}\nground: " + s.ground + "\nframes:\n  - {name: tool, on: " + first +
          ", position: [0.1, 0.05, -0.2], attitude: [0.3, -0.5, 0.7]}\n  - {name: fin, on: " + second +
          ", position: [-0.2, 0.1, -0.05], attitude: [0.1, 0.2, -0.3]}\n  - {name: hook, on: universe, "
          "position: [0.4, -0.1, 0.2], attitude: [0.2, 0.1, -0.4]}\nshapes: " +
          s.shapes + "\n" + (start.empty() ? "" : "initial: {" + start + "}\n") +
          (s.actuation ? "actuation: " : "effects: ") + part +
          "integrator: {name: gauss12, step: 5 ms}\nduration: " + std::to_string(s.duration) + " s\n",
      s.effect + ".yaml", scratch(), nullptr, {LIECHECK_FIXTURES});
}

inline std::string name_of(const EffectScene& s) {
  const std::string robot = s.lone                ? "a lone body"
                            : s.root == "bodies"  ? "two bodies"
                            : s.root == "linkage" ? "a planar linkage"
                                                  : "a tree with the root " + s.root;
  return s.effect + " {" + s.keys + "} on " + robot;
}

}  // namespace liecheck::test
