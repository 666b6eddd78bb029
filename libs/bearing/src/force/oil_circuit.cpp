#include "hersey/bearing/oil_circuit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "hersey/film/feature_overlap.h"

namespace hersey::bearing {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Films and circuit in turn, each by exact derivatives of the other: five do, and more where films rupture anew.
constexpr int kMostAtOnce = 80;
// Between two fills of which one does not answer, increments would lead from one to the other: they are halved unless
// they bring circuit and films nearer to balance.
constexpr double kNearer = 0.95, kLeastPart = 1.0 / 64;
constexpr double kBalancedAtOnce = 1e-12;  // of the largest flow: what films solved to 1e-10 leave after one increment

constexpr double kNoBalanceAtOnce = 1e-9;  // of the largest flow: what machines' iterations leave, and more

// Nodes at which films draw cavitate with these, and are as empty where their entries are equal (circuit.20).
circuit::Network with_cavities_of_films(circuit::Network network, const std::vector<CircuitFilm>& films) {
  for (std::size_t f = films.size(); f-- > 0;) {
    const film::FilmModel& model = films[f].film->model();
    for (const std::size_t node : films[f].nodes)
      network.nodes[node].fill_scale = film::fill_scale(model), network.nodes[node].p_cav = model.p_cav;
  }
  return network;
}

}  // namespace

OilCircuit::OilCircuit(circuit::Network network, std::vector<CircuitFilm> films,
                       std::vector<std::shared_ptr<const ScalarFunction>> given, std::vector<CircuitShaft> shafts,
                       std::vector<CircuitHole> holes, std::optional<CircuitHeat> heat)
    : circuit_(with_cavities_of_films(std::move(network), films)),
      films_(std::move(films)),
      given_(std::move(given)),
      shafts_(std::move(shafts)),
      holes_(std::move(holes)),
      heat_(std::move(heat)),
      area_by_angle_(holes_.size()),
      at_(films_.size()),
      p_by_at_(films_.size()) {
  conditions_.given.setZero(circuit_.size());
  conditions_.speeds.setZero(static_cast<Index>(shafts_.size()));
  conditions_.open_areas.setZero(static_cast<Index>(holes_.size()));
  if (heat_) set_temperatures(heat_->T);
}

void OilCircuit::begin_step(double dt) {
  is_condensed_ = false;
  if (p_start_.size() == 0 || dt == 0) return;  // a state without a step before it has no start
  p_ = p_start_;
  conditions_.content = circuit_.content(p_start_);
}

void OilCircuit::set_conditions(const mbd::SharedMotion& motion) {
  conditions_.dt = motion.dt;
  for (std::size_t i = 0; i < given_.size(); ++i)
    if (given_[i]) conditions_.given[static_cast<Index>(i)] = given_[i]->value({&motion.t, 1});
  for (std::size_t k = 0; k < shafts_.size(); ++k) {
    const CircuitShaft& shaft = shafts_[k];
    conditions_.speeds[static_cast<Index>(k)] =
        shaft.offset + (shaft.coordinate ? shaft.factor * motion.rates[*shaft.coordinate] : 0);
  }
}

// A speed that round-off leaves of a shaft at rest does not count.
void OilCircuit::refuse_backward_pumps() {
  constexpr double kAtRest = 1e-6;  // rad/s, far below any motion that pumps
  for (const circuit::Element& element : circuit_.network().elements) {
    if (!std::holds_alternative<circuit::DisplacementPump>(element.law) || !element.shaft) continue;
    const double speed = conditions_.speeds[static_cast<Index>(*element.shaft)];
    if (speed >= -kAtRest) continue;
    domain_error_ = fmt::format("pump {} turns backwards, at {:.4g} rpm", element.name, speed * 30 / std::numbers::pi);
    return;
  }
}

// (circuit.12), with the surfaces as they are.
void OilCircuit::open_holes() {
  for (std::size_t h = 0; h < holes_.size(); ++h) {
    const FilmForce& film = *films_[holes_[h].film].film;
    const film::FeatureOverlap open =
        film::overlap_of(holes_[h].hole, holes_[h].groove, film.gap().turning().angle, film.model().R);
    conditions_.open_areas[static_cast<Index>(h)] = open.area;
    area_by_angle_[h] = open.slope;
  }
}

