#include "interpret/files/stl_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <map>
#include <string_view>
#include <tuple>
#include <vector>

namespace hersey::model {
namespace {

constexpr std::size_t header_size = 84, facet_size = 50;

constexpr double farthest = 1e15;  // in the file's unit: what lies beyond is no length of a body

bool is_valid_position(const Vector3& corner) {
  return corner.allFinite() && corner.lpNorm<Eigen::Infinity>() < farthest;
}

/// Gathers corners, each once.
class MeshBuilder {
 public:
  void add(const std::array<Vector3, 3>& corners) {
    ++result_.facets;
    if ((corners[1] - corners[0]).cross(corners[2] - corners[0]).squaredNorm() == 0) {
      ++result_.flat;
      return;
    }
    std::array<int, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = index_of(corners[k]);
    result_.mesh.triangles.push_back(triangle);
  }

  [[nodiscard]] StlResult take() { return std::move(result_); }

 private:
  int index_of(const Vector3& corner) {
    auto& known = result_.mesh.corners;
    const auto [entry, is_new] = indices_.try_emplace({corner.x(), corner.y(), corner.z()}, known.size());
    if (is_new) known.push_back(corner);
    return static_cast<int>(entry->second);
  }

  StlResult result_;
  std::map<std::tuple<double, double, double>, std::size_t> indices_;
};

StlResult fault(std::string text) {
  StlResult result;
  result.fault = std::move(text);
  return result;
}

std::uint32_t count_in_header(const std::string& content) {
  std::uint32_t count = 0;
  std::memcpy(&count, content.data() + header_size - sizeof count, sizeof count);
  return count;
}

// The format has no mark: a binary file is one whose length fits the number of facets it names.
bool is_binary(const std::string& content) {
  return content.size() >= header_size && content.size() == header_size + facet_size * count_in_header(content);
}

StlResult parse_binary(const std::string& content) {
  MeshBuilder builder;
  const std::uint32_t count = count_in_header(content);
  for (std::uint32_t f = 0; f < count; ++f) {
    std::array<float, 12> numbers{};  // normal, then three corners
    std::memcpy(numbers.data(), content.data() + header_size + facet_size * f, sizeof numbers);
    std::array<Vector3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = {numbers[3 + 3 * k], numbers[4 + 3 * k], numbers[5 + 3 * k]};
    for (const Vector3& corner : corners) {
      if (!is_valid_position(corner))
        return fault(fmt::format("facet {} has a corner without a finite position", f + 1));
    }
    builder.add(corners);
  }
  return builder.take();
}

// Text begins with "solid"; some programs begin the header of binary files with it too, but fill it up with zeros.
bool is_text(std::string_view content) {
  const std::size_t first = std::min(content.find_first_not_of(" \t\r\n"), content.size());
  std::string word(content.substr(first, 5));
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  return word == "solid" && content.substr(0, header_size).find('\0') == std::string_view::npos;
}

StlResult unreadable(const std::string& content) {
  if (content.size() < header_size) return fault(content.empty() ? "an empty file" : "neither text nor binary STL");
  const std::uint32_t count = count_in_header(content);
  return fault(fmt::format("a binary file of {} bytes, but its {} facets take {}: it is cut short, or no STL",
                           content.size(), count, header_size + facet_size * count));
}

class TextReader {
 public:
  explicit TextReader(std::string_view content) : rest_(content) {}

  StlResult read() {
    while (!rest_.empty() && fault_.empty()) {
      next_line();
      if (!words_.empty()) read_line();
    }
    if (fault_.empty() && is_open_)
      fault_ = fmt::format("line {}: the end of the file without endsolid: it is cut short", number_);
    if (!fault_.empty()) return fault(std::move(fault_));
    return builder_.take();
  }

 private:
  void next_line() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    words_.clear();
    for (std::size_t at = 0; (at = line_.find_first_not_of(" \t\r", at)) < line_.size();) {
      const std::size_t stop = std::min(line_.find_first_of(" \t\r", at), line_.size());
      words_.push_back(line_.substr(at, stop - at));
      at = stop;
    }
  }

  void read_line() {
    std::string word(words_[0]);
    std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
    if (word == "vertex") return add_corner();
    if (word == "outer" || word == "endloop") return switch_loop(word == "outer");
    if (word == "solid" || word == "endsolid") is_open_ = word == "solid";
    const bool is_between = is_open_ && (word == "facet" || word == "endfacet");
    if (in_loop_ || (!is_between && word != "solid" && word != "endsolid")) refuse("where STL has no such word");
  }

  void switch_loop(bool begins) {
    if (begins == in_loop_ || !is_open_) return refuse("where STL has no such word");
    in_loop_ = begins;
    if (begins) {
      corner_ = 0;
    } else if (corner_ == 3) {
      builder_.add(corners_);
    } else {
      refuse("after a facet that is no triangle");
    }
  }

  void add_corner() {
    Vector3 r;
    bool good = in_loop_ && corner_ < 3 && words_.size() == 4;
    for (std::size_t k = 1; good && k < 4; ++k) {
      std::string_view text = words_[k];
      if (text.starts_with('+')) text.remove_prefix(1);
      const auto [end, error] =
          std::from_chars(text.data(), text.data() + text.size(), r[static_cast<Eigen::Index>(k) - 1]);
      good = error == std::errc() && end == text.data() + text.size();
    }
    if (!good || !is_valid_position(r)) return refuse("is no corner of a triangle");
    corners_[corner_++] = r;
  }

  void refuse(const char* why) { fault_ = fmt::format("line {}: '{}' {}", number_, line_.substr(0, 40), why); }

  std::string_view rest_, line_;
  std::vector<std::string_view> words_;
  int number_ = 0;
  bool is_open_ = false, in_loop_ = false;
  std::array<Vector3, 3> corners_;
  std::size_t corner_ = 0;
  std::string fault_;
  MeshBuilder builder_;
};

}  // namespace

StlResult parse_stl(const std::string& content) {
  StlResult result = is_binary(content) ? parse_binary(content)
                     : is_text(content) ? TextReader(content).read()
                                        : unreadable(content);
  if (result.fault.empty() && result.mesh.triangles.empty()) result.fault = "no triangles";
  return result;
}

}  // namespace hersey::model
