#include "format.h"

// Bodies that deform.
namespace hersey::model {

TypePtr flexible_format() {
  const TypePtr material =
      object("an elastic material",
             {
                 required("youngs_modulus", quantity("Pa", "210 GPa", Range::positive()), "Young's modulus."),
                 required("poisson_ratio", number("0.3", {.low = -1, .high = 0.5, .low_open = true, .high_open = true}),
                          "Poisson's ratio."),
                 required("density", quantity("kg/m^3", "7850 kg/m^3", Range::positive()), "Density."),
             });
  const TypePtr damping = object(
      "Rayleigh damping", {
                              defaulted("mass", quantity("Hz", "2 1/s", Range::not_negative()), "0 1/s",
                                        "Times the mass matrix, of the deformation alone; damps slow vibrations."),
                              defaulted("stiffness", quantity("s", "2 us", Range::not_negative()), "0 s",
                                        "Times the stiffness matrix; damps fast vibrations."),
                          });
  return object(
      "a flexible body",
      {
          required(
              "mesh", text("a mesh file", "conrod.inp"),
              "Mesh beside the model file: Gmsh .msh, Abaqus or CalculiX .inp, Nastran .bdf. Its axes are the body's."),
          required("length_unit", quantity("m", "1 mm", Range::positive()), "What a length of 1 in the mesh means."),
          optional("material", material, "Material of all elements.", "the materials of the mesh file"),
          defaulted("form", choice({{"modal", "it moves in static shapes of its frames and vibrations"},
                                    {"nodal", "every node moves; `modes` then only draw it in the report"}}),
                    "modal", "What deforms."),
          defaulted("modes", integer(10, {.low = 0, .high = 1000}), "10",
                    "How many vibrations with all frames held, those of lowest frequency, add to the static shapes."),
          optional("highest_frequency", quantity("Hz", "5 kHz", Range::positive()),
                   "Vibrations above this frequency are left out.", "no limit"),
          defaulted("damping", damping, "{}", "Damping of the material."),
          optional("vtu_every", quantity("s", "1 ms", Range::positive()),
                   "Writes the deformed mesh at this interval beside the results file, for ParaView.", "not written"),
      });
}

}  // namespace hersey::model
