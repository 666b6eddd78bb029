// Beams in the results file.
#include <algorithm>

#include "recorder.h"

namespace hersey::run {
namespace {

/// Per node: displacement of the node and change of its axes (three columns), in the axes of the first node.
constexpr int kPerNode = 12;

/// Which node each corner of the beam's surface follows, where it lies from it, and the triangles between.
struct BeamSurface {
  std::vector<double> corners, node, offset, triangles;
};

void add_corner(BeamSurface& surface, const Vector3& node, int index, const Vector3& offset) {
  const Vector3 place = node + offset;
  surface.corners.insert(surface.corners.end(), place.data(), place.data() + 3);
  surface.offset.insert(surface.offset.end(), offset.data(), offset.data() + 3);
  surface.node.push_back(index);
}

void add_triangle(BeamSurface& surface, std::size_t a, std::size_t b, std::size_t c) {
  for (const std::size_t corner : {a, b, c}) surface.triangles.push_back(static_cast<double>(corner));
}

/// A ring of corners around each node, quads between the rings, fans over both ends.
BeamSurface surface_of(const model::Beam& beam) {
  BeamSurface surface;
  const std::size_t rings = beam.nodes.size(), n = beam.outline.size();
  for (std::size_t i = 0; i < rings; ++i)
    for (const Eigen::Vector2d& at : beam.outline)
      add_corner(surface, beam.nodes[i], static_cast<int>(i),
                 beam.axes[std::min(i, rings - 2)] * Vector3(0, at.x(), at.y()));
  for (std::size_t i = 0; i + 1 < rings; ++i)
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t a = i * n + k, b = i * n + (k + 1) % n;
      add_triangle(surface, a, b, b + n);
      add_triangle(surface, a, b + n, a + n);
    }
  const std::size_t last = (rings - 1) * n;
  for (std::size_t k = 1; k + 1 < n; ++k) {
    add_triangle(surface, 0, k + 1, k);
    add_triangle(surface, last, last + k, last + k + 1);
  }
  return surface;
}

const model::Beam& beam_called(const model::Model& model, const std::string& name) {
  const auto body = std::find_if(model.bodies.begin(), model.bodies.end(),
                                 [&](const model::Body& candidate) { return candidate.name == name; });
  return *body->beam;
}

/// How far nodes and their axes have moved, seen from the first node.
Eigen::VectorXd amplitudes_of(const model::Beam& beam, const model::BuiltBeam& built, const mbd::Observation& seen) {
  const auto pose = [&](std::size_t node) -> const Pose& {
    return seen.bodies[static_cast<std::size_t>(built.ids.bodies[node].index)].X_WF;
  };
  const Pose X_0W = pose(0).inverse();
  Eigen::VectorXd amplitudes(kPerNode * static_cast<Eigen::Index>(beam.nodes.size()));
  for (std::size_t i = 0; i < beam.nodes.size(); ++i) {
    const Pose X = X_0W * pose(i);
    const Matrix3 turned = X.R - Matrix3::Identity();
    amplitudes.segment<kPerNode>(kPerNode * static_cast<Eigen::Index>(i)) << X.r - beam.nodes[i], turned.col(0),
        turned.col(1), turned.col(2);
  }
  return amplitudes;
}

/// Whether a joint or force between bodies holds a node, beyond the beam itself.
bool is_held(const mbd::MechanismSpec& spec, mbd::BodyId node) {
  const auto on_node = [&](mbd::FrameId frame) {
    return spec.frames[static_cast<std::size_t>(frame.index)].body == node;
  };
  for (std::size_t j = 0; j < spec.joints.size(); ++j) {
    const mbd::JointId id{static_cast<int>(j)};
    if (std::find(spec.deforming.begin(), spec.deforming.end(), id) != spec.deforming.end()) continue;
    if (on_node(spec.joints[j].inboard) || on_node(spec.joints[j].outboard)) return true;
  }
  return std::any_of(spec.forces.begin(), spec.forces.end(),
                     [&](const mbd::MechanismSpec::Force& force) { return on_node(force.a) || on_node(force.b); });
}

}  // namespace

void Recorder::hide_inner_nodes() {
  const mbd::MechanismSpec& spec = machine_.mechanism->spec();
  hidden_bodies_.assign(spec.bodies.size(), false);
  hidden_joints_.assign(spec.joints.size(), false);
  for (const model::BuiltBeam& beam : machine_.beams) {
    for (std::size_t i = 0; i < beam.is_named.size(); ++i)
      hidden_bodies_[static_cast<std::size_t>(beam.ids.bodies[i].index)] = !beam.is_named[i];
    for (const mbd::JointId joint : beam.ids.freedoms) hidden_joints_[static_cast<std::size_t>(joint.index)] = true;
  }
}

