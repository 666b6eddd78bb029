// Static answers to film pressures, against closed forms and against the whole mesh.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "hersey/fem/film_surface.h"
#include "hersey/fem/load_distributions.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/reduction.h"
#include "ring.h"
#include "small_bodies.h"
#include "source_dir.h"

namespace hersey::fem {
namespace film_modes_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double E = 2.1e11, nu = 0.3;

FilmSurface must_make(const Mesh& mesh, const FilmCylinder& cylinder, const SurfaceFunctions& functions,
                      double tolerance = 1e-9) {
  const FilmSurfaceResult result =
      film_surface(mesh, faces_on_cylinder(mesh, cylinder, tolerance), cylinder, functions, tolerance);
  CAPTURE(result.message);
  REQUIRE(result.solved());
  return *result.surface;
}

/// A body fixed by frames.
ConstrainedStiffness fixed_at(const ElasticBody& body, const std::vector<InterfaceFrame>& frames) {
  const FrameSupports supports = frame_supports(body.mesh, frames);
  ConstrainedStiffness stiffness(body.K, body.m, supports.fixed_dofs, supports.C);
  REQUIRE(stiffness.factorise().solved());
  return stiffness;
}

InterfaceFrame average_on(const Mesh& mesh, const std::string& set) {
  const std::vector<int>& nodes = mesh.node_sets.at(set);
  return {set, face_centre(mesh, nodes), nodes, Connection::average, face_weights(mesh, nodes)};
}

TEST_CASE("RingUnderFilmPressure_WidensAsLameSays") {
  const Ring ring;
  const double a = ring.inner, b = ring.outer;
  const double exact = a / E * ((b * b + a * a) / (b * b - a * a) + nu);  // plane stress, 1 Pa
  for (const ElementType type : {ElementType::hex20, ElementType::tet10}) {
    CAPTURE(name_of(type));
    const ElasticBody body = assemble(ring_mesh(type, ring), {steel});
    // The mean of the outside is fixed: a pressure all around needs no force for that.
    const ConstrainedStiffness stiffness = fixed_at(body, {average_on(body.mesh, "outside")});
    const FilmSurface surface = must_make(body.mesh, film_of(ring), {16, 4, ring.width});
    const VectorXd f = surface.T * VectorXd::Ones(surface.functions.count());
    const VectorXd d = surface.coefficients(stiffness.solve(f));
    CHECK(d.minCoeff() > (1 - 2e-3) * exact);
    CHECK(d.maxCoeff() < (1 + 2e-3) * exact);
  }
}

TEST_CASE("ThinLiner_GivesWayAsColumnsDo") {
  const auto error_of = [](double thickness) {
    const Ring ring{.inner = 0.0225, .outer = 0.0225 + thickness, .cells = {2, 36, 2}};
    const ElasticBody body = assemble(ring_mesh(ElementType::hex20, ring), {steel});
    std::vector<int> fixed = dofs_of(body.mesh.node_sets.at("outside"));
    for (const char* end : {"bottom", "top"})
      for (const int dof : dofs_of(body.mesh.node_sets.at(end), {false, false, true})) fixed.push_back(dof);
    ConstrainedStiffness stiffness(body.K, body.m, fixed);
    REQUIRE(stiffness.factorise().solved());
    const FilmSurface surface = must_make(body.mesh, film_of(ring), {18, 3, ring.width});
    const VectorXd p = VectorXd::Constant(surface.functions.count(), 2.0) + cosine_on(surface.functions);
    const VectorXd d = surface.coefficients(stiffness.solve(surface.T * p));
    const VectorXd columns = thickness * (1 + nu) * (1 - 2 * nu) / (E * (1 - nu)) * p;
    return (d - columns).cwiseAbs().maxCoeff() / columns.maxCoeff();
  };
  // Columns widen outward: a deviation of the order of thickness over radius.
  const double thick = error_of(0.45e-3), thin = error_of(0.225e-3);
  CHECK(thick < 0.03);
  CHECK(thin < 0.015);
  CHECK(thick / thin == doctest::Approx(2).epsilon(0.15));
}

TEST_CASE("FilmModes_MissNoMoreThanTheySay_AndLessTheMoreThereAre") {
  const Mesh mesh = read_mesh(std::filesystem::path(hersey::source_dir()) / "examples/meshes/conrod.msh", 1e-3);
  const ElasticBody body = assemble(mesh, {steel});
  const ConstrainedStiffness stiffness = fixed_at(body, {average_on(mesh, "small_end"), average_on(mesh, "big_end")});
  const FilmCylinder film{.X = {}, .R = 0.0225, .L = 0.0156, .is_bore = true};
  const std::vector<ElementFace> faces = faces_called(mesh, "big_end");
  const FilmSurface surface = must_make(mesh, film, functions_for(mesh, faces, film), 2e-4);
  // A pressure of 1 at 60 degrees that falls to nothing within a fifth of the circumference.
  VectorXd p(surface.functions.count());
  for (int j = 0; j < surface.functions.count(); ++j) {
    const double phi = 2 * std::numbers::pi * (j % surface.functions.around()) / surface.functions.around();
    p[j] = std::pow(std::max(0.0, std::cos(phi - std::numbers::pi / 3)), 6);
  }
  const VectorXd exact = surface.coefficients(stiffness.solve(surface.T * p));
  const auto size = [&](const VectorXd& c) { return std::sqrt(c.dot(surface.G * c)); };
  double last = 1;
  for (const int most : {5, 15, 40}) {
    const FilmModes modes = film_modes(stiffness, surface, most, 1e-6);
    REQUIRE(modes.compliance.size() == most);
    const VectorXd d = surface.coefficients(modes.shapes * (modes.pressures.transpose() * (surface.G * p)));
    const double error = size(d - exact) / size(exact);
    MESSAGE(surface.functions.around() << " x " << surface.functions.along() << " functions, " << most
                                       << " film modes: miss " << 100 * error << " %, lost " << modes.lost);
    CHECK(size(d - exact) <= 1.001 * modes.lost * modes.compliance[0] * size(p));
    CHECK(error < last);
    last = error;
    // Both ways of writing a mode's answer.
    const MatrixXd answers = surface.coefficients(modes.shapes);
    CHECK((answers - modes.pressures * modes.compliance.asDiagonal()).cwiseAbs().maxCoeff() <
          1e-8 * answers.cwiseAbs().maxCoeff());
  }
  CHECK(last < 0.01);
}

TEST_CASE("FilmModes_OfAMeshTooCoarseForItsFunctions_AreFewer") {
  // 48 x 7 functions on 12 linear elements around and 2 along: 36 radial displacements.
  const Ring ring{.cells = {1, 12, 2}};
  const ElasticBody body = assemble(ring_mesh(ElementType::hex8, ring), {steel});
  const ConstrainedStiffness stiffness = fixed_at(body, {average_on(body.mesh, "outside")});
  const FilmSurface surface = must_make(body.mesh, film_of(ring), {48, 7, ring.width});
  const FilmModes modes = film_modes(stiffness, surface, 1000, 1e-9);
  CHECK(modes.compliance.size() <= 36 * 3);
  CHECK(modes.compliance.size() >= 36);
  CHECK(modes.lost <= 1e-9);  // as asked for
  CHECK(modes.shapes.allFinite());
}

TEST_CASE("FilmModes_OfASurfaceThatAFrameHolds_AreNone") {
  const Ring ring{.cells = {1, 12, 2}};
  const ElasticBody body = assemble(ring_mesh(ElementType::hex8, ring), {steel});
  ConstrainedStiffness stiffness(body.K, body.m, dofs_of(body.mesh.node_sets.at("bore")));
  REQUIRE(stiffness.factorise().solved());
  const FilmSurface surface = must_make(body.mesh, film_of(ring), {12, 3, ring.width});
  const FilmModes modes = film_modes(stiffness, surface, 60, 1e-6);
  CHECK(modes.compliance.size() == 0);
  CHECK(modes.shapes.cols() == 0);
  CHECK(modes.lost == 0);
}

TEST_CASE("CoefficientsFromAFrame_SeeDeformationAlone") {
  const Ring ring{.cells = {2, 18, 3}};
  const ElasticBody body = assemble(ring_mesh(ElementType::hex20, ring), {steel});
  // A bore that its frame carries rigidly does not deform, however the frame moves; relative to the other frame it
  // does.
  const std::vector<int>& nodes = body.mesh.node_sets.at("bore");
  const std::vector<InterfaceFrame> frames = {average_on(body.mesh, "outside"),
                                              {"bore", {0, 0, 1e-3}, nodes, Connection::rigid, {}}};
  const Reduction reduction = reduce(body, frames, {.modes = 3});
  REQUIRE(reduction.solved());
  const MatrixXd U =
      reduction.body.Phi.rightCols(6 + reduction.body.internal_omega.size());  // of frame 1, and vibrations
  const FilmSurface surface = must_make(body.mesh, film_of(ring), {16, 4, ring.width});
  CHECK(surface.coefficients(U).leftCols(6).colwise().norm().maxCoeff() > 1);
  // Round-off, of unit motions.
  CHECK(coefficients_from_frame(surface, body.mesh, U, frames[1].origin, 0).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("ReducedBody_AnswersFilmPressuresAsTheMeshDoes") {
  const Ring ring{.cells = {2, 18, 3}};
  const ElasticBody body = assemble(ring_mesh(ElementType::hex20, ring), {steel});
  const std::vector<InterfaceFrame> frames = {average_on(body.mesh, "outside")};
  const FilmSurface surface = must_make(body.mesh, film_of(ring), {24, 4, ring.width});
  ReductionOptions options;
  options.modes = 6;
  options.film_surfaces = {surface};
  options.film_modes = 30;
  const Reduction reduction = reduce(body, frames, options);
  CAPTURE(reduction.message);
  REQUIRE(reduction.solved());
  const ReducedBody& reduced = reduction.body;
  REQUIRE(reduced.film_modes.size() == 1);
  const FilmModes& modes = reduced.film_modes[0];
  REQUIRE(modes.compliance.size() == 30);
  CHECK(reduced.internal_omega.size() == 36);
  const MatrixXd V = reduced.Phi.rightCols(reduced.internal_omega.size());
  const MatrixXd q = reduced.internal_omega.cwiseAbs2().cwiseInverse().asDiagonal() * (V.transpose() * modes.loads);
  const MatrixXd d = surface.coefficients(V * q);
  for (Eigen::Index k = 0; k < d.cols(); ++k) {
    CAPTURE(k);
    const VectorXd error = d.col(k) - modes.compliance[k] * modes.pressures.col(k);
    // Round-off, as the modes are orthonormalised together with vibrations.
    CHECK(error.cwiseAbs().maxCoeff() < 1e-6 * modes.compliance[k] * modes.pressures.col(k).cwiseAbs().maxCoeff());
  }
}

}  // namespace film_modes_test
}  // namespace hersey::fem
