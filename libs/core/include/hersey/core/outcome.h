#pragma once

#include <concepts>
#include <string>
#include <utility>

namespace hersey {

/// Status of a computation whose failures are not distinguished by kind.
enum class Ending { unsolved, solved };

/// Outcome of a computation that may end without an answer. It is the base of every such summary and result, so that
/// all of them are queried in the same way:
///
///     if (!summary.solved()) report(summary.message);
/// The first status is a failure, so that an unfinished computation is not taken for an answer. Derived types are
/// [[nodiscard]], too.
/// @tparam Status   enumeration of the possible ends, with the kinds of failure that a caller distinguishes
/// @tparam answers  statuses that mean an answer
/// @verified_by outcome_test.cpp
template <class Status, Status... answers>
struct [[nodiscard]] OutcomeOf {
  static_assert(sizeof...(answers) > 0 && ((Status{} != answers) && ...), "the first status is one without an answer");

  Status status = Status{};
  /// Why and where there is no answer, in one sentence. If there is an answer, a remark on it, or empty.
  std::string message = {};

  /// True if there is an answer.
  [[nodiscard]] bool solved() const { return ((status == answers) || ...); }

  /// Sets the status to an answer or to a failure.
  void set_solved(bool is_solved) {
    static_assert(std::same_as<Status, Ending>, "where kinds of failure are distinguished, set the status");
    status = is_solved ? Ending::solved : Ending::unsolved;
  }

  /// Sets the status to a failure; `why` is its reason in one sentence.
  void fail(std::string why) {
    status = Status{};
    message = std::move(why);
  }
};

/// Outcome with a single kind of failure.
using Outcome = OutcomeOf<Ending, Ending::solved>;

/// Returns a result of type T without an answer; `why` is the reason in one sentence.
template <class T>
[[nodiscard]] T no_answer(std::string why) {
  T result;
  result.fail(std::move(why));
  return result;
}

}  // namespace hersey
