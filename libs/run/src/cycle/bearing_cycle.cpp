#include "cycle/bearing_cycle.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

#include "hersey/core/contract.h"

namespace hersey::run {
namespace {

void persist_extreme(Archive& archive, const char* name, FilmExtreme& extreme) {
  const Archive::Group group(archive, name);
  archive.io("value", extreme.value), archive.io("t", extreme.t);
  archive.io("phi", extreme.phi), archive.io("z", extreme.z);
}

}  // namespace

double BearingCycle::friction_mean_effective_pressure(double R) const {
  if (stroke() <= 0) return std::numeric_limits<double>::quiet_NaN();
  return (energy_film + energy_asperity) / (std::numbers::pi * R * R * stroke());
}

void CycleSums::take(double t, const bearing::BearingObservation& observation, const film::FilmFields& fields) {
  const film::FilmObservables& film = observation.film;
  Sample next{.power_film = film.power_film,
              .power_asperity = film.power_asperity,
              .sliding_speed = film.sliding_speed,
              .speed = observation.position.speed,
              .contact = fields.p_asperity,
              .moft = {film.h_min, t, film.h_min_phi, film.h_min_z},
              .pofp = {film.p_max, t, film.p_max_phi, film.p_max_z},
              .walls = observation.walls,
              .h = fields.thickness(),
              .p = fields.p};
  if (observation.heat)
    next.hottest = {observation.heat->T_max, t, observation.heat->T_max_phi, observation.heat->T_max_z};
  if (is_begun_) integrate(t - cycle_.end, next);
  last_ = std::move(next);
  if (!is_begun_) begin(t);
  cycle_.end = t;
  compare(t);
}

BearingCycle CycleSums::close() {
  HERSEY_REQUIRE(is_begun_, "a state was taken");
  BearingCycle closed = cycle_;
  if (closed.duration() > 0) {
    closed.mean_contact /= closed.duration();
    closed.wear_load /= closed.duration();
  } else {
    closed.mean_contact = last_.contact;
    closed.wear_load = last_.contact * last_.sliding_speed;
  }
  begin(closed.end);
  return closed;
}

// Starts a cycle of zero length whose last state is known.
void CycleSums::begin(double t) {
  const Eigen::Index n = last_.p.size();
  is_begun_ = true;
  cycle_ = {};
  cycle_.begin = cycle_.end = t;
  cycle_.mean_contact = cycle_.wear_load = Eigen::VectorXd::Zero(n);
  cycle_.moft.value = std::numeric_limits<double>::infinity();
  cycle_.pofp.value = -std::numeric_limits<double>::infinity();
  cycle_.h_min = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::infinity());
  cycle_.p_max = Eigen::VectorXd::Constant(n, -std::numeric_limits<double>::infinity());
  cycle_.t_h_min = cycle_.t_p_max = Eigen::VectorXd::Constant(n, t);
  compare(t);
}

void CycleSums::integrate(double dt, const Sample& next) {
  cycle_.energy_film += 0.5 * dt * (last_.power_film + next.power_film);
  cycle_.energy_asperity += 0.5 * dt * (last_.power_asperity + next.power_asperity);
  cycle_.way += 0.5 * dt * (last_.speed + next.speed);
  cycle_.lowest = std::min(cycle_.lowest, cycle_.way), cycle_.highest = std::max(cycle_.highest, cycle_.way);
  cycle_.mean_contact += 0.5 * dt * (last_.contact + next.contact);
  cycle_.wear_load += 0.5 * dt * (last_.contact * last_.sliding_speed + next.contact * next.sliding_speed);
}

// Extremes with the last state.
void CycleSums::compare(double t) {
  if (last_.moft.value < cycle_.moft.value) cycle_.moft = last_.moft;
  if (last_.pofp.value > cycle_.pofp.value) cycle_.pofp = last_.pofp;
  if (last_.hottest.value > cycle_.hottest.value) cycle_.hottest = last_.hottest;
  cycle_.walls = last_.walls;
  Eigen::Index node = 0;
  const double contact = last_.contact.maxCoeff(&node);
  if (contact > cycle_.contact.value) {
    const film::Grid& grid = model_.grid;
    const auto i = static_cast<int>(node) / grid.n_z, j = static_cast<int>(node) % grid.n_z;
    cycle_.contact = {contact, t, grid.phi(i), model_.L * grid.z_over_L(j)};
  }
  for (Eigen::Index k = 0; k < last_.p.size(); ++k) {
    if (last_.h[k] < cycle_.h_min[k]) {
      cycle_.h_min[k] = last_.h[k];
      cycle_.t_h_min[k] = t;
    }
    if (last_.p[k] > cycle_.p_max[k]) {
      cycle_.p_max[k] = last_.p[k];
      cycle_.t_p_max[k] = t;
    }
  }
}

void CycleSums::persist(Archive& archive) {
  BearingCycle& c = cycle_;
  archive.io("is_begun", is_begun_), archive.io("begin", c.begin), archive.io("end", c.end);
  archive.io("energy_film", c.energy_film), archive.io("energy_asperity", c.energy_asperity);
  archive.io("way", c.way), archive.io("lowest", c.lowest), archive.io("highest", c.highest);
  persist_extreme(archive, "moft", c.moft), persist_extreme(archive, "pofp", c.pofp);
  persist_extreme(archive, "contact", c.contact), persist_extreme(archive, "hottest", c.hottest);
  archive.io("wall_correction", c.walls.largest), archive.io("wall_rise", c.walls.rise);
  archive.io("mean_contact", c.mean_contact), archive.io("wear_load", c.wear_load);
  archive.io("h_min", c.h_min), archive.io("t_h_min", c.t_h_min);
  archive.io("p_max", c.p_max), archive.io("t_p_max", c.t_p_max);
  const Archive::Group group(archive, "last");
  archive.io("power_film", last_.power_film), archive.io("power_asperity", last_.power_asperity);
  archive.io("sliding_speed", last_.sliding_speed), archive.io("speed", last_.speed);
  archive.io("contact", last_.contact);
  persist_extreme(archive, "moft", last_.moft), persist_extreme(archive, "pofp", last_.pofp);
  persist_extreme(archive, "hottest", last_.hottest);
  archive.io("wall_correction", last_.walls.largest), archive.io("wall_rise", last_.walls.rise);
  archive.io("h", last_.h), archive.io("p", last_.p);
}

}  // namespace hersey::run
