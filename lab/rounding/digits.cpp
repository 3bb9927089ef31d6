#include <rounding/digits.hpp>

#include <dlfcn.h>
#include <unistd.h>

#include <fmt/format.h>
#include <algorithm>
#include <cfenv>
#include <conventions/reference.hpp>
#include <cstdio>
#include <invariants/arguments.hpp>
#include <map>
#include <memory>
#include <numeric>
#include <operations/numbers.hpp>
#include <rounding/subjects.hpp>
#include <sstream>
#include <stdexcept>
#include <timing/inputs.hpp>

namespace liecheck::properties {

namespace {

using Numbers = std::vector<double>;
using Parts = std::vector<std::pair<std::string, std::vector<std::size_t>>>;

/// The indices of the parts of a result with `numbers` numbers. A 6 x 6 Jacobian has the parts on and beside the
/// diagonal.
Parts parts_of(const Operation& operation, std::size_t numbers) {
  Parts all;
  std::size_t from = 0;
  for (const Layout* layout : operation.results)
    for (const Part& part : layout->parts) {
      const std::size_t size = part.size < 0 ? numbers : static_cast<std::size_t>(part.size);
      std::vector<std::size_t> diagonal, rest;
      for (std::size_t i = 0; i < size; ++i) {
        const bool beside = size == 36 && (i / 6 < 3) != (i % 6 < 3);
        (beside ? rest : diagonal).push_back(from + i);
      }
      const std::string name(part.name);
      all.emplace_back(size == 36 ? name + ", diagonal" : name, diagonal);
      if (!rest.empty()) all.emplace_back(name + ", coupling", rest);
      from += size;
    }
  return all;
}

double size_of(const Numbers& x, const std::vector<std::size_t>& part) {
  double sum = 0;
  for (std::size_t i : part) sum = std::hypot(sum, x[i]);
  return sum;
}
double distance(const Numbers& x, const Numbers& y, const std::vector<std::size_t>& part) {
  double sum = 0;
  for (std::size_t i : part) sum = std::hypot(sum, x[i] - y[i]);
  return sum;
}

/// Squares of relative errors, summed over inputs.
class MeanSquare {
 public:
  void add(double error) { sum_ += error * error, ++n_; }
  /// Not more than the digits of double: an error below a rounding tells nothing.
  double digits() const {
    const double rms = std::sqrt(sum_ / double(std::max<std::size_t>(1, n_)));
    return 0 - std::log10(std::clamp(rms, 0x1p-53, 1.0));
  }
  std::size_t count() const { return n_; }

