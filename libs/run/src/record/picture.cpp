#include "hersey/run/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hersey/bearing/film_coordinates.h"
#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"
#include "hersey/model/build.h"
#include "hersey/solver/initialise.h"
#include "series/beam_record.h"
#include "series/bearing_record.h"
#include "series/circuit_record.h"
#include "series/geometry_record.h"
#include "series/joint_record.h"
#include "start/start_changes.h"

namespace hersey::run {
namespace {

// Steps in which a coordinate is moved: with twice as long ones loops of slender mechanisms jump to their other branch.
constexpr double kLargestTurn = std::numbers::pi / 36;
constexpr double kLargestMove = 0.02;  // of the machine's size
constexpr int kMostSteps = 400;
constexpr int kMostHalvings = 6;

/// The bodies and joints of a model alone, all bodies rigid.
model::Model skeleton_of(const model::Model& model) {
  model::Model skeleton;
  skeleton.file = model.file;
  skeleton.gravity = model.gravity;
  skeleton.ground = model.ground;
  skeleton.simulation = model.simulation;
  skeleton.simulation.integrator = model::Integrator::generalized_alpha;
  for (const model::Body& body : model.bodies) {
    model::Body rigid;
    rigid.name = body.name;
    rigid.mass = 1;
    rigid.inertia = Matrix3::Identity();
    rigid.frames = body.frames;
    skeleton.bodies.push_back(std::move(rigid));
  }
  skeleton.joints = model.joints;
  skeleton.drives = model.drives;
  skeleton.couplings = model.couplings;
  return skeleton;
}

/// The value of the one variable: a drive that time moves.
class Identity final : public ScalarFunction {
 public:
  [[nodiscard]] double value(std::span<const double> x) const override { return x[0]; }
  void gradient(std::span<const double> /*x*/, std::span<double> gradient) const override { gradient[0] = 1; }
  [[nodiscard]] double second_derivative(std::span<const double> /*x*/) const override { return 0; }
};

model::Drive moved_by_time(const std::string& joint, const std::string& coordinate) {
  model::Drive drive;
  drive.name = "moved";
  drive.joint = joint;
  drive.coordinate = coordinate;
  drive.motion.value = std::make_shared<Identity>();
  drive.motion.variables.emplace_back();
  return drive;
}

/// True if a film goes all round its journal, whose centre it keeps on the axis of its shell.
bool surrounds(const film::FilmModel& film) {
  return film::is_round(film.surface) && !bearing::is_on_annulus(film) && film.grid.closes();
}

/// Joints that leave their bodies apart or in a plane: what else keeps them together is a film.
bool is_loose(mbd::JointType type) { return type == mbd::JointType::planar || type == mbd::JointType::free; }

/// The pose of a body alone, as BodyRecord writes it.
void write_pose(const std::string& body, const Pose& pose, results::Writer& writer) {
  const std::string group = "/bodies/" + body + "/";
  const Eigen::Quaterniond turn(pose.R);
  writer.series(group + "position", 3, "m", "origin in ground").append({pose.r.x(), pose.r.y(), pose.r.z()});
  writer.series(group + "orientation", 4, "1", "unit quaternion w, x, y, z")
      .append({turn.w(), turn.x(), turn.y(), turn.z()});
}

/// Coordinates of a joint alone, as JointRecord writes them.
void write_coordinates(const mbd::JointSpec& joint, const mbd::JointObservation& observed, results::Writer& writer) {
  const int count = mbd::degrees_of_freedom(joint.type);
  if (count == 0) return;
  const std::string group = "/joints/" + joint.name + "/";
  std::vector<std::string> names;
  for (const mbd::Coordinate& coordinate : mbd::coordinates_of(joint.type))
    for (int i = 0; i < coordinate.size; ++i)
      names.push_back(coordinate.size == 1 ? std::string(coordinate.name)
                                           : fmt::format("{}_{}", coordinate.name, "xyz"[i]));
  writer.attribute("/joints/" + joint.name, "coordinate_names", names);
  const std::string unit = count > 1 ? "SI" : is_rotational(joint, 0) ? "rad" : "m";
  const results::Series series = writer.series(group + "coordinates", count, unit, "joint coordinates");
  series.append(std::span<const double>(observed.position.data(), static_cast<std::size_t>(count)));
}

/// Middle of the points that are known of a deformable body.
Vector3 middle_of(const model::Body& body) {
  Vector3 sum = Vector3::Zero();
  if (body.beam) {
    for (const Vector3& node : body.beam->nodes) sum += node;
    return sum / static_cast<double>(body.beam->nodes.size());
  }
  if (!body.flexible || !body.flexible->mesh || body.flexible->mesh->nodes.empty()) return body.centre_of_mass;
  for (const Vector3& node : body.flexible->mesh->nodes) sum += node;
  return sum / static_cast<double>(body.flexible->mesh->nodes.size());
}

}  // namespace

struct Picture::Impl {
  explicit Impl(const model::Model& drawn) : model(drawn), skeleton(skeleton_of(drawn)) {
    if (skeleton.bodies.empty()) return;
    machine = model::build(skeleton);
    state = machine.mechanism->initial_state();
    state.t = model.simulation.start;
    machine.mechanism->count_revolutions(state);
    solver::InitialiseOptions options;
    options.fixed = machine.mechanism->given_coordinates();
    const solver::InitialiseSummary found = solver::assemble_positions(*machine.mechanism, state, options);
    if (!found.solved()) assembly.fail("the mechanism cannot be assembled: at its closest, " + gaps_text(found.open));
    rest();
  }

