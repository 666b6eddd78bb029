#include "hersey/core/outcome.h"

#include <doctest/doctest.h>

#include <string>

namespace hersey {
namespace outcome_test {

struct Roots : Outcome {
  int count = 0;
};

enum class LandingStatus { lost, late, on_time };
struct Landing : OutcomeOf<LandingStatus, LandingStatus::late, LandingStatus::on_time> {
  double speed = 0;
};

TEST_CASE("Outcome_IsNoAnswerUntilItIsSaid") {
  CHECK_FALSE(Outcome{}.solved());
  CHECK_FALSE(Roots{}.solved());
  CHECK_FALSE(Landing{}.solved());
}

TEST_CASE("Outcome_TellsItsEndAndWhy") {
  Roots roots;
  roots.count = 2;
  roots.set_solved(true);
  CHECK(roots.solved());
  CHECK(roots.message.empty());
  roots.fail("it crosses nowhere");
  CHECK_FALSE(roots.solved());
  CHECK(roots.message == "it crosses nowhere");
  CHECK(roots.count == 2);
  const Roots none = no_answer<Roots>("no polynomial");
  CHECK_FALSE(none.solved());
  CHECK(none.message == "no polynomial");
}

TEST_CASE("Outcome_OfKinds_HasAnAnswerInThoseNamed") {
  Landing landing;
  landing.status = LandingStatus::late;
  CHECK(landing.solved());
  landing.status = LandingStatus::on_time;
  CHECK(landing.solved());
  landing.fail("out of fuel");
  CHECK(landing.status == LandingStatus::lost);
  CHECK_FALSE(landing.solved());
}

}  // namespace outcome_test
}  // namespace hersey
