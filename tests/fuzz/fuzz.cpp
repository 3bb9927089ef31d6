// fuzz ENTRANCE INPUTS SEED FIXTURES: mutates texts and gives them to one entrance of the program, or to each one if
// ENTRANCE is `all`. A text that breaks the reader's promise or takes more than five seconds of the processor is written to
// fuzz.ENTRANCE.failing in the working folder, and the exit code is 1. If LIECHECK_FUZZ_KEEP is set, every text is first written
// to fuzz.ENTRANCE.last, so that one that kills the process is not lost. Ctrl-C ends it with what was done.

#include <fmt/format.h>
#include <app/command_line.hpp>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <liecheck/text/utf8.hpp>
#include <support/progress.hpp>

#include "entrances.hpp"
#include "mutator.hpp"

namespace {

using liecheck::test::Broken, liecheck::test::Entrance;

volatile std::sig_atomic_t stopped = 0;

/// A refusal has words, and is a line that a terminal can show.
void check_message(const std::string& what) {
  if (what.empty()) throw Broken{"a refusal without a word"};
  const std::string line = liecheck::properties::one_line(what);
  if (line.size() > 2100 || line.find('\n') != line.npos || liecheck::firstInvalidUtf8(line) < line.size())
    throw Broken{"a refusal that is no line: " + line.substr(0, 200)};
}

int fuzz(const Entrance& e, std::uint64_t inputs, std::uint64_t seed) {
  if (e.corpus.empty()) return fmt::print(stderr, "fuzz: no text to mutate for {}\n", e.name), 2;
  std::size_t longest = 20000;
  for (const std::string& text : e.corpus) longest = std::max(longest, text.size() + 1000);
  liecheck::test::Mutator mutator(seed, e.words, longest);
  liecheck::properties::Progress progress("fuzz " + e.name);
  const bool keep = std::getenv("LIECHECK_FUZZ_KEEP") != nullptr;
  const auto write = [&](const char* ending, const std::string& text) {
    std::ofstream("fuzz." + e.name + ending, std::ios::binary) << text;
  };
  std::uint64_t accepted = 0, i = 0;
  double slowest = 0;
  std::vector<std::string> found;  // mutants that were accepted, to be mutated further
  const auto begin = std::chrono::steady_clock::now();
  for (; i < inputs && !stopped; ++i) {
    const auto pick = [&]() -> const std::string& {
      const std::size_t k = mutator.below(e.corpus.size() + found.size());
      return k < e.corpus.size() ? e.corpus[k] : found[k - e.corpus.size()];
    };
    const std::string& base = pick();
    const std::string text = mutator.mutated(base, pick());
    if (keep) write(".last", text);
    const std::clock_t start = std::clock();  // a busy machine may stop the program for long
    const auto seconds = [&] { return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC; };
    try {
      try {
        if (e.feed(text)) {
          ++accepted;
          if (found.size() < 200)
            found.push_back(text);
          else
            found[mutator.below(found.size())] = text;
        }
      } catch (const std::exception& refusal) {
        check_message(refusal.what());
      }
      slowest = std::max(slowest, seconds());
      if (seconds() > 5) throw Broken{fmt::format("it takes {:.1f} s", seconds())};
    } catch (const Broken& b) {
      write(".failing", text);
      fmt::print(stderr, "{}: input {}: {}\n", e.name, i, b.what);
      return 1;
    }
    if (i % 256 == 0)
      progress.show(static_cast<double>(i) / static_cast<double>(inputs),
                    fmt::format("{} accepted", accepted));
  }
  const double total = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  progress.show(1, [](double) { return std::string(); });
  fmt::print("{:<12}{:>10} inputs, {:>8} accepted, the slowest in {:.3f} s, {:.0f} s in all\n", e.name, i,
             accepted, slowest, total);
  std::fflush(stdout);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    fmt::print(stderr, "usage: fuzz ENTRANCE INPUTS SEED FIXTURES; entrances: all, {}\n",
               fmt::join(liecheck::test::entrance_names(), ", "));
    return 2;
  }
  std::signal(SIGINT, [](int) { stopped = 1; });
  std::signal(SIGPIPE, SIG_IGN);
  const std::string name = argv[1];
  const char* const memory = "/dev/shm";  // files in it are faster than on a disk
  const std::string scratch = ((std::filesystem::exists(memory) ? std::filesystem::path(memory)
                                                                : std::filesystem::temp_directory_path()) /
                               fmt::format("liecheck_fuzz_{}", ::getpid()))
                                  .string();
  std::filesystem::create_directories(scratch);
  int code = 0;
  try {
    for (const std::string& one : name == "all" ? liecheck::test::entrance_names() : std::vector{name})
      if (code == 0 && !stopped)
        code = fuzz(liecheck::test::entrance(one, argv[4], scratch), std::strtoull(argv[2], nullptr, 10),
                    std::strtoull(argv[3], nullptr, 10));
  } catch (const std::exception& e) {
    fmt::print(stderr, "fuzz: {}\n", e.what());
    code = 2;
  }
  std::filesystem::remove_all(scratch);
  return stopped && code == 0 ? 3 : code;
}
