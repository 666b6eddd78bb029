#include "hersey/fem/surface_detection.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "hersey/fem/mesh_file.h"
#include "ring.h"
#include "small_bodies.h"
#include "source_dir.h"

namespace hersey::fem {
namespace surface_detection_test {

constexpr double pi = std::numbers::pi;
// Nodes lie on circles but for round-off, which the fit of a part of a circle enlarges: far below the micrometre of a
// bearing's clearance.
constexpr double kRoundOff = 1e-12;  // m

using Kind = FoundSurface::Kind;
using Use = FoundSurface::Use;

Mesh without_sets(Mesh mesh) {
  mesh.surfaces.clear();
  mesh.node_sets.clear();
  return mesh;
}

const FoundSurface& called(const std::vector<FoundSurface>& found, const std::string& name) {
  std::string names;
  for (const FoundSurface& surface : found) names += surface.name + " ";
  CAPTURE(names);
  const auto surface = std::find_if(found.begin(), found.end(), [&](const auto& s) { return s.name == name; });
  REQUIRE_MESSAGE(surface != found.end(), name);
  return *surface;
}

std::vector<std::string> names_of(const std::vector<FoundSurface>& found) {
  std::vector<std::string> names;
  for (const FoundSurface& surface : found) names.push_back(surface.name);
  return names;
}

Vector3 centre_of(const Mesh& mesh, const Element& element) {
  Vector3 centre = Vector3::Zero();
  for (int k = 0; k < node_count(element.type); ++k)
    centre += mesh.nodes[static_cast<std::size_t>(mesh.nodes_of(element)[k])] / node_count(element.type);
  return centre;
}

/// Takes out the elements whose centres `is_out` holds for.
template <typename IsOut>
Mesh cut(Mesh mesh, const IsOut& is_out) {
  std::erase_if(mesh.elements, [&](const Element& element) { return is_out(centre_of(mesh, element)); });
  return mesh;
}

/// On a square of half side a with corners rounded by r, at a share of its whole length; a third of each quarter is a
/// corner.
Vector3 on_rounded_square(double share, double a, double r) {
  const double quarter = std::floor(share * 4), along = 3 * (share * 4 - quarter);  // 0..3
  Eigen::Vector2d x(a, along * (a - r));
  if (along > 2) x = {(3 - along) * (a - r), a};
  if (along > 1 && along <= 2)
    x = Eigen::Vector2d(a - r, a - r) +
        r * Eigen::Vector2d(std::cos((along - 1) * pi / 2), std::sin((along - 1) * pi / 2));
  const Eigen::Vector2d rotated = Eigen::Rotation2Dd(quarter * pi / 2) * x;
  return {rotated.x(), rotated.y(), 0};
}

/// A ring one of whose sides is a rounded square: a block with a bore, or a pocket in a disc.
Mesh block_with_bore(ElementType type, bool square_is_outside) {
  const Ring ring{0.010, 0.030, 0.020, {3, 48, 4}};
  Mesh mesh = without_sets(ring_mesh(type, ring));
  for (Vector3& x : mesh.nodes) {
    const double share = std::fmod(std::atan2(x.y(), x.x()) / (2 * pi) + 1 + 1e-12, 1.0);
    const double outwards = (std::hypot(x.x(), x.y()) - ring.inner) / (ring.outer - ring.inner);
    const Vector3 round = (square_is_outside ? 0.010 : 0.030) * Vector3(x.x(), x.y(), 0).normalized();
    const Vector3 square =
        square_is_outside ? on_rounded_square(share, 0.030, 0.006) : on_rounded_square(share, 0.014, 0.006);
    const double to_square = square_is_outside ? outwards : 1 - outwards;
    const double z = x.z();
    x = round + to_square * (square - round);
    x.z() = z;
  }
  return mesh;
}

TEST_CASE("HollowCylinder_IsABore_AJournal_AndTwoPlanes_InEveryElement") {
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const Ring ring;
    const std::vector<FoundSurface> found = find_surfaces(without_sets(ring_mesh(type, ring)));
    REQUIRE(names_of(found) ==
            std::vector<std::string>{"bore_d45_at_0_0_0", "journal_d60_at_0_0_0", "plane_z_min", "plane_z_max"});
    for (const bool is_bore : {true, false}) {
      const FoundSurface& surface = found[is_bore ? 0 : 1];
      const double radius = is_bore ? ring.inner : ring.outer;
      CHECK(std::abs(surface.radius - radius) < kRoundOff);
      CHECK(std::abs(surface.width - ring.width) < kRoundOff);
      CHECK(surface.centre.norm() < kRoundOff);
      CHECK((surface.axis - Vector3::UnitZ()).norm() < kRoundOff / radius);
      CHECK(surface.arc == doctest::Approx(2 * pi).epsilon(kRoundOff / radius));
      CHECK(surface.is_internal == is_bore);
      CHECK(surface.use() == (is_bore ? Use::bore : Use::journal));
      // 24 flat facets have sin(x)/x of the area, x half of their angle; curved ones all but (x^4 / 30).
      const double x = pi / 24;
      CHECK(surface.cover > std::sin(x) / x - kRoundOff / radius);
      CHECK(surface.cover < 1 + std::pow(x, 4));
    }
    CHECK(found[2].kind == Kind::plane);
    CHECK((found[2].axis + Vector3::UnitZ()).norm() < kRoundOff / ring.inner);
  }
}

TEST_CASE("CylinderInAnyDirection_IsFoundToAMillionthOfItsRadius") {
  const Vector3 axis = Vector3(0.48, 0.64, -0.6).normalized(), centre(0.1, -0.2, 0.3);
  for (const ElementType type : {ElementType::tet4, ElementType::tet10}) {
    Mesh mesh = without_sets(ring_mesh(type, {}));
    const Eigen::Quaterniond rotation = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), axis);
    for (Vector3& x : mesh.nodes) x = rotation * x + centre;
    const FoundSurface& bore = called(find_surfaces(mesh), "bore_d45_at_100_-200_300");
    CHECK(std::abs(bore.radius - 0.0225) < 1e-6 * 0.0225);  // what a user needs; round-off is 1e-15
    CHECK(bore.axis.cross(axis).norm() < 1e-9);             // of round-off by the width, 0.0156 m
    CHECK((bore.centre - centre).norm() < kRoundOff);
    CHECK(bore.axis.y() > 0);
  }
}

