#include <liecheck/scene/saved_run.hpp>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <liecheck/scene/setup.hpp>
#include <liecheck/text/from_chars.hpp>

namespace liecheck::scene {
namespace {

/// The hash of Fowler, Noll and Vo (FNV-1a, 64 bits).
class Digest {
 public:
  void add(const std::string& text) {
    for (const char c : text) byte(static_cast<unsigned char>(c));
    byte(0);
  }
  void add(double x) {
    for (std::uint64_t bits = std::bit_cast<std::uint64_t>(x), k = 0; k < 8; ++k, bits >>= 8)
      byte(bits & 0xff);
  }
  void add(long x) { add(double(x)); }
  template <class Numbers>
  void addAll(const Numbers& numbers) {
    for (const double x : numbers) add(x);
    add(long(numbers.size()));
  }
  void add(const SE3<double>& X) { addAll(X.translation()), addAll(X.rotation().reshaped()); }
  void add(const std::vector<Request>& requests) {
    for (const Request& r : requests) {
      add(r.name);
      for (const auto& [key, value] : r.parameters.values) {
        add(key), addAll(value.numbers), add(long(value.width));
        for (const std::string& name : value.names) add(name);
      }
    }
  }
  void add(const Model<double>& m) {
    for (std::size_t i = 0; i < m.joints.size(); ++i) {
      add(m.names[i]), add(long(m.parents[i])), add(m.jointPlacements[i]);
      addAll(m.inertias[i].matrix().reshaped());
      std::visit(
          [&]<class J>(const J& joint) {
            add(joint.shortname());
            if constexpr (!std::is_same_v<J, Universe<double>>)
              addAll(MatrixX<double>(joint.subspace()).reshaped());
            if constexpr (std::is_same_v<J, Mimic<double>>) add(long(joint.primary)), add(joint.offset);
          },
          m.joints[i]);
    }
    for (const auto& f : m.frames) add(f.name), add(long(f.parentJoint)), add(f.placement);
    for (const auto* x :
         {&m.effortLimit, &m.lowerPositionLimit, &m.upperPositionLimit, &m.friction, &m.damping})
      addAll(*x);
  }
  std::uint64_t value() const { return value_; }

 private:
  void byte(std::uint64_t x) { value_ = (value_ ^ x) * 0x100000001b3; }
  std::uint64_t value_ = 0xcbf29ce484222325;
};

const std::string first_line = "liecheck checkpoint 3";

class Writer {
 public:
  std::string text = first_line + "\n";
  void put(double x) {
    char buffer[40];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::hex).ptr;
    text.append(buffer, end) += ' ';
  }
  void put(long n) { text += std::to_string(n) + ' '; }
  template <class Numbers>
  void putAll(const Numbers& numbers) {
    put(long(numbers.size()));
    for (const double x : numbers) put(x);
  }
  void put(const SavedState& s) {
    put(s.step), put(s.t);
    for (const auto* x : {&s.q, &s.v, &s.q_low, &s.v_low}) putAll(*x);
    text += '\n';
  }
  void put(const std::vector<SavedState>& states) {
    put(long(states.size()));
    for (const SavedState& s : states) put(s);
  }
};

/// Every number must be finite. A state of the scene has `numbers` coordinates.
class Reader {
 public:
  Reader(const std::string& text, long numbers)
      : at_(text.data()), end_(text.data() + text.size()), numbers_(numbers) {
    if (!text.starts_with(first_line + "\n"))
      throw std::invalid_argument("is not a checkpoint: its first line is not '" + first_line + "'");
    at_ += first_line.size();
  }
  void get(double& x) {
    number(x);
    if (!std::isfinite(x)) throw std::invalid_argument("is not a whole checkpoint: a number is not finite");
  }
  void get(long& n) { number(n); }
  template <class Numbers>
  void getAll(Numbers& numbers) {
    numbers.resize(decltype(numbers.size())(count(1)));
    for (double& x : numbers) get(x);
  }
  void get(SavedState& s) {
    get(s.step), get(s.t);
    for (auto* x : {&s.q, &s.v, &s.q_low, &s.v_low}) getAll(*x);
  }
  void get(std::vector<SavedState>& states) {
    states.resize(std::size_t(count(6 + numbers_)));  // with its step, its time and four counts
    for (SavedState& s : states) get(s);
  }

