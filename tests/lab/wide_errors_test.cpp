// Two ways of computing the errors of an operation.

#include <gtest/gtest.h>

#include <algorithm>
#include <timing/rows.hpp>
#include <timing/score.hpp>
#include <wide/wide_errors.hpp>

#include "../own_subject.hpp"

namespace {

using namespace liecheck::properties;

/// What a Signature of a wide scalar has.
template <class R, class... A>
void call(R (*function)(const A&...), const char* arguments, WideNumbers& in, WideNumbers& out) {
  liecheck::properties::timing_detail::Passes<double, R, A...>::call(reinterpret_cast<AnyFunction>(function),
                                                                     arguments, in, out);
}

/// Compares the errors that each operation's law measures with errors from the closed forms at 100 digits.
TEST(WideErrors, AgreeWithTheLawsInDouble) {
  const TypedSubject<double>& subject = own_subject();
  const auto laws = make_properties(liecheck::oracles::scalar_of<double>);
  SpatialSlots<double>::for_each([&](const auto& operation) {
    const std::string name(operation.name);
    const auto function = subject.operations[operation];
    const Property* law = law_of(operation, laws);
    ASSERT_TRUE(law && function) << name;
    TypedSubject<double> only;
    only.operations.take(operation, subject.operations);
    const Signature signature = signature_of<double>(function);
    const auto fields = law->fields();
    const auto inputs = cost_inputs<double>(fields, CostOptions(), 4);
    const auto blocks = score(*law, operation, erased(only), inputs);
    std::vector<BlockErrors> wide;
    for (const auto& x : inputs) {
      WideNumbers in, out;
      const auto arguments = signature.arguments({FieldPositions(fields).arguments_of(operation, x)});
      call(function, arguments.get(), in, out);
      add_wide_errors(wide, operation, 0x1p-52, in, out);
    }
    EXPECT_FALSE(wide.empty()) << name;
    for (const BlockErrors& w : wide) {
      const auto found =
          std::find_if(blocks.begin(), blocks.end(), [&](auto& b) { return b.block == w.block; });
      ASSERT_NE(found, blocks.end()) << name << " " << w.block;
      ASSERT_EQ(found->errors.size(), w.errors.size()) << name << " " << w.block;
      const bool matrix = w.block == "rotation" && name != "integrate" &&
                          (name.find("quaternion") == std::string::npos || name.starts_with("matrix_from"));
      for (std::size_t i = 0; i < w.errors.size(); ++i) {
        // Here the error of a rotation matrix includes its non-orthogonality, at most a few eps.
        const double slack = matrix ? 4 : 1e-6 * std::max(1.0, w.errors[i]);
        EXPECT_NEAR(found->errors[i], w.errors[i], slack) << name << " " << w.block << " " << i;
      }
    }
  });
}

}  // namespace
