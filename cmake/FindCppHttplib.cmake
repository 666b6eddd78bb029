# cpp-httplib (MIT), as Debian builds it, a shared library: imported target CppHttplib::CppHttplib. The macros are those
# of its build, which decide about the layout of its classes; its package brings the headers that they ask for.
find_path(CPPHTTPLIB_INCLUDE_DIR httplib.h)
find_library(CPPHTTPLIB_LIBRARY cpp-httplib)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CppHttplib REQUIRED_VARS CPPHTTPLIB_LIBRARY CPPHTTPLIB_INCLUDE_DIR)
if(CppHttplib_FOUND AND NOT TARGET CppHttplib::CppHttplib)
  add_library(CppHttplib::CppHttplib UNKNOWN IMPORTED)
  set_target_properties(
    CppHttplib::CppHttplib
    PROPERTIES IMPORTED_LOCATION ${CPPHTTPLIB_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${CPPHTTPLIB_INCLUDE_DIR}
               INTERFACE_COMPILE_DEFINITIONS "CPPHTTPLIB_OPENSSL_SUPPORT;CPPHTTPLIB_ZLIB_SUPPORT;CPPHTTPLIB_BROTLI_SUPPORT")
endif()
