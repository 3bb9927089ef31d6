#include <lattice/verdict_file.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <liecheck/text/from_chars.hpp>
#include <stdexcept>
#include <support/checksum.hpp>
#include <support/files.hpp>

namespace liecheck::properties {
namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields{""};
  for (const char c : line)
    if (c == '\t')
      fields.emplace_back();
    else
      fields.back() += c;
  return fields;
}

template <class T>
bool read_number(const std::string& text, T& value) {
  const char *const first = text.data(), *const last = first + text.size();
  std::from_chars_result read{};
  if constexpr (std::is_floating_point_v<T>)
    read = fromChars(first, last, value);
  else
    read = std::from_chars(first, last, value);
  return read.ec == std::errc() && read.ptr == last;
}

std::string line_of(const LatticeRow& row) {
  const FaultVerdict& v = row.verdict;
  const std::string line =
      fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t", row.key(), row.family,
                  found_words[static_cast<std::size_t>(v.found)], v.cases, v.by, v.share, row.judged);
  return line + checksum(line) + "\n";
}

/// Returns whether the line is a verdict.
bool read_row(const std::string& line, LatticeRow& row) {
  const std::vector<std::string> f = fields_of(line);
  if (f.size() != 12 || f[11] != checksum(line.substr(0, line.size() - f[11].size()))) return false;
  row.subject = f[0], row.operation = f[1], row.block = f[2], row.change = f[3], row.trigger = f[4];
  row.family = f[5], row.verdict.by = f[8];
  const auto* const word = std::find(std::begin(found_words), std::end(found_words), f[6]);
  if (word == std::end(found_words)) return false;
  row.verdict.found = static_cast<Found>(word - std::begin(found_words));
  return read_number(f[7], row.verdict.cases) && read_number(f[9], row.verdict.share) &&
         read_number(f[10], row.judged);
}

}  // namespace

VerdictFile::VerdictFile(const std::string& name, const std::string& header) : name_(name) {
  if (name_.empty()) return;
  std::string text = std::filesystem::exists(name_) ? read_whole(name_) : "";
  const std::size_t whole = text.rfind('\n') == text.npos ? 0 : text.rfind('\n') + 1;
  if (whole == 0 && !header.starts_with(text))
    throw std::runtime_error(
        fmt::format("{}:1: this run needs '{}', but the file has '{}'", name_, header, text));
  text.resize(whole);
  if (text.empty()) {
    text = header + "\n";
    write_whole(name_, text);
  } else if (std::filesystem::file_size(name_) > whole) {
    write_whole(name_, text);
  }
  std::size_t number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    if (++number == 1) {
      if (line != header)
        throw std::runtime_error(
            fmt::format("{}:1: this run needs '{}', but the file has '{}'", name_, header, line));
      continue;
    }
    LatticeRow row;
    if (!read_row(line, row))
      throw std::runtime_error(fmt::format("{}:{}: this is no verdict of lattice: {}", name_, number, line));
    rows_[row.key()] = row;
  }
  file_.open(name_, std::ios::app);
  if (!file_) throw std::runtime_error(fmt::format("{}: cannot be opened for appending", name_));
}

const LatticeRow* VerdictFile::find(const std::string& key) const {
  const auto at = rows_.find(key);
  return at == rows_.end() ? nullptr : &at->second;
}

void VerdictFile::append(const LatticeRow& row) {
  if (name_.empty()) return;
  file_ << line_of(row) << std::flush;
  if (!file_) throw std::runtime_error(fmt::format("{}: cannot be written", name_));
}

}  // namespace liecheck::properties
