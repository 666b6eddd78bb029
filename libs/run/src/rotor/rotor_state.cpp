#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "hersey/core/input_error.h"
#include "hersey/mbd/gear_mesh.h"
#include "hersey/mbd/unbalance.h"
#include "hersey/model/build.h"
#include "hersey/run/rotor.h"
#include "hersey/solver/equilibrium.h"
#include "hersey/solver/spinning.h"
#include "start/rolling_wheels.h"
#include "start/start.h"
#include "time_stepping/steady_heat.h"

namespace hersey::run {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Twists = Eigen::Matrix<double, 6, Eigen::Dynamic>;

constexpr double kMisfit = 1e-9;        // of what joints must permit: round-off of a few rotations
constexpr double kAlike = 1e-5;         // of the forces of a row: how much those of a shaft may change as it spins on
constexpr double kSpinOn = 0.7;         // rad, of no symmetry that a machine is likely to have
constexpr double kSameSpeed = 1e-9;     // relative
constexpr double kParallel = 1e-6;      // sine of the angle between axes that are one
constexpr double kTeethPart = 1e-9;     // m, of teeth: below the roughness of any flank, above round-off
constexpr double kAlikeMotions = 1e-4;  // relative difference of displacements

/// How a body spins: about a line that it carries along.
struct BodySpin {
  Vector3 omega = Vector3::Zero();   ///< in the body's axes [rad/s]; zero: it does not spin
  Vector3 centre = Vector3::Zero();  ///< point of the line nearest to the body's origin, in the body's axes [m]
  bool is_driven = false;            ///< a drive rotates it, not the teeth of wheels
};

/// Velocities that drives prescribe, all others zero.
VectorXd driven_velocities(mbd::Mechanism& mechanism, const solver::State& start) {
  VectorXd phi, scale;
  solver::Equations::SparseMatrix G;
  mechanism.constraints(start, phi, scale, &G);
  VectorXd v = start.v;
  for (Index column = 0; column < v.size(); ++column) {
    bool is_constrained = false;
    for (solver::Equations::SparseMatrix::InnerIterator entry(G, column); entry; ++entry)
      is_constrained = is_constrained || entry.value() != 0;
    if (!is_constrained) v[column] = 0;
  }
  return v;
}

std::vector<BodySpin> spins_of(const model::Machine& machine, const solver::State& start) {
  mbd::Mechanism& mechanism = *machine.mechanism;
  solver::State moving = start;
  moving.v = driven_velocities(mechanism, start);
  solver::State rolling = moving;
  roll_wheels(machine, rolling);
  std::vector<BodySpin> spins;
  for (const mbd::FrameId frame : mechanism.spec().body_frames) {
    const mbd::FrameMotion motion = mechanism.frame_motion(rolling, frame);
    BodySpin spin;
    spin.is_driven = !mechanism.frame_motion(moving, frame).omega.isZero(0);
    if (const double speed = motion.omega.norm(); speed > 0) {
      const Matrix3 to_body = motion.X_WF.R.transpose();
      spin.omega = to_body * motion.omega;
      spin.centre = to_body * motion.omega.cross(motion.v) / (speed * speed);
    }
    spins.push_back(spin);
  }
  return spins;
}

InputError rotor_fault(const model::Model& model, std::string found, std::string expected, std::string suggestion) {
  return InputError(Fault{{model.file, 0, 0}, "", std::move(found), std::move(expected), std::move(suggestion)});
}

/// The machine with its shaft, spinning.
class SpinningMachine {
 public:
  explicit SpinningMachine(const model::Model& model)
      : model_(model), machine_(model::build(model)), state_(starting_state(model, machine_)) {
    spins_ = spins_of(machine_, state_);
    require_shaft();
    const VectorXd at_start = state_.v;
    double misfit = 0;
    const VectorXd xi = velocities(state_.q, &misfit);
    if (misfit > kMisfit)
      throw rotor_fault(model_, "a joint that does not let the shaft rotate about its own axis",
                        "joints that carry it as `revolute`, `cylindrical`, `planar` or `free` ones about the axis do",
                        "");
    equations_.emplace(*machine_.mechanism, solver::Spin{[this](const VectorXd& q) { return velocities(q, nullptr); },
                                                         mechanism().chains(), mechanism().rotations_in_space()});
    state_.v = at_start - xi;
    state_.vdot.setZero();
  }