void Recorder::declare_beams() {
  for (const model::BuiltBeam& built : machine_.beams) {
    const std::string group = "/bodies/" + built.name, path = group + "/";
    const model::Beam& beam = beam_called(model_, built.name);
    const auto nodes = static_cast<int>(beam.nodes.size()), elements = nodes - 1;
    beams_.push_back(
        {writer_.series(path + "strain_energy", 1, "J", "strain energy"),
         writer_.series(path + "dissipation", 1, "W", "power lost to the material's damping"),
         writer_.series(path + "amplitudes", kPerNode * nodes, "SI",
                        "per node: displacement [m] and change of its x-, y- and z-axis, seen from the first node"),
         writer_.series(path + "node_position", 3 * nodes, "m", "of each node in ground: x, y, z"),
         writer_.series(path + "section_force", 3 * elements, "N",
                        "per element in the axes of its middle section: normal force, shear along y and z"),
         writer_.series(path + "section_moment", 3 * elements, "N.m", "the same: torque, moments about y and z")});
    writer_.attribute(group, "beam_nodes", nodes);
    std::vector<double> places;
    for (const Vector3& node : beam.nodes) places.insert(places.end(), node.data(), node.data() + 3);
    writer_.constant(path + "nodes", places, "m", "x, y, z of each node undeformed, body axes");
    const BeamSurface surface = surface_of(beam);
    const std::string shape = group + "/shapes/surface";
    writer_.attribute(shape, "shape", "mesh");
    writer_.constant(shape + "/corners", surface.corners, "m", "x, y, z of each corner");
    writer_.constant(shape + "/triangles", surface.triangles, "1", "corners of each triangle, counted from 0");
    writer_.attribute(shape, "held_at_both_ends", is_held(machine_.mechanism->spec(), built.ids.bodies.back()) ? 1 : 0);
    writer_.constant(shape + "/node", surface.node, "1", "that each corner follows, counted from 0");
    writer_.constant(shape + "/offset", surface.offset, "m", "x, y, z of each corner from its node");
  }
}

void Recorder::write_beams(const mbd::Observation& seen) {
  for (std::size_t i = 0; i < beams_.size(); ++i) {
    const model::BuiltBeam& built = machine_.beams[i];
    const auto elements = static_cast<Eigen::Index>(built.segments.size());
    Eigen::VectorXd forces(3 * elements), moments(3 * elements), positions(3 * (elements + 1));
    double strain = 0, dissipation = 0;
    for (Eigen::Index k = 0; k < elements; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const mbd::ElasticObservation& segment = seen.elastics[static_cast<std::size_t>(built.ids.segments[at].index)];
      const fem::BeamMotionResponse section = built.segments[at]->section(segment.motion);
      forces.segment<3>(3 * k) = (section.elastic + section.viscous).head<3>();
      moments.segment<3>(3 * k) = (section.elastic + section.viscous).tail<3>();
      strain += segment.energy.strain;
      dissipation += segment.energy.dissipation;
    }
    for (Eigen::Index k = 0; k <= elements; ++k)
      positions.segment<3>(3 * k) =
          seen.bodies[static_cast<std::size_t>(built.ids.bodies[static_cast<std::size_t>(k)].index)].X_WF.r;
    beams_[i].strain.append(strain);
    beams_[i].dissipation.append(dissipation);
    beams_[i].amplitudes.append(amplitudes_of(beam_called(model_, built.name), built, seen));
    beams_[i].positions.append(positions);
    beams_[i].forces.append(forces);
    beams_[i].moments.append(moments);
  }
}

void Recorder::declare_beam_modes() {
  for (const model::BuiltBeam& built : machine_.beams) {
    const int width = kPerNode * static_cast<int>(built.is_named.size());
    const std::string path = "/modes/fields/" + built.name + "_amplitudes_";
    modes_.beams_real.push_back(writer_.series(path + "real", width, "SI", "mode shape in the beam's amplitudes"));
    modes_.beams_imaginary.push_back(writer_.series(path + "imaginary", width, "SI", "the same, imaginary part"));
  }
}

void Recorder::write_beam_mode(const solver::State& state, const Eigen::VectorXcd& shape) {
  constexpr double step = 1e-6;  // amplitudes are smooth, and of a mode linear: their difference loses six digits
  mbd::Mechanism& mechanism = *machine_.mechanism;
  const auto seen_after = [&](const Eigen::VectorXd& increment) {
    solver::State moved = state;
    mechanism.retract(state.q, increment, moved.q);
    return mechanism.observe(moved);
  };
  if (machine_.beams.empty()) return;
  const mbd::Observation here = seen_after(Eigen::VectorXd::Zero(shape.size())), real = seen_after(step * shape.real()),
                         imaginary = seen_after(step * shape.imag());
  for (std::size_t i = 0; i < machine_.beams.size(); ++i) {
    const model::BuiltBeam& built = machine_.beams[i];
    const model::Beam& beam = beam_called(model_, built.name);
    const Eigen::VectorXd rest = amplitudes_of(beam, built, here);
    modes_.beams_real[i].append(Eigen::VectorXd((amplitudes_of(beam, built, real) - rest) / step));
    modes_.beams_imaginary[i].append(Eigen::VectorXd((amplitudes_of(beam, built, imaginary) - rest) / step));
  }
}

}  // namespace hersey::run
