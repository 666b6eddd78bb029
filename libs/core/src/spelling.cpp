#include "hersey/core/spelling.h"

#include <algorithm>
#include <vector>

namespace hersey {
namespace {

char lower(char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  // d[i][j] is the distance between the first i letters of a and the first j of b; three rows suffice.
  const std::size_t n = b.size();
  std::vector<int> two_above(n + 1), above(n + 1), row(n + 1);
  for (std::size_t j = 0; j <= n; ++j) above[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= n; ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], two_above[j - 2] + 1);
    }
    two_above.swap(above);
    above.swap(row);
  }
  return above[n];
}

std::string nearest_name(std::string_view word, std::span<const std::string> candidates) {
  std::string best;
  int least = std::max(1, static_cast<int>(word.size()) / 3) + 1;
  const auto length_difference = [&](const std::string& name) {
    return std::max(name.size(), word.size()) - std::min(name.size(), word.size());
  };
  for (const std::string& candidate : candidates) {
    const int distance = edit_distance(word, candidate);
    // Among equally near names prefer one of the same length: a mistyped letter is more likely than a missing one.
    const bool is_nearer = distance < least || (distance == least && !best.empty() &&
                                                length_difference(candidate) < length_difference(best));
    if (is_nearer) least = distance, best = candidate;
  }
  return best;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> candidates) {
  const std::string name = nearest_name(word, candidates);
  return name.empty() ? "" : "did you mean '" + name + "'?";
}

std::string one_of(std::span<const std::string> names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

}  // namespace hersey