  [[nodiscard]] mbd::Mechanism& mechanism() { return *machine_.mechanism; }
  [[nodiscard]] const std::vector<BodySpin>& spins() const { return spins_; }
  [[nodiscard]] bool does_spin(mbd::FrameId frame) const {
    const int body = machine_.mechanism->spec().frames[static_cast<std::size_t>(frame.index)].body.index;
    return !spins_[static_cast<std::size_t>(body)].omega.isZero(0);
  }

  Outcome find() {
    Outcome outcome;
    solver::EquilibriumSummary found = find_warm_steady_motion(*equations_, machine_, state_, {.steady_motion = true});
    if (!found.solved() && start_from_still_coordinates())
      found = find_warm_steady_motion(*equations_, machine_, state_, {.steady_motion = true});
    outcome.message = found.message;
    if (found.solved()) outcome.message = what_differs_later();
    outcome.set_solved(found.solved() && outcome.message.empty());
    return outcome;
  }

  [[nodiscard]] solver::Linearisation linearise() { return solver::linearise(*equations_, state_, 0); }

  /// Lets the shaft spin on, to an angle of no symmetry.
  void spin_on() { state_ = equations_->spun(state_, time_of_spinning_on()); }

  /// The state of the mechanism, its shaft spinning, in the configuration found.
  [[nodiscard]] solver::State spinning_state() const { return equations_->inner_state(state_); }
  [[nodiscard]] const solver::State& state() const { return state_; }
  [[nodiscard]] const model::Machine& machine() const { return machine_; }

 private:
  /// Takes the steady motion in which all coordinates but the driven ones keep still, if there is one, for a start: its
  /// search follows dampers and films from far away, as pads need it, at the rate of the velocities that it is given.
  bool start_from_still_coordinates() {
    solver::State start = state_;
    start.v += velocities(state_.q, nullptr);
    if (!find_warm_steady_motion(mechanism(), machine_, start, {.steady_motion = true}).solved()) return false;
    state_.q = start.q;
    state_.lambda = start.lambda;
    state_.v = start.v - velocities(start.q, nullptr);
    return true;
  }

  [[nodiscard]] VectorXd velocities(const VectorXd& q, double* misfit) {
    solver::State at = state_;
    at.q = q;
    at.v.setZero(mechanism().nv());
    at.vdot.setZero(mechanism().nv());
    const auto& frames = mechanism().spec().body_frames;
    Twists twists = Twists::Zero(6, static_cast<Index>(frames.size()));
    for (std::size_t b = 0; b < frames.size(); ++b) {
      if (spins_[b].omega.isZero(0)) continue;
      const Pose X = mechanism().frame_motion(at, frames[b]).X_WF;
      const Vector3 omega = X.R * spins_[b].omega;
      twists.col(static_cast<Index>(b)) << omega, (X * spins_[b].centre).cross(omega);
    }
    return mechanism().velocities_of(q, twists, misfit);
  }

  void require_shaft() const {
    if (!model_.fmus.empty())
      throw rotor_fault(model_, "a machine with `fmus`", "a machine whose small motions are known: without FMUs",
                        "springs and dampers, or `bearing_table`, in place of a controller");
    const auto spins = [](const BodySpin& spin) { return !spin.omega.isZero(0); };
    if (std::none_of(spins_.begin(), spins_.end(), spins))
      throw rotor_fault(model_, "no body that a drive rotates", "a shaft that a drive rotates at a constant speed",
                        "for example drives: {motor: {joint: turning, coordinate: rotation, speed: 3000 rpm}}");
    for (const model::BuiltFlexible& flexible : machine_.flexibles)
      for (const mbd::FrameId frame :
           machine_.mechanism->spec().elastics[static_cast<std::size_t>(flexible.elastic.index)].frames)
        if (does_spin(frame))
          throw rotor_fault(model_, "the shaft '" + flexible.name + "' on a mesh", "a shaft of beams and rigid bodies",
                            "`beam` in place of `flexible`");
  }

  [[nodiscard]] double time_of_spinning_on() const {
    double speed = 0;
    for (const BodySpin& spin : spins_) speed = std::max(speed, spin.omega.norm());
    return kSpinOn / speed;
  }

