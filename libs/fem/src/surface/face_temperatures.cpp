#include "hersey/fem/face_temperatures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "hersey/core/contract.h"
#include "hersey/fem/load_distributions.h"
#include "hersey/fem/skin.h"
#include "surface/film_quadrature.h"

namespace hersey::fem {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int pieces_for_temperatures = 4;  // along each edge of a face, as for pressures: the film's grid may be finer

/// The cylinder without ends: all of a face counts.
FilmCylinder unbounded(FilmCylinder cylinder) {
  cylinder.L = std::numeric_limits<double>::infinity(), cylinder.arc.reset();
  return cylinder;
}

}  // namespace

FaceTemperatures::FaceTemperatures(const Mesh& mesh, const std::vector<ElementFace>& faces,
                                   const FilmCylinder& cylinder)
    : mesh_(mesh), faces_(faces), cylinder_(unbounded(cylinder)), nodes_(nodes_on(mesh, faces)) {
  const auto count = static_cast<Index>(nodes_.size());
  areas_.setZero(count);
  std::vector<Eigen::Triplet<double>> entries;
  for (const ElementFace& face : faces_) {
    const std::vector<int> nodes = nodes_of(mesh_, face);
    const auto n = static_cast<Index>(nodes.size());
    Eigen::MatrixXd of_face = Eigen::MatrixXd::Zero(n, n);
    visit_film_points(mesh_, face, cylinder_, pieces_for_temperatures, [&](const FilmPoint& point) {
      of_face += std::abs(point.area) * point.N.head(n) * point.N.head(n).transpose();
    });
    for (Index a = 0; a < n; ++a)
      for (Index b = 0; b < n; ++b) {
        const Index row = index_of(nodes[static_cast<std::size_t>(a)]),
                    column = index_of(nodes[static_cast<std::size_t>(b)]);
        areas_[row] += of_face(a, b);  // the functions N_b add up to 1
        if (row >= column) entries.emplace_back(row, column, of_face(a, b));
      }
  }
  Eigen::SparseMatrix<double> M(count, count);
  M.setFromTriplets(entries.begin(), entries.end());
  factor_.analyse(M);
  if (const solver::FactorSummary summary = factor_.factorise(M); !summary.solved())
    throw std::runtime_error("temperatures of a film's faces: " + summary.message);
}

Index FaceTemperatures::index_of(int node) const {
  return std::lower_bound(nodes_.begin(), nodes_.end(), node) - nodes_.begin();
}

VectorXd FaceTemperatures::of(const FilmField& field, double mean_of_film) const {
  // Differences from the mean are interpolated, so that a uniform temperature is met to the last bit.
  VectorXd T = VectorXd::Zero(areas_.size());
  for (const ElementFace& face : faces_)
    visit_film_points(mesh_, face, cylinder_, pieces_for_temperatures, [&](const FilmPoint& point) {
      const double rise = std::abs(point.area) * (field(point.phi, point.z) - mean_of_film);
      for (std::size_t a = 0; a < point.nodes.size(); ++a)
        T[index_of(point.nodes[a])] += point.N[static_cast<Index>(a)] * rise;
    });
  factor_.solve(T);                           // (film-surface.13)
  return T.array() + mean_of_film - mean(T);  // (film-surface.14)
}

double FaceTemperatures::mean(const VectorXd& nodal) const {
  HERSEY_REQUIRE(nodal.size() == areas_.size(), "a temperature for each node");
  return areas_.dot(nodal) / areas_.sum();
}

}  // namespace hersey::fem