 private:
  double sum_ = 0;
  std::size_t n_ = 0;
};

/// The root mean square distance of samples from their mean, relative to the mean's size; NaN if that is 0.
double spread(const std::vector<Numbers>& samples, const std::vector<std::size_t>& part) {
  Numbers mean(samples.front().size(), 0);
  for (const Numbers& s : samples)
    for (std::size_t i : part) mean[i] += s[i] / double(samples.size());
  double sum = 0;
  for (const Numbers& s : samples) sum = std::hypot(sum, distance(s, mean, part));
  return sum / std::sqrt(double(samples.size() - 1)) / size_of(mean, part);
}

using Function = std::function<Numbers(const Numbers&)>;

/// One operation of one subject, and the inputs on which it runs, by band.
struct Tested {
  const Operation* operation = nullptr;
  Function exact;                 ///< by the oracle; empty numbers if it has none
  Function in_double, at_random;  ///< at_random is empty without a Stochastic
  std::vector<std::string> bands;
  std::function<std::vector<Numbers>(std::size_t band, const DigitsOptions&)> inputs;
};

template <class S, class F>
Function caller(F f, const Operation& operation) {
  if (!f) return nullptr;
  return [f, &operation](const Numbers& x) {
    const std::vector<S> arguments(x.begin(), x.end());
    Numbers y;
    for (const S& number : called(f, operation, arguments.data())) y.push_back(double(number));
    return y;
  };
}

const std::vector<TypedSubject<Stochastic>>& in_stochastic() {
  static const auto all = [] {
    std::vector<TypedSubject<Stochastic>> list = stochastic_textbooks();
    list.insert(list.begin(), stochastic_liecheck());
    return list;
  }();
  return all;
}

std::vector<Numbers> inputs_of(const Property& law, const Operation& operation, std::size_t band,
                               const DigitsOptions& options) {
  const std::vector<Field> fields = law.fields();
  std::vector<Numbers> all;
  for (std::size_t i = 0; i < options.inputs; ++i)
    all.push_back(FieldPositions(fields).arguments_of(
        operation,
        cost_input<double>(fields, cost_bands[band], Source({options.seed, band, i, 0x726f756e}))));
  return all;
}

/// The oracle's result; empty if there is none.
Numbers exact_result(const Operation& operation, const Numbers& x) try {
  std::vector<oracles::Real> arguments;
  for (const double number : x) arguments.push_back(oracles::exact<oracles::Real>(number));
  Numbers y;
  for (const oracles::Real& number : conventions::exact_result(operation, arguments))
    y.push_back(double(number));
  return y;
} catch (const std::exception&) {  // it is not in the oracle's list, or the oracle cannot decide
  return {};
}

const TypedSubject<double>& subject_named(const std::string& name) {
  for (const TypedSubject<double>* s : typed_subjects<double>())
    if (s->name == name) return *s;
  throw std::invalid_argument(
      fmt::format("--subject: unknown subject '{}' in double; 'liecheck list' shows them", name));
}

std::vector<Tested> tested(const std::string& name) {
  static const auto laws = make_properties(oracles::scalar_of<double>);
  const TypedSubject<double>& in_double = subject_named(name);
  const auto at_random = std::ranges::find(in_stochastic(), name, &TypedSubject<Stochastic>::name);
  std::vector<Tested> all;
  SpatialSlots<double>::for_each([&](const auto& operation) {
    const Property* const law = law_of(operation, laws);
    Tested one{&operation,
               [&operation](const Numbers& x) { return exact_result(operation, x); },
               caller<double>(in_double.operations[operation], operation),
               nullptr,
               digits_bands(),
               [law, &operation](std::size_t band, const DigitsOptions& o) {
                 return inputs_of(*law, operation, band, o);
               }};
    if (at_random != in_stochastic().end())
      one.at_random = caller<Stochastic>(at_random->operations[operation], operation);
    if (law && one.in_double && (one.at_random || at_random == in_stochastic().end())) all.push_back(one);
  });
  if (name == "liecheck")
    for (const RobotFunction& f : quadruped_functions())
      all.push_back({f.operation,
                     f.exact,
                     f.in_double,
                     f.at_random,
                     {"states of a quadruped"},
                     [](std::size_t, const DigitsOptions& o) { return quadruped_states(o.inputs, o.seed); }});
  return all;
}

std::vector<Numbers> samples_at_random(const Tested& t, const Numbers& x, std::size_t n) {
  std::vector<Numbers> all;
  for (std::size_t k = 0; k < n; ++k) all.push_back(t.at_random(x));
  return all;
}

/// One call in each rounding mode: only coarse, since all roundings of a call go one way.
std::vector<Numbers> samples_by_mode(const Tested& t, const Numbers& x) {
  std::vector<Numbers> all;
  for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    try {
      all.push_back(t.in_double(x));
    } catch (...) {
      std::fesetround(FE_TONEAREST);
      throw;
    }
  }
  std::fesetround(FE_TONEAREST);
  return all;
}

/// The sums of one part.
struct PartSums {
  MeanSquare actual, estimated, without_exemption;
};

/// Of a result that may have either sign: with that of the exact result.
Numbers signed_as(const Operation& operation, const Numbers& exact, Numbers x) {
  if (operation.results[0]->frame.find("either sign") == std::string_view::npos) return x;
  if (std::inner_product(x.begin(), x.end(), exact.begin(), 0.0) < 0)
    for (double& number : x) number = -number;
  return x;
}

void measure(const std::string& subject, const Tested& t, std::size_t band, const DigitsOptions& options,
             const std::function<void(const DigitsRow&)>& row) {
  Parts parts;
  std::vector<PartSums> sums;
  RandomRounding& rounding = RandomRounding::of_thread();
  rounding = {};
  rounding.state = 0x9e3779b97f4a7c15 ^ options.seed;
  for (const Numbers& x : t.inputs(band, options)) {
    const Numbers exact = t.exact(x);
    if (exact.empty() || (options.stop && *options.stop)) return;
    parts = parts_of(*t.operation, exact.size());
    sums.resize(parts.size());
    const auto aligned = [&](std::vector<Numbers> samples) {
      for (Numbers& s : samples) s = signed_as(*t.operation, exact, std::move(s));
      return samples;
    };
    const Numbers y = signed_as(*t.operation, exact, t.in_double(x));
    rounding.exempt = true;
    const auto samples =
        aligned(t.at_random ? samples_at_random(t, x, options.samples) : samples_by_mode(t, x));
    rounding.exempt = false;
    const auto all_random = t.at_random ? aligned(samples_at_random(t, x, options.samples)) : samples;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const auto& part = parts[p].second;
      const double size = size_of(exact, part);
      if (size == 0) continue;
      // The oracle's result is rounded to double, so that an error below 2^-53 is not seen.
      sums[p].actual.add(distance(y, exact, part) / size);
      sums[p].estimated.add(spread(samples, part));
      sums[p].without_exemption.add(spread(all_random, part));
    }
  }
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (sums[p].actual.count() > 0)
      row({subject, std::string(t.operation->name), parts[p].first, t.bands[band], sums[p].actual.count(),
           sums[p].actual.digits(), sums[p].estimated.digits(),
           t.at_random ? sums[p].without_exemption.digits() : std::nan("")});
}