  /// Why the motion is not steady; empty if it is: a shaft that has spun on has to be in balance as it is.
  [[nodiscard]] std::string what_differs_later() {
    const solver::State later = equations_->spun(state_, time_of_spinning_on());
    const solver::Stage stage{.dt = 0, .k = 1, .c = 0, .m = 0, .dq = {}};
    VectorXd now_residual, then_residual, scale;
    solver::Equations::SparseMatrix tangent;
    equations_->assemble(state_, stage, now_residual, scale, &tangent);
    VectorXd largest = scale;
    equations_->assemble(later, stage, then_residual, scale, &tangent);
    if (!equations_->domain_error().empty()) return equations_->domain_error();
    // Rows in axes that rotate are another mixture then: groups are compared by their largest term.
    for (const auto& group : mechanism().chains()) {
      double size = 0, change = 0;
      for (const Index row : group) size = std::max({size, largest[row], scale[row]});
      for (const Index row : group)
        change = std::max(change, std::abs(then_residual[row]) - std::abs(now_residual[row]));
      if (change > kAlike * size)
        return fmt::format(
            "no steady motion: {} is not in balance at another angle of the shaft; its sections, discs and journals "
            "have "
            "to be alike in all directions and balanced (unbalances are forces of `type: unbalance`)",
            equations_->name_of_row(group.front()));
    }
    equations_->begin_step(state_, 0);
    equations_->assemble(state_, stage, now_residual, scale, &tangent);
    equations_->accept_step(state_);
    return {};
  }

  const model::Model& model_;
  model::Machine machine_;
  solver::State state_;  ///< of the spinning equations
  std::vector<BodySpin> spins_;
  std::optional<solver::SpinningEquations> equations_;
};

/// The same model, to be linearised about its steady motion, without its unbalances, which are returned apart.
std::pair<model::Model, std::vector<model::Unbalance>> without_unbalances(const model::Model& model) {
  std::pair<model::Model, std::vector<model::Unbalance>> apart{model, {}};
  apart.first.simulation.analysis = model::Analysis::modes;
  apart.first.simulation.modes_about = model::ModesAbout::turning;
  for (model::Force& force : apart.first.forces)
    if (auto* mesh = std::get_if<model::GearMesh>(&force.data)) mesh->data.error = 0;
  std::erase_if(apart.first.forces, [&](const model::Force& force) {
    if (const auto* unbalance = force.as<model::Unbalance>()) apart.second.push_back(*unbalance);
    return force.as<model::Unbalance>() != nullptr;
  });
  return apart;
}

/// Twists of frames, at ground's origin in ground's axes, by the free coordinates.
class FrameTwists {
 public:
  FrameTwists(mbd::Mechanism& mechanism, const solver::State& state, const MatrixXd& Z) {
    const std::size_t count = mechanism.spec().frames.size();
    std::vector<Twists> by_velocity(count, Twists::Zero(6, mechanism.nv()));
    solver::State moving = state;
    moving.vdot.setZero();
    for (Index k = 0; k < mechanism.nv(); ++k) {
      moving.v = VectorXd::Unit(mechanism.nv(), k);
      for (std::size_t f = 0; f < count; ++f) {
        const mbd::FrameMotion motion = mechanism.frame_motion(moving, {static_cast<int>(f)});
        by_velocity[f].col(k) << motion.omega, motion.v - motion.omega.cross(motion.X_WF.r);
        if (k == 0) poses.push_back(motion.X_WF);
      }
    }
    for (const Twists& all : by_velocity) twists.emplace_back(all * Z);
  }

  /// Displacement of a point that a frame carries, shape (3, free).
  [[nodiscard]] MatrixXd of_point(std::size_t frame, const Vector3& point) const {
    return twists[frame].bottomRows<3>() - skew(point) * twists[frame].topRows<3>();
  }

  std::vector<Pose> poses;
  std::vector<MatrixXd> twists;
};

/// Directions across an axis: the two axes of ground after the one that it is along, made perpendicular to it.
struct AcrossAxis {
  explicit AcrossAxis(const Vector3& spin) {
    Index along = 0;
    spin.cwiseAbs().maxCoeff(&along);
    sense = spin[along] > 0 ? 1 : -1;
    axis = sense * spin.normalized();
    const Vector3 first = Vector3::Unit((along + 1) % 3);
    const Vector3 x = (first - axis * axis.dot(first)).normalized();
    across << x.transpose(), axis.cross(x).transpose();
    for (int k = 0; k < 2; ++k) names[static_cast<std::size_t>(k)] = std::string(1, "xyz"[(along + 1 + k) % 3]);
  }

