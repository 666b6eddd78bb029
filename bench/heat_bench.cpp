// What a film's temperature costs: a steady bearing from nothing, and a time step of the slider-crank, each beside the
// same film at one temperature.
//
//   heat_bench [EXAMPLES_DIR]
//
// Runs alternate and the shortest counts, so that other work on the machine falls out of the ratios.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "film_cases.h"
#include "hersey/bearing/steady_bearing.h"
#include "hersey/model/read.h"
#include "hersey/run/simulate.h"
#include "hersey/study/bearing_study.h"

namespace {

using namespace hersey;
namespace fs = std::filesystem;

/// The film of an example by itself, from nothing.
struct SteadyCase {
  film::FilmModel model;
  bearing::OperatingPoint point;
  bearing::SteadyOptions options;
  bearing::SteadySummary summary = {};
  double seconds = std::numeric_limits<double>::infinity();

  void time() {
    bearing::SteadyState state;
    seconds = std::min(seconds, film::shortest(1, [&] { summary = solve_steady(model, point, options, state); }));
    if (!summary.solved()) std::abort();
  }
};

SteadyCase steady_case(const fs::path& file, int layers) {
  const model::Model model = model::read(file.string(), {});
  const model::Bearing& bearing = study::bearing_called(model, "");
  SteadyCase c;
  c.point = study::operating_point_of(bearing);
  c.model = bearing::scaled_for(bearing.film, c.point);
  if (layers == 0) return c;
  c.options.thermal = std::get<film::ThermalModel>(bearing.heat);
  c.options.thermal->layers = layers;
  return c;
}

bool print_steady(const fs::path& examples) {
  const fs::path file = examples / "hot_bearing/model.yaml";
  std::array cases{steady_case(file, 0), steady_case(file, 1), steady_case(file, 5)};
  for (int round = 0; round < 15; ++round)
    for (SteadyCase& c : cases) c.time();
  const double cold = cases[0].seconds, ratio = cases[2].seconds / cold;
  fmt::print("A steady bearing from nothing, 60 x 13 (hot_bearing)\n");
  fmt::print("{:>8} {:>10} {:>8} {:>8} {:>16}\n", "layers", "ms", "times", "turns", "linearisations");
  for (std::size_t k = 0; k < cases.size(); ++k)
    fmt::print("{:>8} {:10.2f} {:8.2f} {:8} {:16}\n",
               k == 0   ? "none"
               : k == 1 ? "1"
                        : "5",
               1e3 * cases[k].seconds, cases[k].seconds / cold, cases[k].summary.heat_iterations,
               cases[k].summary.iterations);
  fmt::print("5 layers: {:.2f} times (asked: 4)\n\n", ratio);
  return ratio <= 4;
}

double step_seconds(const fs::path& examples, const fs::path& scratch, const std::string& thermal) {
  const std::vector<std::string> overrides{
      "lubricants.oil.viscosity={law: exponential, viscosity: 12 mPa.s, reference: 60 degC, coefficient: 0.03 1/K}",
      "bearings.big_end.thermal=" + thermal, "simulation.duration=180 deg"};
  const model::Model model = model::read((examples / "slider_crank/model.yaml").string(), overrides);
  run::Options options;
  options.results = scratch / "slider_crank.h5";
  options.overwrite = true;
  run::Summary summary;
  const double seconds = film::shortest(1, [&] { summary = run::simulate(model, options); });
  if (summary.status != run::Status::completed) std::abort();
  return seconds / summary.steps;
}

bool print_steps(const fs::path& examples, const fs::path& scratch) {
  const std::array<std::string, 3> thermal{"{model: isothermal, temperature: 60 degC}",
                                           "{model: film, supply_temperature: 60 degC, layers: 1}",
                                           "{model: film, supply_temperature: 60 degC, layers: 5, shell: {wall: ring, "
                                           "outer_diameter: 70 mm, ambient: 60 degC}}"};
  std::array<double, 3> seconds{};
  seconds.fill(std::numeric_limits<double>::infinity());
  for (int round = 0; round < 5; ++round)
    for (std::size_t k = 0; k < thermal.size(); ++k)
      seconds[k] = std::min(seconds[k], step_seconds(examples, scratch, thermal[k]));
  const double one = seconds[1] / seconds[0], five = seconds[2] / seconds[0];
  fmt::print("A time step of the slider-crank, 60 x 13, half a degree\n{:>8} {:>10} {:>8}\n", "layers", "ms", "times");
  for (std::size_t k = 0; k < seconds.size(); ++k)
    fmt::print("{:>8} {:10.3f} {:8.2f}\n",
               k == 0   ? "none"
               : k == 1 ? "1"
                        : "5",
               1e3 * seconds[k], seconds[k] / seconds[0]);
  fmt::print("1 layer: {:.2f} times (asked: 1.15), 5 layers: {:.2f} (asked: 1.5)\n", one, five);
  return one <= 1.15 && five <= 1.5;
}

}  // namespace

int main(int argc, char** argv) {
  const fs::path examples = argc > 1 ? argv[1] : "examples";
  const fs::path scratch = fs::temp_directory_path() / "hersey-heat-bench";
  fs::create_directories(scratch);
  const bool steady = print_steady(examples), steps = print_steps(examples, scratch);
  fs::remove_all(scratch);
  return steady && steps ? 0 : 1;
}
