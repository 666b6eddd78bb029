#include "runs/event_history.h"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "runs/run_files.h"

namespace hersey::workbench {
namespace {

constexpr std::uintmax_t kMostWhole = std::uintmax_t{32} << 20;  // of a file that is read as a whole
constexpr std::uintmax_t kPart = 16 << 10;                       // longer lines of larger files are left out
constexpr std::size_t kMostAnswer = std::size_t{8} << 20;        // [bytes], about
constexpr std::string_view kStepped = "{\"kind\":\"stepped\"";

/// The lines of a text that end in it.
std::vector<std::string_view> complete_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t from = 0, end = text.find('\n'); end != std::string_view::npos;
       from = end + 1, end = text.find('\n', from))
    if (end > from) lines.push_back(text.substr(from, end - from));
  return lines;
}

/// Lines at `most` places that lie evenly in a file, with its first line and those at its end.
std::string sampled(const std::filesystem::path& file, std::uintmax_t size, std::size_t most) {
  std::string text;
  std::uintmax_t behind = 0;  // of what has been taken
  const std::uintmax_t end = size - kPart;
  for (std::size_t i = 0; i < most; ++i) {
    const std::uintmax_t at = std::max(behind, end / most * i);
    if (at >= end) break;
    const std::string part = part_of(file, at, kPart);
    // A place within a line says nothing before the next one.
    const std::size_t begin = at == behind ? 0 : part.find('\n') + 1;
    const std::size_t stop = begin == 0 && at != behind ? std::string::npos : part.find('\n', begin);
    if (stop == std::string::npos) continue;
    text.append(part, begin, stop + 1 - begin);
    behind = at + stop + 1;
  }
  const std::string tail = part_of(file, std::max(behind, end), kPart);
  const std::size_t begin = behind >= end ? 0 : tail.find('\n') + 1;
  return text + (begin == 0 && behind < end ? "" : tail.substr(begin));
}

/// Of some lines every so manieth, the first and the last besides.
class Sieve {
 public:
  Sieve(std::size_t count, std::size_t bytes, std::size_t most) : count_(count) {
    const auto parts = [](std::size_t whole, std::size_t part) {
      return (whole + part - 1) / std::max<std::size_t>(part, 1);
    };
    every_ = std::max({parts(count, std::max<std::size_t>(most, 3) - 2), parts(bytes, kMostAnswer), std::size_t{1}});
  }
  [[nodiscard]] bool takes_next() {
    const std::size_t number = number_++;
    return number % every_ == 0 || number + 1 == count_;
  }

 private:
  std::size_t count_, every_ = 1, number_ = 0;
};

}  // namespace

std::string thinned_events(const std::filesystem::path& file, std::size_t most) {
  const std::uintmax_t size = size_of(file);
  const std::string whole = size <= kMostWhole ? part_of(file, 0, size) : sampled(file, size, most);
  const std::vector<std::string_view> lines = complete_lines(whole);
  std::size_t steps = 0, bytes_of_steps = 0, bytes = 0;
  for (const std::string_view line : lines) {
    bytes += line.size();
    if (!line.starts_with(kStepped)) continue;
    ++steps;
    bytes_of_steps += line.size();
  }
  Sieve of_steps(steps, bytes_of_steps, most), of_others(lines.size() - steps, bytes - bytes_of_steps, most);
  std::string text;
  for (const std::string_view line : lines)
    if ((line.starts_with(kStepped) ? of_steps : of_others).takes_next()) text.append(line).append("\n");
  return text;
}

}  // namespace hersey::workbench
