#include "build/reduction_folder.h"

#include <doctest/doctest.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <string>

#include "build/build_flexible.h"
#include "model_text.h"
#include "temporary_directory.h"

// Reduced bodies in files.
namespace hersey::model {
namespace reduction_folder_test {

namespace fs = std::filesystem;

const std::string kPad = R"(hersey: 1
bodies:
  pad:
    flexible:
      sector: {inner_radius: 50 mm, thickness: 10 mm, width: 30 mm, middle: 350 deg, arc: 40 deg, seat: {angle: -10 deg, arc: 4 deg, width: 10 mm}}
      material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}
      modes: 4
      load_surfaces: [inner]
    frames: {foot: {nodes: seat, connection: average}}
joints:
  stand: {type: fixed, between: [ground, pad.foot]}
simulation: {duration: 1 ms, step: 0.1 ms}
)";

struct Fixture {
  Model model = read_text(kPad, "m.yaml");
  TemporaryDirectory outer;
  fs::path folder = outer.path() / "kept";

  [[nodiscard]] const Body& body() const { return model.bodies.front(); }
  [[nodiscard]] fem::ReducedBody reduced() const {
    fem::ReductionOptions options{.modes = 4};
    options.surfaces.push_back(fem::loaded_surface(*body().flexible->mesh, "inner", 3));
    options.contact_faces.push_back(body().flexible->mesh->surfaces.at("outer"));
    options.static_error = 0.1;
    fem::Reduction reduction = fem::reduce(assembled(body()), interface_frames(body()), options);
    REQUIRE(reduction.solved());
    return reduction.body;
  }
  [[nodiscard]] fs::path only_file() const {
    REQUIRE(std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == 1);
    return fs::directory_iterator(folder)->path();
  }
};

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void put(const fs::path& path, const std::string& content) { std::ofstream(path, std::ios::binary) << content; }

TEST_CASE("KeptReduction_IsFoundBitForBit") {
  const Fixture f;
  const fem::ReducedBody made = f.reduced();
  ReductionFolder(f.folder, 1'000'000'000).keep(made, "as it is");
  const ReductionFolder later(f.folder, 1'000'000'000);
  const auto found = later.find("as it is");
  REQUIRE(found);
  CHECK(found->Phi == made.Phi);
  CHECK(found->K == made.K);
  CHECK(found->M == made.M);
  CHECK(Eigen::MatrixXd(found->m) == Eigen::MatrixXd(made.m));
  CHECK(found->internal_omega == made.internal_omega);
  CHECK(found->energy_missed == made.energy_missed);
  REQUIRE(found->static_errors.size() == 1);
  CHECK(found->static_errors[0].surface == "inner");
  CHECK(found->static_errors[0].reduced == made.static_errors[0].reduced);
  REQUIRE(found->film_modes.size() == 1);
  CHECK(found->film_modes[0].shapes == made.film_modes[0].shapes);
  CHECK(found->film_modes[0].loads == made.film_modes[0].loads);
  CHECK(found->film_modes[0].pressures == made.film_modes[0].pressures);
  CHECK(found->film_modes[0].compliance == made.film_modes[0].compliance);
  CHECK(found->film_modes[0].lost == made.film_modes[0].lost);
  CHECK(!later.find("as it was"));
}

TEST_CASE("DamagedOrForeignFile_IsNotTaken") {
  const Fixture f;
  const ReductionFolder folder(f.folder, 1'000'000'000);
  folder.keep(f.reduced(), "it");
  const fs::path file = f.only_file();
  const std::string whole = content_of(file);
  for (const std::size_t at : {std::size_t{0}, whole.size() / 3, whole.size() / 2, whole.size() - 1}) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    put(file, damaged);
    CHECK(!folder.find("it"));
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}, whole.size() / 2}) {
    put(file, whole.substr(0, size));
    CHECK(!folder.find("it"));
  }
  put(file, whole);
  CHECK(folder.find("it"));
  // Another fingerprint under its name, as if their checksums were equal.
  folder.keep(f.reduced(), "other");
  for (const auto& entry : fs::directory_iterator(f.folder))
    if (entry.path() != file) fs::rename(entry.path(), file);
  CHECK(!folder.find("it"));
}

TEST_CASE("FilesUsedLongestAgo_GoFirst") {
  const Fixture f;
  const fem::ReducedBody reduced = f.reduced();
  const ReductionFolder first(f.folder, 1'000'000'000);
  first.keep(reduced, "1");
  const std::uintmax_t size = fs::file_size(f.only_file());
  const ReductionFolder folder(f.folder, 3 * size + size / 2);  // room for three
  const auto minutes_old = [&](const std::string& name, int minutes) {
    const std::uintmax_t before =
        static_cast<std::uintmax_t>(std::distance(fs::directory_iterator(f.folder), fs::directory_iterator()));
    CHECK(before <= 3);
    for (const auto& entry : fs::directory_iterator(f.folder)) {
      const bool is_it = content_of(entry.path()).find("\1" + std::string(7, '\0') + name) != std::string::npos;
      if (is_it) fs::last_write_time(entry.path(), fs::file_time_type::clock::now() - std::chrono::minutes(minutes));
    }
  };
  minutes_old("1", 30);
  folder.keep(reduced, "2");
  minutes_old("2", 20);
  folder.keep(reduced, "3");
  minutes_old("3", 10);
  CHECK(folder.find("1"));  // and used now
  folder.keep(reduced, "4");
  CHECK(folder.find("1"));
  CHECK(!folder.find("2"));
  CHECK(folder.find("3"));
  CHECK(folder.find("4"));
  ReductionFolder(f.folder, size / 2).keep(reduced, "too large");
  CHECK(!folder.find("too large"));
  CHECK(folder.find("4"));
}

TEST_CASE("FolderThatCannotBeWritten_KeepsNothing") {
  const Fixture f;
  put(f.folder, "a file stands where the folder would be");
  const ReductionFolder folder(f.folder, 1'000'000'000);
  folder.keep(f.reduced(), "it");
  CHECK(!folder.find("it"));
  CHECK(content_of(f.folder).starts_with("a file stands"));
}

}  // namespace reduction_folder_test
}  // namespace hersey::model
