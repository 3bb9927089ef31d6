#include <correct/correct.hpp>

namespace liecheck::properties::correct {
namespace {

const RegisteredStyles<float> in_float;

}  // namespace
}  // namespace liecheck::properties::correct
