#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "hersey/fem/vtu_file.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "observation/film_pressures.h"

namespace hersey::run {

/// Deformed meshes of flexible bodies in ground's axes, with stress and the pressure of films, as series for ParaView:
/// <results>_<body>.pvd.
class DeformedMeshes {
 public:
  DeformedMeshes(const model::Model& model, const model::Machine& machine, const std::filesystem::path& results);

  /// Writes the meshes that are due at time `t`, `since_start` after the start of the run.
  void write(double t, double since_start, double slack, const StepRecord& step);

  void persist(Archive& archive);

 private:
  struct Series {
    std::size_t flexible = 0;  ///< index in Machine::flexibles
    double every = 0;
    fem::VtuSeries files;
    FilmPressures films;
    double next = 0;          ///< in intervals
    std::size_t next_at = 0;  ///< of the chosen times
  };

  [[nodiscard]] bool is_due(Series& series, double since_start, double slack) const;

  const model::Machine& machine_;
  const std::vector<double>& chosen_;  ///< times since the start
  std::vector<Series> series_;
};

}  // namespace hersey::run
