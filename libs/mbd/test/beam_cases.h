#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hersey/mbd/beam_segment.h"
#include "hersey/mbd/mechanism.h"
#include "hersey/mbd/mechanism_builder.h"

namespace hersey::mbd::test {

/// A straight beam along x from its first node on, section axes those of the body.
struct StraightBeam {
  double length = 1;
  int elements = 10;
  fem::BeamStiffness stiffness;
  double mass_per_length = 1;
  Vector3 inertia_per_length = Vector3::Zero();
  double damping = 0;

  [[nodiscard]] BeamBodyIds add_to(MechanismBuilder& b, const std::string& name = "beam") const {
    BeamSegmentData data;
    data.element.length = length / elements;
    data.element.stiffness = stiffness;
    data.mass_per_length = mass_per_length;
    data.inertia_per_length = inertia_per_length;
    data.damping = damping;
    data.reach = length;
    std::vector<std::string> names;
    std::vector<std::shared_ptr<ElasticBody>> segments;
    for (int i = 1; i <= elements; ++i) {
      names.push_back(std::to_string(i));
      segments.push_back(std::make_shared<BeamSegment>(data));
    }
    return b.add_beam_body(name, names, std::move(segments));
  }
};

}  // namespace hersey::mbd::test
