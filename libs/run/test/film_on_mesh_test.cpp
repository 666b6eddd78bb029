// Pressures of films on meshes, in the files for ParaView; maps of films over angle and time.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>

#include "hersey/core/input_error.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "meshed_bearing.h"
#include "ring_file.h"
#include "small_rig.h"
#include "temporary_directory.h"
#include "vtu_field.h"

namespace hersey::run {
namespace film_on_mesh_test {

/// A hollow shaft rotating in a ring, both meshes.
const std::string machine =
    MeshedBearing{
        .title = "A hollow shaft in a ring",
        .ring = {"ring.inp", "modes: 2\ndamping: {stiffness: 2 us}", kHub},
        .shaft = {"shaft.inp", "modes: 2\ndamping: {stiffness: 2 us}", kPin},
        .journal = "shaft.pin",
        .initial = "{rotation: 25 deg}",
        .film =
            "grid: {circumferential: 48, axial: 9}\n"
            "asperities: {model: greenwood_tripp, roughness: 2 um, elastic_factor: 0.003, composite_modulus: 115 GPa}\n"
            "shell_surface: {faces: bore, modes: 12}\n"
            "journal_surface: {within: 0.1 mm, modes: 12}",
        .sections = "output: {meshes_at: [0.35 ms, 1 ms, 0.8 ms]}"}
        .text();

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

struct Run {
  TemporaryDirectory folder;
  std::filesystem::path results;

  Run() : results(folder / "r.h5") {
    std::ofstream(folder / "ring.inp") << ring().text();
    std::ofstream(folder / "shaft.inp") << shaft().text();
    std::ofstream(folder / "model.yaml") << machine;
    const Summary summary = simulate(model::read(folder / "model.yaml"), {.results = results});
    INFO(summary.message);
    REQUIRE(summary.status == Status::completed);
  }

