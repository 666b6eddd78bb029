#include "hersey/fem/film_surface.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "hersey/fem/load_distributions.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/skin.h"
#include "ring.h"
#include "small_bodies.h"
#include "source_dir.h"

namespace hersey::fem {
namespace film_surface_test {

constexpr double kRoundOff = 1e-12;  // of sums over all faces

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double pi = std::numbers::pi;
constexpr double near = 1e-9;  // m: ring meshes lie on their circles but for round-off

FilmSurface must_make(const Mesh& mesh, const FilmCylinder& cylinder, const SurfaceFunctions& functions,
                      double tolerance = near) {
  const FilmSurfaceResult result =
      film_surface(mesh, faces_on_cylinder(mesh, cylinder, tolerance), cylinder, functions, tolerance);
  CAPTURE(result.message);
  REQUIRE(result.solved());
  return *result.surface;
}

/// Force and moment about the mesh's origin of nodal forces, [moment; force].
Vector6 resultant(const Mesh& mesh, const VectorXd& f) { return rigid_motions(mesh, Vector3::Zero()).transpose() * f; }

/// int p(phi, z) over the film, on many points.
double integral(const FilmCylinder& film, const std::function<double(double, double)>& p) {
  constexpr int around = 720, along = 200;
  double sum = 0;
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < along; ++k) sum += p(2 * pi * (i + 0.5) / around, film.L * ((k + 0.5) / along - 0.5));
  return sum * 2 * pi * film.R * film.L / (around * along);
}

double value_of(const SurfaceFunctions& functions, const VectorXd& c, double phi, double z) {
  std::vector<SurfaceTerm> terms;
  functions.at(phi, z, terms);
  double value = 0;
  for (const SurfaceTerm& term : terms) value += term.value * c[term.index];
  return value;
}

TEST_CASE("ConstantPressure_OnAClosedSurface_HasNoResultant_AndTheWholeArea") {
  const Ring ring;
  for (const ElementType type : solids)
    for (const bool is_bore : {true, false}) {
      CAPTURE(name_of(type));
      CAPTURE(is_bore);
      const Mesh mesh = ring_mesh(type, ring);
      const FilmCylinder film = film_of(ring, is_bore);
      const FilmSurface surface = must_make(mesh, film, {16, 4, film.L});
      const VectorXd one = VectorXd::Ones(surface.functions.count());
      const double area = 2 * pi * film.R * film.L;
      const Vector6 wrench = resultant(mesh, surface.T * one);
      CHECK(wrench.tail<3>().norm() < kRoundOff * area);
      CHECK(wrench.head<3>().norm() < kRoundOff * area * film.R);
      // Quadrature of (film-surface.4) on each face.
      CHECK(one.dot(surface.G * one) == doctest::Approx(area).epsilon(1e-6));
    }
}

TEST_CASE("Resultants_OfAPressureAreThoseOfTheFilm") {
  // Elements that do not end where the film does, nor where the functions' pieces do.
  const Ring ring{.width = 0.023, .cells = {1, 30, 5}};
  for (const ElementType type : {ElementType::hex20, ElementType::tet10}) {
    CAPTURE(name_of(type));
    const Mesh mesh = ring_mesh(type, ring);
    FilmCylinder film = film_of(ring);
    film.L = 0.0156;
    const FilmSurface surface = must_make(mesh, film, {22, 5, film.L});
    VectorXd p = cosine_on(surface.functions);
    for (Eigen::Index j = 0; j < p.size(); ++j) p[j] += std::sin(0.7 * j) + std::cos(2.3 * j * j);
    const auto moment_of = [&](const std::function<double(double, double)>& arm) {
      return integral(film, [&](double phi, double z) { return value_of(surface.functions, p, phi, z) * arm(phi, z); });
    };
    const Vector6 wrench = resultant(mesh, surface.T * p);
    const double scale = 2 * pi * film.R * film.L;
    const double fx = moment_of([](double phi, double) { return std::cos(phi); });
    const double fy = moment_of([](double phi, double) { return std::sin(phi); });
    const double mx = moment_of([](double phi, double z) { return -z * std::sin(phi); });
    const double my = moment_of([](double phi, double z) { return z * std::cos(phi); });
    // Points on triangles on one side, 720 x 200 of them on the other.
    CHECK(std::abs(wrench[3] - fx) < 1e-5 * scale);
    CHECK(std::abs(wrench[4] - fy) < 1e-5 * scale);
    CHECK(std::abs(wrench[0] - mx) < 1e-5 * scale * film.L);
    CHECK(std::abs(wrench[1] - my) < 1e-5 * scale * film.L);
    CHECK(std::abs(wrench[2]) < 1e-5 * scale * film.R);  // radial forces: edges of facets are off the circle
    CHECK(std::hypot(fx, fy) > 0.3 * scale);
  }
}

TEST_CASE("PressureOnHalfTheFilm_PushesAlongARigidMotionWithItsExactForce") {
  // Q = d^T Psi^T (p a) of a displacement along x, with the film's own points: d is cos(phi) in the functions.
  const Ring ring;
  const Mesh mesh = ring_mesh(ElementType::hex20, ring);
  const FilmCylinder film = film_of(ring);
  const auto error_with = [&](int around) {
    const FilmSurface surface = must_make(mesh, film, {around, 4, film.L});
    const MatrixXd d = surface.coefficients(rigid_motions(mesh, Vector3::Zero()));
    const double force = integral(film, [&](double phi, double z) {
      return std::max(0.0, std::cos(phi)) * value_of(surface.functions, d.col(3), phi, z);
    });
    return std::abs(force / (pi / 2 * film.R * film.L) - 1);
  };
  const double coarse = error_with(8), fine = error_with(24);
  // The displacement errs to fourth order in 1/functions, its work to eighth: 2e-7 with 8, 3e-11 with 24.
  CHECK(coarse < 1e-6);
  CHECK(fine < 1e-10);
}

TEST_CASE("Work_IsTheSameOnNodesAndOnTheFilm") {
  const Ring ring{.width = 0.023, .cells = {1, 18, 5}};
  const Mesh mesh = ring_mesh(ElementType::wedge15, ring);
  FilmCylinder film = film_of(ring);
  film.L = 0.0156;
  const FilmSurface surface = must_make(mesh, film, {18, 4, film.L});
  const auto n = 3 * static_cast<Eigen::Index>(mesh.nodes.size());
  VectorXd u(n), p(surface.functions.count());
  for (Eigen::Index i = 0; i < n; ++i) u[i] = std::sin(1.3 * i) + 0.2;
  for (Eigen::Index j = 0; j < p.size(); ++j) p[j] = std::cos(0.9 * j * j);
  const VectorXd d = surface.coefficients(u);
  const double on_nodes = u.dot(surface.T * p);
  const double on_film = integral(film, [&](double phi, double z) {
    return value_of(surface.functions, d, phi, z) * value_of(surface.functions, p, phi, z);
  });
  const double scale = std::sqrt(d.dot(surface.G * d) * p.dot(surface.G * p));
  CHECK(std::abs(on_nodes - d.dot(surface.G * p)) < kRoundOff * scale);
  CHECK(std::abs(on_nodes - on_film) < 1e-4 * scale);  // 720 x 200 points on one side, triangles on the other
}

TEST_CASE("RadialDisplacement_IsRecoveredOnAFilmRotatedInTheMesh") {
  const Ring ring;
  Mesh mesh = ring_mesh(ElementType::hex20, ring);
  FilmCylinder film = film_of(ring);
  film.X = {rotation_exp({0.4, -1.1, 0.7}).toRotationMatrix(), {0.1, -0.3, 0.2}};
  VectorXd u(3 * static_cast<Eigen::Index>(mesh.nodes.size()));
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    const Vector3 x = mesh.nodes[a];
    const double phi = std::atan2(x.y(), x.x());
    const Vector3 e_r(std::cos(phi), std::sin(phi), 0);
    u.segment<3>(3 * static_cast<Eigen::Index>(a)) =
        film.X.R * ((2 + std::cos(2 * phi) + 30 * x.z()) * e_r + Vector3(0, 0, 0.3));
    mesh.nodes[a] = film.X * x;
  }
  const FilmSurface surface = must_make(mesh, film, {24, 4, film.L});
  const VectorXd d = surface.coefficients(u);
  for (const double phi : {0.0, 0.3, 1.9, 4.4})
    for (const double z : {-0.0078, 0.001, 0.0078}) {
      // Elements of 15 degrees with three nodes interpolate cos(2 phi) to a few 1e-4.
      CHECK(std::abs(value_of(surface.functions, d, phi, z) - (2 + std::cos(2 * phi) + 30 * z)) < 2e-3);
    }
}

