#include <support/run_state.hpp>

#include <fmt/format.h>
#include <filesystem>
#include <stdexcept>
#include <support/checksum.hpp>
#include <support/files.hpp>
#include <support/json.hpp>
#include <support/read_json.hpp>
#include <utility>

namespace liecheck::properties {

using nlohmann::json;

RunState::RunState(const std::string& file, const json& options)
    : file_(file), lock_(file), all_({{"options", options}, {"parts", json::object()}}) {
  if (file_.empty()) return;
  check_writable(file_);
  if (!std::filesystem::exists(file_)) return;
  json before = read_json(file_);
  if (!before.is_object() || before.value("options", json()) != options ||
      !before.value("parts", json()).is_object())
    throw std::invalid_argument(
        fmt::format("{}: is no state of a run with the options {}", file_, options.dump()));
  if (before.value("checksum", json()) != checksum(dumped(before["parts"])))
    throw std::invalid_argument(file_ + ": was changed since it was written: its checksum is another one");
  all_ = std::move(before);
}

json RunState::get(const std::string& part) const {
  return all_["parts"].value(part, json());
}

void RunState::put(const std::string& part, json value, bool later) {
  if (file_.empty()) return;
  all_["parts"][part] = std::move(value);
  const auto now = std::chrono::steady_clock::now();
  if (later && now - written_ < std::chrono::seconds(10)) return;
  written_ = now;
  all_["checksum"] = checksum(dumped(all_["parts"]));
  write_whole(file_, dumped(all_));
}

}  // namespace liecheck::properties
