#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <hard_cases/hard_cases.hpp>
#include <history/first_failure.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

void set_if_empty(std::string& text, const std::string& value) {
  if (text.empty()) text = value;
}

std::string law_and_block(const Series& s, const Output& o) {
  return fmt::format("{}: {}, {}", s.property, o.operation, o.block);
}

/// The error or outcome of the worst failing output of a case.
void describe(FirstFailure& f, const std::vector<Judged>& judged) {
  for (const Judged& j : judged) {
    if (!j.failed) continue;
    if (j.residual.outcome == Outcome::measured)
      f.error = std::max(f.error, j.residual.error);
    else
      f.outcome = j.residual.outcome == Outcome::not_finite     ? "not finite"
                  : j.residual.outcome == Outcome::wrong_branch ? "wrong branch"
                                                                : "no result";
  }
}

bool any_row_failed(const Tally& tally) {
  return std::any_of(tally.rows.begin(), tally.rows.end(),
                     [](const auto& at) { return at.second.failed > 0; });
}

/// Runs cases `from` to `to` of a series.
void take_cases(FirstFailure& f, const Series& s, std::uint64_t seed, std::uint64_t from, std::uint64_t to) {
  Tally tally;
  std::uint64_t i = from;
  for (; i < to && !stop_requested; ++i) s.run(seed, i, tally);
  for (const auto& [cell, row] : tally.rows) {
    const Output& o = s.outputs.at(static_cast<std::size_t>(cell.first));
    if (row.failed > 0) set_if_empty(f.by, law_and_block(s, o));
    if (row.unresolved + row.unmeasured > 0) set_if_empty(f.not_measured, law_and_block(s, o));
  }
  if (!f.by.empty()) {  // which of them was the first?
    for (i = from; i + 1 < to; ++i) {
      Tally one;
      s.run(seed, i, one);
      if (any_row_failed(one)) break;
    }
    const CaseId id = s.id(seed, i);
    f.replay = id.text() + subject_flags(s);
    describe(f, s.replay(id));
    ++i;
  }
  f.cases += i - from;
}

void take_hard_cases(FirstFailure& f, const std::vector<HardRow>& rows) {
  for (const HardRow& row : rows) {
    ++f.cases;
    for (const HardCell& cell : row.cells) {
      const std::string text =
          fmt::format("hard case {}: {}, {}", row.entry->name, cell.operation, cell.block);
      if (cell.open) set_if_empty(f.not_measured, text);
      if (!cell.failed || !f.by.empty()) continue;
      f.by = text;
      f.replay = cell.id.text() + cell.flags;
      f.error = cell.error;
      if (cell.verdict != Verdict::inaccurate) f.outcome = name_of(cell.verdict);
    }
    if (!f.by.empty()) return;
  }
}

}  // namespace

double FirstFailure::digits_lost() const {
  const double all = std::numeric_limits<double>::digits * std::log10(2.0);
  if (by.empty()) return 0;
  return outcome.empty() && std::isfinite(error) ? std::clamp(std::log10(error), 0.0, all) : all;
}

FirstFailure first_failure(const FailureSearch& search, const Robot& robot) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  FirstFailure f;
  const auto all = select(search.selection, robot);
  constexpr std::uint64_t round = 64;
  for (std::uint64_t done = 0; f.by.empty() && done < search.cases && elapsed() < search.seconds;) {
    const std::uint64_t next = done + std::min(round, search.cases - done);
    for (const auto& s : all) {
      take_cases(f, *s, search.seed, search.from + done, search.from + next);
      if (!f.by.empty() || stop_requested) break;
    }
    if (stop_requested) break;
    if (done == 0 && search.from == 0 && f.by.empty())
      take_hard_cases(f, run_hard_cases(search.selection, robot));
    done = next;
    f.in_time = done == search.cases;
  }
  f.in_time |= !f.by.empty();
  f.seconds = elapsed();
  return f;
}

}  // namespace liecheck::properties
