#include <campaign/coverage_report.hpp>

#include <fmt/format.h>
#include <algorithm>

namespace liecheck::properties {

namespace {

/// Returns n if at least one case in n falls in the band (measured). A band of a decade is wide. Narrow bands
/// are theta = pi to the last bit and the ends of the exponent range.
std::uint64_t band_one_in(const Band& b) {
  const bool wide = b.axis == Axis::none || (b.low > 0 && b.high / b.low < 11);
  return wide ? 1000 : 4000;
}

bool has(const Series& s, Kind kind, Reach reach) {
  return std::any_of(s.fields.begin(), s.fields.end(), [&](const Field& f) {
    return f.kind == kind && (reach == Reach::limited || f.reach == reach);
  });
}

/// Whether the operation takes a rotation vector, which may be beyond pi. A logarithm is not.
bool takes_rotation_vector(const Operation& o) {
  return std::any_of(o.arguments.begin(), o.arguments.end(), [](const Layout* l) {
    return std::any_of(l->parts.begin(), l->parts.end(),
                       [](const Part& p) { return p.name == "phi" || p.name == "delta"; });
  });
}

std::string name_of(const Output& o) {
  return fmt::format("{}, {}", o.operation, o.block);
}

/// f(i) for each output that every case must record.
template <class F>
void for_each_due(const Series& series, F f) {
  for (std::size_t i = 0; i < series.outputs.size(); ++i)
    if (series.due >> i & 1) f(i);
}

/// The output that was measured least in a class or band.
class Least {
 public:
  Least(std::string what, std::uint64_t one_in) { covered_.what = std::move(what), covered_.one_in = one_in; }
  /// `cases` is the number of cases that measured the output anywhere.
  void add(const Output& o, std::uint64_t measured, std::uint64_t ill_posed, std::uint64_t outside,
           std::uint64_t cases) {
    if (measured == 0 && outside > 0) {
      outside_ = {covered_.what, name_of(o), 0, covered_.one_in, false, true};
      return;
    }
    if (measured == 0 && ill_posed > 0) {
      ill_posed_ = {covered_.what, name_of(o), 0, covered_.one_in,
                    cases / covered_.one_in >= expected_at_least};
      return;
    }
    const Covered c{covered_.what, name_of(o), measured, covered_.one_in,
                    cases / covered_.one_in >= expected_at_least};
    const bool less = c.missing() != covered_.missing() ? c.missing() : measured < covered_.count;
    if (covered_.output.empty() || less) covered_ = c;
  }
  Covered result() const {
    if (!covered_.output.empty()) return covered_;
    return !ill_posed_.output.empty() ? ill_posed_ : !outside_.output.empty() ? outside_ : covered_;
  }