 private:
  template <class T>
  void number(T& x) {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\n')) ++at_;
    const auto [after, error] = read(at_, end_, x);
    if (error != std::errc()) throw std::invalid_argument("is not a whole checkpoint: a number is missing");
    at_ = after;
  }
  static std::from_chars_result read(const char* at, const char* end, double& x) {
    return fromChars(at, end, x, std::chars_format::hex);
  }
  static std::from_chars_result read(const char* at, const char* end, long& n) {
    return std::from_chars(at, end, n);
  }
  /// A count of things that are still to be read, each of so many numbers, which have at least two characters.
  long count(long numbers) {
    long n = 0;
    get(n);
    if (n < 0 || n > (end_ - at_) / (2 * numbers))
      throw std::invalid_argument("is not a whole checkpoint: a count is wrong");
    return n;
  }
  const char *at_, *end_;
  long numbers_;
};

constexpr const char* damaged = "is not a whole checkpoint: ";

/// The last line of a checkpoint, which belongs to the text before it.
std::string sealOf(const std::string& text) {
  Digest digest;
  digest.add(text);
  return "seal " + std::to_string(digest.value()) + "\n";
}

/// Throws std::invalid_argument unless the states until the last one are those that a run of this span keeps.
void checkStates(const SavedRun& run, const Span& span) {
  const auto refuse = [](const char* what) { throw std::invalid_argument(std::string(damaged) + what); };
  const long last = run.last.step, parts = std::clamp(span.steps / 9, 1L, 64L),
             longest = span.steps / parts + 1 + span.every;
  long due = 0;
  for (const SavedState& s : run.samples) {
    if (s.step > last) continue;
    if (s.step != due) refuse("a sample is missing");
    due = due == span.steps ? due + 1 : std::min(due + span.every, span.steps);
  }
  if (due <= last) refuse("a sample is missing");
  long before = -1;
  for (const SavedState& s : run.sections) {
    if (s.step > last) continue;
    if (s.step <= before || s.step - std::max(before, 0L) > longest || (before < 0 && s.step > 0))
      refuse("a state is missing");
    before = s.step;
  }
  if (before < 0 || last - before > longest || (last == span.steps && before < last))
    refuse("a state is missing");
}

}  // namespace

std::uint64_t digestOf(const Scene& scene) {
  Digest digest;
  digest.add(scene.model);
  digest.addAll(scene.q), digest.addAll(scene.v);
  digest.add(long(scene.around.ground)), digest.add(scene.around.height), digest.addAll(scene.around.normal);
  digest.add(scene.effects), digest.add(scene.observers);
  for (const Shape& s : scene.around.shapes) {
    digest.add(s.body), digest.add(long(s.frame)), digest.add(long(s.type));
    digest.add(s.X_FS), digest.addAll(s.size);
  }
  if (scene.around.mesh) {
    for (const auto& vertex : scene.around.mesh->vertices) digest.addAll(vertex);
    for (const auto& triangle : scene.around.mesh->triangles)
      for (const std::size_t vertex : triangle) digest.add(long(vertex));
  }
  digest.add(scene.integrator), digest.add(scene.options.tolerance);
  digest.add(long(scene.options.compensated.value_or(compensates(methodInfo(scene.integrator)))));
  digest.add(scene.span.duration), digest.add(scene.span.steps), digest.add(scene.span.every);
  return digest.value();
}

std::string textOf(const SavedRun& run) {
  Writer w;
  w.put(std::bit_cast<long>(run.digest));
  w.putAll(run.memory), w.putAll(run.history);
  w.put(run.counts.steps), w.put(run.counts.rejected), w.put(run.counts.iterations), w.put(run.largest_turn);
  w.put(run.last), w.put(run.samples), w.put(run.sections);
  w.text += '\n';
  return w.text + sealOf(w.text);
}

SavedRun savedRunOf(const std::string& text, const Scene& scene) {
  SavedRun run;
  const std::size_t seal = text.rfind("\nseal ");
  const std::string numbers = text.substr(0, seal == text.npos ? seal : seal + 1);
  const SavedState start = withSetup(scene, [](auto& setup) { return SavedState(0, setup.start); });
  Reader r(numbers, long(start.q.size() + start.v.size() + start.q_low.size() + start.v_low.size()));
  long digest = 0;
  r.get(digest), run.digest = std::bit_cast<std::uint64_t>(digest);
  if (run.digest != digestOf(scene))
    throw std::invalid_argument(
        "is a checkpoint of another scene: robot, start, effects, integrator, times and observers must be "
        "the same");
  if (text.substr(numbers.size()) != sealOf(numbers))
    throw std::invalid_argument(std::string(damaged) + "it was changed");
  r.getAll(run.memory), r.getAll(run.history);
  r.get(run.counts.steps), r.get(run.counts.rejected), r.get(run.counts.iterations), r.get(run.largest_turn);
  r.get(run.last), r.get(run.samples), r.get(run.sections);
  const auto fits = [&](const SavedState& s) {
    return s.step >= 0 && s.step <= scene.span.steps && s.q.size() == start.q.size() &&
           s.v.size() == start.v.size() && s.q_low.size() == start.q_low.size() &&
           s.v_low.size() == start.v_low.size();
  };
  bool all = fits(run.last);
  for (const auto* states : {&run.samples, &run.sections})
    for (const SavedState& s : *states) all = all && fits(s);
  if (!all)
    throw std::invalid_argument("is not a whole checkpoint: a state has another size than the scene's");
  checkStates(run, scene.span);
  return run;
}

}  // namespace liecheck::scene
