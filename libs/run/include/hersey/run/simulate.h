#pragma once

#include <atomic>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/model/model.h"
#include "hersey/run/work.h"

namespace hersey::run {

/// How far a run has come; handed to Options::on_progress after every accepted step.
struct Progress {
  double t = 0, t_start = 0, t_end = 0;                   ///< [s]
  double dt = 0;                                          ///< step just taken [s]
  int newton_iterations = 0;                              ///< of that step
  double moft = std::numeric_limits<double>::infinity();  ///< minimum oil film thickness so far, all bearings [m]
  double elapsed = 0;                                     ///< wall time since the start of the run [s]
};

/// A cycle that has just ended; handed to Options::on_cycle.
struct CycleProgress {
  int number = 0;       ///< from 1
  double change = 0;    ///< largest difference from the cycle before, relative; not a number in the first
  std::string largest;  ///< of what, "film thickness of big_end"
};

enum class Status {
  completed,  ///< reached the end, or settled
  stopped,    ///< asked to stop; results up to then are complete
  failed,     ///< no convergence at the smallest step, or the results file could not be written
};

/// What the length of the steps has done to the figures of one bearing: the size of their errors, estimated; not a
/// number where it was not asked for.
struct StepErrors {
  double moft = std::numeric_limits<double>::quiet_NaN();        ///< [m]
  double pofp = std::numeric_limits<double>::quiet_NaN();        ///< [Pa]
  double max_force = std::numeric_limits<double>::quiet_NaN();   ///< [N]
  double mean_power = std::numeric_limits<double>::quiet_NaN();  ///< [W]
  double mean_flow = std::numeric_limits<double>::quiet_NaN();   ///< [m^3/s]
};

/// The extremes and balances of one bearing over a run.
struct BearingSummary {
  std::string name;
  double moft = 0, moft_t = 0, moft_phi = 0, moft_z = 0;  ///< minimum oil film thickness [m], when [s], where [rad, m]
  double pofp = 0, pofp_t = 0, pofp_phi = 0, pofp_z = 0;  ///< peak oil film pressure [Pa], when, where
  double max_force = 0;                                   ///< largest film force on the shell [N]
  double eccentricity_ratio = 0;                          ///< at the end [-]
  double mean_power = 0;                                  ///< mean friction power, film and asperities [W]
  double mean_flow = 0;                                   ///< mean oil flow over both edges [m^3/s]
  double worst_mass_balance = 0;                          ///< largest mass_balance_error of a step [-]
  double energy_put_in = 0;                               ///< by the bodies, through the film's forces on them [J]
  double energy_taken = 0;  ///< by shear, flow, friction, storage and oil, each an integral over the film [J]
  double energy_error = 0;  ///< their difference over what the film dissipates [-]
  StepErrors step_error;    ///< where Options::step_error asks for it
};

/// Where the energy put into a machine has gone since the start of the run [J]. Each part is an integral of its own: of
/// a film's shear, of its flows, of what dampers and contacts lose, of what is stored. What they do not explain tells
/// of a force that does not do the work of its losses, of steps too long, or of the integrator's own damping.
struct EnergySummary {
  double put_in = 0;             ///< by drives, motors, loads and pressures
  double films = 0;              ///< dissipated by shear and flow of the oil
  double boundary_friction = 0;  ///< dissipated where asperities touch
  double contacts = 0;           ///< lost in contacts of bodies
  double dampers = 0;            ///< lost in dampers, joint friction and the material of flexible bodies
  double oil = 0;                ///< taken along by oil that leaves the films less what feeds bring
  double film_storage = 0;       ///< more in liners, asperities and compressed oil than at the start
  double stored = 0;             ///< more kinetic, potential, spring and strain energy than at the start
  double largest =
      0;  ///< the largest that energy put in or lost has been, or any kind of it has changed: errors are its shares
  /// Dissipated by films, asperities, contacts and dampers.
  [[nodiscard]] double lost() const { return films + boundary_friction + contacts + dampers; }
  /// What all the parts leave of put_in.
  [[nodiscard]] double unexplained() const { return put_in - lost() - oil - film_storage - stored; }
  /// |unexplained| over the largest [-].
  [[nodiscard]] double error() const { return largest > 0 ? std::abs(unexplained()) / largest : 0; }
};

struct Summary {
  Status status = Status::completed;
  std::string message;   ///< why it ended early; "settled" where it did because nothing changed any more
  std::string warning;   ///< what the user should know about a resumed run
  double t_end = 0;      ///< last accepted time [s]
  double t_results = 0;  ///< last time in the results file [s]
  int steps = 0, rejected_steps = 0;
  int newton_iterations = 0;
  int cycles = 0;                     ///< that ended, where the model asks for cycles
  double cycle_change = 0;            ///< of the last of them: CycleProgress::change
  double worst_step_error = 0;        ///< largest local error of a step: angles [rad], lengths over sizes, StepError
  double worst_constraint_drift = 0;  ///< largest violation of a constraint, relative to what it compares [-]
  double worst_power_balance = 0;     ///< largest residual power of the equations of motion over the largest power [-]
  EnergySummary energy;               ///< where the energy went
  double wall_time = 0;               ///< [s]
  Work work;                          ///< where it went
  std::vector<BearingSummary> bearings;
  std::filesystem::path results;
};

struct StudyParameterValue {
  std::string name, text;
};

struct Options {
  std::filesystem::path results;                       ///< the HDF5 file to write
  bool overwrite = false;                              ///< replace an existing one
  bool step_error = false;                             ///< run with steps twice as long first, and compare
  bool resume = false;                                 ///< go on where `results` and its checkpoint end
  std::function<void(const Progress&)> on_progress;    ///< may be empty
  std::function<void(const CycleProgress&)> on_cycle;  ///< may be empty
  const std::atomic<bool>* stop = nullptr;             ///< set from a signal handler: end after the current step
  std::function<void()> on_stopping;  ///< it ends so: checkpoint and results are yet to be written; may be empty
  std::vector<StudyParameterValue> study_parameters;  ///< of this run, for the results file
};

/// Simulates `model` from its start to its end and writes the results as it goes.
///
/// A step that does not converge is repeated with half its length down to simulation.smallest_step; then the run ends
/// as `failed` with the time, the worst equation and the reason, its results up to there intact.
/// @throws InputError where the model cannot start: gap closed, singular mechanism, a table that does not cover the
/// run.
///
/// Beside the results lies a checkpoint, written as model::Simulation::Checkpoints asks and whenever the run is
/// stopped; it is removed when the run completes. With `resume` the run goes on from there, or from the start where
/// there is no checkpoint yet, and ends with the numbers of a run that was never interrupted, to the last bit on one
/// machine. A run that was completed is left as it is.
///
/// With `step_error` the model is first run with steps twice as long (a tolerance eight times as large), and from the
/// difference of both follows what the steps have done to each bearing's figures (theory manual eq. (integrator.17)).
/// @throws results::FileExists if the results file exists and is not to be overwritten.
/// @throws InputError if `resume` is asked for another model; results::ReadError if results or checkpoint are damaged.
[[nodiscard]] Summary simulate(const model::Model& model, const Options& options);

/// The checkpoint of a results file: results.checkpoint beside results.h5.
[[nodiscard]] std::filesystem::path checkpoint_file(const std::filesystem::path& results);

/// Builds `model` and finds its starting state, as `simulate` does first, and writes nothing.
/// @returns what the user should know though the model runs: initial values that had to move, redundant constraints and
///          how they are treated.
/// @throws InputError as `simulate`, and where error-controlled steps would have to hit instants without end.
std::vector<Fault> check(const model::Model& model);

}  // namespace hersey::run
