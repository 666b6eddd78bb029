#include "hersey/mbd/mechanism_builder.h"

#include <fmt/format.h>

#include <cmath>

#include "hersey/core/contract.h"
#include "hersey/core/input_error.h"
#include "hersey/mbd/mechanism.h"

namespace hersey::mbd {
namespace {

template <class IdType, class Part>
IdType append(std::vector<Part>& parts, Part part) {
  parts.push_back(std::move(part));
  return {static_cast<int>(parts.size()) - 1};
}

Fault fault(const std::string& path, const std::string& found, const std::string& expected) {
  return {.position = {}, .path = path, .found = found, .expected = expected, .suggestion = {}};
}

void check_body(const BodySpec& body, std::vector<Fault>& faults) {
  const std::string path = "bodies." + body.name;
  if (!(body.mass >= 0) || !std::isfinite(body.mass))
    faults.push_back(fault(path + ".mass", fmt::format("{:g} kg", body.mass), "a finite mass >= 0"));
  if (!body.inertia.allFinite() || !body.com.allFinite()) {
    faults.push_back(fault(path, "an inertia or centre of mass that is not finite", "finite numbers"));
    return;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(body.inertia, Eigen::EigenvaluesOnly);
  const Vector3 I = solver.eigenvalues();  // ascending
  // Round-off of measured or CAD inertias (six digits) may break the triangle inequality of thin bodies.
  const double slack = 1e-5 * I.cwiseAbs().maxCoeff();
  if (I[0] < -slack || I[2] > I[0] + I[1] + slack)
    faults.push_back(fault(path + ".inertia",
                           fmt::format("principal moments {:g}, {:g}, {:g} kg.m^2", I[0], I[1], I[2]),
                           "three moments >= 0, none larger than the sum of the other two"));
}

void check_spring(const CoordinateSpringSpec& s, std::vector<Fault>& faults) {
  if (!(s.stiffness >= 0) || !(s.damping >= 0))
    faults.push_back(
        fault("forces." + s.name, fmt::format("stiffness {:g}, damping {:g}", s.stiffness, s.damping), "both >= 0"));
}

bool same(const CoordinateRef& a, const CoordinateRef& b) { return a.joint == b.joint && a.value == b.value; }

void check_drives(const std::vector<DriveSpec>& drives, std::vector<Fault>& faults) {
  for (std::size_t i = 0; i < drives.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (same(drives[i].coordinate, drives[j].coordinate))
        faults.push_back(fault("drives." + drives[i].name,
                               "a coordinate that drive " + drives[j].name + " moves already",
                               "one drive per coordinate"));
}

void check_couplings(const std::vector<CouplingSpec>& couplings, std::vector<Fault>& faults) {
  for (const CouplingSpec& coupling : couplings)
    for (const CouplingSpec::Term& term : coupling.terms)
      if (same(term.input, coupling.output))
        faults.push_back(fault("couplings." + coupling.name, "a coordinate that depends on itself",
                               "an input that is another coordinate than the output"));
}

}  // namespace

MechanismBuilder::MechanismBuilder() { add_body({.name = "ground"}); }

FrameId MechanismBuilder::frame_of(BodyId body) const {
  HERSEY_REQUIRE(0 <= body.index && body.index < static_cast<int>(spec_.bodies.size()), "the body exists");
  return spec_.body_frames[body.index];
}

BodyId MechanismBuilder::add_body(BodySpec body) {
  const std::string name = body.name;
  const BodyId id = append<BodyId>(spec_.bodies, std::move(body));
  spec_.body_frames.push_back(add_frame({.name = name, .body = id, .X_BF = {}}));
  return id;
}

FrameId MechanismBuilder::add_frame(FrameSpec frame) {
  HERSEY_REQUIRE(0 <= frame.body.index && frame.body.index < static_cast<int>(spec_.bodies.size()), "the body exists");
  HERSEY_REQUIRE(frame.X_BF.R.isUnitary(1e-9) && frame.X_BF.R.determinant() > 0, "a frame's axes are a rotation");
  return append<FrameId>(spec_.frames, std::move(frame));
}

JointId MechanismBuilder::add_joint(JointSpec joint) {
  const auto n = static_cast<std::size_t>(degrees_of_freedom(joint.type));
  const int frames = static_cast<int>(spec_.frames.size());
  HERSEY_REQUIRE(0 <= joint.inboard.index && joint.inboard.index < frames, "the inboard frame exists");
  HERSEY_REQUIRE(0 <= joint.outboard.index && joint.outboard.index < frames, "the outboard frame exists");
  HERSEY_REQUIRE(joint.axis.norm() > 0, "a joint's axis has a direction");
  HERSEY_REQUIRE(joint.initial.empty() || joint.initial.size() == n,
                 joint.name + ": one initial value per degree of freedom");
  HERSEY_REQUIRE(joint.initial_rate.empty() || joint.initial_rate.size() == n,
                 joint.name + ": one rate per degree of freedom");
  joint.axis.normalize();
  return append<JointId>(spec_.joints, std::move(joint));
}

ForceId MechanismBuilder::add_force(std::string name, FrameId a, FrameId b, std::shared_ptr<TwoBodyForce> force,
                                    const ForceSurfaces& surfaces) {
  const int frames = static_cast<int>(spec_.frames.size());
  HERSEY_REQUIRE(0 <= a.index && a.index < frames && 0 <= b.index && b.index < frames, "both frames exist");
  HERSEY_REQUIRE(force != nullptr, "there is a force");
  for (const std::optional<ElasticId>& side : {surfaces.a, surfaces.b})
    HERSEY_REQUIRE(!side || spec_.elastics.at(static_cast<std::size_t>(side->index)).body->shape_count() > 0,
                   "a body whose surfaces deform");
  return append<ForceId>(spec_.forces, MechanismSpec::Force{std::move(name), a, b, std::move(force), surfaces});
}

void MechanismBuilder::add_shared_unknowns(std::string name, std::shared_ptr<SharedUnknowns> unknowns,
                                           std::vector<CoordinateRef> coordinates) {
  HERSEY_REQUIRE(unknowns != nullptr, "there are unknowns");
  spec_.shared.push_back({std::move(name), std::move(unknowns), std::move(coordinates)});
}

LoadId MechanismBuilder::add_load(LoadSpec load) {
  HERSEY_REQUIRE(0 <= load.frame.index && load.frame.index < static_cast<int>(spec_.frames.size()), "the frame exists");
  for (const LoadTerm& term : load.terms) HERSEY_REQUIRE(term.magnitude != nullptr, "each term has a magnitude");
  return append<LoadId>(spec_.loads, std::move(load));
}

CoordinateForceId MechanismBuilder::add_coordinate_force(std::string name, CoordinateRef coordinate,
                                                         std::shared_ptr<CoordinateForce> force) {
  HERSEY_REQUIRE(force != nullptr, "there is a force");
  return append<CoordinateForceId>(spec_.coordinate_forces,
                                   MechanismSpec::CoordinateForce{std::move(name), coordinate, std::move(force)});
}

SpringId MechanismBuilder::add_spring(CoordinateSpringSpec spring) {
  return append<SpringId>(spec_.springs, std::move(spring));
}

DriveId MechanismBuilder::add_drive(DriveSpec drive) {
  HERSEY_REQUIRE(drive.function != nullptr, "a drive has a function of time");
  return append<DriveId>(spec_.drives, std::move(drive));
}

CouplingId MechanismBuilder::add_coupling(CouplingSpec coupling) {
  for (const CouplingSpec::Term& term : coupling.terms)
    HERSEY_REQUIRE(term.function != nullptr, "each term of a coupling has a function");
  return append<CouplingId>(spec_.couplings, std::move(coupling));
}

BodyId MechanismBuilder::add_free_frame(const std::string& name, BodyId base, const Pose& rest) {
  const FrameId inboard = add_frame({.name = name + " at rest", .body = base, .X_BF = rest});
  const BodyId body = add_body({.name = name});
  // Given values, so that the assembly at the start leaves the body undeformed where it can.
  spec_.deforming.push_back(add_joint({.name = name,
                                       .type = JointType::free,
                                       .inboard = inboard,
                                       .outboard = frame_of(body),
                                       .initial = std::vector<double>(6, 0.0)}));
  return body;
}

FlexibleBodyIds MechanismBuilder::add_flexible_body(const std::string& name,
                                                    const std::vector<std::string>& frame_names,
                                                    std::shared_ptr<ElasticBody> body) {
  HERSEY_REQUIRE(body != nullptr, "there is a body");
  HERSEY_REQUIRE(static_cast<int>(frame_names.size()) + 1 == body->frame_count(),
                 "a name for each frame but the first");
  FlexibleBodyIds ids;
  ids.bodies.push_back(add_body({.name = name}));
  ids.frames.push_back(frame_of(ids.bodies[0]));
  std::vector<JointId> freedoms;
  for (std::size_t i = 0; i < frame_names.size(); ++i) {
    ids.bodies.push_back(
        add_free_frame(name + "." + frame_names[i], ids.bodies[0], body->rest_pose(static_cast<int>(i) + 1)));
    freedoms.push_back(spec_.deforming.back());
    ids.frames.push_back(frame_of(ids.bodies.back()));
  }
  ids.elastic =
      append<ElasticId>(spec_.elastics, MechanismSpec::Elastic{name, ids.frames, freedoms, std::move(body), {}, {}});
  return ids;
}

void MechanismBuilder::add_nodal_load(ElasticId elastic, const NodalLoad& load,
                                      std::shared_ptr<const ScalarFunction> value) {
  HERSEY_REQUIRE(value != nullptr, "a load has a function of time");
  MechanismSpec::Elastic& body = spec_.elastics.at(static_cast<std::size_t>(elastic.index));
  body.body->add_load(load);
  body.load_names.push_back(load.name);
  body.loads.push_back(std::move(value));
}

std::size_t MechanismBuilder::nodal_loads(ElasticId elastic) const {
  return spec_.elastics.at(static_cast<std::size_t>(elastic.index)).loads.size();
}

BeamBodyIds MechanismBuilder::add_beam_body(const std::string& name, const std::vector<std::string>& node_names,
                                            std::vector<std::shared_ptr<ElasticBody>> segments) {
  HERSEY_REQUIRE(!segments.empty() && node_names.size() == segments.size(), "a name for each node but the first");
  BeamBodyIds ids;
  ids.bodies.push_back(add_body({.name = name}));
  ids.frames.push_back(frame_of(ids.bodies[0]));
  Pose rest;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    HERSEY_REQUIRE(segments[i] != nullptr && segments[i]->frame_count() == 2, "a segment has two frames");
    rest = rest * segments[i]->rest_pose(1);
    ids.bodies.push_back(add_free_frame(name + "." + node_names[i], ids.bodies[0], rest));
    ids.frames.push_back(frame_of(ids.bodies.back()));
    ids.freedoms.push_back(spec_.deforming.back());
    ids.segments.push_back(append<ElasticId>(
        spec_.elastics, MechanismSpec::Elastic{name, {ids.frames[i], ids.frames[i + 1]}, {}, std::move(segments[i])}));
  }
  return ids;
}

std::unique_ptr<Mechanism> MechanismBuilder::finalise() {
  std::vector<Fault> faults;
  for (const BodySpec& body : spec_.bodies) check_body(body, faults);
  for (const JointSpec& joint : spec_.joints)
    if (spec_.frames[joint.inboard.index].body == spec_.frames[joint.outboard.index].body)
      faults.push_back(fault("joints." + joint.name, "two frames of one body", "frames of two different bodies"));
  for (const CoordinateSpringSpec& spring : spec_.springs) check_spring(spring, faults);
  check_drives(spec_.drives, faults);
  check_couplings(spec_.couplings, faults);
  if (!faults.empty()) throw InputError(std::move(faults));
  return std::make_unique<Mechanism>(std::move(spec_));
}

}  // namespace hersey::mbd
