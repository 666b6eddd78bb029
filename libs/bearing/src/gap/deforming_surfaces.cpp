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
  const Index shell_amplitudes = shell_count();
  shapes_.openings = MatrixXd::Zero(grid_.size(), shell_amplitudes + (journal_ ? journal_->D.cols() : 0));
  if (shell_) {
    shapes_.surfaces.push_back({at_nodes(shell_->functions, 0)[0], {}, shell_->D, true});
    shapes_.openings.leftCols(shell_amplitudes) = shapes_.surfaces.back().opening * shell_->D;
  }
  if (journal_) {
    shapes_.surfaces.push_back({{}, {}, journal_->D, false});
    turn_journal(0);
    shapes_.surfaces.back().rate = 0 * slopes_;
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
  film::SurfaceShapes::Surface& journal = shapes_.surfaces.back();
  journal.opening = -fields[0];
  shapes_.openings.rightCols(journal_->D.cols()) = journal.opening * journal_->D;
  slopes_ = fields[1];
  curvatures_ = -fields[2];
}

void DeformingSurfaces::add_displacements(const VectorXd& s, const VectorXd& s_rate,
                                          const GapKinematics::Turning& turning, film::SurfaceMotion& motion) {
  if (!deform()) return;
  if (journal_) turn_journal(turning.angle);
  if (motion.shell_opening.size() == 0) motion.shell_opening.setZero(motion.g.size());
  if (shell_) {
    const film::SurfaceShapes::Functions& opening = shapes_.surfaces.front().opening;
    opened_.noalias() = opening * (shell_->D * s.head(shell_count()));
    motion.g += opened_;
    motion.shell_opening += opened_;
    motion.g_rate.noalias() += opening * (shell_->D * s_rate.head(shell_count()));
  }
  if (!journal_) return;
  const double omega = turning.speed;
  film::SurfaceShapes::Surface& journal = shapes_.surfaces.back();
  const VectorXd amplitudes = journal_->D * s.tail(journal_->D.cols()),
                 rates = journal_->D * s_rate.tail(journal_->D.cols());
  motion.g.noalias() += journal.opening * amplitudes;
  by_angle_.noalias() = slopes_ * amplitudes;
  motion.g_rate.noalias() += journal.opening * rates;
  motion.g_rate += omega * by_angle_;
  rate_by_angle_.noalias() = slopes_ * rates;
  rate_by_angle_.noalias() += omega * (curvatures_ * amplitudes);
  journal.rate = omega * slopes_;
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
  Q_by_s.col(turning.of_angle).tail(journal_->D.cols()) +=
      journal_->D.transpose() * (slopes_.transpose() * normal_forces);
}

VectorXd DeformingSurfaces::shell_displacement(const VectorXd& s) const {
  return shapes_.openings.leftCols(shell_count()) * s.head(shell_count());
}

VectorXd DeformingSurfaces::journal_displacement(const VectorXd& s) const {
  const Index count = amplitudes() - shell_count();
  return -(shapes_.openings.rightCols(count) * s.tail(count));
}

}  // namespace hersey::bearing
