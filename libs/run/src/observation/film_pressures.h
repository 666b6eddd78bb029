#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <vector>

#include "hersey/fem/film_pressure.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "observation/step_record.h"

namespace hersey::run {

/// Pressures of the films on the nodes of a flexible body's mesh.
class FilmPressures {
 public:
  /// @param body  name of the flexible body
  FilmPressures(const model::Model& model, const model::Machine& machine, const std::string& body);

  /// True if there is any film on the mesh.
  [[nodiscard]] bool has_any() const { return !surfaces_.empty(); }

  struct AtNodes {
    Eigen::VectorXd film, contact;  ///< pressure of oil and asperities together, and of asperities alone [Pa]
  };
  /// At the nodes of the mesh, zero where there is no film.
  [[nodiscard]] AtNodes at_nodes(const StepRecord& step) const;

 private:
  struct Surface {
    std::size_t bearing = 0;
    bool is_shell = true;
    Eigen::VectorXd phi, z;  ///< of the film's nodes, on the shell
    fem::SurfacePressure mesh;
  };
  void add(const model::Bearing& bearing, std::size_t i, bool is_shell, const fem::Mesh& mesh);

  const model::Machine& machine_;
  std::size_t nodes_ = 0;
  std::vector<Surface> surfaces_;
};

}  // namespace hersey::run
