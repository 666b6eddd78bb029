#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "hersey/report/order_tracking.h"
#include "hersey/results/reader.h"

namespace hersey::report {

/// Rows of a run, from `begin` to before `end`.
struct Stretch {
  std::size_t begin = 0, end = 0;
};

/// A shaft that changes its speed, over the rows of the run in which it does not turn round.
struct RotatingShaft {
  std::string name;           ///< of the joint or body; "crank"
  Stretch stretch;            ///< rows of the run: the longest without turning round
  std::vector<double> time;   ///< of each row of it [s]
  std::vector<double> angle;  ///< of each row of it [rad]
  int revolutions = 0;        ///< of a window
};

/// A displacement of a run-up: of a journal in its bearing, or of a body.
struct RunUpSignal {
  std::string path;        ///< of the dataset
  std::size_t column = 0;  ///< in it
  std::size_t shaft = 0;   ///< whose orders are tracked, in RunUp::shafts
  OrderTracks tracks;

  /// The window with the largest amplitude once a revolution.
  struct Peak {
    double size = 0;             ///< amplitude [m]
    double speed = 0, time = 0;  ///< [rad/s; s]
    double lag = 0;              ///< behind the shaft's angle [rad]
  };
  [[nodiscard]] Peak peak() const;
};

/// A run-up or coast-down with the orders of what moves.
struct RunUp {
  std::vector<RotatingShaft> shafts;       ///< that of the run first
  std::vector<RunUpSignal> displacements;  ///< journals first
};

/// Tracks the orders of a run in which a shaft makes twenty revolutions or more one way while its speed, as a mean over
/// one of them, changes by more than a fifth; unset for any other run. The shaft is the crank, else the joint that
/// rotates most, else the body that does. What rotates at another changing speed, as a second shaft or a ring, has the
/// orders of its own joint or body.
/// @verified_by run_up_test.cpp
[[nodiscard]] std::optional<RunUp> find_run_up(const results::Reader& reader);

/// The run-up as the page reads it (RunUpText of web/src/data.ts), with spectra; null for any other run.
[[nodiscard]] nlohmann::json run_up_data(const results::Reader& reader);

}  // namespace hersey::report
