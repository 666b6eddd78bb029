#include "pad_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "hersey/core/two_pi.h"

namespace hersey::study {
namespace {

// Pads that are alike are equally hot but for round-off; the first of them is named.
bool is_hotter(double T, double than) {
  constexpr double round_off = 1e-9;  // of the absolute temperature
  return T > (1 + round_off) * than;
}

/// Numbers of the pads in the order of their angles, from which each film's lines are counted on.
std::vector<std::size_t> around(const std::vector<model::Bearing>& films) {
  std::vector<std::size_t> order(films.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto begin = [&](std::size_t k) {
    const double angle = films[k].film.grid.phi(0);
    return angle - two_pi * std::floor((angle + std::numbers::pi) / two_pi);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return begin(a) < begin(b); });
  return order;
}

void append(Eigen::VectorXd& all, const Eigen::VectorXd& more) {
  const Eigen::Index before = all.size();
  all.conservativeResize(before + more.size());
  all.tail(more.size()) = more;
}

}  // namespace

PadFilm::PadFilm(const std::vector<model::Bearing>& films) : films_(films), order_(around(films)) {
  model = films.front().film;
  model.grid = {.n_phi = 0,
                .n_z = films.front().film.grid.n_z,
                .angles = {},
                .heights = films.front().film.grid.heights,
                .patches = {}};
  model.ends.clear();
  for (const std::size_t k : order_) add_patch(films_[k], k);
  kind = films.front().kind;
  if (const auto* thrust = dynamic_cast<const bearing::ThrustBearing*>(kind.get()))
    kind = std::make_shared<bearing::ThrustBearing>(sectors_, thrust->shapes(), thrust->is_forward());
  if (!bore_.arcs.empty()) model.profiles = {{bore_, film::Surface::shell}};
}

void PadFilm::observe(const run::SteadyMotion& motion, const std::vector<double>& fixed_tilts) {
  film.h_min = film.h_min_centre = std::numeric_limits<double>::infinity();
  film.h_min_features = film.rupture_angle = film.reformation_angle = std::numeric_limits<double>::quiet_NaN();
  film.laminar_share = 0;
  film.force_pressure.setZero(), film.force_shear.setZero(), film.force_asperity.setZero();
  for (const std::size_t k : order_) {
    if (std::isnan(fixed_tilts[k])) add_extremes(motion.bearings[k].film);
    add_figures(motion.bearings[k].film, films_[k].film.grid);
    add_fields(motion.fields[k]);
    if (const auto& of_pad = motion.bearings[k].heat)
      add_heat(*of_pad, films_[k].film.grid, motion.bearings[k].film.oil_volume);
  }
  if (heat) divide_heat();
}

void PadFilm::add_patch(const model::Bearing& pad, std::size_t number) {
  film::Grid& grid = model.grid;
  const film::Grid& own = pad.film.grid;
  grid.patches.push_back(grid.n_phi);
  const double last = grid.angles.empty() ? -std::numbers::pi : grid.angles.back();
  const double shift = two_pi * std::ceil((last - own.phi(0)) / two_pi);
  for (int i = 0; i < own.n_phi; ++i) grid.angles.push_back(own.phi(i) + shift);
  grid.n_phi += own.n_phi;
  model.ends.push_back(pad.film.ends.front());
  const std::string name = fmt::format("{}", number + 1);
  if (const film::Arcs* arcs = film::arcs_of(pad.film); arcs != nullptr) {
    bore_.arcs.push_back(arcs->arcs.front());
    bore_.arcs.back().name = name;
    bore_.arcs.back().from += shift, bore_.arcs.back().to += shift;
  } else {
    sectors_.push_back({name, own.phi(0) + shift, own.phi(own.n_phi - 1) + shift});
  }
}

void PadFilm::add_extremes(const film::FilmObservables& pad) {
  if (pad.h_min < film.h_min) film.h_min = pad.h_min, film.h_min_phi = pad.h_min_phi, film.h_min_z = pad.h_min_z;
  film.h_min_centre = std::min(film.h_min_centre, pad.h_min_centre);
  if (pad.p_max > film.p_max) film.p_max = pad.p_max, film.p_max_phi = pad.p_max_phi, film.p_max_z = pad.p_max_z;
  film.p_max_node = std::max(film.p_max_node, pad.p_max_node);
}

void PadFilm::add_figures(const film::FilmObservables& pad, const film::Grid& grid) {
  film.wrench_on_shell += pad.wrench_on_shell;
  append(film.normal_forces, pad.normal_forces);
  film.force_pressure += pad.force_pressure, film.force_shear += pad.force_shear;
  film.force_asperity += pad.force_asperity;
  film.sliding_speed = pad.sliding_speed;
  for (const auto sum :
       {&film::FilmObservables::torque_journal, &film::FilmObservables::torque_shell,
        &film::FilmObservables::power_film, &film::FilmObservables::torque_journal_other_shear,
        &film::FilmObservables::power_film_other_shear, &film::FilmObservables::power_asperity,
        &film::FilmObservables::power_stored, &film::FilmObservables::power_oil, &film::FilmObservables::flow_left,
        &film::FilmObservables::flow_right, &film::FilmObservables::flow_first, &film::FilmObservables::flow_last,
        &film::FilmObservables::flow_supply, &film::FilmObservables::storage_rate, &film::FilmObservables::oil_volume})
    film.*sum += pad.*sum;
  film.patches.push_back(pad.patches.front());
  film.mass_balance_error = std::max(film.mass_balance_error, pad.mass_balance_error);
  film.reynolds_max = std::max(film.reynolds_max, pad.reynolds_max);
  film.taylor_max = std::max(film.taylor_max, pad.taylor_max);
  const double part = (grid.phi(grid.n_phi - 1) - grid.phi(0)) / angle_of_pads();
  film.laminar_share += part * pad.laminar_share, film.transition_share += part * pad.transition_share;
  film.turbulent_share += part * pad.turbulent_share;
  film.cavitated_share += part * pad.cavitated_share;
}

void PadFilm::add_fields(const film::FilmFields& pad) {
  for (const auto field :
       {&film::FilmFields::p, &film::FilmFields::theta, &film::FilmFields::density, &film::FilmFields::h,
        &film::FilmFields::depth, &film::FilmFields::w, &film::FilmFields::p_asperity, &film::FilmFields::reynolds,
        &film::FilmFields::d_shell, &film::FilmFields::T, &film::FilmFields::T_shell, &film::FilmFields::T_journal,
        &film::FilmFields::T_hottest})
    append(fields.*field, pad.*field);
}

// Means are sums first: over the area, of the film over the volume of its oil, of side flows over these.
void PadFilm::add_heat(const film::HeatObservables& pad, const film::Grid& grid, double oil_volume) {
  const double part = (grid.phi(grid.n_phi - 1) - grid.phi(0)) / angle_of_pads();
  if (!heat) heat.emplace();
  if (is_hotter(pad.T_max, heat->T_max))
    heat->T_max = pad.T_max, heat->T_max_phi = pad.T_max_phi, heat->T_max_z = pad.T_max_z;
  if (is_hotter(pad.T_shell_max, heat->T_shell_max))
    heat->T_shell_max = pad.T_shell_max, heat->T_shell_max_phi = pad.T_shell_max_phi;
  for (const auto mean : {&film::HeatObservables::T_shell_mean, &film::HeatObservables::T_journal,
                          &film::HeatObservables::T_shell_wall, &film::HeatObservables::T_journal_wall})
    (*heat).*mean += part * pad.*mean;
  if (oil_volume > 0) heat->T_film_mean += oil_volume * pad.T_film_mean;
  if (pad.leaving > 0) heat->T_side += pad.leaving * pad.T_side, heat->leaving += pad.leaving;
  for (const auto power : {&film::HeatBalance::power, &film::HeatBalance::source, &film::HeatBalance::to_oil,
                           &film::HeatBalance::to_shell, &film::HeatBalance::to_journal, &film::HeatBalance::stored})
    heat->balance.*power += pad.balance.*power;
}

void PadFilm::divide_heat() {
  heat->T_film_mean /= film.oil_volume;
  heat->T_side /= heat->leaving;
}

double PadFilm::angle_of_pads() const {
  double sum = 0;
  for (const model::Bearing& pad : films_) sum += pad.film.grid.phi(pad.film.grid.n_phi - 1) - pad.film.grid.phi(0);
  return sum;
}

}  // namespace hersey::study
