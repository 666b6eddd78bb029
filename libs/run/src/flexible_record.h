#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "hersey/fem/vtu_file.h"
#include "hersey/mbd/mechanism.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"

namespace hersey::run {

/// Deformed meshes of flexible bodies in ground's axes, as series for ParaView: <results>_<body>.pvd.
class DeformedMeshes {
 public:
  DeformedMeshes(const model::Model& model, const model::Machine& machine, const std::filesystem::path& results);

  /// Writes those that are due at time `t`, `since_start` after the start of the run.
  void write(double t, double since_start, double slack, const mbd::Observation& seen);

  void persist(Archive& archive);

 private:
  struct Series {
    std::size_t flexible = 0;  ///< place in Machine::flexibles
    double every = 0;
    fem::VtuSeries files;
    double next = 0;  ///< in intervals
  };

  const model::Machine& machine_;
  std::vector<Series> series_;
};

}  // namespace hersey::run
