#include "schema/film_vocabulary.h"
#include "schema/format.h"

namespace hersey::model {

TypePtr thermal_network_format() {
  return object("a thermal network",
                {
                    optional("walls", choice(thermal_walls_words),
                             "What walls that warm (`ring`, `free` and `node`) do in a simulation.",
                             "cycle_mean of a machine with cycles, transient of others"),
                });
}

}  // namespace hersey::model
