# The report's page, built by web/ and committed, becomes a string of this library.
set(report_page ${dir}/assets/report.html)
set(report_page_source ${CMAKE_CURRENT_BINARY_DIR}/hersey_report_page.cpp)
add_custom_command(
  OUTPUT ${report_page_source}
  COMMAND ${CMAKE_COMMAND} -DINPUT=${report_page} -DOUTPUT=${report_page_source} -P ${dir}/embed_page.cmake
  DEPENDS ${report_page} ${dir}/embed_page.cmake
  COMMENT "Embedding the report's page"
  VERBATIM)
target_sources(hersey_report PRIVATE ${report_page_source})
