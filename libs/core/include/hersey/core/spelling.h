#pragma once

#include <span>
#include <string>
#include <string_view>

namespace hersey {

/// Returns the optimal string alignment distance: the smallest number of insertions, deletions, substitutions and swaps
/// of neighbours that change `a` into `b`. Upper and lower case are equal. Cost O(|a| |b|).
[[nodiscard]] int edit_distance(std::string_view a, std::string_view b);

/// Returns the candidate that `word` most likely meant; empty if more than a third of the letters differ for all
/// candidates.
[[nodiscard]] std::string nearest_name(std::string_view word, std::span<const std::string> candidates);

/// Returns "did you mean 'diameter'?", or an empty text if `nearest_name` finds none.
[[nodiscard]] std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

/// Returns "a", "a or b" or "a, b or c".
[[nodiscard]] std::string one_of(std::span<const std::string> names);

}  // namespace hersey
