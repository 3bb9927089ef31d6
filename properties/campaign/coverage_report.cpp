#include <campaign/coverage_report.hpp>

#include <fmt/format.h>
#include <algorithm>

namespace liecheck::properties {

namespace {

/// Returns n if at least one case in n falls in the band (measured). A band of a decade is wide. Narrow bands
/// are theta = pi to the last bit and the ends of the exponent range. Their cases are rarest in float128,
/// which has 16,000 binades.
std::uint64_t band_one_in(const Band& b, const std::string& scalar) {
  const bool wide = b.axis == Axis::none || (b.low > 0 && b.high / b.low < 11);
  return wide ? 1000 : scalar == "float128" ? 40000 : 4000;
}

bool has(const Series& s, Kind kind, Reach reach) {
  return std::any_of(s.fields.begin(), s.fields.end(), [&](const Field& f) {
    return f.kind == kind && (reach == Reach::limited || f.reach == reach);
  });
}

}  // namespace

std::vector<Covered> coverage_of(const Series& series, const Tally& tally) {
  std::vector<Covered> all;
  const std::uint64_t n = tally.coverage.cases() + tally.excluded.cases();
  const auto add = [&](std::string what, std::uint64_t count, std::uint64_t excluded, std::uint64_t one_in) {
    all.push_back({std::move(what), count, excluded, one_in, n / one_in >= expected_at_least});
  };
  for (std::size_t f = 0; f < series.fields.size(); ++f) {
    const auto& classes = classes_of(series.fields[f].kind);
    for (std::size_t c = 0; c < classes.size(); ++c)
      if (requires_class(series.fields[f], classes[c]))
        add(fmt::format("{}: {}", series.fields[f].name, classes[c].name), tally.coverage.count(f, c),
            tally.excluded.count(f, c), classes[c].one_in);
  }
  std::vector<std::uint64_t> bands(series.bands().all().size(), 0), excluded = bands;
  for (const auto& [key, row] : tally.rows) {
    const auto band = static_cast<std::size_t>(key.second);
    if (band == 0) continue;
    bands[band] = std::max(bands[band], row.inside());
    excluded[band] = std::max(excluded[band], row.outside_domain);
  }
  const bool beyond = has(series, Kind::rotation_vector, Reach::full);
  const bool angles = beyond || has(series, Kind::rotation_vector, Reach::limited) ||
                      has(series, Kind::quaternion, Reach::limited);
  // A law whose results depend on no angle, such as power_pairing, has only rows of band 0.
  if (angles && std::any_of(bands.begin(), bands.end(), [](auto count) { return count > 0; }))
    for (std::size_t b = 1; b < bands.size(); ++b)
      if (beyond || series.bands()[b].region == Region::to_pi)
        add("band " + series.bands()[b].name, bands[b], excluded[b],
            band_one_in(series.bands()[b], series.scalar));
  return all;
}

std::string coverage_line(const std::vector<Covered>& all, const Tally& tally) {
  const std::uint64_t outside = tally.excluded.cases(), cases = tally.coverage.cases() + outside;
  std::uint64_t reached = 0, expected = 0, given_up = 0;
  std::string missing;
  for (const Covered& c : all) {
    reached += c.count > 0, expected += c.required, given_up += c.count == 0 && c.excluded > 0;
    if (c.missing())
      missing +=
          fmt::format("{}{} (at least {} expected)", missing.empty() ? "" : "; ", c.what, cases / c.one_in);
  }
  const std::string domain =
      outside == 0 && given_up == 0
          ? ""
          : fmt::format("; {} of {} cases and {} whole classes and bands are outside the subject's domain",
                        outside, cases, given_up);
  if (!missing.empty()) return "NOT COVERED in " + std::to_string(cases) + " cases: " + missing + domain;
  return fmt::format("{} of {} classes and bands reached, {} required for so many cases{}", reached,
                     all.size(), expected, domain);
}

}  // namespace liecheck::properties
