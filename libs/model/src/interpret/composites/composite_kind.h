#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "check/check.h"
#include "interpret/composites/alone.h"
#include "interpret/composites/composite_parts.h"
#include "interpret/composites/floating_ring.h"
#include "interpret/composites/thrust_pads.h"
#include "interpret/composites/tilting_pads.h"

namespace hersey::model {

/// How one kind of composite is spelt out. A new kind is a file with its parts, and its line in composite_kinds().
struct CompositeKind {
  std::string_view tag;
  std::string fixed, moving;  ///< keys of its two frames
  std::string body;           ///< that stands for the moving one by itself
  /// Reads the operating point.
  void (*read_point)(const Value& bearing, CompositeParts& parts, std::vector<Fault>& faults);
  /// Returns its parts, as tilting_pads().
  std::optional<Node> (*parts)(const Node& node, const Value& value, const std::string& fixed,
                               const std::string& moving, CompositeParts& parts, std::vector<Fault>& faults);
  /// Returns the model file around its parts by itself.
  std::string (*alone)(const CompositeParts& parts);
};

/// All kinds.
[[nodiscard]] inline const std::vector<CompositeKind>& composite_kinds() {
  static const std::vector<CompositeKind> kinds{
      {"tilting_pad", "shell", "journal", "journal", read_journal_of_composite, tilting_pads, journal_alone},
      {"tilting_pad_thrust", "stator", "runner", "collar", read_collar_of_composite, thrust_pads, collar_alone},
      {"floating_ring", "shell", "journal", "journal", read_journal_of_composite, floating_ring, journal_alone}};
  return kinds;
}

}  // namespace hersey::model
