# The page, built by web/ and committed, becomes strings of this library.
set(workbench_assets ${dir}/assets)
set(workbench_assets_source ${CMAKE_CURRENT_BINARY_DIR}/hersey_workbench_assets.cpp)
add_custom_command(
  OUTPUT ${workbench_assets_source}
  COMMAND ${CMAKE_COMMAND} -DFOLDER=${workbench_assets} -DOUTPUT=${workbench_assets_source} -P ${dir}/embed_assets.cmake
  DEPENDS ${workbench_assets}/index.html ${workbench_assets}/workbench.js ${workbench_assets}/workbench.css
          ${workbench_assets}/licences.txt ${dir}/embed_assets.cmake
  COMMENT "Embedding the workbench's page"
  VERBATIM)
target_sources(hersey_workbench PRIVATE ${workbench_assets_source})
# cpp-httplib's header is large and declares what no other source should see: its only user is compiled by itself.
set_source_files_properties(${dir}/src/server/http_server.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
