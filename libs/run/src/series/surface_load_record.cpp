#include "series/surface_load_record.h"

namespace hersey::run {

const QuantityTable<mbd::ElasticLoad, SurfaceLoadRecord::Plan>& SurfaceLoadRecord::table() {
  using Load = mbd::ElasticLoad;
  static const QuantityTable<Load, Plan> table{
      {"force", "N", "resultant, ground axes", [](const Load& load) { return Vector3(load.wrench.tail<3>()); }},
      {"moment", "N.m", "about the body's origin, ground axes",
       [](const Load& load) { return Vector3(load.wrench.head<3>()); }},
      {"power", "W", "put into the machine", &Load::power},
  };
  return table;
}

const std::vector<Attribute<SurfaceLoadRecord::Plan>>& SurfaceLoadRecord::attributes() {
  static const std::vector<Attribute<Plan>> table{{"body", "", "on whose mesh it acts", [](const Plan& plan) {
                                                     return plan.machine.flexibles[plan.load.flexible].name;
                                                   }}};
  return table;
}

SurfaceLoadRecord::SurfaceLoadRecord(const model::Machine& machine, results::Writer& writer) : machine_(machine) {
  for (const model::BuiltSurfaceLoad& load : machine.surface_loads) {
    const std::string group = "/surface_loads/" + load.name + "/";
    const Plan plan{machine, load};
    write_once(attributes(), group, plan, writer);
    loads_.emplace_back(table(), group, plan, writer);
  }
}

void SurfaceLoadRecord::append(const mbd::Observation& observation) const {
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    const model::BuiltSurfaceLoad& load = machine_.surface_loads[i];
    const auto elastic = static_cast<std::size_t>(machine_.flexibles[load.flexible].elastic.index);
    mbd::ElasticLoad sum;
    for (std::size_t k = 0; k < load.count; ++k) {
      const mbd::ElasticLoad& part = observation.elastics[elastic].energy.loads[load.first + k];
      sum.power += part.power;
      sum.wrench += part.wrench;
    }
    loads_[i].append(sum);
  }
}

QuantityGroup SurfaceLoadRecord::describe() {
  QuantityGroup group{.path = "/surface_loads/<f>/",
                      .heading = "of a `pressure` or `surface_force` on the mesh of a flexible body",
                      .quantities = {}};
  run::describe(attributes(), "n", group);
  run::describe(table(), "n", group);
  return group;
}

}  // namespace hersey::run