  Vector3 axis;
  int sense = 1;
  Eigen::Matrix<double, 2, 3> across;
  std::array<std::string, 2> names;
};

/// Motions of the frames of a shaft, in space, by torques and forces on them that grow as exp(omega t): no resonance
/// shows in these.
struct Mobility {
  MatrixXd rotations, displacements;
};

class RotorFinder {
 public:
  RotorFinder(const model::Model& model, SpinningMachine& spinning, RotorState& rotor)
      : model_(model),
        spinning_(spinning),
        rotor_(rotor),
        linear_(spinning.linearise()),
        state_(spinning.spinning_state()),
        frames_(spinning.mechanism(), state_, linear_.Z),
        axis_(axis_of()) {
    rotor.M = linear_.M, rotor.C = linear_.C, rotor.K = linear_.K;
    rotor.axis = axis_.axis, rotor.sense = axis_.sense;
    rotor.x_name = axis_.names[0], rotor.y_name = axis_.names[1];
    rotor.is_geared = std::ranges::any_of(
        model.forces, [](const model::Force& force) { return std::holds_alternative<model::GearMesh>(force.data); });
    rotor.unbalance.setZero(linear_.Z.cols());
  }

  void add_all(const std::vector<std::string>& stations) {
    add_stations(stations);
    add_bearings();
    add_bodies();
  }

  [[nodiscard]] Mobility mobility() {
    const auto& frames = spinning_.mechanism().spec().frames;
    MatrixXd rotations(0, linear_.Z.cols()), displacements = rotations;
    for (std::size_t f = 0; f < frames.size(); ++f) {
      if (!spinning_.does_spin({static_cast<int>(f)})) continue;
      rotations.conservativeResize(rotations.rows() + 3, Eigen::NoChange);
      rotations.bottomRows<3>() = frames_.twists[f].topRows<3>();
      displacements.conservativeResize(rotations.rows(), Eigen::NoChange);
      displacements.bottomRows<3>() = frames_.twists[f].bottomRows<3>();
    }
    const double growth = rotor_.speed;
    const Eigen::PartialPivLU<MatrixXd> dynamic(linear_.K + growth * linear_.C + growth * growth * linear_.M);
    return {rotations * dynamic.solve(rotations.transpose()), displacements * dynamic.solve(displacements.transpose())};
  }

  /// Gear meshes whose flanks do not press on each other in the steady motion.
  void warn_of_parted_teeth() {
    mbd::Mechanism& mechanism = spinning_.mechanism();
    const auto& forces = mechanism.spec().forces;
    for (std::size_t i = 0; i < forces.size(); ++i) {
      const auto* mesh = dynamic_cast<const mbd::GearMesh*>(forces[i].force.get());
      if (mesh == nullptr) continue;
      const mbd::GearMesh::Load load = mesh->load(mechanism.relative_motion(state_, {static_cast<int>(i)}));
      if (!(load.normal < 0 && load.deflection < -kTeethPart)) continue;
      rotor_.warning += fmt::format(
          "{}gear mesh {}: its teeth would part, at a mesh force of {:.4g} N, and the mesh pulls there instead; a "
          "torque of the other sign wants another `torque_on_first`",
          rotor_.warning.empty() ? "" : "; ", forces[i].name, load.normal);
    }
  }

  void add_unbalances(const std::vector<model::Unbalance>& unbalances) {
    for (const model::Unbalance& unbalance : unbalances) add_unbalance(unbalance);
    rotor_.unbalances = static_cast<int>(unbalances.size());
    if (unbalances.empty()) return;
    rotor_.unbalance *= std::exp(std::complex<double>(0, -angle_of_mark(unbalances.front())));
  }

 private:
  void add_stations(const std::vector<std::string>& names) {
    for (const std::string& name : names) add_station(frame_called(name), name);
  }

