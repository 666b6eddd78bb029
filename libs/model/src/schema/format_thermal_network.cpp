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
  return object(
      "a thermal network",
      {
          optional(
              "walls", choice(thermal_walls_words),
              "What walls that warm do in a simulation: rings and free journals; bodies of the network are frozen by "
              "`frozen`, and else follow their heat capacity.",
              "cycle_mean of a machine with cycles, transient of others"),
          optional("nodes", named("a mapping from names to nodes", node),
                   "Bodies and surroundings; a bearing's shell or journal is one with `{wall: node, node: block}`, and "
                   "several bearings may share one.",
                   "none"),
          optional("paths", named("a mapping from names to paths", path), "What conducts heat between nodes.", "none"),
      });
}

}  // namespace hersey::model
