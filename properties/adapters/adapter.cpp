#include <adapters/adapter.hpp>

namespace liecheck::properties::adapters {

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
    case Status::failed:
      break;
  }
  return why;
}

}  // namespace liecheck::properties::adapters
