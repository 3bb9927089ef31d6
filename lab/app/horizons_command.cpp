#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <horizons/scene_horizons.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <support/environment.hpp>
#include <support/files.hpp>
#include <support/json_number.hpp>
#include <support/progress.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>
#include "lab_commands.hpp"

namespace liecheck::properties {

namespace {

struct HorizonsFlags {
  HorizonOptions options;
  std::vector<std::string> subjects, scalars, walks;
  std::string json;
  bool all = false;
};

bool is_finite(const Horizon& h) {
  return std::ranges::all_of(h.points,
                             [](auto& p) { return std::isfinite(p.norm) && std::isfinite(p.attitude); });
}

struct Status {
  std::string word, why;  ///< of the schema of horizons
};

/// What a walk of liecheck must keep: docs/laboratory.md.
Status status_of(const Horizon& h) {
  const bool ours = h.subject == "liecheck";
  if (!is_finite(h)) return {ours ? "fail" : "not judged", "not finite"};
  if (!ours || (h.norm_limit == 0 && h.angle_limit == 0)) return {"not judged", ""};
  for (const HorizonPoint& p : h.points) {
    if (h.norm_limit > 0 && p.norm > h.norm_limit)
      return {"fail", fmt::format("norm beyond {} eps", h.norm_limit)};
    if (h.angle_limit > 0 && p.attitude > h.angle_limit * std::sqrt(static_cast<double>(p.n)))
      return {"fail", fmt::format("more than {} sqrt(n) eps at {} calls", h.angle_limit, p.n)};
  }
  return {"pass", ""};
}

nlohmann::json json_of(const Horizon& h, const Status& status) {
  nlohmann::json points = nlohmann::json::array();
  for (const HorizonPoint& p : h.points)
    points.push_back({{"n", p.n}, {"norm_eps", number(p.norm)}, {"attitude_eps", number(p.attitude)}});
  return {{"subject", h.subject},           {"scalar", h.scalar},   {"walk", h.walk},
          {"exponent", number(h.exponent)}, {"low", number(h.low)}, {"high", number(h.high)},
          {"status", status.word},          {"why", status.why},    {"points", points}};
}

int run(const HorizonsFlags& f) {
  HorizonOptions o = f.options;
  if (!f.subjects.empty()) o.subjects = without_repeats(f.subjects);
  if (!f.scalars.empty()) o.scalars = without_repeats(f.scalars);
  if (!f.walks.empty()) o.walks = without_repeats(f.walks);
  stop_on_signals();
  std::unique_ptr<Progress> progress;  // of the walk that runs
  std::string walk;
  o.progress = [&](const std::string& path, double share) {
    const std::string its = path.substr(0, path.rfind(' '));
    if (its != walk || !progress) progress = std::make_unique<Progress>(its), walk = its;
    progress->show(share, "of a path of " + std::to_string(o.steps) + " calls");
  };
  std::vector<std::string> left_out;
  o.left_out = [&](const std::string& what) { left_out.push_back(what); };
  nlohmann::json rows = nlohmann::json::array();
  bool failed = false;
  say("{:<18} {:<7} {:<19}{:>12}{:>11}{:>13}{:>12}{:>9}  {}\n", "subject", "scalar", "walk", "calls",
      "norm [eps]", "angle [eps]", "/ sqrt(n)", "growth", "95 %");
  const auto show = [&](const Horizon& h) {
    const Status status = status_of(h);
    progress.reset();
    failed = failed || status.word == "fail";
    for (const HorizonPoint& p : h.points) {
      const bool last = &p == &h.points.back();
      if (!last && !f.all) continue;
      say("{:<18} {:<7} {:<19}{:>12}{:>11.3g}{:>13.4g}{:>12.3g}{}{}\n", h.subject, h.scalar, h.walk, p.n,
          p.norm, p.attitude, p.attitude / std::sqrt(static_cast<double>(p.n)),
          last && std::isfinite(h.exponent)
              ? fmt::format("{:>9.2f}  {:.2f} .. {:.2f}", h.exponent, h.low, h.high)
              : "",
          !last || status.why.empty() ? "" : (status.word == "fail" ? "  FAILED: " : "  ") + status.why);
    }
    std::fflush(stdout);
    rows.push_back(json_of(h, status));
  };
  const bool complete = measure_horizons(o, show) && measure_scene_horizons(o, show);
  for (const std::string& what : left_out) say("left out: {}\n", what);
  if (!complete)
    warn(fmt::format("interrupted{}\n",
                     std::filesystem::exists(o.state) ? ": the same command goes on with " + o.state : ""));
  const int code = failed ? property_failed : !complete || rows.empty() ? incomplete : within_budget;
  if (!f.json.empty())
    write_record(f.json, {{"horizons", 1},
                          {"version", LIECHECK_VERSION},
                          {"environment", environment()},
                          {"verdict", failed                  ? "fail"
                                      : code == within_budget ? "pass"
                                                              : "incomplete"},
                          {"steps", o.steps},
                          {"paths", o.paths},
                          {"seed", o.seed},
                          {"rows", rows}});
  return code;
}

}  // namespace

Command horizons_command(CLI::App& lab) {
  CommandWith<HorizonsFlags> a(
      lab, "horizons",
      "measure the drift over many calls: the drift of norm and attitude over many calls of "
      "integrate, of products with a "
      "normalisation, and of compose there and back, and how fast they grow. Exit code 0 if "
      "liecheck keeps what docs/laboratory.md says; 1 if not; 2 for bad input; 3 if stopped");
  a.list("--subject", a->subjects, "NAME", "a subject, repeatable; default liecheck");
  a.list("--scalar", a->scalars, "T", "float or double, repeatable; default both");
  a.list("--walk", a->walks, "WALK",
         fmt::format("{}; repeatable; default all", fmt::join(horizon_walk_names(), ", ")));
  a.number("--steps", a->options.steps, 64, 100'000'000'000, "calls of each path");
  a.number("--paths", a->options.paths, 1, 64, "paths with other random numbers");
  a.seed(a->options.seed, "seed of the increments");
  a.updated("--state", a->options.state, "FILE", "write where each path is, and go on from there");
  a.toggle("--all", a->all, "show all points");
  a.jobs(a->options.jobs);
  a.json(a->json, "write the rows to FILE");
  return a.runs(run);
}

}  // namespace liecheck::properties