/// The name of a file with its line, without its folders and what addr2line adds.
std::string file_and_line(const std::string& place) {
  const std::string name = place.substr(place.rfind('/') + 1);
  return name.substr(0, name.find(' '));
}

/// The line of each address, as addr2line of binutils finds it: the innermost one of the subject that is no
/// primitive such as mul_add.
std::map<const void*, RoundingLine> lines_of(const std::set<const void*>& sites) {
  std::map<const void*, RoundingLine> all;
  std::string command = "addr2line -C -f -i -p -e /proc/self/exe 2>&1";
  std::vector<const void*> order;
  for (const void* site : sites) {
    Dl_info info{};
    dladdr(site, &info);
    // The return address follows the call: one byte before it is inside.
    command +=
        fmt::format(" {:#x}", static_cast<const char*>(site) - static_cast<const char*>(info.dli_fbase) - 1);
    order.push_back(site);
  }
  // /proc/self would be the shell's.
  char self[4096] = {};
  if (readlink("/proc/self/exe", self, sizeof self - 1) < 0)
    throw std::runtime_error("cannot read /proc/self/exe");
  command.replace(command.find("/proc/self/exe"), 14, fmt::format("'{}'", self));
  FILE* const pipe = popen(command.c_str(), "r");
  std::string text;
  char buffer[4096];
  while (const std::size_t n = pipe ? fread(buffer, 1, sizeof buffer, pipe) : 0) text.append(buffer, n);
  if (!pipe || pclose(pipe) != 0)
    throw std::runtime_error("--where: addr2line, of the package binutils, cannot be run");
  std::istringstream lines(text);
  std::size_t at = 0;
  bool chosen = true;
  for (std::string line; std::getline(lines, line);) {
    const bool inlined = line.starts_with(" (inlined by) ");
    if (!inlined) chosen = false, ++at;
    if (chosen || at == 0 || at > order.size()) continue;
    const std::size_t in = line.rfind(" at ");
    if (in == std::string::npos) continue;
    std::string place = line.substr(in + 4);
    const std::string function = line.substr(inlined ? 14 : 0, in - (inlined ? 14 : 0));
    // Code that is not the subject's, such as a product of Eigen's that was not inlined, has its outermost line.
    all[order[at - 1]] = {file_and_line(place), function, 0};
    const bool ours =
        place.find("/lib/liecheck/") != std::string::npos || place.find("/subjects/") != std::string::npos;
    const bool primitive = place.find("/scalar/double_word.hpp") != std::string::npos ||
                           place.find("/scalar/scalar.hpp") != std::string::npos;
    if (!ours || primitive) continue;
    for (const char* root : {"/lib/liecheck/", "/subjects/"})
      if (const std::size_t here = place.find(root); here != std::string::npos)
        place = place.substr(here + 1);
    all[order[at - 1]] = {place.substr(0, place.find(' ')), function, 0}, chosen = true;
  }
  for (const void* site : order)
    if (!all.contains(site)) all[site] = {fmt::format("{}", site), "", 0};
  return all;
}

}  // namespace

