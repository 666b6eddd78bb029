# The models of `hersey init` are part of the program.
set(models "")
foreach(model bearing hydrostatic tilting_pads thrust tilting_thrust floating_ring damper skirt rotor big_end engine turbocharger flexible_rod)
  set(file ${dir}/starting_models/${model}.yaml)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} text)
  string(APPEND models "      {\"${model}\", R\"yaml(${text})yaml\"},\n")
endforeach()
set(starting_models ${CMAKE_CURRENT_BINARY_DIR}/starting_models.cpp)
file(CONFIGURE OUTPUT ${starting_models} @ONLY CONTENT [=[#include "hersey/session/starting_models.h"

namespace hersey::session {

const std::vector<StartingModel>& starting_models() {
  static const std::vector<StartingModel> models{
@models@  };
  return models;
}

}  // namespace hersey::session
]=])
target_sources(hersey_session PRIVATE ${starting_models})
