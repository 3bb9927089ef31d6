#include <environments/environments.hpp>

#include <fmt/format.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace liecheck::properties::environments {

namespace {

using Need = Environment::Need;

Environment call(const std::string& name, const std::string& what, Promise promise, FloatMode mode) {
  return {name, what, promise, mode};
}

Environment build(const std::string& name, const std::string& compiler, const std::string& flags,
                  std::vector<Need> needs = {}, Promise promise = Promise::same) {
  Environment e{name, compiler + " " + flags, promise};
  e.compiler = compiler, e.flags = flags, e.needs = std::move(needs);
  const bool clang = compiler.starts_with("clang");
  e.needs.insert(e.needs.begin(),
                 {Need::program, compiler, clang ? "apt-get install clang" : "apt-get install g++"});
  return e;
}

Environment emulated(const std::string& architecture) {
  const std::string compiler = architecture + "-linux-gnu-g++", runs = "qemu-" + architecture;
  Environment e =
      build(architecture, compiler, "-O2 -static", {{Need::program, runs, "apt-get install qemu-user"}});
  e.needs.front().get = "apt-get install g++-" + architecture + "-linux-gnu";
  e.what += ", run by " + runs;
  e.run = runs;
  return e;
}

/// Run by qemu, since many kernels no longer run programs of 32 bits.
Environment of_32_bits(const std::string& name, const std::string& flags) {
  Environment e = build(
      name, "g++", "-O2 -m32 " + flags + " -static -idirafter /usr/include/x86_64-linux-gnu",
      {{Need::file, "/usr/lib/gcc/x86_64-linux-gnu/12/32/libstdc++.a", "apt-get install g++-12-multilib"},
       {Need::program, "qemu-i386", "apt-get install qemu-user"}});
  e.what += ", run by qemu-i386";
  e.run = "qemu-i386 -cpu max";
  return e;
}

/// glibc's mathematical functions are replaced by the objects of musl's that compute them.
Environment musl() {
  const std::string archive = "/usr/lib/x86_64-linux-musl/libc.a";
  Environment e = build("musl-libm", "g++", "-O2", {{Need::file, archive, "apt-get install musl-dev"}});
  e.what += ", sin, cos, atan2, hypot, ... of musl's libm";
  e.prepare = fmt::format(
      "rm -rf musl && mkdir musl && cd musl && ar x {0} $(ar t {0} | grep -E "
      "'^(__(cos|sin|tan|rem_pio2|math|expo2)[a-z0-9_]*|(sin|cos|tan|sincos|asin|acos|atan|atan2|hypot|exp|"
      "exp2|log|log2|"
      "pow|fma|remainder|remquo|fmod|ldexp|scalbn|frexp|floor|ceil|rint|round|trunc|cbrt)f?|"
      "(exp|exp2f|log|logf|log2|log2f|pow|powf)_data)[.]l?o$')",
      archive);
  e.link = std::string("-no-pie ") + builds_folder + "/musl/*o";  // .o or .lo
  return e;
}

Environment wasm() {
  Environment e = build("wasm", "em++", "-O2 -fexceptions -sNODERAWFS=1 -sALLOW_MEMORY_GROWTH=1",
                        {{Need::program, "node", "apt-get install nodejs"}});
  e.needs.front().get = "apt-get install emscripten node-acorn";
  e.what += ", run by node";
  e.run = "node --no-experimental-fetch", e.ending = ".js";  // else this emscripten fetches its file as a URL
  return e;
}

std::vector<Environment> make() {
  const Need v3{Need::processor, "avx2", "a processor of x86-64-v3"};
  const Need v4{Need::processor, "avx512vl", "a processor of x86-64-v4"};
  const Need libcxx{Need::file, "/usr/include/c++/v1/version", "apt-get install libc++-dev libc++abi-dev"};
  std::vector<Environment> all{
      call("up", "every call rounds up", Promise::fourfold, {FE_UPWARD, false}),
      call("down", "every call rounds down", Promise::fourfold, {FE_DOWNWARD, false}),
      call("zero", "every call rounds to zero", Promise::fourfold, {FE_TOWARDZERO, false}),
      build("gcc-O0", "g++", "-O0"),
      build("gcc-O2", "g++", "-O2"),
      build("gcc-O3-v3", "g++", "-O3 -march=x86-64-v3 -ffp-contract=fast", {v3}),
      build("gcc-O3-v3-off", "g++", "-O3 -march=x86-64-v3 -ffp-contract=off", {v3}),
      build("gcc-O3-v4", "g++", "-O3 -march=x86-64-v4 -ffp-contract=fast", {v4}),
      build("clang-O2", "clang++", "-O2"),
      build("clang-O3-v3", "clang++", "-O3 -march=x86-64-v3 -ffp-contract=fast", {v3}),
      build("clang-libc++", "clang++", "-O2 -stdlib=libc++", {libcxx}),
      build("gcc-x87", "g++", "-O2 -mfpmath=387", {{Need::processor, "sse2", "a processor of x86-64"}}),
      of_32_bits("gcc-m32-x87", "-mfpmath=387"),
      of_32_bits("gcc-m32-sse2", "-msse2 -mfpmath=sse"),
      musl(),
      emulated("aarch64"),
      emulated("riscv64"),
      emulated("s390x"),
      wasm(),
      build("gcc-fast-math", "g++", "-O2 -ffast-math", {}, Promise::none),
      build("gcc-Ofast-v3", "g++", "-Ofast -march=x86-64-v3", {v3}, Promise::none),
      build("clang-fast-math", "clang++", "-O2 -ffast-math", {}, Promise::none)};
  if (FloatEnvironment::can_flush())
    all.insert(all.begin() + 3, call("flush", "every call takes subnormal numbers for zero", Promise::flushed,
                                     {FE_TONEAREST, true}));
  return all;
}

bool is_in_path(const std::string& program) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  std::error_code error;
  for (std::string folder; std::getline(folders, folder, ':');)
    if (std::filesystem::exists(folder + "/" + program, error)) return true;
  return false;
}

bool processor_has(const std::string& flag) {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("flags")) return (line + " ").find(" " + flag + " ") != line.npos;
  return false;
}

bool is_there(const Need& n) {
  std::error_code error;
  switch (n.kind) {
    case Need::program:
      return is_in_path(n.what);
    case Need::file:
      return std::filesystem::exists(n.what, error);
    case Need::processor:
      return processor_has(n.what);
  }
  return false;
}

}  // namespace

const std::vector<Environment>& all() {
  static const std::vector<Environment> environments = make();
  return environments;
}

std::string missing(const Environment& e) {
  std::string text;
  for (const Need& n : e.needs)
    if (!is_there(n))
      text += fmt::format("{}{} is not there; to get it: {}", text.empty() ? "" : "; ", n.what, n.get);
  return text;
}

}  // namespace liecheck::properties::environments
