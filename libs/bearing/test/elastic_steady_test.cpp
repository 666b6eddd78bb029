// A bearing by itself whose bore deforms, at rest with its film: what holds however it has been found.
#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "hersey/bearing/steady_bearing.h"

namespace hersey::bearing {
namespace elastic_steady_test {

constexpr double kSolved = 1e-8;  // the search ends at 1e-10 of the load, of the film's throughput and of the clearance

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double pi = std::numbers::pi;
constexpr int kAround = 24;
constexpr Index kShapes = 4;

film::FilmModel full_film() {
  film::FilmModel model{.R = 0.025, .L = 0.03, .c = 25e-6, .grid = {48, 7}};
  model.supply = {.kind = film::SupplyKind::widest_gap, .pressure = 1e5};
  return model;
}

/// A bore of two and three waves around, as soft in every direction: `compliance` [1/N] for shapes of 1 m.
SteadyOptions with_bore(const film::FilmModel& model, double compliance) {
  SurfaceFlexibility bore;
  ElasticSurface surface{SurfaceFunctions(kAround, 1, model.L), MatrixXd(kAround, kShapes)};
  for (Index j = 0; j < kAround; ++j) {
    const double phi = 2 * pi * static_cast<double>(j) / kAround;
    surface.D.row(j) << std::cos(2 * phi), std::sin(2 * phi), std::cos(3 * phi), std::sin(3 * phi);
  }
  bore.surface = std::make_shared<ElasticSurface>(surface);
  bore.by_forces = compliance * Eigen::Vector4d(1, 1, 0.2, 0.2).asDiagonal().toDenseMatrix();
  bore.by_wrench = MatrixXd::Zero(kShapes, 6);
  bore.by_spin = VectorXd::Zero(kShapes);
  bore.turn = bore.turn_in_body = bore.offset = MatrixXd::Zero(3, kShapes);
  bore.by_offset_moment = MatrixXd::Zero(kShapes, 3);
  SteadyOptions options;
  options.elasticity =
      std::make_shared<SteadyElasticity>(SteadyElasticity{std::make_shared<SurfaceFlexibility>(bore), nullptr});
  return options;
}

OperatingPoint under_load(double newtons, double angle) {
  OperatingPoint point{.journal_speed = 200};
  point.load = newtons * Vector2d(std::cos(angle), std::sin(angle));
  return point;
}

SteadyState solved(const film::FilmModel& model, const OperatingPoint& point, const SteadyOptions& options) {
  SteadyState state;
  const SteadySummary summary = solve_steady(model, point, options, state);
  CAPTURE(summary.message);
  REQUIRE(summary.solved());
  return state;
}

/// The film's forces on the shapes, node by node.
VectorXd forces_on(const film::FilmModel& model, const ElasticSurface& bore, const VectorXd& normal_forces) {
  VectorXd Q = VectorXd::Zero(kShapes);
  std::vector<SurfaceTerm> terms;
  for (int node = 0; node < model.grid.size(); ++node) {
    const int i = node / model.grid.n_z, j = node % model.grid.n_z;
    bore.functions.at(model.grid.phi(i), model.L * model.grid.z_over_L(j), terms);
    for (const SurfaceTerm& term : terms) Q += term.value * normal_forces[node] * bore.D.row(term.index).transpose();
  }
  return Q;
}

// Load and deformation, from stiff to a bore that gives way by the clearance and more, wherever the search begins.
TEST_CASE("SoftBore_CarriesItsLoadAndYieldsToItsFilm") {
  const film::FilmModel model = full_film();
  for (const double compliance : {1e-10, 1e-9, 1e-8})
    for (const double load : {100.0, 2e3, 4e4}) {
      CAPTURE(compliance);
      CAPTURE(load);
      SteadyOptions options = with_bore(model, compliance);
      const SurfaceFlexibility& bore = *options.elasticity->shell;
      const OperatingPoint point = under_load(load, -0.4 * pi);
      const SteadyState from_ocvirk = solved(model, point, options);
      for (const double epsilon : {0.05, 0.9}) {
        CAPTURE(epsilon);
        options.start = epsilon * model.c * Vector2d(0.6, 0.8);
        const SteadyState state = solved(model, point, options);
        CHECK((state.load - *point.load).norm() <= kSolved * load);
        const VectorXd given_way = bore.by_forces * forces_on(model, *bore.surface, state.film.normal_forces);
        CHECK((state.s - given_way).norm() <= kSolved * (model.c + given_way.norm()));
        CHECK((state.e - from_ocvirk.e).norm() <= kSolved * (model.c + given_way.norm()));
      }
    }
}

TEST_CASE("StiffBore_IsARigidOne") {
  const film::FilmModel model = full_film();
  const OperatingPoint point = under_load(3e3, 0.7);
  const SteadyState rigid = solved(model, point, {}), stiff = solved(model, point, with_bore(model, 0));
  CHECK((stiff.e - rigid.e).norm() <= kSolved * model.c);
  CHECK((stiff.coefficients.stiffness - rigid.coefficients.stiffness).norm() <=
        1e-6 * rigid.coefficients.stiffness.norm());  // what weak spots of the film make of its tolerance
}

TEST_CASE("SoftBoreUnderALoadThatIsTurned_TurnsItsAnswer") {
  const film::FilmModel model = full_film();
  const SteadyOptions options = with_bore(model, 2e-9);
  const double turn = 2 * pi * 5 / kAround;  // ten cells of the grid
  const SteadyState here = solved(model, under_load(1e4, 0.3), options),
                    there = solved(model, under_load(1e4, 0.3 + turn), options);
  CHECK(here.s.norm() > 0.1 * model.c);
  CHECK((Eigen::Rotation2Dd(turn) * here.e - there.e).norm() <= 1e-7 * model.c);  // the same film, by another search
  CHECK((Eigen::Rotation2Dd(2 * turn) * here.s.head<2>() - there.s.head<2>()).norm() <= 1e-7 * model.c);  // likewise
  CHECK((Eigen::Rotation2Dd(3 * turn) * here.s.tail<2>() - there.s.tail<2>()).norm() <= 1e-7 * model.c);  // likewise
}

}  // namespace elastic_steady_test
}  // namespace hersey::bearing
