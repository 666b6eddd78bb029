#include "hersey/fem/film_radii.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "hersey/fem/mesh_file.h"
#include "hersey/fem/skin.h"
#include "ring_file.h"
#include "temporary_directory.h"

namespace hersey::fem {
namespace film_radii_test {

constexpr double degree = std::numbers::pi / 180;

/// A ring of the given radii whose nodes `move` puts elsewhere, and its bore or outside as a film's surface.
struct Ring {
  Mesh mesh;
  FilmSurface surface;

  template <class Move>
  Ring(bool is_bore, Move move) : surface{{}, {}, SurfaceFunctions(8, 1, 0.0156), {}} {
    const TemporaryDirectory folder;
    std::ofstream(folder / "ring.inp") << RingFile{.along = 6}.text();
    mesh = read_mesh(folder / "ring.inp", 1e-3);
    const FilmCylinder cylinder{.X = {}, .R = is_bore ? 0.0225 : 0.03, .L = 0.0156, .is_bore = is_bore};
    FilmSurfaceResult found =
        film_surface(mesh, faces_on_cylinder(mesh, cylinder, 1e-6), cylinder, SurfaceFunctions(8, 1, cylinder.L), 1e-6);
    REQUIRE(found.solved());
    surface = *found.surface;
    for (Vector3& node : mesh.nodes) node += move(node);
  }
};

Vector3 nowhere(const Vector3&) { return Vector3::Zero(); }

TEST_CASE("SurfaceRadii_OfNodesOnTheCylinder_AreItsRadius") {
  const Ring ring(true, nowhere);  // flat faces of 15 degrees count as round
  const SurfaceRadii radii = surface_radii(ring.mesh, ring.surface);
  // Twelve digits of a file in mm.
  CHECK(radii.deviation.cwiseAbs().maxCoeff() < 1e-12);
  CHECK(std::abs(radii.mean) < 1e-12);
}

TEST_CASE("SurfaceRadii_OfAMovedRing_FollowTheCosine") {
  for (const bool is_bore : {true, false}) {
    CAPTURE(is_bore);
    const double away = 20e-6;
    const Ring ring(is_bore, [&](const Vector3&) { return Vector3(away, 0, 0); });
    const SurfaceRadii radii = surface_radii(ring.mesh, ring.surface);
    for (const double phi : {1.0, 60.0, 179.0, 300.0})
      for (const double z : {-0.0077, 0.001})
        CHECK(radii.at(phi * degree, z) == doctest::Approx(away * std::cos(phi * degree)).epsilon(0.06).scale(away));
    CHECK(std::abs(radii.mean) < 0.02 * away);
    // On the safe side within each field.
    const double side = is_bore ? -1 : 1;
    for (int i = 0; i < SurfaceRadii::around; ++i)
      CHECK(side * (radii.at(SurfaceRadii::phi_of(i), 0) - away * std::cos(SurfaceRadii::phi_of(i))) > -0.01 * away);
  }
}

TEST_CASE("SurfaceRadii_TakeTheWorstInAField") {
  // One row of nodes stands out by 30 um.
  const auto bump = [](const Vector3& node) {
    // Which nodes they are.
    const bool is_there = node.head<2>().norm() < 0.025 && node.x() > 0 && std::abs(node.y()) < 1e-6;
    return is_there ? Vector3(-30e-6, 0, 0) : Vector3(0, 0, 0);
  };
  const Ring ring(true, bump);
  const SurfaceRadii radii = surface_radii(ring.mesh, ring.surface);
  CHECK(radii.at(0.1 * degree, 0) < -28e-6);
  CHECK(radii.at(-0.1 * degree, 0.005) < -28e-6);
  CHECK(radii.at(7.4 * degree, 0) == doctest::Approx(-15e-6).epsilon(0.15));
  CHECK(std::abs(radii.at(20 * degree, 0)) < 1e-12);  // twelve digits of a file in mm
  CHECK(radii.mean == doctest::Approx(-30e-6 / 24).epsilon(0.01));
}

}  // namespace film_radii_test
}  // namespace hersey::fem
