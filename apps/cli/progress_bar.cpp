#include "progress_bar.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "standard_streams.h"

namespace hersey::cli {
namespace {

using namespace std::chrono_literals;

std::size_t terminal_width() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20) return size.ws_col;
  return 100;
}

std::string remaining(double share, double elapsed) {
  if (share <= 0.005) return "--:--";
  const long seconds = std::lround(elapsed * (1 - share) / share);
  return fmt::format("{:02d}:{:02d}", seconds / 60, seconds % 60);
}

// The most important first: a narrow terminal shows as many as leave room for the bar.
std::vector<std::string> figures(const run::Progress& progress, double share) {
  std::vector<std::string> texts{fmt::format("{:3.0f} %", 100 * share), "left " + remaining(share, progress.elapsed),
                                 fmt::format("t {:.5g} s", progress.t)};
  if (std::isfinite(progress.moft)) texts.push_back(fmt::format("MOFT {:.2f} um", 1e6 * progress.moft));
  texts.push_back(fmt::format("step {:.2g} s", progress.dt));
  texts.push_back(fmt::format("Newton {:2d}", progress.newton_iterations));
  return texts;
}

std::string line_of(const std::string& label, const std::vector<std::string>& texts, std::size_t most) {
  std::string line = label;
  for (const std::string& text : texts) {
    const std::string longer = line + (line.empty() ? "" : "  ") + text;
    if (!line.empty() && longer.size() > most) break;
    line = longer;
  }
  return line;
}

// "[=======>        ]"
std::string bar_of(double share, std::size_t room) {
  const auto full = std::min(room, static_cast<std::size_t>(std::lround(share * static_cast<double>(room))));
  std::string bar(full, '=');
  if (full > 0 && full < room) bar.back() = '>';
  return "[" + bar + std::string(room - full, ' ') + "]";
}

}  // namespace

ProgressBar::ProgressBar()
    : terminal_(isatty(STDERR_FILENO) != 0), width_(terminal_width()), last_(Clock::now() - (terminal_ ? 1s : 0s)) {}

void ProgressBar::show(const std::string& label, const run::Progress& progress) {
  const Clock::time_point now = Clock::now();
  if (now - last_ < (terminal_ ? Clock::duration(100ms) : Clock::duration(10s))) return;
  last_ = now;
  const double span = progress.t_end - progress.t_start;
  const double share = span > 0 ? std::clamp((progress.t - progress.t_start) / span, 0.0, 1.0) : 1.0;
  constexpr std::size_t kLeastBar = 20, kFrame = 4;  // brackets, and a blank on both sides of the text
  if (!terminal_) {
    say("{}\n", line_of(label, figures(progress, share), std::string::npos));
    return;
  }
  const std::size_t most = width_ > kLeastBar + kFrame ? width_ - kLeastBar - kFrame : 0;
  const std::string text = line_of(label, figures(progress, share), most);
  const std::size_t room = width_ > text.size() + kFrame ? width_ - text.size() - kFrame : 0;
  say("\r\033[K{} {}", bar_of(share, room), text);
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressBar::clear() {
  if (!drawn_) return;
  say("\r\033[K");
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace hersey::cli
