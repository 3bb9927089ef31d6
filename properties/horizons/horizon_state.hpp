#pragma once
// Where each path is, in a file from which a run goes on.

#include <fmt/format.h>
#include <chrono>
#include <filesystem>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <support/file_lock.hpp>
#include <support/files.hpp>
#include <support/json.hpp>
#include <utility>

namespace liecheck::properties {

/// The state of all paths in a file.
class HorizonState {
 public:
  /// `options` is what a run must have in common to go on from the file. progress() may be empty. Throws
  /// std::invalid_argument for a file of another run, or one that another program writes.
  HorizonState(const std::string& file, const nlohmann::json& options,
               std::function<void(const std::string&, double)> progress)
      : file_(file), lock_(file), progress_(std::move(progress)) {
    all_ = {{"horizons", 1}, {"options", options}, {"paths", nlohmann::json::object()}};
    if (file_.empty() || !std::filesystem::exists(file_)) return;
    nlohmann::json before;
    try {
      before = parsed(read_whole(file_));
    } catch (const nlohmann::json::exception&) {
      throw std::invalid_argument(fmt::format("{}: is not JSON", file_));
    }
    if (!before.is_object() || !before.contains("horizons") || before["horizons"] != 1 ||
        !before.contains("options") || before["options"] != options || !before.contains("paths") ||
        !before["paths"].is_object())
      throw std::invalid_argument(
          fmt::format("{}: is no state of a run with the options {}", file_, options.dump()));
    all_ = before;
  }
  nlohmann::json get(const std::string& path) {
    const std::lock_guard lock(mutex_);
    return all_["paths"].value(path, nlohmann::json());
  }
  const std::string& file() const { return file_; }
  void tell(const std::string& path, double share) {
    const std::lock_guard lock(mutex_);
    if (progress_) progress_(path, share);
  }
  /// Writes the file at most every ten seconds, and when a path ends.
  void put(const std::string& path, nlohmann::json state, bool end) {
    if (file_.empty()) return;
    const std::lock_guard lock(mutex_);
    all_["paths"][path] = std::move(state);
    const auto now = std::chrono::steady_clock::now();
    if (!end && now - written_ < std::chrono::seconds(10)) return;
    written_ = now;
    write_whole(file_, dumped(all_));
  }

 private:
  std::string file_;
  FileLock lock_;
  std::function<void(const std::string&, double)> progress_;
  std::mutex mutex_;
  nlohmann::json all_;
  std::chrono::steady_clock::time_point written_ = std::chrono::steady_clock::now();
};

}  // namespace liecheck::properties
