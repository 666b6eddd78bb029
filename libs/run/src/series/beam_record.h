#pragma once

#include <string>
#include <vector>

#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "table/quantity.h"

namespace hersey::run {

/// A beam of the model and the parts that the machine has built from it.
struct BeamPlan {
  const model::Beam& beam;
  const model::BuiltBeam& built;
  bool is_fixed_at_both_ends = false;
};

/// A beam at an instant.
struct BeamRow {
  const BeamPlan& plan;
  const mbd::Observation& observation;
  Eigen::Matrix<double, 6, Eigen::Dynamic> sections;  ///< force and moment in the middle of each element [N; N m]
};

/// Numbers in a beam's amplitudes.
[[nodiscard]] int beam_amplitude_count(const model::BuiltBeam& built);

/// Displacements and rotations of the nodes, relative to the first node, shape (beam_amplitude_count).
[[nodiscard]] Eigen::VectorXd beam_amplitudes(const model::Beam& beam, const model::BuiltBeam& built,
                                              const mbd::Observation& observation);

/// The beam of the model that `built` was made of.
[[nodiscard]] const model::Beam& beam_of(const model::Model& model, const model::BuiltBeam& built);

/// Writes the surface of a beam at rest, a shape of its body, for pictures.
/// @param group  of the body, ends with "/"
void write_beam_surface(const model::Beam& beam, const std::string& group, results::Writer& writer);

/// One beam in the results file, besides the motion of its nodes with frames.
class BeamRecord {
 public:
  /// @param model, machine  outlive this
  BeamRecord(const model::Model& model, const model::Machine& machine, const model::BuiltBeam& built,
             results::Writer& writer);
  void append(const mbd::Observation& observation) const;
  /// Adds its quantities.
  static void describe(QuantityGroup& group);
  /// Adds the quantities of its surface, a shape of the body.
  static void describe_surface(QuantityGroup& group);

 private:
  BeamPlan plan_;
  QuantityRows<BeamRow, BeamPlan> rows_;
};

}  // namespace hersey::run
