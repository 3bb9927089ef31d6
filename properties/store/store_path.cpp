#include <fmt/format.h>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <store/store.hpp>
#include <store/store_path.hpp>

namespace liecheck::properties {

namespace {

/// Returns FILE and N; N is 0 if the argument has none.
std::pair<std::string, int> split(const std::string& name) {
  const auto at = name.rfind('@');
  if (at == std::string::npos || std::filesystem::exists(name)) return {name, 0};
  const char *p = name.data() + at + 1, *end = name.data() + name.size();
  int number = 0;
  const auto r = std::from_chars(p, end, number);
  if (r.ec != std::errc() || r.ptr != end) return {name, 0};
  if (number < 1)
    throw std::runtime_error(fmt::format("{}: the campaigns of a store are numbered from 1", name));
  return {name.substr(0, at), number};
}

}  // namespace

std::string stored_file(const std::string& argument) {
  return split(argument).first;
}

StoredCampaign load_campaign(const std::string& argument) {
  const auto [file, number] = split(argument);
  Store store(file, Store::Open::existing);
  return store.load(number ? number : store.campaigns());
}

bool is_store(const std::string& name) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(name, error)) return false;  // a pipe must not be read here
  std::ifstream file(name, std::ios::binary);
  char head[16] = {};
  file.read(head, sizeof head);
  return file && std::string(head, sizeof head) == std::string("SQLite format 3\0", 16);
}

}  // namespace liecheck::properties