TEST_CASE("RoundedBlock_HasItsBore_AndRoundingsThatAreNoJournals") {
  for (const ElementType type : {ElementType::wedge6, ElementType::hex8, ElementType::tet10, ElementType::hex20}) {
    CAPTURE(name_of(type));
    const std::vector<FoundSurface> found = find_surfaces(block_with_bore(type, true));
    CHECK(called(found, "bore_d20_at_0_0_0").use() == Use::bore);
    const FoundSurface& corner = called(found, "rounding_d12_at_24_-24_0");
    CHECK(corner.use() == Use::none);
    CHECK(corner.arc == doctest::Approx(pi / 2).epsilon(1e-9));  // angles of corners by arctangents
    CHECK_FALSE(corner.is_internal);
    for (const char* plane : {"plane_x_min", "plane_x_max", "plane_y_min", "plane_y_max", "plane_z_min", "plane_z_max"})
      CHECK(called(found, plane).kind == Kind::plane);
    CHECK(found.size() == 1 + 4 + 6);
    CHECK(called(found, "plane_x_max").area == doctest::Approx(2 * 0.024 * 0.020).epsilon(1e-9));  // sums of areas
  }
}

TEST_CASE("FilletsOfAPocket_AreNoBores") {
  for (const ElementType type : {ElementType::hex8, ElementType::tet10}) {
    CAPTURE(name_of(type));
    const std::vector<FoundSurface> found = find_surfaces(block_with_bore(type, false));
    const FoundSurface& fillet = called(found, "rounding_d12_at_8_8_0");
    CHECK(fillet.is_internal);
    CHECK(fillet.runs_into_neighbours);
    for (const FoundSurface& surface : found) CHECK(surface.use() != Use::bore);
    CHECK(found.front().name == "journal_d60_at_0_0_0");
  }
}

