// What the results file keeps of bearings.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "hersey/run/assumptions.h"
#include "recorder.h"

namespace hersey::run {
namespace {

// Attitude: from the load on the journal (the shell's film force turned round) to the line of centres, 0..pi.
double attitude(const bearing::BearingObservation& seen) {
  const Eigen::Vector2d load = seen.wrench_on_shell.tail<3>().head<2>();
  const double cross = load.x() * seen.position.e.y() - load.y() * seen.position.e.x();
  return std::abs(std::atan2(cross, load.dot(seen.position.e)));
}

}  // namespace

Recorder::BearingSeries Recorder::declare_bearing(const model::Bearing& bearing) {
  const std::string group = "/bearings/" + bearing.name, path = group + "/";
  const film::FilmModel& film = bearing.film;
  writer_.attribute(group, "radius", film.R);
  writer_.attribute(group, "width", film.L);
  writer_.attribute(group, "radial_clearance", film.c);
  writer_.attribute(group, "n_phi", film.grid.n_phi);
  writer_.attribute(group, "n_z", film.grid.n_z);
  for (const auto& [name, text] : assumptions(model_)) {
    if (name.starts_with(bearing.name + ": ")) writer_.attribute(group, name.substr(bearing.name.size() + 2), text);
  }
  const auto series = [&](const char* name, const char* unit, const char* description, int columns = 1) {
    return writer_.series(path + name, columns, unit, description);
  };
  BearingSeries s;
  s.eccentricity = series("eccentricity", "m", "journal axis from bore axis at z = 0, bearing frame", 2);
  s.ratio = series("eccentricity_ratio", "1", "eccentricity over radial clearance");
  s.attitude = series("attitude", "rad", "angle between load and line of centres");
  s.tilt = series("tilt", "1", "slope of the journal's axis in the bearing frame", 2);
  s.h_min = series("h_min", "m", "smallest film thickness beside features with depth, edges included");
  s.h_min_phi = series("h_min_phi", "rad", "where: bearing angle");
  s.h_min_z = series("h_min_z", "m", "where: axial");
  s.h_min_centre = series("h_min_centre", "m", "smallest film thickness at z = 0");
  if (std::any_of(film.features.begin(), film.features.end(), [](const auto& f) { return f.depth > 0; }))
    s.h_min_features = series("h_min_features", "m", "smallest thickness over features with depth, that included");
  s.p_max = series("p_max", "Pa", "peak film pressure, interpolated");
  s.p_max_phi = series("p_max_phi", "rad", "where: bearing angle");
  s.p_max_z = series("p_max_z", "m", "where: axial");
  s.p_max_node = series("p_max_node", "Pa", "largest nodal film pressure");
  s.force = series("force", "N", "film force on the shell, bearing frame", 3);
  s.force_pressure = series("force_pressure", "N", "its part from film pressure", 3);
  s.force_shear = series("force_shear", "N", "its part from shear", 3);
  s.force_asperity = series("force_asperity", "N", "its part from asperity contact", 3);
  s.moment = series("moment", "N.m", "film moment on the shell about the bearing's origin", 3);
  s.speed = series("speed", "rad/s", "journal's angular velocity relative to the shell");
  s.torque_journal = series("torque_journal", "N.m", "friction torque on the journal about its own axis");
  s.torque_shell = series("torque_shell", "N.m", "friction torque on the shell about its own axis");
  s.power_film = series("power_film", "W", "viscous dissipation in the film");
  s.power_asperity = series("power_asperity", "W", "boundary friction");
  s.power_stored = series("power_stored", "W", "rate of the energy in liner, asperities and compressed oil");
  s.power_oil = series("power_oil", "W", "taken along by oil over the edges less what feeds bring");
  s.power_into_bodies = series("power_into_bodies", "W", "film wrench times relative velocity (negative: taken)");
  s.power_error = series("power_error", "W", "put in by the bodies less dissipated, stored and carried out");
  s.flow_left = series("flow_left", "m^3/s", "oil leaving over the edge z = -L/2, mean of the step");
  s.flow_right = series("flow_right", "m^3/s", "oil leaving over the edge z = +L/2, mean of the step");
  s.flow_supply = series("flow_supply", "m^3/s", "oil entering through the supply, mean of the step");
  for (const film::SurfaceFeature& feature : film.features) {
    s.flow_features.push_back(series(("flow_feature_" + feature.name).c_str(), "m^3/s",
                                     "oil entering through this feature, mean of the step"));
  }
  s.storage_rate = series("storage_rate", "m^3/s", "rate of change of the oil volume in the film, mean of the step");
  s.oil_volume = series("oil_volume", "m^3", "oil volume in the film");
  if (!film::cavitation_law(film).loses_oil())
    s.mass_balance_error = series("mass_balance_error", "1",
                                  "oil of the step that is neither stored nor has passed, over the largest flow");
  s.oil_through_flow = series("oil_through_flow", "m^3", "oil that has passed the film since the start");
  s.oil_unexplained =
      series("oil_unexplained", "m^3", "growth of the oil volume since the start less what has come in");
  s.cavitated_share = series("cavitated_share", "1", "share of the area that is cavitated");
  s.rupture_angle = series("rupture_angle", "rad", "where the film at mid-width ruptures; NaN where it is whole");
  s.reformation_angle = series("reformation_angle", "rad", "where it re-forms; NaN where it is whole");
  s.film_iterations = series("film_iterations", "1", "film linearisations in the step");
  if (bearing.coupling.scheme == model::CouplingScheme::partitioned)
    s.exchanges =
        series("exchanges", "1", "wrenches that film and bodies exchanged in the step; 0: it was solved as one system");
  const auto around = [&](const char* name, const char* unit, const char* description) {
    return writer_.series(path + name, film.grid.n_phi, unit, description, results::Precision::float32,
                          path + "fields/phi");
  };
  s.h_min_around = around("h_min_around", "m", "smallest film thickness over the width at each angle of fields/phi");
  s.p_max_around = around("p_max_around", "Pa", "largest film pressure over the width at each angle of fields/phi");
  declare_fields(bearing, s);
  return s;
}

void Recorder::declare_fields(const model::Bearing& bearing, BearingSeries& s) {
  const std::string path = "/bearings/" + bearing.name + "/fields/";
  const film::Grid& grid = bearing.film.grid;
  const std::array<int, 2> shape{grid.n_phi, grid.n_z};
  const std::array<std::string, 2> nodes{path + "phi", path + "z"};
  s.field_time = writer_.series(path + "time", 1, "s", "time of the fields");
  s.pressure = writer_.field(path + "pressure", shape, "Pa", "film pressure", nodes);
  s.thickness = writer_.field(path + "thickness", shape, "m", "film thickness, depth of features included", nodes);
  s.fill = writer_.field(path + "fill", shape, "1", "fill fraction", nodes);
  s.asperity_pressure = writer_.field(path + "asperity_pressure", shape, "Pa", "asperity contact pressure", nodes);
  const film::FilmFields start = machine_.bearings[bearings_.size()].bearing->fields();
  const auto displacement = [&](const char* name, const char* whose) {
    return writer_.field(path + name, shape, "m", fmt::format("radial displacement of the {}, outward", whose), nodes);
  };
  if (start.d_shell.size() > 0) s.shell_displacement = displacement("shell_displacement", "shell's surface");
  if (start.d_journal.size() > 0) s.journal_displacement = displacement("journal_displacement", "journal's surface");
}

void Recorder::write_bearing(const BearingSeries& s, const bearing::BearingObservation& seen) const {
  const film::FilmObservables& film = seen.film;
  s.eccentricity.append(seen.position.e);
  s.ratio.append(seen.position.ratio());
  s.attitude.append(attitude(seen));
  s.tilt.append(seen.position.tilt);
  s.h_min.append(film.h_min);
  s.h_min_phi.append(film.h_min_phi);
  s.h_min_z.append(film.h_min_z);
  s.h_min_centre.append(film.h_min_centre);
  if (s.h_min_features) s.h_min_features->append(film.h_min_features);
  s.p_max.append(film.p_max);
  s.p_max_phi.append(film.p_max_phi);
  s.p_max_z.append(film.p_max_z);
  s.p_max_node.append(film.p_max_node);
  s.force.append(Vector3(seen.wrench_on_shell.tail<3>()));
  s.force_pressure.append(film.force_pressure);
  s.force_shear.append(film.force_shear);
  s.force_asperity.append(film.force_asperity);
  s.moment.append(Vector3(seen.wrench_on_shell.head<3>()));
  s.speed.append(seen.position.speed);
  s.torque_journal.append(film.torque_journal);
  s.torque_shell.append(film.torque_shell);
  s.power_film.append(film.power_film);
  s.power_asperity.append(film.power_asperity);
  s.power_stored.append(film.power_stored);
  s.power_oil.append(film.power_oil);
  s.power_into_bodies.append(seen.power_into_bodies);
  s.power_error.append(-seen.power_into_bodies - film.power_taken());
  s.flow_left.append(film.flow_left);
  s.flow_right.append(film.flow_right);
  s.flow_supply.append(film.flow_supply);
  for (std::size_t f = 0; f < s.flow_features.size(); ++f) {
    s.flow_features[f].append(film.flow_features[static_cast<Eigen::Index>(f)]);
  }
  s.storage_rate.append(film.storage_rate);
  s.oil_volume.append(film.oil_volume);
  if (s.mass_balance_error) s.mass_balance_error->append(film.mass_balance_error);
  s.oil_through_flow.append(seen.oil.through_flow);
  s.oil_unexplained.append(seen.oil.unexplained);
  s.cavitated_share.append(film.cavitated_share);
  s.rupture_angle.append(film.rupture_angle);
  s.reformation_angle.append(film.reformation_angle);
  s.film_iterations.append(seen.film_iterations);
  if (s.exchanges) s.exchanges->append(seen.exchanges);
}

// Over the width at each angle: index i n_z + j of a field is angle i, height j.
void Recorder::write_around(std::size_t bearing) const {
  const film::FilmFields fields = machine_.bearings[bearing].bearing->fields();
  const film::Grid& grid = model_.bearings[bearing].film.grid;
  const Eigen::VectorXd thickness = fields.thickness();
  using Map = Eigen::Map<const Eigen::MatrixXd>;
  const Eigen::VectorXd h = Map(thickness.data(), grid.n_z, grid.n_phi).colwise().minCoeff();
  const Eigen::VectorXd p = Map(fields.p.data(), grid.n_z, grid.n_phi).colwise().maxCoeff();
  bearings_[bearing].h_min_around.append(h);
  bearings_[bearing].p_max_around.append(p);
}

void Recorder::write_fields(const StepRecord& step) {
  for (std::size_t i = 0; i < bearings_.size(); ++i) {
    const film::FilmFields fields = machine_.bearings[i].bearing->fields();
    bearings_[i].field_time.append(step.mechanism.t);
    bearings_[i].pressure.append(fields.p);
    bearings_[i].thickness.append(fields.thickness());
    bearings_[i].fill.append(fields.theta);
    bearings_[i].asperity_pressure.append(fields.p_asperity);
    if (bearings_[i].shell_displacement) bearings_[i].shell_displacement->append(fields.d_shell);
    if (bearings_[i].journal_displacement) bearings_[i].journal_displacement->append(fields.d_journal);
  }
}

}  // namespace hersey::run
