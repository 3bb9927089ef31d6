#include <generators/coverage.hpp>

#include <fmt/format.h>
#include <bit>
#include <boost/multiprecision/float128.hpp>
#include <charconv>

namespace liecheck::properties {

using float128 = boost::multiprecision::float128;

template <class S>
void Coverage::add(const std::vector<Field>& fields, const std::vector<S>& input) {
  if (counts_.size() < fields.size()) counts_.resize(fields.size());
  ++cases_;
  std::size_t from = 0;
  std::array<std::span<const S>, kind_count> last{};  // the last group of each kind
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const std::span<const S> x(input.data() + from, static_cast<std::size_t>(fields[f].size));
    auto& earlier = last[static_cast<std::size_t>(fields[f].kind)];
    std::uint32_t c =
        classify<S>(fields[f].kind, x, fields[f].reach == Reach::beside ? earlier : std::span<const S>());
    for (; c; c &= c - 1) ++counts_[f][static_cast<std::size_t>(std::countr_zero(c))];
    earlier = x;
    from += x.size();
  }
}

void Coverage::merge(const Coverage& o) {
  if (counts_.size() < o.counts_.size()) counts_.resize(o.counts_.size());
  cases_ += o.cases_;
  for (std::size_t f = 0; f < o.counts_.size(); ++f)
    for (std::size_t c = 0; c < o.counts_[f].size(); ++c) counts_[f][c] += o.counts_[f][c];
}

template void Coverage::add(const std::vector<Field>&, const std::vector<float>&);
template void Coverage::add(const std::vector<Field>&, const std::vector<double>&);
template void Coverage::add(const std::vector<Field>&, const std::vector<float128>&);

std::string Coverage::text() const {
  std::string all = std::to_string(cases_);
  for (const auto& field : counts_) all += fmt::format(";{}", fmt::join(field, ","));
  return all;
}

bool Coverage::parse(const std::string& text) {
  *this = {};
  const char *at = text.data(), *const end = at + text.size();
  const auto number = [&](std::uint64_t& n) {
    const auto [next, error] = std::from_chars(at, end, n);
    at = next;
    return error == std::errc();
  };
  if (!number(cases_)) return false;
  while (at != end) {
    auto& field = counts_.emplace_back();
    char separator = ';';
    for (std::uint64_t& n : field) {
      if (at == end || *at++ != separator || !number(n)) return false;
      separator = ',';
    }
  }
  return true;
}

}  // namespace liecheck::properties
