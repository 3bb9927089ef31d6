#include <liecheck/scene/setup.hpp>

namespace liecheck::scene {

SystemKind kindOf(Model<double> model, const Effects<double>& effects, const std::string& integrator) {
  if (!LoneBody<double>::fits(model))
    return LoneJoint<double>::fits(model, effects) ? SystemKind::LoneJoint : SystemKind::Tree;
  model.armature.setZero();
  for (const auto& e : effects) e->prepare(model);
  if (!model.armature.isZero(0)) return SystemKind::Tree;
  BodyTerms<double> terms;
  bool thrown = integrator != Variational<double>::info.name;
  for (const auto& e : effects)
    if (e->acts() != Acts::OnModel) thrown = e->addConstant(model.inertias[1].lever(), terms) && thrown;
  return thrown && terms.thrown() ? SystemKind::ThrownBody : SystemKind::LoneBody;
}
SystemKind kindOf(const Scene& scene) {
  return kindOf(scene.model, makeEffects(scene, scene.model), scene.integrator);
}

template <class Sys>
Setup<Sys>::Setup(const Scene& of)
    : scene(of),
      effects(makeEffects<double>(of, of.model)),
      system(of.model, effects),
      start(startOf(of, system)),
      watched{&system.model(), &effects, step() * double(of.span.every), &of},
      a_(start.v) {
  for (const Request& r : scene.observers) {
    if (r.name == attitude_error_info.name)
      attitude_error.emplace(scene, system, r.parameters);
    else
      observers.push_back(observerEntry(r.name).make(r.parameters, watched));
  }
  for (const auto& o : observers) {
    needs = std::max(needs, o->needs());
    if (o->everyStep()) every_step_needs = std::max(every_step_needs, o->needs()), every_step = true;
  }
}

template <class Sys>
std::vector<Column> Setup<Sys>::columns() const {
  std::vector<Column> all{{"t", "s"}};
  for (const auto& o : observers)
    for (Column& c : o->columns()) all.push_back(std::move(c));
  if (attitude_error) all.push_back({attitude_error_info.name, "rad"});
  return all;
}

template <class Sys>
Now<double> Setup<Sys>::look(const State<Sys>& s, Kinematics kinematics) {
  if (kinematics != Kinematics::Accelerations) return system.here(s, kinematics);
  system.acceleration(s.t, s.q, s.v, a_);
  return system.here(s, kinematics, &a_);
}

template <class Sys>
double AttitudeError<Sys>::sample(Sys& system, const State<Sys>& state, long n,
                                  const std::function<bool()>& go_on) {
  if (n > steps_) {
    if (!method_) method_ = makeMethod<Sys>("gauss12");
    Span span;
    span.steps = (n - steps_) * refinement_;
    span.every = 256;
    span.duration = scene_.span.duration / double(scene_.span.steps) * double(n - steps_);
    const Switches<double> held = system.switches();  // of the run, which goes on after this
    const Outcome o =
        simulate(system, *method_, reference_, span, [&](const auto&, long) { return go_on(); });
    system.switches() = held;
    if (o.stopped) throw Interrupted();
    if (o.diverged) throw StepFailed("the reference motion of attitude_error diverges: " + o.why);
    steps_ = n;
  }
  double largest = 0;
  const VectorX<double> exact = system.toModel(reference_).first, made = system.toModel(state).first;
  for (std::size_t i = 1; i < scene_.model.joints.size(); ++i) {
    const int unit = std::visit([](const auto& j) { return int(j.unit_begin); }, scene_.model.joints[i]);
    if (scene_.model.nqs[i] - unit != 4) continue;
    const int at = scene_.model.idx_qs[i] + unit;
    Vector7<double> q0, q1;
    q0 << 0, 0, 0, exact.template segment<4>(at);
    q1 << 0, 0, 0, made.template segment<4>(at);
    largest = std::max(largest, differenceSE3<double>(q0, q1).template tail<3>().norm());
  }
  largest_ = std::max(largest_, largest);
  return largest;
}

template class Setup<LoneBody<double>>;
template class Setup<ThrownBody<double>>;
template class Setup<LoneJoint<double>>;
template class Setup<Tree<double>>;
template class AttitudeError<LoneBody<double>>;
template class AttitudeError<ThrownBody<double>>;
template class AttitudeError<LoneJoint<double>>;
template class AttitudeError<Tree<double>>;

}  // namespace liecheck::scene
