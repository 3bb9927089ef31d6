#include <liecheck/scene_file/csv_table.hpp>

#include <algorithm>
#include <liecheck/multibody/nearest_names.hpp>
#include <liecheck/scene_file/units.hpp>
#include <liecheck/text/text_file.hpp>
#include <liecheck/text/utf8.hpp>
#include <stdexcept>

namespace liecheck::scene_file_detail {
namespace {

constexpr std::size_t max_csv_bytes = std::size_t(1) << 26;

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\""), end = text.find_last_not_of(" \t\r\"");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

/// The parts of text between separators, without spaces and quotation marks at their ends.
std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> all;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    all.push_back(trimmed(text.substr(at, end - at)));
    at = end + 1;
  }
  return all;
}

class Reader {
 public:
  Reader(const std::string& path, const std::string& unit) : path_(path), unit_(unit) {}

  CsvTable read(const CsvChoice& choice) {
    std::string text;
    try {
      text = readTextFile(path_, max_csv_bytes);
    } catch (const FileError& e) {
      throw std::invalid_argument(path_ + ": " + e.what());
    }
    if (text.size() > max_csv_bytes)
      throw std::invalid_argument(path_ + ": is longer than " + std::to_string(max_csv_bytes) + " bytes");
    for (const std::string& line : split(std::string(withoutByteOrderMark(text)), '\n')) {
      ++line_;
      if (line.empty()) continue;
      const std::vector<std::string> cells = split(line, ',');
      if (names_.empty() && begin(cells, choice)) continue;
      if (cells.size() != names_.size())
        refuse("has " + std::to_string(cells.size()) + " columns, and the first line has " +
               std::to_string(names_.size()));
      addRow(cells);
    }
    if (table_.numbers.empty()) throw std::invalid_argument(path_ + ": has no row of numbers");
    return std::move(table_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw std::invalid_argument(path_ + ":" + std::to_string(line_) + ": " + what);
  }
  /// Reads the names of the columns, if the line has them, and chooses columns. True if it has names.
  bool begin(const std::vector<std::string>& cells, const CsvChoice& choice) {
    const bool named =
        std::string("+-.0123456789").find(cells[0].empty() ? 'x' : cells[0][0]) == std::string::npos;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::size_t bracket = named && cells[i].ends_with(']') ? cells[i].rfind(" [") : std::string::npos;
      names_.push_back(named ? cells[i].substr(0, bracket) : std::to_string(i + 1));
      units_.push_back(
          bracket == std::string::npos ? "" : cells[i].substr(bracket + 2, cells[i].size() - bracket - 3));
    }
    chosen_ = {column(choice.time)};
    if (choice.columns) {
      for (const std::string& name : *choice.columns) chosen_.push_back(column(name));
    } else {
      for (std::size_t i = 0; i < names_.size(); ++i)
        if (i != chosen_[0]) chosen_.push_back(i);
    }
    if (chosen_.size() < 2) refuse("has no column besides the time");
    table_.width = chosen_.size();
    return named;
  }
  std::size_t column(const std::string& name) const {
    const auto found = std::ranges::find(names_, name);
    if (found != names_.end()) return std::size_t(found - names_.begin());
    for (std::size_t i = 0; i < names_.size(); ++i)
      if (name == std::to_string(i + 1)) return i;
    refuse("has no column '" + name + "'" + multibody_detail::nearestNames(name, names_));
  }
  void addRow(const std::vector<std::string>& cells) {
    for (std::size_t k = 0; k < chosen_.size(); ++k) {
      const std::size_t i = chosen_[k];
      const std::string unit = units_[i].empty() || units_[i] == "1" ? "" : " " + units_[i];
      try {
        table_.numbers.push_back(parseQuantity(cells[i] + unit, k == 0 ? "s" : unit_));
      } catch (const std::invalid_argument& e) {
        refuse("column '" + names_[i] + "': " + e.what());
      }
    }
    const std::size_t at = table_.numbers.size() - table_.width;
    if (at > 0 && !(table_.numbers[at] >= table_.numbers[at - table_.width]))
      refuse("the time '" + cells[chosen_[0]] +
             "' is before the time before it: write the rows in the order of their times, and two rows with "
             "one time "
             "for a jump");
  }

  const std::string &path_, &unit_;
  int line_ = 0;
  std::vector<std::string> names_, units_;
  std::vector<std::size_t> chosen_;
  CsvTable table_;
};

}  // namespace

CsvTable readCsvTable(const std::string& path, const CsvChoice& choice, const std::string& unit) {
  return Reader(path, unit).read(choice);
}

}  // namespace liecheck::scene_file_detail
