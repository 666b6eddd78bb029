# Debian packages by `cpack` (scripts/package): hersey (program, manual, examples, site), libhersey-dev (libraries, headers) and
# python3-hersey.
# What is generated lies in packaging/ of the build folder; `scripts/package` puts it there before it calls cpack.
set(generated ${CMAKE_CURRENT_BINARY_DIR}/packaging)
install(DIRECTORY ${generated}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program OPTIONAL)
install(FILES ${generated}/completion/hersey DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        COMPONENT program OPTIONAL)
install(FILES ${generated}/completion/_hersey DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program OPTIONAL)
install(FILES ${generated}/completion/hersey.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
        COMPONENT program OPTIONAL)
install(DIRECTORY ${generated}/doc/hersey/ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program OPTIONAL)
install(DIRECTORY ${generated}/doc/libhersey-dev DESTINATION ${CMAKE_INSTALL_DATADIR}/doc COMPONENT dev OPTIONAL)
install(DIRECTORY ${generated}/doc/python3-hersey DESTINATION ${CMAKE_INSTALL_DATADIR}/doc COMPONENT python OPTIONAL)
install(DIRECTORY ${generated}/python/hersey DESTINATION lib/python3/dist-packages COMPONENT python OPTIONAL)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program
        PATTERN "*.h5" EXCLUDE PATTERN "results" EXCLUDE PATTERN "__pycache__" EXCLUDE)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME hersey)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "oil-film journal bearings inside moving machines")
set(CPACK_PACKAGE_VENDOR "the hersey developers")
set(CPACK_PACKAGE_CONTACT "The hersey developers <maintainers@hersey.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME hersey)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "python3-scipy, python3-openturns, python3-nlopt, python3-h5py, gmsh")  # hersey study; hersey mesh of CAD files
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "xdg-utils")  # hersey open
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "hersey solves oil films and the mechanisms they carry together: film thickness,
pressure, friction, oil flow, heat and contact of bearings whose shell and
journal belong to rigid or elastic bodies that move.
.
A model is one YAML file with units; a run leaves an HDF5 file and a report,
one HTML page that opens in any browser.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libhersey-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
    "libeigen3-dev (>= 3.4), libfmt-dev (>= 9), libyaml-cpp-dev (>= 0.7), nlohmann-json3-dev, libmuparser-dev, libhdf5-dev, liblzma-dev, libexpat1-dev, zlib1g-dev, libsuitesparse-dev, libmumps-seq-dev, libopenblas0-pthread, libudunits2-dev, libcpp-httplib-dev")
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "cmake (>= 3.24)")
set(CPACK_COMPONENT_DEV_DESCRIPTION "Static libraries and headers: what the program hersey is made of,
for programs of one's own;
oil films, mechanisms, elastic bodies, models and runs as C++20 libraries.
.
CMake finds them by find_package(hersey).")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-hersey)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy, python3-h5py")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-xarray, python3-h5netcdf, python3-pandas, python3-matplotlib, python3-tqdm")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "The Python package: models are loaded, changed by key and solved,
runs started and
their results read as arrays with names and units.")
include(CPack)
