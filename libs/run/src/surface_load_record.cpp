// Pressures and forces on the meshes of flexible bodies, in the results file.
#include "recorder.h"

namespace hersey::run {

void Recorder::declare_surface_loads() {
  for (const model::BuiltSurfaceLoad& load : machine_.surface_loads) {
    const std::string path = "/surface_loads/" + load.name + "/";
    writer_.attribute("/surface_loads/" + load.name, "body", machine_.flexibles[load.flexible].name);
    surface_loads_.push_back({writer_.series(path + "force", 3, "N", "resultant, ground axes"),
                              writer_.series(path + "moment", 3, "N.m", "about the body's origin, ground axes"),
                              writer_.series(path + "power", 1, "W", "put into the machine")});
  }
}

void Recorder::write_surface_loads(const mbd::Observation& seen) {
  for (std::size_t i = 0; i < surface_loads_.size(); ++i) {
    const model::BuiltSurfaceLoad& load = machine_.surface_loads[i];
    const auto elastic = static_cast<std::size_t>(machine_.flexibles[load.flexible].elastic.index);
    mbd::ElasticLoad sum;
    for (std::size_t k = 0; k < load.count; ++k) {
      const mbd::ElasticLoad& part = seen.elastics[elastic].energy.loads[load.first + k];
      sum.power += part.power;
      sum.wrench += part.wrench;
    }
    surface_loads_[i].force.append(Vector3(sum.wrench.tail<3>()));
    surface_loads_[i].moment.append(Vector3(sum.wrench.head<3>()));
    surface_loads_[i].power.append(sum.power);
  }
}

}  // namespace hersey::run
