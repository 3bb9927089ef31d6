#pragma once
// Makes the Peer that a shared library exports.

#include <scenes/peers/peer.hpp>

namespace liecheck::properties {

/// A peer whose runners are of type R, with its methods for a free body and for a chain.
template <class R>
Peer make_peer(const std::string& name, const std::string& version, const std::vector<PeerMethod>& for_free,
               const std::vector<PeerMethod>& for_chain) {
  return {name, version,
          [=](const Benchmark& s) {
            const auto bodies = peer_bodies(s);
            return bodies.empty() ? std::vector<PeerMethod>() : bodies[0].free ? for_free : for_chain;
          },
          [](const Benchmark& s, const std::string& method) { return std::make_unique<R>(s, method); }};
}
template <class R>
Peer make_peer(const std::string& name, const std::string& version, const std::vector<PeerMethod>& methods) {
  return make_peer<R>(name, version, methods, methods);
}

}  // namespace liecheck::properties
