#include "hersey/fem/load_distributions.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "hersey/fem/mesh_file.h"
#include "small_bodies.h"
#include "source_dir.h"

namespace hersey::fem {
namespace load_distributions_test {

double total(const Eigen::VectorXd& f, int axis) {
  double sum = 0;
  for (Eigen::Index i = axis; i < f.size(); i += 3) sum += f[i];
  return sum;
}

TEST_CASE("FacesCalled_FindsSurfacesAndFacesOfNodeSets") {
  const Vector3 size(0.3, 0.2, 0.5);
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    Mesh mesh = box_mesh(type, size, {2, 3, 2});
    const std::size_t faces = mesh.surfaces.at("y1").size();
    mesh.surfaces.erase("y1");
    CHECK(faces_called(mesh, "y1").size() == faces);
    // Round-off of sums over faces.
    CHECK(area_of(mesh, faces_called(mesh, "y1")) == doctest::Approx(0.15).epsilon(1e-13));
    CHECK(faces_called(mesh, "nowhere").empty());
    // Faces between two elements are no surface.
    std::vector<int> all(mesh.nodes.size());
    std::iota(all.begin(), all.end(), 0);
    // Round-off of sums over faces.
    CHECK(area_of(mesh, outer_faces(mesh, all)) == doctest::Approx(2 * (0.06 + 0.15 + 0.1)).epsilon(1e-13));
  }
}

TEST_CASE("CosinePressure_OnABoreSumsUpToAQuarterOfPiTimesDiameterAndWidth") {
  const Mesh mesh = read_mesh(std::filesystem::path(hersey::source_dir()) / "examples/meshes/conrod.msh", 1e-3);
  const std::vector<ElementFace> faces = faces_called(mesh, "big_end");
  const Vector3 towards = Vector3(0.6, 0.8, 0);
  const Eigen::VectorXd f = cosine_pressure_load(mesh, faces, towards);
  const double R = 0.0225, L = 0.0156, force = std::numbers::pi / 2 * R * L;
  CHECK(total(f, 0) == doctest::Approx(0.6 * force).epsilon(2e-3));  // the bore's facets are parabolas, and few
  CHECK(total(f, 1) == doctest::Approx(0.8 * force).epsilon(2e-3));
  CHECK(std::abs(total(f, 2)) < 1e-8 * force);  // the mesh file has nine digits
}

TEST_CASE("SpreadForce_IsOneNewtonHoweverLargeItsFaces") {
  const Mesh mesh = box_mesh(ElementType::tet10, {0.3, 0.2, 0.5}, {2, 3, 1});
  const Eigen::VectorXd f = spread_force(mesh, faces_called(mesh, "z0"), Vector3(0, 0.6, -0.8));
  CHECK(std::abs(total(f, 0)) < 1e-14);  // round-off
  // Round-off of sums over faces.
  CHECK(total(f, 1) == doctest::Approx(0.6).epsilon(1e-13));
  CHECK(total(f, 2) == doctest::Approx(-0.8).epsilon(1e-13));
}

}  // namespace load_distributions_test
}  // namespace hersey::fem
