#pragma once

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "hersey/core/outcome.h"
#include "hersey/run/work.h"

namespace hersey::run {

enum class Status {
  failed,     ///< no convergence at the smallest step, or the results file could not be written
  completed,  ///< reached the end, or settled
  stopped,    ///< stopped on request; results up to then are complete
};

/// Estimated errors that the length of the steps causes in the figures of one bearing; not a number if no estimate was
/// requested.
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
  double mean_power_film = 0;                             ///< the film's part of it [W]
  double mean_power_other_shear = 0;                      ///< that with the other film::CavitatedShear [W]
  double mean_flow = 0;                                   ///< mean oil flow over both edges [m^3/s]
  double worst_mass_balance = 0;                          ///< largest mass_balance_error of a step [-]
  double energy_put_in = 0;                               ///< by the bodies, through the film's forces on them [J]
  double energy_taken = 0;  ///< by shear, flow, friction, storage and oil, each an integral over the film [J]
  double energy_error = 0;  ///< their difference over the film's dissipation [-]
  double T_max = std::numeric_limits<double>::quiet_NaN();  ///< hottest oil of a film with temperatures [K]
  double reynolds_max = 0, laminar_share = 1;  ///< largest Reynolds number, smallest laminar share of the area [-]
  double turned = 0, travelled = 0;  ///< rotation of the journal in its shell: net, and the sum of its magnitudes [rad]
  std::vector<std::string> warnings;  ///< states in which the film exceeds the range for which its oil is known
  std::string cavitated_shear;  ///< the assumption taken, with the result of the alternative; empty if it makes no
                                ///< difference
  StepErrors step_error;        ///< where Options::step_error asks for it
};

/// Balance of the energy put into a machine since the start of the run [J]. Each part is a separate integral: of a
/// film's shear, of its flows, of the losses of dampers and contacts, of stored energy. A remainder points to a force
/// that does not do the work of its losses, to steps that are too long, or to the integrator's own damping.
struct EnergySummary {
  double put_in = 0;             ///< by drives, motors, loads and pressures
  double films = 0;              ///< dissipated by shear and flow of the oil
  double boundary_friction = 0;  ///< dissipated where asperities touch
  double contacts = 0;           ///< lost in contacts of bodies
  double dampers = 0;            ///< lost in dampers, joint friction and the material of flexible bodies
  double oil = 0;                ///< carried out by oil that leaves the films, less the energy that feeds bring
  double film_storage = 0;       ///< more in liners, asperities and compressed oil than at the start
  double stored = 0;             ///< more kinetic, potential, spring and strain energy than at the start
  double available = 0;     ///< energy at the start and energy put in or released since (theory manual, integrator.32)
  double from_nowhere = 0;  ///< energy gained by steps beyond the work of what acted, integrator.33: at the end, less
                            ///< what was lost again
  /// Dissipated by films, asperities, contacts and dampers.
  [[nodiscard]] double lost() const { return films + boundary_friction + contacts + dampers; }
  /// Remainder of put_in that the other parts do not explain.
  [[nodiscard]] double unexplained() const { return put_in - lost() - oil - film_storage - stored; }
  /// |unexplained| over the energy available [-].
  [[nodiscard]] double error() const { return available > 0 ? std::abs(unexplained()) / available : 0; }
  /// from_nowhere over the energy available [-].
  [[nodiscard]] double share_from_nowhere() const { return available > 0 ? from_nowhere / available : 0; }
};

/// Summary of a run; completed and stopped runs count as solved. The message gives the reason of an early end:
/// "settled" if nothing changed any more.
struct [[nodiscard]] Summary : OutcomeOf<Status, Status::completed, Status::stopped> {
  std::string warning;   ///< about a resumed run, and of FMUs
  double t_end = 0;      ///< last accepted time [s]
  double t_results = 0;  ///< last time in the results file [s]
  int steps = 0, rejected_steps = 0;
  int newton_iterations = 0;
  int cycles = 0;                     ///< that ended, where the model asks for cycles
  double cycle_change = 0;            ///< of the last of them: CycleProgress::change
  int lead_in_cycles = 0;             ///< that were run on coarser grids before, and discarded
  double worst_step_error = 0;        ///< largest local error of a step: angles [rad], lengths over sizes, StepError
  double worst_constraint_drift = 0;  ///< largest violation of a constraint, relative to the compared quantities [-]
  double worst_power_balance = 0;     ///< largest residual power of the equations of motion over the largest power [-]
  EnergySummary energy;               ///< where the energy went
  double wall_time = 0;               ///< [s]
  Work work;                          ///< where it went
  std::vector<BearingSummary> bearings;
  std::filesystem::path results;
};

}  // namespace hersey::run
