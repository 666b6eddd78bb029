#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hersey/model/model.h"
#include "tree/source_tree.h"

namespace hersey::model {

/// A bearing of several films and bodies, taken out of a model's tree and spelt out there as parts that could have been
/// written by hand.
struct CompositeParts {
  std::string name, kind;
  SourcePosition position;              ///< of its key
  std::string fixed_key;                ///< of the frame on the fixed side, "shell"
  std::vector<std::string> pads;        ///< names of its films, which are those of its pads
  std::vector<std::string> sections;    ///< of the entry that each film has for itself, "inner"; empty of pads
  std::vector<std::string> own_keys;    ///< keys there, "inner.width"
  std::vector<double> pivot_angles;     ///< of each pad, from the fixed frame's x-axis towards y [rad]
  double pivot_radius = 0;              ///< of pads below a collar: distance of the pivots from the axis [m]
  double clearance = 0;                 ///< around a journal: assembled, radial [m]; below a collar a usual film
  double speed = 1;                     ///< of the journal where parts begin; 1 where it is not known [rad/s]
  double whirl_ratio = 1;               ///< frequency over the journal's at which the pads follow [-]
  std::optional<OperatingPoint> point;  ///< of the bearing by itself
  bool is_in_machine = false;           ///< false: it is described by itself only
  Node alone;                           ///< a model of the bearing by itself, at its operating point or centred
};

}  // namespace hersey::model
