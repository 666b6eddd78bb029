// Holes of one surface of a bearing that pass over grooves of the other, elements of the circuit.
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "hersey/core/spelling.h"
#include "interpret/context/interpret.h"

namespace hersey::model {
namespace {

/// Resolves the names of one hole over a groove.
class PassingHole {
 public:
  PassingHole(Context& context, const Value& element, const circuit::Element& of, CircuitHole& hole)
      : context_(context), element_(element), of_(of), hole_(hole) {}

  void read() {
    if (!find_bearing()) return;
    const auto hole = feature_called(hole_.hole, "hole"), groove = feature_called(hole_.groove, "groove");
    if (!hole || !groove) return;
    hole_.hole_feature = *hole, hole_.groove_feature = *groove;
    check_shapes();
    check_nodes();
  }

 private:
  [[nodiscard]] const Bearing& bearing() const { return context_.model.bearings[hole_.of_bearing]; }
  [[nodiscard]] const film::SurfaceFeature& feature(std::size_t index) const { return bearing().film.features[index]; }

  [[nodiscard]] bool find_bearing() {
    std::vector<std::string> names;
    for (const Bearing& other : context_.model.bearings) names.push_back(other.name);
    for (hole_.of_bearing = 0; hole_.of_bearing < names.size(); ++hole_.of_bearing)
      if (names[hole_.of_bearing] == hole_.bearing) return true;
    context_.fault(*element_.find("bearing"), "unknown bearing '" + hole_.bearing + "'", one_of(names),
                   did_you_mean(hole_.bearing, names));
    return false;
  }

  [[nodiscard]] std::optional<std::size_t> feature_called(const std::string& name, const char* key) {
    std::vector<std::string> names;
    for (const film::SurfaceFeature& other : bearing().film.features) names.push_back(other.name);
    for (std::size_t k = 0; k < names.size(); ++k)
      if (names[k] == name) return k;
    const std::string expected = names.empty() ? "a bearing with `features`" : one_of(names);
    context_.fault(*element_.find(key), "unknown feature '" + name + "' of bearing '" + hole_.bearing + "'", expected,
                   did_you_mean(name, names));
    return std::nullopt;
  }

  void check_shapes() {
    const film::SurfaceFeature &hole = feature(hole_.hole_feature), &groove = feature(hole_.groove_feature);
    if (!std::holds_alternative<film::Ellipse>(hole.shape))
      context_.fault(*element_.find("hole"), "'" + hole.name + "', which is not round",
                     "a feature with `shape: hole` or `oval_hole`");
    if (!std::holds_alternative<film::Rectangle>(groove.shape))
      context_.fault(*element_.find("groove"), "'" + groove.name + "', a hole", "a groove or a pocket");
    if (hole.surface == groove.surface)
      return context_.fault(*element_.find("groove"),
                            "'" + groove.name + "' in the same surface as '" + hole.name + "', which never passes it",
                            "one of them with `on: journal`, the other in the shell");
    if (std::abs(hole.z - groove.z) >= 0.5 * (hole.length + groove.length))
      context_.fault(*element_.find("groove"), "'" + groove.name + "', beside which '" + hole.name + "' always passes",
                     "a `z` and a length with which both overlap along the axis");
  }

  /// A port that another node feeds would let the oil appear where it does not flow.
  void check_nodes() {
    bool is_fed = false;
    for (const CircuitPort& port : bearing().circuit_ports) {
      if (port.feature != hole_.hole_feature && port.feature != hole_.groove_feature) continue;
      is_fed = true;
      if (port.node == of_.from || port.node == of_.to) continue;
      const std::string& node = context_.model.circuit->network.nodes[port.node].name;
      context_.fault_at_key(
          element_,
          "'" + feature(port.feature).name + "' is fed by node '" + node + "', at which this element does not end",
          "from and to: the nodes of groove and hole");
    }
    if (!is_fed)
      context_.fault_at_key(element_, "neither '" + hole_.hole + "' nor '" + hole_.groove + "' is fed by the circuit",
                            "`circuit: " + context_.model.circuit->network.nodes[of_.from].name +
                                "` in the features of bearing '" + hole_.bearing + "'");
  }

  Context& context_;
  const Value& element_;
  const circuit::Element& of_;
  CircuitHole& hole_;
};

}  // namespace

bool joins_features(const Model& model, const std::string& bearing, const std::string& a, const std::string& b) {
  if (!model.circuit) return false;
  for (const CircuitHole& hole : model.circuit->holes)
    if (hole.bearing == bearing && ((hole.hole == a && hole.groove == b) || (hole.hole == b && hole.groove == a)))
      return true;
  return false;
}

void find_passing_holes(Context& context) {
  if (!context.model.circuit || !context.faults.empty()) return;  // names may be undefined
  OilCircuit& circuit = *context.model.circuit;
  for (const auto& [name, value] : section(*context.root.find("circuit"), "elements"))
    for (const circuit::Element& element : circuit.network.elements)
      if (element.hole && element.name == name)
        PassingHole(context, value, element, circuit.holes[*element.hole]).read();
}

}  // namespace hersey::model