  /// Velocities and accelerations play no part.
  void rest() {
    state.v.setZero(machine.mechanism->nv());
    state.vdot.setZero(machine.mechanism->nv());
    state.lambda.setZero(machine.mechanism->nlambda());
    observed = machine.mechanism->observe(state);
  }

  [[nodiscard]] FrameOnBody frame(const model::FrameName& name) const {
    const auto is_called = [&](const auto& one) { return one.name == name.body; };
    const auto body = std::find_if(model.bodies.begin(), model.bodies.end(), is_called);
    const model::Body& of = body == model.bodies.end() ? model.ground : *body;
    for (const model::Frame& one : of.frames)
      if (one.name == name.frame) return {name.body, one.X_BF};
    return {name.body, Pose{}};
  }

  /// Index of a joint of the model in the mechanism, and the coordinate.
  [[nodiscard]] std::pair<std::size_t, mbd::Coordinate> find(const std::string& joint, const std::string& name) const {
    std::vector<std::string> coordinates;
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      if (model.joints[j].name != joint) continue;
      for (const mbd::Coordinate& coordinate : mbd::coordinates_of(model.joints[j].type)) {
        if (coordinate.size != 1) continue;
        if (name.empty() || coordinate.name == name) return {j, coordinate};
        coordinates.emplace_back(coordinate.name);
      }
      throw InputError(Fault{{model.file, 0, 0},
                             "joints." + joint,
                             name.empty() ? "a joint without a scalar coordinate" : "no coordinate '" + name + "'",
                             coordinates.empty() ? "a joint with one" : one_of(coordinates),
                             did_you_mean(name, coordinates)});
    }
    std::vector<std::string> joints;
    for (const model::Joint& one : model.joints) joints.push_back(one.name);
    throw InputError(Fault{{model.file, 0, 0},
                           "joints",
                           "no joint '" + joint + "'",
                           joints.empty() ? "a joint, but the model has none" : one_of(joints),
                           did_you_mean(joint, joints)});
  }

  [[nodiscard]] double value_of(std::size_t joint, const mbd::Coordinate& coordinate) const {
    return observed.joints[joint].position[coordinate.offset];
  }