  static RingFile ring() { return {.around = 48, .along = 6}; }
  static RingFile shaft() { return {.inner = 12, .outer = 22.466, .around = 48, .along = 6}; }
};

/// Force on the nodes at `radius` by pressures on the nodes of a mesh, in its axes: sums around, Simpson's rule along.
Eigen::Vector2d resultant(const RingFile& ring, const fem::Mesh& mesh, const std::vector<double>& pressure,
                          double radius) {
  REQUIRE(pressure.size() == mesh.nodes.size());
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  const double arc = 2 * std::numbers::pi / ring.around * 0.0225, length = 1e-3 * ring.width / ring.along;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const Vector3& x = mesh.nodes[n];
    if (std::abs(x.head<2>().norm() - radius) > 1e-4) {
      CHECK(pressure[n] == 0);
      continue;
    }
    const auto row = static_cast<int>(std::lround((x.z() + 0.5e-3 * ring.width) / length));
    const double simpson = row == 0 || row == ring.along ? 1.0 / 3 : row % 2 == 1 ? 4.0 / 3 : 2.0 / 3;
    force += pressure[n] * simpson * arc * length * x.head<2>().normalized();
  }
  return force;
}

TEST_CASE("FilmPressureOnMeshes_HasTheFilmsForce_AtTheChosenTimes") {
  const Run run;
  const results::Reader reader(run.results);
  const std::vector<double> time = reader.read("/time").values;
  const std::vector<double> of_pressure = reader.read("/bearings/main/force_pressure").values;
  const std::vector<double> of_contact = reader.read("/bearings/main/force_asperity").values;
  const std::vector<double> turned = reader.read("/joints/slide/coordinates").values;
  const std::size_t width = turned.size() / time.size();
  const fem::Mesh ring = fem::read_mesh(run.folder / "ring.inp", 1e-3);
  const fem::Mesh shaft = fem::read_mesh(run.folder / "shaft.inp", 1e-3);
  const auto of_ring = files_in(run.folder / "r_ring"), of_shaft = files_in(run.folder / "r_shaft");
  REQUIRE(of_ring.size() == 3);
  REQUIRE(of_shaft.size() == 3);
  const double expected[] = {0.4e-3, 0.8e-3, 1e-3};  // the first step at 0.35 ms or beyond
  for (std::size_t file = 0; file < 3; ++file) {
    // The instant itself.
    const auto row = static_cast<std::size_t>(
        std::find_if(time.begin(), time.end(), [&](double t) { return std::abs(t - expected[file]) < 1e-9; }) -
        time.begin());
    REQUIRE(row < time.size());
    const Eigen::Vector2d contact(of_contact[3 * row], of_contact[3 * row + 1]);
    const Eigen::Vector2d all = Eigen::Vector2d(of_pressure[3 * row], of_pressure[3 * row + 1]) + contact;
    REQUIRE(all.norm() > 300);
    const Eigen::Vector2d on_ring = resultant(Run::ring(), ring, field_of(of_ring[file], "film_pressure"), 0.0225);
    CHECK((on_ring - all).norm() < 0.01 * all.norm());
    const Eigen::Vector2d touching = resultant(Run::ring(), ring, field_of(of_ring[file], "contact_pressure"), 0.0225);
    // Quadrature on the mesh of a contact that is small beside the whole.
    CHECK((touching - contact).norm() < 0.02 * contact.norm() + 1e-3 * all.norm());
    // The shaft has rotated beneath the film, which pushes it the other way.
    double angle = 0;
    for (std::size_t k = 0; k < width; ++k) angle = k + 1 == width ? turned[row * width + k] : angle;
    const Eigen::Vector2d on_shaft =
        resultant(Run::shaft(), shaft, field_of(of_shaft[file], "film_pressure"), 0.022466);
    CHECK((Eigen::Rotation2Dd(angle) * on_shaft - all).norm() < 0.01 * all.norm());
    // Stress is there, and largest where the film pushes.
    const std::vector<double> stress = field_of(of_ring[file], "von_mises");
    CHECK(*std::max_element(stress.begin(), stress.end()) > 0.2e6);
  }
}

TEST_CASE("DeformedMesh_MovesAsTheFilmSeesItsSurface") {
  // Displacements, and with them stresses, contain the responses to film pressure: most of the deformation of a bore.
  const Run run;
  const results::Reader reader(run.results);
  const std::vector<double> pressures = reader.read("/bearings/main/fields/shell_displacement").values;
  constexpr std::size_t nodes = 48 * 9;
  REQUIRE(pressures.size() >= nodes);
  const auto last = pressures.end() - static_cast<std::ptrdiff_t>(nodes);
  const double most = *std::max_element(last, pressures.end());
  const fem::Mesh ring = fem::read_mesh(run.folder / "ring.inp", 1e-3);
  const std::vector<double> u = field_of(files_in(run.folder / "r_ring").back(), "displacement");
  double radial = 0;
  for (std::size_t n = 0; n < ring.nodes.size(); ++n) {
    const Eigen::Vector2d x = ring.nodes[n].head<2>();
    if (x.norm() < 0.023) radial = std::max(radial, Eigen::Vector2d(u[3 * n], u[3 * n + 1]).dot(x.normalized()));
  }
  CHECK(radial > 0.05e-6);
  CHECK(radial == doctest::Approx(most).epsilon(0.03));
}

TEST_CASE("FilmsOnSurfacesThatDeform_TakeNoLeadIn") {
  const TemporaryDirectory folder;
  std::ofstream(folder / "ring.inp") << Run::ring().text();
  std::ofstream(folder / "shaft.inp") << Run::shaft().text();
  std::ofstream(folder / "model.yaml") << machine;
  CHECK_THROWS_WITH_AS(
      (void)model::read(folder / "model.yaml", {"simulation.cycle={period: 0.5 ms, lead_in: half_grids}"}),
      doctest::Contains("a lead-in of films on half grids between surfaces that deform"), InputError);
}

TEST_CASE("MeshesAt_AnglesComeAgainInEveryCycle") {
  const model::Model model =
      rig(rig_with("  duration: \"${duration}\"\n", "  cycle: {period: 360 deg, until_converged: 0, most: 3}\n") +
          "output: {meshes_at: [90 deg, 1 ms]}\n");
  const std::vector<double> expected{1e-3, 5e-3, 25e-3, 45e-3};  // a revolution lasts 20 ms
  REQUIRE(model.output.meshes_at.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) CHECK(model.output.meshes_at[i] == doctest::Approx(expected[i]));
  try {
    (void)rig(kSmallRig + "output: {meshes_at: [1 ms, 5 ms]}\n");
    FAIL("accepted");
  } catch (const InputError& error) {
    CHECK(error.faults().front().path == "output.meshes_at.1");
    CHECK(error.faults().front().found == "a mesh after the end of the run");
  }
}

TEST_CASE("MapsOverAngleAndTime_AreTheExtremesOverTheWidth") {
  const TemporaryDirectory scratch;
  const model::Model model = rig(kSmallRig + "output: {fields_every: 2 deg, every: 2}\n");
  REQUIRE(simulate(model, {.results = scratch / "r.h5"}).status == Status::completed);
  const results::Reader reader(scratch / "r.h5");
  const std::vector<double> time = reader.read("/time").values;
  const std::vector<double> of_fields = reader.read("/bearings/big_end/fields/time").values;
  const results::Array h = reader.read("/bearings/big_end/h_min_around"),
                       p = reader.read("/bearings/big_end/p_max_around");
  const std::vector<double> thickness = reader.read("/bearings/big_end/fields/thickness").values;
  const std::vector<double> pressure = reader.read("/bearings/big_end/fields/pressure").values;
  constexpr std::size_t n_phi = 24, n_z = 5;
  REQUIRE(h.info.shape == std::vector<std::size_t>{time.size(), n_phi});
  REQUIRE(p.info.shape == h.info.shape);
  for (std::size_t row = 0; row < time.size(); ++row) {
    const auto instant =
        static_cast<std::size_t>(std::find(of_fields.begin(), of_fields.end(), time[row]) - of_fields.begin());
    REQUIRE(instant < of_fields.size());
    for (std::size_t i = 0; i < n_phi; ++i) {
      const auto first = static_cast<std::ptrdiff_t>((instant * n_phi + i) * n_z);
      const auto last = first + static_cast<std::ptrdiff_t>(n_z);
      const double least = *std::min_element(thickness.begin() + first, thickness.begin() + last);
      const double most = *std::max_element(pressure.begin() + first, pressure.begin() + last);
      CHECK(h.values[row * n_phi + i] == static_cast<float>(least));  // four bytes each
      CHECK(p.values[row * n_phi + i] == static_cast<float>(most));
    }
  }
}

}  // namespace film_on_mesh_test
}  // namespace hersey::run
