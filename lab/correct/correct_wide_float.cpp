#include <correct/correct_subject.hpp>

namespace liecheck::properties::correct {
namespace {

const Registered<float> in_float(
    CorrectSubject<float, Quaternions<double>>::make("wide", "quaternions in more digits"));

}  // namespace
}  // namespace liecheck::properties::correct
