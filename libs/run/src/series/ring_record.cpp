#include "series/ring_record.h"

#include "cycle/engine_friction.h"

namespace hersey::run {

const QuantityTable<RingRecord::Row, model::BuiltRing>& RingRecord::table() {
  static const QuantityTable<Row, model::BuiltRing> table{
      {"friction_force",
       "N",
       "friction force on the piston along the liner's z-axis",
       &Row::friction_force,
       {.note = "this and the following: of a `piston_ring`",
        .summary_entries =
            {{.statistic = SummaryEntry::Statistic::largest_in_size, .name = "largest friction force", .unit = "N"}}}},
      {"radial_load",
       "N",
       "by which tension and gas press the whole ring against the liner",
       &Row::radial_load,
       {.summary_entries =
            {{.statistic = SummaryEntry::Statistic::largest, .name = "largest radial load", .unit = "N"}}}},
      {"friction_power",
       "W",
       "taken by the ring's friction",
       &Row::power,
       {.summary_entries = {{.statistic = SummaryEntry::Statistic::mean, .name = "mean friction power", .unit = "W"}}}},
  };
  return table;
}

RingRecord::RingRecord(const model::BuiltRing& ring, results::Writer& writer)
    : ring_(ring), rows_(table(), "/forces/" + ring.name + "/", ring, writer) {}

void RingRecord::append(const mbd::Observation& observation) const {
  rows_.append({.friction_force = observation.force_wrenches[static_cast<std::size_t>(ring_.force.index)][5],
                .radial_load = ring_.ring->radial_load(observation.t),
                .power = ring_power(ring_, observation)});
}

void RingRecord::describe(QuantityGroup& group) { run::describe(table(), "n", group); }

}  // namespace hersey::run
