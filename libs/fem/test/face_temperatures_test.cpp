#include "hersey/fem/face_temperatures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hersey/fem/film_surface.h"
#include "ring.h"
#include "small_bodies.h"

namespace hersey::fem {
namespace face_temperatures_test {

using Eigen::VectorXd;

constexpr double round_off = 1e-11;  // over hundreds of faces
constexpr double near = 1e-9;        // m: ring meshes lie on their circles but for round-off

/// A film that warms along its circumference and away from its middle [degC].
double temperature(double phi, double z) { return 80 + 12 * std::cos(phi - 2) + 3 * std::sin(3 * phi) + 1e5 * z * z; }

FaceTemperatures on(const Mesh& mesh, const FilmCylinder& film) {
  return {mesh, faces_on_cylinder(mesh, film, near), film};
}

/// Largest difference at the nodes from the film's own temperature there.
double error_of(const Mesh& mesh, const FilmCylinder& film) {
  const FaceTemperatures faces = on(mesh, film);
  // Mean of temperature() over the cylinder: the mean of z^2 is L^2/12.
  const double mean = 80 + 1e5 * film.L * film.L / 12;
  const VectorXd T = faces.of(temperature, mean);
  double worst = 0;
  for (std::size_t a = 0; a < faces.nodes().size(); ++a) {
    const Vector3& x = mesh.nodes[static_cast<std::size_t>(faces.nodes()[a])];
    worst = std::max(worst, std::abs(T[static_cast<Eigen::Index>(a)] - temperature(std::atan2(x.y(), x.x()), x.z())));
  }
  return worst;
}

TEST_CASE("NodalTemperatures_HaveTheFilmsMean") {
  for (const ElementType type : solids)
    for (const bool is_bore : {true, false}) {
      CAPTURE(name_of(type));
      const Ring ring;
      const Mesh mesh = ring_mesh(type, ring);
      const FaceTemperatures faces = on(mesh, film_of(ring, is_bore));
      for (const double mean : {80.0, 84.5}) {  // whatever the film's own mean is, by its own weights
        const VectorXd T = faces.of(temperature, mean);
        CHECK(faces.mean(T) == doctest::Approx(mean).epsilon(round_off));
      }
      CHECK(faces.mean(VectorXd::Ones(static_cast<Eigen::Index>(faces.nodes().size()))) ==
            doctest::Approx(1).epsilon(round_off));
    }
}

TEST_CASE("UniformTemperature_IsMetAtEveryNode") {
  for (const ElementType type : solids) {
    const Ring ring;
    const Mesh mesh = ring_mesh(type, ring);
    FilmCylinder film = film_of(ring);
    film.L = 0.6 * ring.width;  // faces reach beyond it
    const FaceTemperatures faces = on(mesh, film);
    const VectorXd T = faces.of([](double, double) { return 71.3; }, 71.3);
    CHECK((T.array() == 71.3).all());
  }
}

TEST_CASE("NodalTemperatures_ConvergeToTheFilmsWithTheOrderOfTheFaces") {
  const auto rate_of = [](ElementType type) {
    const Ring coarse{.cells = {1, 24, 4}}, fine{.cells = {1, 48, 8}};
    return std::log2(error_of(ring_mesh(type, coarse), film_of(coarse)) /
                     error_of(ring_mesh(type, fine), film_of(fine)));
  };
  // Faces of 15 deg are not yet small against a wave of 120 deg.
  CHECK(rate_of(ElementType::hex8) > 1.8);
  CHECK(rate_of(ElementType::hex20) > 2.7);
}

TEST_CASE("RotatedMesh_TakesTheSameTemperatures") {
  const Ring ring;
  const Mesh mesh = ring_mesh(ElementType::hex20, ring);
  const FilmCylinder film = film_of(ring);
  const VectorXd T = on(mesh, film).of(temperature, 82);
  const Pose X{.R = Eigen::AngleAxisd(0.7, Vector3(1, 2, -1).normalized()).toRotationMatrix(), .r = {0.1, -0.2, 0.05}};
  Mesh moved = mesh;
  for (Vector3& x : moved.nodes) x = X * x;
  FilmCylinder with_it = film;
  with_it.X = X;
  const VectorXd T_moved = on(moved, with_it).of(temperature, 82);
  CHECK((T_moved - T).lpNorm<Eigen::Infinity>() < 1e-9);  // K: round-off of angles times the film's slope
}

}  // namespace face_temperatures_test
}  // namespace hersey::fem
