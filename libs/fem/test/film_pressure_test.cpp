#include "hersey/fem/film_pressure.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "hersey/fem/mesh_file.h"
#include "ring_file.h"
#include "seeded_random.h"
#include "temporary_directory.h"

namespace hersey::fem {
namespace film_pressure_test {

TEST_CASE("SurfacePressure_IsTheFilmsAtTheNodesAndCarriesItsForce") {
  const TemporaryDirectory folder;
  std::ofstream(folder / "ring.inp") << RingFile().text();
  const Mesh mesh = read_mesh(folder / "ring.inp", 1e-3);
  const FilmCylinder cylinder{.X = {}, .R = 0.0225, .L = 0.0156, .is_bore = true};
  const FilmSurfaceResult found =
      film_surface(mesh, faces_on_cylinder(mesh, cylinder, 1e-6), cylinder, SurfaceFunctions(16, 3, cylinder.L), 1e-6);
  REQUIRE(found.solved());
  const FilmSurface& surface = *found.surface;

  // A film of 72 x 9 nodes under p = 3 + 2 cos(phi) MPa: force pi R L 2 MPa along x.
  constexpr int around = 72, along = 9;
  const auto pressure = [](double phi) { return 1e6 * (3 + 2 * std::cos(phi)); };
  Eigen::VectorXd phi(around * along), z(around * along), forces(around * along);
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < along; ++j) {
      const int k = i * along + j;
      phi[k] = 2 * std::numbers::pi * i / around;
      z[k] = cylinder.L * (static_cast<double>(j) / (along - 1) - 0.5);
      const double share = j == 0 || j == along - 1 ? 1.0 / 3 : j % 2 == 1 ? 4.0 / 3 : 2.0 / 3;  // Simpson's rule
      forces[k] = share * pressure(phi[k]) * cylinder.R * cylinder.L * 2 * std::numbers::pi / (around * (along - 1));
    }
  const SurfacePressure on_mesh(mesh, surface);
  const Eigen::VectorXd coefficients = on_mesh.coefficients(phi, z, forces);
  Eigen::VectorXd at_nodes = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(mesh.nodes.size()));
  on_mesh.add(coefficients, at_nodes);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const Vector3& x = mesh.nodes[n];
    const double expected = x.head<2>().norm() < 0.023 ? pressure(std::atan2(x.y(), x.x())) : 0;
    CHECK(at_nodes[static_cast<Eigen::Index>(n)] == doctest::Approx(expected).epsilon(0.01));
  }
  const Eigen::VectorXd nodal = surface.T * coefficients;
  double force = 0;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) force += nodal[3 * static_cast<Eigen::Index>(n)];
  CHECK(force == doctest::Approx(2e6 * std::numbers::pi * cylinder.R * cylinder.L).epsilon(0.01));

  // The work on a displacement is that of the film's own forces on it.
  const Eigen::VectorXd u = seeded_random(nodal.size(), 1, 3);
  const Eigen::VectorXd d = surface.coefficients(u);
  double work = 0;
  std::vector<SurfaceTerm> terms;
  for (Eigen::Index k = 0; k < forces.size(); ++k) {
    surface.functions.at(phi[k], z[k], terms);
    for (const SurfaceTerm& term : terms) work += term.value * d[term.index] * forces[k];
  }
  CHECK(nodal.dot(u) == doctest::Approx(work));
}

}  // namespace film_pressure_test
}  // namespace hersey::fem
