// Reports for which no formula stands here; `wrong` gives the reason. They stay in the table.

#include <history/history.hpp>

namespace liecheck::properties::history {
namespace {

HistoricBug row(const char* name, const char* library, const char* thread, const char* region,
                const char* symptom, const char* reason) {
  return {name, library, thread, region, symptom, reason, {}, HistoryKind::not_expressed};
}

std::vector<HistoricBug> reports() {
  const char* const no_cause = "The report names no cause from which a formula could be written.";
  const char* const no_sim3 = "No operation of Sim(3) exists here.";
  const char* const integrator = "The fault is in an integrator of motions; scenes measure these, not laws.";
  const char* const gradient =
      "A fault of derivatives by automatic differentiation in that library; the test AutomaticDerivatives "
      "has "
      "the same question for liecheck.";
  return {
      row("sophus_30", "Sophus", "strasdat/Sophus#30", "one pose", "the translation does not come back",
          no_cause),
      row("physx_202", "PhysX 2019-08", "NVIDIAGameWorks/PhysX#202", "28 joints", "CRBA and ABA disagree",
          no_cause),
      row("sophus_79", "Sophus before c37421dc", "strasdat/Sophus#79", "theta near 0, sigma != 0",
          "a coefficient lacks -1", no_sim3),
      row("kornia_rs_1069", "kornia-rs", "kornia/kornia-rs#1069", "all", "exp and log are not inverse",
          no_sim3),
      row("basilisk_887", "Basilisk", "AVSLab/basilisk#887", "switch of the set", "a wrong difference",
          "No operation of modified Rodrigues parameters exists here."),
      row("ceres_83133357d", "Ceres before 83133357d", "commit 83133357d of ceres-solver/ceres-solver",
          "subnormal angles", "0/0",
          "It needs a libc++ before 19, whose hypot of three arguments underflows."),
      row("mujoco_3553", "MuJoCo to 3.12.0", "google-deepmind/mujoco#3553", "inertia on a fixed child",
          "implicitfast diverges", integrator),
      row("avian_400", "Avian", "avianphysics/avian#400", "a fast asymmetric spin", "the energy explodes",
          integrator),
      row("pinocchio_1655", "Pinocchio with CasADi", "stack-of-tasks/pinocchio#1655",
          "identity, zero increment", "NaN gradient", gradient),
      row("kornia_3949", "kornia", "kornia/kornia#3949", "identity, half turn", "NaN gradient", gradient),
      row("rotations_jl_280", "Rotations.jl", "JuliaGeometry/Rotations.jl#280", "0", "NaN derivative",
          gradient),
  };
}

const HistoryRows registered_not_expressed(reports);

}  // namespace
}  // namespace liecheck::properties::history