std::vector<std::string> stochastic_subjects() {
  std::vector<std::string> all;
  for (const auto& s : in_stochastic()) all.push_back(s.name);
  return all;
}

std::vector<std::string> digits_bands() {
  std::vector<std::string> all;
  for (const CostBand& b : cost_bands) all.emplace_back(b.name);
  return all;
}

void check_digits(const DigitsOptions& options) {
  for (const std::string& subject : options.subjects) subject_named(subject);
  std::vector<std::string> known;
  SpatialSlots<double>::for_each([&](const auto& operation) { known.emplace_back(operation.name); });
  for (const RobotFunction& f : quadruped_functions()) known.emplace_back(f.operation->name);
  for (const std::string& name : options.operations)
    if (!std::ranges::count(known, name))
      throw std::invalid_argument(
          fmt::format("--operation: unknown operation '{}'; 'liecheck list' shows them", name));
}

void measure_digits(const DigitsOptions& options, const std::function<void(const DigitsRow&)>& row) {
  check_digits(options);
  for (const std::string& subject : options.subjects.empty() ? stochastic_subjects() : options.subjects) {
    for (const Tested& t : tested(subject)) {
      const std::string name(t.operation->name);
      if (!options.operations.empty() && std::ranges::count(options.operations, name) == 0) continue;
      for (std::size_t band = 0; band < t.bands.size(); ++band) {
        if (options.stop && *options.stop) return;
        measure(subject, t, band, options, row);
      }
    }
  }
}

std::vector<RoundingLine> rounding_lines(const DigitsOptions& options, const std::string& band) {
  check_digits(options);
  for (const Tested& t : tested(options.subjects.front())) {
    const auto named = std::ranges::find(t.bands, band);
    if (t.operation->name != options.operations.front() || !t.at_random || named == t.bands.end()) continue;
    const std::vector<Numbers> inputs = t.inputs(std::size_t(named - t.bands.begin()), options);
    RandomRounding& rounding = RandomRounding::of_thread();
    rounding = {};
    std::set<const void*> sites;
    rounding.sites = &sites;
    Parts parts;
    for (const Numbers& x : inputs) parts = parts_of(*t.operation, t.at_random(x).size());
    rounding.sites = nullptr;
    const std::map<const void*, RoundingLine> lines = lines_of(sites);
    std::map<std::string, RoundingLine> by_place;
    double total = 0;
    for (const void* site : sites) {
      if (options.stop && *options.stop) break;
      rounding.only = site;
      double variance = 0;
      for (const Numbers& x : inputs) {
        const auto samples = samples_at_random(t, x, options.samples);
        for (const auto& [name, part] : parts)
          if (const double s = spread(samples, part); std::isfinite(s)) variance += s * s;
      }
      RoundingLine& line = by_place.try_emplace(lines.at(site).place, lines.at(site)).first->second;
      line.share += variance, total += variance;
    }
    rounding = {};
    std::vector<RoundingLine> all;
    for (auto& [place, line] : by_place) line.share /= total > 0 ? total : 1, all.push_back(line);
    std::ranges::sort(all, std::greater<>(), &RoundingLine::share);
    return all;
  }
  throw std::invalid_argument(fmt::format(
      "--where: subject '{}' has no operation '{}' in band '{}' that is compiled for random rounding; "
      "bands: {}",
      options.subjects.front(), options.operations.front(), band, fmt::join(digits_bands(), ", ")));
}

}  // namespace liecheck::properties
