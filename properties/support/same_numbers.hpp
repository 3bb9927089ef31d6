#pragma once
// Whether two results are the same. Two NaN are, whatever their signs and payloads: arithmetic does not determine those
// (IEEE 754-2019, section 6.3), and the same correct code gives others on another run.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace liecheck::properties {

template <class S>
bool same_number(S a, S b) {
  using Bits = std::conditional_t<sizeof(S) == 4, std::uint32_t, std::uint64_t>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b) || (a != a && b != b);
}

/// Lists of equal lengths.
template <class S>
bool same_numbers(std::span<const S> a, std::span<const S> b) {
  return std::ranges::equal(a, b, same_number<S>);
}

/// The bytes of consecutive numbers of S, of equal lengths.
template <class S>
bool same_numbers_in(std::span<const std::byte> a, std::span<const std::byte> b) {
  for (std::size_t at = 0; at < a.size(); at += sizeof(S)) {
    S x, y;
    std::memcpy(&x, a.data() + at, sizeof x), std::memcpy(&y, b.data() + at, sizeof y);
    if (!same_number(x, y)) return false;
  }
  return true;
}

}  // namespace liecheck::properties
