#include "cycle_maps.h"

#include <array>
#include <string>

#include "film_nodes.h"

namespace hersey::run {
namespace {

template <class Series>
void append(const Series& series, const FilmExtreme& extreme) {
  series.value.append(extreme.value);
  series.t.append(extreme.t);
  series.phi.append(extreme.phi);
  series.z.append(extreme.z);
}

}  // namespace

CycleMaps::CycleMaps(const model::Model& model, const model::Machine& machine, results::Writer& writer)
    : machine_(machine) {
  series_.reserve(model.bearings.size());
  sums_.reserve(model.bearings.size());
  for (const model::Bearing& bearing : model.bearings) {
    series_.push_back(declare(bearing, writer));
    sums_.emplace_back(bearing.film);
  }
}

// A group called fields counts its rows by itself: cycles are no instants.
CycleMaps::BearingSeries CycleMaps::declare(const model::Bearing& bearing, results::Writer& writer) {
  write_film_nodes(bearing, writer);
  const std::string path = "/bearings/" + bearing.name + "/cycles/fields/";
  const auto series = [&](const std::string& name, const char* unit, const std::string& description) {
    return writer.series(path + name, 1, unit, description);
  };
  const auto extreme = [&](const std::string& name, const char* unit, const std::string& description) {
    return ExtremeSeries{.value = series(name, unit, description),
                         .t = series(name + "_time", "s", "when"),
                         .phi = series(name + "_phi", "rad", "where: bearing angle"),
                         .z = series(name + "_z", "m", "where: axial")};
  };
  const std::array<int, 2> shape{bearing.film.grid.n_phi, bearing.film.grid.n_z};
  const std::string fields = "/bearings/" + bearing.name + "/fields/";
  const std::array<std::string, 2> nodes{fields + "phi", fields + "z"};
  const auto map = [&](const char* name, const char* unit, const char* description) {
    return writer.field(path + name, shape, unit, description, nodes);
  };
  return {.begin = series("begin", "s", "time at the beginning of the cycle"),
          .end = series("end", "s", "time at its end"),
          .is_complete = series("complete", "1", "1: a cycle of the model; 0: the whole run"),
          .energy_film = series("energy_film", "J", "viscous dissipation in the film over the cycle"),
          .energy_asperity = series("energy_asperity", "J", "boundary friction over the cycle"),
          .power_film = series("power_film", "W", "viscous dissipation, mean over the cycle"),
          .power_asperity = series("power_asperity", "W", "boundary friction, mean over the cycle"),
          .moft = extreme("moft", "m", "minimum oil film thickness, edges included"),
          .pofp = extreme("pofp", "Pa", "peak oil film pressure, interpolated"),
          .contact = extreme("contact", "Pa", "largest contact pressure of a node"),
          .mean_contact = map("asperity_pressure_mean", "Pa", "contact pressure, mean over the cycle"),
          .wear_load = map("wear_load", "W/m^2", "contact pressure times sliding speed, mean over the cycle"),
          .h_min = map("thickness_min", "m", "smallest film thickness in the cycle"),
          .t_h_min = map("thickness_min_time", "s", "when"),
          .p_max = map("pressure_max", "Pa", "largest film pressure in the cycle"),
          .t_p_max = map("pressure_max_time", "s", "when")};
}

void CycleMaps::take(double t, const std::vector<bearing::BearingObservation>& seen) {
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i].take(t, seen[i], machine_.bearings[i].bearing->fields());
}

std::vector<BearingCycle> CycleMaps::close() { return write(true); }

void CycleMaps::finish() {
  if (rows_ == 0 && !sums_.empty() && sums_.front().duration() > 0) write(false);
}

void CycleMaps::persist(Archive& archive) {
  archive.io("rows", rows_);
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    const Archive::Group group(archive, machine_.bearings[i].bearing->name());
    sums_[i].persist(archive);
  }
}

std::vector<BearingCycle> CycleMaps::write(bool is_complete) {
  std::vector<BearingCycle> cycles;
  cycles.reserve(sums_.size());
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    const BearingCycle& cycle = cycles.emplace_back(sums_[i].close());
    const BearingSeries& s = series_[i];
    const double duration = cycle.duration();
    s.begin.append(cycle.begin);
    s.end.append(cycle.end);
    s.is_complete.append(is_complete ? 1 : 0);
    s.energy_film.append(cycle.energy_film);
    s.energy_asperity.append(cycle.energy_asperity);
    s.power_film.append(duration > 0 ? cycle.energy_film / duration : 0);
    s.power_asperity.append(duration > 0 ? cycle.energy_asperity / duration : 0);
    append(s.moft, cycle.moft);
    append(s.pofp, cycle.pofp);
    append(s.contact, cycle.contact);
    s.mean_contact.append(cycle.mean_contact);
    s.wear_load.append(cycle.wear_load);
    s.h_min.append(cycle.h_min);
    s.t_h_min.append(cycle.t_h_min);
    s.p_max.append(cycle.p_max);
    s.t_p_max.append(cycle.t_p_max);
  }
  ++rows_;
  return cycles;
}

}  // namespace hersey::run
