#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <integrators/confirm.hpp>
#include <integrators/make_runner.hpp>
#include <integrators/reference.hpp>
#include <limits>
#include <optional>

namespace liecheck::properties {
namespace {

using Clock = std::chrono::steady_clock;
using Moments = std::vector<Moment>;

class Search {
 public:
  Search(const Benchmark& s, long parts, const std::atomic<bool>* stop,
         const std::function<void(const std::string&)>& progress)
      : scene_(s), parts_(parts), stop_(stop), progress_(progress) {}

  /// The best of two successive runs of a method. The steps are halved until the runs agree to `enough`, no
  /// longer agree better, or the next run would take longer than `seconds`.
  std::optional<Reference> halved(const std::string& method, const std::string& scalar, long first,
                                  double enough, double seconds) {
    const auto runner = make(scene_, method, scalar);
    std::optional<Moments> coarse;
    std::optional<Reference> best;
    int no_better = 0;
    for (long steps = first; steps <= 1L << 18 && no_better < 2; steps *= 2) {
      progress_(fmt::format("reference: {} in {}, {} steps", method, scalar, steps));
      const auto begin = Clock::now();
      const auto fine = run(*runner, {steps, 0});
      const double took = std::chrono::duration<double>(Clock::now() - begin).count();
      if (coarse && fine) {
        const MotionError d = difference(*fine, *coarse);
        ++no_better;
        if (!best || d.leading() < best->disagreement.leading() / 2)
          best = {fmt::format("{} in {} with {} and {} steps", method, scalar, steps / 2, steps), false, d,
                  *fine},
          no_better = 0;
        if (d.leading() < enough) break;
      }
      if (2 * took > seconds) break;
      coarse = fine;
    }
    return best;
  }
  /// rkmk6 in double, and the run of another method that agrees with it best. (Implicit methods take long
  /// where steps of fixed length are too long for contact.)
  std::optional<Reference> by_two_methods() {
    std::optional<Reference> best = halved("rkmk6", "double", 1024, 0, 20);
    if (!best) return best;
    Reference r{"", false, {}, best->at};
    double least = std::numeric_limits<double>::infinity();
    for (const std::string name : {"dopri5", "radau5"})
      for (const double tolerance : {1e-10, 1e-11, 1e-12, 1e-13}) {
        progress_(fmt::format("reference: {} in double, tolerance {:.0e}", name, tolerance));
        const auto runner = make(scene_, name, "double");
        const auto begin = Clock::now();
        const auto found = run(*runner, {parts_, tolerance});
        if (!found) break;
        const MotionError d = difference(*found, r.at);
        if (d.leading() < least) {
          least = d.leading(), r.disagreement = d;
          r.name = fmt::format("{}, and {} in double with the tolerance {:.0e}", best->name, name, tolerance);
        }
        if (std::chrono::duration<double>(Clock::now() - begin).count() > 10) break;
      }
    if (r.name.empty()) return std::nullopt;
    return r;
  }
  /// Why the last run that failed did not reach the end.
  const std::string& why() const { return why_; }

 private:
  std::unique_ptr<Runner> make(const Benchmark& s, const std::string& method, const std::string& scalar) {
    auto runner = make_runner(s, method, scalar);
    runner->stop = stop_;
    return runner;
  }
  std::optional<Moments> run(Runner& runner, const Effort& effort) {
    Moments moments;
    try {
      runner.run(effort, parts_, [&](double, const Moment& m) { moments.push_back(m); });
    } catch (const Diverged& e) {
      why_ = e.what();
      return std::nullopt;
    }
    return moments;
  }
  MotionError difference(const Moments& a, const Moments& b) const {
    MotionError worst = MotionError::none();
    for (std::size_t k = 1; k < a.size(); ++k) worst.take_larger(motion_error(scene_.robot, a[k], b[k]));
    return worst;
  }

  const Benchmark& scene_;
  long parts_;
  const std::atomic<bool>* stop_;
  const std::function<void(const std::string&)>& progress_;
  std::string why_;
};

/// Whether forces begin, end or bend where the state decides. In float128, it takes too long to locate these
/// events.
bool has_events(const Benchmark& s) {
  for (const std::string& name : s.effect_names)
    for (const char* bends : {"contact", "collisions", "joint_limits", "motor", "pd along rows"})
      if (name == bends) return true;
  return std::any_of(s.servos.begin(), s.servos.end(), [](const Servo& x) { return std::isfinite(x.limit); });
}

/// The reference with its second formulation. A difference below a hundred times what the two are known to may come from
/// the amplification of errors, and limits what is compared; a larger one shows a wrong equation. The second one is known
/// to its difference from a run with another tolerance, which is made if the first one is known better than they agree.
Reference confirmed(Reference r, const Benchmark& s, const std::atomic<bool>* stop,
                    const std::function<void(const std::string&)>& progress) {
  progress("reference: maximal coordinates");
  const Confirmation c = confirmation_of(s, r.at, stop);
  if (!c.unconfirmed.empty()) {
    r.name += " (unconfirmed: " + c.unconfirmed + ")";
    return r;
  }
  oracles::Real size(1);
  for (const Moment& m : r.at)
    for (const auto* numbers : {&m.q, &m.v})
      for (const oracles::Real& x : *numbers) size = std::max<oracles::Real>(size, abs(x));
  const double rounding = 0x1p-53 * static_cast<double>(size);  // what a run in double can show
  std::optional<Confirmation> again;
  for (const ErrorMeasure& m : error_measures) {
    const double apart = c.apart.*m.of;
    double known = std::max(rounding, r.disagreement.*m.of);
    if (apart > 100 * known && !again) again = confirmation_of(s, c.at, stop, 0x1p-52L);
    if (again && again->unconfirmed.empty()) known = std::max(known, again->apart.*m.of);
    if (apart > 100 * known)
      throw std::invalid_argument(
          fmt::format("{}: no reference: {} and maximal coordinates differ by {:.0e} in {}, and they are "
                      "known to {:.0e}: "
                      "take a shorter duration, or effects with fewer events",
                      s.name, r.name, apart, m.name, known));
  }
  r.disagreement.take_larger(c.apart);
  r.name += ", and extrapolation in maximal coordinates";
  return r;
}

}  // namespace

Reference reference_of(const Benchmark& s, long parts, const std::atomic<bool>* stop,
                       const std::function<void(const std::string&)>& progress) {
  progress("reference");
  if (const auto truth = truth_of(s, stop)) {
    Reference r{truth->name, truth->closed, {}, {}};
    for (const ErrorMeasure& m : error_measures) r.disagreement.*m.of = truth->disagreement;
    for (long k = 0; k <= parts; ++k) r.at.push_back(truth->at(s.duration * double(k) / double(parts)));
    return r;
  }
  Search search(s, parts, stop, progress);
  const auto wide = has_events(s) ? std::nullopt : search.halved("gauss12", "float128", 64, 1e-20, 40);
  const auto with_second = [&](const Reference& r) { return confirmed(r, s, stop, progress); };
  if (wide && wide->disagreement.leading() < 1e-13) return with_second(*wide);
  const auto two = search.by_two_methods();
  if (two && !(wide && wide->disagreement.leading() < two->disagreement.leading())) return with_second(*two);
  if (wide) return with_second(*wide);
  throw Diverged("no two runs with different steps reach the end: " + search.why());
}

}  // namespace liecheck::properties
