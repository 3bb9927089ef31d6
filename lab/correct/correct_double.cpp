#include <correct/correct_subject.hpp>

namespace liecheck::properties::correct {
namespace {

const RegisteredStyles<double> in_double;

}  // namespace
}  // namespace liecheck::properties::correct
