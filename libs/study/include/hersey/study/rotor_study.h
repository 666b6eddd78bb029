#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "hersey/model/study.h"
#include "hersey/run/rotor.h"
#include "hersey/study/study.h"

/// A rotor over its speeds: Campbell diagram, unbalance response, critical speeds, and the table that API 617 and 684
/// ask for.
namespace hersey::study {

/// A rotor at one speed.
struct RotorAtSpeed {
  std::string label;                      ///< of the run, "speed = 3000 rpm"
  std::vector<model::StudyValue> values;  ///< of the run
  run::RotorState state;
  std::vector<run::WhirlMode> modes;
  std::vector<int> tracks;                         ///< of each mode: the same number at another speed is the same mode
  std::optional<run::UnbalanceResponse> response;  ///< unset: the model has no unbalance
};

/// Finds the rotor at the speeds of `runs` and follows its modes from one to the next; ascending by speed.
/// @param stations  frames whose motion is wanted
/// A speed that the model refuses is not solved, and says why.
/// @throws InputError as run::find_rotor_state, where it refuses all speeds
[[nodiscard]] std::vector<RotorAtSpeed> rotor_over_speeds(const ModelReader& read,
                                                          const std::vector<model::StudyRun>& runs,
                                                          const std::vector<std::string>& stations);

/// A speed at which a mode's damped frequency equals the speed.
struct DampedCriticalSpeed {
  int track = 0;
  double speed = 0;          ///< [rad/s]
  double log_decrement = 0;  ///< there
  run::Whirl whirl = run::Whirl::forward;
};
/// Returns the damped critical speeds between the speeds of `rotor`, by linear interpolation; none where two of them
/// are equal, because something else is varied.
[[nodiscard]] std::vector<DampedCriticalSpeed> damped_critical_speeds(const std::vector<RotorAtSpeed>& rotor);

/// A peak of an unbalance response over the speed.
struct ResponsePeak {
  std::size_t station = 0;
  double speed = 0;      ///< [rad/s]
  double amplitude = 0;  ///< half of the longest diameter of the orbit [m]
  /// Amplification factor N_c/(N_2 - N_1) by the speeds at which the amplitude is 0.707 of the peak (rotors.13); not a
  /// number where one of them is outside the range of speeds or hidden by a higher peak, or where the speeds are too
  /// far apart.
  double amplification = std::numeric_limits<double>::quiet_NaN();
  double before = 0, after = 0;  ///< neighbouring speeds of the sweep [rad/s]
  /// False: between two neighbouring speeds the amplitude falls below 0.707 of the peak; the true peak lies somewhere
  /// between these and may be far higher and sharper.
  bool is_resolved = true;
};
/// Returns the peaks at each station; none where two speeds are equal.
[[nodiscard]] std::vector<ResponsePeak> response_peaks(const std::vector<RotorAtSpeed>& rotor);
/// The same of one curve. @param speeds  ascending @param station  taken over
[[nodiscard]] std::vector<ResponsePeak> peaks_of(const std::vector<double>& speeds,
                                                 const std::vector<double>& amplitudes, std::size_t station);

/// Range of speeds in service [rad/s].
struct OperatingRange {
  double low = 0, high = 0;
};

/// Distance of a critical speed from the operating range, as a fraction of its nearer end.
struct SeparationMargin {
  double actual = 0;    ///< 0 within the range
  double required = 0;  ///< by API 617 and 684; 0 where the critical speed is critically damped
  /// True if the critical speed is far enough away.
  [[nodiscard]] bool is_enough() const { return actual >= required; }
};
/// Theory manual eq. (rotors.14). A response whose amplification is not a number is taken for an undamped one.
[[nodiscard]] SeparationMargin separation_margin(double speed, double amplification, const OperatingRange& range);

/// Stability of a rotor over a cross-coupled stiffness, level 1 of API 617.
struct StabilityScreening {
  std::vector<double> Q, log_decrement;  ///< of the least damped whirl up to 1.25 times the speed; Q up to ten times
                                         ///< that anticipated [N/m]
  double anticipated = 0;                ///< Q_A [N/m]
  double at_anticipated = 0;             ///< log decrement
  double threshold = std::numeric_limits<double>::infinity();  ///< Q_0 at which it is zero; infinite: above the range
  /// True if no analysis of level 2 is asked for: log decrement of 0.1 and Q_0 of twice Q_A.
  [[nodiscard]] bool is_enough() const { return at_anticipated >= 0.1 && threshold >= 2 * anticipated; }
};
/// Screens a rotor whose seals and impellers are anticipated to have a cross-coupled stiffness.
[[nodiscard]] StabilityScreening screen_stability(const run::RotorState& rotor, const run::CrossCoupling& anticipated);

/// Undamped critical speeds over the stiffness of the bearings.
struct CriticalSpeedMap {
  std::vector<double> stiffness;                           ///< [N/m]
  std::vector<std::vector<run::CriticalSpeed>> criticals;  ///< of each stiffness
};
/// @param low, high  > 0 @param points  of equal ratio
[[nodiscard]] CriticalSpeedMap critical_speed_map(const run::RotorState& rotor, double low, double high, int points);

}  // namespace hersey::study