TEST_CASE("BoreInTwoHalves_IsOneBore") {
  // Two cells are taken out, at 0 and 180 degrees: the halves do not touch, 11/12 of the circle remain.
  const Ring ring{0.0225, 0.03, 0.0156, {1, 24, 2}};
  for (const ElementType type : {ElementType::hex8, ElementType::tet10}) {
    const Mesh mesh = cut(without_sets(ring_mesh(type, ring)), [](const Vector3& x) {
      const double cell = std::floor(std::fmod(std::atan2(x.y(), x.x()) / (2 * pi) + 1, 1.0) * 24);
      return cell == 0 || cell == 12;
    });
    const std::vector<FoundSurface> found = find_surfaces(mesh);
    const FoundSurface& bore = called(found, "bore_d45_at_0_0_0");
    CHECK(bore.use() == Use::bore);
    CHECK(bore.arc == doctest::Approx(2 * pi * 11 / 12).epsilon(1e-9));  // angles of corners by arctangents
    CHECK(std::abs(bore.radius - ring.inner) < kRoundOff);
    CHECK(std::count_if(found.begin(), found.end(), [](const auto& s) { return s.use() == Use::bore; }) == 1);
  }
}

TEST_CASE("HalfABore_CouldBeABearing_ItsSidesAreEdges") {
  const Mesh mesh = cut(without_sets(ring_mesh(ElementType::hex20, {})), [](const Vector3& x) { return x.y() > 0; });
  const FoundSurface& bore = called(find_surfaces(mesh), "bore_d45_at_0_0_0");
  CHECK(bore.arc == doctest::Approx(pi).epsilon(1e-9));  // angles of corners by arctangents
  CHECK_FALSE(bore.runs_into_neighbours);
}

TEST_CASE("BoreWithAnOilHole_IsStillOneBore") {
  const Ring ring{0.0225, 0.03, 0.018, {2, 24, 6}};
  const Mesh mesh = cut(without_sets(ring_mesh(ElementType::hex20, ring)), [](const Vector3& x) {
    return std::abs(x.z()) < 0.003 && x.x() > 0 && std::abs(std::atan2(x.y(), x.x())) < pi / 12;
  });
  const FoundSurface& bore = called(find_surfaces(mesh), "bore_d45_at_0_0_0");
  CHECK(bore.arc == doctest::Approx(2 * pi).epsilon(1e-9));  // angles of corners by arctangents
  // Two of 24 by two of six fields are gone; parabolas are shorter than arcs by (pi/24)^4/30 at most.
  CHECK(bore.cover == doctest::Approx(1 - 4.0 / 144).epsilon(std::pow(pi / 24, 4)));
}

TEST_CASE("LandsBesideAGroove_AreOneBore_ButBearingsInARow_AreNot") {
  const Ring ring{0.0225, 0.03, 0.018, {2, 24, 6}};
  const auto without_layer = [&](double half_width) {
    return find_surfaces(cut(without_sets(ring_mesh(ElementType::hex8, ring)), [&](const Vector3& x) {
      return std::abs(x.z()) < half_width && std::hypot(x.x(), x.y()) < 0.02625;
    }));
  };
  // Two layers of six are away: lands of 6 mm, 6 mm apart.
  const std::vector<FoundSurface> apart = without_layer(0.003);
  CHECK(called(apart, "bore_d45_at_0_0_-6").width == doctest::Approx(0.006).epsilon(1e-9));  // sums of coordinates
  CHECK(called(apart, "bore_d45_at_0_0_6").use() == Use::bore);
  Ring fine = ring;
  fine.cells = {2, 24, 9};
  const std::vector<FoundSurface> grooved =
      find_surfaces(cut(without_sets(ring_mesh(ElementType::hex8, fine)), [&](const Vector3& x) {
        return std::abs(x.z()) < 0.001 && std::hypot(x.x(), x.y()) < 0.02625;
      }));
  const FoundSurface& bore = called(grooved, "bore_d45_at_0_0_0");
  CHECK(bore.width == doctest::Approx(0.018).epsilon(1e-9));  // sums of coordinates
  CHECK(bore.cover < 0.9);
  CHECK(called(grooved, "hole_d52.5_at_0_0_0").use() == Use::none);  // the groove's floor, a 26th of its diameter wide
}

