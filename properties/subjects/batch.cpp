// liecheck's batches. Each call fills all lanes of a SIMD register with one input and returns the result of
// the last lane. `liecheck cost` times whole batches (timing/batches.hpp).

#include <subjects/subject.hpp>

#include <liecheck/multibody/batch.hpp>
#include <liecheck/spatial/checked_rotation.hpp>

namespace liecheck::batch {  // compiled in timing/batches.cpp
extern template decltype(integrate<float>) integrate<float>;
extern template decltype(integrate<double>) integrate<double>;
extern template decltype(difference<float>) difference<float>;
extern template decltype(difference<double>) difference<double>;
}  // namespace liecheck::batch

namespace liecheck::properties {
namespace {

template <class S>
struct Batch {
  static constexpr Eigen::Index lanes = register_bytes / sizeof(S);

  template <int N>
  static batch::Rows<S, N> filled(const Vec<S, N>& v) {
    return v.array().replicate(1, lanes);
  }
  static Subject<S> make() {
    Subject<S> s{"liecheck:batch", LIECHECK_VERSION, {}};
    s.operations.check_quaternion = [](const Vec<S, 4>& Q) { checkedQuaternion<S>(Q); };
    s.operations[op::integrate] = [](const Vec<S, 7>& q, const Vec<S, 6>& d) -> Vec<S, 7> {
      return batch::integrate<S>(filled(q), filled(d)).col(lanes - 1);
    };
    s.operations[op::difference] = [](const Vec<S, 7>& q0, const Vec<S, 7>& q1) -> Vec<S, 6> {
      return batch::difference<S>(filled(q0), filled(q1)).col(lanes - 1);
    };
    return s;
  }
};

const Registered<float> in_float(Batch<float>::make());
const Registered<double> in_double(Batch<double>::make());

}  // namespace
}  // namespace liecheck::properties
