// A program that speaks the process protocol (docs/adapters.md) for an adapter with the C interface. Both are compiled
// into one executable, for environments that load no shared library: another architecture, another C library.

#include <liecheck_adapter.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace {

struct Sizes {
  const char* operation;
  std::size_t inputs, results;
};
constexpr Sizes all_sizes[] = {
#define LIECHECK_OPERATION(name, inputs, results) {#name, inputs, results},
#include <liecheck_operations.inc>
#undef LIECHECK_OPERATION
};

/// The text as a string of JSON.
std::string quoted(const std::string& text) {
  std::string all = "\"";
  for (const char c : text)
    if (c == '"' || c == '\\')
      all += std::string("\\") + c;
    else if (static_cast<unsigned char>(c) >= 0x20)
      all += c;
  return all + "\"";
}

/// "quaternion: wxyz, twist: angular first" as an object of JSON.
std::string object_of(const std::string& conventions) {
  const auto word = [](std::string w) {
    w.erase(0, std::min(w.find_first_not_of(' '), w.size()));
    while (!w.empty() && w.back() == ' ') w.pop_back();
    return quoted(w);
  };
  std::string all;
  for (std::size_t at = 0; at < conventions.size();) {
    const std::size_t end = std::min(conventions.find(',', at), conventions.size());
    const std::string one = conventions.substr(at, end - at);
    const std::size_t colon = std::min(one.find(':'), one.size());
    all += (all.empty() ? "" : ", ") + word(one.substr(0, colon)) + ": " +
           word(one.substr(std::min(colon + 1, one.size())));
    at = end + 1;
  }
  return "{" + all + "}";
}

using Function = std::function<void(size_t n, const void* inputs, void* results, unsigned char* status)>;
/// The function of an operation, of either version of the interface; empty if it is not offered.
Function function_of(const liecheck_adapter& a, const char* operation, const char* scalar) {
  if (a.interface_version > 1 && a.find_call) {
    const liecheck_call call = a.find_call(a.context, operation, scalar);
    if (!call) return {};
    return [&a, call](size_t n, const void* inputs, void* results, unsigned char* status) {
      call(a.context, n, inputs, results, status);
    };
  }
  return a.find ? Function(a.find(operation, scalar)) : Function();
}

std::string description_of(const liecheck_adapter& a) {
  std::string operations;
  for (const Sizes& o : all_sizes) {
    std::string scalars;
    for (const char* scalar : {"float", "double"})
      if (function_of(a, o.operation, scalar)) scalars += (scalars.empty() ? "" : ", ") + quoted(scalar);
    if (!scalars.empty())
      operations += (operations.empty() ? "" : ", ") + quoted(o.operation) + ": [" + scalars + "]";
  }
  return "{\"protocol\": 1, \"name\": " + quoted(a.name) + ", \"version\": " + quoted(a.version) +
         ", \"operations\": {" + operations +
         "}, \"conventions\": " + object_of(a.conventions ? a.conventions : "") + "}\n";
}

/// The next line without its end. Returns false at the end of the input.
bool read_line(std::string& line) {
  line.clear();
  for (int c = std::getchar(); c != EOF; c = std::getchar()) {
    if (c == '\n') return true;
    line += static_cast<char>(c);
  }
  return false;
}

/// Turns numbers from little-endian into this machine's order of bytes, or back.
void swap_if_big_endian(std::vector<unsigned char>& bytes, std::size_t size) {
  if constexpr (std::endian::native == std::endian::big)
    for (std::size_t i = 0; i + size <= bytes.size(); i += size)
      std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(i),
                   bytes.begin() + static_cast<std::ptrdiff_t>(i + size));
}

bool write_all(const void* bytes, std::size_t size) {
  return std::fwrite(bytes, 1, size, stdout) == size;
}

/// "call exp6 double 128". Returns false if the line is another one, or if the input ends.
bool call(const liecheck_adapter& a, const std::string& line) {
  char operation[64] = "", scalar[8] = "";
  unsigned long n = 0;
  if (std::sscanf(line.c_str(), "call %63s %7s %lu", operation, scalar, &n) != 3) return false;
  const bool is_double = std::strcmp(scalar, "double") == 0;
  const auto sizes = std::find_if(std::begin(all_sizes), std::end(all_sizes),
                                  [&](const Sizes& s) { return std::strcmp(s.operation, operation) == 0; });
  const Function function = sizes == std::end(all_sizes) ? Function() : function_of(a, operation, scalar);
  if (!function) return false;
  const std::size_t size = is_double ? 8 : 4;
  std::vector<unsigned char> inputs(n * sizes->inputs * size), results(n * sizes->results * size),
      status(n, liecheck_done);
  if (std::fread(inputs.data(), 1, inputs.size(), stdin) != inputs.size()) return false;
  swap_if_big_endian(inputs, size);
  function(n, inputs.data(), results.data(), status.data());
  swap_if_big_endian(results, size);
  std::string done = "done " + std::to_string(n);
  if (std::find(status.begin(), status.end(), liecheck_refused) != status.end() && a.reason) {
    std::string why = a.reason();
    std::replace(why.begin(), why.end(), '\n', ' ');
    done += ' ' + why;
  }
  done += '\n';
  return write_all(done.data(), done.size()) && write_all(status.data(), n) &&
         write_all(results.data(), results.size()) && std::fflush(stdout) == 0;
}

}  // namespace

int main() {
  const liecheck_adapter& a = *liecheck_get_adapter();
  std::string line;
  if (!read_line(line) || line != "liecheck 1") return 2;
  const std::string description = description_of(a);
  if (!write_all(description.data(), description.size()) || std::fflush(stdout) != 0) return 2;
  while (read_line(line))
    if (!call(a, line)) {
      std::fprintf(stderr, "not a call of an operation that is offered: %s\n", line.c_str());
      return 2;
    }
}
