// Stresses of a reduced body from its amplitudes: sigma = sum q_k sigma_k of the shapes, (elastic.17) each.
#include "hersey/run/body_stress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"
#include "hersey/fem/skin.h"
#include "hersey/fem/stress.h"
#include "hersey/run/model_of_results.h"

namespace hersey::run {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

[[noreturn]] void refuse_stress(std::string found, std::string expected, std::string remedy = "") {
  throw InputError(Fault{{"", 0, 0}, "--body", std::move(found), std::move(expected), std::move(remedy)});
}

const model::Body& flexible_called(const model::Model& model, const std::string& name) {
  std::vector<std::string> names;
  const model::Body* found = nullptr;
  for (const model::Body& body : model.bodies) {
    if (!body.flexible) continue;
    names.push_back(body.name);
    if (body.name == name || name.empty()) found = &body;
  }
  if (names.empty()) refuse_stress("the model has no flexible body", "a body with `flexible`");
  if (name.empty() && names.size() > 1)
    refuse_stress(fmt::format("{} bodies are flexible", names.size()), one_of(names));
  if (found == nullptr)
    refuse_stress(fmt::format("the model has no flexible body '{}'", name), one_of(names), did_you_mean(name, names));
  if (found->flexible->nodal)
    refuse_stress(fmt::format("body {} is `form: nodal`: results hold no amplitudes that say all of its deformation",
                              found->name),
                  "a body with `form: modal`",
                  "or add `output: {meshes_at: [370 deg]}` to the model: its run then writes the stresses at these "
                  "times beside the results");
  if (found->flexible->mesh->elements.empty())
    refuse_stress(fmt::format("body {} has no elements to which stresses belong", found->name),
                  "a body made of a mesh with elements");
  return *found;
}

model::BuiltFlexible built_flexible(const model::Model& model, const std::string& name) {
  const model::Machine machine = model::build(model);
  const auto at = std::find_if(machine.flexibles.begin(), machine.flexibles.end(),
                               [&](const model::BuiltFlexible& body) { return body.name == name; });
  if (at == machine.flexibles.end() || at->materials.empty())
    refuse_stress(fmt::format("of body {} the materials are not known", name), "a body with a mesh and its materials");
  return *at;
}

}  // namespace

BodyStress::BodyStress(const results::Reader& results, const model::Model& model, const std::string& body)
    : results_(results) {
  const model::Body& of = flexible_called(model, body);
  require_same_mesh(results, model, of);
  flexible_ = built_flexible(model, of.name);
  require_same_shapes();
  times_ = results.read("/time").values;
  if (results.has("/crank_angle")) crank_angles_ = results.read("/crank_angle").values;
  shape_stress_.emplace(mesh(), flexible_.materials, flexible_.shapes);
}

// Another version or machine may have found the same vibrations with another sign or, of equal frequencies, another
// mixture: their amplitudes would be those of other shapes.
void BodyStress::require_same_shapes() const {
  const std::string path = "/bodies/" + flexible_.name + "/shapes/mesh/deformation";
  const std::vector<double> before = results_.has(path) ? results_.read(path).values : std::vector<double>();
  const fem::Skin skin = fem::skin(mesh());
  const auto corners = static_cast<Index>(skin.nodes.size());
  bool is_same = static_cast<Index>(before.size()) == 3 * corners * shapes();
  constexpr double round_off_of_solutions = 1e-6;
  for (Index k = 0; is_same && k < shapes(); ++k) {
    VectorXd now(3 * corners);
    for (Index c = 0; c < corners; ++c)
      now.segment<3>(3 * c) = flexible_.shapes.col(k).segment<3>(3 * skin.nodes[static_cast<std::size_t>(c)]);
    const Eigen::Map<const VectorXd> then(before.data() + 3 * corners * k, 3 * corners);
    is_same = (now - then).norm() <= round_off_of_solutions * then.norm();
  }
  if (!is_same)
    refuse_stress(fmt::format("body {} has other shapes than in the results", flexible_.name),
                  "results of this version of the program on this machine", "run the model again");
}

VectorXd BodyStress::amplitudes_at(std::size_t instant) const {
  const std::vector<double> row = results_.read_rows("/bodies/" + flexible_.name + "/amplitudes", instant, 1).values;
  return Eigen::Map<const VectorXd>(row.data(), static_cast<Index>(row.size()));
}

BodyStressAt BodyStress::at(std::size_t instant) const {
  const VectorXd q = amplitudes_at(instant);
  const auto nodes = static_cast<Index>(mesh().nodes.size());
  BodyStressAt result;
  result.time = times_.at(instant);
  if (!crank_angles_.empty()) result.crank_angle = crank_angles_.at(instant);
  const VectorXd u = flexible_.shapes * q;
  result.displacement = Eigen::Map<const MatrixXd>(u.data(), 3, nodes);
  result.stress = shape_stress_->nodal(q);
  result.von_mises.resize(nodes);
  for (Index n = 0; n < nodes; ++n) result.von_mises[n] = fem::von_mises(result.stress.col(n));
  result.von_mises.maxCoeff(&result.node);
  return result;
}

BodyStress::Envelope BodyStress::envelope() const {
  Envelope envelope;
  const auto nodes = static_cast<Index>(mesh().nodes.size());
  envelope.largest = VectorXd::Constant(nodes, -1), envelope.when = VectorXd::Zero(nodes);
  for (std::size_t k = 0; k < times_.size(); ++k) {
    const BodyStressAt now = at(k);
    envelope.peaks.push_back({k, now.time, now.crank_angle, now.von_mises[now.node], now.node});
    for (Index n = 0; n < nodes; ++n)
      if (now.von_mises[n] > envelope.largest[n]) envelope.largest[n] = now.von_mises[n], envelope.when[n] = now.time;
  }
  return envelope;
}

std::vector<StressPeak> largest_stresses(const std::vector<StressPeak>& peaks, std::size_t most) {
  std::vector<StressPeak> found;
  for (std::size_t k = 0; k < peaks.size(); ++k) {
    const bool rises = k == 0 || peaks[k].von_mises > peaks[k - 1].von_mises,
               falls = k + 1 == peaks.size() || peaks[k].von_mises >= peaks[k + 1].von_mises;
    if (rises && falls) found.push_back(peaks[k]);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const StressPeak& a, const StressPeak& b) { return a.von_mises > b.von_mises; });
  if (found.size() > most) found.resize(most);
  return found;
}

}  // namespace hersey::run
