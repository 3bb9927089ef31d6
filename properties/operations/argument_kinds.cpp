#include <operations/argument_kinds.hpp>

namespace liecheck::properties {
namespace {

int place_in(std::initializer_list<double> list, double x) {
  int k = 0;
  for (const double y : list) {
    if (x == y) break;
    ++k;
  }
  return k;
}
int order_of(std::span<const double> x) {
  return x[0] >= 0 && x[0] < 24 && x[0] == static_cast<int>(x[0]) ? static_cast<int>(x[0]) : -1;
}
int fraction_of(std::span<const double> x) {
  return place_in({0, 0.5, 1}, x[0]);
}
int axis_of(std::span<const double> x) {
  for (int i = 0; i < 3; ++i)
    if (x[static_cast<std::size_t>(i)] == 1 && x[0] * x[0] + x[1] * x[1] + x[2] * x[2] == 1) return i;
  return 3;
}

}  // namespace

const ArgumentKinds order_kinds{
    "order", 24, order_of, [](int k) { return std::vector<double>{static_cast<double>(k)}; }, {}};
const ArgumentKinds fraction_kinds{"t",
                                   4,
                                   fraction_of,
                                   [](int k) {
                                     constexpr double examples[] = {0, 0.5, 1, 0.3125};
                                     return std::vector<double>{examples[k]};
                                   },
                                   {"0", "1/2", "1", "any other number"}};
const ArgumentKinds axis_kinds{"axis",
                               4,
                               axis_of,
                               [](int k) {
                                 std::vector<double> axis{0.48, -0.6, 0.64};
                                 if (k < 3) axis.assign(3, 0), axis[static_cast<std::size_t>(k)] = 1;
                                 return axis;
                               },
                               {"x", "y", "z", "any other axis"}};

const ArgumentKinds* argument_kinds(const Operation& operation, std::size_t& first) {
  first = 0;
  for (const Layout* l : operation.arguments)
    for (const Part& part : l->parts) {
      for (const ArgumentKinds* kinds : {&order_kinds, &fraction_kinds, &axis_kinds})
        if (part.name == kinds->part) return kinds;
      first += static_cast<std::size_t>(part.size);
    }
  return nullptr;
}

std::string text_of(const ArgumentKinds& kinds, const char* plural, std::uint32_t taken) {
  if (taken == kinds.every()) return "";
  std::string text = plural;
  for (int k = 0; k < kinds.count; ++k)
    if (taken >> k & 1) text += "_" + std::to_string(k);
  return text;
}

}  // namespace liecheck::properties
