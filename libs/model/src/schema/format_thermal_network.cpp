#include "schema/film_vocabulary.h"
#include "schema/format.h"
#include "schema/oil_laws.h"

namespace hersey::model {

TypePtr thermal_network_format() {
  const TypePtr node = with_exactly_one(
      object(
          "a node",
          {
              optional("heat_capacity", quantity("J/K", "20 kJ/K", Range::positive()),
                       "Of a body of one temperature, which it follows from the heat that it takes up."),
              optional("fixed", temperature("25 degC"), "Of surroundings, which keep their temperature."),
              defaulted("temperature", temperature("25 degC"), "20 degC", "Of a body, at the start of a simulation."),
          }),
      {"heat_capacity", "fixed"});
  const TypePtr path = object(
      "a path of heat",
      {
          required("between", list("two nodes", reference(Refers::thermal_node, "block"), 2), "What it connects."),
          required("conductance", quantity("W/K", "5 W/K", Range::not_negative()),
                   "Heat flow for each kelvin between them: k A/l of a bar, alpha A of a surface."),
      });
  const TypePtr groove = object(
      "a groove between films",
      {
          required(
              "between", list("two bearings", text("a bearing", "pad_1"), 2),
              "The one whose film ends at the groove, then the one whose film begins there, counted from x towards "
              "y; both lie on arcs."),
          optional("temperature", temperature("40 degC"), "Of the fresh oil that mixes with what the films bring.",
                   "`edge_temperature` of the film that begins there"),
          optional("carry_over", number("0.9", {.low = 0, .high = 1}),
                   "Share of the oil that comes out of the films which stays on the journal; 0: all is renewed.",
                   "that of the film that begins there"),
      });
  return object(
      "a thermal network",
      {
          optional("walls", choice(thermal_walls_words),
                   "What walls that warm (`ring`, `free` and `node`) do in a simulation.",
                   "cycle_mean of a machine with cycles, transient of others"),
          optional("nodes", named("a mapping from names to nodes", node),
                   "Bodies and surroundings; a bearing's shell or journal is one with `{wall: node, node: block}`, and "
                   "several bearings may share one.",
                   "none"),
          optional(
              "grooves", named("a mapping from names to grooves", groove),
              "Grooves between films of several bearings, such as pads, in which the oil that one film brings warms "
              "what the next one draws.",
              "none"),
          optional("paths", named("a mapping from names to paths", path), "What conducts heat between nodes.", "none"),
      });
}

}  // namespace hersey::model
