#include <correct/correct_subject.hpp>

namespace liecheck::properties::correct {
namespace {

const RegisteredMatrices<float> in_float;

}  // namespace
}  // namespace liecheck::properties::correct