TEST_CASE("SlightlyCurvedFace_IsNotReported_AndItsEdgesArePlanes") {
  // 10 degrees of a cylinder of 0.3 m: a plane it is not, nor a cylinder that a bearing could have.
  Mesh mesh = without_sets(box_mesh(ElementType::hex20, {0.05, 0.05, 0.02}, {12, 12, 2}));
  for (Vector3& x : mesh.nodes) x.z() += x.z() / 0.02 * (std::sqrt(0.09 - std::pow(x.x() - 0.025, 2)) - 0.3);
  std::vector<std::string> names = names_of(find_surfaces(mesh));
  std::sort(names.begin(), names.end());
  CHECK(names == std::vector<std::string>{"plane_x_max", "plane_x_min", "plane_y_max", "plane_y_min", "plane_z_min"});
}

TEST_CASE("Prism_OfSixSides_HasPlanes_AndNoCylinder") {
  const Ring ring{0.01, 0.02, 0.01, {1, 6, 2}};
  const std::vector<FoundSurface> found = find_surfaces(without_sets(ring_mesh(ElementType::hex8, ring)));
  CHECK(found.size() == 14);
  for (const FoundSurface& surface : found) CHECK(surface.kind == Kind::plane);
}

TEST_CASE("ConesAndTori_AreNoCylinders_AndNotPlanes") {
  for (const ElementType type : {ElementType::hex8, ElementType::tet10, ElementType::hex20}) {
    CAPTURE(name_of(type));
    const Ring ring{0.0225, 0.03, 0.03, {1, 48, 6}};
    const Mesh straight = without_sets(ring_mesh(type, ring));
    for (const bool is_cone : {true, false}) {
      Mesh mesh = straight;
      for (Vector3& x : mesh.nodes) {
        const double r = std::hypot(x.x(), x.y()), share = (r - ring.inner) / (ring.outer - ring.inner);
        const double outer = is_cone ? 0.035 + 0.1 * x.z() : 0.03 + std::sqrt(0.03 * 0.03 - x.z() * x.z()) - 0.02;
        const double to = ring.inner + share * (outer - ring.inner);
        x = Vector3(x.x() * to / r, x.y() * to / r, x.z());
      }
      std::vector<std::string> names = names_of(find_surfaces(mesh));
      std::sort(names.begin(), names.end());
      CHECK(names == std::vector<std::string>{"bore_d45_at_0_0_0", "plane_z_max", "plane_z_min"});
    }
  }
}

TEST_CASE("SurfaceThatTheMeshNames_KeepsItsName_AndOthersAreAdded") {
  Mesh mesh = ring_mesh(ElementType::hex8, {});
  mesh.surfaces.erase("outside");
  const std::vector<FoundSurface> found = find_surfaces(mesh);
  CHECK(names_of(found) == std::vector<std::string>{"bore", "journal_d60_at_0_0_0", "bottom", "top"});
  const std::size_t surfaces = mesh.surfaces.size();
  add_surfaces(mesh, found);
  CHECK(mesh.surfaces.size() == surfaces + 1);
  CHECK(mesh.surfaces.at("journal_d60_at_0_0_0").size() == 24 * 4);
  CHECK(mesh.node_sets.at("journal_d60_at_0_0_0") == mesh.node_sets.at("outside"));
}

TEST_CASE("ExampleParts_HaveTheBoresAndJournalsOfTheirPages") {
  const auto uses = [](const char* file, Use use) {
    std::vector<std::string> names;
    const auto path = std::filesystem::path(hersey::source_dir()) / "examples/meshes" / file;
    for (const FoundSurface& surface : find_surfaces(read_mesh(path, 1e-3)))
      if (surface.use() == use) names.push_back(surface.name);
    return names;
  };
  CHECK(uses("conrod.msh", Use::bore) == std::vector<std::string>{"big_end", "small_end"});
  CHECK(uses("bearing_housing.msh", Use::bore).front() == "bore");
  const std::vector<std::string> journals = uses("crankshaft.msh", Use::journal);
  for (const std::string journal : {"main_1", "main_2", "main_5", "pin_1", "pin_4"})
    CHECK(std::count(journals.begin(), journals.end(), journal) == 1);
}

TEST_CASE("BodyOfBeams_HasNoSurfaces") {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}};
  mesh.node_labels = {1, 2};
  mesh.connectivity = {0, 1};
  mesh.elements = {{.type = ElementType::beam2, .label = 1, .first = 0}};
  CHECK(find_surfaces(mesh).empty());
}

}  // namespace surface_detection_test
}  // namespace hersey::fem
