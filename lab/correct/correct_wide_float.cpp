#include <correct/correct.hpp>

namespace liecheck::properties::correct {
namespace {

const Registered<float> in_float(Correct<float, Quaternions<double>>::make("wide",
                                                                           "quaternions in more digits"));

}  // namespace
}  // namespace liecheck::properties::correct
