// Static condensation of a mesh to frames and a film's surface, against the reduction by modes and closed forms.
#include "hersey/fem/static_answers.h"

#include <doctest/doctest.h>

#include "hersey/fem/film_surface.h"
#include "hersey/fem/reduction.h"
#include "ring.h"
#include "small_bodies.h"

namespace hersey::fem {
namespace static_answers_test {

constexpr double kAnotherWay = 1e-8;  // two factorisations of the same matrix: round-off times its condition

using Eigen::VectorXd;

FilmSurface bore_of(const Mesh& mesh, const Ring& ring) {
  const FilmCylinder cylinder = film_of(ring);
  const FilmSurfaceResult result =
      film_surface(mesh, faces_on_cylinder(mesh, cylinder, 1e-9), cylinder, {12, 3, ring.width}, 1e-9);
  REQUIRE(result.solved());
  return *result.surface;
}

std::vector<InterfaceFrame> outside_of(const Mesh& mesh) {
  const std::vector<int>& nodes = mesh.node_sets.at("outside");
  return {{"outside", face_centre(mesh, nodes), nodes, Connection::average, face_weights(mesh, nodes)}};
}

TEST_CASE("StaticAnswers_AreThoseOfTheReductionWithEveryFilmMode") {
  const Ring ring;
  const ElasticBody body = assemble(ring_mesh(ElementType::hex20, ring), {steel});
  const FilmSurface surface = bore_of(body.mesh, ring);
  const std::vector<InterfaceFrame> frames = outside_of(body.mesh);
  const StaticAnswers answers = static_answers(body, frames, surface, Vector3::Zero(), Vector3::UnitZ());
  INFO(answers.message);
  REQUIRE(answers.solved());
  ReductionOptions options;
  options.modes = 0;
  options.film_surfaces = {surface};
  const Reduction reduced = reduce(body, frames, options);
  REQUIRE(reduced.solved());
  const FilmModes& films = reduced.body.film_modes.front();
  REQUIRE(films.compliance.size() > 10);
  for (Eigen::Index k = 0; k < films.compliance.size(); ++k) {
    CAPTURE(k);
    const VectorXd p = films.pressures.col(k), d = answers.compliance * (surface.G * p);
    CHECK((d - films.compliance[k] * p).norm() < kAnotherWay * films.compliance[0] * p.norm());
  }
  // Zero for the one frame of a free body, on the scale of the material's stiffness.
  CHECK((answers.stiffness - reduced.body.K.topLeftCorner(6, 6)).norm() < 1e-6 * steel.D.norm());
}

/// A turning ring grows by rho omega^2 r/(8 E) [(3 + nu)(1 - nu)(a^2 + b^2 + (1 + nu)/(1 - nu) a^2 b^2/r^2)
/// - (1 - nu^2) r^2], plane stress (Timoshenko and Goodier 1970, sec. 32).
TEST_CASE("RotatingRing_GrowsByTheClosedForm") {
  const Ring ring;
  const ElasticBody body = assemble(ring_mesh(ElementType::hex20, ring), {steel});
  const FilmSurface surface = bore_of(body.mesh, ring);
  const StaticAnswers answers = static_answers(body, outside_of(body.mesh), surface, Vector3::Zero(), Vector3::UnitZ());
  REQUIRE(answers.solved());
  const double E = 2.1e11, nu = 0.3, a2 = ring.inner * ring.inner, b2 = ring.outer * ring.outer, r = ring.inner;
  const double grows =
      steel.density * r / (8 * E) *
      ((3 + nu) * (1 - nu) * (a2 + b2 + (1 + nu) / (1 - nu) * a2 * b2 / (r * r)) - (1 - nu * nu) * r * r);
  CHECK(answers.spin.mean() == doctest::Approx(grows).epsilon(2e-3));
  CHECK(answers.spin_on_frames.norm() < 1e-9 * steel.density);  // on the scale of the forces, which cancel
}

TEST_CASE("StaticAnswers_OfABodyThatNothingHolds_SayWhy") {
  const Ring ring;
  const ElasticBody body = assemble(ring_mesh(ElementType::hex20, ring), {steel});
  const FilmSurface surface = bore_of(body.mesh, ring);
  const StaticAnswers answers =
      static_answers(body, {{"nowhere", Vector3::Zero(), {}, Connection::rigid, {}}}, surface, {}, Vector3::UnitZ());
  CHECK_FALSE(answers.solved());
  CHECK(answers.message == "frame 'nowhere' sits on no node");
}

}  // namespace static_answers_test
}  // namespace hersey::fem