void OilCircuit::add_passing_holes(std::size_t film, const VectorXd& p, MatrixXd& rhs) const {
  const std::vector<circuit::Element>& elements = circuit_.network().elements;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (!elements[e].hole || holes_[*elements[e].hole].film != film) continue;
    const double change = circuit_.flow(e, p, conditions_).by_area * area_by_angle_[*elements[e].hole];
    const Index angle = films_[film].film->gap().turning().of_angle;
    rhs(static_cast<Index>(elements[e].from), angle) += change;
    rhs(static_cast<Index>(elements[e].to), angle) -= change;
  }
}

// (circuit.20)
double OilCircuit::port_scale(const CircuitFilm& film, std::size_t node) const {
  const bool has_pressure = circuit_.state(node, p_[static_cast<Index>(node)]).p_slope > 0;
  return !has_pressure ? film::fill_scale(film.film->model()) / circuit_.fill_scale(node) : 1;
}

void OilCircuit::pass_pressures() {
  for (const CircuitFilm& film : films_) {
    VectorXd p(static_cast<Index>(film.nodes.size()));
    for (std::size_t k = 0; k < film.nodes.size(); ++k) {
      const circuit::NodeState there = circuit_.state(film.nodes[k], p_[static_cast<Index>(film.nodes[k])]);
      const double lack = (1 - there.fill) * film::fill_scale(film.film->model());
      p[static_cast<Index>(k)] = std::max(there.p, film.film->model().p_cav) - lack;
    }
    film.film->set_port_pressures(p);
  }
}

// (circuit.11): p = p_solved + sum over films of dp/ds (s - s_last).
void OilCircuit::follow(const mbd::SharedMotion& motion) {
  domain_error_.clear();
  set_conditions(motion);
  refuse_backward_pumps();
  for (const CircuitFilm& film : films_) film.film->follow(motion.motions[film.force]);
  open_holes();
  if (p_.size() == 0) {
    p_ = circuit_.start(conditions_);
    if (VectorXd p = p_; circuit_.solve(conditions_, circuit_.nothing_drawn(), p).solved()) p_ = p;
  }
  if (is_condensed_) {
    p_ = p_solved_;
    for (std::size_t f = 0; f < films_.size(); ++f)
      if (films_[f].film->domain_error().empty()) p_ += p_by_at_[f] * films_[f].film->change_of_parameters(at_[f]);
  }
  for (Index i = 0; i < circuit_.size(); ++i) {
    const circuit::Node& node = circuit_.network().nodes[static_cast<std::size_t>(i)];
    const double empty = node.p_cav - circuit_.fill_scale(static_cast<std::size_t>(i));
    p_[i] = node.is_given ? conditions_.given[i] : std::max(p_[i], empty);
  }
  pass_pressures();
  if (motion.dt == 0) balance_with_films(motion);
}

// At an instant each evaluation solves films to their end. So it does the circuit with them, since who asks for a state
// at rest or in steady motion may evaluate it once.
void OilCircuit::balance_with_films(const mbd::SharedMotion& motion) {
  VectorXd p_before = p_;
  double left = 1, before = std::numeric_limits<double>::max(), part = 1;
  for (int k = 0; k < kMostAtOnce; ++k) {
    bool is_inside = domain_error_.empty();
    for (const CircuitFilm& film : films_) {
      mbd::ForceResponse response;
      film.film->evaluate(motion.motions[film.force], true, response);
      is_inside = is_inside && film.film->domain_error().empty();
      film.film->follow(motion.motions[film.force]);
    }
    if (!is_inside && k == 0) return;
    // A film that has no solution where its fill was sought may have one nearer to where it had.
    if (!is_inside) {
      p_ = 0.5 * (p_ + p_before);
      pass_pressures();
      continue;
    }
    p_before = p_;
    const circuit::Drawn drawn = drawn_by_films();
    const Imbalance worst = imbalance(p_, drawn.flow);
    left = worst.over_largest_flow;
    if (left <= kBalancedAtOnce) return;
    part = worst.flow < kNearer * before ? std::min(1.0, 2 * part) : std::max(kLeastPart, part / 2);
    before = worst.flow;
    if (VectorXd p = p_; solve(drawn, p).solved()) p_ += part * (p - p_);
    pass_pressures();
  }
  if (left > kNoBalanceAtOnce)
    domain_error_ = fmt::format("no balance of circuit and films: {:.2g} of the largest flow is left", left);
}

