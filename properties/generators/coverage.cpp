#include <generators/coverage.hpp>

#include <fmt/format.h>
#include <bit>
#include <charconv>

namespace liecheck::properties {

void Coverage::add(const std::vector<Field>& fields, const std::vector<double>& input,
                   const oracles::Scalar& scalar, MeasuredOutputs outputs) {
  Counts& counts = counts_[outputs];
  if (counts.classes.size() < fields.size()) counts.classes.resize(fields.size());
  ++counts.cases;
  scalar.with([&]<class S>() {
    const std::vector<S> numbers = oracles::numbers_in<S>(input);
    std::size_t from = 0;
    std::array<std::span<const S>, kind_count> last{};  // the last group of each kind
    for (std::size_t f = 0; f < fields.size(); ++f) {
      const std::span<const S> x(numbers.data() + from, static_cast<std::size_t>(fields[f].size));
      auto& earlier = last[static_cast<std::size_t>(fields[f].kind)];
      std::uint32_t c =
          classify<S>(fields[f].kind, x, fields[f].reach == Reach::beside ? earlier : std::span<const S>());
      for (; c; c &= c - 1) ++counts.classes[f][static_cast<std::size_t>(std::countr_zero(c))];
      earlier = x;
      from += x.size();
    }
  });
}

void Coverage::merge(const Coverage& o) {
  for (const auto& [outputs, more] : o.counts_) {
    Counts& counts = counts_[outputs];
    if (counts.classes.size() < more.classes.size()) counts.classes.resize(more.classes.size());
    counts.cases += more.cases;
    for (std::size_t f = 0; f < more.classes.size(); ++f)
      for (std::size_t c = 0; c < more.classes[f].size(); ++c) counts.classes[f][c] += more.classes[f][c];
  }
}

namespace {

/// The sum of `count` over the sets of outputs that contain the output; over all sets if `set` is null.
template <class All, class Count>
std::uint64_t sum(const All& all, Coverage::Set set, std::size_t output, Count count) {
  std::uint64_t n = 0;
  for (const auto& [outputs, counts] : all)
    if (!set || (outputs.*set >> output & 1) != 0) n += count(counts);
  return n;
}

}  // namespace

std::uint64_t Coverage::cases() const {
  return cases(nullptr, 0);
}
std::uint64_t Coverage::cases(Set set, std::size_t output) const {
  return sum(counts_, set, output, [](const Counts& n) { return n.cases; });
}
std::uint64_t Coverage::cases_outside() const {
  std::uint64_t n = 0;
  for (const auto& [outputs, counts] : counts_) n += outputs.outside ? counts.cases : 0;
  return n;
}
std::uint64_t Coverage::count(std::size_t field, std::size_t c) const {
  return count(field, c, nullptr, 0);
}
std::uint64_t Coverage::count(std::size_t field, std::size_t c, Set set, std::size_t output) const {
  return sum(counts_, set, output, [&](const Counts& n) { return n.of(field, c); });
}

std::string Coverage::text() const {
  std::string all;
  for (const auto& [outputs, counts] : counts_) {
    all += fmt::format("{}{},{},{}:{}", all.empty() ? "" : "|", outputs.measured, outputs.ill_posed,
                       outputs.outside, counts.cases);
    for (const auto& field : counts.classes) all += fmt::format(";{}", fmt::join(field, ","));
  }
  return all;
}

bool Coverage::parse(const std::string& text) {
  *this = {};
  const char *at = text.data(), *const end = at + text.size();
  const auto number = [&](auto& n) {
    const auto [next, error] = std::from_chars(at, end, n);
    at = next;
    return error == std::errc();
  };
  const auto take = [&](char separator) { return at != end && *at++ == separator; };
  while (at != end) {
    MeasuredOutputs outputs;
    if (!counts_.empty() && !take('|')) return false;
    if (!number(outputs.measured) || !take(',') || !number(outputs.ill_posed) || !take(',') ||
        !number(outputs.outside) || !take(':'))
      return false;
    if (counts_.contains(outputs)) return false;
    Counts& counts = counts_[outputs];
    if (!number(counts.cases)) return false;
    while (at != end && *at == ';') {
      char separator = ';';
      for (std::uint64_t& n : counts.classes.emplace_back()) {
        if (!take(separator) || !number(n)) return false;
        separator = ',';
      }
    }
  }
  return true;
}

}  // namespace liecheck::properties
