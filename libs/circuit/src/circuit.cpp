#include "hersey/circuit/circuit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hersey/core/contract.h"

namespace hersey::circuit {
namespace {

// Round-off of a flow that follows from the difference of two pressures or of two contents.
constexpr double kRoundOff = 8 * std::numeric_limits<double>::epsilon();
// Conductances [m^3/(Pa s)] that keep increments bounded where nothing yet leads away from a node, over the largest of
// the circuit and at least.
constexpr double kLeastConductance = 1e-12, kNoConductance = 1e-12;

// (circuit.19)
void carry(const Flow& full, const NodeState& from, const NodeState& to, Through& through) {
  const NodeState& upstream = full.value < 0 ? to : from;
  through.value += upstream.fill * full.value;
  through.by_from += upstream.fill * full.slope * from.p_slope;
  through.by_to -= upstream.fill * full.slope * to.p_slope;
  (full.value < 0 ? through.by_to : through.by_from) += upstream.fill_slope * full.value;
  through.by_area += upstream.fill * full.by_area;
}

}  // namespace

Circuit::Circuit(Network network) : network_(std::move(network)) {
  for (const Element& element : network_.elements)
    HERSEY_REQUIRE(
        element.from < network_.nodes.size() && element.to < network_.nodes.size() && element.from != element.to,
        "elements between two nodes of the circuit");
  for (const Node& node : network_.nodes) {
    HERSEY_REQUIRE(node.fill_scale > 0, "a scale of the fill");
    if (!node.storage) {
      fill_scales_.push_back(node.fill_scale);
      continue;
    }
    const Storage::Content full = node.storage->content(node.p_cav, network_.ambient);
    fill_scales_.push_back(full.value / full.slope);  // with which the content has no bend there
  }
}

// (circuit.18)
NodeState Circuit::state(std::size_t node, double p) const {
  const double p_cav = network_.nodes[node].p_cav;
  if (network_.nodes[node].is_given || p >= p_cav) return {.p = p};
  const double by_p = 1 / fill_scales_[node];
  return {.p = p_cav, .p_slope = 0, .fill = std::max(0.0, 1 + (p - p_cav) * by_p), .fill_slope = by_p};
}

Eigen::VectorXd Circuit::pressures(const Eigen::VectorXd& p) const {
  Eigen::VectorXd all(size());
  for (Eigen::Index i = 0; i < size(); ++i) all[i] = state(static_cast<std::size_t>(i), p[i]).p;
  return all;
}

Eigen::VectorXd Circuit::fills(const Eigen::VectorXd& p) const {
  Eigen::VectorXd all(size());
  for (Eigen::Index i = 0; i < size(); ++i) all[i] = state(static_cast<std::size_t>(i), p[i]).fill;
  return all;
}

// (circuit.2)
double Circuit::drop(const Element& element, const Eigen::VectorXd& p, const Conditions& conditions) const {
  const double speed = element.shaft ? conditions.speeds[static_cast<Eigen::Index>(*element.shaft)] : 0;
  const double head =
      0.5 * network_.oil.density * speed * speed * (element.r_to * element.r_to - element.r_from * element.r_from);
  return state(element.from, p[static_cast<Eigen::Index>(element.from)]).p -
         state(element.to, p[static_cast<Eigen::Index>(element.to)]).p + head;
}

Through Circuit::flow(std::size_t element, const Eigen::VectorXd& p, const Conditions& conditions) const {
  const Element& of = network_.elements[element];
  Setting setting;
  if (of.shaft) setting.speed = conditions.speeds[static_cast<Eigen::Index>(*of.shaft)];
  if (of.hole) setting.open_area = conditions.open_areas[static_cast<Eigen::Index>(*of.hole)];
  const double over = drop(of, p, conditions);
  Oil oil = network_.oil;
  if (conditions.viscosities.size() > 0) oil.mu = conditions.viscosities[static_cast<Eigen::Index>(element)];
  const NodeState from = state(of.from, p[static_cast<Eigen::Index>(of.from)]),
                  to = state(of.to, p[static_cast<Eigen::Index>(of.to)]);
  Through through;
  if (const auto* pump = std::get_if<DisplacementPump>(&of.law)) {
    carry({.value = pump->displacement * setting.speed}, from, to, through);
    carry(pump->leak(over), from, to, through);
  } else {
    carry(std::visit([&](const auto& law) { return law.flow(over, oil, setting); }, of.law), from, to, through);
  }
  return through;
}

// (circuit.21), and (circuit.22): the oil's moment of momentum grows by omega r^2 on its way outwards.
double Circuit::torque(std::size_t element, const Eigen::VectorXd& p, const Conditions& conditions) const {
  const Element& of = network_.elements[element];
  if (!of.shaft) return 0;
  if (const auto* pump = std::get_if<DisplacementPump>(&of.law)) {
    const NodeState from = state(of.from, p[static_cast<Eigen::Index>(of.from)]);
    const double rise = state(of.to, p[static_cast<Eigen::Index>(of.to)]).p - from.p;
    const double ideal = from.fill * pump->displacement * rise;
    return rise > 0 ? ideal / pump->mechanical_efficiency : ideal * pump->mechanical_efficiency;
  }
  const double speed = conditions.speeds[static_cast<Eigen::Index>(*of.shaft)];
  return network_.oil.density * flow(element, p, conditions).value * speed *
         (of.r_to * of.r_to - of.r_from * of.r_from);
}

// (circuit.17): friction takes the drop evenly along a straight bore.
double Circuit::pressure_at_axis(std::size_t element, const Eigen::VectorXd& p, const Conditions& conditions) const {
  const Element& of = network_.elements[element];
  HERSEY_REQUIRE(of.passes_axis && of.shaft && of.r_from + of.r_to > 0, "a bore through the axis");
  const double speed = conditions.speeds[static_cast<Eigen::Index>(*of.shaft)];
  const double head = 0.5 * network_.oil.density * speed * speed * of.r_from * of.r_from;
  return state(of.from, p[static_cast<Eigen::Index>(of.from)]).p - head -
         drop(of, p, conditions) * of.r_from / (of.r_from + of.r_to);
}

double Circuit::dissipation(std::size_t element, const Eigen::VectorXd& p, const Conditions& conditions) const {
  const Element& of = network_.elements[element];
  const double over = drop(of, p, conditions);
  if (std::holds_alternative<GivenFlow>(of.law) || std::holds_alternative<PumpCurve>(of.law)) return 0;
  if (const auto* pump = std::get_if<DisplacementPump>(&of.law)) {
    const std::size_t upstream = over < 0 ? of.to : of.from;
    return state(upstream, p[static_cast<Eigen::Index>(upstream)]).fill * pump->leak(over).value * over;
  }
  return std::max(0.0, flow(element, p, conditions).value * over);
}

Eigen::VectorXd Circuit::flows(const Eigen::VectorXd& p, const Conditions& conditions) const {
  Eigen::VectorXd all(static_cast<Eigen::Index>(network_.elements.size()));
  for (std::size_t e = 0; e < network_.elements.size(); ++e)
    all[static_cast<Eigen::Index>(e)] = flow(e, p, conditions).value;
  return all;
}

Eigen::VectorXd Circuit::content(const Eigen::VectorXd& p) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(size());
  for (Eigen::Index i = 0; i < size(); ++i)
    if (network_.nodes[static_cast<std::size_t>(i)].storage)
      all[i] = content_of(static_cast<std::size_t>(i), p[i]).value;
  return all;
}

