#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hersey/fem/heat_conduction.h"
#include "hersey/fem/mesh.h"
#include "hersey/fem/solid_material.h"
#include "hersey/fem/thermal_material.h"

/// Files of a mesh with pressures on its faces at instants, for strength programs.
namespace hersey::fem {

/// Pressures on faces at one instant.
struct LoadInstant {
  double time = 0;            ///< [s]
  std::string name;           ///< shown as a comment or a subcase's label
  Eigen::VectorXd pressures;  ///< against the faces' outward normals, shape (faces) [Pa]
};

/// Steady temperatures of a body, and what causes them.
struct BodyTemperatures {
  ThermalMaterial material;          ///< of all elements; expansion 0: they strain nothing
  double T_reference = 293.15;       ///< at which the body has the shape of its mesh [K]
  std::map<int, double> prescribed;  ///< temperatures of nodes: of the films' surfaces, and others [K]
  std::vector<CooledFaces> cooled;   ///< a face in several of them is cooled by all
  Eigen::VectorXd T;                 ///< of all nodes, shape (nodes) [K]
  std::string source;                ///< of the prescribed temperatures, for the files' comments
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
  std::optional<BodyTemperatures> heat = {};              ///< unset: the body is as warm as its mesh
};

/// Consistent units of a file.
enum class FileUnits {
  si,          ///< m, N, kg, s, Pa
  millimetres  ///< mm, N, t, s, MPa
};

/// Writes for CalculiX (PrePoMax, FreeCAD; Abaqus reads the same): `<name>_mesh.inp` with nodes, elements, sets and
/// materials; `<name>_steps.inp`, a static step with `*DLOAD` for each instant; `<name>_history.inp`, one step over all
/// of the time with an `*AMPLITUDE` for each face. Of a body with temperatures, too: `<name>_heat.inp`, a step of
/// `*HEAT TRANSFER, STEADY STATE` with what causes them, and `<name>_temperatures.inp`, the temperatures themselves,
/// which the other steps include where the body expands.
/// @throws std::runtime_error naming a file that cannot be written, or what CalculiX has not got
/// (pyramids). @see Dhondt, CalculiX CrunchiX USER'S MANUAL. @verified_by load_file_test.cpp
void write_calculix_loads(const std::filesystem::path& folder, const LoadedBody& body, FileUnits units);

/// Writes `<name>.bdf`, Nastran bulk data in large fields: a linear static solution (SOL 101) with a subcase of
/// `PLOAD4` for each instant, and with `TEMP` of all nodes for a body that is warm and expands. Of a body with
/// temperatures `<name>_heat.bdf`, too: a solution for steady heat (SOL 153) with what causes them.
/// @throws as write_calculix_loads. @verified_by load_file_test.cpp
void write_nastran_loads(const std::filesystem::path& folder, const LoadedBody& body, FileUnits units);

}  // namespace hersey::fem
