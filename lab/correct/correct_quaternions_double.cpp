#include <correct/correct_subject.hpp>

namespace liecheck::properties::correct {
namespace {

const RegisteredQuaternions<double> in_double;

}  // namespace
}  // namespace liecheck::properties::correct
