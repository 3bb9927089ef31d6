#include <liecheck/batch/dispatch.hpp>

#include <exception>

namespace liecheck::batch {

bool supported(Instructions instructions) {
#if defined(LIECHECK_BATCH_X86)
  if (instructions == Instructions::avx2) return __builtin_cpu_supports("avx2");
  if (instructions == Instructions::avx512)
    return supported(Instructions::avx2) && __builtin_cpu_supports("fma") &&
           __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq");
#endif
  return instructions == Instructions::baseline;
}

Instructions bestInstructions() {
  static const Instructions best = supported(Instructions::avx512) ? Instructions::avx512
                                   : supported(Instructions::avx2) ? Instructions::avx2
                                                                   : Instructions::baseline;
  return best;
}

const detail::Kernels& detail::kernelsOf(Instructions instructions) {
  if (!supported(instructions))
    throw std::invalid_argument("a batch is to use instructions that this processor or this library lacks");
#if defined(LIECHECK_BATCH_X86)
  if (instructions == Instructions::avx512) return avx512;
  if (instructions == Instructions::avx2) return avx2;
#endif
  return baseline;
}

void detail::inThreads(Eigen::Index columns, int width, Eigen::Index least, int threads,
                       const std::function<void(Eigen::Index, Eigen::Index)>& f) {
  const Eigen::Index parts = std::clamp<Eigen::Index>(columns / least, 1, std::max(1, threads));
  if (parts == 1) return f(0, columns);
  std::exception_ptr failure;
#pragma omp parallel for num_threads(int(parts))
  for (Eigen::Index k = 0; k < parts; ++k) try {
      f(columns / width * k / parts * width, columns / width * (k + 1) / parts * width);
    } catch (...) {
#pragma omp critical
      failure = std::current_exception();
    }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace liecheck::batch
