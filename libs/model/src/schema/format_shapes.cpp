#include "schema/format.h"

// Shapes of bodies: what the report draws and what contacts refer to.
namespace hersey::model {

TypePtr shapes_format() {
  const TypePtr size = quantity("m", "20 mm", Range::positive());
  const TypePtr position = vector("m", "0 140 0 mm");
  const std::vector<Key> line = {defaulted("from", position, "0 0 0 m", "Centre of one end, body axes."),
                                 required("to", position, "Centre of the other end."),
                                 required("diameter", size, "Its diameter.")};
  const TypePtr rotation =
      object("an axis and an angle",
             {
                 required("axis", axis_format(), "Direction: x, y, z or three numbers, whose length does not matter."),
                 required("angle", quantity("rad", "90 deg"), "Right-handed about the axis."),
             });
  return named(
      "a mapping from names to shapes",
      variant("a shape", "shape", {},
              {
                  {"sphere",
                   "a ball",
                   {defaulted("centre", position, "0 0 0 m", "From the body's origin, body axes."),
                    required("diameter", size, "Its diameter.")}},
                  {"cylinder", "a solid cylinder with flat ends", line},
                  {"capsule", "a cylinder with round ends, which reach half the diameter further", line},
                  {"box",
                   "a block",
                   {defaulted("centre", position, "0 0 0 m", "From the body's origin, body axes."),
                    required("size", vector("m", "20 40 10 mm"), "Its edges."),
                    optional("rotation", rotation, "Rotates the edges from the body's axes.", "none")}},
                  {"half_space",
                   "everything behind a plane",
                   {defaulted("point", position, "0 0 0 m", "A point of the plane."),
                    required("normal", axis_format(),
                             "Points out of it: x, y, z or three numbers, whose length does not matter.")}},
                  {"faces",
                   "faces of a flexible body's mesh, which deform with it: for contacts",
                   {required("of", text("a surface or a set of nodes", "pad"), "Their name in the mesh.")}},
                  {"mesh",
                   "a triangulated surface",
                   {required("file", text("a file", "rod.stl"),
                             "Beside the model file: STL, text or binary, or a mesh of solids (.msh, .inp, .bdf), "
                             "whose outer surface is taken."),
                    defaulted("unit", quantity("m", "1 mm", Range::positive()), "1 mm", "What a length of 1 means."),
                    defaulted("origin", position, "0 0 0 m", "Where the file's origin lies in the body.")}},
              }));
}

}  // namespace hersey::model
