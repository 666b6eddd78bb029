#include "record/deformed_meshes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hersey/fem/stress.h"

namespace hersey::run {
namespace {

constexpr double most_of_shapes = 64e6;  // bytes of the stresses of all shapes

/// Stresses are linear in the amplitudes of fewer shapes than there will be meshes.
bool is_worth_shapes(const model::BuiltFlexible& flexible, double meshes) {
  const auto shapes = static_cast<double>(flexible.shapes.cols());
  const double bytes = 6 * sizeof(double) * static_cast<double>(flexible.mesh->nodes.size()) * shapes;
  return flexible.strain == mbd::Strain::small && shapes > 0 && !flexible.materials.empty() && shapes < meshes &&
         bytes <= most_of_shapes;
}

void add_stress(Eigen::MatrixXd stress, fem::VtuFrame& frame) {
  Eigen::RowVectorXd von_mises(stress.cols());
  for (Eigen::Index n = 0; n < stress.cols(); ++n) von_mises[n] = fem::von_mises(stress.col(n));
  frame.node_fields.push_back({"stress", std::move(stress)});
  frame.node_fields.push_back({"von_mises", von_mises});
}

void add_film_pressure(const FilmPressures::AtNodes& pressures, fem::VtuFrame& frame) {
  frame.node_fields.push_back({"film_pressure", pressures.film.transpose()});
  frame.node_fields.push_back({"contact_pressure", pressures.contact.transpose()});
}

}  // namespace

DeformedMeshes::DeformedMeshes(const model::Model& model, const model::Machine& machine,
                               const std::filesystem::path& results)
    : machine_(machine), chosen_(model.output.meshes_at) {
  if (results.empty()) return;
  for (std::size_t i = 0; i < machine.flexibles.size(); ++i) {
    const std::string& name = machine.flexibles[i].name;
    const auto body = std::find_if(model.bodies.begin(), model.bodies.end(),
                                   [&](const model::Body& candidate) { return candidate.name == name; });
    const bool at_times = !chosen_.empty() && !machine.flexibles[i].mesh->elements.empty();
    if (!(body->flexible->vtu_every > 0) && !at_times) continue;
    std::filesystem::path pvd = results;
    pvd.replace_extension();
    pvd += "_" + name + ".pvd";
    const double every = body->flexible->vtu_every;
    series_.push_back({i, every, fem::VtuSeries(std::move(pvd)), FilmPressures(model, machine, name), {}});
    const double meshes = static_cast<double>(chosen_.size()) + (every > 0 ? model.simulation.duration / every : 0.0);
    const model::BuiltFlexible& flexible = machine.flexibles[i];
    if (is_worth_shapes(flexible, meshes))
      series_.back().shape_stress.emplace(*flexible.mesh, flexible.materials, flexible.shapes);
  }
}

Eigen::MatrixXd DeformedMeshes::stress_of(const Series& series, const mbd::ElasticMotion& motion,
                                          const Eigen::VectorXd& u) const {
  const model::BuiltFlexible& flexible = machine_.flexibles[series.flexible];
  if (series.shape_stress) return series.shape_stress->nodal(flexible.body->amplitudes(motion));
  const auto measure = flexible.strain == mbd::Strain::finite ? fem::StressMeasure::finite : fem::StressMeasure::small;
  return fem::recover_stress(*flexible.mesh, flexible.materials, u, fem::Integration::full, measure).nodal;
}

bool DeformedMeshes::is_due(Series& series, double since_start, double slack) const {
  bool is_due = false;
  if (series.every > 0 && since_start >= series.next * series.every - slack) {
    series.next = std::floor((since_start + slack) / series.every) + 1;
    is_due = true;
  }
  while (series.next_at < chosen_.size() && since_start >= chosen_[series.next_at] - slack) {
    ++series.next_at;
    is_due = true;
  }
  return is_due;
}

void DeformedMeshes::write(double t, double since_start, double slack, const StepRecord& step) {
  for (Series& series : series_) {
    if (!is_due(series, since_start, slack)) continue;
    const model::BuiltFlexible& flexible = machine_.flexibles[series.flexible];
    const mbd::ElasticMotion& motion = step.mechanism.elastics[static_cast<std::size_t>(flexible.elastic.index)].motion;
    const Pose& X_WB = motion.frames[0].X_WF;
    const Eigen::VectorXd u = flexible.body->displacements(motion, flexible.shapes);
    const auto nodes = static_cast<Eigen::Index>(flexible.mesh->nodes.size());
    fem::VtuFrame frame;
    frame.positions.resize(3, nodes);
    Eigen::MatrixXd displacement(3, nodes);
    for (Eigen::Index n = 0; n < nodes; ++n) {
      // The position after a motion without deformation: viewers add the displacement themselves, with any
      // magnification.
      displacement.col(n) = X_WB.R * u.segment<3>(3 * n);
      frame.positions.col(n) = X_WB * flexible.mesh->nodes[static_cast<std::size_t>(n)];
    }
    frame.node_fields.push_back({"displacement", std::move(displacement)});
    if (series.films.has_any()) add_film_pressure(series.films.at_nodes(step), frame);
    if (!flexible.materials.empty()) add_stress(stress_of(series, motion, u), frame);
    series.files.add(t, *flexible.mesh, frame);
  }
}

void DeformedMeshes::persist(Archive& archive) {
  for (Series& series : series_) {
    const Archive::Group group(archive, machine_.flexibles[series.flexible].name);
    archive.io("next", series.next), archive.io("next_at", series.next_at);
    series.files.persist(archive);
  }
}

}  // namespace hersey::run
