#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <campaign/robots.hpp>
#include <cmath>
#include <failures/calls.hpp>
#include <failures/drawn_tree.hpp>
#include <failures/findings.hpp>
#include <failures/program.hpp>
#include <failures/result.hpp>
#include <failures/second_ways.hpp>
#include <failures/tree_substitutions.hpp>
#include <failures/two_results.hpp>
#include <search/plain.hpp>
#include <set>
#include <support/stop.hpp>
#include <support/text.hpp>

namespace liecheck::properties {

namespace {

void add_once(std::vector<std::string>& to, const std::string& text) {
  if (std::ranges::find(to, text) == to.end()) to.push_back(text);
}

/// The failing bands of a block: those of ordinary angles first, of these the ones that lose half of the digits that the
/// worst band loses, and of these the one in which most cases fail.
std::vector<BandOfFailure> bands_of(const FailedBlock& f, const BandOf& worst) {
  std::vector<std::pair<double, BandOfFailure>> all;
  const auto loss = [&](const BandOf& b) {  // 1 is all digits
    const double eps = f.worst->series->eps;
    return std::log(std::clamp(b.row->worst_score, 1.0, 1 / eps)) / -std::log(eps);
  };
  double most = 0;
  for (const BandOf& b : f.bands)
    if (b.fails) most = std::max(most, loss(b));
  for (const BandOf& b : f.bands) {
    if (!b.fails || b.series != worst.series || b.output != worst.output) continue;
    const double share = static_cast<double>(b.row->failed) / static_cast<double>(b.row->inside());
    const bool ordinary = is_ordinary(b.series->bands()[b.band]);
    const double score = worst_outcome(*b.row).empty() ? score_of(b) : b.row->worst_score;
    all.push_back({share + (ordinary ? 4 : 0) + (2 * loss(b) >= most ? 2 : 0), {b.band, score, ordinary}});
  }
  std::ranges::stable_sort(all, std::greater(), [](const auto& one) { return one.first; });
  std::vector<BandOfFailure> bands;
  for (const auto& [order, band] : all) bands.push_back(band);
  return bands;
}

/// ": 7.6 of 15.7 digits lost", if an example loses fewer digits than the headline says, or more, by one at least.
std::string other_than_the_worst(const FailedBlock& f, const Shrunk& example) {
  const Series& series = *f.worst->series;
  if (example.judged.residual.outcome != Outcome::measured) return "";
  const double all = 1 / series.eps, score = std::min(score_of(series, example.judged), all);
  const std::string lost = digits_lost(score, series.eps);
  const double told = std::min(f.score, all);
  return lost.empty() || (10 * score > told && score < 10 * told) ? "" : ": " + lost;
}

/// Whether a result fails in no other block, so that the digits which this one loses are those of the number that is shown.
bool fails_alone(const Series& series, std::size_t output, const Shrunk& example) {
  const Output& shown = series.outputs.at(output);
  return std::ranges::none_of(series.measure(series.numbers(example.id)), [&](const Judged& j) {
    const Output& o = series.outputs.at(static_cast<std::size_t>(j.residual.output));
    return j.failed && o.operation == shown.operation && o.block != shown.block;
  });
}

/// The call that shows a failure, what is wrong with its result, and how to repeat it.
std::string example_of(const FailedBlock& f, const CampaignResult& campaign) try {
  const BandOf& w = *f.worst;
  const Series& series = *w.series;
  const auto output = static_cast<int>(w.output);
  const CaseId worst = series.id(campaign.options.seed, w.row->worst_index);
  std::optional<Shrunk> s =
      plain_failure(series, worst, output, bands_of(f, w), worst_outcome(*w.row).empty());
  if (!s) s = shrink(series, worst, output, 500);
  std::string text;
  const bool steady = s->reproduced && worst_outcome(*w.row) != std::string("not repeatable");
  if (!steady) text = "   this case gives other results when it is measured again\n";
  const NotedCase all = noted(series, s->id, w.output);
  const Output& of = series.outputs.at(w.output);
  const NotedCall* const call = worst_call(of, all);
  if (const std::string called = call ? called_with(series, *call) : ""; !called.empty())
    text += fmt::format("   example  {}\n", called);
  else
    text += drawn_tree(series, s->id, of, all.compared.seen);
  if (const std::string two = steady ? "" : two_results_text(series, worst, w.output); !two.empty())
    text += fmt::format("            {}\n", two);
  else if (const std::string number =
               f.block == "sign" || !s->reproduced ? "" : worst_number_text(series, of, all);
           !number.empty())
    text += fmt::format("            {}{}\n", number,
                        fails_alone(series, w.output, *s) ? other_than_the_worst(f, *s) : "");
  else if (call && !call->thrown.empty())
    text += fmt::format("            {}\n", printable(call->thrown));
  text += program_of_template(series, of, all);
  const std::string shown = s->id.input.size() > 40 ? worst.text() : s->id.text();
  return text + fmt::format("   replay   {}\n", replay_words(shown, replay_flags(series, campaign.robot)));
} catch (const GivenUp&) {
  return "   interrupted: this case is not measured again\n";
}

/// The line of [domain] that leaves the failures out, if every failing band is of angles above 10, or of angles below 1e-100;
/// else "".
std::string domain_of(const FailedBlock& f) {
  bool huge = true, tiny = true;
  for (const BandOf& b : f.bands) {
    if (!b.fails && !b.expected) continue;
    const Band& band = b.series->bands()[b.band];
    huge = huge && band.axis == Axis::none && band.region == Region::beyond_pi && band.low >= 10;
    tiny = tiny && band.axis == Axis::theta && band.low > 0 && band.high < 2e-100;
  }
  return huge ? "angle = 100" : tiny ? "angle >= 1e-100" : "";
}

/// "all 15.7 digits lost in double, 3.9 of 6.9 digits lost in float", of the worst block in each scalar.
std::string how_bad(const std::vector<const FailedBlock*>& blocks) {
  std::vector<std::string> scalars, all;
  for (const FailedBlock* first : blocks) {
    if (std::ranges::find(scalars, first->scalar) != scalars.end()) continue;
    scalars.push_back(first->scalar);
    const FailedBlock* f = first;
    for (const FailedBlock* other : blocks)
      if (first->block != "sign" && worst_outcome(*first->worst->row).empty() &&
          other->operation == f->operation && other->scalar == f->scalar && other->score > 10 * f->score)
        f = other;
    const bool any_not_finite = std::ranges::any_of(blocks, [&](const FailedBlock* other) {
      return other->operation == f->operation && other->scalar == f->scalar &&
             std::ranges::any_of(other->bands,
                                 [](const BandOf& b) { return b.fails && b.row->not_finite > 0; });
    });
    const std::string what = what_of(*f);
    all.push_back(f->block == "sign"
                      ? fmt::format("-Q is returned where Q is nearer, in {}", f->scalar)
                      : fmt::format("{}{} in {}", what,
                                    any_not_finite && what.find("NaN") == what.npos ? ", or NaN or Inf," : "",
                                    f->scalar));
  }
  return fmt::format("{}", fmt::join(all, ", "));
}

}  // namespace

std::string text_of(const Finding& finding, std::size_t number, const CampaignResult& campaign) {
  if (finding.own.empty()) {
    const HardCell& cell = *finding.hard_cells.front();
    const HardCase& entry = *finding.hard_rows.front()->entry;
    return fmt::format("{}  {} {}: hard case {} ({})\n   input    {}\n   reason   {}\n   replay   {}\n",
                       number, finding.operation, cell.block, entry.name, name_of(cell.verdict), entry.input,
                       entry.reason, replay_words(cell.id.text(), cell.flags));
  }
  const FailedBlock& first = *finding.own.front();
  const SecondWays second = second_ways(finding, campaign);
  std::vector<const FailedBlock*> own = finding.own;
  std::erase_if(own, [&](const FailedBlock* f) {
    return f->operation == finding.operation && second.apart.contains(f->block);
  });
  std::vector<std::string> blocks, others;
  for (const FailedBlock* f : own)
    if (f->operation == finding.operation) add_once(blocks, f->block);
  for (const FailedBlock* f : finding.others)
    if (f->operation != finding.operation) add_once(others, f->operation);
  for (const std::string& operation : finding.partly)
    if (operation != finding.operation) add_once(others, operation);
  std::string text =
      fmt::format("{}  {} ({}): {}\n", number, finding.operation, fmt::join(blocks, ", "), how_bad(own));
  text += fmt::format("   where    {}{}\n", where_and_how_often(first, campaign),
                      finding.ordinary > 0 ? ""
                      : std::ranges::any_of(first.bands, &BandOf::expected)
                          ? "; other angles fail as the limits file expects"
                          : "; all angles from 1e-8 to pi - 1e-8 pass");
  if (const std::string domain = domain_of(first); !domain.empty())
    text += fmt::format("   domain   a limits file leaves such angles out by \"{}, {}\" below [domain]\n",
                        others.empty() ? finding.operation : "*", domain);
  // That of the first block whose errors tell one. A jump tells least, since few angles are tried.
  std::string guess;
  for (const bool of_jumps : {false, true})
    for (const FailedBlock* f : own)
      if (guess.empty() && f->operation == first.operation && f->scalar == first.scalar &&
          (f->block == "jump") == of_jumps)
        if (guess = guess_of(*f); !guess.empty() && f->block != first.block && !of_jumps)
          guess = f->block + ": " + guess;
  if (guess.empty() && !finding.used.empty())
    guess = fmt::format("it uses {}, which {} above", fmt::join(finding.used, ", "),
                        finding.used.size() == 1 ? "fails" : "fail");
  if (guess.empty()) guess = needed_term_of(*first.worst->series, first.worst->output);
  if (std::ranges::all_of(first.bands,
                          [](const BandOf& b) { return !b.fails || worst_outcome(*b.row) == "refused"; }))
    guess.clear();  // no number is wrong that a guess could explain
  if (!guess.empty()) text += fmt::format("   perhaps  {}\n", guess);
  if (!others.empty())
    text += fmt::format("   so       {} {} in the same way\n", fmt::join(others, ", "),
                        others.size() == 1 ? "fails" : "fail");
  text += example_of(first, campaign) + second.text;
  std::set<const HardCase*> hard;  // a case of several laws and scalars is one
  for (const HardRow* row : finding.hard_rows) hard.insert(row->entry);
  if (!hard.empty())
    text += fmt::format("   hard     {} of the hard cases {} worst in these blocks: {}{}\n", hard.size(),
                        hard.size() == 1 ? "fails" : "fail", finding.hard_rows.front()->entry->name,
                        hard.size() > 1 ? ", ..." : "");
  return text;
}

}  // namespace liecheck::properties
