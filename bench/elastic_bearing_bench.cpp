// A bearing by itself between a shaft and the bore of a meshed ring: from the files to position, stiffness, damping and
// error of the grid. Fails where the ring of 24,960 degrees of freedom with a displacement of every node takes more
// than 5 s, film 60 x 13. With `settled` also the run of the same bearing until it has settled (minutes), and how far
// the two are apart: fails above 1e-4. Usage: elastic_bearing_bench [settled]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "hersey/study/bearing_study.h"
#include "ring_file.h"
#include "temporary_directory.h"

namespace {

using namespace hersey;
using Clock = std::chrono::steady_clock;

constexpr double target = 5, agreement = 1e-4;

const std::string machine = R"(hersey: 1
title: A shaft in a ring on a foot
bodies:
  ring:
    flexible:
      mesh: ring.inp
      length_unit: 1 mm
      material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}
      form: nodal
      damping: {stiffness: 20 us}
    frames:
      foot: {nodes: foot, origin: 0 0 0 mm}
      bore: {nodes: bore, connection: average, origin: 0 0 0 mm}
  shaft:
    mass: 0.1 kg
    inertia: {xx: 1e-4 kg.m^2, yy: 1e-4 kg.m^2, zz: 1e-4 kg.m^2}
joints:
  clamp: {type: fixed, between: [ground, ring.foot]}
  slide: {type: planar, between: [ground, shaft], initial: {x: 6 um, y: -24 um, rotation_rate: 3000 rpm}}
drives:
  motor: {joint: slide, coordinate: rotation, speed: 3000 rpm}
forces:
  push: {type: force, body: shaft, components: [0 N, -2 kN, 0 N]}
lubricants:
  oil: {viscosity: 15 mPa.s}
bearings:
  main:
    shell: ring.bore
    journal: shaft
    diameter: 45 mm
    width: 15.6 mm
    radial_clearance: 34 um
    lubricant: oil
    edge_pressure: 1 bar
    grid: {circumferential: 60, axial: 13}
    shell_surface: {faces: bore}
    operating_point: {journal_speed: 3000 rpm, load: 2 kN, load_angle: -90 deg}
simulation: {duration: 150 ms, step: 0.25 ms, spectral_radius: 0.6, settle: {tolerance: 1e-8, over: 10 ms}}
)";

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Largest relative difference of position, thickness, pressure and torque from the settled run.
double apart_from_run(const std::string& path, const std::filesystem::path& results,
                      const bearing::SteadyState& state) {
  const run::Summary summary = run::simulate(model::read(path), {.results = results});
  fmt::print("  run: {}\n", summary.message);
  const results::Reader reader(results);
  const auto last = [&](const char* name, std::size_t back) {
    const std::vector<double> values = reader.read(std::string("/bearings/main/") + name).values;
    return values[values.size() - back];
  };
  const Eigen::Vector2d e(last("eccentricity", 2), last("eccentricity", 1));
  return std::max({(state.e - e).norm() / e.norm(), std::abs(state.film.h_min / last("h_min", 1) - 1),
                   std::abs(state.film.p_max / last("p_max", 1) - 1),
                   std::abs(state.film.torque_journal / last("torque_journal", 1) - 1)});
}

}  // namespace

int main(int count, char** arguments) {
  const bool with_run = count > 1 && std::string_view(arguments[1]) == "settled";
  const TemporaryDirectory folder;
  const std::string path = folder / "model.yaml";
  std::ofstream(folder / "ring.inp") << RingFile{.outer = 36, .around = 64, .along = 12, .through = 9}.text();
  std::ofstream(folder / "model.yaml") << machine;
  bool is_good = true;
  fmt::print("form    load [N]    time [s]    linearisations    ecc. ratio    h_min [um]    p_max [MPa]\n");
  for (const char* form : {"nodal", "modal"}) {
    for (const char* load : {"500", "2000"}) {
      const auto start = Clock::now();
      const model::StudyRun run{{std::string("bodies.ring.flexible.form=") + form,
                                 std::string("bearings.main.operating_point.load=") + load + " N"},
                                "",
                                "",
                                {}};
      const study::BearingSolution solution = study::solve_bearings(path, {run}, {}).front();
      const double time = since(start);
      if (!solution.solved()) fmt::print("{}\n", solution.message);
      fmt::print("{:6}{:>10}{:>12.2f}{:>18}{:>14.6f}{:>14.5f}{:>15.5f}\n", form, load, time,
                 solution.summary.iterations, solution.numbers.eccentricity_ratio, 1e6 * solution.state.film.h_min,
                 1e-6 * solution.state.film.p_max);
      const bool is_nodal = std::string_view(form) == "nodal";
      is_good = is_good && solution.solved() && (!is_nodal || time < target);
      if (!with_run || !is_nodal || std::string_view(load) != "2000") continue;
      const double apart = apart_from_run(path, folder / "r.h5", solution.state);
      fmt::print("  apart from the settled run by {:.2g}\n", apart);
      is_good = is_good && apart < agreement;
    }
  }
  return is_good ? 0 : 1;
}
