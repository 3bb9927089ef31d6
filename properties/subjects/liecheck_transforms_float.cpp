#include <subjects/liecheck_transforms.hpp>

namespace liecheck::properties {

template void LiecheckTransforms<float>::add(O&);

}  // namespace liecheck::properties
