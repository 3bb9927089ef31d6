#include <integrators/peers/peer.hpp>

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace liecheck::properties {
namespace {

constexpr const char* known[] = {"Bullet", "DART", "MuJoCo", "ODE", "Simbody"};

std::vector<Peer> load() {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  std::vector<Peer> all;
  for (std::string name : known) {
    std::string file = name + ".so";
    std::transform(file.begin(), file.end(), file.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    const auto path = program.parent_path().parent_path() / "scene_peers" / file;
    if (!std::filesystem::exists(path, error)) continue;
    void* const module = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!module) {  // built, but a library that it needs is missing
      std::fputs(fmt::format("{} is left out: {}\n", name, ::dlerror()).c_str(), stderr);
      continue;
    }
    const auto get = reinterpret_cast<const PeerModule* (*)()>(::dlsym(module, "liecheck_scene_peer"));
    if (!get || get()->layout != PeerModule().layout)
      throw std::runtime_error(
          fmt::format("{}: built with other type layouts than this program: rebuild both", path.string()));
    all.push_back(get()->peer);
  }
  return all;
}

}  // namespace

const std::vector<Peer>& peers() {
  static const std::vector<Peer> all = load();
  return all;
}

std::vector<std::string> absent_peers() {
  std::vector<std::string> names;
  for (const char* name : known)
    if (std::none_of(peers().begin(), peers().end(), [&](const Peer& p) { return p.name == name; }))
      names.push_back(name);
  return names;
}

}  // namespace liecheck::properties
