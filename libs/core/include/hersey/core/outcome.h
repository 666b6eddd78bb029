#pragma once

#include <concepts>
#include <string>
#include <utility>

namespace hersey {

/// How something ended of which no kinds of failure are told apart.
enum class Ending { unsolved, solved };

/// How something went that may end without an answer: the base of every summary and result of that kind, so that all
/// of them are asked in the same words,
///
///     if (!summary.solved()) tell(summary.message);
///
/// The first of the statuses is a failure: what was never brought to an end does not pass for an answer. Types derived
/// from it are [[nodiscard]] like it.
/// @tparam Status   enumeration of the ways to end, with the kinds of failure that a caller tells apart
/// @tparam answers  those of them with an answer
/// @verified_by outcome_test.cpp
template <class Status, Status... answers>
struct [[nodiscard]] OutcomeOf {
  static_assert(sizeof...(answers) > 0 && ((Status{} != answers) && ...), "the first status is one without an answer");

  Status status = Status{};
  /// One sentence: why there is no answer, and where. Beside an answer a remark on it, or empty.
  std::string message = {};

  /// Whether there is an answer.
  [[nodiscard]] bool solved() const { return ((status == answers) || ...); }

  /// Ends with an answer, or without one.
  void set_solved(bool is_solved) {
    static_assert(std::same_as<Status, Ending>, "where kinds of failure are told apart, set the status");
    status = is_solved ? Ending::solved : Ending::unsolved;
  }

  /// Ends without an answer, in one sentence because of `why`.
  void fail(std::string why) {
    status = Status{};
    message = std::move(why);
  }
};

/// The plain one: there is an answer, or there is none.
using Outcome = OutcomeOf<Ending, Ending::solved>;

/// A result of type T that ended without an answer, in one sentence because of `why`.
template <class T>
[[nodiscard]] T no_answer(std::string why) {
  T result;
  result.fail(std::move(why));
  return result;
}

}  // namespace hersey
