#pragma once
// SHA-256, and a digest of a set of records that does not depend on their order: the sum modulo 2^256 of the
// records' SHA-256. Threads and chunks can be added up in any order.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace liecheck::properties {

using Sha256 = std::array<std::uint64_t, 4>;

Sha256 sha256(std::string_view bytes);
std::string hexadecimal(const Sha256& digest);

class SetDigest {
 public:
  void add(std::string_view record) { add(sha256(record)); }
  void merge(const SetDigest& other) { add(other.sum_); }
  /// SHA-256 of a header and the sum.
  std::string finish(std::string_view header) const;

 private:
  void add(const Sha256& d);
  Sha256 sum_{};
};

}  // namespace liecheck::properties