 private:
  Covered covered_, ill_posed_, outside_;
};

/// The bands of one series that its outputs must reach.
void add_bands(const Series& series, const Tally& tally, std::vector<Covered>& all) {
  const bool beyond = has(series, Kind::rotation_vector, Reach::full);
  if (!beyond && !has(series, Kind::rotation_vector, Reach::limited) &&
      !has(series, Kind::quaternion, Reach::limited))
    return;
  // Outputs that depend on no angle, such as the power in two frames, have only rows of band 0.
  std::uint32_t by_angle = 0;
  for (const auto& [cell, row] : tally.rows)
    if (cell.second > 0) by_angle |= 1u << cell.first;
  for (std::size_t b = 1; by_angle && b < series.bands().all().size(); ++b) {
    const Band& band = series.bands()[b];
    Least least("band " + band.name, band_one_in(band));
    bool reached = false;
    for_each_due(series, [&](std::size_t i) {
      const Output& o = series.outputs[i];
      if (!(by_angle >> i & 1)) return;
      if (band.region == Region::beyond_pi && !(beyond && takes_rotation_vector(*o.record))) return;
      reached = true;
      const auto row = tally.rows.find({static_cast<int>(i), static_cast<int>(b)});
      const bool none = row == tally.rows.end();
      least.add(o, none ? 0 : row->second.judged(), none ? 0 : row->second.ill_posed,
                none ? 0 : row->second.outside_domain, tally.coverage.cases(&MeasuredOutputs::measured, i));
    });
    if (reached) all.push_back(least.result());
  }
}

}  // namespace

std::vector<Covered> coverage_of(const Series& series, const Tally& tally) {
  std::vector<Covered> all;
  constexpr auto measured = &MeasuredOutputs::measured, ill_posed = &MeasuredOutputs::ill_posed,
                 outside = &MeasuredOutputs::outside;
  for (std::size_t f = 0; f < series.fields.size(); ++f) {
    const auto& classes = classes_of(series.fields[f].kind);
    for (std::size_t c = 0; c < classes.size(); ++c) {
      if (!requires_class(series.fields[f], classes[c])) continue;
      Least least(fmt::format("{}: {}", series.fields[f].name, classes[c].name), classes[c].one_in);
      for_each_due(series, [&](std::size_t i) {
        least.add(series.outputs[i], tally.coverage.count(f, c, measured, i),
                  tally.coverage.count(f, c, ill_posed, i), tally.coverage.count(f, c, outside, i),
                  tally.coverage.cases(measured, i));
      });
      all.push_back(least.result());
    }
  }
  add_bands(series, tally, all);
  return all;
}

std::vector<std::string> not_measured(const Series& series, const Tally& tally) {
  std::vector<std::string> all;
  if (series.due == 0) all.emplace_back("the subject offers no output of the law");
  std::uint64_t accepted = 0;  // cases that a limits file expects to end without a result
  for (const auto& [cell, r] : tally.rows)
    if (series.expected(static_cast<std::size_t>(cell.first), static_cast<std::size_t>(cell.second)))
      accepted += r.crashed + r.refused + r.not_repeatable;
  for_each_due(series, [&](std::size_t i) {
    const Output& o = series.outputs[i];
    std::uint64_t unresolved = 0, unmeasured = 0;
    for (const auto& [cell, row] : tally.rows)
      if (cell.first == static_cast<int>(i)) unresolved += row.unresolved, unmeasured += row.unmeasured;
    if (unmeasured > accepted)
      all.push_back(fmt::format("{}: not recorded in {} cases", name_of(o), unmeasured));
    if (unresolved) all.push_back(fmt::format("{}: {} unresolved", name_of(o), unresolved));
    const std::uint64_t outside = tally.coverage.cases(&MeasuredOutputs::outside, i),
                        n = tally.cases - outside,
                        measured = tally.coverage.cases(&MeasuredOutputs::measured, i);
    const bool few = n / measured_one_in >= expected_at_least && measured < n / measured_one_in;
    // So few cases of a long campaign are no verdict, whatever excludes the others.
    const bool too_few = tally.cases / measured_one_in >= expected_at_least && measured < expected_at_least;
    // The user says that the operation refuses every input, as it may.
    if (n == 0 && series.expected(i, 0)) return;
    if (measured == 0 || few || too_few)
      all.push_back(fmt::format(
          "{}: measured in {} of {} cases{}{}", name_of(o), measured, n,
          outside ? fmt::format(", {} more are outside the domain", outside) : "",
          n == 0
              ? fmt::format("; if that is meant, a limits file says so below [expected]: {}, {}, any = WHY, "
                            "LINK",
                            o.operation, o.block)
              : ""));
  });
  for (const Covered& c : coverage_of(series, tally))
    if (c.missing() && c.count + accepted < tally.cases / c.one_in)
      all.push_back(fmt::format("{}: {} not measured in it, at least {} expected", c.what, c.output,
                                tally.cases / c.one_in));
  return all;
}

std::string coverage_line(const std::vector<Covered>& all, const Tally& tally) {
  const std::uint64_t outside = tally.coverage.cases_outside(), cases = tally.coverage.cases();
  std::uint64_t reached = 0, expected = 0, given_up = 0;
  std::string missing;
  for (const Covered& c : all) {
    reached += c.count > 0, expected += c.required, given_up += c.outside_domain;
    if (c.missing())
      missing +=
          fmt::format("{}{} (at least {} expected)", missing.empty() ? "" : "; ", c.what, cases / c.one_in);
  }
  const std::string domain =
      outside
          ? fmt::format("; {} of {} cases and {} whole classes and bands are outside the subject's domain",
                        outside, cases, given_up)
          : "";
  if (!missing.empty()) return "NOT COVERED in " + std::to_string(cases) + " cases: " + missing + domain;
  return fmt::format("{} of {} classes and bands measured, {} required for so many cases{}", reached,
                     all.size() - given_up, expected, domain);
}

}  // namespace liecheck::properties
