#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "hersey/fem/mesh.h"
#include "hersey/fem/solid_material.h"

/// Files of a mesh with pressures on its faces at instants, for strength programs.
namespace hersey::fem {

/// Pressures on faces at one instant.
struct LoadInstant {
  double time = 0;            ///< [s]
  std::string name;           ///< shown as a comment or a subcase's label
  Eigen::VectorXd pressures;  ///< against the faces' outward normals, shape (faces) [Pa]
};

/// A body with its loads.
struct LoadedBody {
  std::string name;  ///< of the body, and of its files
  const Mesh& mesh;
  const std::vector<SolidMaterial>& materials;            ///< by Element::material; an element without takes the first
  std::vector<int> fixed_dofs;                            ///< degrees of freedom 3 a + i that do not move
  std::map<std::string, std::vector<ElementFace>> films;  ///< named surfaces to be added to those of the mesh
  std::vector<ElementFace> faces;                         ///< that carry pressure
  std::vector<LoadInstant> instants;                      ///< by rising time
};

/// Consistent units of a file.
enum class FileUnits {
  si,          ///< m, N, kg, s, Pa
  millimetres  ///< mm, N, t, s, MPa
};

/// Writes for CalculiX (PrePoMax, FreeCAD; Abaqus reads the same): `<name>_mesh.inp` with nodes, elements, sets and
/// materials; `<name>_steps.inp`, a static step with `*DLOAD` for each instant; `<name>_history.inp`, one step over all
/// of the time with an `*AMPLITUDE` for each face.
/// @throws std::runtime_error naming a file that cannot be written, or what CalculiX has not got
/// (pyramids). @see Dhondt, CalculiX CrunchiX USER'S MANUAL. @verified_by load_file_test.cpp
void write_calculix_loads(const std::filesystem::path& folder, const LoadedBody& body, FileUnits units);

/// Writes `<name>.bdf`, Nastran bulk data in large fields: a linear static solution (SOL 101) with a subcase of
/// `PLOAD4` for each instant. @throws as write_calculix_loads. @verified_by load_file_test.cpp
void write_nastran_loads(const std::filesystem::path& folder, const LoadedBody& body, FileUnits units);

}  // namespace hersey::fem
