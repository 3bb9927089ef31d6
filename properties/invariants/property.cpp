#include <invariants/property.hpp>

#include <algorithm>

namespace liecheck::properties {

template <class S>
bool Property<S>::offers(const Subject<S>& subject, const Output& output) const {
  for (const Formed& f : statement().formed)
    if (f.quantity == output.record)
      return std::all_of(f.from.begin(), f.from.end(),
                         [&](const Operation* operation) { return has(subject, *operation); });
  return has(subject, *output.record);
}
template <class S>
bool Property<S>::offered(const Subject<S>& subject) const {
  const auto all = outputs();
  return std::any_of(all.begin(), all.end(), [&](const Output& o) { return offers(subject, o); });
}
template <class S>
std::vector<Field> Property<S>::fields() const {
  std::vector<Field> all;
  for (const ConstantField& f : statement().fields) all.push_back({f.name, f.kind, f.size, f.unit, f.reach});
  return all;
}
template <class S>
bool Property<S>::takes(std::size_t numbers) const {
  std::size_t all = 0;
  for (const Field& f : fields()) all += static_cast<std::size_t>(f.size);
  return numbers == all;
}
template <class S>
bool Property<S>::valid(const std::vector<S>& input) const {
  using std::isfinite;
  return std::all_of(input.begin(), input.end(), [](const S& x) { return isfinite(x); });
}
template class Property<float>;
template class Property<double>;
template class Property<float128>;

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
