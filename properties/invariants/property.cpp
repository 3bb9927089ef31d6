#include <invariants/property.hpp>

#include <algorithm>

namespace liecheck::properties {

template <class S>
bool Property<S>::offered(const Subject<S>& subject) const {
  const auto all = outputs();
  return std::any_of(all.begin(), all.end(),
                     [&](const Output& o) { return subject.operations.has(*o.record); });
}
template bool Property<float>::offered(const Subject<float>&) const;
template bool Property<double>::offered(const Subject<double>&) const;
template bool Property<float128>::offered(const Subject<float128>&) const;

template <class S>
std::vector<std::unique_ptr<Property<S>>> make_properties() {
  std::vector<std::unique_ptr<Property<S>>> all;
  for (auto* make : property_makers<S>) all.push_back(make());
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a->name() < b->name(); });
  return all;
}
template std::vector<std::unique_ptr<Property<float>>> make_properties<float>();
template std::vector<std::unique_ptr<Property<double>>> make_properties<double>();
template std::vector<std::unique_ptr<Property<float128>>> make_properties<float128>();

}  // namespace liecheck::properties
