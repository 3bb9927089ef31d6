// The schema of a record's `scenes`.

#include <reports/field.hpp>
#include <reports/scenes.hpp>

namespace liecheck::reports {
namespace {

void measured_or_none(const Field& f) {
  if (!f.null()) f.measured();
}

void check_drift(const Field& drift) {
  if (drift.null()) return;
  for (const char* name : {"slope", "oscillation"})
    if (!drift[name].is("inf")) drift[name].real();
}

void check_time(const Field& time) {
  if (time.null()) return;
  for (const char* name : {"median", "low", "high"}) time[name].number();
  time["repetitions"].count(1);
}

void check_series(const Field& series) {
  series.texts({"subject", "version", "integrator"});
  series["order"].count();
  series["adaptive"].boolean(), series["at_floor"].boolean();
  measured_or_none(series["smallest"]);
  series["points"].each([](const Field& p) {
    p["steps"].count();
    if (!p["tolerance"].null()) p["tolerance"].number();
    for (const char* name : {"attitude", "position", "angular_velocity", "linear_velocity"})
      measured_or_none(p[name]);
    for (const char* name : {"energy", "momentum"}) check_drift(p[name]);
    check_time(p["time_ns"]);
    p["diverged"].text();
  });
}

void check_order(const Field& order) {
  order.texts({"integrator", "scalar"});
  for (const char* name : {"promised", "halvings", "first"}) order[name].count();
  order["exact"].boolean(), order["settled"].boolean();
  order["observed"].real();
  measured_or_none(order["floor"]);
  order["steps"].each([](const Field& n) { n.count(1); });
  order["errors"].each([](const Field& e) { e.measured(); });
}

void check_film(const Field& film) {
  film.texts({"name", "what", "integrator"});
  film["interval"].number();
  if (!film["ground"].null()) film["ground"].real();
  const auto numbers = [](const Field& list, std::size_t count) {
    list.length(count);
    list.each([](const Field& x) { x.real(); });
  };
  std::size_t links = 0;
  film["links"].each([&](const Field& link) {
    ++links;
    link["name"].text();
    for (const char* name : {"centre", "half"}) numbers(link[name], 3);
    numbers(link["axes"], 9);
    link["joints"].each([&](const Field& p) { numbers(p, 3); });
  });
  film["frames"].not_empty();
  film["frames"].each([&](const Field& frame) {
    frame.length(links);
    frame.each([&](const Field& pose) { numbers(pose, 7); });
  });
}

}  // namespace

void check_scenes(const Field& scenes) {
  scenes["version"].text();
  scenes["verdict"].one_of({"pass", "fail", "incomplete"});
  scenes["elapsed"].number();
  for (const char* name : {"wrong_orders", "absent"})
    scenes[name].each([](const Field& line) { line.text(); });
  scenes["scenes"].each([](const Field& s) {
    s.texts({"scene", "what", "truth"});
    s["closed"].boolean();
    for (const char* name : {"duration", "disagreement"}) s[name].number();
    s["series"].each(check_series);
    s["orders"].each(check_order);
  });
  scenes["peers"].each([](const Field& p) {
    p.texts({"scene", "peer", "integrator", "ours"});
    p["points"].count();
    for (const char* name : {"ratio", "error"}) p[name].measured();
    p["unmatched"].boolean();
  });
  scenes["spins"].each([](const Field& s) {
    s["integrator"].text();
    for (const char* name : {"order", "turns", "steps_per_turn"}) s[name].count(1);
    s["error"].measured();
    for (const char* name : {"limit", "seconds"}) s[name].number();
  });
  scenes["flips"].each([](const Field& f) {
    f.texts({"scalar", "integrator"});
    for (const char* name : {"perturbation", "horizon"}) f[name].number();
    f["exact"].each([](const Field& t) { t.number(); });
    f["relative"].each([](const Field& e) { e.measured(); });
    f["predicted"].count();
  });
  if (scenes.has("costs"))
    scenes["costs"].each([](const Field& c) {
      c.texts({"scene", "stage", "equation", "energy", "when", "why"});
      if (!c["nanoseconds"].null()) c["nanoseconds"].number();
    });
  if (scenes.has("films")) scenes["films"].each(check_film);
}

}  // namespace liecheck::reports
