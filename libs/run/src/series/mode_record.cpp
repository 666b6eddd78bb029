#include "series/mode_record.h"

#include "series/beam_record.h"

namespace hersey::run {
namespace {

using model::Machine;

int body_count(const Machine& machine) { return static_cast<int>(machine.mechanism->spec().bodies.size()) - 1; }

std::vector<std::string> flexible_names(const Machine& machine) {
  std::vector<std::string> names;
  for (const model::BuiltFlexible& flexible : machine.flexibles) names.push_back(flexible.name);
  return names;
}

std::vector<std::string> beam_names(const Machine& machine) {
  std::vector<std::string> names;
  for (const model::BuiltBeam& beam : machine.beams) names.push_back(beam.name);
  return names;
}

enum class Part { real, imaginary };

Eigen::VectorXd part_of(const Eigen::VectorXcd& shape, Part part) {
  if (part == Part::real) return shape.real();
  return shape.imag();
}

auto of_bodies(Part part) {
  return [part](const ModeRow& row) { return part_of(row.bodies, part); };
}
auto of_shape(Part part) {
  return [part](const ModeRow& row) { return part_of(row.mode.shape, part); };
}
auto of_each(std::vector<Eigen::VectorXcd> ModeRow::*amplitudes, Part part) {
  return [amplitudes, part](const ModeRow& row, std::size_t k) { return part_of((row.*amplitudes)[k], part); };
}

// A group called fields counts its own rows, because modes are not instants.
const QuantityTable<ModeRow, Machine>& mode_quantities() {
  using M = solver::Mode;
  const auto of_mode = [](auto member) {
    return [member](const ModeRow& row) { return std::invoke(member, row.mode); };
  };
  static const Extent<Machine> coordinates{
      "nv",
      [](const Machine& machine, std::size_t /*k*/) { return std::vector{static_cast<int>(machine.mechanism->nv())}; },
      {"fields/coordinate"}};
  static const Extent<Machine> bodies{
      "6 bodies",
      [](const Machine& machine, std::size_t /*k*/) { return std::vector{6 * body_count(machine)}; },
      {"fields/body_component"}};
  static const Extent<Machine> of_flexible{"shapes",
                                           [](const Machine& machine, std::size_t k) {
                                             return std::vector{static_cast<int>(machine.flexibles[k].shapes.cols())};
                                           },
                                           {"fields/<b>_amplitudes_shape"}};
  static const Extent<Machine> of_beam{"12 nodes", [](const Machine& machine, std::size_t k) {
                                         return std::vector{beam_amplitude_count(machine.beams[k])};
                                       }};
  static const QuantityTable<ModeRow, Machine> table{
      {"fields/frequency", "Hz", "natural frequency |s|/(2 pi), one row per mode", of_mode(&M::frequency)},
      {"fields/damped_frequency", "Hz", "frequency of the damped motion, Im s/(2 pi)", of_mode(&M::damped_frequency)},
      {"fields/damping_ratio", "1", "-Re s/|s|; negative: the motion grows", of_mode(&M::damping_ratio)},
      {"fields/eigenvalue_real", "1/s", "real part of the eigenvalue s",
       [](const ModeRow& row) { return row.mode.s.real(); }},
      {"fields/eigenvalue_imaginary", "1/s", "imaginary part of the eigenvalue s",
       [](const ModeRow& row) { return row.mode.s.imag(); }},
      {"fields/shape_real",
       "1",
       "mode shape, real part: increments of the coordinates",
       of_shape(Part::real),
       {.note = "named by the attribute `coordinates`, the largest 1", .extent = coordinates}},
      {"fields/shape_imaginary", "1", "mode shape, imaginary part", of_shape(Part::imaginary), {.extent = coordinates}},
      {"fields/body_real",
       "1",
       "mode shape, real part: small rotation and displacement of each body",
       of_bodies(Part::real),
       {.note = "ground axes, at the origin of each body named by the attribute `bodies`", .extent = bodies}},
      {"fields/body_imaginary", "1", "the same, imaginary part", of_bodies(Part::imaginary), {.extent = bodies}},
      {"fields/<b>_amplitudes_real",
       "SI",
       "mode shape in the body's amplitudes",
       of_each(&ModeRow::flexibles, Part::real),
       {.extent = of_flexible, .each = flexible_names}},
      {"fields/<b>_amplitudes_imaginary",
       "SI",
       "the same, imaginary part",
       of_each(&ModeRow::flexibles, Part::imaginary),
       {.extent = of_flexible, .each = flexible_names}},
      {"fields/<b>_amplitudes_real",
       "SI",
       "mode shape in the beam's amplitudes",
       of_each(&ModeRow::beams, Part::real),
       {.extent = of_beam, .each = beam_names}},
      {"fields/<b>_amplitudes_imaginary",
       "SI",
       "the same, imaginary part",
       of_each(&ModeRow::beams, Part::imaginary),
       {.extent = of_beam, .each = beam_names}},
  };
  return table;
}

std::vector<std::string> names_of_coordinates(const Machine& machine) {
  std::vector<std::string> names;
  for (Eigen::Index k = 0; k < machine.mechanism->nv(); ++k) names.push_back(machine.mechanism->name_of_row(k));
  return names;
}

std::vector<std::string> names_of_bodies(const Machine& machine) {
  std::vector<std::string> names;
  for (const mbd::BodySpec& body : machine.mechanism->spec().bodies) names.push_back(body.name);
  names.erase(names.begin());  // ground
  return names;
}

const std::vector<Attribute<Machine>>& mode_attributes() {
  static const std::vector<Attribute<Machine>> table{
      {"coordinates", "", "names of the coordinates of mode shapes", names_of_coordinates},
      {"bodies", "", "names of the bodies of mode shapes", names_of_bodies},
  };
  return table;
}

const std::vector<Attribute<solver::Modes>>& mode_findings() {
  static const std::vector<Attribute<solver::Modes>> table{
      {"stable", "1", "1: no motion grows", [](const solver::Modes& found) { return found.stable ? 1 : 0; }}};
  return table;
}

/// Rotation and displacement of every body for small increments of the coordinates, computed like velocities.
Eigen::VectorXd body_increments(const Machine& machine, const solver::State& state, const Eigen::VectorXd& shape) {
  solver::State moving = state;
  moving.v = shape;
  const std::vector<mbd::FrameId>& frames = machine.mechanism->spec().body_frames;
  Eigen::VectorXd all(6 * body_count(machine));
  for (int i = 0; i < body_count(machine); ++i) {
    const mbd::FrameMotion motion = machine.mechanism->frame_motion(moving, frames[static_cast<std::size_t>(i) + 1]);
    all.segment<6>(6 * i) << motion.omega, motion.v;
  }
  return all;
}

Eigen::VectorXcd complex_of(const Eigen::VectorXd& real, const Eigen::VectorXd& imaginary) {
  Eigen::VectorXcd both(real.size());
  both.real() = real;
  both.imag() = imaginary;
  return both;
}

/// The mode in the amplitudes of one body.
/// @param amplitudes  function of the observation of the machine
template <class Amplitudes>
Eigen::VectorXcd mode_in(const Amplitudes& amplitudes, const mbd::Observation& here, const mbd::Observation& real,
                         const mbd::Observation& imaginary, double step) {
  const Eigen::VectorXd rest = amplitudes(here);
  return complex_of((amplitudes(real) - rest) / step, (amplitudes(imaginary) - rest) / step);
}

}  // namespace

ModeRecord::ModeRecord(const model::Model& model, const Machine& machine, results::Writer& writer)
    : model_(model), machine_(machine), writer_(writer), rows_(mode_quantities(), "/modes/", machine, writer) {
  write_once(mode_attributes(), "/modes/", machine, writer);
}

void ModeRecord::append(const solver::State& state, const solver::Modes& found) {
  constexpr double step = 1e-6;  // amplitudes are smooth, and of a mode linear: their difference loses six digits
  mbd::Mechanism& mechanism = *machine_.mechanism;
  const auto observed_after = [&](const Eigen::VectorXd& increment) {
    solver::State moved = state;
    mechanism.retract(state.q, increment, moved.q);
    return mechanism.observe(moved);
  };
  for (const solver::Mode& mode : found.modes) {
    const Eigen::VectorXd re = mode.shape.real(), im = mode.shape.imag();
    ModeRow row{mode, complex_of(body_increments(machine_, state, re), body_increments(machine_, state, im)), {}, {}};
    if (!machine_.flexibles.empty() || !machine_.beams.empty()) {
      const mbd::Observation here = observed_after(Eigen::VectorXd::Zero(mode.shape.size())),
                             real = observed_after(step * re), imaginary = observed_after(step * im);
      for (const model::BuiltFlexible& body : machine_.flexibles) {
        const auto amplitudes = [&](const mbd::Observation& observation) -> Eigen::VectorXd {
          return body.body->amplitudes(observation.elastics[static_cast<std::size_t>(body.elastic.index)].motion);
        };
        row.flexibles.push_back(mode_in(amplitudes, here, real, imaginary, step));
      }
      for (const model::BuiltBeam& built : machine_.beams) {
        const auto amplitudes = [&](const mbd::Observation& observation) {
          return beam_amplitudes(beam_of(model_, built), built, observation);
        };
        row.beams.push_back(mode_in(amplitudes, here, real, imaginary, step));
      }
    }
    rows_.append(row);
  }
  write_once(mode_findings(), "/modes/", found, writer_);
}

QuantityGroup ModeRecord::describe() {
  QuantityGroup group{
      .path = "/modes/", .heading = "of small motions, by rising frequency: analysis `modes`", .quantities = {}};
  run::describe(mode_attributes(), "modes", group);
  run::describe(mode_findings(), "modes", group);
  run::describe(mode_quantities(), "modes", group);
  return group;
}

}  // namespace hersey::run
