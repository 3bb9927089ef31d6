#include <wide/tiers.hpp>

namespace liecheck::properties {

template AddTier add_tier<Digits50>;
template AddTier add_tier<Digits100>;

}  // namespace liecheck::properties