  /// The shaft's bodies, so that modes and responses show the whole axis.
  void add_bodies() {
    const mbd::MechanismSpec& spec = spinning_.mechanism().spec();
    for (std::size_t b = 1; b < spec.bodies.size(); ++b)
      if (spinning_.does_spin(spec.body_frames[b]))
        add_station(static_cast<std::size_t>(spec.body_frames[b].index), spec.bodies[b].name);
  }

  void add_bearings() {
    const mbd::MechanismSpec& spec = spinning_.mechanism().spec();
    for (std::size_t i = 0; i < spec.forces.size(); ++i) {
      const mbd::MechanismSpec::Force& force = spec.forces[i];
      if (spinning_.does_spin(force.a) == spinning_.does_spin(force.b)) continue;
      if (spinning_.does_spin(force.a))  // its coefficients would be those in axes that rotate
        throw rotor_fault(model_, "force '" + force.name + "' from the shaft to what carries it",
                          "between: [housing, shaft]", "exchange its two frames");
      add_bearing(force, {static_cast<int>(i)});
    }
    tell_names_apart();
  }

  /// A film and a force of one name are called by their sections, too: `bearings.left`, `forces.left`.
  void tell_names_apart() {
    std::map<std::string, int> count;
    for (const RotorBearing& bearing : rotor_.bearings) ++count[bearing.name];
    for (std::size_t b = 0; b < rotor_.bearings.size(); ++b)
      if (std::string& name = rotor_.bearings[b].name; count[name] > 1) name = sections_[b] + "." + name;
  }

  [[nodiscard]] BodySpin spin_of(std::size_t frame) const {
    const mbd::MechanismSpec& spec = spinning_.machine().mechanism->spec();
    return spinning_.spins()[static_cast<std::size_t>(spec.frames[frame].body.index)];
  }
  [[nodiscard]] const Pose& body_pose(std::size_t frame) const {
    const mbd::MechanismSpec& spec = spinning_.machine().mechanism->spec();
    const auto body = static_cast<std::size_t>(spec.frames[frame].body.index);
    return frames_.poses[static_cast<std::size_t>(spec.body_frames[body].index)];
  }

  /// True if two bodies rotate with one another: about one line, at one speed.
  [[nodiscard]] bool are_of_one_shaft(std::size_t a, std::size_t b) const {
    const auto& frames = spinning_.machine().mechanism->spec().body_frames;
    const auto& spins = spinning_.spins();
    const Pose &X = frames_.poses[static_cast<std::size_t>(frames[a].index)],
               &Y = frames_.poses[static_cast<std::size_t>(frames[b].index)];
    const Vector3 omega = X.R * spins[a].omega, apart = Y * spins[b].centre - X * spins[a].centre;
    return (omega - Y.R * spins[b].omega).norm() <= kParallel * omega.norm() &&
           omega.normalized().cross(apart).norm() <= kParallel * (1 + apart.norm());
  }

  /// Angle in the sense of rotation from the direction x to the x-axis of the first body of the shaft of `unbalance`.
  [[nodiscard]] double angle_of_mark(const model::Unbalance& unbalance) const {
    const mbd::MechanismSpec& spec = spinning_.machine().mechanism->spec();
    const auto carrier = static_cast<std::size_t>(body_of(frame_called(name_in_model(unbalance))));
    std::size_t first = 1;
    while (first < carrier && !are_of_one_shaft(carrier, first)) ++first;
    const Pose& X = frames_.poses[static_cast<std::size_t>(spec.body_frames[first].index)];
    const Vector3& spin = spinning_.spins()[first].omega;
    const Eigen::Vector2d mark = axis_.across * X.R.col(across_spin(spin));
    return std::atan2(sense_of(X.R * spin) * mark.y(), mark.x());
  }

  [[nodiscard]] static std::string name_in_model(const model::Unbalance& unbalance) {
    return unbalance.to.body + (unbalance.to.frame.empty() ? "" : "." + unbalance.to.frame);
  }

  [[nodiscard]] int sense_of(const Vector3& omega) const { return axis_.axis.dot(omega) < 0 ? -1 : 1; }

  /// Axis of a body that is x where the body spins about its z-axis, else the next one after that about which it does.
  [[nodiscard]] static Index across_spin(const Vector3& spin) {
    Index along = 0;
    spin.cwiseAbs().maxCoeff(&along);
    return (along + 1) % 3;
  }

