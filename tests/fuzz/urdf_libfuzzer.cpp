// The check of urdf_input.hpp as a libFuzzer target, which needs clang: urdf_libfuzzer [flags] FOLDER.

#include <cstddef>
#include <cstdint>

#include "urdf_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  liecheck::test::try_urdf(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
