#include "cycle/cycle_maps.h"

#include <string>
#include <variant>

#include "hersey/bearing/film_coordinates.h"

namespace hersey::run {
namespace {

using Statistic = SummaryEntry::Statistic;
using Only = SummaryEntry::Only;
using CycleLine = Quantity<CycleRow, model::Bearing>;
using CycleTable = QuantityTable<CycleRow, model::Bearing>;

template <class Member>
auto of_cycle(Member member) {
  return [member](const CycleRow& row) { return std::invoke(member, row.cycle); };
}

bool is_of_plane(const model::Bearing& bearing) { return !film::is_round(bearing.film.surface); }
bool is_of_annulus(const model::Bearing& bearing) { return bearing::is_on_annulus(bearing.film); }
bool has_axial_place(const model::Bearing& bearing) { return !is_of_annulus(bearing); }
bool is_of_skirt(const model::Bearing& bearing) { return std::holds_alternative<film::Skirt>(bearing.film.surface); }
bool is_of_angle(const model::Bearing& bearing) { return !is_of_plane(bearing); }

/// Energy over the cycle's duration.
auto mean_power(double BearingCycle::*energy) {
  return [energy](const CycleRow& row) {
    const double duration = row.cycle.duration();
    return duration > 0 ? row.cycle.*energy / duration : 0;
  };
}

/// Four lines: the value, when and where.
void add_extreme(const std::string& name, const char* unit, const char* text, FilmExtreme BearingCycle::*extreme,
                 const SummaryEntry& summary_entry, CycleTable& table) {
  const auto of = [extreme](double FilmExtreme::*member) {
    return [extreme, member](const CycleRow& row) { return row.cycle.*extreme.*member; };
  };
  table.push_back({name, unit, text, of(&FilmExtreme::value), {.summary_entries = {summary_entry}}});
  table.push_back({name + "_time", "s", "when", of(&FilmExtreme::t)});
  table.push_back({name + "_phi", "rad", "where: bearing angle", of(&FilmExtreme::phi), {.only = is_of_angle}});
  table.push_back({name + "_y",
                   "m",
                   "where: along the sliding direction",
                   of(&FilmExtreme::phi),
                   {.note = "of a plane slider", .only = is_of_plane}});
  table.push_back({name + "_z", "m", "where: axial", of(&FilmExtreme::z), {.only = has_axial_place}});
  table.push_back({name + "_r",
                   "m",
                   "where: radius",
                   [extreme](const CycleRow& row) { return row.radius + (row.cycle.*extreme).z; },
                   {.note = "of a thrust bearing", .only = is_of_annulus}});
}

CycleLine map_line(const char* name, const char* unit, const char* text, Eigen::VectorXd BearingCycle::*values,
                   const char* note = "", std::vector<SummaryEntry> summary_entries = {}) {
  return {name,
          unit,
          text,
          of_cycle(values),
          {.note = note,
           .extent = {"n_phi, n_z",
                      [](const model::Bearing& bearing, std::size_t /*k*/) {
                        return std::vector{bearing.film.grid.n_phi, bearing.film.grid.n_z};
                      },
                      {"../../fields/phi", "../../fields/z"},
                      [](const model::Bearing& bearing) {
                        return std::vector<std::string>{
                            is_of_plane(bearing) ? "../../fields/y" : "../../fields/phi",
                            bearing::is_on_annulus(bearing.film) ? "../../fields/r" : "../../fields/z"};
                      }},
           .summary_entries = std::move(summary_entries)}};
}

const CycleTable& cycle_quantities() {
  static const CycleTable table = [] {
    using C = BearingCycle;
    CycleTable lines{
        {"begin", "s", "time at the beginning of the cycle", of_cycle(&C::begin)},
        {"end", "s", "time at its end", of_cycle(&C::end)},
        {"complete", "1", "1: a cycle of the model; 0: the whole run", &CycleRow::is_complete},
    };
    add_extreme("moft", "m", "minimum oil film thickness, edges included", &C::moft,
                {Statistic::at_end, "minimum film thickness (MOFT)", "µm", true, Only::of_a_cycle}, lines);
    add_extreme("pofp", "Pa", "peak oil film pressure, interpolated", &C::pofp,
                {Statistic::at_end, "peak film pressure (POFP)", "MPa", true, Only::of_a_cycle}, lines);
    lines.insert(
        lines.end(),
        {{"energy_film",
          "J",
          "viscous dissipation in the film over the cycle",
          of_cycle(&C::energy_film),
          {.summary_entries = {{Statistic::at_end, "energy lost in the film", "J"}}}},
         {"energy_asperity",
          "J",
          "boundary friction over the cycle",
          of_cycle(&C::energy_asperity),
          {.summary_entries = {{Statistic::at_end, "energy lost in asperity contact", "J"}}}},
         {"power_film",
          "W",
          "viscous dissipation, mean over the cycle",
          mean_power(&C::energy_film),
          {.summary_entries = {{Statistic::at_end, "mean power loss in the film", "W", false, Only::of_a_cycle}}}},
         {"power_asperity",
          "W",
          "boundary friction, mean over the cycle",
          mean_power(&C::energy_asperity),
          {.summary_entries = {
               {Statistic::at_end, "mean power loss in asperity contact", "W", false, Only::of_a_cycle}}}}});
    lines.insert(lines.end(),
                 {{"stroke",
                   "m",
                   "way between the skirt's extreme places along the liner",
                   of_cycle(&C::stroke),
                   {.note = "this and the following: of `kind: skirt`", .only = is_of_skirt}},
                  {"friction_mean_effective_pressure",
                   "Pa",
                   "energy lost in film and contact of the skirt over the displaced volume",
                   [](const CycleRow& row) { return row.cycle.friction_mean_effective_pressure(row.radius); },
                   {.only = is_of_skirt,
                    .summary_entries = {{Statistic::at_end, "friction mean effective pressure of the skirt", "bar",
                                         false, Only::of_a_cycle}}}}});
    add_extreme("contact", "Pa", "largest contact pressure of a node", &C::contact,
                {Statistic::at_end, "largest contact pressure", "MPa", true, Only::with_contact}, lines);
    const auto of_hot_film = [](const model::Bearing& bearing) {
      return std::holds_alternative<film::ThermalModel>(bearing.heat);
    };
    lines.insert(
        lines.end(),
        {{"T_max",
          "degC",
          "hottest oil",
          [](const CycleRow& row) { return row.cycle.hottest.value - film::zero_celsius; },
          {.note = "this and the following: of films with `thermal: {model: film}`",
           .only = of_hot_film,
           .summary_entries = {{Statistic::at_end, "hottest oil", "°C", true, Only::of_a_cycle}}}},
         {"T_max_time", "s", "when", [](const CycleRow& row) { return row.cycle.hottest.t; }, {.only = of_hot_film}},
         {"T_max_phi",
          "rad",
          "where: bearing angle",
          [](const CycleRow& row) { return row.cycle.hottest.phi; },
          {.only = of_hot_film}},
         {"T_max_z",
          "m",
          "where: axial",
          [](const CycleRow& row) { return row.cycle.hottest.z; },
          {.only = of_hot_film}},
         {"wall_correction",
          "K",
          "by how much walls with the temperature of the cycle's mean heat were off",
          [](const CycleRow& row) { return row.cycle.walls.largest; },
          {.only = of_hot_film,
           .summary_entries = {
               {Statistic::at_end, "correction of wall temperatures", "K", false, Only::of_a_cycle}}}}});
    const auto with_largest_of_map = [](const char* name, const char* unit) {
      return std::vector<SummaryEntry>{{Statistic::largest, name, unit, true, Only::with_contact}};
    };
    lines.insert(lines.end(),
                 {map_line("asperity_pressure_mean", "Pa", "contact pressure, mean over the cycle", &C::mean_contact,
                           "", with_largest_of_map("largest mean contact pressure", "MPa")),
                  map_line("wear_load", "W/m^2", "contact pressure times sliding speed, mean over the cycle",
                           &C::wear_load, "times the friction coefficient it is the mean heat of contact",
                           with_largest_of_map("largest wear load", "W/mm²")),
                  map_line("thickness_min", "m", "smallest film thickness in the cycle", &C::h_min, "MOFT map"),
                  map_line("thickness_min_time", "s", "when", &C::t_h_min),
                  map_line("pressure_max", "Pa", "largest film pressure in the cycle", &C::p_max, "POFP map"),
                  map_line("pressure_max_time", "s", "when", &C::t_p_max)});
    return lines;
  }();
  return table;
}

// A group called fields counts its own rows, because cycles are not instants.
const char* const group_of_cycles = "cycles/fields/";

}  // namespace

CycleMaps::CycleMaps(const model::Model& model, const model::Machine& machine, results::Writer& writer)
    : machine_(machine) {
  for (const model::Bearing& bearing : model.bearings) {
    series_.emplace_back(cycle_quantities(), "/bearings/" + bearing.name + "/" + group_of_cycles, bearing, writer);
    sums_.emplace_back(bearing.film);
  }
}

void CycleMaps::take(double t, const std::vector<bearing::BearingObservation>& observation) {
  for (std::size_t i = 0; i < sums_.size(); ++i)
    sums_[i].take(t, observation[i], machine_.bearings[i].bearing->fields());
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
    series_[i].append({cycle, is_complete, machine_.bearings[i].bearing->model().R});
  }
  ++rows_;
  return cycles;
}

QuantityGroup CycleMaps::describe() {
  QuantityGroup group{.path = std::string("/bearings/<b>/") + group_of_cycles,
                      .heading =
                          "of a bearing's cycles: one row per complete cycle of the machine; without one, a single row "
                          "over the whole run",
                      .quantities = {}};
  run::describe(cycle_quantities(), "c", group);
  return group;
}

}  // namespace hersey::run
