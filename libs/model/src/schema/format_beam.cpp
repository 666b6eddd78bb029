#include "schema/format.h"

// Beams: slender bodies with large rotations and bending.
namespace hersey::model {
namespace {

/// Moments of inertia over length about the section's axes.
std::vector<Key> rotary_entries() {
  const TypePtr per_length = quantity("kg.m", "0.02 kg.m", Range::positive());
  return {
      required("yy", per_length, "Moment of inertia over length about the section's y-axis."),
      required("zz", per_length, "The same about its z-axis."),
      optional("xx", per_length, "The same about the beam's axis: turning and torsion.", "yy + zz"),
  };
}

TypePtr section_format() {
  const TypePtr length = quantity("m", "40 mm", Range::positive());
  const TypePtr area = quantity("m^2", "12 cm^2", Range::positive());
  const TypePtr moment = quantity("m^4", "12 cm^4", Range::positive());
  const TypePtr circle =
      object("a circle or ring",
             {
                 required("diameter", length, "Outer diameter."),
                 defaulted("bore", quantity("m", "20 mm", Range::not_negative()), "0 mm", "Inner diameter; 0: solid."),
             });
  const TypePtr rectangle = object("a rectangle", {
                                                      required("width", length, "Side along the section's y-axis."),
                                                      required("height", length, "Side along its z-axis."),
                                                  });
  const TypePtr properties =
      object("properties of a section",
             {
                 required("area", area, "Area."),
                 required("shear_y", area, "Effective area in shear along y: area times shear coefficient."),
                 required("shear_z", area, "The same along z."),
                 required("I_y", moment, "Second moment of area about y: bending in the plane x, z."),
                 required("I_z", moment, "Second moment of area about z: bending in the plane x, y."),
                 required("J", moment, "Torsion constant; the polar moment of inertia is from I_y + I_z."),
             });
  return with_exactly_one(object("a cross-section",
                                 {
                                     optional("circle", circle, "A round bar or tube."),
                                     optional("rectangle", rectangle, "A solid rectangle."),
                                     optional("properties", properties, "Any section, by its properties."),
                                     optional("rotary_inertia", object("rotary inertia of a length", rotary_entries()),
                                              "Moments of inertia over length, where they are not density times second "
                                              "moments of area: of published beams, whose stiffness and inertia in "
                                              "bending are given apart. The mass stays density times area.",
                                              "density times I_y + I_z, I_y and I_z"),
                                 }),
                          {"circle", "rectangle", "properties"});
}

}  // namespace

TypePtr beam_format() {
  const TypePtr material =
      object("an isotropic material",
             {
                 required("youngs_modulus", quantity("Pa", "210 GPa", Range::positive()), "Young's modulus."),
                 required("poisson_ratio", number("0.3", {.low = -1, .high = 0.5, .low_open = true, .high_open = true}),
                          "Poisson's ratio, of the shear modulus E/(2 (1 + nu)) and of shear coefficients."),
                 required("density", quantity("kg/m^3", "7850 kg/m^3", Range::positive()), "Density."),
             });
  const TypePtr damping =
      object("damping", {
                            defaulted("stiffness", quantity("s", "2 us", Range::not_negative()), "0 s",
                                      "Forces of strain rates over those of strains; damps fast vibrations."),
                        });
  std::vector<Key> mass_and_rotary = rotary_entries();
  mass_and_rotary.insert(
      mass_and_rotary.begin(),
      required("mass_per_length", quantity("kg/m", "9.4 kg/m", Range::positive()), "Mass over length."));
  const TypePtr inertia = object("mass and rotary inertia of a length", mass_and_rotary);
  return object(
      "a beam",
      {
          required("points", list("points of its axis", vector("m", "0 0 400 mm")),
                   "At least two, straight in between, body axes. The body's origin moves with the first one."),
          required("section", section_format(), "Cross-section, the same everywhere."),
          optional("up", axis_format(), "Direction of the section's z-axis, as far as it lies across the beam.",
                   "z; x of a beam that begins along z"),
          required("material", material, "What it is made of."),
          optional(
              "inertia", inertia,
              "Mass and rotary inertia, where they are not those of section and density: of windings, discs spread "
              "over a length, or measured beams.",
              "those of the section"),
          defaulted("elements", integer(20, {.low = 1, .high = 2000}), "20",
                    "Into how many elements it is divided; their ends lie on all points and frames."),
          defaulted("damping", damping, "{}", "Damping of the material."),
      });
}

}  // namespace hersey::model
