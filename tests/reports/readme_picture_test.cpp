// The picture of README.md is what the tree shows today. To draw it anew:
// LIECHECK_WRITE_PICTURES=1 build/release/bin/house_tests --gtest_filter='ReadmePicture.*'

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <reports/picture.hpp>
#include <support/files.hpp>
#include <support/read_json.hpp>

#include "../scratch.hpp"
#include "../shell.hpp"

namespace liecheck::properties {
namespace {

/// The first words of two pictures that differ, or "". Numbers may differ by 3 and 2 %: another processor's mathematical
/// functions move a worst error by a fraction of a digit, which is 11 px, and the number of failures by a few.
std::string picture_difference(const std::string& a, const std::string& b) {
  static const std::regex word("[0-9]+(\\.[0-9]+)?|[^0-9]");
  std::sregex_iterator i(a.begin(), a.end(), word), j(b.begin(), b.end(), word), end;
  for (; i != end && j != end; ++i, ++j) {
    const std::string was = i->str(), is = j->str();
    const bool numbers =
        std::isdigit(static_cast<unsigned char>(was[0])) && std::isdigit(static_cast<unsigned char>(is[0]));
    if (numbers ? std::abs(std::stod(was) - std::stod(is)) > 3 + .02 * std::stod(was) : was != is)
      return "'" + a.substr(static_cast<std::size_t>(i->position()), 60) + "', and '" +
             b.substr(static_cast<std::size_t>(j->position()), 60) + "'";
  }
  return (i == end) == (j == end) ? "" : "one picture ends before the other";
}

/// The line with the digest of the inputs, which is the same on every machine.
std::string picture_inputs(const std::string& picture) {
  const auto from = picture.find("<desc>");
  return picture.substr(from, picture.find("</desc>") - from);
}

TEST(ReadmePicture, IsAsNewAsTheTree) {
  const std::filesystem::path folder = own_folder();
  const std::string file = (folder / "record.json").string(),
                    picture = LIECHECK_SOURCE_DIR "/docs/images/first_screen.svg";
  if (!std::filesystem::exists(LIECHECK_PROGRAM)) GTEST_SKIP() << "liecheck is not built";
  const Answer run =
      shell(fmt::format("'{}' campaign --subject liecheck --subject eigen --subject ceres --subject textbook "
                        "--property exp_oracle "
                        "--property log_oracle --cases 500 --json '{}'",
                        LIECHECK_PROGRAM, file));
  ASSERT_EQ(run.code, 1) << run.text;
  auto record = read_json(file);
  if (!record["absent"].empty() && dumped(record["absent"]).find("ceres") != std::string::npos)
    GTEST_SKIP() << "Ceres, which the picture shows, is absent";
  record["cost"] = read_json(LIECHECK_SOURCE_DIR "/fixtures/report/times.json");
  write_whole(file, dumped(record));
  const std::string drawn = reports::first_picture(reports::merge_records({file}));
  if (std::getenv("LIECHECK_WRITE_PICTURES")) write_whole(picture, drawn);
  const std::string stored = read_whole(picture);
  EXPECT_EQ(picture_inputs(stored), picture_inputs(drawn));
  EXPECT_EQ(picture_difference(stored, drawn), "") << "draw it anew, as the head of this file says";
}

TEST(ReadmePicture, IsOldIfAWordOrANumberDiffers) {
  EXPECT_EQ(picture_difference("M10 20: 387 of 989", "M10 20.5: 388 of 989"), "");
  EXPECT_NE(picture_difference("M10 20: 387 of 989", "M10 20: 487 of 989"), "");
  EXPECT_NE(picture_difference("eigen 3", "ceres 3"), "");
  EXPECT_NE(picture_difference("eigen 3", "eigen 3 4"), "");
}

}  // namespace
}  // namespace liecheck::properties
