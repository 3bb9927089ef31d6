#include <failures/calls.hpp>
#include <failures/pairs.hpp>
#include <failures/result.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <adapters/adapter.hpp>
#include <adapters/subjects.hpp>
#include <algorithm>
#include <campaign/series.hpp>
#include <conventions/probe.hpp>
#include <conventions/reference.hpp>
#include <conventions/values.hpp>
#include <operations/list.hpp>
#include <operations/quaternion_poses.hpp>
#include <operations/trees.hpp>
#include <oracles/number.hpp>
#include <oracles/orientations.hpp>
#include <span>
#include <support/text.hpp>

namespace liecheck::properties {

namespace {

using oracles::Real;

constexpr std::size_t most_numbers = 4;  ///< of a result that are printed
constexpr std::size_t most_inputs =
    40;  ///< a case of a tree has hundreds of numbers: the replay line has them

/// What is to be said where other results are right, too.
std::string others_of(const NotedCall& call, const std::vector<Real>& exact) {
  const Real near = Real(1) / 10000000;
  if (call.operation->name == "rotation_between" && abs(exact[3]) < near)
    return "    the arguments are opposite but for rounding: every unit Q with w = 0 and an axis "
           "perpendicular "
           "to them is right\n";
  if (conventions::has_order(*call.operation) && call.operation->results[0]->parts[0].name == "angles") {
    const oracles::Order order(static_cast<int>(call.arguments[0]));
    const bool proper = order.axes[0] == order.axes[2];
    if (abs(proper ? sin(exact[1]) : cos(exact[1])) < near)
      return "    at or near gimbal lock, the first and the last angle are not unique; the rotation that "
             "they give "
             "is\n";
  }
  return "";
}

/// The scalar's number nearest to x.
double nearest(const Scalar& scalar, const Real& x) {
  return scalar.is_float() ? static_cast<float>(x) : static_cast<double>(x);
}

std::string lines_of(const Scalar& scalar, std::vector<NumberPair> all) {
  const std::size_t count = all.size();
  std::erase_if(all, [&](const NumberPair& p) { return scalar.rounded(p.got) == nearest(scalar, p.exact); });
  const std::size_t apart = all.size();
  if (apart == 0) return fmt::format("    the exact result, rounded\n");
  std::ranges::stable_sort(all, std::greater(), &NumberPair::apart);
  all.resize(std::min(apart, most_numbers));
  constexpr int digits = 17;
  const auto decimal = [&](const NumberPair& p) -> std::string {
    if (std::isfinite(p.got)) return Real(p.got).str(digits);
    return std::isnan(p.got) ? "NaN" : p.got > 0 ? "inf" : "-inf";
  };
  std::size_t width = 0;
  for (const NumberPair& p : all) width = std::max({width, decimal(p).size(), p.exact.str(digits).size()});
  std::string text;
  for (const NumberPair& p : all) {
    text += std::isfinite(p.got) ? fmt::format("    {:<12}got       {:<{}}  {}\n", p.name, decimal(p), width,
                                               hexadecimal_float(scalar.rounded(p.got)))
                                 : fmt::format("    {:<12}got       {}\n", p.name, decimal(p));
    text += fmt::format("    {:<12}expected  {:<{}}  {}\n", "", p.exact.str(digits), width,
                        hexadecimal_float(nearest(scalar, p.exact)));
  }
  if (apart > all.size())
    text += fmt::format("    {} of {} numbers differ; these differ most\n", apart, count);
  else if (count > apart)
    text += fmt::format(
        "    {} agree{} to the last bit\n",
        count - apart == 1 ? "the other number" : fmt::format("the other {} numbers", count - apart),
        count - apart == 1 ? "s" : "");
  return text;
}

std::string numbers_text(const Series& series, const std::vector<double>& numbers) {
  std::vector<std::string> text;
  for (const double x : numbers) text.push_back(decimal_float(x, series.format()));
  return fmt::format("{}", fmt::join(text, ", "));
}

/// "exp6(xi)", with the arguments' numbers if they are not those of the input.
std::string call_text(const Series& series, const NotedCall& call, const std::vector<double>& input) {
  std::vector<std::string_view> names;
  for (const Layout* l : call.operation->arguments) names.push_back(l->name);
  std::string text = fmt::format("  call      {}({})", call.operation->name, fmt::join(names, ", "));
  const std::vector<double> given = given_numbers(series, call);
  const bool known = std::ranges::search(input, given).begin() != input.end();
  if (!known && given.size() <= most_inputs)
    text += fmt::format("\n            = ({})", numbers_text(series, given));
  return text + "\n";
}

/// The calls to show: at most two, those whose results are farthest from the oracle's, and none that is right beside one
/// that is wrong.
std::vector<const NotedCall*> shown(const Output& output, const NotedCase& noted) {
  std::vector<std::pair<double, const NotedCall*>> all;
  for (const NotedCall& call : noted.calls) {
    double apart = call.thrown.empty() ? 0 : std::numeric_limits<double>::infinity();
    const std::vector<Real> exact = expected_of(call);
    if (!exact.empty() && exact.size() == call.result.size())
      for (const NumberPair& p : pairs_of(output, noted, call, exact)) apart = std::max(apart, p.apart);
    all.emplace_back(apart, &call);
  }
  std::ranges::stable_sort(all, std::greater(), [](const auto& c) { return c.first; });
  const double most = all.empty() ? 0 : all.front().first;
  std::erase_if(all, [&](const auto& c) { return c.first < 1e-3 * most; });
  all.resize(std::min<std::size_t>(all.size(), 2));
  std::vector<const NotedCall*> calls;
  for (const auto& [apart, call] : all) calls.push_back(call);
  std::ranges::sort(calls);  // in the order of the calls
  return calls;
}

}  // namespace

const NotedCall* worst_call(const Output& output, const NotedCase& noted) {
  const auto calls = shown(output, noted);
  for (const NotedCall* call : calls)
    if (call->operation == output.record) return call;
  return calls.empty() ? nullptr : calls.back();
}

std::string digits_lost(double score, double eps) {
  const double all = -std::log10(eps), lost = std::log10(score);
  if (!(lost >= std::log10(2.0))) return "";
  const std::string number = fmt::format("{:.1f}", std::min(lost, all)), most = fmt::format("{:.1f}", all);
  return number == most ? fmt::format("all {} digits lost", most)
                        : fmt::format("{} of {} digits lost", number, most);
}

std::string error_text(const Judged& j) {
  const Residual& r = j.residual;
  if (r.outcome != Outcome::measured) return outcome_words[static_cast<int>(r.outcome)];
  return fmt::format("{:.4g} eps{}", r.error, r.kappa > 0 ? fmt::format(", kappa {:.3g}", r.kappa) : "");
}

std::string limit_text(const Series& series, std::size_t output, std::size_t band) {
  const Region region = series.bands()[band].region;
  const Budget& b = series.budget(output, region);
  const bool own =
      series.own && std::ranges::any_of(series.own->lines, [&](const Budget& line) {
        return replaces(line, b, region == Region::to_pi ? "to_pi" : "beyond_pi") && line.limit == b.limit;
      });
  const std::string whose = own ? "promised by " + printable(series.own->file)
                            : series.profile != Profile::ours
                                ? fmt::format("profile {}", name_of(series.profile))
                            : b.subject.empty() ? "liecheck's budget"
                                                : fmt::format("{}'s line of liecheck's budgets", b.subject);
  return fmt::format("{:g} {}, {}{}", b.limit, b.rule == Rule::forward ? "eps" : "eps kappa", whose,
                     b.reason.empty() || b.reason == whose ? "" : ": " + b.reason);
}

std::string input_text(const Series& series, const std::vector<std::string>& hexadecimal) {
  if (hexadecimal.size() > most_inputs)
    return fmt::format("  input     {} numbers, in the replay line\n", hexadecimal.size());
  std::string text;
  std::size_t from = 0;
  for (const Field& f : series.fields) {
    std::vector<std::string> decimals;
    for (int i = 0; i < f.size && from < hexadecimal.size(); ++i)
      decimals.push_back(decimal_float(parse_float(hexadecimal[from++], series.format()), series.format()));
    text += fmt::format("  {:<10}{} = {}{}\n", text.empty() ? "input" : "", f.name, fmt::join(decimals, ", "),
                        f.unit.empty() || f.unit == "1" ? "" : fmt::format("  [{}]", f.unit));
  }
  return text;
}

std::string comparison_text(const Series& series, const Output& output, const NotedCase& noted,
                            const std::vector<std::string>& input) {
  std::vector<double> given;
  for (const std::string& x : input) given.push_back(parse_float(x, series.format()));
  std::string text;
  for (const NotedCall* call : shown(output, noted)) {
    if (noted.compared.exact.empty() || !call->thrown.empty()) text += call_text(series, *call, given);
    if (!call->thrown.empty()) {
      const bool answered = call->thrown.starts_with("the adapter states");  // and with another choice
      text += fmt::format("    {}     {}\n", answered ? "but  " : "threw", printable(call->thrown));
      continue;
    }
    const std::vector<Real> exact = expected_of(*call);
    if (!exact.empty() && exact.size() == call->result.size())
      text += lines_of(series.format(), pairs_of(output, noted, *call, exact)) + others_of(*call, exact);
    else if (noted.compared.exact.empty())
      text += call->result.size() <= most_inputs
                  ? fmt::format("    got       {}\n", numbers_text(series, call->result))
                  : fmt::format("    got       {} numbers\n", call->result.size());
  }
  if (noted.compared.exact.empty()) return text;
  const std::string& seen = noted.compared.seen;
  return text +
         fmt::format("  result    {} of {}{}\n", output.record->results[0]->name, output.operation,
                     seen.empty() ? "" : " in " + seen) +
         lines_of(series.format(), pairs_of_law(output, noted.compared));
}

namespace {

/// The numbers of the result that differs most from the oracle's, those first that differ most; and whose result it is.
std::pair<std::string, std::vector<NumberPair>> compared(const Output& output, const NotedCase& noted) {
  std::pair<std::string, std::vector<NumberPair>> all;
  if (!noted.compared.exact.empty()) {
    all = {std::string(output.operation), pairs_of_law(output, noted.compared)};
  } else if (const NotedCall* call = worst_call(output, noted); call && call->thrown.empty()) {
    const std::vector<Real> exact = expected_of(*call);
    if (!exact.empty() && exact.size() == call->result.size())
      all = {std::string(call->operation->name), pairs_of(output, noted, *call, exact)};
  }
  std::ranges::stable_sort(all.second, std::greater(), &NumberPair::apart);
  return all;
}

/// "M[1,0]" of "M[0,1]".
std::string mirrored(const std::string& name) {
  const auto from = name.find('['), comma = name.find(','), to = name.find(']');
  if (to == name.npos || comma == name.npos) return name;
  return fmt::format("{}[{},{}]", name.substr(0, from), name.substr(comma + 1, to - comma - 1),
                     name.substr(from + 1, comma - from - 1));
}

/// "YZX, rotating (7)".
std::string order_text(double number) {
  const oracles::Order order(static_cast<int>(number));
  return fmt::format("{}, {} ({})", order.name(), order.rotating ? "rotating" : "static", number);
}

/// By how much the rotation of Euler angles is wrong. Empty of other operations.
std::string turned_text(const Series& series, const Output& output, const NotedCase& noted) {
  const NotedCall* const call = worst_call(output, noted);
  if (!call || output.block != "rotation" || !call->operation->name.starts_with("euler_from") ||
      call->result.size() != 3 ||
      !std::ranges::all_of(call->result, [](double x) { return std::isfinite(x); }))
    return "";
  const auto quaternion = [&](const std::vector<Real>& angles) {
    return conventions::exact_result(conventions::operation_named("euler_to_quaternion"),
                                     {Real(call->arguments[0]), angles[0], angles[1], angles[2]});
  };
  const std::vector<Real> exact = expected_of(*call);
  if (exact.size() != 3) return "";
  const std::vector<Real> a = quaternion({call->result.begin(), call->result.end()}), b = quaternion(exact);
  Real same(0), opposite(0);
  for (std::size_t i = 0; i < 4; ++i)
    same += (a[i] - b[i]) * (a[i] - b[i]), opposite += (a[i] + b[i]) * (a[i] + b[i]);
  const double wrong =
      4 * std::asin(std::min(1.0, std::sqrt(static_cast<double>(std::min(same, opposite))) / 2));
  const std::vector<double> right = {nearest(series.format(), exact[0]), nearest(series.format(), exact[1]),
                                     nearest(series.format(), exact[2])};
  return fmt::format("the rotation of the angles {} is wrong by {:.2g} rad; that of {}, for one, is right",
                     numbers_text(series, call->result), wrong, numbers_text(series, right));
}

/// " (rho, phi)": the parts of an argument, whose numbers have these places among the subject's; "" of a vector, and of a
/// matrix by rows.
std::string parts_text(const Layout& layout, std::span<const int> places) {
  std::vector<std::pair<int, std::string>> all;
  std::size_t at = 0;
  bool by_columns = false;
  for (const Part& part : layout.parts) {
    const bool columns = part.size == 9 && std::abs(places[at + 1]) != std::abs(places[at]) + 1;
    by_columns = by_columns || columns;
    if (part.size == 4)
      for (std::size_t i = 0; i < 4; ++i)
        all.emplace_back(std::abs(places[at + i]), std::string(1, "xyzw"[i]));
    else
      all.emplace_back(std::abs(places[at]), part.size == 2 && part.unit == "1" ? "cos, sin"
                                             : columns ? fmt::format("{} by columns", part.name)
                                                       : std::string(part.name));
    at += static_cast<std::size_t>(part.size);
  }
  if (all.size() == 1 && !by_columns) return "";
  std::ranges::sort(all);
  std::vector<std::string> names;
  for (auto& [place, name] : all) names.push_back(std::move(name));
  return fmt::format(" ({})", fmt::join(names, ", "));
}

/// The arguments of an operation, with " (x, y, z, w)" in the order of an adapter with these statements, or "". Throws
/// std::logic_error if the model of a robot determines the size of one.
std::vector<std::pair<Layout, std::string>> arguments_in_order(const Operation& operation,
                                                               const conventions::Statements& stated) {
  const conventions::Order order = conventions::rearranged(operation, stated).arguments;
  std::vector<std::pair<Layout, std::string>> all;
  std::span<const int> left(order);
  for (const Layout* l : operation.arguments) {
    const Layout layout = conventions::has_quaternion_poses(stated) ? with_quaternion(*l) : *l;
    all.emplace_back(layout, parts_text(layout, left));
    left = left.subspan(conventions::size_of(layout));
  }
  return all;
}

/// A number of a matrix by its place in the subject's own order. Those of other results have a name that is theirs in any order.
NumberPair in_own_order(const Series& series, std::string_view operation, NumberPair p) {
  const adapters::Description* const d = adapters::description_of(series.adapter);
  const auto at = std::ranges::find(all_operations(), operation, &Operation::name);
  if (!d || d->conventions.empty() || at == all_operations().end()) return p;
  const Part& part = (*at)->results[0]->parts[0];
  if ((*at)->results[0]->parts.size() > 1 || (part.size != 9 && part.size != 36)) return p;
  const conventions::Order order = conventions::rearranged(**at, d->conventions).result;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (conventions::number_name(part, i) != p.name) continue;
    p.name = conventions::number_name(part, static_cast<std::size_t>(std::abs(order[i]) - 1));
    if (order[i] < 0) p.got = -p.got, p.exact = -p.exact;
    break;
  }
  return p;
}

}  // namespace

