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
# So are the recipes of `hersey recipes`, which are pages of the documentation as well.
set(recipes "")
foreach(recipe size-a-bearing hot-bearing big-end rotor-stability coefficients mend-a-model trust-a-result study read-results long-run)
  set(file ${PROJECT_SOURCE_DIR}/docs/recipes/${recipe}.md)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} text)
  string(APPEND recipes "      {\"${recipe}\", R\"md(${text})md\"},\n")
endforeach()
set(recipes_source ${CMAKE_CURRENT_BINARY_DIR}/recipes.cpp)
file(CONFIGURE OUTPUT ${recipes_source} @ONLY CONTENT [=[#include "hersey/session/recipes.h"

namespace hersey::session {

const std::vector<Recipe>& recipes() {
  static const std::vector<Recipe> all{
@recipes@  };
  return all;
}

}  // namespace hersey::session
]=])
target_sources(hersey_session PRIVATE ${recipes_source})
