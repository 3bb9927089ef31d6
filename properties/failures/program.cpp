#include <failures/program.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <map>

namespace liecheck::properties {

namespace {

struct Call {
  const char* header;
  const char* expression;  ///< over the variables that `set_up` makes of the law's fields
};

const Call* call_of(const std::string& operation) {
  static const char* const exp_log = "spatial/exp_log.hpp";
  static const char* const jacobians = "spatial/jacobians.hpp";
  static const char* const configuration = "multibody/se3_configuration.hpp";
  static const char* const inertia = "spatial/inertia.hpp";
  static const char* const se3 = "spatial/se3.hpp";
  static const char* const urdf = "multibody/configuration.hpp>\n#include <liecheck/urdf/urdf.hpp";
  static const std::map<std::string, Call> calls = {
      {"exp3_quaternion", {exp_log, "quaternion::exp3<S>(phi).to_vector()"}},
      {"exp3_matrix", {exp_log, "exp3<S>(phi)"}},
      {"exp6", {exp_log, "exp6<S>(Motion<S>(xi))"}},
      {"log3_quaternion", {exp_log, "quaternion::log3<S>(SO3<S>(Q))"}},
      {"log3_matrix", {exp_log, "log3<S>(R)"}},
      {"log6", {exp_log, "log6<S>(X).to_vector()"}},
      {"left_jacobian3", {jacobians, "leftJacobian<S>(phi)"}},
      {"right_jacobian3", {jacobians, "rightJacobian<S>(phi)"}},
      {"left_jacobian3_inverse", {jacobians, "leftJacobianInverse<S>(phi)"}},
      {"right_jacobian3_inverse", {jacobians, "rightJacobianInverse<S>(phi)"}},
      {"left_jacobian6", {jacobians, "leftJacobian<S>(Motion<S>(xi))"}},
      {"right_jacobian6", {jacobians, "rightJacobian<S>(Motion<S>(xi))"}},
      {"left_jacobian6_inverse", {jacobians, "leftJacobianInverse<S>(Motion<S>(xi))"}},
      {"right_jacobian6_inverse", {jacobians, "rightJacobianInverse<S>(Motion<S>(xi))"}},
      {"integrate", {configuration, "integrateSE3<S>(q0, xi)"}},
      {"difference", {configuration, "differenceSE3<S>(q0, q1)"}},
      {"difference_of_integrate", {configuration, "differenceSE3<S>(q0, integrateSE3<S>(q0, xi))"}},
      {"integrate_of_difference", {configuration, "integrateSE3<S>(q0, differenceSE3<S>(q0, q1))"}},
      {"d_integrate_arg0", {configuration, "dIntegrateSE3<S>(q0, xi, ArgumentPosition::ARG0)"}},
      {"d_integrate_arg1", {configuration, "dIntegrateSE3<S>(q0, xi, ArgumentPosition::ARG1)"}},
      {"d_difference_arg0", {configuration, "dDifferenceSE3<S>(q0, q1, ArgumentPosition::ARG0)"}},
      {"d_difference_arg1", {configuration, "dDifferenceSE3<S>(q0, q1, ArgumentPosition::ARG1)"}},
      {"integrate_coefficient_jacobian", {configuration, "integrateCoeffWiseJacobianSE3<S>(q0)"}},
      {"compose", {se3, "(X * Y).toActionMatrix()"}},
      {"inverse", {se3, "X.inverse().toActionMatrix()"}},
      {"act_point", {se3, "X.act(p_Y)"}},
      {"rotate_point", {se3, "SO3<S>(Q).act(p)"}},
      {"act_motion", {se3, "X.act(V).to_vector()"}},
      {"act_inverse_motion", {se3, "X.actInv(V).to_vector()"}},
      {"act_force", {se3, "X.act(F).to_vector()"}},
      {"act_inverse_force", {se3, "X.actInv(F).to_vector()"}},
      {"cross_motion", {se3, "V.cross(W).to_vector()"}},
      {"cross_force", {se3, "V.cross(F).to_vector()"}},
      {"power", {se3, "X.act(F).to_vector().dot(X.act(V).to_vector()) - F.to_vector().dot(V.to_vector())"}},
      {"act_inertia", {inertia, "X.act(I).matrix()"}},
      {"act_inverse_inertia", {inertia, "X.actInv(I).matrix()"}},
      {"momentum", {inertia, "(I * V).to_vector()"}},
      {"kinetic_energy", {inertia, "I.kineticEnergy(V)"}},
      {"energy_frames", {inertia, "X.act(I).kineticEnergy(X.act(V)) - I.kineticEnergy(V)"}},
      {"inertia_matrix", {inertia, "I.matrix()"}},
      {"robot_integrate", {urdf, "integrate(model, q0, delta)"}},
      {"robot_difference", {urdf, "difference(model, q0, q1)"}},
      {"robot_is_same", {urdf, "isSameConfiguration(model, q0, q1)"}}};
  const auto found = calls.find(operation);
  return found == calls.end() ? nullptr : &found->second;
}

std::string declaration(const Field& f, std::vector<std::string> x) {
  if (f.kind == Kind::inertia) {  // xx xy yy xz yz zz, to rows
    x = {x[0], x[1], x[3], x[1], x[2], x[4], x[3], x[4], x[5]};
  }
  const std::string list = fmt::format("{}", fmt::join(x, ", "));
  if (x.size() == 1) return fmt::format("  const S {} = {};  // {}\n", f.name, list, f.unit);
  if (f.size == 3 || f.size == 4)
    return fmt::format("  const Vector{}<S> {}({});  // {}\n", x.size(), f.name, list, f.unit);
  const bool matrix = f.kind == Kind::rotation_matrix || f.kind == Kind::inertia;
  const std::string type =
      matrix ? "Matrix3<S> " + f.name : fmt::format("Eigen::Matrix<S, {}, 1> {}", f.size, f.name);
  return fmt::format("  {};  // {}\n  {} << {};\n", type, f.unit, f.name, list);
}

/// A variable made of the law's fields.
struct Variable {
  std::string name;
  std::vector<std::string> fields;
  std::string text;
};

std::vector<Variable> variables(bool robot, bool fixed) {
  const auto stacked = [](int size, const char* name, const char* first, const char* last) {
    return Variable{name,
                    {first, last},
                    fmt::format("  Vector{}<S> {};\n  {} << {}, {};\n", size, name, name, first, last)};
  };
  std::vector<Variable> all = {stacked(6, "xi", "rho", "phi"), stacked(7, "q0", "p0", "Q0"),
                               stacked(7, "q1", "p1", "Q1"), stacked(7, "q0", "p", "Q")};
  all.push_back({"X", {"R", "p"}, "  const SE3<S> X(R, p);\n"});
  all.push_back({"Y", {"R_Y", "p_Y"}, "  const SE3<S> Y(R_Y, p_Y);\n"});
  all.push_back({"V", {"u", "omega"}, "  const Motion<S> V(u, omega);\n"});
  all.push_back({"W", {"u_W", "omega_W"}, "  const Motion<S> W(u_W, omega_W);\n"});
  all.push_back({"F", {"f", "n"}, "  const Force<S> F(f, n);\n"});
  all.push_back({"I", {"mass", "c", "I_C"}, "  const Inertia<S> I(mass, c, I_C);\n"});
  if (robot)
    all.push_back(
        {"model",
         {},
         fmt::format("  const auto model = buildModelFromUrdf(\"ROBOT.urdf\", RootJoint::{}).cast<S>();\n",
                     fixed ? "Fixed" : "FreeFlyer")});
  return all;
}

/// Does the text use the name, as a word?
bool mentions(const std::string& text, const std::string& name) {
  const auto word = [&](std::size_t i) {
    return i < text.size() && (std::isalnum(text[i]) || text[i] == '_');
  };
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
    if (!(at > 0 && word(at - 1)) && !word(at + name.size())) return true;
  return false;
}

/// The law's fields; a robot's, one for each part of a joint (q0_7, q0_0_p, ...), as the vectors that they make up.
std::vector<Field> whole_vectors(const Series& series) {
  if (series.robot == "none") return series.fields;
  std::vector<Field> all;
  for (const Field& f : series.fields) {
    const std::string name = f.name.substr(0, f.name.find('_'));
    if (all.empty() || all.back().name != name)
      all.push_back({name, Kind::opaque, 0, name == "delta" ? "m, rad" : "m, 1, rad"});
    all.back().size += f.size;
  }
  return all;
}

}  // namespace

std::string snippet(const Series& series, const Output& output, const std::vector<std::string>& numbers) {
  const auto note = [&] {
    return series.subject == "liecheck"
               ? std::string()
               : fmt::format("  // liecheck's own function: put {}'s in its place.\n", series.subject);
  };
  if (std::string own = series.program(output, numbers); !own.empty()) {
    const std::string main = "int main() {\n";
    return own.insert(own.find(main) + main.size(), note());
  }
  const Call* call = call_of(output.operation);
  if (!call) return "";
  const std::vector<Field> fields = whole_vectors(series);
  const bool wide = series.scalar == "float128";
  std::string text = fmt::format(
      "// c++ -std=gnu++20 -I lib $(pkg-config --cflags eigen3) case.cpp{}{}\n"
      "#include <iostream>\n{}#include <liecheck/{}>\nusing namespace liecheck;\nint main() {{\n  using S = "
      "{};\n",
      wide ? " -lquadmath" : "", series.robot == "none" ? "" : " -lliecheck_lib -ltinyxml2",
      wide ? "#include <boost/multiprecision/eigen.hpp>\n#include <boost/multiprecision/float128.hpp>\n" : "",
      call->header, wide ? "boost::multiprecision::float128" : series.scalar);
  const char* suffix = wide ? "Q" : series.scalar == "float" ? "f" : "";
  std::string result = call->expression;
  if (output.operation == "exp6")
    result += output.block == "rotation" || output.block == "orthogonality defect" ? ".rotation()"
                                                                                   : ".translation()";
  const bool across = std::any_of(fields.begin(), fields.end(),
                                  [](const Field& f) { return f.name == "theta" && f.size == 2; });
  // Only what the call needs.
  std::vector<std::string> needed;
  std::string set_up;
  const auto has = [&](const std::string& name) {
    return std::any_of(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
  };
  for (const Variable& v : variables(series.robot != "none", series.robot_fixed))
    if (mentions(result, v.name) && !has(v.name) && std::all_of(v.fields.begin(), v.fields.end(), has)) {
      set_up += v.text;
      needed.insert(needed.end(), v.fields.begin(), v.fields.end());
    }
  std::size_t from = 0;
  for (const Field& f : fields) {
    std::vector<std::string> x;
    for (int i = 0; i < f.size; ++i) x.push_back(numbers.at(from++) + suffix);
    if (across || mentions(result, f.name) || std::find(needed.begin(), needed.end(), f.name) != needed.end())
      text += declaration(f, x);
  }
  text += set_up;
  text += note();
  text += "  std::cout.precision(36);\n";
  if (across)  // the law compares two adjacent angles
    return text + fmt::format(
                      "  for (int k = 0; k < 2; ++k) {{\n    const Vector3<S> phi = theta[k] * direction;\n"
                      "    Vector6<S> xi;\n    xi << rho, phi;\n    std::cout << {} << '\\n';\n  }}\n}}\n",
                      result);
  return text + fmt::format("  std::cout << {} << '\\n';\n}}\n", result);
}

}  // namespace liecheck::properties
