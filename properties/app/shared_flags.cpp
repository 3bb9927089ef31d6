#include <app/shared_flags.hpp>

#include <campaign/robots.hpp>

#include <algorithm>
#include <thread>

namespace liecheck::properties {

Flag add_seed(Arguments& a, std::uint64_t& seed, const std::string& help) {
  return a.number("--seed", seed, 0, UINT64_MAX, help);
}

Flag add_jobs(Arguments& a, unsigned& jobs) {
  return a.number("-j,--jobs", jobs, 1, 1024, "number of threads; the digests do not depend on it");
}

unsigned default_jobs() {
  return std::max(1u, std::thread::hardware_concurrency());
}

Flag RobotFlags::add(Arguments& a, const std::string& help) {
  const Flag robot = a.text("--robot", file, "URDF", help);
  a.choice("--root", root, {"free-flyer", "fixed"}, "ROOT",
           "root joint of the robot: free-flyer or fixed")
      .with_default_in_help()
      .needs(robot);
  return robot;
}

Robot RobotFlags::read() const {
  return file.empty() ? built_in_robot() : load_robot(file, root == "fixed");
}

void SelectionFlags::add(Arguments& a) {
  a.list("--subject", subjects, "NAME",
         "a subject, repeatable, or 'all'; default liecheck in float and double");
  a.list("--property", properties, "NAME", "a property, repeatable; default every one");
  a.list("--scalar", scalars, "SCALAR", "float, double or float128, repeatable");
  a.text("--json", json, "FILE", "write the record to FILE");
}

Selection SelectionFlags::selection() const {
  Selection s{subjects, properties, scalars};
  if (subjects.empty()) {
    s.subjects = {"liecheck"};
    if (scalars.empty()) s.scalars = {"float", "double"};
  } else if (std::erase(s.subjects, "all") > 0) {
    check_subjects(s.subjects);
    s.subjects.clear();
  }
  return s;
}

std::vector<Flag> CaseFlags::add(Arguments& a) {
  const Flag count =
      a.number("--cases", cases, 1, std::uint64_t(1) << 40, "cases per property x subject x scalar");
  const Flag robot_flag = robot.add(a), seed_flag = add_seed(a, seed, "seed of the campaign");
  const Flag time = a.duration("--for", seconds, "run for a time instead: 30s, 5m, 1h").excludes(count);
  jobs_flag = add_jobs(a, jobs);
  return {robot_flag, seed_flag, count, time, jobs_flag};
}

}  // namespace liecheck::properties
