// Flexible bodies in the results file, and their deformed meshes beside it.
#include "flexible_record.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hersey/fem/skin.h"
#include "hersey/fem/stress.h"
#include "recorder.h"

namespace hersey::run {

namespace {

// What a unit amplitude of each shape does to the corners of the body's skin, shape after shape.
std::vector<double> deformation_of_skin(const model::BuiltFlexible& flexible) {
  const fem::Skin skin = fem::skin(*flexible.mesh);
  std::vector<double> values;
  values.reserve(3 * skin.nodes.size() * static_cast<std::size_t>(flexible.shapes.cols()));
  for (Eigen::Index shape = 0; shape < flexible.shapes.cols(); ++shape)
    for (const int node : skin.nodes)
      for (int axis = 0; axis < 3; ++axis) values.push_back(flexible.shapes(3 * node + axis, shape));
  return values;
}

/// Stresses in the body's axes, which turn with it.
void add_stress(const model::BuiltFlexible& flexible, const Eigen::VectorXd& u, fem::VtuFrame& frame) {
  const auto measure = flexible.strain == mbd::Strain::finite ? fem::StressMeasure::finite : fem::StressMeasure::small;
  const fem::Stress stress =
      fem::recover_stress(*flexible.mesh, flexible.materials, u, fem::Integration::full, measure);
  frame.node_fields.push_back({"stress", stress.nodal});
  frame.node_fields.push_back({"von_mises", stress.nodal_von_mises.transpose()});
}

void add_film_pressure(const FilmPressures::AtNodes& pressures, fem::VtuFrame& frame) {
  frame.node_fields.push_back({"film_pressure", pressures.film.transpose()});
  frame.node_fields.push_back({"contact_pressure", pressures.contact.transpose()});
}

}  // namespace

void Recorder::declare_flexible_bodies() {
  for (const model::BuiltFlexible& flexible : machine_.flexibles) {
    const std::string group = "/bodies/" + flexible.name, path = group + "/";
    const auto shapes = static_cast<int>(flexible.shapes.cols());
    flexibles_.push_back({writer_.series(path + "strain_energy", 1, "J", "strain energy"),
                          writer_.series(path + "dissipation", 1, "W", "power lost to the material's damping"),
                          shapes > 0 ? writer_.series(path + "amplitudes", shapes, "SI",
                                                      "of the shapes: [rotation; displacement] of each frame but the "
                                                      "first against it, then vibrations with all frames held [m]",
                                                      results::Precision::float64, path + "shape")
                                     : results::Series{}});
    if (shapes > 0 && !flexible.mesh->elements.empty()) {
      writer_.constant(path + "shapes/mesh/deformation", deformation_of_skin(flexible), "SI",
                       "displacement of each corner (x, y, z) by a unit amplitude, shape after shape, body axes");
    }
    writer_.attribute(group, "flexible_nodes", static_cast<int>(flexible.mesh->nodes.size()));
    writer_.attribute(group, "flexible_shapes", shapes);
    for (const fem::StaticError& error : flexible.static_errors)
      writer_.attribute(group, "static_error_" + error.surface, error.reduced);
    if (!flexible.frequencies.empty())
      writer_.constant(path + "held_frequencies", flexible.frequencies, "Hz", "of the vibrations with all frames held");
  }
}

void Recorder::write_flexible_bodies(const mbd::Observation& seen) {
  double strain = 0;  // of all, beams too
  for (const mbd::ElasticObservation& body : seen.elastics) strain += body.energy.strain;
  for (std::size_t i = 0; i < flexibles_.size(); ++i) {
    const mbd::ElasticObservation& body = seen.elastics[static_cast<std::size_t>(machine_.flexibles[i].elastic.index)];
    flexibles_[i].strain.append(body.energy.strain);
    flexibles_[i].dissipation.append(body.energy.dissipation);
    const Eigen::VectorXd amplitudes = machine_.flexibles[i].body->amplitudes(body.motion);
    if (amplitudes.size() > 0) flexibles_[i].amplitudes.append(amplitudes);
  }
  energy_.strain.append(strain);
}

void Recorder::declare_flexible_modes() {
  for (const model::BuiltFlexible& flexible : machine_.flexibles) {
    const auto shapes = static_cast<int>(flexible.shapes.cols());
    const std::string path = "/modes/fields/" + flexible.name + "_amplitudes_";
    modes_.amplitudes_real.push_back(writer_.series(path + "real", shapes, "SI", "mode shape in the body's amplitudes",
                                                    results::Precision::float64, path + "shape"));
    modes_.amplitudes_imaginary.push_back(writer_.series(path + "imaginary", shapes, "SI", "the same, imaginary part",
                                                         results::Precision::float64, path + "shape"));
  }
}

void Recorder::write_flexible_mode(const solver::State& state, const Eigen::VectorXcd& shape) {
  constexpr double step = 1e-6;  // amplitudes are smooth, and of a mode linear: their difference loses six digits
  mbd::Mechanism& mechanism = *machine_.mechanism;
  const auto amplitudes = [&](std::size_t i, const Eigen::VectorXd& increment) {
    solver::State moved = state;
    mechanism.retract(state.q, increment, moved.q);
    const auto elastic = static_cast<std::size_t>(machine_.flexibles[i].elastic.index);
    return machine_.flexibles[i].body->amplitudes(mechanism.observe(moved).elastics[elastic].motion);
  };
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(shape.size());
  for (std::size_t i = 0; i < machine_.flexibles.size(); ++i) {
    const Eigen::VectorXd here = amplitudes(i, none);
    const Eigen::VectorXd real = (amplitudes(i, step * shape.real()) - here) / step;
    const Eigen::VectorXd imaginary = (amplitudes(i, step * shape.imag()) - here) / step;
    modes_.amplitudes_real[i].append(real);
    modes_.amplitudes_imaginary[i].append(imaginary);
  }
}

DeformedMeshes::DeformedMeshes(const model::Model& model, const model::Machine& machine,
                               const std::filesystem::path& results)
    : machine_(machine), chosen_(model.output.meshes_at) {
  for (std::size_t i = 0; i < machine.flexibles.size(); ++i) {
    const std::string& name = machine.flexibles[i].name;
    const auto body = std::find_if(model.bodies.begin(), model.bodies.end(),
                                   [&](const model::Body& candidate) { return candidate.name == name; });
    const bool at_times = !chosen_.empty() && !machine.flexibles[i].mesh->elements.empty();
    if (!(body->flexible->vtu_every > 0) && !at_times) continue;
    std::filesystem::path pvd = results;
    pvd.replace_extension();
    pvd += "_" + name + ".pvd";
    series_.push_back(
        {i, body->flexible->vtu_every, fem::VtuSeries(std::move(pvd)), FilmPressures(model, machine, name)});
  }
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
      // Where the body has moved without deforming: viewers add the displacement themselves, as often as is asked.
      displacement.col(n) = X_WB.R * u.segment<3>(3 * n);
      frame.positions.col(n) = X_WB * flexible.mesh->nodes[static_cast<std::size_t>(n)];
    }
    frame.node_fields.push_back({"displacement", std::move(displacement)});
    if (series.films.has_any()) add_film_pressure(series.films.at_nodes(step), frame);
    if (!flexible.materials.empty()) add_stress(flexible, u, frame);
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