  /// Each joint begins where it is now, and may move.
  void keep_positions(model::Model& moved) const {
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      model::Joint& joint = moved.joints[j];
      joint.initial.clear();
      joint.guess.clear();
      const mbd::JointValues& position = observed.joints[j].position;
      for (const mbd::Coordinate& coordinate : mbd::coordinates_of(joint.type))
        joint.guess.push_back(
            {std::string(coordinate.name),
             {position.data() + coordinate.offset, position.data() + coordinate.offset + coordinate.size},
             {}});
    }
  }

  /// Largest step of a coordinate.
  [[nodiscard]] double longest(const mbd::Coordinate& coordinate) const {
    if (coordinate.rotational) return kLargestTurn;
    double size = 0;
    for (const mbd::FrameMotion& one : observed.bodies)
      for (const mbd::FrameMotion& other : observed.bodies) size = std::max(size, (one.X_WF.r - other.X_WF.r).norm());
    return size > 0 ? kLargestMove * size : std::numeric_limits<double>::infinity();
  }

  /// Whether a journal stays in its bearing while a coordinate moves. Where a joint places it, or is moved across the
  /// film, it does not.
  [[nodiscard]] bool stays(const model::Bearing& bearing, const model::Joint& moved,
                           const mbd::Coordinate& coordinate) const {
    const std::string &shell = bearing.shell.body, &journal = bearing.journal.body;
    if (shell.empty() || journal.empty() || shell == journal || !surrounds(bearing.film)) return false;
    const auto joins = [](const model::Joint& joint, const std::string& body) {
      return joint.inboard.body == body || joint.outboard.body == body;
    };
    const auto places = [&](const model::Joint& joint) {
      return !is_loose(joint.type) && joins(joint, shell) && joins(joint, journal);
    };
    if (std::any_of(model.joints.begin(), model.joints.end(), places)) return false;
    const bool is_shifted = is_loose(moved.type) && !coordinate.rotational;
    return !is_shifted || (moved.outboard.body != shell && moved.outboard.body != journal);
  }

  /// Pose of a body in ground.
  [[nodiscard]] Pose pose_of(const std::string& name) const {
    for (std::size_t i = 0; i < skeleton.bodies.size(); ++i)
      if (skeleton.bodies[i].name == name) return observed.bodies[i + 1].X_WF;
    return {};
  }

  /// A journal keeps its place in the bearing's section and may rotate, tilt and move along the axis: a spherical joint
  /// on a body that slides in the shell.
  void close(model::Model& moved, const model::Bearing& bearing) const {
    const std::string name = "film of " + bearing.name;
    const FrameOnBody shell = frame(bearing.shell), journal = frame(bearing.journal);
    const Pose X_WS = pose_of(shell.body), X_WJ = pose_of(journal.body);
    const Matrix3 R_WF = X_WJ.R * journal.X_BF.R;
    const Vector3 r_WF = X_WJ.r + X_WJ.R * journal.X_BF.r;
    model::Frame place;
    place.name = name;
    place.X_BF = {X_WS.R.transpose() * R_WF, X_WS.R.transpose() * (r_WF - X_WS.r)};
    if (shell.body == "ground")
      moved.ground.frames.push_back(place);
    else
      for (model::Body& body : moved.bodies)
        if (body.name == shell.body) body.frames.push_back(place);
    model::Body slider;
    slider.name = name;
    slider.mass = 1;
    slider.inertia = Matrix3::Identity();
    moved.bodies.push_back(std::move(slider));
    model::Joint along, about;
    along.name = name;
    along.type = mbd::JointType::prismatic;
    along.inboard = {shell.body, name, {}};
    along.outboard = {name, "", {}};
    along.axis = place.X_BF.R.transpose() * shell.X_BF.R.col(2);
    about.name = name + ", rotation";
    about.type = mbd::JointType::spherical;
    about.inboard = {name, "", {}};
    about.outboard = bearing.journal;
    moved.joints.push_back(std::move(along));
    moved.joints.push_back(std::move(about));
  }

  Outcome move(const std::string& joint, const std::string& name, double value) {
    const auto [index, coordinate] = find(joint, name);
    if (value == value_of(index, coordinate)) return {Ending::solved};
    model::Model moved = skeleton;
    moved.drives = {moved_by_time(joint, std::string(coordinate.name))};
    keep_positions(moved);
    for (const model::Bearing& bearing : model.bearings)
      if (stays(bearing, model.joints[index], coordinate)) close(moved, bearing);
    return move(moved, joint, index, coordinate, value);
  }

  Outcome move(model::Model& moved, const std::string& joint, std::size_t index, const mbd::Coordinate& coordinate,
               double value) {
    const double from = value_of(index, coordinate), distance = value - from;
    moved.simulation.start = from;
    model::Machine built = model::build(moved);
    solver::State at = built.mechanism->initial_state();
    const int steps = std::clamp(static_cast<int>(std::ceil(std::abs(distance) / longest(coordinate))), 1, kMostSteps);
    double done = 0, step = 1.0 / steps;
    for (int halvings = 0; done < 1;) {
      solver::State trial = at;
      const double share = std::min(1.0, done + step);
      trial.t = share < 1 ? from + share * distance : value;
      const solver::InitialiseSummary found = solver::assemble_positions(*built.mechanism, trial, {});
      if (found.solved()) {
        at = std::move(trial);
        done = share;
        continue;
      }
      if (++halvings > kMostHalvings) {
        Outcome outcome;
        outcome.fail("the mechanism cannot be assembled with " + joint + " there: it follows up to " +
                     fmt::format("{:.4g} of the way; at its closest, ", done) + gaps_text(found.open));
        return outcome;
      }
      step /= 2;
    }
    machine = std::move(built);
    state = std::move(at);
    rest();
    return {Ending::solved};
  }

  const model::Model& model;
  model::Model skeleton;
  model::Machine machine;  // without mechanism where there are no bodies
  solver::State state;
  mbd::Observation observed;
  Outcome assembly{Ending::solved};
};

