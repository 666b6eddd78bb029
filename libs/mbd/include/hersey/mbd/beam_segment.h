#pragma once

#include "hersey/fem/beam.h"
#include "hersey/mbd/elastic_body.h"

namespace hersey::mbd {

/// Data of a straight beam element between two frames.
struct BeamSegmentData {
  fem::BeamElement element;                      ///< element frame in the axes that both frames have at rest
  double mass_per_length = 0;                    ///< [kg/m]
  Vector3 inertia_per_length = Vector3::Zero();  ///< inertia of the section about its own x, y and z [kg m]
  double damping = 0;                            ///< forces of strain rates over those of strains [s]
  double reach = 0;                              ///< size of the whole beam, whose round-off its positions carry [m]
};

/// One element of a beam of any rotation and small strain, which shares its frames with its neighbours (theory manual
/// eq. (beams.1) to (beams.6)): forces of strains and of their rates as the element of `fem` has
/// them, the mass of linearly moving points, half of the sections' inertia on each frame.
class BeamSegment final : public ElasticBody {
 public:
  /// @pre length, mass and stiffness > 0, damping >= 0
  explicit BeamSegment(const BeamSegmentData& data);

  [[nodiscard]] int frame_count() const override { return 2; }
  [[nodiscard]] int coordinate_count() const override { return 0; }
  [[nodiscard]] Pose rest_pose(int i) const override;
  [[nodiscard]] double mass() const override { return data_.mass_per_length * data_.element.length; }
  [[nodiscard]] Vector3 centre() const override { return rest_pose(1).r / 2; }
  void evaluate(const ElasticMotion& motion, bool want_tangent, ElasticResponse& response) override;
  [[nodiscard]] ElasticEnergy energy(const ElasticMotion& motion, const Vector3& gravity) override;

  /// Returns the strains, and [N; M] in the axes of the middle section.
  [[nodiscard]] fem::BeamMotionResponse section(const ElasticMotion& motion) const;
  [[nodiscard]] const BeamSegmentData& data() const { return data_; }

 private:
  /// Returns the inertia forces including the weight, [moment; force] at each frame in its axes.
  [[nodiscard]] fem::BeamVector inertia_force(const ElasticMotion& motion) const;
  [[nodiscard]] fem::BeamVector magnitude(const ElasticMotion& motion, const fem::BeamVector& inertia,
                                          const fem::BeamMotionResponse& strained) const;
  void differentiate_inertia(const ElasticMotion& motion, ElasticResponse& response) const;

  BeamSegmentData data_;
  Matrix3 inertia_;            ///< inertia of half of the sections in a frame's axes [kg m^2]
  fem::BeamVector round_off_;  ///< magnitude of forces by the round-off of positions
};

}  // namespace hersey::mbd
