#include "schema/circuit_vocabulary.h"
#include "schema/format.h"
#include "schema/oil_laws.h"
#include "schema/thermal_walls.h"

namespace hersey::model {
namespace {

std::vector<Key> with_shaft(std::vector<Key> keys, const std::string& what) {
  keys.push_back(
      optional("speed", quantity("rad/s", "3000 rpm"), what + ", where no joint gives it.", "that of `joint`"));
  keys.push_back(optional("joint", reference(Refers::joint, "main"), "The joint whose rotation gives the speed."));
  keys.push_back(defaulted("coordinate", reference(Refers::coordinate, "rotation"), "rotation", "Its coordinate."));
  keys.push_back(defaulted("ratio", number("-1.5"), "1",
                           "Revolutions per revolution of the joint; negative where it rotates the other way."));
  return keys;
}

TypePtr node_format() {
  const Range fraction{.low = 0, .high = 1, .high_open = true};
  return object(
      "a node",
      {
          optional("pressure", function_format({"Pa"}, "0 bar"),
                   "Of a sump or a supply, whose pressure is given; a function of time.",
                   "follows from the flows that meet in the node"),
          optional("temperature", temperature_or_node("90 degC"),
                   "Of its oil, which stays; or that of a node of the thermal network, a sump that the oil that flows "
                   "into it warms. With one such node in the circuit the oil carries its heat along.",
                   "of the oil that flows into it"),
          optional("volume", quantity("m^3", "300 cm^3", Range::positive()),
                   "Of oil in the node, which yields to pressure over time, as in a gallery.", "it stores nothing"),
          defaulted("compliance", quantity("m^3/Pa", "1 mm^3/bar", Range::not_negative()), "0 mm^3/bar",
                    "By which the walls around `volume` give way."),
          defaulted("bulk_modulus", quantity("Pa", "1.5 GPa", Range::positive()), "1.5 GPa",
                    "Of the oil in `volume`, without bubbles."),
          defaulted("free_air", number("0.03", fraction), "0",
                    "Fraction of `volume` that is bubbles of air at ambient pressure."),
          defaulted("solubility", number("0.09", Range::not_negative()), "0.09",
                    "Volume of air that oil dissolves at ambient pressure over its own; by Henry's law in proportion "
                    "to absolute pressure."),
      });
}

std::vector<Variant> element_kinds() {
  const TypePtr length = quantity("m", "60 mm", Range::positive()), bore = quantity("m", "5 mm", Range::positive());
  const TypePtr flow_over_pressure = quantity("m^3/s/Pa", "12 l/min/bar", Range::positive());
  const TypePtr leak = quantity("m^3/s/Pa", "0.1 l/min/bar", Range::not_negative());
  return {
      {"drilling",
       "a bore or pipe: laminar or turbulent friction, losses of its ends and bends, and the head of rotation",
       with_shaft({required("length", length, "Its length."), required("diameter", bore, "Of its bore."),
                   defaulted("roughness", quantity("m", "10 um", Range::not_negative()), "0 um",
                             "Height of its wall's roughness."),
                   defaulted("loss_coefficient", number("1.5", Range::not_negative()), "0",
                             "Sum of the coefficients of inlet, outlet and bends, by the velocity in the bore."),
                   defaulted("friction", choice(friction_words), "churchill", "Of its wall."),
                   optional("radii", list("two radii", quantity("m", "30 mm", Range::not_negative()), 2),
                            "Distances of its ends, `from` and `to`, from the axis about which it rotates.",
                            "it does not rotate"),
                   defaulted("course", choice(course_words), "one_side", "With `radii`: past the axis or not.")},
                  "Of the body with which it rotates")},
      {"orifice",
       "a sharp-edged hole or a jet: flow by the root of the drop of pressure",
       {required("diameter", quantity("m", "1.5 mm", Range::positive()), "Of the hole."),
        defaulted("discharge_coefficient", number("0.7", {.low = 0, .high = 1, .low_open = true}), "0.7",
                  "Of flow at large Reynolds numbers.")}},
      {"resistance",
       "a filter or a leak that has been measured: flow in proportion to the drop of pressure",
       {required("resistance", quantity("Pa.s/m^3", "1e9 Pa.s/m^3", Range::positive()),
                 "Drop of pressure over the flow.")}},
      {"cooler",
       "a cooler: flow in proportion to the drop of pressure, and heat to a coolant",
       {required("resistance", quantity("Pa.s/m^3", "1e9 Pa.s/m^3", Range::positive()),
                 "Drop of pressure over the flow."),
        required("conductance", quantity("W/K", "250 W/K", Range::positive()),
                 "Heat from oil to coolant for each kelvin between them, of all of its surface."),
        required("coolant", temperature_or_node("60 degC"),
                 "Temperature of the coolant, or the node of the thermal network that it is.")}},
      {"relief_valve",
       "a valve that opens at a drop of pressure, in proportion to what exceeds it",
       {required("opening_pressure", quantity("Pa", "4 bar"), "Drop of pressure at which it opens."),
        required("conductance", flow_over_pressure, "Flow over what the drop exceeds that by.")}},
      {"pump", "a pump that displaces a volume with each revolution",
       with_shaft({required("displacement", quantity("m^3", "12 cm^3", Range::positive()), "Volume of a revolution."),
                   defaulted("leakage", leak, "0 l/min/bar", "Flow back through its gaps over the rise of pressure."),
                   defaulted("mechanical_efficiency", number("0.85", {.low = 0, .high = 1, .low_open = true}), "1",
                             "Displacement times rise of pressure over the torque that it takes from its joint.")},
                  "Of its shaft")},
      {"pump_curve",
       "a pump whose flow over the rise of pressure has been measured",
       {required("flow", law_format("m^3/s", "rise", "Pa", "20 l/min"),
                 "Over the `rise` of pressure; nowhere ascending.")}},
      {"hole_over_groove",
       "a hole of one surface of a bearing that passes over a groove of the other: an orifice as large as both overlap",
       {required("bearing", text("a bearing", "main_1"), "Whose surfaces they are."),
        required("hole", text("a hole", "mouth"), "A round or oval hole of one surface, in `features`."),
        required("groove", text("a groove", "groove"), "A groove or pocket of the other surface, in `features`."),
        defaulted("discharge_coefficient", number("0.7", {.low = 0, .high = 1, .low_open = true}), "0.7",
                  "Of flow at large Reynolds numbers.")}},
      {"flow",
       "a flow that nothing changes",
       {required("flow", quantity("m^3/s", "10 l/min", Range::positive()), "From `from` to `to`.")}},
  };
}

}  // namespace

Key circuit_node_key() {
  return optional("circuit", text("a node of the circuit", "gallery"),
                  "The node of `circuit` that feeds it, in place of `pressure`: flow and pressure follow from film and "
                  "circuit together.",
                  "no circuit feeds it");
}

TypePtr circuit_format() {
  const TypePtr node = text("a node", "gallery");
  return object("an oil circuit",
                {
                    required("lubricant", reference(Refers::lubricant, "oil"), "Its oil."),
                    optional("temperature", temperature("90 degC"),
                             "Of its oil; where nodes have temperatures, of the others at the start.",
                             "that of the lubricant, or of the first node that has one"),
                    defaulted("cavitation_pressure", quantity("Pa", "-0.5 bar"), "-1.01325 bar",
                              "At which oil ceases to fill nodes from which no film draws: the vacuum, or where air "
                              "comes out of it. Nodes of films have that of the films."),
                    required("nodes", named("a mapping from names to nodes", node_format()),
                             "Where elements and feeds of films meet. `{}`: a junction."),
                    required("elements",
                             named("a mapping from names to elements",
                                   variant("an element", "type",
                                           {required("from", node, "The node from which flows count."),
                                            required("to", node, "The node to which they count.")},
                                           element_kinds())),
                             "What lies between two nodes."),
                });
}

}  // namespace hersey::model
