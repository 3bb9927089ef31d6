#pragma once
// The verdict on each library, in words. Inputs that people meet weigh more
// than extreme ones: a library that fails at extreme angles alone is said to be accurate for ordinary inputs.

#include <reports/picture.hpp>
#include <string>
#include <vector>

namespace liecheck::reports {

std::vector<FirstScreen::Line> verdicts_of(const Looks& looks, const std::vector<HardCase>& cases);

/// The headline: of one library, its verdict; of several, how many have which. `word` is the verdict of all records.
std::string title_of(const std::vector<FirstScreen::Line>& all, const std::string& word);

/// Which libraries fail near 0 and near pi, and in how many operations.
std::string near_words(const Looks& looks);

}  // namespace liecheck::reports