circuit::Drawn OilCircuit::drawn_by_films() const {
  circuit::Drawn drawn = circuit_.nothing_drawn();
  drawn.p = p_;
  for (const CircuitFilm& film : films_) {
    const FilmForce::PortAnswer answer = film.film->port_answer();
    for (std::size_t k = 0; k < film.nodes.size(); ++k) {
      const auto row = static_cast<Index>(film.nodes[k]);
      drawn.flow[row] += answer.flow[static_cast<Index>(k)];
      for (std::size_t j = 0; j < film.nodes.size(); ++j)
        drawn.by_p(row, static_cast<Index>(film.nodes[j])) +=
            port_scale(film, film.nodes[j]) * answer.by_pressure(static_cast<Index>(k), static_cast<Index>(j));
    }
  }
  return drawn;
}

// A film that gets too little oil to build up pressure loses none: its flow does not answer to the fill, and the linear
// film has no balance with what comes. Then its fill is to rise by a part at a time until the film answers.
circuit::CircuitSummary OilCircuit::solve(const circuit::Drawn& drawn, VectorXd& p) const {
  constexpr double kFillAtATime = 0.2;  // halved, it takes twice as long; doubled, films that answer are passed over
  const VectorXd start = p;
  circuit::CircuitSummary summary = circuit_.solve(conditions_, drawn, p);
  if (summary.solved()) return summary;
  circuit::Circuit::Balance balance;
  circuit_.evaluate(p_, conditions_, balance);
  circuit::Drawn answering = drawn;
  answering.flow = drawn.flow + drawn.by_p * (p_ - drawn.p), answering.p = p_;
  for (const CircuitFilm& film : films_)
    for (const std::size_t node : film.nodes) {
      const auto i = static_cast<Index>(node);
      const double least = std::abs(balance.surplus[i]) / (kFillAtATime * circuit_.fill_scale(node));
      if (circuit_.state(node, p_[i]).p_slope == 0) answering.by_p(i, i) = std::max(answering.by_p(i, i), least);
    }
  p = start;
  if (const circuit::CircuitSummary slow = circuit_.solve(conditions_, answering, p); slow.solved()) return slow;
  return summary;
}

// What round-off makes of a balance does not count.
OilCircuit::Imbalance OilCircuit::imbalance(const VectorXd& p, const VectorXd& drawn) const {
  circuit::Circuit::Balance balance;
  circuit_.evaluate(p, conditions_, balance);
  const double scale = std::max(balance.largest_flow, drawn.lpNorm<Eigen::Infinity>());
  Imbalance worst;
  for (Index i = 0; i < circuit_.size(); ++i) {
    if (circuit_.network().nodes[static_cast<std::size_t>(i)].is_given) continue;
    const double surplus = std::abs(balance.surplus[i] - drawn[i]);
    if (surplus <= worst.over_largest_flow * scale || surplus <= balance.round_off) continue;
    worst = {surplus / scale, static_cast<std::size_t>(i), surplus};
  }
  return worst;
}

