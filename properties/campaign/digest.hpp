#pragma once
// SHA-256, and a digest of a set of records: the sum modulo 2^256 of their 128-bit XXH3 hashes. The sum does
// not depend on the order of the records. (XXH3 detects accidental changes, but not deliberate ones.)

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace liecheck::properties {

using Sha256 = std::array<std::uint64_t, 4>;

Sha256 sha256(std::string_view bytes);
std::string hexadecimal(const Sha256& digest);

class SetDigest {
 public:
  void add(const void* record, std::size_t bytes);
  void merge(const SetDigest& other) { add(other.sum_); }
  void merge(const Sha256& sum) { add(sum); }
  const Sha256& sum() const { return sum_; }
  /// SHA-256 of a header and the sum.
  std::string finish(std::string_view header) const;

 private:
  void add(const Sha256& d);
  Sha256 sum_{};
};

}  // namespace liecheck::properties
