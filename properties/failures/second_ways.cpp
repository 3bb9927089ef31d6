#include <failures/second_ways.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <failures/calls.hpp>
#include <failures/result.hpp>
#include <map>
#include <search/plain.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

constexpr std::size_t most_lines = 3;
constexpr std::uint64_t least = 3;  ///< failing cases: fewer may be rounding next to a limit

/// The block with the bands for which `fails` is true; its worst band is null if there are none.
template <class Fails>
FailedBlock part_of(const FailedBlock& f, const Fails& fails) {
  FailedBlock part;
  part.subject = f.subject, part.scalar = f.scalar, part.operation = f.operation, part.block = f.block;
  part.bands = f.bands;
  for (BandOf& b : part.bands) b.fails = b.band > 0 && fails(b);
  find_worst(part);
  return part;
}

bool is_huge(const BandOf& b) {
  const Band& band = b.series->bands()[b.band];
  return band.region == Region::beyond_pi && band.low >= 100;
}

/// Whether the worst case of a band, without an outcome in place of an error, passes in another block, which loses a tenth of the
/// error there at most. False if its law does not measure that block.
bool passes_in(const FailedBlock& other, const BandOf& b, std::uint64_t seed) try {
  if (!b.fails || !worst_outcome(*b.row).empty() || stop_requested) return false;
  const auto judged = b.series->measure(b.series->numbers(b.series->id(seed, b.row->worst_index)));
  const double error = std::min(b.row->worst_score, 1 / b.series->eps);
  return std::ranges::any_of(judged, [&](const Judged& j) {
    const Output& o = b.series->outputs.at(static_cast<std::size_t>(j.residual.output));
    return o.operation == other.operation && o.block == other.block && !j.failed &&
           j.residual.outcome == Outcome::measured && 10 * score_of(*b.series, j) < error;
  });
} catch (const GivenUp&) {
  return false;
}

/// The bands of another block of an operation of which the cause of `first` explains nothing: far more cases fail there, or the
/// worst one passes in `first`.
FailedBlock beside_another(const FailedBlock& f, const FailedBlock& first, std::uint64_t seed) {
  std::map<std::size_t, std::uint64_t> failed;
  for (const BandOf& b : first.bands) failed[b.band] += b.row->failed;
  return part_of(f, [&](const BandOf& b) {
    return b.fails && (b.row->failed > 2 * failed[b.band] + least || passes_in(first, b, seed));
  });
}

/// The lines of a part, with an example; "" if no input fails alone.
std::string lines_of(const FailedBlock& part, const std::string& name, bool of_outcome,
                     const CampaignResult& campaign, std::uint64_t fewest = least) try {
  if (!part.worst || part.failed < fewest || part.block == "sign") return "";
  // The outcome of a band may be rarer than its errors, so the example is of the band in which it is most frequent.
  const BandOf* most = part.worst;
  for (const BandOf& b : part.bands)
    if (b.fails && b.row->failed > most->row->failed) most = &b;
  const Series& series = *most->series;
  const auto output = static_cast<int>(most->output);
  const CaseId worst = series.id(campaign.options.seed, most->row->worst_index);
  std::vector<BandOfFailure> bands;
  for (const BandOf& b : part.bands)
    if (b.fails && b.series == most->series && b.output == most->output)
      bands.push_back({b.band, score_of(b), is_ordinary(b.series->bands()[b.band])});
  std::optional<Shrunk> s =
      plain_failure(series, worst, output, bands, !of_outcome && worst_outcome(*most->row).empty());
  if (!s) s = shrink(series, worst, output, 500);
  if (!s->reproduced) return "";
  // A simpler input may fail for the reason that the finding tells already.
  if (std::ranges::find(bands, s->judged.residual.band, &BandOfFailure::band) == bands.end()) {
    const std::vector<double> x = series.numbers(worst);
    const auto judged = series.measure(x);
    const auto own = std::ranges::find_if(
        judged, [&](const Judged& j) { return j.failed && j.residual.output == output; });
    if (own == judged.end()) return "";
    s = case_with(series, worst, x, *own);
  }
  const NotedCase all = noted(series, s->id, most->output);
  const Output& of = series.outputs.at(most->output);
  const NotedCall* const call = worst_call(of, all);
  const std::string called = call ? called_with(series, *call) : "",
                    number =
                        call && !call->thrown.empty() ? call->thrown : worst_number_text(series, of, all);
  std::string what = worst_outcome(*most->row, of_outcome);
  if (what.empty()) what = digits_lost(part.score, series.eps);
  if (called.empty() || number.empty() || what.empty()) return "";
  const double score = score_of(series, s->judged);
  const bool less =
      s->judged.residual.outcome == Outcome::measured && 10 * score < std::min(part.score, 1 / series.eps);
  const std::string where = where_of(part);
  const bool several = where.find(", ") != where.npos && worst_outcome(*most->row, of_outcome).empty();
  return fmt::format("   also     {}{}{}, {}: {}\n            {}{}\n", name, what, several ? " at worst" : "",
                     where, called, number, less ? ": " + digits_lost(score, series.eps) : "");
} catch (const GivenUp&) {
  return "";
}

}  // namespace

SecondWays second_ways(const Finding& finding, const CampaignResult& campaign) {
  const FailedBlock& first = *finding.own.front();
  SecondWays ways;
  std::vector<std::string> named;
  const auto add = [&](const FailedBlock& part, const std::string& name, bool of_outcome = false,
                       std::uint64_t fewest = least) {
    if (std::ranges::find(named, name) != named.end() || named.size() >= most_lines) return false;
    const std::string lines = lines_of(part, name.empty() ? "" : name + ": ", of_outcome, campaign, fewest);
    if (lines.empty()) return false;
    ways.text += lines, named.push_back(name);
    return true;
  };
  const bool has_error = worst_outcome(*first.worst->row).empty();
  if (first.worst->band > 0 &&
      !add(part_of(first, [&](const BandOf& b) { return fails_otherwise(first, b); }), ""))
    add(part_of(first, [&](const BandOf& b) { return b.fails && has_error && b.row->not_finite > 0; }), "",
        true);
  // Formulas that cancel at small angles do so at huge ones for another reason.
  const bool between = std::ranges::any_of(first.bands, [](const BandOf& b) {
    return b.fails && b.series->bands()[b.band].axis != Axis::theta && !is_huge(b);
  });
  const bool small = std::ranges::any_of(
      first.bands, [](const BandOf& b) { return b.fails && b.series->bands()[b.band].axis == Axis::theta; });
  if (small && !between)
    add(part_of(first, [](const BandOf& b) { return b.fails && is_huge(b); }), "at other angles");
  const auto count = [](const FailedBlock& f) {
    return std::ranges::count_if(f.bands, [](const BandOf& b) { return b.band > 0 && b.fails; });
  };
  for (const FailedBlock* f : finding.own) {
    if (f->operation != first.operation || f->scalar != first.scalar || f->block == first.block ||
        f->block == "jump")
      continue;
    const FailedBlock part = beside_another(*f, first, campaign.options.seed);
    if (add(part, f->block, false, 1) && count(part) == count(*f)) ways.apart.insert(f->block);
  }
  for (const Beside& beside : finding.beside)
    if (beside.block->scalar == first.scalar)
      add(part_of(*beside.block, [&](const BandOf& b) { return beside.bands.contains(b.band); }),
          beside.block->operation, beside.of_outcome);
  return ways;
}

}  // namespace liecheck::properties
