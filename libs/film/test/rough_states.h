#pragma once

#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "film_cases.h"
#include "seeded_random.h"

// Films at which derivatives are compared with central differences: every cavitation model, with all laws on and with
// each kind of boundary; and the changes of surfaces and ports.
namespace hersey::film::rough_states {

struct State {
  FilmModel model;
  SurfaceMotion motion;
  FilmHistory history;
  Eigen::VectorXd u;
  std::string name;
};

// A rough film: full and cavitated nodes side by side, nothing symmetric, nothing within a difference step of a switch.
inline State rough_state(Cavitation cavitation, bool all_laws, bool transient, const Grid& grid = {14, 6}) {
  State s;
  s.model = {.R = 0.03, .L = 0.02, .c = 20e-6, .grid = grid, .cavitation = cavitation, .p_cav = 1e4};
  s.model.edge_left.pressure = 2e5, s.model.edge_right.pressure = 3e5;
  s.model.supply = {SupplyKind::widest_gap, 0, 4e5};
  s.model.features = {{.name = "groove", .phi = 4, .arc = 0.7, .length = 0.009, .pressure = 5e5},
                      {.name = "hole",
                       .shape = Ellipse{},
                       .surface = Surface::journal,
                       .phi = 2.9,
                       .z = 1e-3,
                       .arc = 0.8,
                       .length = 0.008,
                       .pressure = 6e5}};
  if (all_laws) {
    s.model.lubricant.viscosity_law = Barus{2e-8};
    s.model.lubricant.density_law = DowsonHigginson{5e-9, 2e-9};  // ten times as soft as oil
    s.model.compliance = 5e-13;
    s.model.asperities = {AsperityModel::greenwood_tripp_exact, 4e-6, 3e-3, 57e9, 0.1};  // many nodes in contact
  }
  const Journal journal{
      .e = {9e-6, 14e-6}, .e_rate = {0.01, -0.02}, .tilt = {2e-4, -1e-4}, .omega_shell = -20, .omega_journal = 300};
  s.motion = surfaces(s.model, journal, 1.3);
  s.motion.phi_journal = -0.3;
  s.motion.w_journal = 0.4, s.motion.w_shell = -0.1;
  s.motion.feature_pressure = Eigen::Vector2d(5e5, 6e5);
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(0.1, 1.0);
  const int n = s.model.grid.size();
  s.motion.shell_opening.resize(n);  // as much as the gap itself
  for (int i = 0; i < n; ++i) s.motion.shell_opening[i] = 20e-6 * uniform(generator);
  s.u.resize(n);
  const double P0 = fill_scale(s.model);
  for (int i = 0; i < n; ++i)
    s.u[i] = uniform(generator) < 0.4 ? -0.5 * P0 * uniform(generator) : 2e7 * uniform(generator);
  if (transient) {
    s.history.dt = 1e-4;
    s.history.theta.resize(n), s.history.w.resize(n);
    for (int i = 0; i < n; ++i) s.history.theta[i] = uniform(generator), s.history.w[i] = 1e-6 * uniform(generator);
    s.history.density = Eigen::VectorXd::Constant(n, 1.01);
  }
  s.name = "cavitation " + std::to_string(static_cast<int>(cavitation)) + (all_laws ? ", all laws" : "") +
           (transient ? ", transient" : ", steady");
  return s;
}

inline State graded_state() {
  const Grid grid = graded_grid(14, 6, {{.position = 1.0, .reach = 0.6, .factor = 3}},
                                {{.position = 0.5, .reach = 0.2, .factor = 3}});
  State s = rough_state(Cavitation::mass_conserving, true, true, grid);
  s.name = "graded grid";
  return s;
}

inline std::vector<State> rough_states() {
  std::vector<State> states;
  for (const auto cavitation : {Cavitation::guembel, Cavitation::reynolds, Cavitation::mass_conserving}) {
    for (const bool all_laws : {false, true}) {
      for (const bool transient : {false, true}) states.push_back(rough_state(cavitation, all_laws, transient));
    }
  }
  State s = rough_state(Cavitation::mass_conserving, true, true);
  s.model.asperities.model = AsperityModel::greenwood_tripp_fit;
  s.model.shear_force = ShearForce::torque_only;
  s.model.cavitated_shear = CavitatedShear::full;
  s.model.edge_left.kind = s.model.edge_right.kind = EdgeKind::closed;
  s.name = "closed edges, torque only, full shear";
  states.push_back(s);
  s = rough_state(Cavitation::mass_conserving, true, true);
  s.motion.u_journal *= -1, s.motion.w_journal *= -1;
  s.name = "turning backwards";
  states.push_back(s);
  states.push_back(graded_state());
  s = rough_state(Cavitation::mass_conserving, true, true);
  s.model.edge_left.pressure = s.model.p_cav, s.model.edge_right.pressure = s.model.p_cav;
  s.model.edge_left.ambient_fill = 0.8, s.model.edge_right.ambient_fill = 1;
  s.name = "edges in oil mist and in oil";
  states.push_back(s);
  for (const auto cavitation :
       {Cavitation::guembel, Cavitation::full_film, Cavitation::reynolds, Cavitation::mass_conserving}) {
    s = rough_state(cavitation, true, cavitation == Cavitation::mass_conserving);
    s.model.lubricant.shear_thinning = {Cross{.limit = 0.3, .exponent = 0.8}, 3e5, 0};
    s.model.lubricant.density_law = BubblyOil{0.1, 1e6};
    s.motion.w_journal = 4;
    s.model.edge_left = {.kind = EdgeKind::leaking, .pressure = 2e5, .leakage = 0.4};
    s.model.edge_right = {.kind = EdgeKind::leaking, .pressure = 1e6, .leakage = 2};
    s.model.features[0].length = 0.03;  // to both edges
    s.name += ", seals that leak";
    states.push_back(s);
  }
  for (const bool transient : {false, true}) {
    s = rough_state(Cavitation::mass_conserving, true, transient);
    for (int i = 0; i < s.model.grid.n_phi; ++i) {
      const bool is_wide = i % 4 < 2;  // what is fitted through the nodes would cross zero between two narrow ones
      s.motion.g.segment(s.model.grid.index(i, 0), s.model.grid.n_z) *= is_wide ? 30 : 1;
    }
    s.name = std::string("gap that jumps from line to line") + (transient ? ", transient" : ", steady");
    states.push_back(s);
    s = rough_state(Cavitation::mass_conserving, true, transient);
    s.motion.phi_supply = 1.5;  // within a cell, away from its middle
    s.name = "line between nodes";
    states.push_back(s);
    s = rough_state(Cavitation::mass_conserving, true, transient);
    s.model.roughness = {FlowFactors::patir_cheng, {3e-6, 0.2}, {5e-6, 4}};  // from contact to full film
    s.name = std::string("flow factors") + (transient ? ", transient" : ", steady");
    states.push_back(s);
    if (!transient) continue;
    s.history.w.resize(0);
    s.name = "flow factors, liner at rest";
    states.push_back(s);
    s.model.roughness = {};
    s.name = "liner at rest";
    states.push_back(s);
  }
  return states;
}

// Grooves that end within the last cell before an edge, one of them travelling: oil flows over the land there.
inline std::vector<State> states_with_land() {
  std::vector<State> states;
  for (State s :
       {rough_state(Cavitation::mass_conserving, true, true), rough_state(Cavitation::guembel, true, false),
        rough_state(Cavitation::reynolds, false, false), rough_state(Cavitation::mass_conserving, true, false)}) {
    s.model.features = {
        {.name = "groove", .phi = 4, .arc = 0.7, .length = 0.017, .pressure = 5e5},
        {.name = "slot", .surface = Surface::journal, .phi = 2.9, .arc = 0.8, .length = 0.0165, .pressure = 6e5}};
    s.name += ", land";
    states.push_back(s);
    s.model.lubricant.shear_thinning = {Cross{.limit = 0.3, .exponent = 0.8}, 3e5, 0};
    s.model.roughness = {FlowFactors::patir_cheng, {3e-6, 0.2}, {5e-6, 4}};
    s.motion.w_journal = 4;
    s.name += ", sheared and rough";
    states.push_back(s);
    s.model.edge_left.pressure = s.model.edge_right.pressure = s.model.p_cav;
    s.model.edge_left.ambient_fill = 0.8, s.model.edge_right.ambient_fill = 0;
    s.name += ", edges in air";
    states.push_back(s);
  }
  return states;
}

// Oils that thin by the sliding of surfaces that slide slantwise: by a critical rate, and by a critical stress, which
// pressure raises.
inline std::vector<State> sheared_states() {
  std::vector<State> states;
  for (State s : {rough_state(Cavitation::mass_conserving, true, true), rough_state(Cavitation::guembel, true, false),
                  rough_state(Cavitation::reynolds, false, false)}) {
    s.motion.phi_supply = 1.5;
    s.motion.w_journal = 4;
    s.model.lubricant.shear_thinning = {Cross{.limit = 0.3, .exponent = 0.8}, 3e5, 0};
    s.name += ", Cross by rate";
    states.push_back(s);
    s.model.lubricant.shear_thinning = {Carreau{.limit = 0.2, .exponent = 0.4, .transition = 1.3}, 0, 4e3};
    s.model.roughness = {FlowFactors::patir_cheng, {3e-6, 0.2}, {5e-6, 4}};
    s.name += "; Carreau by stress, flow factors";
    states.push_back(s);
  }
  State s = rough_state(Cavitation::mass_conserving, true, true);
  s.model.lubricant.shear_thinning = {Cross{.limit = 0.3, .exponent = 0.8}, 3e5, 0};
  s.model.asperities.mu_friction = 0;  // changes its direction within less than a difference step
  s.motion.u_shell = s.motion.u_journal - 0.2, s.motion.w_journal = s.motion.w_shell;
  s.name = "hardly any sliding";
  states.push_back(s);
  return states;
}

// Films of thin oil that are laminar, in transition and turbulent side by side, with surfaces that slide slantwise.
inline std::vector<State> turbulent_states() {
  std::vector<State> states;
  const auto add = [&states](State s, const Turbulence& turbulence, const char* name) {
    s.model.lubricant.mu0 = 1e-4;
    s.model.turbulence = turbulence;
    s.motion.phi_supply = 1.5;
    s.motion.w_journal = 4;
    s.name += name;
    states.push_back(s);
  };
  for (const auto cavitation : {Cavitation::guembel, Cavitation::reynolds, Cavitation::mass_conserving}) {
    add(rough_state(cavitation, true, true), {.model = TurbulenceModel::ng_pan}, ", Ng and Pan");
    add(rough_state(cavitation, false, false), {.model = TurbulenceModel::hirs, .onset = 400, .full = 2000}, ", Hirs");
    add(rough_state(cavitation, true, false),
        {.model = TurbulenceModel::constantinescu, .number = TransitionNumber::taylor, .onset = 10, .full = 60},
        ", Constantinescu by the Taylor number");
  }
  State s = rough_state(Cavitation::mass_conserving, true, true);
  s.model.features = {
      {.name = "groove", .phi = 4, .arc = 0.7, .length = 0.017, .pressure = 5e5},
      {.name = "slot", .surface = Surface::journal, .phi = 2.9, .arc = 0.8, .length = 0.0165, .pressure = 6e5}};
  add(s, {.model = TurbulenceModel::ng_pan}, ", turbulent over land");
  s = rough_state(Cavitation::mass_conserving, true, true);
  s.model.surface = Annulus{};
  s.motion.shell_opening.resize(0);
  add(s, {.model = TurbulenceModel::ng_pan}, ", turbulent annulus");
  return states;
}

// Depth on both surfaces, one over the other in part.
inline std::vector<State> states_with_pockets() {
  std::vector<State> states;
  for (const bool transient : {false, true}) {
    for (const bool backwards : {false, true}) {
      State s = rough_state(Cavitation::mass_conserving, true, transient);
      s.model.features = {
          {.name = "shell's", .phi = 1.1, .z = 2e-3, .arc = 1.3, .length = 0.008, .is_fed = false, .depth = 3e-5},
          {.name = "journal's",
           .shape = Ellipse{},
           .surface = Surface::journal,
           .phi = 2.1,
           .z = -1e-3,
           .arc = 1.2,
           .length = 0.011,
           .is_fed = false,
           .depth = 8e-5},
          {.name = "slot",
           .surface = Surface::journal,
           .phi = 4.6,
           .arc = 0.7,
           .length = 0.013,
           .is_fed = false,
           .depth = 2e-5}};
      s.motion.u_shell = 0;
      s.motion.feature_pressure.resize(0);
      if (backwards) s.motion.u_journal *= -1;
      s.history.phi_journal = backwards ? -0.27 : -0.33;
      s.name = std::string("pockets") + (transient ? ", transient" : ", steady") + (backwards ? ", backwards" : "");
      states.push_back(s);
      for (const double line : {1.5, 2.3, 4.85}) {  // through each of them, within cells; 1.5: through two
        State crossed = s;
        crossed.motion.phi_supply = line;
        crossed.name += ", line at " + std::to_string(line);
        states.push_back(crossed);
      }
      if (!transient) continue;
      s.model.roughness = {FlowFactors::patir_cheng, {1e-6, 0.2}, {2e-6, 4}};
      s.name += ", rough";
      s.motion.phi_supply = 1.5;
      states.push_back(s);
      s.model.lubricant.shear_thinning = {Cross{.limit = 0.3, .exponent = 0.8}, 0, 4e3};
      s.name += ", sheared";
      states.push_back(s);
    }
  }
  return states;
}

// Pads of a bore, with an edge in air among their ends; an annulus, on which speeds grow with the radius; and a plane.
inline std::vector<State> states_on_surfaces() {
  std::vector<State> states;
  for (const bool transient : {false, true}) {
    const Grid pads = patch_grid({{.from = 0.3, .to = 2.5, .lines = 7}, {.from = 2.6, .to = 5.8, .lines = 8}}, 6);
    State s = rough_state(Cavitation::mass_conserving, true, transient, pads);
    s.model.supply.kind = SupplyKind::none;
    s.model.ends = {{.first = {.pressure = 4e5}, .last = {.pressure = 1e4, .ambient_fill = 0.7}},
                    {.first = {.kind = EdgeKind::closed}, .last = {.pressure = 2e5}}};
    s.name = "pads";
    states.push_back(s);
    // The gap is wide there, because the interpolation through the nodes would cross zero beside the ends.
    for (const int line : {2, 4, 9, 12}) s.motion.g.segment(s.model.grid.index(line, 0), s.model.grid.n_z) *= 40;
    s.name = "pads, gap that jumps";
    states.push_back(s);
    s.motion = rough_state(Cavitation::mass_conserving, true, transient, pads).motion;
    s.motion.u_shell = 0;
    s.motion.feature_pressure.resize(0);
    s.history.phi_journal = -0.33;
    s.model.features = {{.name = "slot",
                         .surface = Surface::journal,
                         .phi = 4.6,
                         .arc = 0.7,
                         .length = 0.013,
                         .is_fed = false,
                         .depth = 2e-5}};
    s.name = "pads, pocket that travels";
    states.push_back(s);
    for (State pockets : states_with_pockets()) {
      if ((pockets.history.dt > 0) != transient || pockets.motion.phi_supply != 1.3) continue;
      pockets.model.surface = Annulus{};
      pockets.name += ", annulus";
      states.push_back(pockets);
    }
    s = rough_state(Cavitation::mass_conserving, true, transient);
    s.model.surface = Annulus{};
    s.model.lubricant.shear_thinning = {Cross{.limit = 0.3, .exponent = 0.8}, 3e5, 0};
    s.motion.phi_supply = 1.5, s.motion.w_journal = 4;
    s.name = "annulus, sheared";
    states.push_back(s);
    s = rough_state(Cavitation::mass_conserving, true, transient);
    s.model.surface = Skirt{};
    s.motion.w_journal = -6;
    s.name = "skirt";
    states.push_back(s);
    s = rough_state(Cavitation::mass_conserving, true, transient, pads);
    s.model.surface = Plane{};
    s.model.supply.kind = SupplyKind::none;
    s.model.ends.resize(2);
    for (PatchEnds& ends : s.model.ends) ends.first.pressure = ends.last.pressure = s.model.p_cav;
    s.motion.shell_opening.resize(0);
    s.name = "plane";
    states.push_back(s);
  }
  for (State& s : states) s.name += s.history.dt > 0 ? ", transient" : ", steady";
  return states;
}

inline std::vector<State> all_states() {
  std::vector<State> states = rough_states();
  for (const State& s : states_on_surfaces()) states.push_back(s);
  for (const State& s : states_with_pockets()) states.push_back(s);
  for (const State& s : sheared_states()) states.push_back(s);
  for (const State& s : states_with_land()) states.push_back(s);
  for (const State& s : turbulent_states()) states.push_back(s);
  return states;
}

// The error of a central difference with relative step d is d^2 times third derivatives (the laws bend over about a
// tenth of a state) plus round-off over d.
inline constexpr double d = 1e-5;
inline constexpr double tolerance = 1e3 * d * d + 10 * std::numeric_limits<double>::epsilon() / d;

inline SurfaceMotion moved(const SurfaceMotion& motion, const MotionDirection& direction, double step) {
  SurfaceMotion m = motion;
  if (direction.g.size()) m.g += step * direction.g;
  if (direction.shell_fraction != 0) m.shell_opening += step * direction.shell_fraction * direction.g;
  if (direction.g_rate.size()) m.g_rate += step * direction.g_rate;
  m.u_shell += step * direction.u_shell;
  m.u_journal += step * direction.u_journal;
  m.w_shell += step * direction.w_shell;
  m.w_journal += step * direction.w_journal;
  m.phi_supply += step * direction.phi_supply;
  m.phi_journal += step * direction.phi_journal;
  if (direction.port_pressure.size() != 0) m.feature_pressure += step * direction.port_pressure;
  return m;
}

// One direction per kind of change, each of the size of the quantity it changes.
inline std::vector<std::pair<std::string, MotionDirection>> directions(const State& s) {
  const Eigen::VectorXd random = seeded_random(s.model.grid.size(), 1, 3);
  const double speed = s.model.R * 300;
  std::vector<std::pair<std::string, MotionDirection>> all{
      {"gap", {.g = 1e-6 * random, .g_rate = {}}},
      {"gap rate", {.g = {}, .g_rate = 0.02 * random}},
      {"u_shell", {.g = {}, .g_rate = {}, .u_shell = speed}},
      {"u_journal", {.g = {}, .g_rate = {}, .u_journal = speed}},
      {"w_shell", {.g = {}, .g_rate = {}, .w_shell = speed}},
      {"w_journal", {.g = {}, .g_rate = {}, .w_journal = speed}},
      {"phi_journal", {.g = {}, .g_rate = {}, .phi_journal = 0.1}}};
  if (s.motion.shell_opening.size() != 0)
    all.push_back({"gap by the shell's surface", {.g = 1e-6 * random, .g_rate = {}, .shell_fraction = 1}});
  if (s.model.supply.kind != SupplyKind::none)
    all.push_back({"phi_supply", {.g = {}, .g_rate = {}, .phi_supply = 0.1}});
  for (Eigen::Index port = 0; port < s.motion.feature_pressure.size(); ++port) {
    MotionDirection pressure;
    pressure.port_pressure = 1e5 * Eigen::VectorXd::Unit(s.motion.feature_pressure.size(), port);
    all.push_back({"pressure of port " + std::to_string(port), pressure});
  }
  return all;
}

}  // namespace hersey::film::rough_states
