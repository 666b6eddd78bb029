#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "relative.h"
#include "temporary_directory.h"

// A bearing with a groove on either side of the load, as those of Brito, Miranda, Claro and Fillon: under load the film
// presses hot oil back through the upstream one.
namespace hersey::run {
namespace twin_groove_test {

struct Case {
  double load;              ///< [kN]
  double pressure;          ///< of the supply [bar]
  bool is_one_pipe = true;  ///< to both grooves; false: the supply is beside each
  double rotation = 1;      ///< -1: the other way round
};

std::string twin_grooves(const Case& at) {
  const std::string up = at.rotation > 0 ? "180 deg" : "0 deg", down = at.rotation > 0 ? "0 deg" : "180 deg";
  return fmt::format(R"(hersey: 1
lubricants: {{oil: {{grade: iso_vg_32}}}}
bodies: {{shaft: {{mass: 30 kg, inertia: {{xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 0.1 kg.m^2}}}}}}
joints: {{turning: {{type: planar, between: [ground, shaft], axis: z}}}}
drives: {{motor: {{joint: turning, coordinate: rotation, speed: {} rpm}}}}
forces: {{load: {{type: force, body: shaft, components: [0 N, -{} kN, 0 N]}}}}
circuit:
  lubricant: oil
  nodes: {{supply: {{pressure: {} bar, temperature: 40 degC}}, tee: {{}}, upstream: {{}}, downstream: {{}}}}
  elements:
    pipe: {{type: drilling, from: supply, to: tee, length: 500 mm, diameter: 8 mm, loss_coefficient: 1.5}}
    to_upstream: {{type: drilling, from: {}, to: upstream, length: 100 mm, diameter: 8 mm, loss_coefficient: 1.5}}
    to_downstream: {{type: drilling, from: {}, to: downstream, length: 100 mm, diameter: 8 mm, loss_coefficient: 1.5}}
bearings:
  main:
    shell: ground
    journal: shaft
    diameter: 50 mm
    width: 50 mm
    radial_clearance: 40 um
    lubricant: oil
    grid: {{circumferential: 48, axial: 9}}
    features:
      upstream: {{shape: axial_groove, angle: {}, arc: 30 deg, length: 44 mm, circuit: upstream}}
      downstream: {{shape: axial_groove, angle: {}, arc: 30 deg, length: 44 mm, circuit: downstream}}
    thermal: {{model: film, supply_temperature: 40 degC, shell: {{wall: ring, outer_diameter: 100 mm, ambient: 30 degC}}}}
simulation: {{analysis: steady}}
)",
                     3000 * at.rotation, at.load, at.pressure, at.is_one_pipe ? "tee" : "supply",
                     at.is_one_pipe ? "tee" : "supply", up, down);
}

class TwinGrooves {
 public:
  explicit TwinGrooves(const Case& at)
      : summary_(simulate(model::read_text(twin_grooves(at), "m.yaml"), {.results = scratch_ / "run.h5"})) {
    INFO(summary_.message);
    REQUIRE(summary_.status == Status::completed);
  }
  [[nodiscard]] double last(const std::string& series) const {
    return results::Reader(summary_.results).read("/" + series).values.back();
  }
  [[nodiscard]] double upstream() const { return last("circuit/drawn_upstream"); }
  [[nodiscard]] double hottest() const { return last("bearings/main/T_max"); }

 private:
  TemporaryDirectory scratch_;
  Summary summary_;
};

TEST_CASE("UpstreamGroove_GivesOilBackUnderHighLoadAndLowSupplyPressure") {
  const double low = 0.1, high = 0.7;  // bar
  std::vector<double> flow;
  for (const double load : {4.0, 7.0, 13.0}) flow.push_back(TwinGrooves({load, low}).upstream());
  CHECK(flow[0] > flow[1]);
  CHECK(flow[1] > 0);
  CHECK(flow[2] < 0);
  CHECK(TwinGrooves({10, low}).upstream() < 0);
  CHECK(TwinGrooves({10, high}).upstream() > TwinGrooves({10, low}).upstream());
}

// What flows back is hot, and on one pipe the other groove draws it.
TEST_CASE("OilThatFlowsBack_WarmsTheBearingThroughTheOtherGroove") {
  const TwinGrooves fed({6, 0.1}), fed_apart({6, 0.1, false}), back({13, 0.1}), back_apart({13, 0.1, false});
  CHECK(fed.last("circuit/temperature_downstream") < 40.01);  // degC; losses of pressure warm oil by 6 mK
  CHECK(fed.hottest() - fed_apart.hottest() < 0.1);           // K: the pipe of half a metre costs a little pressure
  CHECK(fed.upstream() > 0);
  CHECK(back.last("circuit/temperature_upstream") > 60);
  CHECK(back.last("circuit/temperature_downstream") > 44);
  CHECK(back_apart.last("circuit/temperature_downstream") < 40.01);  // as above
  CHECK(back.hottest() - back_apart.hottest() > 2);
  // Of the downstream groove's oil the upstream groove's gives as much as mixes to its temperature.
  const double T_back = back.last("circuit/temperature_upstream"), T = back.last("circuit/temperature_downstream");
  const double mixed = 40 - back.upstream() / back.last("circuit/drawn_downstream") * (T_back - 40);
  CHECK(std::abs(T - mixed) < 0.01);  // K: of losses of pressure
}

TEST_CASE("BearingThatTurnsTheOtherWay_HasItsGroovesExchanged") {
  const TwinGrooves one({13, 0.1}), other({.load = 13, .pressure = 0.1, .rotation = -1});
  for (const char* series : {"circuit/drawn_upstream", "circuit/drawn_downstream", "circuit/temperature_downstream",
                             "bearings/main/T_max", "bearings/main/h_min"}) {
    CAPTURE(series);
    CHECK(other.last(series) ==
          relative(one.last(series)).epsilon(1e-6));  // temperatures are found to 1e-8 of their rise
  }
}

}  // namespace twin_groove_test
}  // namespace hersey::run
