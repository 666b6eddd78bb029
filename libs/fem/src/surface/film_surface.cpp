#include "hersey/fem/film_surface.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "hersey/core/contract.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/fem/load_distributions.h"
#include "surface/film_coordinates.h"
#include "surface/film_coverage.h"
#include "surface/film_quadrature.h"

namespace hersey::fem {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double may_be_missing = 0.02;   // of a film's area: an oil hole in the mesh
constexpr double least_condition = 1e-4;  // reciprocal, of G: splines on a whole cylinder have 1e-3

double millimetres(double length) { return 1e3 * length; }

/// Division of a face's edges: pieces of at most a third of the distance between functions.
int parts_of(const Mesh& mesh, const std::vector<ElementFace>& faces, const FilmCylinder& cylinder,
             const SurfaceFunctions& functions) {
  const Pose to_cylinder = cylinder.X.inverse();
  const int intervals = std::max(1, functions.along() - 3);
  const double per_angle =
      cylinder.arc ? (functions.around() - 3) / cylinder.arc->over : functions.around() / (2 * std::numbers::pi);
  double most = 0;
  for (const ElementFace face : faces) {
    const CylinderBox box = cylinder_box(mesh, face, to_cylinder);
    most = std::max(
        {most, (box.phi_high - box.phi_low) * per_angle,
         (std::min(box.z_high, cylinder.L / 2) - std::max(box.z_low, -cylinder.L / 2)) * intervals / cylinder.L});
  }
  return std::clamp(static_cast<int>(std::ceil(3 * most)), 2, 12);
}

FilmSurfaceResult refused(std::string message, std::string remedy) {
  auto result = no_answer<FilmSurfaceResult>(std::move(message));
  result.remedy = std::move(remedy);
  return result;
}

/// The radius nearest to the cylinder's at which the mesh has outer nodes in the film's width.
std::optional<double> nearest_radius(const Mesh& mesh, const FilmCylinder& cylinder) {
  const Pose to_cylinder = cylinder.X.inverse();
  std::optional<double> nearest;
  for (const int node : nodes_on(mesh, outer_faces(mesh))) {
    const CylinderPoint point = cylinder_point(to_cylinder * mesh.nodes[static_cast<std::size_t>(node)]);
    if (std::abs(point.z) > cylinder.L / 2) continue;
    if (!nearest || std::abs(point.radius - cylinder.R) < std::abs(*nearest - cylinder.R)) nearest = point.radius;
  }
  return nearest;
}

FilmSurfaceResult no_faces(const Mesh& mesh, const FilmCylinder& cylinder) {
  const std::optional<double> nearest = nearest_radius(mesh, cylinder);
  const std::string where = fmt::format("no face of the mesh on the film's surface (radius {:.4g} mm, width {:.4g} mm)",
                                        millimetres(cylinder.R), millimetres(cylinder.L));
  if (!nearest)
    return refused(where + "; the mesh has no surface at all across the film's width",
                   "check where the bearing's frame stands in the mesh, and that its z-axis is the bearing's");
  return refused(where + fmt::format("; the nearest nodes have a radius of {:.4g} mm", millimetres(*nearest)),
                 "check the frame's position and axis, the bearing's diameter and the mesh's length unit, or allow for "
                 "a larger distance");
}

/// Returns the radius of the largest deviation; none if all nodes are within the tolerance.
std::optional<double> off_radius(const Mesh& mesh, const std::vector<ElementFace>& faces, const FilmCylinder& cylinder,
                                 double tolerance) {
  const Pose to_cylinder = cylinder.X.inverse();
  double worst = cylinder.R;
  for (const int node : nodes_on(mesh, faces)) {
    const double radius = cylinder_point(to_cylinder * mesh.nodes[static_cast<std::size_t>(node)]).radius;
    if (std::abs(radius - cylinder.R) > std::abs(worst - cylinder.R)) worst = radius;
  }
  if (std::abs(worst - cylinder.R) <= tolerance) return std::nullopt;
  return worst;
}

/// A thousand times the radius, or a thousandth, is that of millimetres read as metres, or the other way round.
FilmSurfaceResult refused_radius(double worst, const FilmCylinder& cylinder) {
  constexpr double near = 0.1;
  const auto is_near = [&](double factor) { return std::abs(worst / (factor * cylinder.R) - 1) < near; };
  const std::string unit = is_near(1e3)    ? "is the mesh in millimetres? then give its length unit, mm"
                           : is_near(1e-3) ? "is the mesh in metres? then give its length unit, m"
                                           : "check the frame's position and axis and the bearing's diameter";
  return refused(fmt::format("a surface with nodes at a radius of {:.5g} mm, {:.3g} mm off the film's {:.5g} mm",
                             millimetres(worst), millimetres(std::abs(worst - cylinder.R)), millimetres(cylinder.R)),
                 unit);
}

/// Returns the position of a face whose normal has the wrong direction; none if all are right.
std::optional<CylinderPoint> wrong_face(const Mesh& mesh, const std::vector<ElementFace>& faces,
                                        const FilmCylinder& cylinder) {
  for (const ElementFace face : faces) {
    double area = 0;
    std::optional<CylinderPoint> at;
    visit_film_points(mesh, face, cylinder, 1, [&](const FilmPoint& point) {
      area += cylinder.is_bore ? -point.area : point.area;
      at = CylinderPoint{point.phi, point.z, cylinder.R};
    });
    if (area < 0) return at;
  }
  return std::nullopt;
}

/// Fills T and G.
void integrate(const Mesh& mesh, int parts, FilmSurface& surface) {
  const std::vector<int> nodes = nodes_on(mesh, surface.faces);
  std::vector<Index> index(mesh.nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) index[static_cast<std::size_t>(nodes[i])] = static_cast<Index>(i);
  const Index count = surface.functions.count();
  MatrixXd T = MatrixXd::Zero(3 * static_cast<Index>(nodes.size()), count);
  surface.G = MatrixXd::Zero(count, count);
  std::vector<SurfaceTerm> terms;
  for (const ElementFace face : surface.faces)
    visit_film_points(mesh, face, surface.cylinder, parts, [&](const FilmPoint& point) {
      surface.functions.at(point.phi, point.z, terms);
      const double area = std::abs(point.area);
      for (const SurfaceTerm& term : terms) {
        for (std::size_t a = 0; a < point.nodes.size(); ++a)
          T.block<3, 1>(3 * index[static_cast<std::size_t>(point.nodes[a])], term.index) +=
              area * term.value * point.N[static_cast<Index>(a)] * point.outward;
        for (const SurfaceTerm& other : terms) surface.G(other.index, term.index) += area * term.value * other.value;
      }
    });
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>((T.array() != 0).count()));
  for (Index j = 0; j < count; ++j)
    for (Index i = 0; i < T.rows(); ++i)
      if (T(i, j) != 0)
        entries.emplace_back(static_cast<int>(3 * nodes[static_cast<std::size_t>(i / 3)] + i % 3), static_cast<int>(j),
                             T(i, j));
  surface.T.resize(3 * static_cast<Index>(mesh.nodes.size()), count);
  surface.T.setFromTriplets(entries.begin(), entries.end());
}

}  // namespace