TEST_CASE("FunctionsFor_FollowTheMesh") {
  const Ring coarse{.cells = {1, 6, 1}}, medium{.cells = {1, 18, 3}}, fine{.cells = {1, 90, 20}};
  const auto functions_on = [](const Ring& ring) {
    const Mesh mesh = ring_mesh(ElementType::hex20, ring);
    return functions_for(mesh, mesh.surfaces.at("bore"), film_of(ring));
  };
  CHECK(functions_on(coarse).around() == 8);
  CHECK(functions_on(medium).around() == 24);  // 36 nodes around
  CHECK(functions_on(medium).along() == 5);    // 7 nodes along
  CHECK(functions_on(fine).around() == 32);
  CHECK(functions_on(fine).along() == 5);
}

TEST_CASE("FacesOnCylinder_OfAnUnstructuredBoreAreThoseOfItsNamedSurface") {
  const Mesh mesh = read_mesh(std::filesystem::path(hersey::source_dir()) / "examples/meshes/conrod.msh", 1e-3);
  const FilmCylinder film{.X = {}, .R = 0.0225, .L = 0.0156, .is_bore = true};
  const std::vector<ElementFace> faces = faces_on_cylinder(mesh, film, 2e-4);
  CHECK(faces.size() == faces_called(mesh, "big_end").size());
  const SurfaceFunctions functions = functions_for(mesh, faces, film);
  const FilmSurface surface = must_make(mesh, film, functions, 2e-4);
  const VectorXd one = VectorXd::Ones(functions.count());
  // Quadrature on faces of a coarse, unstructured mesh.
  CHECK(one.dot(surface.G * one) == doctest::Approx(2 * pi * film.R * film.L).epsilon(1e-4));
  CHECK(resultant(mesh, surface.T * one).tail<3>().norm() < 1e-4 * 2 * pi * film.R * film.L);
}