// What is lost at the cavitation pressure leaves the node filled in part (circuit.18).
Storage::Content Circuit::content_of(std::size_t node, double p) const {
  const Node& of = network_.nodes[node];
  const NodeState there = state(node, p);
  const Storage::Content full = of.storage->content(there.p, network_.ambient);
  return {there.fill * full.value, there.p_slope * full.slope + there.fill_slope * full.value};
}

// (circuit.1)
void Circuit::evaluate(const Eigen::VectorXd& p, const Conditions& conditions, Balance& balance) const {
  balance.surplus.setZero(size());
  balance.by_p.setZero(size(), size());
  balance.largest_flow = 0;
  for (std::size_t e = 0; e < network_.elements.size(); ++e) {
    const auto from = static_cast<Eigen::Index>(network_.elements[e].from),
               to = static_cast<Eigen::Index>(network_.elements[e].to);
    const Through through = flow(e, p, conditions);
    balance.surplus[from] -= through.value;
    balance.surplus[to] += through.value;
    balance.by_p(from, from) -= through.by_from;
    balance.by_p(from, to) -= through.by_to;
    balance.by_p(to, from) += through.by_from;
    balance.by_p(to, to) += through.by_to;
    balance.largest_flow = std::max(balance.largest_flow, std::abs(through.value));
  }
  // Pressures are exact to round-off of the absolute ones: flows that cease do not count beyond.
  const Eigen::VectorXd absolute = p.cwiseAbs().array() + network_.ambient;
  balance.round_off = kRoundOff * (balance.by_p.cwiseAbs() * absolute).maxCoeff();
  if (conditions.dt <= 0) return;
  for (Eigen::Index i = 0; i < size(); ++i) {
    const Node& node = network_.nodes[static_cast<std::size_t>(i)];
    if (!node.storage || node.is_given) continue;
    const Storage::Content content = content_of(static_cast<std::size_t>(i), p[i]);
    const double stored = (content.value - conditions.content[i]) / conditions.dt;
    balance.surplus[i] -= stored;
    balance.by_p(i, i) -= content.slope / conditions.dt;
    balance.largest_flow = std::max(balance.largest_flow, std::abs(stored));
    balance.round_off = std::max(balance.round_off, kRoundOff * content.value / conditions.dt);
  }
}

void Circuit::fix_given(Eigen::MatrixXd& by_p) const {
  const double largest = std::max(by_p.cwiseAbs().maxCoeff(), kNoConductance);
  for (Eigen::Index i = 0; i < size(); ++i) {
    if (network_.nodes[static_cast<std::size_t>(i)].is_given) by_p.row(i).setZero();
    by_p(i, i) -= (network_.nodes[static_cast<std::size_t>(i)].is_given ? 1 : kLeastConductance) * largest;
  }
}

Drawn Circuit::nothing_drawn() const {
  return {Eigen::VectorXd::Zero(size()), Eigen::MatrixXd::Zero(size(), size()), Eigen::VectorXd::Zero(size())};
}

Eigen::VectorXd Circuit::start(const Conditions& conditions) const {
  double highest = 0;
  for (const Node& node : network_.nodes) highest = std::max(highest, node.p_cav);
  for (Eigen::Index i = 0; i < size(); ++i)
    if (network_.nodes[static_cast<std::size_t>(i)].is_given) highest = std::max(highest, conditions.given[i]);
  for (const Element& element : network_.elements)
    if (const auto* valve = std::get_if<ReliefValve>(&element.law))
      highest = std::max(highest, valve->opening_pressure);
  Eigen::VectorXd p = Eigen::VectorXd::Constant(size(), highest);
  for (Eigen::Index i = 0; i < size(); ++i)
    if (network_.nodes[static_cast<std::size_t>(i)].is_given) p[i] = conditions.given[i];
  return p;
}

}  // namespace hersey::circuit
