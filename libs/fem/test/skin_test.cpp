#include "hersey/fem/skin.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <limits>

#include "hersey/fem/mesh_file.h"
#include "source_dir.h"

namespace hersey::fem {
namespace skin_test {

// The block of the readers' tests: a brick of trapezoidal base, one of rectangular base, tetrahedra on the second.
Mesh block() {
  return read_mesh(std::filesystem::path(hersey::source_dir()) / "libs/fem/test/data/block_22.msh", 1e-3);
}

TEST_CASE("Skin_IsClosed_AndHoldsTheBodysVolume") {
  const Mesh mesh = block();
  const Skin surface = skin(mesh);
  double volume = 0;
  Vector3 area = Vector3::Zero();
  for (const std::array<int, 3>& triangle : surface.triangles) {
    std::array<Vector3, 3> r;
    for (std::size_t k = 0; k < 3; ++k)
      r[k] = mesh.nodes[static_cast<std::size_t>(surface.nodes[static_cast<std::size_t>(triangle[k])])];
    volume += r[0].dot(r[1].cross(r[2])) / 6;
    area += (r[1] - r[0]).cross(r[2] - r[0]) / 2;
  }
  const double expected = (10 * (8 + 9) / 2. * 7 + 10 * 9 * 7 + 10 * 9 * 5) * 1e-9;
  // Gmsh places midside nodes to 1e-11 of an edge.
  CHECK(volume == doctest::Approx(expected).epsilon(1e-10));  // of three edges
  CHECK(area.norm() < 64 * std::numeric_limits<double>::epsilon() * 1e-3);
}

TEST_CASE("OuterFaces_AreThoseOfOneElement") {
  // Hexahedra: 2 x 6 faces less 2 between them less 2 to the wedges. Wedges: 4 x 5 less 2 x 2 between layers less 2 x 2
  // across the diagonal less 2 to the hexahedra less 2 to the tetrahedra. Six tetrahedra fill a box: 12 less the
  // floor's 2.
  CHECK(outer_faces(block()).size() == 8 + 8 + 10);
}

}  // namespace skin_test
}  // namespace hersey::fem
