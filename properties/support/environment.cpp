#include <support/environment.hpp>

#include <gnu/libc-version.h>
#include <sys/utsname.h>

#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <support/json.hpp>

namespace liecheck::properties {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line))
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace

nlohmann::json environment() {
  utsname u{};
  uname(&u);
  return {{"cpu", processor()},
          {"os", fmt::format("{} {}", u.sysname, u.machine)},
          {"compiler", LIECHECK_COMPILER},
          {"flags", LIECHECK_FLAGS},
          {"fma_contraction", "off"},
          {"libm", fmt::format("glibc {}", gnu_get_libc_version())}};
}

std::string environment_text() {
  return dumped(environment());
}

std::string environment_line() {
  const auto text = [all = environment()](const char* name) { return all[name].get<std::string>(); };
  return fmt::format("{}, governor {}, {}, {}, {}", text("cpu"), frequency_governor(), text("os"),
                     text("compiler"), text("flags"));
}

std::string frequency_governor() {
  std::ifstream file("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  std::string name;
  return std::getline(file, name) ? name : "unknown";
}

}  // namespace liecheck::properties