  /// Of the fastest shaft; of two alike that which is driven.
  [[nodiscard]] AcrossAxis axis_of() {
    const mbd::MechanismSpec& spec = spinning_.mechanism().spec();
    Vector3 fastest = Vector3::Zero();
    bool is_driven = false;
    for (std::size_t b = 1; b < spec.bodies.size(); ++b) {
      const BodySpin& spin = spinning_.spins()[b];
      const Vector3 omega = frames_.poses[static_cast<std::size_t>(spec.body_frames[b].index)].R * spin.omega;
      const bool is_faster = omega.norm() > (1 + kSameSpeed) * fastest.norm();
      const bool is_as_fast = omega.norm() >= (1 - kSameSpeed) * fastest.norm();
      if (is_faster || (is_as_fast && spin.is_driven && !is_driven)) fastest = omega, is_driven = spin.is_driven;
    }
    rotor_.speed = fastest.norm();
    return AcrossAxis(fastest);
  }

  [[nodiscard]] std::size_t frame_called(const std::string& name) const {
    std::string known;
    for (const auto& [names, frame] : spinning_.machine().frames) {
      if (!spinning_.does_spin(frame)) continue;
      const std::string whole = names.first + (names.second.empty() ? "" : "." + names.second);
      if (whole == name) return static_cast<std::size_t>(frame.index);
      known += (known.empty() ? "" : ", ") + whole;
    }
    throw rotor_fault(model_, "no station '" + name + "' on the shaft", known, "");
  }

  /// The point of the axis that the frame's origin is beside, and what the frame is called.
  std::size_t add_station(std::size_t frame, const std::string& name) {
    const BodySpin spin = spin_of(frame);
    const Pose& X = body_pose(frame);
    const Vector3 centre = X * spin.centre, direction = (X.R * spin.omega).normalized();
    const Vector3 point = centre + direction * direction.dot(frames_.poses[frame].r - centre);
    const double along = axis_.axis.dot(point);
    const auto same = std::find_if(rotor_.stations.begin(), rotor_.stations.end(), [&](const RotorStation& other) {
      return std::abs(other.along - along) < 1e-9 * (1 + std::abs(along)) &&
             bodies_[other.name] == body_of(frame);  // round-off
    });
    if (same != rotor_.stations.end())
      return rotor_.places[name] = static_cast<std::size_t>(same - rotor_.stations.begin());
    const MatrixXd displacement = frames_.of_point(frame, point);
    MatrixXd along_and_about(2, displacement.cols());
    along_and_about << axis_.axis.transpose() * displacement,
        axis_.axis.transpose() * frames_.twists[frame].topRows<3>();
    rotor_.stations.push_back({name, along, sense_of(X.R * spin.omega), axis_.across * displacement, along_and_about});
    bodies_[name] = body_of(frame);
    return rotor_.places[name] = rotor_.stations.size() - 1;
  }

  [[nodiscard]] int body_of(std::size_t frame) const {
    return spinning_.machine().mechanism->spec().frames[frame].body.index;
  }

  void add_bearing(const mbd::MechanismSpec::Force& force, mbd::ForceId id) {
    mbd::Mechanism& mechanism = spinning_.mechanism();
    const auto a = static_cast<std::size_t>(force.a.index), b = static_cast<std::size_t>(force.b.index);
    RotorBearing bearing;
    std::tie(sections_.emplace_back(), bearing.name) = name_of_bearing(force, id);
    const mbd::RelativeMotion motion = mechanism.relative_motion(state_, id);
    mbd::ForceResponse response;
    response.set_zero(motion.s.size());
    force.force->evaluate(motion, true, response);
    // (rotors.10): a twist moves the velocities, and its rate the accelerations, that are seen from the housing.
    const Matrix6 moved = cross_motion_matrix(motion.V_AB_A);
    bearing.K = -(response.dW_dX - response.dW_dV * moved);
    bearing.C = -(response.dW_dV - response.dW_dA * moved);
    bearing.M = -response.dW_dA;
    const Matrix6 to_a = motion_transform(frames_.poses[a].inverse());
    bearing.twist = to_a * (frames_.twists[b] - frames_.twists[a]);
    bearing.across = axis_.across * frames_.poses[a].R;
    bearing.station = add_station(b, name_of(b));
    // Of translations of the shaft.
    const auto across = [&](const Matrix6& A) {
      return Eigen::Matrix2d(bearing.across * A.bottomRightCorner<3, 3>() * bearing.across.transpose());
    };
    bearing.stiffness = across(bearing.K), bearing.damping = across(bearing.C), bearing.inertia = across(bearing.M);
    bearing.force = bearing.across * response.W_B_A.tail<3>();
    rotor_.bearings.push_back(std::move(bearing));
  }