void OilCircuit::condense(std::span<mbd::ForceResponse> responses) {
  for (const CircuitFilm& film : films_)
    if (!film.film->domain_error().empty()) return;
  if (!domain_error_.empty()) return;
  const circuit::Drawn drawn = drawn_by_films();
  worst_ = imbalance(p_, drawn.flow);
  VectorXd p = p_;
  if (const circuit::CircuitSummary solved = solve(drawn, p); !solved.solved()) {
    domain_error_ = solved.message;
    return;
  }
  p_solved_ = p;
  drawn_ = drawn.flow + drawn.by_p * (p - p_);
  circuit::Circuit::Balance balance;
  circuit_.evaluate(p, conditions_, balance);
  MatrixXd by_p = balance.by_p - drawn.by_p;
  circuit_.fix_given(by_p);
  const Eigen::PartialPivLU<MatrixXd> factor(by_p);
  for (std::size_t f = 0; f < films_.size(); ++f) {
    const CircuitFilm& film = films_[f];
    const FilmForce::PortAnswer answer = film.film->port_answer();
    MatrixXd rhs = MatrixXd::Zero(circuit_.size(), answer.by_parameters.cols());
    for (std::size_t k = 0; k < film.nodes.size(); ++k)
      rhs.row(static_cast<Index>(film.nodes[k])) += answer.by_parameters.row(static_cast<Index>(k));
    add_passing_holes(f, p, rhs);
    for (std::size_t i = 0; i < circuit_.network().nodes.size(); ++i)
      if (circuit_.network().nodes[i].is_given) rhs.row(static_cast<Index>(i)).setZero();
    at_[f] = film.film->surface_parameters();
    p_by_at_[f] = factor.solve(rhs);
    VectorXd dp(static_cast<Index>(film.nodes.size()));
    MatrixXd dp_by(dp.size(), rhs.cols());
    for (std::size_t k = 0; k < film.nodes.size(); ++k) {
      const auto node = static_cast<Index>(film.nodes[k]);
      const double scale = port_scale(film, film.nodes[k]);
      dp[static_cast<Index>(k)] = scale * (p[node] - p_[node]);
      dp_by.row(static_cast<Index>(k)) = scale * p_by_at_[f].row(node);
    }
    film.film->complete(dp, dp_by, responses[film.force]);
  }
  is_condensed_ = true;
}

void OilCircuit::accept_step() {
  p_start_ = is_condensed_ ? p_solved_ : p_;
  observation_.pressures = circuit_.pressures(p_start_);
  observation_.fills = circuit_.fills(p_start_);
  observation_.flows = circuit_.flows(p_start_, conditions_);
  observation_.drawn = drawn_;
  observation_.content = circuit_.content(p_start_);
  observation_.speeds = conditions_.speeds;
  observation_.open_areas = conditions_.open_areas;
  observation_.balance_error = imbalance(p_start_, drawn_).over_largest_flow;
  // Work done on the oil between the ends of each element is lost in it, but where a source lifts it against pressure.
  observation_.power = 0;
  for (std::size_t e = 0; e < circuit_.network().elements.size(); ++e) {
    const circuit::Element& element = circuit_.network().elements[e];
    const double rise = observation_.pressures[static_cast<Index>(element.to)] -
                        observation_.pressures[static_cast<Index>(element.from)];
    observation_.power += std::max(0.0, observation_.flows[static_cast<Index>(e)] * rise);
  }
  observe_axes();
  observation_.dissipated = 0;
  for (std::size_t e = 0; heat_ && e < circuit_.network().elements.size(); ++e)
    observation_.dissipated += circuit_.dissipation(e, p_start_, conditions_);
  is_condensed_ = false;
}

void OilCircuit::observe_axes() {
  std::vector<double> at_axes;
  for (std::size_t e = 0; e < circuit_.network().elements.size(); ++e)
    if (circuit_.network().elements[e].passes_axis)
      at_axes.push_back(circuit_.pressure_at_axis(e, p_start_, conditions_));
  observation_.axis_pressures = Eigen::Map<const VectorXd>(at_axes.data(), static_cast<Index>(at_axes.size()));
}

double OilCircuit::torque_on(std::size_t shaft) const {
  const VectorXd& p = is_condensed_ ? p_solved_ : p_start_;
  if (p.size() == 0) return 0;
  double torque = 0;
  for (std::size_t e = 0; e < circuit_.network().elements.size(); ++e)
    if (circuit_.network().elements[e].shaft == shaft) torque += circuit_.torque(e, p, conditions_);
  return -shafts_[shaft].factor * torque;
}

void OilCircuit::persist(Archive& archive) {
  archive.io("pressures", p_start_);
  archive.io("content", conditions_.content);  // at the start of the last step, whose end is evaluated again
  if (archive.restores()) p_ = p_start_;
  if (heat_) persist_heat(archive);
}

}  // namespace hersey::bearing
