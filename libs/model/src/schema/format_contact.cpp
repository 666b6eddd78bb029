#include "schema/format.h"

namespace hersey::model {

TypePtr contacts_format() {
  const TypePtr material =
      object("a material",
             {
                 required("youngs_modulus", quantity("Pa", "210 GPa", Range::positive()), "Young's modulus."),
                 required("poisson_ratio", number("0.3", {.low = -1, .high = 0.5, .low_open = true, .high_open = true}),
                          "Poisson's ratio."),
             });
  const TypePtr stiffness = object(
      "a stiffness",
      {
          optional("force", quantity("N", "1 kN", Range::positive()), "Normal force at this penetration."),
          optional(
              "pressure", quantity("Pa", "10 MPa", Range::positive()),
              "Of a mesh on anything but a sphere: pressure at this penetration. Each corner of the mesh represents "
              "the area around it."),
          required("penetration", quantity("m", "10 um", Range::positive()), "What force or pressure belong to."),
          optional("exponent", number("1.5", {.low = 1}), "Force or pressure grow with this power of the penetration.",
                   "1.5 with `force`, 1 with `pressure`"),
      });
  const TypePtr damping = object(
      "a damping",
      {
          optional("coefficient", quantity("s/m", "0.5 s/m", Range::not_negative()),
                   "The elastic force grows by this share for each velocity of penetration (Hunt and Crossley)."),
          optional("restitution", number("0.8", {.low = 0, .high = 1, .low_open = true}),
                   "Speed after an impact over the speed before it; gives the coefficient exactly."),
          optional("speed", quantity("m/s", "1 m/s", Range::positive()),
                   "Speed of the impact that `restitution` was measured at; slower ones lose less."),
      });
  const TypePtr friction =
      object("friction", {
                             required("coefficient", number("0.3", Range::not_negative()), "Of Coulomb friction."),
                             defaulted("slip_speed", quantity("m/s", "1 mm/s", Range::positive()), "1 mm/s",
                                       "Below some times this speed friction gives way: what sticks creeps slower "
                                       "than this."),
                         });
  const TypePtr contact = object(
      "a contact",
      {
          required("between", list("two shapes", reference(Refers::shape, "ball.surface"), 2),
                   "Shapes of two bodies, or of a body and ground: a sphere and anything, a half-space and anything "
                   "but another, two capsules, a mesh and anything but another mesh."),
          optional("materials", list("two materials", material, 2),
                   "Of the first and the second shape: the stiffness follows from Hertz, where both shapes' radii are "
                   "known."),
          optional("stiffness", with_exactly_one(stiffness, {"force", "pressure"}), "The stiffness itself."),
          optional("damping",
                   with_together(with_exactly_one(damping, {"coefficient", "restitution"}), {"restitution", "speed"}),
                   "Loss of energy in an impact.", "none"),
          optional("friction", friction, "Friction.", "none"),
      });
  return named("a mapping from names to contacts", with_exactly_one(contact, {"materials", "stiffness"}));
}

}  // namespace hersey::model
