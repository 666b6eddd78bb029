#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "hersey/fem/contact_modes.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/fem/film_surface.h"

namespace hersey::fem {

/// How a frame is tied to its nodes.
enum class Connection {
  rigid,   ///< the nodes follow the frame: nothing strains among them
  average  ///< the frame follows the nodes' mean displacement and rotation, its wrench is spread over them
};

/// A frame that joints and forces attach to, axes parallel to the mesh's.
struct InterfaceFrame {
  std::string name;
  Vector3 origin = Vector3::Zero();  ///< in the mesh's axes [m]
  std::vector<int> nodes;            ///< places in the mesh
  Connection connection = Connection::rigid;
  std::vector<double> weights;  ///< of the nodes, for `average`; empty: all the same. See `face_weights`.
};

/// The share of each of `nodes` in the area of the faces whose nodes are all among them; empty if there is no such
/// face.
[[nodiscard]] std::vector<double> face_weights(const Mesh& mesh, const std::vector<int>& nodes);

/// An `average` frame on one node, or on nodes of one line, with the other nodes of the elements around them: these
/// turn the frame, but count for little where it is, so that it stays with the nodes it was given. Any other frame as
/// it is.
[[nodiscard]] InterfaceFrame braced(const Mesh& mesh, InterfaceFrame frame);

/// The centre of the faces whose nodes are all among `nodes`: of a bore a point on its axis, however it is meshed. The
/// mean of the nodes if there is no such face.
[[nodiscard]] Vector3 face_centre(const Mesh& mesh, const std::vector<int>& nodes);

/// (6, 3 n): small rotation and displacement of `frame`, [theta; d], that the displacements of its nodes mean,
/// (elastic.13); its transpose spreads a wrench [tau; f] over the nodes.
[[nodiscard]] Eigen::SparseMatrix<double> frame_motion(const Mesh& mesh, const InterfaceFrame& frame);

/// What keeps a mesh still while no frame moves: degrees of freedom that rigid frames hold, and constraints C u = 0 of
/// the averages, (6 average frames, 3 n).
struct FrameSupports {
  std::vector<int> held;
  Eigen::SparseMatrix<double> C;
};
/// Of these frames on this mesh.
[[nodiscard]] FrameSupports frame_supports(const Mesh& mesh, const std::vector<InterfaceFrame>& frames);

/// A surface that carries loads, and shapes of pressure on it.
struct LoadedSurface {
  std::string name;
  Eigen::MatrixXd loads;      ///< nodal forces (3 n, shapes)
  std::vector<int> nodes;     ///< of the surface, places in the mesh
  std::vector<double> areas;  ///< that each node stands for
};

/// Pressures on the surface or node set `name` of `mesh`: around a bore those of bore_pressures with `harmonics`, on
/// any other face 1 and what grows along it. @pre the mesh has faces of that name: see faces_called
[[nodiscard]] LoadedSurface loaded_surface(const Mesh& mesh, const std::string& name, int harmonics);

/// The axis of a bore whose normals are those of `faces`, as the z-axis of a pose; none if they are no part of one.
[[nodiscard]] std::optional<Pose> bore_of(const Mesh& mesh, const std::vector<ElementFace>& faces);

struct ReductionOptions {
  int modes = 20;                                            ///< fixed-interface modes at most
  double highest = std::numeric_limits<double>::infinity();  ///< up to this angular frequency [rad/s]
  /// Nodal forces (3 n, loads) whose static displacement the reduced body shall have exactly: one mode more for each.
  Eigen::MatrixXd loads;
  std::vector<LoadedSurface> surfaces;
  /// Largest error of the static displacement of a surface under each of its pressures, all frames at rest, over the
  /// largest of these displacements: static shapes are added until it holds. Infinity: the error is told alone.
  double static_error = std::numeric_limits<double>::infinity();
  std::vector<FilmSurface> film_surfaces;               ///< that oil films press on: their film modes are added
  std::vector<std::vector<ElementFace>> contact_faces;  ///< that touch other bodies: likewise, with contact_modes
  int film_modes = 60;                                  ///< of each of them at most that does not say so itself
  double film_tolerance = 1e-6;                         ///< smallest compliance of a film mode, over the largest
};

/// How well a reduced body meets the static displacement of a surface, all frames at rest, (elastic.16).
struct StaticError {
  std::string surface;
  int shapes = 0;      ///< pressures looked at
  double modes = 0;    ///< largest error of the fixed-interface modes alone, over the largest displacement
  double reduced = 0;  ///< of the reduced body
};

/// An elastic body in few coordinates: u = Phi q, (elastic.14).
///
/// q holds six coordinates [theta; d] for each frame, in turn, then the internal ones. Coordinates of frames are
/// displacements from the undeformed body, in the mesh's axes; a rigid motion of all frames is one of the whole body,
/// exactly.
struct ReducedBody {
  std::vector<InterfaceFrame> frames;
  std::vector<Vector3> nodes;      ///< of the mesh, undeformed [m]
  Eigen::SparseMatrix<double> m;   ///< consistent mass of the mesh, M = m (x) I3 [kg]
  Eigen::MatrixXd Phi;             ///< (3 n, r)
  Eigen::MatrixXd K;               ///< (r, r); between frames and internal coordinates zero
  Eigen::MatrixXd M;               ///< (r, r); internal coordinates have the unit matrix
  Eigen::VectorXd internal_omega;  ///< of the internal coordinates alone, all frames at rest, ascending [rad/s]
  /// For each load of the options: the share of its static strain energy, all frames at rest, that the fixed-interface
  /// modes alone would miss. Near 1: that many modes say nothing about this load.
  Eigen::VectorXd energy_missed;

  std::vector<StaticError> static_errors;  ///< of the surfaces of the options
  std::vector<FilmModes> film_modes;       ///< of film surfaces, then of contact faces; files do not keep them
  /// Elements, sets and surfaces, as far as they are known; its nodes are `nodes`.
  Mesh mesh;
  std::vector<SolidMaterial> materials;  ///< of the elements; none: unknown

  /// Coordinates, r.
  [[nodiscard]] Eigen::Index size() const { return Phi.cols(); }
  /// Place of the first internal coordinate in q.
  [[nodiscard]] Eigen::Index internal_first() const { return 6 * static_cast<Eigen::Index>(frames.size()); }
};

struct Reduction {
  bool ok = false;
  std::string message;  ///< why not, naming the frame where one is to blame
  ReducedBody body;
};

/// Craig-Bampton reduction: static displacements for unit motions of each frame, fixed-interface modes, static
/// displacements for loads and film modes, all but the first orthonormalised together. Costs two factorisations, and
/// one solution per column of Phi.
/// @see Craig, Bampton (1968), AIAA J. 6, 1313; Cardona (2000) for `average`. @verified_by reduction_test.cpp
[[nodiscard]] Reduction reduce(const ElasticBody& body, const std::vector<InterfaceFrame>& frames,
                               const ReductionOptions& options = {});

/// Pressures of 1 Pa on a bore, as nodal forces: P_l(z/h) cos(k phi) and P_l(z/h) sin(k phi), k = 0..harmonics, l =
/// 0..axial; phi about the z-axis of `X`, z/h from -1 to 1 over the faces. (3 n, (2 harmonics + 1)(axial + 1)), axial
/// <= 2
[[nodiscard]] Eigen::MatrixXd bore_pressures(const Mesh& mesh, const std::vector<ElementFace>& faces, const Pose& X,
                                             int harmonics, int axial = 1);

}  // namespace hersey::fem
