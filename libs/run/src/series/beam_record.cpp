#include "series/beam_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace hersey::run {
namespace {

/// Per node: displacement of the node and change of its axes (three columns), in the axes of the first node.
constexpr int kPerNode = 12;

/// Which node each corner of the beam's surface follows, where it lies from it, and the triangles between.
struct BeamSurface {
  std::vector<double> corners, node, offset, triangles;
};

void add_corner(BeamSurface& surface, const Vector3& node, int index, const Vector3& offset) {
  const Vector3 corner = node + offset;
  surface.corners.insert(surface.corners.end(), corner.data(), corner.data() + 3);
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

/// True if a joint or force between bodies supports a node, besides the beam itself.
bool is_fixed(const mbd::MechanismSpec& spec, mbd::BodyId node) {
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

Eigen::VectorXd node_positions(const BeamRow& row) {
  const std::vector<mbd::BodyId>& nodes = row.plan.built.ids.bodies;
  Eigen::VectorXd positions(3 * static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t k = 0; k < nodes.size(); ++k)
    positions.segment<3>(3 * static_cast<Eigen::Index>(k)) =
        row.observation.bodies[static_cast<std::size_t>(nodes[k].index)].X_WF.r;
  return positions;
}

/// @param first  of three components
auto sections(Eigen::Index first) {
  return [first](const BeamRow& row) { return Eigen::VectorXd(row.sections.middleRows<3>(first).reshaped()); };
}

auto sum_of_segments(double mbd::ElasticEnergy::*energy) {
  return [energy](const BeamRow& row) {
    double sum = 0;
    for (const mbd::ElasticId id : row.plan.built.ids.segments)
      sum += row.observation.elastics[static_cast<std::size_t>(id.index)].energy.*energy;
    return sum;
  };
}

/// Extent with a fixed number of values for each node or element.
Extent<BeamPlan> per_node(int numbers) {
  return {fmt::format("{} nodes", numbers), [numbers](const BeamPlan& plan, std::size_t /*k*/) {
            return std::vector{numbers * static_cast<int>(plan.beam.nodes.size())};
          }};
}
Extent<BeamPlan> per_element(int numbers) {
  return {fmt::format("{} elements", numbers), [numbers](const BeamPlan& plan, std::size_t /*k*/) {
            return std::vector{numbers * (static_cast<int>(plan.beam.nodes.size()) - 1)};
          }};
}

const QuantityTable<BeamRow, BeamPlan>& beam_quantities() {
  static const QuantityTable<BeamRow, BeamPlan> table{
      {"strain_energy", "J", "strain energy", sum_of_segments(&mbd::ElasticEnergy::strain), {.note = "of a beam"}},
      {"dissipation",
       "W",
       "power lost to the material's damping",
       sum_of_segments(&mbd::ElasticEnergy::dissipation),
       {.note = "of a beam"}},
      {"amplitudes",
       "SI",
       "per node: displacement [m] and change of its x-, y- and z-axis, relative to the first node",
       [](const BeamRow& row) { return beam_amplitudes(row.plan.beam, row.plan.built, row.observation); },
       {.note = "of a beam", .extent = per_node(kPerNode)}},
      {"node_position",
       "m",
       "of each node in ground: x, y, z",
       node_positions,
       {.note = "of a beam; nodes with frames are bodies `<b>.<frame>` too", .extent = per_node(3)}},
      {"section_force",
       "N",
       "per element in the axes of its middle section: normal force, shear along y and z",
       sections(0),
       {.note = "of a beam", .extent = per_element(3)}},
      {"section_moment",
       "N.m",
       "the same: torque, moments about y and z",
       sections(3),
       {.note = "of a beam", .extent = per_element(3)}},
  };
  return table;
}

const std::vector<Constant<BeamPlan>>& beam_constants() {
  static const std::vector<Constant<BeamPlan>> table{
      {"nodes",
       "m",
       "x, y, z of each node undeformed, body axes",
       "[3 nodes]",
       [](const BeamPlan& plan) {
         std::vector<double> coordinates;
         for (const Vector3& node : plan.beam.nodes)
           coordinates.insert(coordinates.end(), node.data(), node.data() + 3);
         return coordinates;
       },
       {},
       {.note = "of a beam"}},
  };
  return table;
}

/// Constants of the beam's surface, a shape.
const std::vector<Constant<BeamPlan>>& surface_constants() {
  const auto of_surface = [](std::vector<double> BeamSurface::*member) {
    return [member](const BeamPlan& plan) { return surface_of(plan.beam).*member; };
  };
  static const std::vector<Constant<BeamPlan>> table{
      {"corners", "m", "x, y, z of each corner", "[3 corners]", of_surface(&BeamSurface::corners)},
      {"triangles", "1", "corners of each triangle, counted from 0", "[3 triangles]",
       of_surface(&BeamSurface::triangles)},
      {"node", "1", "that each corner follows, counted from 0", "[corners]", of_surface(&BeamSurface::node)},
      {"offset", "m", "x, y, z of each corner from its node", "[3 corners]", of_surface(&BeamSurface::offset)},
  };
  return table;
}

const std::vector<Attribute<BeamPlan>>& beam_attributes() {
  static const std::vector<Attribute<BeamPlan>> table{{"beam_nodes", "1", "nodes of a beam", [](const BeamPlan& plan) {
                                                         return static_cast<int>(plan.beam.nodes.size());
                                                       }}};
  return table;
}

/// Attributes of the beam's surface, a shape.
const std::vector<Attribute<BeamPlan>>& surface_attributes() {
  static const std::vector<Attribute<BeamPlan>> table{
      {"shape", "", "`mesh`", [](const BeamPlan& /*plan*/) { return "mesh"; }},
      {"held_at_both_ends", "1", "1: a joint or force holds the last node of the beam",
       [](const BeamPlan& plan) { return plan.is_fixed_at_both_ends ? 1 : 0; }}};
  return table;
}

std::string group_of(const model::BuiltBeam& built) { return "/bodies/" + built.name + "/"; }

}  // namespace

int beam_amplitude_count(const model::BuiltBeam& built) { return kPerNode * static_cast<int>(built.is_named.size()); }

Eigen::VectorXd beam_amplitudes(const model::Beam& beam, const model::BuiltBeam& built,
                                const mbd::Observation& observation) {
  const auto pose = [&](std::size_t node) -> const Pose& {
    return observation.bodies[static_cast<std::size_t>(built.ids.bodies[node].index)].X_WF;
  };
  const Pose X_0W = pose(0).inverse();
  Eigen::VectorXd amplitudes(beam_amplitude_count(built));
  for (std::size_t i = 0; i < beam.nodes.size(); ++i) {
    const Pose X = X_0W * pose(i);
    const Matrix3 turned = X.R - Matrix3::Identity();
    amplitudes.segment<kPerNode>(kPerNode * static_cast<Eigen::Index>(i)) << X.r - beam.nodes[i], turned.col(0),
        turned.col(1), turned.col(2);
  }
  return amplitudes;
}

const model::Beam& beam_of(const model::Model& model, const model::BuiltBeam& built) {
  const auto body = std::find_if(model.bodies.begin(), model.bodies.end(),
                                 [&](const model::Body& candidate) { return candidate.name == built.name; });
  return *body->beam;
}

BeamRecord::BeamRecord(const model::Model& model, const model::Machine& machine, const model::BuiltBeam& built,
                       results::Writer& writer)
    : plan_{beam_of(model, built), built, is_fixed(machine.mechanism->spec(), built.ids.bodies.back())},
      rows_(beam_quantities(), group_of(built), plan_, writer) {
  write_once(beam_attributes(), group_of(built), plan_, writer);
  write_once(beam_constants(), group_of(built), plan_, writer);
  write_once(surface_attributes(), group_of(built) + "shapes/surface/", plan_, writer);
  write_once(surface_constants(), group_of(built) + "shapes/surface/", plan_, writer);
}

void write_beam_surface(const model::Beam& beam, const std::string& group, results::Writer& writer) {
  const model::BuiltBeam unbuilt;
  const BeamPlan plan{beam, unbuilt};
  write_once(surface_attributes(), group + "shapes/surface/", plan, writer);
  write_once(surface_constants(), group + "shapes/surface/", plan, writer);
}

void BeamRecord::append(const mbd::Observation& observation) const {
  const auto& segments = plan_.built.segments;
  BeamRow row{plan_, observation, {}};
  row.sections.resize(6, static_cast<Eigen::Index>(segments.size()));
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const auto elastic = static_cast<std::size_t>(plan_.built.ids.segments[k].index);
    const fem::BeamMotionResponse section = segments[k]->section(observation.elastics[elastic].motion);
    row.sections.col(static_cast<Eigen::Index>(k)) = section.elastic + section.viscous;
  }
  rows_.append(row);
}

void BeamRecord::describe(QuantityGroup& group) {
  run::describe(beam_attributes(), "n", group);
  run::describe(beam_quantities(), "n", group);
  run::describe(beam_constants(), "n", group);
}

void BeamRecord::describe_surface(QuantityGroup& group) {
  QuantityGroup surface;
  run::describe(surface_attributes(), "n", surface);
  run::describe(surface_constants(), "n", surface);
  for (QuantityInfo& quantity : surface.quantities) {
    quantity.note = "of a beam's surface, the shape `surface`";
    group.quantities.push_back(std::move(quantity));
  }
}

}  // namespace hersey::run
