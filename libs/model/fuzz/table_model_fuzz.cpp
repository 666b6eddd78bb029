// libFuzzer target: whatever a table file contains, a model that takes a load and a measured bore from it is read, or
// its faults are reported.
// seeds: libs/model/fuzz/seeds/table.csv
// longest: 4096
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "hersey/model/read.h"

namespace {

/// The folder of one process, with the model files; the table is written there anew for every input.
std::filesystem::path folder() {
  const std::filesystem::path memory = "/dev/shm";
  const auto base = std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
  const std::filesystem::path path = base / ("hersey_fuzz_table_" + std::to_string(::getpid()));
  std::filesystem::create_directories(path);
  std::ofstream(path / "model.yaml") << R"(hersey: 1
bodies: {shaft: {mass: 1 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}}
joints: {guide: {type: planar, between: [ground, shaft], axis: z}}
forces:
  weight: {type: force, body: shaft, components: [{table: {file: table.csv, x: angle, y: load}, over: guide.rotation, period: 360 deg, interpolation: smooth}, 0 N, 0 N], axes: ground}
lubricants: {oil: {viscosity: 15 mPa.s}}
bearings:
  main: {shell: ground, journal: shaft, diameter: 45 mm, width: 20 mm, radial_clearance: 50 um, lubricant: oil, shape: [{profile: table, file: table.csv}]}
simulation: {duration: 1 ms, step: 1 ms}
)";
  return path;
}

void read(const std::filesystem::path& model) {
  try {
    (void)hersey::model::read(model.string());
  } catch (const hersey::InputError&) {
    // the expected answer to nearly every input
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path models = folder();
  std::ofstream(models / "table.csv", std::ios::binary) << std::string(data, data + size);
  read(models / "model.yaml");
  return 0;
}
