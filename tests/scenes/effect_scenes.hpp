#pragma once
// Scenes for every effect and actuation: on a tree that carries a prismatic joint on a revolute one and a
// continuous one, with generic placements, and on a lone body. Every key of an effect has a value that
// matters in one of its scenes.

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
  bool lone = false;  ///< on a lone body
  std::string root = "free_flyer";
  std::string ground = "{height: -0.1}";
};

inline const std::vector<EffectScene>& effect_scenes() {
  static const std::string place = "frame: tool, ", on_root = "joints: root_joint, ",
                           touch = "stiffness: 300, dissipation: 0.4, friction: 0.5, slip: 0.3, radius: 0.2";
  static const std::vector<EffectScene> all = [] {
    std::vector<EffectScene> both = {
        {"gravity", "acceleration: [1, -2, -9]"},
        {"wrench", place + "force: [3, -1, 2], moment: [0.2, 0.5, -0.3], from: 0.05, until: 0.25"},
        {"wrench", place + "force: [3, -1, 2], moment: [0.2, 0.5, -0.3], axes: world"},
        {"drag", place + "linear: 0.5, quadratic: 0.7, angular_linear: 0.03, angular_quadratic: 0.02"},
        {"buoyancy", place + "volume: 2 l, density: 900, acceleration: [1, 2, -9]"},
        {"thruster", place + "thrust: 4, direction: [1, 2, 3], moment_ratio: 0.1, from: 0.05, until: 0.25"},
        {"contact", "frames: [tool, fin], rolling: 0.05, torsion: 0.04, angular_slip: 0.5, " + touch}};
    std::vector<EffectScene> scenes = both;
    for (EffectScene& s : both) s.lone = true, scenes.push_back(s);
    for (const bool lone : {false, true}) {
      const std::string where = lone ? on_root : "";
      scenes.push_back({"joint_damping", where + "coefficient: 0.3", false, lone});
      scenes.push_back({"joint_friction", where + "force: 0.4, slip: 0.5", false, lone});
      scenes.push_back(
          {"constant", (lone ? on_root : "joints: [shoulder, spin], ") + "force: 0.8", true, lone});
      scenes.push_back({"table",
                        (lone ? on_root : "joints: [shoulder, slide], ") +
                            "times: [0.05, 0.1, 0.25], forces: [0.5, 3, -2]",
                        true, lone});
    }
    for (const EffectScene& s : std::vector<EffectScene>{
             {"joint_damping", ""},
             {"joint_friction", "slip: 0.4"},
             {"joint_spring", "stiffness: 5, rest: 0.3"},
             {"joint_limits", "stiffness: 60, dissipation: 0.9"},
             {"joint_limits",
              "stiffness: 60, dissipation: 1.5"},  // the slide leaves its limit faster than 1/c
             {"armature", "inertia: 0.05"},
             {"armature", on_root + "inertia: 0.3"},
             {"pd", "stiffness: 30, damping: 0.5, target: [0.2, 0.05]", true}})
      scenes.push_back(s);
    scenes.push_back({"gravity", "", false, false, "spherical"});
    scenes.push_back({"gravity", "", false, false, "planar"});
    scenes.push_back({"gravity", "", false, false, "translation"});
    scenes.push_back({"contact", "frames: [tool, fin], " + touch, false, false, "free_flyer",
                      "{height: 0, normal: [0.1, -0.2, 1]}"});
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
  const bool flies = s.lone || s.root == "free_flyer";
  return loadSceneText(
      (s.lone
           ? "robot: {body: body, mass: 2, moments: [0.05, 0.07, 0.06], centre: [0.05, -0.02, 0.03], turned: "
             "[0.2, 0.1, 0.4]}\n"
           : "robot: {urdf: tree.urdf, root: " + s.root + "}\n") +
          "ground: " + s.ground + "\nframes:\n  - {name: tool, on: " + (s.lone ? "body" : "sledge") +
          ", position: [0.1, 0.05, -0.2], attitude: [0.3, -0.5, 0.7]}\n  - {name: fin, on: " +
          (s.lone ? "body" : "base") + ", position: [-0.2, 0.1, -0.05], attitude: [0.1, 0.2, -0.3]}\n" +
          "initial: {" +
          (flies ? "position: [0.1, -0.2, 0.3], attitude: [0.4, 0.3, -0.6], velocity: [0.5, -0.3, -1.2], "
                   "angular_velocity: [0.7, -1.1, 0.9]"
                 : "") +
          (s.lone ? ""
                  : std::string(flies ? ", " : "") +
                        "joints: {shoulder: 0.3, slide: 0.1, spin: 3}, joint_velocities: {shoulder: 1.5, "
                        "slide: 0.8, spin: 2}") +
          "}\n" + (s.actuation ? "actuation: " : "effects: ") + part +
          "integrator: {name: gauss12, step: 10 ms}\nduration: 0.3 s\n",
      s.effect + ".yaml", scratch());
}

inline std::string name_of(const EffectScene& s) {
  return s.effect + " {" + s.keys + "} on " + (s.lone ? "a lone body" : "a tree with the root " + s.root);
}

}  // namespace liecheck::test
