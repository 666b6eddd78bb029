#pragma once

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

#include "hersey/fem/shape_stress.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/results/reader.h"

namespace hersey::run {

/// Displacements and stresses of a flexible body at one instant of a run, in the body's axes.
struct BodyStressAt {
  double time = 0;                                  ///< [s]
  std::optional<double> crank_angle;                ///< [rad]; of a model with a crank
  Eigen::MatrixXd displacement;                     ///< of the nodes, shape (3, nodes) [m]
  Eigen::Matrix<double, 6, Eigen::Dynamic> stress;  ///< at the nodes: xx, yy, zz, xy, yz, xz [Pa]
  Eigen::VectorXd von_mises;                        ///< of `stress`, shape (nodes) [Pa]
  Eigen::Index node = 0;                            ///< with the largest
};

/// Largest equivalent stress of a body at one instant.
struct StressPeak {
  std::size_t instant = 0;  ///< row of the results
  double time = 0;
  std::optional<double> crank_angle;
  double von_mises = 0;   ///< [Pa]
  Eigen::Index node = 0;  ///< index in the mesh
};

/// Stresses of a flexible body with `form: modal` over a finished run, recovered from the amplitudes of its shapes in
/// the results: all that deforms it is in them, films, joints, loads and its own inertia, but not the stress of
/// temperatures. The body is reduced again for its shapes, and these are compared with those of the results.
/// @verified_by loads_test.py
class BodyStress {
 public:
  /// @param results  outlives this
  /// @param body     empty: the only flexible one
  /// @throws InputError where there is no such body, or it has no amplitudes that say all of its deformation
  BodyStress(const results::Reader& results, const model::Model& model, const std::string& body);

  /// Name of the body.
  [[nodiscard]] const std::string& body() const { return flexible_.name; }
  /// Its mesh.
  [[nodiscard]] const fem::Mesh& mesh() const { return *flexible_.mesh; }
  /// Number of shapes it moves in.
  [[nodiscard]] Eigen::Index shapes() const { return flexible_.shapes.cols(); }
  [[nodiscard]] const std::vector<double>& times() const { return times_; }  ///< [s], of the rows
  /// Returns displacements and stresses at a row of the results.
  [[nodiscard]] BodyStressAt at(std::size_t instant) const;

  /// Largest stresses over the run.
  struct Envelope {
    std::vector<StressPeak> peaks;  ///< of every instant
    Eigen::VectorXd largest, when;  ///< largest equivalent stress of each node and its time [Pa, s]
  };
  /// Goes through all instants once.
  [[nodiscard]] Envelope envelope() const;

 private:
  [[nodiscard]] Eigen::VectorXd amplitudes_at(std::size_t instant) const;
  void require_same_shapes() const;

  const results::Reader& results_;
  model::BuiltFlexible flexible_;
  std::optional<fem::ShapeStress> shape_stress_;
  std::vector<double> times_, crank_angles_;
};

/// Returns at most `most` instants at which the largest stress is not smaller than before and after, the largest first.
[[nodiscard]] std::vector<StressPeak> largest_stresses(const std::vector<StressPeak>& peaks, std::size_t most);

}  // namespace hersey::run