ComparedResult comparison_of(const Series& series, const Output& output, const NotedCase& noted,
                             std::size_t most) {
  auto [operation, pairs] = compared(output, noted);
  ComparedResult all{operation, {}};
  pairs.resize(std::min(pairs.size(), most));
  for (const NumberPair& p : pairs)
    all.numbers.push_back({p.name,
                           std::isfinite(p.got) ? hexadecimal_float(series.format().rounded(p.got))
                           : std::isnan(p.got)  ? "nan"
                           : p.got > 0          ? "inf"
                                                : "-inf",
                           hexadecimal_float(nearest(series.format(), p.exact))});
  return all;
}

std::string worst_number_text(const Series& series, const Output& output, const NotedCase& noted) {
  if (const std::string rotation = turned_text(series, output, noted); !rotation.empty()) return rotation;
  const auto [operation, pairs] = compared(output, noted);
  if (pairs.empty()) return "";
  const NumberPair p = in_own_order(series, operation, pairs.front());
  const std::string got = std::isfinite(p.got) ? decimal_float(p.got, series.format())
                          : std::isnan(p.got)  ? "NaN"
                          : p.got > 0          ? "inf"
                                               : "-inf",
                    // -0 would not be another number
      other = decimal_float(nearest(series.format(), p.exact) + 0.0, series.format());
  if (output.operation == op::crba_symmetric.name)
    return fmt::format("{} is {}, and {} is {}", p.name, got, mirrored(p.name), other);
  if (output.operation == op::crba_columns.name)
    return fmt::format("{} is {}, and tree_rnea gives {}", p.name, got, other);
  return fmt::format("{} is {}, and {} is right", p.name, got, other);
}

std::string called_with(const Series& series, const NotedCall& call) try {
  if (call.arguments.size() > most_inputs) return "";
  const adapters::Description* const d = adapters::description_of(series.adapter);
  const conventions::Statements stated = d ? d->conventions : conventions::Statements{};
  const std::vector<double> numbers =
      conventions::given(*call.operation, stated, call.arguments, series.format().is_float());
  std::vector<std::string> all;
  auto from = numbers.begin();
  for (const auto& [layout, names] : arguments_in_order(*call.operation, stated)) {
    const auto to = from + static_cast<std::ptrdiff_t>(conventions::size_of(layout));
    all.push_back(fmt::format("{}{} = {}", layout.name, names,
                              layout.name == "order" ? order_text(*from) : numbers_text(series, {from, to})));
    from = to;
  }
  return fmt::format("{}({})", call.operation->name, fmt::join(all, "; "));
} catch (const std::logic_error&) {  // an argument whose size the model of a robot determines
  return "";
}

}  // namespace liecheck::properties