  /// Section and name in the model: films are called "bearing left" in a mechanism.
  [[nodiscard]] std::pair<std::string, std::string> name_of_bearing(const mbd::MechanismSpec::Force& force,
                                                                    mbd::ForceId id) const {
    const std::vector<model::BuiltBearing>& films = spinning_.machine().bearings;
    for (std::size_t i = 0; i < films.size(); ++i)
      if (films[i].force == id) return {"bearings", model_.bearings[i].name};
    return {"forces", force.name};
  }

  [[nodiscard]] std::string name_of(std::size_t frame) const {
    for (const auto& [names, id] : spinning_.machine().frames)
      if (id.index == static_cast<int>(frame)) return names.first + (names.second.empty() ? "" : "." + names.second);
    return spinning_.machine().mechanism->spec().frames[frame].name;
  }

  // (rotors.4) of a shaft that spins steadily, as an amplitude of exp(i omega t).
  void add_unbalance(const model::Unbalance& unbalance) {
    const std::string name = name_in_model(unbalance);
    const std::size_t frame = frame_called(name);
    add_station(frame, name);
    const Pose& X = frames_.poses[frame];
    const Vector3 omega = body_pose(frame).R * spin_of(frame).omega;
    const double speed = omega.norm();
    if (std::abs(speed - rotor_.speed) > kSameSpeed * rotor_.speed)
      throw rotor_fault(model_, "unbalances on shafts of different speeds", "unbalances on one shaft, the fastest", "");
    if ((omega / speed).cross(X.R.col(2)).norm() > kParallel)
      throw rotor_fault(model_, "an unbalance at '" + name + "', whose z-axis is not that of the shaft",
                        "a frame with its z-axis along the shaft", "");
    const Vector3 u = X.R * unbalance.moment;
    const Eigen::Vector3cd moment = u.cast<std::complex<double>>() -
                                    std::complex<double>(0, 1) * (omega / speed).cross(u).cast<std::complex<double>>();
    const Eigen::Vector3cd force = speed * speed * moment;
    const Vector3 g = model_.gravity;
    Eigen::Vector3cd torque;
    torque.real() = moment.real().cross(g), torque.imag() = moment.imag().cross(g);
    rotor_.unbalance += frames_.of_point(frame, X.r).transpose() * force;
    rotor_.unbalance += frames_.twists[frame].topRows<3>().transpose() * torque;
  }

  const model::Model& model_;
  SpinningMachine& spinning_;
  RotorState& rotor_;
  solver::Linearisation linear_;
  solver::State state_;  // of the mechanism
  FrameTwists frames_;
  AcrossAxis axis_;
  std::map<std::string, int> bodies_;  // of stations
  std::vector<std::string> sections_;  // of the model, of bearings
};

bool are_alike(const Mobility& a, const Mobility& b) {
  return (a.rotations - b.rotations).norm() <= kAlikeMotions * a.rotations.norm() &&
         (a.displacements - b.displacements).norm() <= kAlikeMotions * a.displacements.norm();
}

}  // namespace

RotorState find_rotor_state(const model::Model& model, const std::vector<std::string>& stations) {
  const auto [balanced, unbalances] = without_unbalances(model);
  SpinningMachine spinning(balanced);
  RotorState rotor;
  const Outcome found = spinning.find();
  rotor.message = found.message;
  if (!found.solved()) return rotor;
  RotorFinder finder(balanced, spinning, rotor);
  finder.add_all(stations);
  finder.add_unbalances(unbalances);
  finder.warn_of_parted_teeth();
  spinning.spin_on();
  RotorState later;
  if (!are_alike(finder.mobility(), RotorFinder(balanced, spinning, later).mobility()))
    throw rotor_fault(model, "a shaft whose inertias, sections or films differ between directions across its axis",
                      "discs, sections and journals that are alike in all of them", "");
  rotor.set_solved(true);
  return rotor;
}

}  // namespace hersey::run
