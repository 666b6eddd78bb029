# cpp-httplib (MIT): imported target CppHttplib::CppHttplib. Debian builds it as a shared library; the macros are those of
# that build, which decide about the layout of its classes; its package brings the headers that they ask for. Elsewhere,
# as in conda-forge, it is its header alone.
find_path(CPPHTTPLIB_INCLUDE_DIR httplib.h)
find_library(CPPHTTPLIB_LIBRARY cpp-httplib)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CppHttplib REQUIRED_VARS CPPHTTPLIB_INCLUDE_DIR)
if(CppHttplib_FOUND AND NOT CPPHTTPLIB_LIBRARY AND NOT TARGET CppHttplib::CppHttplib)
  find_package(Threads REQUIRED)
  add_library(CppHttplib::CppHttplib INTERFACE IMPORTED)
  target_include_directories(CppHttplib::CppHttplib INTERFACE ${CPPHTTPLIB_INCLUDE_DIR})
  target_link_libraries(CppHttplib::CppHttplib INTERFACE Threads::Threads)
elseif(CppHttplib_FOUND AND NOT TARGET CppHttplib::CppHttplib)
  add_library(CppHttplib::CppHttplib UNKNOWN IMPORTED)
  set_target_properties(
    CppHttplib::CppHttplib
    PROPERTIES IMPORTED_LOCATION ${CPPHTTPLIB_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${CPPHTTPLIB_INCLUDE_DIR}
               INTERFACE_COMPILE_DEFINITIONS "CPPHTTPLIB_OPENSSL_SUPPORT;CPPHTTPLIB_ZLIB_SUPPORT;CPPHTTPLIB_BROTLI_SUPPORT")
endif()
