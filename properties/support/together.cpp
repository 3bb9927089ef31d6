// makecontext() begins a task on its stack; from then on setjmp() and longjmp() change stacks, because swapcontext() makes
// a system call. glibc's check of longjmp(), of which it tells nobody to use another stack, must be off.
#undef _FORTIFY_SOURCE

#include <support/together.hpp>

#include <setjmp.h>
#include <sys/mman.h>
#include <ucontext.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <utility>
#include <vector>

namespace liecheck::properties {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool has_stacks = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
constexpr bool has_stacks = false;
#else
constexpr bool has_stacks = true;
#endif
#else
constexpr bool has_stacks = true;
#endif

/// A stack, below which memory is protected, so that an overflow is a crash. It runs one task after the other.
class Stack {
 public:
  /// `number` differs between stacks, which begin in other cache lines: at the same place of its page each would
  /// replace the others in the cache.
  Stack(std::size_t number, void (*run)())
      : memory_(mmap(nullptr, size, PROT_READ | PROT_WRITE, flags, -1, 0)) {
    if (!exists()) return;
    mprotect(memory_, guard, PROT_NONE);
    getcontext(&start_);
    start_.uc_stack.ss_sp = memory_, start_.uc_stack.ss_size = size - number % 56 * 1088;
    start_.uc_link = nullptr;
    makecontext(&start_, run, 0);
  }
  Stack(const Stack&) = delete;
  Stack& operator=(const Stack&) = delete;
  ~Stack() {
    if (exists()) munmap(memory_, size);
  }
  bool exists() const { return memory_ != MAP_FAILED; }
  /// Goes on where it was left, or begins. Returns when the stack is left.
  void enter() {
    if (_setjmp(outside_)) return;
    if (std::exchange(begun_, true)) _longjmp(inside_, 1);
    setcontext(&start_);
  }
  /// Returns when the stack is entered again.
  void leave() {
    if (!_setjmp(inside_)) _longjmp(outside_, 1);
  }

 private:
  static constexpr std::size_t size = 1 << 20, guard = 1 << 16;
  static constexpr int flags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK;
  void* memory_;
  ucontext_t start_;
  jmp_buf inside_, outside_;
  bool begun_ = false;
};

class Together;
thread_local Together* running = nullptr;

class Together {
 public:
  Together(std::size_t n, const std::function<void(std::size_t)>& task,
           const std::function<void(std::size_t)>& switched)
      : task_(task), switched_(switched), tasks_(n) {}

  void run() {
    Together* const before = std::exchange(running, this);
    for (now_ = 0; now_ < tasks_.size(); ++now_) begin(now_);
    while (answer())
      for (now_ = 0; now_ < tasks_.size(); ++now_)
        if (tasks_[now_].answered) switched_(now_), enter(now_);
    running = before;
    if (error_) std::rethrow_exception(error_);
  }
  bool may_wait() const { return inside_ && std::uncaught_exceptions() == 0 && !std::current_exception(); }
  void wait(Question& question) {
    Task& task = tasks_[now_];
    task.question = &question;
    task.stack->leave();
    task.answered = false;
  }

 private:
  struct Task {
    Stack* stack = nullptr;
    Question* question = nullptr;
    bool answered = false;
  };

  void begin(std::size_t k) {
    // A task that never waits leaves its stack to the next one. A thread keeps its stacks.
    thread_local std::vector<std::unique_ptr<Stack>> stacks;
    if (used_ == stacks.size() && has_stacks) stacks.push_back(std::make_unique<Stack>(used_, &tasks));
    if (!has_stacks || !stacks[used_]->exists()) return guarded(k);
    tasks_[k].stack = stacks[used_].get();
    enter(k);
    used_ += tasks_[k].question != nullptr;
  }
  void enter(std::size_t k) {
    inside_ = true;
    tasks_[k].stack->enter();
    inside_ = false;
    if (tasks_[k].question) switched_(k);
  }
  /// What a stack runs.
  static void tasks() {
    for (;;) {
      Stack* const here = running->tasks_[running->now_].stack;
      running->guarded(running->now_);
      here->leave();
    }
  }
  void guarded(std::size_t k) try { task_(k); } catch (...) {
    if (!error_) error_ = std::current_exception();
  }

  /// Answers all questions. Returns false if there is none.
  bool answer() {
    std::vector<Question*> waiting;
    for (Task& task : tasks_)
      if (task.question) {
        waiting.push_back(std::exchange(task.question, nullptr));
        task.answered = true;
      }
    const bool any = !waiting.empty();
    for (auto from = waiting.begin(); from != waiting.end();) {
      const auto to = std::stable_partition(
          from, waiting.end(), [how = (*from)->answer](const Question* q) { return q->answer == how; });
      (*from)->answer({from, to});
      from = to;
    }
    return any;
  }

  const std::function<void(std::size_t)>&task_, &switched_;
  std::vector<Task> tasks_;
  std::size_t now_ = 0, used_ = 0;
  bool inside_ = false;
  std::exception_ptr error_;
};

}  // namespace

void run_together(std::size_t n, const std::function<void(std::size_t)>& task,
                  const std::function<void(std::size_t)>& switched) {
  if (!running) return Together(n, task, switched).run();
  for (std::size_t k = 0; k < n; ++k) task(k);  // inside a task, which may wait in each of them
}
bool can_wait() {
  return running && running->may_wait();
}
void wait_for_answer(Question& question) {
  running->wait(question);
}

}  // namespace liecheck::properties
