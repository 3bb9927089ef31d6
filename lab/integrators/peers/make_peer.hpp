#pragma once
// Makes the Peer that a shared library exports.

#include <integrators/peers/peer.hpp>

namespace liecheck::properties {

/// A peer with its methods for one free body and for other robots. `armature`: whether it has the inertia of
/// motors.
inline Peer make_peer(decltype(Peer::make) make, const std::string& name, const std::string& version,
                      const std::vector<PeerMethod>& for_free, const std::vector<PeerMethod>& for_others,
                      bool armature = false) {
  const auto why_not = [=](const Benchmark& s) -> std::string {
    const std::string why = why_no_peer(s);
    const bool motors = s.armature.size() && !s.armature.isZero(0);
    return !why.empty() || armature || !motors ? why : "it has no armature, the inertia of motors";
  };
  const auto methods = [=](const Benchmark& s) {
    return s.robot.njoints == 2 && peer_bodies(s)[0].free() ? for_free : for_others;
  };
  return {name, version, why_not, methods, std::move(make)};
}
/// A peer whose runners are of type R, with the same methods for every robot.
template <class R>
Peer make_peer(const std::string& name, const std::string& version, const std::vector<PeerMethod>& methods,
               bool armature = false) {
  return make_peer(
      [](const Benchmark& s, const std::string& method) { return std::make_unique<R>(s, method); }, name,
      version, methods, methods, armature);
}

}  // namespace liecheck::properties
