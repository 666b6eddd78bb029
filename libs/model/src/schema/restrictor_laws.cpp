#include "schema/restrictor_laws.h"

#include "check/members.h"

namespace hersey::model {

const std::vector<Alternative<film::RestrictorLaw>>& restrictor_laws() {
  const TypePtr bore = quantity("m", "0.6 mm", Range::positive());
  static const std::vector<Alternative<film::RestrictorLaw>> laws{
      {{"capillary",
        "a long, narrow bore with laminar flow, which is proportional to the drop of pressure and to 1/viscosity",
        {required("length", quantity("m", "30 mm", Range::positive()), "Its length."),
         required("diameter", bore, "Of its bore.")}},
       [](const Value& law) {
         return film::Capillary{number_of(law, "length"), number_of(law, "diameter")};
       }},
      {{"resistance",
        "a measured capillary, slot or porous plug: flow in proportion to the drop of pressure",
        {required("resistance", quantity("Pa.s/m^3", "3e11 Pa.s/m^3", Range::positive()),
                  "Drop of pressure over the flow.")}},
       [](const Value& law) { return film::FlowResistance{number_of(law, "resistance")}; }},
      {{"orifice",
        "a sharp-edged hole: flow by the root of the drop of pressure, and creeping flow where the drop is small",
        {required("diameter", bore, "Of the hole."),
         defaulted("discharge_coefficient", number("0.6", {.low = 0, .high = 1, .low_open = true}), "0.6",
                   "Of flow at large Reynolds numbers; sharp edges: 0.6 to 0.65.")}},
       [](const Value& law) {
         return film::Orifice{number_of(law, "diameter"), number_of(law, "discharge_coefficient")};
       }},
      {{"constant_flow",
        "a pump of its own; a `pressure` of the feature is its limit, over whose last 5 % a relief valve takes the "
        "flow "
        "back",
        {required("flow", quantity("m^3/s", "0.5 l/min", Range::positive()), "What it delivers.")}},
       [](const Value& law) { return film::ConstantFlow{.rate = number_of(law, "flow")}; }},
  };
  return laws;
}

Key restrictor_key() {
  return optional("restrictor", variant("a restrictor", "type", {}, variants_of(restrictor_laws())),
                  "Through which it is fed: `pressure` is then that of the supply, before it, and the pressure in the "
                  "feature follows from the flow that the film takes.",
                  "the feature has the pressure of its supply");
}

}  // namespace hersey::model
