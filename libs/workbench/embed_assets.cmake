# cmake -DFOLDER=assets -DOUTPUT=assets.cpp -P embed_assets.cmake: the page's text files as C++ raw string literals.
set(delimiter hersey_page)
file(WRITE ${OUTPUT} "// Generated from ${FOLDER}.
#include \"server/assets.h\"

namespace hersey::workbench {

Asset asset(std::string_view path) {
")
foreach(entry "/|index.html|text/html; charset=utf-8" "/workbench.js|workbench.js|text/javascript; charset=utf-8"
        "/workbench.css|workbench.css|text/css; charset=utf-8" "/licences.txt|licences.txt|text/plain; charset=utf-8")
  string(REGEX MATCH "([^|]+)[|]([^|]+)[|](.+)" ignored "${entry}")
  set(path ${CMAKE_MATCH_1})
  set(type "${CMAKE_MATCH_3}")
  file(READ ${FOLDER}/${CMAKE_MATCH_2} content)
  string(FIND "${content}" ")${delimiter}\"" clash)
  if(NOT clash EQUAL -1)
    message(FATAL_ERROR "${FOLDER}/${CMAKE_MATCH_2} contains the delimiter )${delimiter}\"")
  endif()
  file(APPEND ${OUTPUT} "  if (path == \"${path}\") {
    // Its length is left to the compiler: counting it in a constant expression would exceed that one's limits.
    static const char text[] = R\"${delimiter}(")
  file(APPEND ${OUTPUT} "${content}")
  file(APPEND ${OUTPUT} ")${delimiter}\";
    return {{text, sizeof text - 1}, \"${type}\"};
  }
")
endforeach()
file(APPEND ${OUTPUT} "  return {};
}

}  // namespace hersey::workbench
")
