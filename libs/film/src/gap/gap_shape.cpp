#include "hersey/film/gap_shape.h"

#include "gap/grid_geometry.h"

namespace hersey::film {

GapShape::GapShape(const FilmModel& model) : model_(model), geometry_(std::make_unique<GridGeometry>(model)) {
  still_.setZero(model.grid.size());
  of_shell_.setZero(model.grid.size());
  for (const Profile& profile : model.profiles) {
    if (profile.surface == Surface::journal && profile.varies_around()) {
      turning_profiles_.push_back(profile);
      continue;
    }
    Eigen::VectorXd& opening = profile.surface == Surface::shell ? of_shell_ : still_;
    for (int k = 0; k < opening.size(); ++k) opening[k] += opening_at(profile, k, 0).value;
  }
  still_ += of_shell_;
}

GapShape::~GapShape() = default;
GapShape::GapShape(GapShape&&) noexcept = default;
GapShape& GapShape::operator=(GapShape&&) noexcept = default;

Opening GapShape::opening_at(const Profile& profile, int node, double turned) const {
  const int n_z = model_.grid.n_z;
  return profile.opening(geometry_->phi[node / n_z] - turned, geometry_->z[node % n_z], model_.L);
}

Eigen::VectorXd GapShape::shell_slope() const {
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(of_shell_.size());
  for (const Profile& profile : model_.profiles) {
    if (profile.surface != Surface::shell || !profile.varies_around()) continue;
    for (int k = 0; k < slope.size(); ++k) slope[k] += opening_at(profile, k, 0).phi;
  }
  return slope;
}

void GapShape::rotate_profiles(double phi_journal, Eigen::VectorXd& opening, Eigen::VectorXd& first,
                               Eigen::VectorXd& second) const {
  for (auto* field : {&opening, &first, &second}) field->setZero(still_.size());
  for (const Profile& profile : turning_profiles_) {
    for (int k = 0; k < still_.size(); ++k) {
      // In the frame of the journal the node moves backwards.
      const Opening o = opening_at(profile, k, phi_journal);
      opening[k] += o.value, first[k] -= o.phi, second[k] += o.phi_phi;
    }
  }
}

Eigen::VectorXd gap_opening(const FilmModel& model, double phi_journal) {
  GapShape shape(model);
  Eigen::VectorXd profiles, first, second;
  shape.rotate_profiles(phi_journal, profiles, first, second);
  return shape.still() + profiles;
}

}  // namespace hersey::film
