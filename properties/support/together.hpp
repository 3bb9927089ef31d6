#pragma once
// Tasks of one thread that wait for answers together, so that many questions are asked at once. Each task runs on a
// stack of its own (a fiber).

#include <cstddef>
#include <functional>
#include <span>

namespace liecheck::properties {

/// What a task waits for: derive from it. `answer` receives the questions of all tasks that wait for the same
/// function, in the order of the tasks, and must not throw.
struct Question {
  void (*answer)(std::span<Question* const> all);
};

/// Runs task(0) to task(n - 1) and returns when all have ended. When each has ended or waits, the questions are
/// answered. `switched(k)` is called before task k goes on after it waited, and when it begins to wait: there it
/// exchanges pointers of the thread that the task has for itself. The first exception of a task is thrown again at
/// the end. Under a sanitizer, which does not know of other stacks, and without memory for stacks, tasks cannot wait.
void run_together(std::size_t n, const std::function<void(std::size_t)>& task,
                  const std::function<void(std::size_t)>& switched);

/// Whether the caller is a task that may wait. It may not while it handles an exception, of which a thread has one.
bool can_wait();

/// Returns when the question is answered. May be called only if can_wait().
void wait_for_answer(Question& question);

}  // namespace liecheck::properties
