#include "hersey/fem/face_pressures.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "hersey/fem/film_surface.h"
#include "ring.h"
#include "small_bodies.h"

namespace hersey::fem {
namespace face_pressures_test {

using Eigen::VectorXd;

constexpr double round_off_of_sums = 1e-11;  // over hundreds of faces
constexpr double near = 1e-9;                // m: ring meshes lie on their circles but for round-off

/// A pressure that pushes to one side and tilts.
double pressure(double phi, double z) { return 2e7 * std::pow(std::max(0.0, std::cos(phi - 1)), 3) * (1 + 40 * z); }

FacePressures on(const Mesh& mesh, const FilmCylinder& film) {
  return {mesh, faces_on_cylinder(mesh, film, near), film};
}

TEST_CASE("Pressures_HaveTheWrenchThatIsAsked") {
  for (const ElementType type : solids)
    for (const bool is_bore : {true, false}) {
      CAPTURE(name_of(type));
      const Ring ring;
      const Mesh mesh = ring_mesh(type, ring);
      const FacePressures faces = on(mesh, film_of(ring, is_bore));
      const VectorXd p = faces.means(pressure);
      const Vector6 of_mean = faces.wrenches() * p;
      // Any force across the axis and moment about an axis across it, near those of the mean pressures.
      Vector6 wrench = of_mean;
      wrench.head<3>() += Vector3(0.03, -0.02, 0) * of_mean.tail<3>().norm() * ring.width;
      wrench.tail<3>() += Vector3(-0.02, 0.04, 0) * of_mean.tail<3>().norm();
      const VectorXd corrected = faces.with_wrench(p, wrench);
      const Vector6 off = faces.wrenches() * corrected - wrench;
      const double size = wrench.tail<3>().norm();
      CHECK(off.tail<3>().head<2>().norm() < round_off_of_sums * size);
      CHECK(off.head<2>().norm() < round_off_of_sums * size * ring.width);
      for (Eigen::Index f = 0; f < p.size(); ++f) {
        if (p[f] == 0) CHECK(corrected[f] == 0);
        CHECK(std::abs(corrected[f] - p[f]) <= 0.5 * p[f]);  // a change of the force by 4 %, spread over half the bore
      }
    }
}

TEST_CASE("Pressures_ThatHaveTheWrenchStay") {
  const Ring ring;
  const Mesh mesh = ring_mesh(ElementType::hex20, ring);
  const FacePressures faces = on(mesh, film_of(ring));
  const VectorXd p = faces.means(pressure), none = VectorXd::Zero(p.size());
  CHECK((faces.with_wrench(p, faces.wrenches() * p) - p).norm() < round_off_of_sums * p.norm());
  CHECK(faces.with_wrench(none, faces.wrenches() * p) == none);
}

TEST_CASE("Correction_FallsWithTheSquareOfTheMeshWidth") {
  const auto correction = [](int around) {
    const Ring ring{.cells = {1, around, around / 6}};
    const Mesh mesh = ring_mesh(ElementType::hex8, ring);
    const FacePressures faces = on(mesh, film_of(ring));
    const VectorXd p = faces.means(pressure);
    Vector6 wrench = Vector6::Zero();  // of the smooth pressure, by a fine sum
    constexpr int many = 600;
    for (int i = 0; i < many; ++i)
      for (int k = 0; k < many; ++k) {
        const double phi = 2 * std::numbers::pi * (i + 0.5) / many, z = ring.width * ((k + 0.5) / many - 0.5);
        const double force = pressure(phi, z) * 2 * std::numbers::pi * ring.inner * ring.width / (many * many);
        const Vector3 e_r(std::cos(phi), std::sin(phi), 0);
        wrench.tail<3>() += force * e_r;
        wrench.head<3>() += force * Vector3(0, 0, z).cross(e_r);
      }
    return (faces.with_wrench(p, wrench) - p).norm() / p.norm();
  };
  const double coarse = correction(24), fine = correction(48);
  CHECK(coarse / fine == doctest::Approx(4).epsilon(0.1));  // the error's next term
}

TEST_CASE("FieldOfAFace_IsItsMean") {
  const Ring ring;
  const Mesh mesh = ring_mesh(ElementType::hex20, ring);
  FilmCylinder film = film_of(ring);
  film.L = 0.6 * ring.width;  // its edges cut faces
  const FacePressures faces = on(mesh, film);
  const VectorXd one = faces.means([](double, double) { return 1; }),
                 within = faces.means_within([](double, double) { return 7; });
  const auto areas = faces.wrenches().bottomRows<3>().colwise().norm();
  double covered = 0;
  for (Eigen::Index f = 0; f < one.size(); ++f) {
    CHECK(one[f] < 1 + 1e-5);  // the area on the cylinder over that of the parabola through its nodes
    CHECK(within[f] == doctest::Approx(7).epsilon(round_off_of_sums));
    covered += one[f] * areas[f];
  }
  // Chords of an arc of 15 deg are shorter by 15 deg^2/24.
  CHECK(covered == doctest::Approx(2 * std::numbers::pi * film.R * film.L).epsilon(0.003));
}

}  // namespace face_pressures_test
}  // namespace hersey::fem
