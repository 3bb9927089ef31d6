#include <support/progress.hpp>

#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/format.h>
#include <algorithm>
#include <cstdio>
#include <support/stop.hpp>
#include <support/text.hpp>

namespace liecheck::properties {
namespace {

std::string clock_text(double seconds) {
  const auto s = static_cast<long>(seconds + 0.5);
  return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60)
                   : fmt::format("{}:{:02}", s / 60, s % 60);
}

int terminal_columns() {
  winsize size{};
  return ioctl(2, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

Progress::Progress(std::string what, bool quiet)
    : what_(std::move(what)), terminal_(isatty(2) != 0), quiet_(quiet), start_(Clock::now()) {}

Progress::~Progress() {
  if (open_) std::fprintf(stderr, "\r%*s\r", std::max(terminal_columns() - 1, 0), "");
}

double Progress::elapsed() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void Progress::show(double share, const std::function<std::string(double)>& detail, bool last) {
  if (quiet_) return;
  const double now = elapsed();
  if (!last && now - shown_ < (terminal_ ? 0.2 : 10.0)) return;
  shown_ = now;
  std::string text = what_.empty() ? "" : what_ + ": ";
  if (share < 0) {
    const std::string said = detail(now);
    text += (said.empty() ? "" : said + "  ") + clock_text(now);
  } else {
    share = std::min(share, 1.0);
    const std::string left = share > 0 ? clock_text(now * (1 - share) / share) : "?";
    text += fmt::format("{:3.0f} %  {}  left {}", share * 100, detail(now), left);
  }
  text = printable(text);
  if (terminal_) {
    const int columns = terminal_columns(), room = columns - 4 - static_cast<int>(text.size());
    const int width = share < 0 ? 0 : std::clamp(room, 0, 30), full = static_cast<int>(share * width);
    const std::string bar = width < 5 ? "" : fmt::format("[{:#<{}}{:.<{}}] ", "", full, "", width - full);
    // Spaces overwrite a longer line. The last column stays free: some terminals begin a new line there.
    const std::string line = fmt::format("{:<{}}", bar + text, bar.size() + text.size() + 3);
    std::fprintf(stderr, "\r%.*s", std::max(columns - 1, 0), line.c_str());
    if (last) std::fprintf(stderr, "\n");
    open_ = !last;
  } else {
    std::fprintf(stderr, "%s\n", text.c_str());
  }
  std::fflush(stderr);
}

Steps::Steps(std::string what, std::size_t all)
    : progress_(std::move(what), all == 0 && isatty(2) != 0),
      all_(all),
      shows_([this](const std::stop_token& end) {
        std::unique_lock lock(mutex_);
        while (
            !ended_.wait_for(lock, end, std::chrono::milliseconds(200), [&] { return end.stop_requested(); }))
          progress_.show(all_ == 0 ? -1 : static_cast<double>(done_) / static_cast<double>(all_), piece_);
      }) {}

void Steps::done(const std::string& piece) {
  const std::lock_guard lock(mutex_);
  ++done_, piece_ = piece;
}

Counted::Counted(std::string what, std::string pieces, std::size_t every)
    : progress_(std::move(what)), pieces_(std::move(pieces)), every_(every) {}

void Counted::next() {
  if (++done_ % every_ == 0 && given_up()) throw GivenUp{};
}

bool Counted::given_up() {
  progress_.show(-1, pieces_.empty() ? "" : fmt::format("{} {}", done_, pieces_));
  return stop_requested && progress_.elapsed() > 0.5;
}

}  // namespace liecheck::properties
