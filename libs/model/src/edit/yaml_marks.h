#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Where pieces of YAML begin and end in a text that has been read without fault: offsets of bytes, columns from 0.
namespace hersey::model {

inline constexpr std::string_view kSpace = " \t";

[[nodiscard]] std::vector<std::size_t> starts_of_lines(const std::string& text);
/// Behind the quoted text that begins at `at`.
[[nodiscard]] std::size_t behind_quotes(std::string_view text, std::size_t at);
[[nodiscard]] bool begins_comment(std::string_view text, std::size_t at);
/// Behind the bracket that closes the one at `at`.
[[nodiscard]] std::size_t behind_brackets(std::string_view text, std::size_t at);
[[nodiscard]] std::size_t without_trailing_space(std::string_view text, std::size_t begin, std::size_t end);
[[nodiscard]] std::size_t end_of_line(std::string_view text, std::size_t at);
[[nodiscard]] std::size_t indentation(std::string_view text, std::size_t line);
/// Behind a plain scalar, which may go on in lines that are indented deeper than `column`, counted from 0.
[[nodiscard]] std::size_t behind_plain(std::string_view text, std::size_t at, std::size_t column, bool is_in_flow);
/// Behind a block scalar, `|` or `>`, in a mapping whose keys stand in `column`, counted from 0.
[[nodiscard]] std::size_t behind_block(std::string_view text, std::size_t at, std::size_t column);
/// Behind the colon of a key that ends at `at`; there itself for a key without one, as in {a, b}.
[[nodiscard]] std::size_t behind_colon(std::string_view text, std::size_t at);

}  // namespace hersey::model
