#pragma once

#include <span>
#include <string>
#include <string_view>

namespace hersey {

/// Least number of insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`, letters' case
/// ignored (optimal string alignment distance). Cost O(|a| |b|).
[[nodiscard]] int edit_distance(std::string_view a, std::string_view b);

/// The candidate that `word` most likely meant; empty where none is near (more than a third of its letters differ).
[[nodiscard]] std::string nearest_name(std::string_view word, std::span<const std::string> candidates);

/// "did you mean 'diameter'?", or empty where `nearest_name` finds none.
[[nodiscard]] std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

/// "a", "a or b", "a, b or c".
[[nodiscard]] std::string one_of(std::span<const std::string> names);

}  // namespace hersey
