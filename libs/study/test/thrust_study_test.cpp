#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/model/read.h"
#include "hersey/study/bearing_study.h"
#include "relative.h"

// A thrust bearing from the model file to its figures.
namespace hersey::study {
namespace thrust_study_test {

const std::string thrust = R"(hersey: 1
lubricants:
  oil: {viscosity: 20 mPa.s}
bearings:
  main:
    kind: thrust
    inner_diameter: 100 mm
    outer_diameter: 200 mm
    pads: {count: 3, arc: 50 deg}
    shape: [{profile: ramp, rise: 20 um}]
    lubricant: oil
    grid: {along: 21, radial: 13}
    operating_point: {speed: 300 rad/s, film_thickness: 20 um}
)";

/// The same without its pads, and with others or none in their place.
std::string with_pads(const std::string& pads) {
  const std::string equal = "    pads: {count: 3, arc: 50 deg}\n";
  std::string text = thrust;
  return text.replace(text.find(equal), equal.size(), pads);
}

/// An even washer.
std::string washer() {
  const std::string ramp = "    shape: [{profile: ramp, rise: 20 um}]\n";
  std::string text = with_pads("");
  return text.replace(text.find(ramp), ramp.size(), "");
}

using Figures = std::map<std::string, BearingFigure>;

Figures figures_with(const std::vector<std::string>& overrides, const std::string& text = thrust) {
  const model::Model model = model::read_text(text, "m.yaml", overrides);
  const BearingSolution solution = BearingSolver().solve(model, {.grid_error = false});
  REQUIRE_MESSAGE(solution.solved(), solution.message);
  Figures all;
  for (const BearingFigure& f : figures_of(solution)) all[f.key] = f;
  return all;
}

std::string fault_with(const std::vector<std::string>& overrides, const std::string& text = thrust) {
  try {
    const model::Model model = model::read_text(text, "m.yaml", overrides);
    (void)operating_point_of(model.bearings.front());
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

const std::string bearing = "bearings.main.", point = bearing + "operating_point.";

// Independent solution of one such pad: W h^2/(mu omega r_o^4), centre, power h/(mu omega^2 r_o^4), flows over
// omega r_o^2 h, k h/W, c omega h/W. Without tilt all pads are alike.
TEST_CASE("EqualPads_HaveTheFiguresOfAnIndependentSolution") {
  constexpr double mu = 0.02, omega = 300, h = 20e-6, r_o = 0.1;
  const double load = 0.00828283 * mu * omega * std::pow(r_o, 4) / (h * h), flow = omega * r_o * r_o * h;
  const Figures f = figures_with({bearing + "grid={along: 41, radial: 31}"});
  const auto si = [&](const char* key) { return f.at(key).value * f.at(key).si; };
  constexpr double of_grid = 3e-3, of_edges = 2e-2;  // (1/30)^2 times some three; slopes of the pressure at edges
  for (const char* pad : {"1", "2", "3"}) {
    CAPTURE(pad);
    const auto of_pad = [&](const std::string& key) { return si((key + pad).c_str()); };
    CHECK(of_pad("pad_load_") == relative(load).epsilon(of_grid));
    CHECK(of_pad("pad_centre_r_") == relative(0.0753167).epsilon(of_grid));
    CHECK(of_pad("pad_centre_angle_") == relative(29.49192 * 3.14159265358979 / 180).epsilon(of_grid));
    CHECK(of_pad("pad_flow_in_") == relative(0.329086 * flow).epsilon(of_grid));
  }
  CHECK(si("load") == relative(3 * load).epsilon(of_grid));
  CHECK(si("power_put_in") == relative(3 * 0.146516 * mu * omega * omega * std::pow(r_o, 4) / h).epsilon(of_grid));
  CHECK(si("flow_outer") == relative(3 * 0.0733648 * flow).epsilon(of_edges));
  CHECK(si("flow_inner") == relative(3 * 0.0389093 * flow).epsilon(of_edges));
  CHECK(si("stiffness") * h / si("load") == relative(2.161545).epsilon(of_grid));
  CHECK(si("damping") * omega * h / si("load") == relative(1.745329).epsilon(of_grid));
  CHECK(si("thrust_number") == relative(3 * 0.00828283).epsilon(of_grid));
  // Three equal pads all around: tilts do the same in every direction, and nothing to the load.
  CHECK(si("tilting_stiffness_xx") == relative(si("tilting_stiffness_yy")).epsilon(1e-8));   // the film's tolerance
  CHECK(si("tilting_stiffness_xy") == relative(-si("tilting_stiffness_yx")).epsilon(1e-8));  // likewise
  CHECK(std::abs(si("load_by_tilt_x")) < 1e-8 * si("stiffness") * r_o);                      // likewise
}

// What is given one way and another is the same bearing: sectors for pads, a load for a film thickness, a negative
// sense for a positive one.
TEST_CASE("SameThrustBearing_InOtherWords") {
  const std::vector<std::string> tilted{point + "tilt_x=5e-5 rad", point + "tilt_y=2e-5 rad"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), tilted.begin(), tilted.end());
    return more;
  };
  const Figures as_it_is = figures_with(tilted);
  const Figures sectors = figures_with(
      tilted,
      with_pads("    sectors: {c: {middle: 240 deg, arc: 50 deg}, a: {middle: 0 deg, arc: 50 deg}, b: {middle: 120 "
                "deg, arc: 50 deg}}\n"));
  const Figures loaded = figures_with(
      with({point + "film_thickness=none", point + "load=" + std::to_string(as_it_is.at("load").value) + " N"}));
  constexpr double solved = 1e-6;  // digits of the load as it is written
  for (const char* key : {"load", "h_min", "p_max", "p_max_r", "torque_runner", "stiffness", "damping", "flow_outer",
                          "flow_leading", "moment_x", "moment_y", "centre_x"}) {
    CAPTURE(key);
    CHECK(sectors.at(key).value == relative(as_it_is.at(key).value).epsilon(solved));
    CHECK(loaded.at(key).value == relative(as_it_is.at(key).value).epsilon(solved));
  }
  // Mirrored at y = 0.
  const Figures mirrored = figures_with(
      {bearing + "sense=negative", point + "speed=-300 rad/s", point + "tilt_x=5e-5 rad", point + "tilt_y=-2e-5 rad"});
  for (const char* key : {"load", "h_min", "p_max", "stiffness", "flow_leading", "flow_outer", "moment_y", "centre_x",
                          "pad_centre_angle_1", "pad_flow_in_1"}) {
    CAPTURE(key);
    CHECK(mirrored.at(key).value == relative(as_it_is.at(key).value).epsilon(solved));
  }
  CHECK(mirrored.at("torque_runner").value == relative(-as_it_is.at("torque_runner").value).epsilon(solved));
  CHECK(mirrored.at("moment_x").value == relative(-as_it_is.at("moment_x").value).epsilon(solved));
}

// A step is deep at the leading edge, whichever that is, and pockets that are fed bear a runner at rest.
TEST_CASE("StepsAndPockets_Carry") {
  const std::string step = bearing + "shape=[{profile: step, depth: 15 um, arc: 30 deg}]";
  const Figures forward = figures_with({step}),
                backward = figures_with({step, bearing + "sense=negative", point + "speed=-300 rad/s"}),
                wrong = figures_with({step, bearing + "sense=negative"});
  CHECK(forward.at("load").value > 1000);
  CHECK(backward.at("load").value == relative(forward.at("load").value).epsilon(1e-8));  // the film's tolerance
  CHECK(wrong.at("load").value < 0.2 * forward.at("load").value);
  CHECK(model::read_text(thrust, "m.yaml", {step}).warnings.empty());
  const model::Model against = model::read_text(thrust, "m.yaml", {step, bearing + "sense=negative"});
  REQUIRE(against.warnings.size() == 1);
  CHECK(against.warnings[0].expected == "a speed < 0, or `sense: positive`");
  // A washer at rest on a circular groove: between two discs Q = pi h^3 p/(6 mu ln(r_2/r_1)) goes to either side.
  const Figures fed = figures_with(
      {bearing + "grid={along: 24, radial: 41}",
       bearing + "features={ring: {shape: pocket, angle: 0 deg, arc: 360 deg, width: 10 mm, pressure: 20 bar}}",
       point + "speed=0 rpm"},
      washer());
  const auto flow = [](double inner, double outer) {
    return 3.14159265358979 * std::pow(20e-6, 3) * 20e5 / (6 * 0.02 * std::log(outer / inner));
  };
  CHECK(fed.at("flow_outer").value * 1e-9 == relative(flow(0.08, 0.1)).epsilon(3e-3));   // 16 cells over the land
  CHECK(fed.at("flow_inner").value * 1e-9 == relative(flow(0.05, 0.07)).epsilon(3e-3));  // likewise
  CHECK(std::abs(fed.at("torque_runner").value) < 1e-12);  // round-off of some newton metres
}

TEST_CASE("FaultsOfThrustBearings_AreToldByName") {
  CHECK(fault_with({bearing + "outer_diameter=100 mm"}).find("expected more than the inner diameter, 100 mm") !=
        std::string::npos);
  CHECK(fault_with({bearing + "pads.count=8"})
            .find("8 pads of 50 deg, 400 deg in all; expected 360 deg in all at most") != std::string::npos);
  CHECK(fault_with({bearing + "sectors={a: {middle: 0 deg, arc: 50 deg}}"}).find("both 'pads' and 'sectors'") !=
        std::string::npos);
  CHECK(fault_with({}, with_pads("    sectors: {a: {middle: 0 deg, arc: 50 deg}, b: {middle: 30 deg, arc: 50 deg}}\n"))
            .find("pad 'a' (-25 to 25 deg) overlaps 'b' (5 to 55 deg)") != std::string::npos);
  CHECK(fault_with({}, with_pads("")).find("a ramp of a washer, which has no leading edge") != std::string::npos);
  CHECK(fault_with({bearing + "shape=[{profile: ramp, rise: 20 um, arc: 60 deg}]"})
            .find("60 deg, longer than a pad; expected at most the pads' arc, 50 deg") != std::string::npos);
  CHECK(fault_with({bearing + "features={p: {shape: pocket, angle: 60 deg, arc: 20 deg, pressure: 2 bar}}"})
            .find("it does not lie within one pad") != std::string::npos);
  CHECK(fault_with({bearing + "features={p: {shape: pocket, angle: 0 deg, arc: 20 deg, radius: 52 mm, width: 20 mm, "
                              "pressure: 2 bar}}"})
            .find("it reaches from 42 to 62 mm from the axis; expected 50 to 100 mm") != std::string::npos);
  CHECK(fault_with({bearing + "features={p: {shape: pocket, angle: 0 deg, arc: 20 deg}}"})
            .find("neither 'pressure' nor 'depth'") != std::string::npos);
  CHECK(fault_with({bearing + "edge_pressure=closed"}).find("the pressure is given nowhere") != std::string::npos);
  CHECK(fault_with({point + "load=5 kN"}).find("keys 'load' and 'film_thickness' together") != std::string::npos);
  CHECK(fault_with({point + "speed=0 rpm"}).find("a runner at rest") != std::string::npos);
}

// On three grids, each half of the one before, the load changes by a quarter of what it did.
TEST_CASE("LoadOfPads_IsOfSecondOrder") {
  std::array<double, 3> load{};
  for (const int k : {0, 1, 2})
    load[static_cast<std::size_t>(k)] =
        figures_with({bearing + "pads.count=1", bearing + "grid={along: " + std::to_string((10 << k) + 1) +
                                                    ", radial: " + std::to_string((8 << k) + 1) + "}"})
            .at("load")
            .value;
  CHECK(std::log2((load[1] - load[0]) / (load[2] - load[1])) == doctest::Approx(2).epsilon(0.15));
}

}  // namespace thrust_study_test
}  // namespace hersey::study
