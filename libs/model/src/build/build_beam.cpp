#include "build/build_beam.h"

#include <algorithm>
#include <utility>

#include "hersey/core/contract.h"

namespace hersey::model {
namespace {

/// The name of a node: that of the first frame on it, or its number.
std::string name_of(const Body& body, int node) {
  const auto frame = std::find_if(body.frames.begin(), body.frames.end(),
                                  [&](const Frame& candidate) { return candidate.nodes.front() == node; });
  return frame != body.frames.end() ? frame->name : "node " + std::to_string(node + 1);
}

double length_of(const Beam& beam) {
  double length = 0;
  for (std::size_t i = 1; i < beam.nodes.size(); ++i) length += (beam.nodes[i] - beam.nodes[i - 1]).norm();
  return length;
}

}  // namespace

BuiltBeam build_beam(const Body& body, mbd::MechanismBuilder& mechanism) {
  HERSEY_REQUIRE(body.beam && body.beam->axes.size() + 1 == body.beam->nodes.size(), "the reader checks beams");
  const Beam& beam = *body.beam;
  mbd::BeamSegmentData data;
  data.element.stiffness = fem::beam_stiffness(beam.section, beam.material);
  data.mass_per_length = beam.mass_per_length;
  data.inertia_per_length = beam.inertia_per_length;
  data.damping = beam.damping;
  data.reach = length_of(beam);

  BuiltBeam built;
  built.name = body.name;
  std::vector<std::string> names;
  std::vector<std::shared_ptr<mbd::ElasticBody>> segments;
  for (std::size_t i = 0; i < beam.axes.size(); ++i) {
    data.element.frame = beam.axes[i];
    data.element.length = (beam.nodes[i + 1] - beam.nodes[i]).norm();
    built.segments.push_back(std::make_shared<mbd::BeamSegment>(data));
    segments.push_back(built.segments.back());
    names.push_back(name_of(body, static_cast<int>(i) + 1));
  }
  built.ids = mechanism.add_beam_body(body.name, names, std::move(segments));
  built.is_named.assign(beam.nodes.size(), false);
  built.is_named[0] = true;
  for (const Frame& frame : body.frames) built.is_named[static_cast<std::size_t>(frame.nodes.front())] = true;
  return built;
}

}  // namespace hersey::model
