#include <subjects/liecheck_transforms.hpp>

namespace liecheck::properties {

template void LiecheckTransforms<double>::add(O&);

}  // namespace liecheck::properties
