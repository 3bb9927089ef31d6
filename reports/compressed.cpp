#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <reports/html.hpp>
#include <stdexcept>

namespace liecheck::reports {

std::string compressed(const std::string& text) {
  uLongf size = compressBound(text.size());
  std::string bytes(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(text.data()),
                text.size(), Z_BEST_COMPRESSION) != Z_OK)
    throw std::runtime_error("the figures of the page could not be compressed: out of memory");
  bytes.resize(size);
  std::string
      out;  // four bytes as five digits of base 85, from '#' on and without '<'; of fewer bytes, one digit more
  out.reserve((size + 3) / 4 * 5);
  for (std::size_t i = 0; i < bytes.size(); i += 4) {
    std::uint32_t four = 0;
    for (std::size_t k = i; k < i + 4; ++k)
      four = four << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u);
    char digits[5];
    for (int k = 4; k >= 0; --k, four /= 85)
      digits[k] = static_cast<char>('#' + four % 85 + (four % 85 >= '<' - '#'));
    out.append(digits, std::min<std::size_t>(bytes.size() - i, 4) + 1);
  }
  return out;
}

}  // namespace liecheck::reports
