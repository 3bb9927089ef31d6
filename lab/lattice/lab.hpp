#pragma once
// Faults planted in one base subject, and how many cases the laws need to find each.
//
// A fault acts only in the cases in which its trigger fires. So a first pass runs every case once, without a
// fault, and notes where each trigger fires in each operation. Then a fault is planted only in its own cases.
// Because a case follows from its address, the result is the same as if all cases were run with the fault.

#include <campaign/series.hpp>
#include <lattice/watch.hpp>

namespace liecheck::properties {

constexpr std::uint64_t first_cases = 1000;
/// A trigger that fires in this share of the cases has a tenth of its cases in the first 1000.
constexpr double common_share = 0.01;

enum class Found : std::uint8_t {
  found,      ///< a law failed
  granted,    ///< laws measured the error, but it is within their limits (times kappa)
  unseen,     ///< results changed, but no measurement did
  unchanged,  ///< the trigger fired, but no result changed in a case that the base passes
  unfired     ///< the trigger never fired
};
inline constexpr const char* found_words[] = {"found", "granted", "unseen", "unchanged", "never fired"};
static_assert(std::size(found_words) == static_cast<std::size_t>(Found::unfired) + 1);

/// Whether the condition that a finding prints is that of the trigger (search/condition.hpp): it holds for nearly all failing
/// cases and for few others, and in about as many cases as the trigger fires in.
enum class Told : std::uint8_t { unasked, right, other, silent };

struct FaultVerdict {
  Found found = Found::unfired;
  std::uint64_t cases = 0;  ///< of a law, until it fails; 0 if none failed
  std::string by;           ///< law: operation, block
  double share = 0;         ///< of the cases of a law in which the trigger fires; the largest of all laws
  /// Of this run, for a found fault whose trigger is no angle and no habit, of a law that the base passes.
  Told told = Told::unasked;
  std::string condition = {};  ///< in words, if one was told
};

/// Which laws run: those of single operations and robots, and those of trees.
struct LawKinds {
  bool single = true, trees = true;
};

class Lab {
 public:
  /// `table` must outlive the lab. Throws std::invalid_argument if no law applies to the base.
  Lab(const Subject& base, const std::vector<Trigger>& table, std::uint64_t seed, const Robot& robot,
      LawKinds kinds = {});
  Lab(const Lab&) = delete;
  Lab& operator=(const Lab&) = delete;

  /// Notes where triggers fire in the cases below `cases` of each law, or in a tenth of them for laws of
  /// trees; cases of an earlier call are not run again. Beyond the first 1000 cases only triggers are noted
  /// that fired in less than 1 % of those. Returns false if `stop` became true; call again to go on.
  bool scan(
      std::uint64_t cases, const std::function<bool()>& stop = [] { return false; });
  /// Every operation with every trigger that its arguments admit, in a fixed order. The perturbation is drawn
  /// from the seed; with the trigger "always" there is one fault of each kind.
  std::vector<Fault> faults() const;
  /// The share of a law's scanned cases in which the fault's trigger fires; the largest of all laws.
  double share(const Fault& fault) const;
  /// Plants the fault in the scanned cases in which its trigger fires. It is found if a law fails that does
  /// not fail the same output of the base.
  FaultVerdict judge(const Fault& fault);
  /// The share of the scanned cases of all laws that the base itself fails.
  double failures_of_base() const;

 private:
  struct Noted {
    std::vector<std::uint32_t> cases;  ///< in which the trigger fired in the operation
    bool often = false;                ///< in at least 1 % of the first cases: no longer noted
  };
  struct LawRun {
    std::unique_ptr<Series> series;
    Source::Key key;
    bool of_trees = false;
    std::uint64_t scanned = 0, failed = 0;
    std::vector<bool> base_fails;
    std::map<std::pair<const Operation*, std::size_t>, Noted> noted;
    std::vector<Watch::Calls> calls_before;  ///< of the first cases
  };
  /// The state of one fault's trial.
  struct Trial {
    std::uint64_t granted = 0;
    bool changed = false;    ///< a result, in a case that the base passes
    std::size_t output = 0;  ///< the one that failed
  };

  std::vector<Judged> run(const LawRun& law, std::uint64_t index);
  void scan_case(LawRun& law, std::uint64_t index);
  /// Runs a case with the fault. Returns the failed measurement, or null.
  bool fails(const LawRun& law, std::uint64_t index, const Fault& fault, Trial& trial, std::string& by);
  /// What a finding would say of where a found fault acts.
  void tell(const LawRun& law, const Fault& fault, std::size_t output, FaultVerdict& verdict);
  Perturbation drawn(const Operation& operation, std::size_t trigger) const;

  const std::vector<Trigger>& triggers_;
  std::uint64_t seed_;
  Watch watch_;
  Subject subject_;
  std::vector<LawRun> laws_;
  std::map<const Operation*, std::vector<bool>> applies_;  ///< which triggers an operation's arguments admit
};

}  // namespace liecheck::properties
