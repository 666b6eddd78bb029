// Models that tests of several modules build from one description.
#include "meshed_bearing.h"

#include <fstream>

#include "model_text.h"
#include "ring_file.h"
#include "temporary_directory.h"

namespace hersey::model {
namespace meshed_bearing_test {

TEST_CASE("MeshedBearings_OfEveryForm_AreRead") {
  const TemporaryDirectory folder;
  std::ofstream(folder / "ring.inp") << RingFile().text();
  std::ofstream(folder / "shaft.inp") << RingFile{.inner = 12, .outer = 22.466}.text();
  const MeshedBody ring{"ring.inp", "modes: 1", kHub}, shaft{"shaft.inp", "modes: 1", kPin}, rigid;
  for (const MeshedBody& shell : {ring, rigid})
    for (const MeshedBody& journal : {shaft, rigid})
      for (const char* load : {"2 kN", ""}) {
        const std::string text = MeshedBearing{.ground = "middle: {origin: 0 0 0 mm}",
                                               .ring = shell,
                                               .shaft = journal,
                                               .journal = journal.mesh.empty() ? "shaft" : "shaft.pin",
                                               .guided_on = "ground.middle",
                                               .load = load,
                                               .film = "grid: {circumferential: 24, axial: 5}\ncavitation: guembel"}
                                     .text();
        CAPTURE(text);
        std::ofstream(folder / "model.yaml") << text;
        const Model model = read(folder / "model.yaml");
        REQUIRE(model.bearings.size() == 1);
        CHECK(model.bearings[0].film.L == doctest::Approx(15.6e-3));
        CHECK(model.bearings[0].film.grid.n_phi == 24);
        std::size_t meshes = 0;
        for (const Body& body : model.bodies) meshes += body.flexible ? 1 : 0;
        CHECK(meshes == (shell.mesh.empty() ? 0u : 1u) + (journal.mesh.empty() ? 0u : 1u));
        CHECK(model.drives.size() == (*load != '\0' ? 1 : 0));
      }
}

}  // namespace meshed_bearing_test
}  // namespace hersey::model
