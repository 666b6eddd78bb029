# `cmake --install` puts libraries, headers and program in place; `find_package(hersey)` finds them.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/hersey)
install(EXPORT herseyTargets NAMESPACE hersey:: DESTINATION ${package_dir} COMPONENT dev)
configure_package_config_file(${CMAKE_CURRENT_SOURCE_DIR}/cmake/herseyConfig.cmake.in
                              ${CMAKE_CURRENT_BINARY_DIR}/herseyConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/herseyConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(DIRECTORY python/hersey_study DESTINATION share/hersey/python COMPONENT program
        PATTERN __pycache__ EXCLUDE)
install(FILES LICENSE THIRD_PARTY.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
foreach(page report workbench)  # notices of the packages in its page
  install(FILES libs/${page}/assets/licences.txt DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME licences-${page}.txt
          COMPONENT program)
endforeach()
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/herseyConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/herseyConfigVersion.cmake
              cmake/FindHDF5C.cmake cmake/FindKLU.cmake cmake/FindMUMPS.cmake
              cmake/FindUdunits2.cmake cmake/FindCppHttplib.cmake
        DESTINATION ${package_dir} COMPONENT dev)
