#include <doctest/doctest.h>

#include <Eigen/Dense>

#include "hersey/film/observables.h"
#include "hersey/film/reynolds.h"
#include "rough_states.h"

// What a film shows that has been evaluated already is what it shows evaluated anew, bit by bit.
namespace hersey::film {
namespace evaluated_film_test {

using namespace rough_states;

void check_same(const FilmObservables& a, const FilmObservables& b) {
  CHECK(a.wrench_on_shell == b.wrench_on_shell);
  CHECK(a.force_pressure == b.force_pressure);
  CHECK(a.torque_journal == b.torque_journal);
  CHECK(a.torque_journal_other_shear == b.torque_journal_other_shear);
  CHECK(a.normal_forces == b.normal_forces);
  CHECK(a.h_min == b.h_min);
  CHECK(a.p_max == b.p_max);
  CHECK(a.flow_left == b.flow_left);
  CHECK(a.flow_supply == b.flow_supply);
  CHECK(a.storage_rate == b.storage_rate);
  CHECK(a.power_taken() == b.power_taken());
  CHECK(a.cavitated_share == b.cavitated_share);
}

void check_same(const FilmFields& a, const FilmFields& b) {
  CHECK(a.p == b.p);
  CHECK(a.theta == b.theta);
  CHECK(a.density == b.density);
  CHECK(a.h == b.h);
  CHECK(a.w == b.w);
  CHECK(a.p_asperity == b.p_asperity);
  REQUIRE(a.reynolds.size() == b.reynolds.size());
  CHECK((a.reynolds.size() == 0 || a.reynolds == b.reynolds));
}

TEST_CASE("EvaluatedFilm_ShowsWhatItShowsAnew") {
  const Eigen::Vector2d e(4e-6, -7e-6), tilt(1e-5, 2e-5);
  for (const ShearForce shear : {ShearForce::full, ShearForce::none}) {
    for (State s : all_states()) {
      CAPTURE(s.name);
      s.model.shear_force = shear;
      const FilmObservables anew = observe_film(s.model, s.motion, s.history, e, s.u, tilt);
      const FilmFields fields = film_fields(s.model, s.motion, s.u, s.history.viscosity);
      Reynolds film(s.model);
      REQUIRE(film.linearise(s.motion, s.history, s.u).is_inside());
      check_same(film.observe(s.motion, e, s.u, tilt), anew);
      check_same(film.fields(), fields);
      if (s.history.dt == 0) continue;
      StepOilBalance oil, again;
      film.settle(oil);
      check_same(film.observe(s.motion, e, s.u, tilt), anew);
      check_same(film.fields(), fields);
      film.settle(s.motion, s.history, s.u, again);
      check_same(film.observe(s.motion, e, s.u, tilt), anew);
      // On a factor of its own, or on that of the linearisation: the same matrix.
      CHECK((oil.content - again.content).lpNorm<Eigen::Infinity>() < 1e-12);      // round-off of contents of 1
      CHECK(oil.flow_supply == doctest::Approx(again.flow_supply).epsilon(1e-9));  // of a sum of larger flows
    }
  }
}

}  // namespace evaluated_film_test
}  // namespace hersey::film
