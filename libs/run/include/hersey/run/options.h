#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace hersey::run {

/// Figures of one bearing at an accepted step, few enough to be shown while the run goes on.
struct BearingProgress {
  std::string name;
  double h_min = 0, p_max = 0;  ///< smallest film thickness [m], largest film pressure [Pa]
  double e_x = 0, e_y = 0;      ///< position of the moving surface in the bearing's axes [m]
  double power = 0;             ///< friction power of film and asperities [W]
  double flow = 0;              ///< oil leaving over the edges [m^3/s]
  double T_max = std::numeric_limits<double>::quiet_NaN();  ///< hottest oil of a film with temperatures [K]
  double power_asperity = 0;                                ///< part of `power`: boundary friction [W]
  bool has_heat = false;                                    ///< a film with temperatures
  double heat_to_oil = 0, heat_to_shell = 0, heat_to_journal = 0, heat_stored = 0;  ///< with them: where it goes [W]
};

/// Powers of the whole machine at an accepted step [W]: those of the results' group `power`, and the heat of the bodies
/// where the model has a thermal network.
struct PowerProgress {
  double drives = 0, loads = 0, gravity = 0, springs = 0, contacts = 0, bearings = 0, elastic = 0, kinetic_rate = 0;
  double error = 0;                                     ///< sum of the others less the kinetic rate
  double film_friction = 0, asperity_friction = 0;      ///< dissipated in all films
  bool has_network = false;                             ///< whether there are bodies that the films warm
  double heat_to_surroundings = 0, heat_in_bodies = 0;  ///< where the network carries it, and where it stays
};

/// Figures of the oil circuit at an accepted step; empty of a machine without one.
struct CircuitProgress {
  struct Node {
    std::string name;
    double pressure = 0, drawn = 0;                                 ///< [Pa]; by films from it [m^3/s]
    double temperature = std::numeric_limits<double>::quiet_NaN();  ///< of oil that carries heat along [K]
  };
  struct Element {
    std::string name;
    double flow = 0;  ///< [m^3/s]
  };
  std::vector<Node> nodes;
  std::vector<Element> elements;
};

/// Progress of a run; handed to Options::on_progress after every accepted step.
struct Progress {
  double t = 0, t_start = 0, t_end = 0;                   ///< [s]
  double dt = 0;                                          ///< length of the last step [s]
  int newton_iterations = 0;                              ///< of that step
  double moft = std::numeric_limits<double>::infinity();  ///< minimum oil film thickness so far, all bearings [m]
  double elapsed = 0;                                     ///< wall time since the start of the run [s]
  /// Returns the figures of all bearings at this step; to be called, if wanted, before on_progress returns. May be
  /// empty.
  std::function<std::vector<BearingProgress>()> bearings = {};
  std::function<CircuitProgress()> circuit = {};  ///< likewise
  std::function<PowerProgress()> powers = {};     ///< likewise
};

/// A cycle that has just ended; handed to Options::on_cycle.
struct CycleProgress {
  int number = 0;         ///< from 1
  double change = 0;      ///< largest difference from the cycle before, relative; not a number in the first
  std::string largest;    ///< of what, "film thickness of big_end"
  bool leads_in = false;  ///< it is of the lead-in (model::LeadIn), before those of the run
};

struct StudyParameterValue {
  std::string name, text;
};

struct Options {
  std::filesystem::path results;  ///< the HDF5 file to write; a Simulation writes none if it is empty
  bool overwrite = false;         ///< replace an existing one
  bool step_error = false;        ///< run with steps twice as long first, and compare
  bool resume = false;            ///< go on where `results` and its checkpoint end
  std::function<void(const Progress&)> on_progress;    ///< may be empty
  std::function<void(const CycleProgress&)> on_cycle;  ///< may be empty
  const std::atomic<bool>* stop = nullptr;             ///< set from a signal handler: end after the current step
  std::function<void()> on_stopping;  ///< it ends so: checkpoint and results are yet to be written; may be empty
  std::vector<StudyParameterValue> study_parameters;  ///< of this run, for the results file
};

}  // namespace hersey::run
