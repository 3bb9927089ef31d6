#pragma once
// The instructions that batches use. They are chosen when the program runs, so that one binary runs
// everywhere and uses what the processor has.

namespace liecheck::batch {

/// baseline: those for which the library is compiled. avx2: AVX2 and FMA, 32 bytes at once. avx512: AVX-512
/// F, VL, BW and DQ, 64 bytes at once. avx2 and avx512 give the same bits; without FMA the last bits differ.
enum class Instructions { baseline, avx2, avx512 };

/// Whether this library and this processor have them.
bool supported(Instructions instructions);
/// The last of the enumeration that is supported.
Instructions bestInstructions();

/// How a batch is computed. The result depends on neither the number of threads nor the other columns.
struct Options {
  int threads = 1;  ///< at most; short batches use fewer. Without OpenMP there is one.
  Instructions instructions = bestInstructions();
};

}  // namespace liecheck::batch
