#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "small_rig.h"
#include "temporary_directory.h"

namespace hersey::run {
namespace cycle_maps_test {

constexpr double kFriction = 0.1;

// The rig, pressed until its rough surfaces touch.
std::string rough_rig() {
  return rig_with(
      "    supply: {line: widest_gap, pressure: 1 bar}\n",
      "    supply: {line: widest_gap, pressure: 1 bar}\n"
      "    asperities: {model: greenwood_tripp, roughness: 2 um, composite_modulus: 115 GPa, friction: 0.1}\n");
}

struct RunResults {
  explicit RunResults(const std::filesystem::path& file) : reader(file) {}
  [[nodiscard]] std::vector<double> series(const std::string& name) const {
    return reader.read("/bearings/big_end/" + name).values;
  }
  [[nodiscard]] std::vector<double> cycle(const std::string& name) const { return series("cycles/fields/" + name); }
  [[nodiscard]] double only(const std::string& name) const {
    REQUIRE(cycle(name).size() == 1);
    return cycle(name).front();
  }
  results::Reader reader;
};

double integral(const std::vector<double>& t, const std::vector<double>& y) {
  double sum = 0;
  for (std::size_t k = 1; k < t.size(); ++k) sum += 0.5 * (y[k] + y[k - 1]) * (t[k] - t[k - 1]);
  return sum;
}

// Over the bearing's surface: nodes evenly around, trapezoidal along.
double surface_integral(const std::vector<double>& map, double R, double L, int n_phi, int n_z) {
  double sum = 0;
  for (int i = 0; i < n_phi; ++i) {
    for (int j = 0; j < n_z; ++j) {
      sum += map[static_cast<std::size_t>(i * n_z + j)] * (j == 0 || j == n_z - 1 ? 0.5 : 1);
    }
  }
  return sum * (2 * M_PI * R / n_phi) * (L / (n_z - 1));
}

// Sums of some hundred numbers in another order.
const double round_off = 1e-12;

TEST_CASE("WholeRun_LossesAndExtremesAreThoseOfTheSeries") {
  const TemporaryDirectory scratch;
  const Summary summary = simulate(rig(rough_rig(), {"load=8000 N"}), {.results = scratch / "run.h5"});
  REQUIRE(summary.status == Status::completed);
  const RunResults results(summary.results);
  const std::vector<double> t = results.reader.read("/time").values;
  CHECK(results.only("begin") == 0);
  CHECK(results.only("end") == summary.t_end);
  CHECK(results.only("complete") == 0);
  const double film = integral(t, results.series("power_film")),
               asperity = integral(t, results.series("power_asperity"));
  CHECK(film > 0);
  CHECK(asperity > 0);
  CHECK(results.only("energy_film") == doctest::Approx(film).epsilon(round_off));
  CHECK(results.only("energy_asperity") == doctest::Approx(asperity).epsilon(round_off));
  CHECK(results.only("power_film") == doctest::Approx(film / summary.t_end).epsilon(round_off));
  CHECK(results.only("moft") == summary.bearings[0].moft);
  CHECK(results.only("moft_time") == summary.bearings[0].moft_t);
  CHECK(results.only("pofp") == summary.bearings[0].pofp);
  CHECK(results.only("pofp_phi") == summary.bearings[0].pofp_phi);
}

TEST_CASE("WearLoad_TimesFrictionIsTheMeanLossInContact") {
  const TemporaryDirectory scratch;
  const Summary summary = simulate(rig(rough_rig(), {"load=8000 N"}), {.results = scratch / "run.h5"});
  REQUIRE(summary.status == Status::completed);
  const RunResults results(summary.results);
  const double power = kFriction * surface_integral(results.cycle("wear_load"), 0.0225, 0.0156, 24, 5);
  // Sums over the same nodes: what means over time leave.
  CHECK(power == doctest::Approx(results.only("power_asperity")).epsilon(1e-6));
  // The pin rotates at a constant speed: wear load is mean contact pressure times speed, nearly; the rod hardly moves.
  const double speed = 3000 * M_PI / 30 * 0.0225;
  const double mean = surface_integral(results.cycle("asperity_pressure_mean"), 0.0225, 0.0156, 24, 5);
  CHECK(power / kFriction == doctest::Approx(speed * mean).epsilon(0.01));
}

TEST_CASE("Maps_HoldTheExtremesOfTheFields") {
  const TemporaryDirectory scratch;
  const std::string text = rough_rig() + "output: {fields_every: 2 deg}\n";
  const Summary summary = simulate(rig(text, {"load=8000 N"}), {.results = scratch / "run.h5"});
  REQUIRE(summary.status == Status::completed);
  const RunResults results(summary.results);
  const std::vector<double> t = results.series("fields/time"), h = results.series("fields/thickness"),
                            p = results.series("fields/pressure"), contact = results.series("fields/asperity_pressure");
  const std::vector<double> h_min = results.cycle("thickness_min"), p_max = results.cycle("pressure_max");
  const std::vector<double> t_h = results.cycle("thickness_min_time"), t_p = results.cycle("pressure_max_time");
  const std::size_t n = h_min.size();
  REQUIRE(n == 24 * 5);
  REQUIRE(t.size() == static_cast<std::size_t>(summary.steps) + 1);
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t least = 0, most = 0;
    for (std::size_t row = 1; row < t.size(); ++row) {
      if (h[row * n + k] < h[least * n + k]) least = row;
      if (p[row * n + k] > p[most * n + k]) most = row;
    }
    CHECK(h_min[k] == h[least * n + k]);
    CHECK(t_h[k] == t[least]);
    CHECK(p_max[k] == p[most * n + k]);
    CHECK(t_p[k] == t[most]);
  }
  CHECK(results.only("contact") == *std::max_element(contact.begin(), contact.end()));
}

}  // namespace cycle_maps_test
}  // namespace hersey::run