Picture::Picture(const model::Model& model) : impl_(std::make_unique<Impl>(model)) {}
Picture::~Picture() = default;

const Outcome& Picture::assembly() const { return impl_->assembly; }

std::vector<std::pair<std::string, Pose>> Picture::poses() const {
  std::vector<std::pair<std::string, Pose>> poses;
  for (std::size_t i = 0; i < impl_->skeleton.bodies.size(); ++i)
    poses.emplace_back(impl_->skeleton.bodies[i].name, impl_->observed.bodies[i + 1].X_WF);
  return poses;
}

double Picture::coordinate(const std::string& joint, const std::string& name) const {
  const auto [index, coordinate] = impl_->find(joint, name);
  return impl_->value_of(index, coordinate);
}

double Picture::residual() const {
  if (!impl_->machine.mechanism) return 0;
  Eigen::VectorXd phi, scale;
  impl_->machine.mechanism->constraints(impl_->state, phi, scale, nullptr);
  return phi.size() == 0 ? 0 : phi.cwiseQuotient(scale).lpNorm<Eigen::Infinity>();
}

Outcome Picture::move(const std::string& joint, const std::string& name, double value) {
  return impl_->move(joint, name, value);
}

void Picture::write(results::Writer& writer) const {
  const model::Model& model = impl_->model;
  writer.attribute("/", "title", model.title);
  writer.attribute("/", "description", model.description);
  writer.series("/time", 1, "s", "of the rows").append(model.simulation.start);
  write_ground(model.ground, model.gravity, writer);
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const model::Body& body = model.bodies[i];
    write_body(body, body.mass, body.flexible || body.beam ? middle_of(body) : body.centre_of_mass, writer);
    if (body.beam) write_beam_surface(*body.beam, "/bodies/" + body.name + "/", writer);
    write_pose(body.name, impl_->observed.bodies[i + 1].X_WF, writer);
  }
  if (impl_->machine.mechanism) {
    const mbd::MechanismSpec& spec = impl_->machine.mechanism->spec();
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      write_joint_position(spec, spec.joints[j], writer);
      write_coordinates(spec.joints[j], impl_->observed.joints[j], writer);
    }
  }
  for (const model::Bearing& bearing : model.bearings) {
    write_bearing_plan(model, bearing, writer);
    if (!bearing.shell.body.empty() && !bearing.journal.body.empty())
      write_link("/bearings/" + bearing.name + "/", impl_->frame(bearing.shell), impl_->frame(bearing.journal), writer);
  }
  if (model.circuit) write_circuit_plan(*model.circuit, writer);
  for (const model::Contact& contact : model.contacts)
    write_link("/contacts/" + contact.name + "/", {contact.first.body, Pose{}}, {contact.second.body, Pose{}}, writer);
  for (const model::Force& force : model.forces)
    if (const std::vector<model::FrameName> frames = model::frames_of(force); frames.size() == 2)
      write_link("/forces/" + force.name + "/", impl_->frame(frames[0]), impl_->frame(frames[1]), writer);
}

}  // namespace hersey::run
