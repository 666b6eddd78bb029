#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "hersey/bearing/oil_circuit.h"
#include "hersey/core/contract.h"

// Temperatures of a circuit's oil.
namespace hersey::bearing {

using Eigen::Index;

namespace {

bool is_cooler(const circuit::Element& element) { return std::holds_alternative<circuit::Cooler>(element.law); }

}  // namespace

// (circuit.14): oil flows from node to node along the flow, and on its way loses heat to a coolant (circuit.15) and
// gains what it dissipates (circuit.16).
std::vector<film::OilStream> OilCircuit::streams() const {
  std::vector<film::OilStream> all;
  if (!heat_ || observation_.flows.size() == 0) return all;
  const std::vector<circuit::Element>& elements = circuit_.network().elements;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const double Q = observation_.flows[static_cast<Index>(e)];
    const std::size_t from = Q < 0 ? elements[e].to : elements[e].from, to = Q < 0 ? elements[e].from : elements[e].to;
    const double rate = heat_->heat_capacity * std::abs(Q);
    const auto* cooler = std::get_if<circuit::Cooler>(&elements[e].law);
    const double kept = cooler != nullptr ? rate * cooler->remaining(rate) : rate;
    all.push_back({.from = heat_->nodes[from],
                   .to = heat_->nodes[to],
                   .kept = kept,
                   .coolant = heat_->coolants[e],
                   .cooled = rate - kept,
                   .heat = circuit_.dissipation(e, p_start_, conditions_)});
  }
  return all;
}

// An element through which oil flows both ways within a cycle has two mean streams.
void OilCircuit::add_streams_to_mean(double dt) {
  const std::vector<film::OilStream> now = streams();
  const std::size_t n = now.size();
  if (sum_.empty()) sum_.resize(2 * n);
  for (std::size_t e = 0; e < n; ++e) {
    const bool is_forward = now[e].from == heat_->nodes[circuit_.network().elements[e].from];
    film::OilStream& sum = sum_[is_forward ? e : n + e];
    sum.from = now[e].from, sum.to = now[e].to, sum.coolant = now[e].coolant;
    sum.kept += dt * now[e].kept, sum.cooled += dt * now[e].cooled, sum.heat += dt * now[e].heat;
  }
  sum_of_steps_ += dt;
}

std::vector<film::OilStream> OilCircuit::mean_streams() {
  std::vector<film::OilStream> mean = sum_;
  for (film::OilStream& stream : mean)
    stream.kept /= sum_of_steps_, stream.cooled /= sum_of_steps_, stream.heat /= sum_of_steps_;
  sum_.clear();
  sum_of_steps_ = 0;
  return mean;
}

void OilCircuit::follow_temperatures(const Eigen::VectorXd& T_network) {
  HERSEY_REQUIRE(heat_.has_value(), "a circuit with temperatures");
  Eigen::VectorXd T(circuit_.size());
  for (Index i = 0; i < T.size(); ++i) T[i] = T_network[static_cast<Index>(heat_->nodes[static_cast<std::size_t>(i)])];
  const auto at = [&T_network](std::size_t node) { return T_network[static_cast<Index>(node)]; };
  std::vector<double> cooled;
  const std::vector<film::OilStream> now = streams();
  for (std::size_t e = 0; e < now.size(); ++e)
    if (is_cooler(circuit_.network().elements[e]))
      cooled.push_back(now[e].cooled * (at(now[e].from) - at(now[e].coolant)));
  observation_.cooled = Eigen::Map<const Eigen::VectorXd>(cooled.data(), static_cast<Index>(cooled.size()));
  set_temperatures(T);
}

void OilCircuit::set_temperatures(const Eigen::VectorXd& T) {
  HERSEY_REQUIRE(heat_ && T.size() == circuit_.size(), "a temperature of each node");
  observation_.temperatures = T;
  if (observation_.cooled.size() == 0)
    observation_.cooled.setZero(std::ranges::count_if(circuit_.network().elements, is_cooler));
  update_viscosities();
}

// The oil that flows into an element fills it. Which end that is, the step before says: a flow that turns within a step
// would jump.
void OilCircuit::update_viscosities() {
  const std::vector<circuit::Element>& elements = circuit_.network().elements;
  conditions_.viscosities.resize(static_cast<Index>(elements.size()));
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const bool turns_back = observation_.flows.size() > 0 && observation_.flows[static_cast<Index>(e)] < 0;
    const std::size_t from = turns_back ? elements[e].to : elements[e].from;
    conditions_.viscosities[static_cast<Index>(e)] =
        film::viscosity_at(heat_->law, observation_.temperatures[static_cast<Index>(from)]);
  }
}

void OilCircuit::persist_heat(Archive& archive) {
  archive.io("temperatures", observation_.temperatures);
  archive.io("viscosities", conditions_.viscosities);
  const std::size_t n = circuit_.network().elements.size();
  if (archive.restores()) sum_.assign(2 * n, {});
  if (sum_.empty()) sum_.resize(2 * n);
  for (std::size_t k = 0; k < sum_.size(); ++k) {
    const Archive::Group group(archive, "stream_" + std::to_string(k));
    const circuit::Element& element = circuit_.network().elements[k % n];
    film::OilStream& sum = sum_[k];
    sum.from = heat_->nodes[k < n ? element.from : element.to],
    sum.to = heat_->nodes[k < n ? element.to : element.from];
    sum.coolant = heat_->coolants[k % n];
    archive.io("kept", sum.kept), archive.io("cooled", sum.cooled), archive.io("heat", sum.heat);
  }
  archive.io("time", sum_of_steps_);
}

}  // namespace hersey::bearing
