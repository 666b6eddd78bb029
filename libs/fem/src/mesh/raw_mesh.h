#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Label that stands for a mid-side node that an element omits.
inline constexpr long kLeftOut = std::numeric_limits<long>::min() / 2;

/// Location in the mesh file, or in a file it includes.
struct FileLocation {
  int file = 0;  ///< index in RawMesh::files
  int line = 0;
};

/// The labels first, first + step, ... up to last.
struct LabelRange {
  long first = 0;
  long last = 0;
  long step = 1;
};

/// Members of a named set: labels, and other sets whole.
struct RawSet {
  FileLocation location;
  std::vector<LabelRange> labels;
  std::vector<std::string> sets;
  bool is_of_either_kind =
      false;  ///< its labels may be of nodes or of elements: those that do not exist are no mistake
};

struct RawElement {
  ElementType type = ElementType::tet4;
  long label = 0;
  FileLocation location;
  std::size_t first = 0;           ///< index of its first node's label in RawMesh::connectivity
  int material = -1;               ///< index in RawMesh::materials
  bool continues_another = false;  ///< a further piece of the element before it, with the same label
};

/// An element of surface, line or point shape: it marks the nodes, and of a surface the faces, that its sets name.
struct RawMark {
  long label = 0;
  FileLocation location;
  std::array<long, 9> nodes{};  ///< corners first
  int node_count = 0;
  int corner_count = 0;
};

/// Part of a surface given by elements: of one element or one element set a face, or all faces that lie outside.
struct RawSurfacePart {
  FileLocation location;
  long element = 0;         ///< 0 with a set's name
  std::string element_set;  ///< empty with an element's label
  int face = -1;            ///< -1: those that lie outside
};

/// A section of the file: the elements of a set are of a material, both by their names.
struct RawSection {
  FileLocation location;
  std::string element_set, material;
  bool may_be_unused = false;  ///< no mistake where no element belongs to it
};

/// A term of a tie: the displacement of a node, or its rotation, times a vector in the basic axes that holds the
/// coefficient.
struct RawTieTerm {
  long node = 0;
  bool is_rotation = false;
  Vector3 factor = Vector3::Zero();
};

/// A linear equation between displacements and rotations, the sum of its terms being zero. Rotations, and nodes of no
/// element, are eliminated.
struct RawTie {
  FileLocation location;
  std::vector<RawTieTerm> terms;
};

/// Nodes of one surface or set that move as the faces of another surface do.
struct RawSurfaceTie {
  FileLocation location;
  std::string slave, master;
  std::optional<double> tolerance;  ///< largest distance, in the file's length
  bool adjusts = true;              ///< puts the nodes on the faces
};

/// Nodes that move as one rigid body.
struct RawRigidBody {
  FileLocation location;
  std::string node_set, element_set;  ///< one of them, or both
  std::optional<long> reference;      ///< a node that moves with them
};

/// An equation whose terms are of nodes, or of all nodes of sets, one after the other.
struct RawEquation {
  struct Term {
    long node = 0;
    std::string set;    ///< empty: of `node`
    int component = 0;  ///< 0 to 5: along the axes, about them
    double coefficient = 0;
  };
  FileLocation location;
  std::vector<Term> terms;
};

/// Content of a mesh file, by the file's labels and in the file's units; `finished` makes a Mesh of it.
struct RawMesh {
  std::vector<std::string> files;
  std::vector<Vector3> nodes;
  std::vector<long> node_labels;
  std::vector<FileLocation> node_locations;
  std::vector<RawElement> elements;
  std::vector<long> connectivity;
  std::vector<RawMark> marks;  ///< their labels are those of no element; element sets may hold them
  std::vector<MeshMaterial> materials;
  std::vector<FileLocation> material_locations;
  std::map<std::string, RawSet> node_sets, element_sets;
  std::map<std::string, std::vector<RawSurfacePart>> surfaces;
  std::vector<RawSection> sections;
  std::vector<RawTie> ties;
  std::vector<RawEquation> equations;
  std::vector<RawSurfaceTie> surface_ties;
  std::vector<RawRigidBody> rigid_bodies;
  std::map<int, Fault>
      unsound_materials;  ///< by index: reason why the material cannot be used, reported where it is needed
  std::vector<std::string> transformed_sets;  ///< sets whose nodes have displacements in axes of their own
  std::vector<Fault> warnings;
  std::vector<Fault> material_faults;  ///< why elements have no material, or more than one

  void add_node(long label, const Vector3& r, FileLocation location);
  /// @param nodes labels in Abaqus' order
  void add_element(ElementType type, long label, std::span<const long> nodes, FileLocation location);
  /// @param nodes labels, corners first
  void add_mark(long label, std::span<const long> nodes, int corner_count, FileLocation location);
  /// Adds a tie: the displacement along `direction` of the node at `r`, or its rotation about it, equals that of a
  /// rigid body whose reference is the node `body` at `origin`.
  void add_rigid_tie(long node, const Vector3& r, long body, const Vector3& origin, const Vector3& direction,
                     bool of_rotation, FileLocation location);
  /// A label for a reference that no file has.
  [[nodiscard]] long new_reference();
  /// @throws InputError where there is one of that name already
  MeshMaterial& add_material(const std::string& name, FileLocation location);
  [[nodiscard]] Fault fault(FileLocation location, std::string found, std::string expected,
                            std::string suggestion = {}) const;
  void warn(FileLocation location, std::string found, std::string expected, std::string suggestion = {});
  /// Throws InputError for a location.
  [[noreturn]] void fail(FileLocation location, std::string found, std::string expected,
                         std::string suggestion = {}) const;

 private:
  long references_ = 0;
};

/// Resolves labels, puts in mid-side nodes that are left out, drops nodes that no element uses, ties, matches surfaces
/// with faces, gives elements the materials of their sections, scales to metres and SI.
/// @throws InputError for nodes that are missing or given twice, elements given twice, a file without elements.
[[nodiscard]] Mesh finished(RawMesh& raw, double length_unit);

}  // namespace hersey::fem
