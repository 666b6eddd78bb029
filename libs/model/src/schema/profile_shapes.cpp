#include "schema/profile_shapes.h"

#include "check/members.h"

namespace hersey::model {

const std::vector<Alternative<film::ProfileShape>>& profile_shapes() {
  static const TypePtr size = quantity("m", "5 um", Range::not_negative()), angle = quantity("rad", "90 deg");
  static const std::vector<Alternative<film::ProfileShape>> shapes{
      {{"barrel",
        "falls off towards both edges, as a parabola",
        {required("drop", size, "By how much the gap is wider at the edges.")}},
       [](const Value& value) { return film::Barrel{number_of(value, "drop")}; }},
      {{"taper", "a cone", {required("rise", quantity("m", "5 um"), "By how much the gap grows from z < 0 to z > 0.")}},
       [](const Value& value) { return film::Taper{number_of(value, "rise")}; }},
      {{"ovality",
        "an ellipse",
        {required("amplitude", size, "By how much the gap is wider at `angle` and narrower across."),
         defaulted("angle", angle, "0 deg", "Where it is wide.")}},
       [](const Value& value) {
         return film::Ovality{number_of(value, "amplitude"), number_of(value, "angle")};
       }},
      {{"lobes",
        "equal arcs; two make a lemon bore",
        {defaulted("count", integer(2, {.low = 2, .high = 100}), "2", "Number of arcs."),
         required("offset", size,
                  "By how much the centre of each arc is moved away from its middle, where the gap stays that of the "
                  "clearance."),
         defaulted("angle", angle, "90 deg", "Middle of one arc.")}},
       [](const Value& value) {
         return film::Lobes{integer_of(value, "count"), number_of(value, "offset"), number_of(value, "angle")};
       }},
  };
  return shapes;
}

}  // namespace hersey::model
