#pragma once

#include <optional>
#include <vector>

#include "cycle_maps.h"
#include "hersey/mbd/mechanism.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/results/writer.h"
#include "hersey/run/options.h"
#include "hersey/run/summary.h"
#include "hersey/solver/linearise.h"
#include "power_balance.h"
#include "step_record.h"

namespace hersey::run {

/// Where the results of a resumed run are gathered until they hold all that the interrupted one had.
[[nodiscard]] std::filesystem::path unfinished_file(const std::filesystem::path& results);

/// Puts steps into the results file (layout: docs/results-file.md).
class Recorder {
 public:
  /// @param start    what the run starts from, to tell where that is not what the model gives
  /// @param resumes  the file is written under another name, to take the place of `options.results` in `persist`
  /// @throws results::FileExists, results::WriteError.
  Recorder(const model::Model& model, const model::Machine& machine, const solver::State& start, const Options& options,
           bool resumes = false);

  /// @param energy  since the start of the run
  void write_row(const StepRecord& step, const EnergySummary& energy);
  void write_fields(const StepRecord& step);
  /// What the bearings' maps and losses over a cycle are made of: every accepted step.
  void gather(const StepRecord& step) { cycles_.take(step.mechanism.t, step.bearings); }
  /// A cycle of the machine ends with the step last gathered.
  std::vector<BearingCycle> close_cycle() { return cycles_.close(); }
  /// Small motions about `state`.
  void write_modes(const solver::State& state, const solver::Modes& found);
  void flush_if_due() { writer_.flush_if_due(); }
  /// How many rows there are; restoring takes so many from the results of the run that was interrupted.
  /// @throws results::ReadError where these have fewer
  void persist(Archive& archive, const std::filesystem::path& results);
  /// How far the cycle that ended at `t` repeats the one before: CycleChange::value.
  void write_cycle(double t, double change) const;
  /// Makes room for what `finish` writes, so that it changes nothing of the file's structure: a program killed then
  /// leaves a file that can be read. Before the first row.
  /// @param work  of no steps yet
  void declare_cost(const Work& work);
  void write_step_errors(const std::string& bearing, const StepErrors& errors);
  void finish(results::Status status, const std::string& message, double wall_time, const Work& work, int steps);

 private:
  void write_cost(double wall_time, const Work& work, int steps);

  struct BodySeries {
    results::Series position, orientation, velocity, angular_velocity, acceleration;
  };
  struct JointSeries {
    results::Series coordinates, rates, force, torque;
  };
  struct FlexibleSeries {
    results::Series strain, dissipation, amplitudes;
  };
  struct SurfaceLoadSeries {
    results::Series force, moment, power;
  };
  struct BeamSeries {
    results::Series strain, dissipation, amplitudes, positions, forces, moments;
  };
  struct DriveSeries {
    results::Series effort, power;
  };
  struct ContactSeries {
    results::Series gap, normal_force, friction_force, force, position, damping_power, friction_power, spots;
  };
  struct EnergySeries {
    results::Series kinetic, potential, springs, strain;
    results::Series put_in, films, boundary_friction, contacts, dampers, oil, film_storage, unexplained;
  };
  struct PowerSeries {
    results::Series drives, loads, gravity, springs, contacts, bearings, elastic, kinetic_rate, balance_error,
        unexplained, film_friction, asperity_friction;
  };
  struct BearingSeries {
    results::Series eccentricity, ratio, attitude, tilt, h_min, h_min_phi, h_min_z, h_min_centre, p_max, p_max_phi,
        p_max_z, p_max_node, force, force_pressure, force_shear, force_asperity, moment, speed, torque_journal,
        torque_shell, power_film, power_asperity, power_stored, power_oil, power_into_bodies, power_error, flow_left,
        flow_right, flow_supply, storage_rate, oil_volume, oil_through_flow, oil_unexplained, cavitated_share,
        rupture_angle, reformation_angle, film_iterations;
    std::optional<results::Series> mass_balance_error;  // of films that conserve oil: all but Reynolds'
    std::optional<results::Series> h_min_features;      // where features have depth
    std::vector<results::Series> flow_features;
    std::optional<results::Series> exchanges;  // of a partitioned coupling
    results::Series h_min_around, p_max_around;
    results::Series field_time, pressure, thickness, fill, asperity_pressure;
    std::optional<results::Series> shell_displacement, journal_displacement;  // of surfaces of elastic bodies
  };

  struct ModeSeries {
    results::Series frequency, damped_frequency, damping_ratio, real, imaginary, shape_real, shape_imaginary, body_real,
        body_imaginary;
    std::vector<results::Series> amplitudes_real, amplitudes_imaginary;  // of flexible bodies
    std::vector<results::Series> beams_real, beams_imaginary;            // the same of beams
  };

  void declare_cycles();
  void declare_modes();
  void declare_flexible_modes();
  void write_flexible_mode(const solver::State& state, const Eigen::VectorXcd& shape);
  [[nodiscard]] Eigen::VectorXd body_increments(const solver::State& state, const Eigen::VectorXd& shape) const;
  void declare_run(const solver::State& start, const Options& options);
  void declare_machine();
  void declare_flexible_bodies();
  void write_flexible_bodies(const mbd::Observation& seen);
  void declare_surface_loads();
  void write_surface_loads(const mbd::Observation& seen);
  [[nodiscard]] bool integrates() const { return model_.simulation.analysis == model::Analysis::dynamics; }
  void hide_inner_nodes();
  void declare_beams();
  void write_beams(const mbd::Observation& seen);
  void declare_beam_modes();
  void write_beam_mode(const solver::State& state, const Eigen::VectorXcd& shape);
  void declare_contacts();
  void write_contacts(const std::vector<mbd::ContactObservation>& seen) const;
  [[nodiscard]] BearingSeries declare_bearing(const model::Bearing& bearing);
  void declare_fields(const model::Bearing& bearing, BearingSeries& series);
  void write_around(std::size_t bearing) const;
  void write_bearing(const BearingSeries& series, const bearing::BearingObservation& seen) const;

  const model::Model& model_;
  const model::Machine& machine_;
  results::Writer writer_;
  CycleMaps cycles_;
  results::Series time_, crank_angle_, dt_, newton_iterations_, residual_, error_, step_error_, rejected_, drift_;
  std::vector<FlexibleSeries> flexibles_;
  std::vector<SurfaceLoadSeries> surface_loads_;
  std::vector<BeamSeries> beams_;
  std::vector<bool> hidden_bodies_, hidden_joints_;  ///< inner nodes of beams: not written one by one
  EnergySeries energy_;
  PowerSeries power_;
  ModeSeries modes_;
  results::Series cycle_end_, cycle_change_;
  std::vector<BodySeries> bodies_;
  std::vector<JointSeries> joints_;
  std::vector<DriveSeries> drives_;
  std::vector<results::Series> couplings_;  ///< their efforts
  std::vector<DriveSeries> coordinate_forces_;
  std::vector<ContactSeries> contacts_;
  std::vector<BearingSeries> bearings_;
};

}  // namespace hersey::run
