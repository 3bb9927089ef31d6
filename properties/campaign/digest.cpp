#include <campaign/digest.hpp>

#include <openssl/sha.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <fmt/format.h>

namespace liecheck::properties {

Sha256 sha256(std::string_view bytes) {
  unsigned char md[SHA256_DIGEST_LENGTH];
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), md);
  Sha256 d{};
  for (std::size_t i = 0; i < 32; ++i) d[i / 8] = d[i / 8] << 8 | md[i];
  return d;
}

std::string hexadecimal(const Sha256& d) {
  return fmt::format("{:016x}{:016x}{:016x}{:016x}", d[0], d[1], d[2], d[3]);
}

void SetDigest::add(const void* record, std::size_t bytes) {
  const XXH128_hash_t h = XXH3_128bits(record, bytes);
  add(Sha256{0, 0, h.high64, h.low64});
}

void SetDigest::add(const Sha256& d) {
  unsigned __int128 carry = 0;
  for (std::size_t i = 4; i-- > 0;) {
    carry += static_cast<unsigned __int128>(sum_[i]) + d[i];
    sum_[i] = static_cast<std::uint64_t>(carry);
    carry >>= 64;
  }
}

std::string SetDigest::finish(std::string_view header) const {
  return hexadecimal(sha256(std::string(header) + "\n" + hexadecimal(sum_)));
}

}  // namespace liecheck::properties
