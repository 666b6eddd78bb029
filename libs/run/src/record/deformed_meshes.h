#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "hersey/fem/shape_stress.h"
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
    std::optional<fem::ShapeStress> shape_stress;  ///< where it is worth its making
    double next = 0;                               ///< in intervals
    std::size_t next_at = 0;                       ///< of the chosen times
  };

  /// In the body's axes, which rotate with it, shape (6, nodes).
  [[nodiscard]] Eigen::MatrixXd stress_of(const Series& series, const mbd::ElasticMotion& motion,
                                          const Eigen::VectorXd& u) const;
  [[nodiscard]] bool is_due(Series& series, double since_start, double slack) const;

  const model::Machine& machine_;
  const std::vector<double>& chosen_;  ///< times since the start
  std::vector<Series> series_;
};

}  // namespace hersey::run
