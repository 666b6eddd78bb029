#include <numbers>

#include "schema/format.h"
#include "schema/machine_vocabulary.h"
#include "schema/oil_laws.h"

// Bodies that deform.
namespace hersey::model {

TypePtr body_heat_format() {
  const TypePtr cooling =
      object("heat transfer to surroundings",
             {
                 required("heat_transfer", quantity("W/m^2/K", "80 W/m^2/K", Range::not_negative()), "Coefficient."),
                 required("ambient", temperature("40 degC"), "Temperature of what is around."),
             });
  return object(
      "heat in a body",
      {
          required("conductivity", quantity("W/m/K", "46 W/m/K", Range::positive()), "Of its material."),
          optional("expansion", quantity("1/K", "12e-6 1/K", Range::not_negative()),
                   "Linear thermal expansion: a bearing's surface that takes its temperature from the body takes its "
                   "shape too.",
                   "the body keeps its shape"),
          defaulted("reference_temperature", temperature("20 degC"), "20 degC",
                    "At which it has the shape of the mesh."),
          optional(
              "cooling", named("a mapping from surfaces or sets of nodes to surroundings", cooling),
              "Where the body gives heat off; no heat passes other surfaces. `rest` is all of its surface that has "
              "no other cooling, no given temperature and no film.",
              "none"),
          optional("temperatures",
                   named("a mapping from surfaces or sets of nodes to temperatures", temperature("60 degC")),
                   "Where its temperature is given.", "none"),
          optional("fixed", list("sets of nodes", text("a set of nodes", "base")),
                   "Nodes that are fixed as the body expands.", "none: it expands freely"),
      });
}

TypePtr sector_format() {
  const TypePtr length = quantity("m", "20 mm", Range::positive());
  const TypePtr angle = quantity("rad", "90 deg"), extent = quantity("rad", "60 deg", Range::positive());
  const TypePtr seat =
      object("where a sector stands", {
                                          required("angle", angle, "Its middle, from the body's x-axis towards y."),
                                          required("arc", extent, "Its extent around, on the outer face."),
                                          optional("width", length, "Its extent along the axis.", "that of the sector"),
                                      });
  return object(
      "a sector of a ring about the body's z-axis",
      {
          required("inner_radius", length, "Radius of its inner face."),
          required("thickness", length, "From there to its outer face."),
          required("width", length, "Along the axis, half of it on either side of the body's origin."),
          required("middle", angle, "Angle of its middle, from the body's x-axis towards y."),
          required("arc", quantity("rad", "60 deg", {.low = 0, .high = 1.95 * std::numbers::pi, .low_open = true}),
                   "Its extent around."),
          defaulted("elements", list("three numbers", integer(12, {.low = 1, .high = 1000}), 3), "[12, 4, 2]",
                    "Quadratic elements around, along and through it."),
          optional("seat", seat, "A part of the outer face, the set of nodes `seat`, on whose borders elements end.",
                   "none"),
      });
}

TypePtr flexible_format() {
  const Key density = required("density", quantity("kg/m^3", "7850 kg/m^3", Range::positive()), "Density.");
  const TypePtr orthotropic = object(
      "an orthotropic material: nine constants along axes 1, 2, 3",
      {
          required("youngs_moduli", vector("Pa", "140 10 10 GPa"), "E_1, E_2, E_3."),
          required(
              "poisson_ratios", list("three numbers", number("0.3"), 3),
              "nu_12, nu_23, nu_13: contraction along the second axis under tension along the first, by the stretch."),
          required("shear_moduli", vector("Pa", "5 4 5 GPa"), "G_12, G_23, G_13."),
          optional("axes", rotation_format(), "Rotates axes 1, 2, 3 from the body's x, y, z.", "none"),
      });
  const TypePtr material = with_together(
      with_exactly_one(
          object("an elastic material",
                 {
                     optional("youngs_modulus", quantity("Pa", "210 GPa", Range::positive()), "Young's modulus."),
                     optional("poisson_ratio",
                              number("0.3", {.low = -1, .high = 0.5, .low_open = true, .high_open = true}),
                              "Poisson's ratio."),
                     optional("orthotropic", orthotropic, "Nine constants instead of these two."),
                     density,
                 }),
          {"youngs_modulus", "orthotropic"}),
      {"youngs_modulus", "poisson_ratio"});
  const TypePtr damping = object(
      "Rayleigh damping", {
                              defaulted("mass", quantity("Hz", "2 1/s", Range::not_negative()), "0 1/s",
                                        "Times the mass matrix, of the deformation alone; damps slow vibrations."),
                              defaulted("stiffness", quantity("s", "2 us", Range::not_negative()), "0 s",
                                        "Times the stiffness matrix; damps fast vibrations."),
                          });
  const TypePtr flexible = object(
      "a flexible body",
      {
          optional(
              "mesh", text("a mesh file", "conrod.inp"),
              "Mesh beside the model file: Gmsh .msh, Abaqus or CalculiX .inp, Nastran .bdf. Its axes are the body's."),
          optional("reduced", text("a file of `hersey reduce`", "conrod.h5"),
                   "Reduced body beside the model file, instead of a mesh: its frames come with it by their names, and "
                   "its material, modes and units are those it was made with."),
          optional(
              "sector", sector_format(),
              "A sector of a ring, meshed by the program, instead of a mesh: pads, half sleeves. Surfaces and sets "
              "of nodes are `inner`, `outer`, `first_end`, `last_end` (by the angle), `low_side`, `high_side` (by "
              "z), and `seat`."),
          optional("length_unit", quantity("m", "1 mm", Range::positive()), "What a length of 1 in the mesh means.",
                   "must be given with `mesh`"),
          optional("part", text("a part of the mesh file", "Block"),
                   "Of an Abaqus file with several `*PART`: the one that is the body.", "the file has no other"),
          defaulted("parts", choice(parts_words), "one", "Whether the mesh may have parts that share no node."),
          optional("material", material, "Material of all elements.", "the materials of the mesh file"),
          optional("heat", body_heat_format(), "How the body conducts heat, steadily, and expands.",
                   "no bearing takes its temperature from it"),
          defaulted("form", choice(form_words), "modal", "What deforms."),
          defaulted("strain", choice(strain_words), "small", "How displacements strain the body."),
          defaulted("modes", integer(10, {.low = 0, .high = 1000}), "10",
                    "How many vibrations with all frames fixed, those of lowest frequency, add to the static shapes; "
                    "and those that "
                    "share the last one's frequency."),
          optional("highest_frequency", quantity("Hz", "5 kHz", Range::positive()),
                   "Vibrations above this frequency are left out.", "no limit"),
          optional("load_surfaces", list("surfaces or sets of nodes", text("a surface or a set of nodes", "big_end")),
                   "Where pressures act on the mesh: there the body shall deform as the whole mesh would.", "none"),
          defaulted("static_error", number("0.01", {.low = 0, .high = 1, .low_open = true, .high_open = true}), "0.01",
                    "Largest error of the static displacement of each of `load_surfaces` under pressures of a bore's "
                    "lowest harmonics, by the largest displacement: static shapes are added until it holds."),
          defaulted("load_harmonics", integer(4, {.low = 0, .high = 40}), "4",
                    "Highest harmonic around a bore of the pressures that `static_error` looks at."),
          defaulted("damping", damping, "{}", "Damping of the material."),
          optional("vtu_every", quantity("s", "1 ms", Range::positive()),
                   "Writes the deformed mesh at this interval beside the results file, for ParaView.", "not written"),
      });
  return with_exactly_one(flexible, {"mesh", "reduced", "sector"});
}

}  // namespace hersey::model
