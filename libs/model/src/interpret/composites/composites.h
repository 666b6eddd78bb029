#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hersey/model/model.h"
#include "tree/source_tree.h"

namespace hersey::model {

/// A bearing of several films and bodies, taken out of a model's tree and spelt out there as parts that could have been
/// written by hand.
struct CompositeParts {
  std::string name;
  SourcePosition position;            ///< of its key
  std::vector<std::string> pads;      ///< names of its films, which are those of its pads
  std::vector<double> pivot_angles;   ///< of each pad, from the shell's x-axis towards y [rad]
  double preload = 0;                 ///< of each pad [-]
  double sense = 1;                   ///< of the journal's rotation, 1 or -1, where the pads begin
  double whirl_ratio = 1;             ///< frequency over the journal's at which the pads follow [-]
  std::optional<JournalPoint> point;  ///< of the bearing by itself
  bool is_in_machine = false;         ///< false: it is described by itself only
  Node alone;                         ///< a model of the bearing by itself, at its operating point or centred
};

/// The composites of a model and the location of their keys.
struct Composites {
  std::vector<CompositeParts> parts;
  std::map<std::string, SourcePosition> positions;
};

/// Spells out all composites of the tree `root`, whose templates and parameters have been put in. One that is at fault
/// is taken out, and its faults are added to `faults`.
[[nodiscard]] Composites expand_composites(Node& root, std::vector<Fault>& faults);

/// Gives faults in parts of a composite the path of the composite, which is what the file has.
void name_composites(const std::vector<CompositeParts>& composites, std::vector<Fault>& faults);

}  // namespace hersey::model
