#pragma once
// The instructions that batches use. They are chosen when the program runs, so that one binary runs
// everywhere and uses what the processor has.

namespace liecheck::batch {

/// baseline: those for which the library is compiled. avx2: 32 bytes at once. avx512: AVX-512 F, VL, BW and
/// DQ, 64 bytes at once. All give the same bits. No multiplication is fused with an addition: that would save
/// a tenth of the time at most, but cross(v, v) would not be 0, and aba would lose all digits of small
/// results.
enum class Instructions { baseline, avx2, avx512 };

/// Whether this library and this processor have them.
bool supported(Instructions instructions);
/// The last of the enumeration that is supported.
Instructions bestInstructions();

/// How a batch is computed. The result depends on none of these, nor on the other columns.
struct Options {
  int threads = 1;  ///< at most; short batches use fewer. Without OpenMP there is one.
  Instructions instructions = bestInstructions();
};

}  // namespace liecheck::batch