MatrixXd coefficients_from_frame(const FilmSurface& surface, const Mesh& mesh, const MatrixXd& U, const Vector3& origin,
                                 Index first) {
  HERSEY_REQUIRE(first >= 0 && first + 6 <= U.cols(), "a frame has six unit motions");
  MatrixXd D = surface.coefficients(U);
  D.middleCols<6>(first) -= surface.coefficients(rigid_motions(mesh, origin));
  return D;
}

FilmSurfaceResult film_surface(const Mesh& mesh, const std::vector<ElementFace>& faces, const FilmCylinder& cylinder,
                               const SurfaceFunctions& functions, double tolerance) {
  HERSEY_REQUIRE(cylinder.R > 0 && cylinder.L > 0, "a film lies on a cylinder");
  FilmSurface surface{{}, cylinder, functions, faces};
  const Pose to_cylinder = cylinder.X.inverse();
  std::erase_if(surface.faces,
                [&](ElementFace face) { return !reaches_into(cylinder_box(mesh, face, to_cylinder), cylinder); });
  if (surface.faces.empty()) return no_faces(mesh, cylinder);
  if (const std::optional<double> worst = off_radius(mesh, surface.faces, cylinder, tolerance))
    return refused_radius(*worst, cylinder);
  if (const auto at = wrong_face(mesh, surface.faces, cylinder))
    return refused(
        fmt::format("a face at {:.0f} deg, z = {:.3g} mm that looks {} the axis", at->phi * 180 / std::numbers::pi,
                    millimetres(at->z), cylinder.is_bore ? "away from" : "towards"),
        cylinder.is_bore ? "a shell is a bore, with the solid around the film; a shaft is the journal"
                         : "a journal is a shaft, with the solid within the film; a bore is the shell");
  const int parts = parts_of(mesh, surface.faces, cylinder, functions);
  if (const FilmCover cover = film_cover(mesh, surface.faces, cylinder, parts); cover.missing > may_be_missing)
    return refused(cover.text(), "make the bearing's width that of the surface, or take in all of its faces");
  integrate(mesh, parts, surface);
  if (const Eigen::LLT<MatrixXd> factor(surface.G); !(factor.rcond() > least_condition))
    return refused(fmt::format("{} functions around and {} along are finer than the surface", functions.around(),
                               functions.along()),
                   "take fewer");
  FilmSurfaceResult result;
  result.surface = std::move(surface);
  result.set_solved(true);
  return result;
}

}  // namespace hersey::fem
