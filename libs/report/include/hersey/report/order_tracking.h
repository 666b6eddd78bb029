#pragma once

#include <complex>
#include <cstddef>
#include <vector>

namespace hersey::report {

/// How a signal is split into orders, multiples of the speed of a shaft.
struct OrderOptions {
  std::vector<double> orders{0.5, 1, 2};  ///< > 0, all different [-]
  int revolutions = 8;                    ///< whole revolutions of a window, > 0
  std::size_t windows = 200;              ///< most windows, spread evenly over the time, > 0
};

/// Orders of a signal, window by window (theory manual, rotors.15): within one it is the mean, a linear drift and
/// Re(a exp(i o theta)) of each order o over the shaft's angle theta.
struct OrderTracks {
  std::vector<double> orders;                   ///< [-]
  std::vector<double> time, angle;              ///< at the middle of each window [s; rad], the angle rising
  std::vector<double> speed;                    ///< mean over the revolution around it, > 0 [rad/s]
  std::vector<double> mean;                     ///< of the signal there
  std::vector<double> peak_to_peak;             ///< largest less smallest row of the window
  std::vector<std::complex<double>> amplitude;  ///< a, shape (windows, orders)

  /// Returns the complex amplitude of the order with an index in `orders`, in a window [unit of the signal].
  [[nodiscard]] std::complex<double> at(std::size_t window, std::size_t order) const {
    return amplitude[window * orders.size() + order];
  }
};

/// Tracks orders of a signal over a run whose speed may change, as a run-up: by least squares in windows of whole
/// revolutions under Hann's weight over the angle. Rows need not be even in time or angle.
///
/// Rows that are no numbers, or whose angle has not risen, are left out. Windows with fewer than 2.5 rows in a period
/// of the highest order, or too few for the unknowns, are left out as well; there may be none at all.
/// @param time   of the rows [s]
/// @param angle  of the shaft, in either sense of rotation [rad]
/// @param signal  in any unit
/// @pre equally many rows; options in their ranges
/// @verified_by order_tracking_test.cpp
[[nodiscard]] OrderTracks track_orders(const std::vector<double>& time, const std::vector<double>& angle,
                                       const std::vector<double>& signal, const OrderOptions& options = {});

/// Mean speed of a shaft over the revolution around each instant, > 0 [rad/s]; at the ends of a run over what there is.
/// @param time   of the rows, of which there are two at least [s]
/// @param angle  of the shaft, in either sense of rotation [rad]
/// @param at  instants within the run [s]
[[nodiscard]] std::vector<double> revolution_speeds(const std::vector<double>& time, const std::vector<double>& angle,
                                                    const std::vector<double>& at);

/// Spectra of a signal, piece by piece of a run.
struct SpectrumCascade {
  std::vector<double> time;       ///< in the middle of each piece [s]
  std::vector<double> frequency;  ///< [Hz]
  std::vector<double> amplitude;  ///< of a sine as large as its peak, shape (pieces, frequencies)
};

/// Spectra of `pieces` pieces of equal length that overlap by half, under Hann's window, without their means.
/// @param highest  frequency [Hz]; at most that of two rows and a half in a period is given
/// @param pieces  > 0
/// @verified_by order_tracking_test.cpp
[[nodiscard]] SpectrumCascade spectrum_cascade(const std::vector<double>& time, const std::vector<double>& signal,
                                               double highest, std::size_t pieces);

}  // namespace hersey::report
