#include <liecheck/scene/count_instructions.hpp>

#if defined(__x86_64__) && defined(__linux__)
#include <sys/syscall.h>
#include <time.h>
#include <ucontext.h>
#include <unistd.h>
#include <x86intrin.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdint>
#endif

namespace liecheck::scene {

#if defined(__x86_64__) && defined(__linux__)
extern "C" {
// Where a call that is not counted returns to, and where it would have returned to.
[[gnu::visibility("hidden")]] void liecheck_count_on();
[[gnu::visibility("hidden")]] std::uintptr_t liecheck_count_from = 0;
}
// The trap flag acts after the instruction that follows popfq. The caller made a call, so that it keeps nothing below
// its stack pointer.
asm(R"(
  .text
  .type liecheck_count_on, @function
liecheck_count_on:
  endbr64
  pushfq
  orq $0x100, (%rsp)
  popfq
  jmp *liecheck_count_from(%rip)
  .size liecheck_count_on, .-liecheck_count_on
)");

namespace {

constexpr unsigned long long trap_flag = 0x100;

double nowInSeconds() {
  timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// The counts of a function's calls, of all or of those with the same small whole numbers as arguments: the index of a
/// joint, or a size.
struct Function {
  std::uint64_t key = 0;
  long counted = 0;
  double mean = 0, squares = 0;  ///< squares: the sum of (count - mean)^2

  void add(double count) {
    const double d = count - mean;
    mean += d / double(++counted), squares += d * (count - mean);
  }
  /// Whether `least` calls were counted, with a standard error of the mean below 1 %.
  bool known(long least) const {
    return counted >= least &&
           (counted == 1 || squares <= 1e-4 * mean * mean * double(counted) * double(counted - 1));
  }
};

/// A call that is being counted.
struct Call {
  std::uintptr_t stack;  ///< the address of its return address
  Function *like, *any;  ///< of its arguments, and of all
  double begin;          ///< the count when it began
  bool chosen;  ///< as one of the sample of a function: one in eight, and those that a robot begins with
};

/// All that the handler of the signal reads and writes. It allocates nothing.
struct Counting {
  double count = 0;
  std::uintptr_t instruction = 0, stack = 0;  ///< of the last trap
  std::size_t depth = 0;
  std::array<Call, 256> calls;
  std::array<Function, 8192> functions;
  bool every = true, resumed = false, expired = false, hurried = false;
  long traps = 0;
  double half = 0, until = 0;

  Function* function(std::uint64_t key) {
    for (std::size_t i = key * 0x9E3779B97F4A7C15u >> 51, n = 0; n < 16;
         i = (i + 1) % functions.size(), ++n) {
      if (functions[i].key == 0) functions[i].key = key;
      if (functions[i].key == key) return &functions[i];
    }
    return nullptr;
  }
  /// The instructions of a call that need not be counted, or 0. A call that is not counted takes two traps.
  /// A call may make another number of iterations than the one before. So one that is a tenth of all is counted, and of one
  /// that is a thirtieth, two must agree.
  double expected(const Call& call) {
    constexpr double little = 8;
    const auto needs = [&](const Function& like) { return hurried && like.mean <= 0.03 * count ? 1 : 2; };
    if (call.like->mean > 0.1 * count) return 0;
    if (call.like->mean > little && call.like->known(needs(*call.like))) return call.like->mean;
    const double mean = call.any->mean;
    return needs(*call.any) == 1 && !call.chosen && call.any->counted >= 8 && mean > little ? mean : 0;
  }
} counting;

/// After each instruction: counts it, and notes calls and returns by the stack pointer.
void onTrap(int, siginfo_t*, void* context) {
  auto& registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  const auto instruction = std::uintptr_t(registers[REG_RIP]), stack = std::uintptr_t(registers[REG_RSP]);
  Counting& c = counting;
  if (!c.resumed) c.count += 1;
  c.resumed = false;
  if (++c.traps % 256 == 0) {
    const double now = nowInSeconds();
    c.hurried = c.hurried || now > c.half;
    if (now > c.until) {
      c.expired = true;
      registers[REG_EFL] &= ~greg_t(trap_flag);
      return;
    }
  }
  while (c.depth > 0 && stack > c.calls[c.depth - 1].stack) {
    const Call& call = c.calls[--c.depth];
    call.like->add(c.count - call.begin), call.any->add(c.count - call.begin);
  }
  // A call pushes the address of the instruction after it, at most 8 bytes on.
  const bool called = !c.every && stack + 8 == c.stack &&
                      *reinterpret_cast<std::uintptr_t*>(stack) != instruction &&
                      *reinterpret_cast<std::uintptr_t*>(stack) - c.instruction - 1 < 8;
  c.instruction = instruction, c.stack = stack;
  if (!called) return;
  std::uint64_t key = instruction;
  bool chosen = (c.traps * 0x9E3779B97F4A7C15u >> 61) == 0;
  for (const int r : {REG_RSI, REG_RDX, REG_RCX, REG_R8}) {
    const auto argument = std::uint64_t(registers[r]);
    key = 31 * key + (argument < 4096 ? argument + 1 : 0);
    chosen = chosen || argument == 1;
  }
  const Call call{stack, c.function(key), c.function(~instruction), c.count, chosen};
  if (!call.like || !call.any) return;
  // The first two calls are those of the work itself.
  if (const double expected = c.depth < 2 ? 0 : c.expected(call); expected > 0) {
    auto& back = *reinterpret_cast<std::uintptr_t*>(stack);
    c.count += expected, c.resumed = true;
    liecheck_count_from = back, back = reinterpret_cast<std::uintptr_t>(&liecheck_count_on);
    registers[REG_EFL] &= ~greg_t(trap_flag);
  } else if (c.depth < c.calls.size()) {
    c.calls[c.depth++] = call;
  }
}

struct Trapping {
  Trapping() { __writeeflags(__readeflags() | trap_flag); }
  ~Trapping() { __writeeflags(__readeflags() & ~trap_flag); }
};

/// Whether the processor refuses a return to another address than that of the call (ARCH_SHSTK_STATUS).
bool hasShadowStack() {
  unsigned long features = 0;
  return ::syscall(SYS_arch_prctl, 0x5005, &features) == 0 && (features & 1);
}

double trapsOf(const InstructionCounter::Work& f) {
  counting.count = 0, counting.depth = 0, counting.instruction = counting.stack = 0, counting.resumed = false;
  {
    const Trapping until_the_end;
    f();
  }
  return counting.count;
}

}  // namespace

InstructionCounter::InstructionCounter(bool every, double seconds, double expected)
    : every_(every || hasShadowStack()), until_(nowInSeconds() + seconds), half_(until_ - seconds / 2) {
  counting.functions = {};
  const double begin = nowInSeconds();
  volatile int sum = 0;
  const auto few = count([&] {
    for (int i = 0; i < 200; ++i) sum = sum + i;
  });
  hurried_ = few && expected / double(*few) * (nowInSeconds() - begin) > 0.9 * seconds;
}

std::optional<long> InstructionCounter::count(const Work& f, const Work& before) const {
  if (nowInSeconds() > until_) return {};
  struct sigaction trap {
  }, earlier{};
  trap.sa_sigaction = onTrap, trap.sa_flags = SA_SIGINFO;
  if (sigaction(SIGTRAP, &trap, &earlier) != 0) return {};
  counting.expired = false, counting.every = every_, counting.hurried = hurried_;
  counting.half = half_, counting.until = until_;
  const double around = trapsOf([] {});
  if (before) before();
  const double all = trapsOf(f);
  sigaction(SIGTRAP, &earlier, nullptr);
  if (around == 0 || counting.expired) return {};
  return std::lround(all - around);
}
double InstructionCounter::soFar() const { return *static_cast<const volatile double*>(&counting.count); }
#else
InstructionCounter::InstructionCounter(bool every, double seconds, double)
    : every_(every), until_(seconds), half_(seconds) {}
std::optional<long> InstructionCounter::count(const Work&, const Work&) const {
  return {};
}
double InstructionCounter::soFar() const { return 0; }
#endif

}  // namespace liecheck::scene