TEST_CASE("Surfaces_ThatAreNoneAreRefusedWithTheReason") {
  const Ring ring;
  const Mesh mesh = ring_mesh(ElementType::hex20, ring);
  const FilmCylinder bore = film_of(ring);
  const SurfaceFunctions functions(16, 4, bore.L);
  const auto message_of = [&](const FilmCylinder& film, const std::vector<ElementFace>& faces, double tolerance) {
    const FilmSurfaceResult result = film_surface(mesh, faces, film, functions, tolerance);
    CHECK_FALSE(result.solved());
    CHECK_FALSE(result.remedy.empty());
    return result.message;
  };
  FilmCylinder small = bore;
  small.R = 0.02;
  CHECK(message_of(small, faces_on_cylinder(mesh, small, 1e-4), 1e-4).find("nearest nodes have a radius of 22.5 mm") !=
        std::string::npos);
  CHECK(message_of(small, mesh.surfaces.at("bore"), 1e-4).find("2.5 mm off the film's 20 mm") != std::string::npos);
  FilmCylinder shaft = bore;
  shaft.is_bore = false;
  CHECK(message_of(shaft, mesh.surfaces.at("bore"), 1e-4).find("that looks towards the axis") != std::string::npos);
  FilmCylinder outside = film_of(ring, false);
  outside.is_bore = true;
  CHECK(message_of(outside, mesh.surfaces.at("outside"), 1e-4).find("that looks away from the axis") !=
        std::string::npos);
  FilmCylinder away = bore;
  away.X.r = {0, 0, 1};
  CHECK(message_of(away, mesh.surfaces.at("bore"), 1e-4).find("no surface at all") != std::string::npos);
  // A film 25 % wider than its bore, and a bore of which a quarter is left out.
  FilmCylinder wide = bore;
  wide.L = 1.25 * ring.width;
  const std::string ends = message_of(wide, mesh.surfaces.at("bore"), 1e-4);
  CHECK(ends.find("covers only 8") != std::string::npos);
  CHECK(ends.find("all around") != std::string::npos);
  std::vector<ElementFace> rest = mesh.surfaces.at("bore");
  std::erase_if(rest, [&](ElementFace face) {
    double x = 0, y = 0;
    for (const int node : nodes_of(mesh, face)) {
      x += mesh.nodes[static_cast<std::size_t>(node)].x();
      y += mesh.nodes[static_cast<std::size_t>(node)].y();
    }
    return x > 0 && y > 0;
  });
  const std::string sector = message_of(bore, rest, 1e-4);
  CHECK(sector.find("covers only 75 % of the film: there is none from 0 to 90 deg, z = -7.8 to 7.8 mm") !=
        std::string::npos);
}

TEST_CASE("AFunctionThatTheSurfaceDoesNotReach_IsRefused") {
  const Ring ring{.cells = {1, 48, 8}};
  const Mesh mesh = ring_mesh(ElementType::hex20, ring);
  std::vector<ElementFace> faces = mesh.surfaces.at("bore");
  // An oil hole at the edge, 1.6 % of the film: what the last functions along see of it is nearly all.
  std::erase_if(faces, [&](ElementFace face) {
    Vector3 middle = Vector3::Zero();
    for (const int node : nodes_of(mesh, face)) middle += mesh.nodes[static_cast<std::size_t>(node)] / 8;
    return middle.z() > 0.375 * ring.width && std::abs(std::atan2(middle.y(), middle.x())) < 3.1 * pi / 24;
  });
  CHECK(faces.size() == 48 * 8 - 6);
  CHECK(film_surface(mesh, faces, film_of(ring), {16, 4, ring.width}, near).solved());
  const FilmSurfaceResult fine = film_surface(mesh, faces, film_of(ring), {48, 7, ring.width}, near);
  CAPTURE(fine.message);
  CHECK_FALSE(fine.solved());
  CHECK(fine.message.find("finer than the surface") != std::string::npos);
}

}  // namespace film_surface_test
}  // namespace hersey::fem
