#include <failures/second_ways.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <failures/calls.hpp>
#include <failures/result.hpp>
#include <map>
#include <search/plain.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

constexpr std::size_t most_lines = 3;
constexpr std::uint64_t least = 3;  ///< failing cases

constexpr std::uint64_t Row::*without_error[] = {&Row::crashed, &Row::not_finite, &Row::wrong_branch,
                                                 &Row::refused};
using Counts = std::array<std::uint64_t, std::size(without_error)>;
/// The cases of a row with each outcome in place of an error, and those with an error.
Counts counts_of(const Row& row) {
  Counts all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = row.*without_error[i];
  return all;
}

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

/// The bands of a block in which its failures cannot be those of a cause with the blocks `of`: it has an outcome there that no
/// block of the cause has.
FailedBlock beside_its_cause(const FailedBlock& f, const std::vector<const FailedBlock*>& of) {
  std::map<std::size_t, Counts> by_band;
  for (const FailedBlock* own : of)
    for (const BandOf& b : own->bands)
      if (own->scalar == f.scalar) {
        const Counts counts = counts_of(*b.row);
        for (std::size_t i = 0; i < counts.size(); ++i) by_band[b.band][i] += counts[i];
      }
  return part_of(f, [&](const BandOf& b) {
    const Counts own = counts_of(*b.row), &of_cause = by_band[b.band];
    for (std::size_t i = 0; i < own.size(); ++i)
      if (b.row->failed > 0 && own[i] > 0 && of_cause[i] == 0) return true;
    return false;
  });
}

/// The bands of another block of an operation in which far more cases fail than in `first`.
FailedBlock beside_another(const FailedBlock& f, const FailedBlock& first) {
  std::map<std::size_t, std::uint64_t> failed;
  for (const BandOf& b : first.bands) failed[b.band] += b.row->failed;
  return part_of(f, [&](const BandOf& b) { return b.fails && b.row->failed > 2 * failed[b.band] + least; });
}

/// The lines of a part, with an example; "" if no input fails alone.
std::string lines_of(const FailedBlock& part, const std::string& name, bool of_outcome,
                     const CampaignResult& campaign) try {
  if (!part.worst || part.failed < least || part.block == "sign") return "";
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
  const NotedCase all = noted(series, s->id, most->output);
  const Output& of = series.outputs.at(most->output);
  const NotedCall* const call = worst_call(of, all);
  const std::string called = call ? called_with(series, *call) : "",
                    number =
                        call && !call->thrown.empty() ? call->thrown : worst_number_text(series, of, all);
  std::string what = worst_outcome(*most->row, of_outcome);
  if (what.empty()) what = digits_lost(score_of(*most), series.eps);
  if (called.empty() || number.empty() || what.empty()) return "";
  return fmt::format("   also     {}{}, {}: {}\n            {}\n", name, what, where_of(part), called,
                     number);
} catch (const GivenUp&) {
  return "";
}

}  // namespace

std::string second_ways(const Finding& finding, const CampaignResult& campaign) {
  const FailedBlock& first = *finding.own.front();
  std::vector<std::string> all, named;
  const auto add = [&](const FailedBlock& part, const std::string& name, bool of_outcome = false) {
    if (std::ranges::find(named, name) != named.end() || all.size() >= most_lines) return;
    if (std::string lines = lines_of(part, name.empty() ? "" : name + ": ", of_outcome, campaign);
        !lines.empty())
      all.push_back(lines), named.push_back(name);
  };
  if (first.worst->band > 0)
    add(part_of(first, [&](const BandOf& b) { return fails_otherwise(first, b); }), "");
  // Formulas that cancel at small angles do so at huge ones for another reason.
  const bool between = std::ranges::any_of(first.bands, [](const BandOf& b) {
    return b.fails && b.series->bands()[b.band].axis != Axis::theta && !is_huge(b);
  });
  const bool small = std::ranges::any_of(
      first.bands, [](const BandOf& b) { return b.fails && b.series->bands()[b.band].axis == Axis::theta; });
  if (small && !between)
    add(part_of(first, [](const BandOf& b) { return b.fails && is_huge(b); }), "at other angles");
  for (const FailedBlock* f : finding.own)
    if (f->operation == first.operation && f->scalar == first.scalar && f->block != first.block &&
        f->block != "jump" && !f->block.ends_with("defect"))
      add(beside_another(*f, first), f->block);
  std::vector<const FailedBlock*> of_cause;
  for (const FailedBlock* f : finding.own)
    if (f->operation == finding.operation) of_cause.push_back(f);
  for (const FailedBlock* f : finding.others)
    if (f->operation != finding.operation && f->scalar == first.scalar)
      add(beside_its_cause(*f, of_cause), f->operation, true);
  for (const auto& [f, bands] : finding.beside)
    if (f->scalar == first.scalar)
      add(part_of(*f, [&bands = bands](const BandOf& b) { return bands.contains(b.band); }), f->operation);
  std::string text;
  for (const std::string& lines : all) text += lines;
  return text;
}

}  // namespace liecheck::properties
