#include <liecheck/scene/count_instructions.hpp>

#if defined(__x86_64__) && defined(__unix__)
#include <x86intrin.h>

#include <csignal>
#endif

namespace liecheck::scene {

#if defined(__x86_64__) && defined(__unix__)
namespace {

volatile long traps = 0;

constexpr unsigned long long trap_flag = 0x100;
struct Trapping {
  Trapping() { __writeeflags(__readeflags() | trap_flag); }
  ~Trapping() { __writeeflags(__readeflags() & ~trap_flag); }
};

long trapsOf(const std::function<void()>& f) {
  traps = 0;
  {
    const Trapping until_the_end;
    f();
  }
  return traps;
}

}  // namespace

std::optional<long> countInstructions(const std::function<void()>& f) {
  f();
  struct sigaction counting {
  }, before{};
  counting.sa_handler = [](int) { traps = traps + 1; };
  if (sigaction(SIGTRAP, &counting, &before) != 0) return {};
  const long around = trapsOf([] {}), all = trapsOf(f);
  sigaction(SIGTRAP, &before, nullptr);
  if (around == 0) return {};
  return all - around;
}
#else
std::optional<long> countInstructions(const std::function<void()>&) {
  return {};
}
#endif

}  // namespace liecheck::scene
