#include <adapters/adapter.hpp>

#include <fmt/format.h>
#include <support/text.hpp>
#include <tuple>

namespace liecheck::properties::adapters {

std::string changed(const Description& earlier, const Description& now) {
  const auto otherwise = [](const std::string& how) {
    return "the adapter was started again and describes itself otherwise: " + how;
  };
  for (const auto& [what, was, is] :
       {std::tuple("name", &earlier.name, &now.name), {"version", &earlier.version, &now.version}})
    if (*was != *is)
      return otherwise(fmt::format("its {} was '{}' and is '{}' now", what, printable(*was), printable(*is)));
  for (const auto& [operation, scalar] : earlier.offered)
    if (!now.offered.contains({operation, scalar}))
      return otherwise(fmt::format("it offered {} in {} and does not now", operation, scalar));
  return earlier.conventions == now.conventions ? "" : otherwise("it states other conventions now");
}

std::string in_words(Status status, const std::string& why) {
  switch (status) {
    case Status::done:
      return "";
    case Status::refused:
      return "the input is refused: " + (why.empty() ? "the adapter gave no reason" : why);
    case Status::argument_written:
      return "the call writes to its inputs";
    case Status::output_unwritten:
      return "the call leaves a number of its results unwritten";
    case Status::environment_changed:
      return "the call changes the rounding mode or the treatment of subnormals";
    case Status::printed:
      return "the call writes to standard output";
    case Status::not_repeatable:
    case Status::other_choice:
    case Status::failed:
      break;
  }
  return why;
}

Outcome outcome_of(Status s) {
  constexpr Outcome all[] = {Outcome::measured,
                             Outcome::refused,
                             Outcome::argument_written,
                             Outcome::output_unwritten,
                             Outcome::environment_changed,
                             Outcome::printed,
                             Outcome::not_repeatable,
                             Outcome::wrong_branch,
                             Outcome::crashed};
  return all[static_cast<std::size_t>(s)];
}

}  // namespace liecheck::properties::adapters
