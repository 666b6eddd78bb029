# cmake -DINPUT=page.html -DOUTPUT=page.cpp -P embed_page.cmake: a text file as a C++ raw string literal.
file(READ ${INPUT} page)
set(delimiter hersey_page)
string(FIND "${page}" ")${delimiter}\"" clash)
if(NOT clash EQUAL -1)
  message(FATAL_ERROR "${INPUT} contains the delimiter )${delimiter}\"")
endif()
file(WRITE ${OUTPUT} "// Generated from ${INPUT}.
#include \"report_page.h\"

namespace hersey::report {

std::string_view report_page() {
  // Its length is left to the compiler: counting it in a constant expression would exceed that one's limits.
  static const char page[] = R\"${delimiter}(")
file(APPEND ${OUTPUT} "${page}")
file(APPEND ${OUTPUT} ")${delimiter}\";
  return {page, sizeof page - 1};
}

}  // namespace hersey::report
")
