# HDF5's C library, serial (BSD): imported target HDF5::HDF5. CMake's own FindHDF5 compiles C programs to find it, which a
# consumer of this package that has enabled C++ only cannot do. Functions are those of version 1.10, Debian 12's, which later
# versions keep for who asks for them.
find_path(HDF5C_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial)
find_library(HDF5C_LIBRARY NAMES hdf5_serial hdf5 PATH_SUFFIXES hdf5/serial)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(HDF5C REQUIRED_VARS HDF5C_LIBRARY HDF5C_INCLUDE_DIR)
if(HDF5C_FOUND AND NOT TARGET HDF5::HDF5)
  add_library(HDF5::HDF5 UNKNOWN IMPORTED)
  set_target_properties(HDF5::HDF5 PROPERTIES IMPORTED_LOCATION ${HDF5C_LIBRARY}
                                              INTERFACE_INCLUDE_DIRECTORIES ${HDF5C_INCLUDE_DIR}
                                              INTERFACE_COMPILE_DEFINITIONS H5_USE_110_API)
endif()
