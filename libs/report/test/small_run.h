#pragma once

#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "hersey/results/writer.h"
#include "temporary_directory.h"

namespace hersey::report {

/// A results file with one bearing whose numbers follow simple formulas; not physics, but known.
struct SmallRun {
  std::string title = "Small run";
  std::string load = "500 N";
  int rows = 11;
  double dt = 1e-3;  ///< [s]

  double h_min(int k) const { return 1e-6 * (10 + std::abs(k - 7)); }  ///< smallest, 10 um, at row 7
  double p_max(int k) const { return 1e6 * (5 - std::abs(k - 4)); }    ///< largest, 5 MPa, at row 4

  void write(const std::filesystem::path& path) const {
    results::Writer writer(path, {.overwrite = true});
    writer.attribute("/", "title", title);
    writer.attribute("/", "hersey_version", "0.1.0");
    writer.attribute("/", "wall_time", 1.25);
    writer.attribute("/", "study_parameters", std::vector<std::string>{"load"});
    writer.attribute("/parameters", "load", load);
    writer.attribute("/bearings/big_end", "radial_clearance", 34e-6);
    writer.text("/model", "hersey: 1\n# </script> must not end the page\n", "the model");
    writer.text_table("/assumptions", {{"cavitation", "mass conserving, 0 Pa"}}, "assumptions");
    series(writer);
    fields(writer);
    writer.finish(results::Status::completed);
  }

 private:
  void series(results::Writer& writer) const {
    const auto add = [&](const char* name, const char* unit, auto value) {
      const results::Series series = writer.series(name, 1, unit, "test series");
      for (int k = 0; k < rows; ++k) series.append(value(k));
    };
    const std::string bearing = "/bearings/big_end/";
    add("/time", "s", [&](int k) { return k * dt; });
    add("/crank_angle", "rad", [&](int k) { return k * std::numbers::pi / 10; });
    add("/solver/newton_iterations", "1", [](int k) { return k % 2 == 0 ? 2.0 : 4.0; });
    add("/power/drives", "W", [](int k) { return 2.0 * k; });
    add("/power/loads", "W", [](int k) { return -4.0 * k; });
    add("/power/balance_error", "W", [](int k) { return k == 3 ? -2e-6 : 1e-6; });
    add((bearing + "h_min").c_str(), "m", [&](int k) { return h_min(k); });
    add((bearing + "h_min_phi").c_str(), "rad", [](int k) { return k * std::numbers::pi / 18; });
    add((bearing + "h_min_z").c_str(), "m", [](int) { return -7.8e-3; });
    add((bearing + "p_max").c_str(), "Pa", [&](int k) { return p_max(k); });
    // Linear in time, so that the trapezoidal mean is exact: (0 + 10) / 2 = 5 W.
    add((bearing + "power_film").c_str(), "W", [](int k) { return 1.0 * k; });
    add((bearing + "flow_left").c_str(), "m^3/s", [](int) { return 3e-7; });
    const results::Series force = writer.series(bearing + "force", 3, "N", "force on the shell");
    for (int k = 0; k < rows; ++k) force.append({3.0 * k, -4.0 * k, 0.0});
  }

  void fields(results::Writer& writer) const {
    const std::string group = "/bearings/big_end/fields/";
    const std::vector<double> phi{0, 1.5, 3, 4.5}, z{-7.8e-3, 0, 7.8e-3};
    writer.constant(group + "phi", phi, "rad", "bearing angle");
    writer.constant(group + "z", z, "m", "axial position");
    const results::Series time = writer.series(group + "time", 1, "s", "time of the fields");
    const results::Series pressure = writer.field(group + "pressure", {4, 3}, "Pa", "film pressure");
    for (int k = 0; k < rows; ++k) {
      time.append(k * dt);
      pressure.append(std::vector<double>(12, p_max(k)));
    }
  }
};

}  // namespace hersey::report
