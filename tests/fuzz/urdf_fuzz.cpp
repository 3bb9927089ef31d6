// urdf_fuzz INPUTS SEED FOLDER: mutates the URDF texts of a folder and gives them to the URDF reader. An
// input that breaks the reader's promise (urdf_input.hpp) or takes more than five seconds is written to
// urdf_fuzz.failing in the working folder, and the exit code is 1. If LIECHECK_FUZZ_KEEP is set, every input
// is first written to urdf_fuzz.last. An input that kills the process is then not lost.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "urdf_input.hpp"
#include "urdf_mutator.hpp"

namespace {

std::string read(const std::filesystem::path& p) {
  std::ifstream file(p, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
void write(const char* path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return std::fputs("usage: urdf_fuzz INPUTS SEED FOLDER\n", stderr), 2;
  const long inputs = std::strtol(argv[1], nullptr, 10);
  liecheck::test::UrdfMutator mutator(std::strtoull(argv[2], nullptr, 10));
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(argv[3]))
    if (entry.is_regular_file() && entry.path().extension() == ".urdf") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> corpus;
  for (const auto& f : files) corpus.push_back(read(f));
  if (corpus.empty() || inputs < 0)
    return std::fputs("urdf_fuzz: INPUTS is negative, or FOLDER has no *.urdf\n", stderr), 2;
  const bool keep = std::getenv("LIECHECK_FUZZ_KEEP") != nullptr;
  long robots = 0;
  double slowest = 0;
  std::vector<std::string> found;  // mutants that loaded, to be mutated further
  for (long i = 0; i < inputs; ++i) {
    const auto pick = [&]() -> const std::string& {
      const std::size_t k = mutator.below(corpus.size() + found.size());
      return k < corpus.size() ? corpus[k] : found[k - corpus.size()];
    };
    const std::string& base = pick();
    const std::string text = mutator.mutated(base, pick());
    if (keep) write("urdf_fuzz.last", text);
    const auto start = std::chrono::steady_clock::now();
    try {
      if (liecheck::test::try_urdf(text)) {
        ++robots;
        if (found.size() < 200)
          found.push_back(text);
        else
          found[mutator.below(found.size())] = text;
      }
    } catch (const std::exception& e) {
      write("urdf_fuzz.failing", text);
      std::fprintf(stderr, "input %ld: %s\n", i, e.what());
      return 1;
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    slowest = std::max(slowest, seconds);
    if (seconds > 5) {
      write("urdf_fuzz.failing", text);
      std::fprintf(stderr, "input %ld takes %.1f s\n", i, seconds);
      return 1;
    }
  }
  std::printf("%ld inputs, %ld robots, the slowest in %.3f s\n", inputs, robots, slowest);
  return 0;
}
