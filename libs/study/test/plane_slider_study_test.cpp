#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/model/read.h"
#include "hersey/study/bearing_study.h"
#include "hersey/study/run_figures.h"
#include "relative.h"

// A plane slider from the model file to its figures.
namespace hersey::study {
namespace plane_slider_study_test {

const std::string slider = R"(hersey: 1
lubricants:
  oil: {viscosity: 20 mPa.s}
bearings:
  pad:
    kind: plane_slider
    length: 50 mm
    width: 40 mm
    lubricant: oil
    grid: {along: 21, across: 13}
    shape: [{profile: ramp, rise: 30 um}]
    operating_point: {speed: 3 m/s, film_thickness: 20 um}
)";

using Figures = std::map<std::string, BearingFigure>;

Figures figures(const std::vector<std::string>& overrides, bool with_grid_error = false) {
  const model::Model model = model::read_text(slider, "m.yaml", overrides);
  const BearingSolution solution = BearingSolver().solve(model, {.grid_error = with_grid_error});
  REQUIRE_MESSAGE(solution.solved(), solution.message);
  Figures all;
  for (const BearingFigure& f : figures_of(solution)) all[f.key] = f;
  return all;
}

std::string fault_of(const std::vector<std::string>& overrides) {
  try {
    const model::Model model = model::read_text(slider, "m.yaml", overrides);
    (void)operating_point_of(model.bearings.front());
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

// A pad with a ramp over its whole length is a plane pad that leans: all figures agree but the reference of the force
// along the pad, which differs by the ramp's slope.
TEST_CASE("DragOfATiltedPad_IsThatOfTheRamp") {
  const Figures ramp = figures({}),
                tilted = figures({"bearings.pad.shape=[{profile: ramp, rise: 0 um}]",
                                  "bearings.pad.operating_point.tilt_along=" + std::to_string(30e-6 / 50e-3) + " rad"});
  constexpr double solved = 1e-6;  // digits of the tilt as it is written
  for (const char* key : {"load", "h_min", "p_max", "p_max_y", "centre_y", "power_film", "flow_leading", "side_flow",
                          "stiffness", "damping", "load_number"}) {
    CAPTURE(key);
    CHECK(tilted.at(key).value == relative(ramp.at(key).value).epsilon(solved));
  }
  // Pressure on the ramp is summed over intervals, on a plane pad it has no share: two sums of second order.
  constexpr double of_second_order = 1e-3;  // 20 cells, of a drag
  CHECK(tilted.at("force_runner").value == relative(ramp.at("force_runner").value).epsilon(of_second_order));
  CHECK(tilted.at("force_pad").value + 30e-6 / 50e-3 * tilted.at("load").value ==
        relative(ramp.at("force_pad").value).epsilon(of_second_order));
}

// The load found at a film thickness gives that film thickness back, by the names of the command line.
TEST_CASE("LoadOfASlider_GivesItsFilmThicknessBack") {
  const Figures placed = figures({});
  const std::string load = std::to_string(placed.at("load").value) + " N";
  const Figures loaded =
      figures({"bearings.pad.operating_point.film_thickness=none", "bearings.pad.operating_point.load=" + load});
  for (const char* key : {"h_min", "p_max", "force_runner", "stiffness"}) {
    CAPTURE(key);
    CHECK(loaded.at(key).value == relative(placed.at(key).value).epsilon(1e-6));  // digits of the load
  }
}

// On three grids, each half of the one before, every figure with an error of the grid changes by less than that.
TEST_CASE("FiguresOfASlider_AreOfSecondOrder") {
  std::array<Figures, 3> grids;
  for (const int k : {0, 1, 2})
    grids[static_cast<std::size_t>(k)] = figures({"bearings.pad.grid={along: " + std::to_string((20 << k) + 1) +
                                                  ", across: " + std::to_string((12 << k) + 1) + "}"});
  for (const auto& entry : grids[2]) {
    const std::string& key = entry.first;
    CAPTURE(key);
    const double fine = entry.second.value, half = grids[1].at(key).value, quarter = grids[0].at(key).value;
    const double last = std::abs(fine - half), before = std::abs(half - quarter);
    if (key == "power_error_share" || key == "cavitated_share" || key == "mass_balance_error")
      continue;                                           // errors themselves
    if (last <= 1e-6 * std::abs(fine) + 1e-12) continue;  // exact on every grid, or zero
    // A quarter, with the next order of the coarsest grid: shear sees the slope of the pressure at the corners.
    CHECK(last < 0.4 * before);
  }
}

TEST_CASE("GridErrorOfASlider_CoversAFinerGrid") {
  const Figures coarse = figures({}, true), fine = figures({"bearings.pad.grid={along: 81, across: 49}"});
  for (const char* key : {"load", "p_max", "friction_runner", "power_film", "side_flow", "stiffness", "damping"}) {
    CAPTURE(key);
    const BearingFigure& f = coarse.at(key);
    REQUIRE(f.grid_error > 0);
    CHECK(std::abs(f.value - fine.at(key).value) < 1.2 * f.grid_error);  // an estimate
    CHECK(f.grid_error < 0.1 * std::abs(f.value));
  }
}

// Closed form of a hydrostatic pad at rest that is fed all over but a strip: load and flow by its pressure alone.
TEST_CASE("PadThatIsFed_CarriesAtRest") {
  const std::vector<std::string> fed{
      "bearings.pad.shape=[{profile: ramp, rise: 0 um}]", "bearings.pad.operating_point.speed=0 m/s",
      "bearings.pad.grid={along: 101, across: 5}",
      "bearings.pad.edge_pressure={leading: 0 Pa, trailing: 0 Pa, left: closed, right: closed}",
      "bearings.pad.features={recess: {shape: pocket, along: 30 mm, pressure: 20 bar}}"};
  const Figures pad = figures(fed);
  // Over the lands of 10 mm the pressure falls linearly: 20 bar on 40 mm of 40 mm width, q = h^3 p L/(12 mu l) each.
  CHECK(pad.at("load").value == relative(20e5 * 0.04 * 0.04).epsilon(2e-3));  // a land of 20 cells, borders on lines
  const double flow = 2 * std::pow(20e-6, 3) * 20e5 * 0.04 / (12 * 0.02 * 0.01) * 1e9;
  CHECK(pad.at("flow_supply").value == relative(flow).epsilon(1e-6));       // linear pressure: exact
  CHECK(pad.at("force_runner").value == doctest::Approx(0).epsilon(1e-9));  // round-off of 3200 N
}

TEST_CASE("FaultsOfSliders_SayWhatIsWrong") {
  const auto says = [](const std::vector<std::string>& overrides, const char* part) {
    const std::string fault = fault_of(overrides);
    CAPTURE(fault);
    CHECK(fault.find(part) != std::string::npos);
  };
  says({"bearings.pad.operating_point.load=5 kN"}, "keys 'load' and 'film_thickness' together");
  says({"bearings.pad.operating_point.film_thickness=none"}, "neither 'load' nor 'film_thickness'");
  says({"bearings.pad.operating_point.speed=0 m/s"}, "a runner at rest");
  says({"bearings.pad.diameter=40 mm"}, "which kind plane_slider does not have");
  says({"bearings.pad.kind=plane_slyder"}, "did you mean 'plane_slider'");
  says({"bearings.pad.shape=[{profile: step, depth: 10 um, length: 60 mm}]"}, "longer than the pad");
  says({"bearings.pad.features={hole: {shape: hole, y: 22 mm, diameter: 8 mm, pressure: 1 bar}}"},
       "at most half of the pad");
  says({"bearings.pad.features={hole: {shape: hole, diameter: 1 mm, pressure: 1 bar}}"}, "fewer than 3 nodes");
  says({"bearings.pad.pressures=absolute", "bearings.pad.edge_pressure=1 bar"}, "which would count the atmosphere");
  says({"bearings.pad.shear_force=torque_only"}, "'shear_force' belongs to kind journal");
  says({"bearings.pad.edge_pressure=closed"}, "the pressure is given nowhere");
  says({"bearings.pad.operating_point.film_thickness=none", "bearings.pad.operating_point.load=1e16 N"},
       "no solid bears");
}

TEST_CASE("Keys_AreThoseOfTheKind") {
  const auto has = [](const std::vector<std::string>& keys, const std::string& key) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  };
  const std::vector<std::string> own = figure_keys("plane_slider");
  for (const auto& entry : figures({})) {
    INFO(entry.first);
    CHECK(has(own, entry.first));
  }
  CHECK_FALSE(has(own, "eccentricity_ratio"));
  CHECK_FALSE(has(figure_keys("journal"), "h_min_y"));
  CHECK(has(figure_keys(), "eccentricity_ratio"));
  const std::vector<std::string> known = steady_figure_keys(model::read_text(slider, "m.yaml"));
  CHECK(has(known, "bearings.pad.h_min_y"));
  CHECK_FALSE(has(known, "bearings.pad.eccentricity_ratio"));
}

}  // namespace plane_slider_study_test
}  // namespace hersey::study
