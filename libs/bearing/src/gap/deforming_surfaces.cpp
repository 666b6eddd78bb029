#include "gap/deforming_surfaces.h"

#include <limits>
#include <utility>

namespace hersey::bearing {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

DeformingSurfaces::DeformingSurfaces(const film::FilmModel& model, std::shared_ptr<const ElasticSurface> shell,
                                     std::shared_ptr<const ElasticSurface> journal)
    : grid_(model.grid),
      L_(model.L),
      shell_(std::move(shell)),
      journal_(std::move(journal)),
      turned_(std::numeric_limits<double>::quiet_NaN()) {
  const Index n = grid_.size(), count = shell_count() + (journal_ ? journal_->D.cols() : 0);
  openings_ = MatrixXd::Zero(n, count);
  if (count == 0) return;
  directions_.resize(2 * static_cast<std::size_t>(count));
  if (shell_) openings_.leftCols(shell_count()) = at_nodes(shell_->functions, 0)[0] * shell_->D;
  if (journal_) turn_journal(0);
  for (Index a = 0; a < count; ++a) {
    directions_[static_cast<std::size_t>(a)].g = openings_.col(a);
    directions_[static_cast<std::size_t>(a)].shell_fraction = a < shell_count() ? 1 : 0;
    directions_[static_cast<std::size_t>(count + a)].g_rate = openings_.col(a);
  }
}

std::array<DeformingSurfaces::Functions, 3> DeformingSurfaces::at_nodes(const SurfaceFunctions& functions,
                                                                        double phi) const {
  std::array<std::vector<Eigen::Triplet<double>>, 3> entries;
  std::vector<SurfaceTerm> terms;
  for (int k = 0; k < grid_.size(); ++k) {
    functions.at(grid_.phi(k / grid_.n_z) - phi, L_ * grid_.z_over_L(k % grid_.n_z), terms);
    for (const SurfaceTerm& term : terms) {
      entries[0].emplace_back(k, term.index, term.value);
      entries[1].emplace_back(k, term.index, term.by_phi);
      entries[2].emplace_back(k, term.index, term.by_phi_phi);
    }
  }
  std::array<Functions, 3> fields;
  for (std::size_t i = 0; i < 3; ++i) {
    fields[i].resize(grid_.size(), functions.count());
    fields[i].setFromTriplets(entries[i].begin(), entries[i].end());
  }
  return fields;
}

/// Over the grid the journal's displacement is psi(phi - turned) D s.
void DeformingSurfaces::turn_journal(double phi) {
  if (phi == turned_) return;
  turned_ = phi;
  const std::array<Functions, 3> fields = at_nodes(journal_->functions, phi);
  openings_.rightCols(journal_->D.cols()) = -(fields[0] * journal_->D);
  slopes_ = fields[1] * journal_->D;
  curvatures_ = -(fields[2] * journal_->D);
}

void DeformingSurfaces::add_displacements(const VectorXd& s, const VectorXd& s_rate,
                                          const GapKinematics::Turning& turning, film::SurfaceMotion& motion) {
  if (!deform()) return;
  const double omega = turning.speed;
  if (journal_) turn_journal(turning.angle);
  motion.g.noalias() += openings_ * s;
  if (motion.shell_opening.size() == 0) motion.shell_opening.setZero(motion.g.size());
  motion.shell_opening.noalias() += openings_.leftCols(shell_count()) * s.head(shell_count());
  motion.g_rate.noalias() += openings_ * s_rate;
  if (!journal_) return;
  const Index count = journal_->D.cols(), first = shell_count();
  const auto s_j = s.tail(count), rate_j = s_rate.tail(count);
  by_angle_.noalias() = slopes_ * s_j;
  motion.g_rate += omega * by_angle_;
  rate_by_angle_.noalias() = slopes_ * rate_j;
  rate_by_angle_.noalias() += omega * (curvatures_ * s_j);
  for (Index a = 0; a < count; ++a) {
    film::MotionDirection& position = directions_[static_cast<std::size_t>(first + a)];
    position.g = openings_.col(first + a);
    position.g_rate = omega * slopes_.col(a);
    directions_[static_cast<std::size_t>(amplitudes() + first + a)].g_rate = openings_.col(first + a);
  }
}

void DeformingSurfaces::add_turning(const GapKinematics::Turning& turning,
                                    std::vector<film::MotionDirection>& of_parameters) const {
  if (!journal_) return;
  film::MotionDirection &angle = of_parameters[static_cast<std::size_t>(turning.of_angle)],
                        &speed = of_parameters[static_cast<std::size_t>(turning.of_speed)];
  add_field(by_angle_, angle.g);
  add_field(rate_by_angle_, angle.g_rate);
  add_field(by_angle_ / turning.radius, speed.g_rate);
}

void DeformingSurfaces::add_turning_forces(const GapKinematics::Turning& turning, const VectorXd& normal_forces,
                                           MatrixXd& Q_by_s) const {
  if (!journal_) return;
  const Index first = Q_by_s.rows() - slopes_.cols();
  for (Index k = 0; k < slopes_.cols(); ++k) Q_by_s(first + k, turning.of_angle) += slopes_.col(k).dot(normal_forces);
}

VectorXd DeformingSurfaces::shell_displacement(const VectorXd& s) const {
  return openings_.leftCols(shell_count()) * s.head(shell_count());
}

VectorXd DeformingSurfaces::journal_displacement(const VectorXd& s) const {
  const Index count = openings_.cols() - shell_count();
  return -(openings_.rightCols(count) * s.tail(count));
}

}  // namespace hersey::bearing
