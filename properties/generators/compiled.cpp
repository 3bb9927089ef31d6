#include <boost/multiprecision/float128.hpp>
#include <generators/rotations.hpp>
#include <tuple>

namespace liecheck::properties {

/// Instantiates what compiled.hpp declares: it takes the addresses.
template <class S>
struct Compiled {
  static constexpr std::tuple all{&angle<S>, &direction<S>, &vector3<S>, &unit_quaternion<S>,
                                  &rotation_matrix<S>};
};
template struct Compiled<float>;
template struct Compiled<double>;
template struct Compiled<boost::multiprecision::float128>;

}  // namespace liecheck::properties
