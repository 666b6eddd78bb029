#include "schema/format.h"

namespace hersey::model {

TypePtr couplings_format() {
  const TypePtr coordinate = text("joint.coordinate", "main.rotation");
  const Key input = required("input", coordinate, "A scalar coordinate, `joint.coordinate`.");
  const Key output = required("output", coordinate, "The coordinate that follows.");
  const TypePtr term = object("an input", {input, required("factor", number("0.5"), "Its factor.")});
  const TypePtr coupling = variant(
      "a coupling", "type", {output},
      {
          {"gear",
           "output = ratio times input, both rotations or both translations, from where the joints start",
           {input, required("ratio", number("-2.5"),
                            "Revolutions of the output per revolution of the input; negative where they "
                            "rotate against each other.")}},
          {"rack",
           "output (a translation) = radius times input (a rotation), from where the joints start",
           {input, required("radius", quantity("m", "20 mm"), "Pitch radius; negative to run the other way.")}},
          {"linear",
           "output = sum of factors times inputs, all rotations or all translations, from where the joints start: a "
           "differential",
           {required("inputs", list("inputs", term), "What is added up.")}},
          {"relation",
           "output = function of the input: a cam",
           {input, required("function", relation_format(), "The output over the input.")}},
      });
  return named("a mapping from names to couplings", coupling);
}

}  // namespace hersey::model
