#include "hersey/fem/reduction.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "hersey/core/contract.h"
#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/contact_modes.h"
#include "hersey/fem/frame_motion.h"
#include "hersey/fem/vibration.h"
#include "reduction/frame_interface.h"
#include "reduction/static_error.h"

namespace hersey::fem {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double dependent = 1e-10;  // share of a vector's energy that is new; below, it lies in the others

/// Turns `V` (fixed-interface displacements) into a basis with M = I and diagonal K; dependent directions are dropped.
VectorXd orthonormalise(const ElasticBody& body, MatrixXd& V) {
  if (V.cols() == 0) return {};
  const MatrixXd K = V.transpose() * (body.K * V), M = V.transpose() * mass_times(body.m, V);
  const VectorXd scale = M.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> mass(MatrixXd(scale.asDiagonal() * M * scale.asDiagonal()));
  const VectorXd& d = mass.eigenvalues();
  const Index kept = (d.array() > dependent * d[d.size() - 1]).count();
  const MatrixXd T =
      scale.asDiagonal() * mass.eigenvectors().rightCols(kept) * d.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> stiffness(MatrixXd(T.transpose() * K * T));
  V = V * (T * stiffness.eigenvectors());
  return stiffness.eigenvalues().cwiseMax(0).cwiseSqrt();
}

/// Share of each load's strain energy that `modes` (M-orthonormal, with frequencies omega) miss; `exact` are its
/// displacements.
VectorXd energy_missed(const MatrixXd& loads, const MatrixXd& exact, const Vibration& modes) {
  VectorXd missed(loads.cols());
  for (Index k = 0; k < loads.cols(); ++k) {
    const double whole = loads.col(k).dot(exact.col(k));
    const VectorXd amplitude = (modes.shapes.transpose() * loads.col(k)).cwiseQuotient(modes.omega);
    missed[k] = whole > 0 ? std::max(0.0, 1 - amplitude.squaredNorm() / whole) : 0;
  }
  return missed;
}

/// All film modes side by side, (3 n, modes).
MatrixXd shapes_of(const std::vector<FilmModes>& films, Index dofs) {
  Index columns = 0;
  for (const FilmModes& film : films) columns += film.shapes.cols();
  MatrixXd shapes(dofs, columns);
  columns = 0;
  for (const FilmModes& film : films) {
    shapes.middleCols(columns, film.shapes.cols()) = film.shapes;
    columns += film.shapes.cols();
  }
  return shapes;
}

/// Stiffness and mass of the reduced body, (elastic.15).
void project(const ElasticBody& body, ReducedBody& reduced) {
  const MatrixXd K = reduced.Phi.transpose() * (body.K * reduced.Phi);
  const MatrixXd M = reduced.Phi.transpose() * mass_times(body.m, reduced.Phi);
  reduced.K = (K + K.transpose()) / 2;
  reduced.M = (M + M.transpose()) / 2;
  // Exactly known values are written exactly.
  const Index b = reduced.internal_first(), i = reduced.size() - b;
  reduced.K.topRightCorner(b, i).setZero();
  reduced.K.bottomLeftCorner(i, b).setZero();
  reduced.K.bottomRightCorner(i, i) = reduced.internal_omega.cwiseAbs2().asDiagonal();
  reduced.M.bottomRightCorner(i, i).setIdentity();
}

}  // namespace

FrameSupports frame_supports(const Mesh& mesh, const std::vector<InterfaceFrame>& frames) {
  Interface interface = interface_of(mesh, frames);
  return {std::move(interface.fixed_dofs), interface.C};
}

namespace {

// Frequencies this near to each other belong to one: their modes are mixed by round-off, not by the body.
constexpr double same_frequency = 1e-6;

/// The modes with all frames at rest. Where the last one wanted is one of several with the same frequency, all of these
/// are kept: which of their mixtures an iteration finds first is chance, and so would be the reduced body.
Vibration fixed_interface_modes(const ElasticBody& body, const Interface& interface, const ReductionOptions& options) {
  for (int wanted = options.modes + 1;; ++wanted) {
    Vibration found =
        natural_modes(body, interface.fixed_dofs, {.count = wanted, .highest = options.highest}, interface.C);
    const Eigen::Index count = found.omega.size();
    if (!found.solved() || count < wanted) return found;
    if (found.omega[count - 1] - found.omega[count - 2] < same_frequency * found.omega[count - 1]) continue;
    found.omega.conservativeResize(count - 1);
    found.shapes.conservativeResize(Eigen::NoChange, count - 1);
    return found;
  }
}

}  // namespace

Reduction reduce(const ElasticBody& body, const std::vector<InterfaceFrame>& frames, const ReductionOptions& options) {
  HERSEY_REQUIRE(options.loads.size() == 0 || options.loads.rows() == body.size(), "one force per degree of freedom");
  if (frames.empty()) return no_answer<Reduction>("a reduced body needs a frame that something attaches to");
  if (std::string fault = fault_of(body.mesh, frames); !fault.empty()) return no_answer<Reduction>(std::move(fault));
  const Interface interface = interface_of(body.mesh, frames);
  ConstrainedStiffness stiffness(body.K, body.m, interface.fixed_dofs, interface.C);
  if (const solver::FactorSummary summary = stiffness.factorise(); !summary.solved())
    return no_answer<Reduction>(summary.status == solver::FactorStatus::singular
                                    ? "a part of the body is not connected to the frames"
                                    : summary.message);
  MatrixXd internal(body.size(), 0);
  Vibration modes;
  modes.set_solved(true);
  modes.omega.resize(0);
  modes.shapes.resize(body.size(), 0);
  if (options.modes > 0 && stiffness.freedom() > 0) modes = fixed_interface_modes(body, interface, options);
  if (!modes.solved()) return no_answer<Reduction>(modes.message);
  const MatrixXd exact = options.loads.size() ? stiffness.solve(options.loads) : MatrixXd(body.size(), 0);
  const StaticShapes of_surfaces = static_shapes(stiffness, modes, options);
  std::vector<FilmModes> films;
  films.reserve(options.film_surfaces.size() + options.contact_faces.size());
  for (const FilmSurface& surface : options.film_surfaces)
    films.push_back(film_modes(stiffness, surface, surface.modes.value_or(options.film_modes), options.film_tolerance));
  for (const std::vector<ElementFace>& faces : options.contact_faces)
    films.push_back(contact_modes(stiffness, body.mesh, faces, options.film_modes, options.film_tolerance));
  const MatrixXd of_films = shapes_of(films, body.size());
  internal.resize(body.size(), modes.shapes.cols() + exact.cols() + of_surfaces.added.cols() + of_films.cols());
  internal << modes.shapes, exact, of_surfaces.added, of_films;

  Reduction reduction;
  reduction.set_solved(true);
  ReducedBody& reduced = reduction.body;
  reduced.frames = frames;
  reduced.nodes = body.mesh.nodes;
  reduced.m = body.m;
  reduced.mesh = body.mesh;
  reduced.materials = body.materials;
  reduced.static_errors = of_surfaces.errors;
  reduced.film_modes = std::move(films);
  reduced.energy_missed = energy_missed(options.loads, exact, modes);
  reduced.internal_omega = orthonormalise(body, internal);
  const MatrixXd boundary = constraint_modes(body, interface, stiffness);
  reduced.Phi.resize(body.size(), boundary.cols() + internal.cols());
  reduced.Phi << boundary, internal;
  project(body, reduced);
  return reduction;
}

}  // namespace hersey::fem
