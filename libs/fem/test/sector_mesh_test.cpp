#include "hersey/fem/sector_mesh.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/fem/film_surface.h"
#include "hersey/fem/load_distributions.h"
#include "hersey/fem/static_answers.h"

namespace hersey::fem {
namespace sector_mesh_test {

const ElasticMaterial steel{210e9, 0.3, 7850};
constexpr RingSector pad{.inner = 0.05,
                         .outer = 0.065,
                         .width = 0.04,
                         .from = -0.4,
                         .to = 0.7,
                         .elements = {10, 4, 2},
                         .seat = SectorSeat{0.05, 0.15, 0.02}};

TEST_CASE("SectorOfARing_HasItsMass") {
  constexpr double quadratic = 1e-6;  // arcs of 6 deg by quadratic elements
  const ElasticBody body = assemble(sector_mesh(pad), {isotropic(steel)});
  const double arc = pad.to - pad.from, ro = pad.outer, ri = pad.inner;
  const double mass = steel.density * pad.width * arc / 2 * (ro * ro - ri * ri);
  CHECK(body.mass == doctest::Approx(mass).epsilon(quadratic));
  const double centre = 4.0 / 3 * std::sin(arc / 2) * (std::pow(ro, 3) - std::pow(ri, 3)) / (arc * (ro * ro - ri * ri));
  const double middle = (pad.from + pad.to) / 2;
  CHECK((body.centre - centre * Vector3(std::cos(middle), std::sin(middle), 0)).norm() < quadratic * centre);
}

TEST_CASE("SidesOfASector_CarryTheirNames") {
  const Mesh mesh = sector_mesh(pad);
  const auto radius = [&](int node) { return mesh.nodes[static_cast<std::size_t>(node)].head<2>().norm(); };
  for (const int node : mesh.node_sets.at("inner")) CHECK(radius(node) == doctest::Approx(pad.inner));
  for (const int node : mesh.node_sets.at("outer")) CHECK(radius(node) == doctest::Approx(pad.outer));
  for (const auto& [name, angle] : {std::pair{"first_end", pad.from}, std::pair{"last_end", pad.to}})
    for (const int node : mesh.node_sets.at(name)) {
      const Vector3& x = mesh.nodes[static_cast<std::size_t>(node)];
      CHECK(std::atan2(x.y(), x.x()) == doctest::Approx(angle));
    }
  for (const int node : mesh.node_sets.at("low_side"))
    CHECK(mesh.nodes[static_cast<std::size_t>(node)].z() == doctest::Approx(-pad.width / 2));
  CHECK(mesh.surfaces.at("high_side").size() == mesh.surfaces.at("low_side").size());
}

// Elements end on its borders: its faces have its area, and its centre is the seat's.
TEST_CASE("SeatOfASector_IsMadeOfWholeFaces") {
  const Mesh mesh = sector_mesh(pad);
  const std::vector<int>& seat = mesh.node_sets.at("seat");
  double low = 1, high = -1, wide = 0;
  for (const int node : seat) {
    const Vector3& x = mesh.nodes[static_cast<std::size_t>(node)];
    low = std::min(low, std::atan2(x.y(), x.x())), high = std::max(high, std::atan2(x.y(), x.x()));
    wide = std::max(wide, x.z());
  }
  CHECK(low == doctest::Approx(pad.seat->from));
  CHECK(high == doctest::Approx(pad.seat->to));
  CHECK(wide == doctest::Approx(pad.seat->width / 2));
}

// A slender sector without contraction across, at rest at one end under pressure inside: a curved cantilever,
// (pads.6).
TEST_CASE("SectorUnderPressure_BendsAsACurvedBeam") {
  constexpr double ri = 0.1, t = 0.006, B = 0.02, angle = 0.8, E = 210e9, p = 1e5;
  RingSector sector{.inner = ri, .outer = ri + t, .width = B, .from = 0, .to = angle, .elements = {16, 2, 2}};
  const ElasticBody body = assemble(sector_mesh(sector), {isotropic({E, 0, 7850})});
  const FilmCylinder cylinder{.X = {}, .R = ri, .L = B, .arc = SurfaceArc{0, angle}};
  const auto& faces = body.mesh.surfaces.at("inner");
  const FilmSurfaceResult film = film_surface(body.mesh, faces, cylinder, functions_for(body.mesh, faces, cylinder),
                                              1e-6);  // m, of round-off
  REQUIRE_MESSAGE(film.solved(), film.message);
  std::vector<Support> supports;
  for (const int dof : dofs_of(body.mesh.node_sets.at("first_end"))) supports.push_back({dof, 0});
  const Eigen::VectorXd load = film.surface->T * Eigen::VectorXd::Constant(film.surface->functions.count(), p);
  const StaticSolution solution = solve_static(body, supports, load);
  REQUIRE(solution.solved());
  const Vector3 outward(std::cos(angle), std::sin(angle), 0);
  double tip = 0;
  const std::vector<int>& end = body.mesh.node_sets.at("last_end");
  for (const int node : end)
    tip += outward.dot(solution.u.col(0).segment<3>(3 * node)) / static_cast<double>(end.size());
  const double rc = ri + t / 2, I = B * t * t * t / 12, q = p * B * ri;
  const double bending = q * std::pow(rc, 3) / (2 * E * I) * std::pow(1 - std::cos(angle), 2);
  const double shear = 1.2 * 2 / (E * B * t) * q * rc / 2 * std::pow(std::sin(angle), 2);
  CHECK(tip == doctest::Approx(bending + shear).epsilon(0.005));  // of order (t/R)^2 and the stretch of the axis
}

TEST_CASE("FilmOnAnArc_TakesThePartOfTheFacesBelowIt") {
  const Mesh mesh = sector_mesh(pad);
  const auto& faces = mesh.surfaces.at("inner");
  for (const SurfaceArc arc : {SurfaceArc{pad.from, pad.to - pad.from}, SurfaceArc{-0.25, 0.6}, SurfaceArc{6.4, 0.5}}) {
    const FilmCylinder cylinder{.X = {}, .R = pad.inner, .L = 0.03, .arc = arc};
    const FilmSurfaceResult film = film_surface(mesh, faces, cylinder, {8, 3, cylinder.L, arc}, 1e-6);  // m, round-off
    REQUIRE_MESSAGE(film.solved(), film.message);
    constexpr double quadratic = 1e-6,  // arcs of 6 deg by quadratic elements
        cut = 2e-5;                     // the arc's ends within faces, straight in their natural coordinates
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(film.surface->functions.count());
    CHECK(one.dot(film.surface->G * one) == doctest::Approx(cylinder.R * arc.over * cylinder.L).epsilon(quadratic));
    const Eigen::VectorXd forces = film.surface->T * one;
    Vector3 sum = Vector3::Zero();
    for (Eigen::Index node = 0; node < forces.size() / 3; ++node) sum += forces.segment<3>(3 * node);
    const double middle = arc.from + arc.over / 2, resultant = 2 * cylinder.R * cylinder.L * std::sin(arc.over / 2);
    CHECK((sum - resultant * Vector3(std::cos(middle), std::sin(middle), 0)).norm() < cut * resultant);
  }
}

TEST_CASE("FilmOnAnArc_NeedsFacesAllAlongIt") {
  const Mesh mesh = sector_mesh(pad);
  const FilmCylinder cylinder{.X = {}, .R = pad.inner, .L = 0.03, .arc = SurfaceArc{0.2, 0.8}};
  const FilmSurfaceResult film =
      film_surface(mesh, mesh.surfaces.at("inner"), cylinder, {8, 3, cylinder.L, cylinder.arc}, 1e-6);  // m, round-off
  CHECK(!film.solved());
  CHECK(film.message.find("covers only 6") != std::string::npos);
}

}  // namespace sector_mesh_test
}  // namespace hersey::fem
