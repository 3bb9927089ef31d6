#pragma once
// Runs the hard cases on every selected subject that offers their law, and gives a verdict for each.

#include <campaign/selection.hpp>
#include <hard_cases/corpus.hpp>

namespace liecheck::properties {

/// From best to worst. The verdict of a cell is the worst one of its blocks.
enum class Verdict {
  stable,
  refused,
  ill_posed,
  unmeasured,
  unresolved,
  inaccurate,
  wrong_branch,
  not_finite,
  bad_call
};

const char* name_of(Verdict v);
/// One letter, for tables: S, R, P, M, U, I, B, N, C.
char letter_of(Verdict v);

/// A block that fails in a case.
struct FailedPlace {
  std::string_view operation, block;
  const Bands* bands;
  std::size_t band;
};

/// One hard case on one subject in one scalar.
struct HardCell {
  std::string subject, scalar;
  Verdict verdict = Verdict::stable;
  bool failed = false;                 ///< sets the exit code: every verdict except stable, ill-posed, those
                                       ///< of `open`, the refusal of an input that is not a rotation, and
                                       ///< what a limits file expects
  bool open = false;                   ///< a block is unresolved or unmeasured
  std::string operation, block, band;  ///< of the worst block: by verdict, then error / budget
  double error = 0, kappa = 0;         ///< [eps], [1]; kappa is 0 if it was not computed
  double budget = 0;                   ///< eps, or eps kappa under the excess rule
  bool excess = false;
  std::string refusal;               ///< the error's text
  std::vector<FailedPlace> failing;  ///< all blocks that set `failed`
  CaseId id;
  std::string flags;  ///< subject_flags(), for a replay
};

/// One hard case of one law.
struct HardRow {
  const HardCase* entry = nullptr;
  std::string property;
  std::map<std::string, std::vector<std::string>> input;  ///< by scalar, hexadecimal floats
  std::vector<HardCell> cells;
};

/// Runs `cases` (which must outlive the rows) on every selected series. Throws std::invalid_argument with
/// file, line and value if a case does not fit its law.
std::vector<HardRow> run_hard_cases(const Selection& selection, const Robot& robot,
                                    const std::vector<HardCase>& cases = built_in_corpus(),
                                    unsigned jobs = 1);

bool any_failed(const std::vector<HardRow>& rows);
bool any_open(const std::vector<HardRow>& rows);

}  // namespace liecheck::properties
