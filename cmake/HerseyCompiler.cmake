# How every target is compiled: C++20, warnings on, ccache where present, one precompiled header for all modules.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
# Every program lies in the build folder itself: build/release/hersey.
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
# Contracts stay on in release: a wrong answer costs more than a comparison.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
# Every branch taken is counted (make coverage): clang's own counting, by what stands in the sources.
set(CMAKE_CXX_FLAGS_COVERAGE "-O1 -fprofile-instr-generate -fcoverage-mapping")
set(CMAKE_EXE_LINKER_FLAGS_COVERAGE "-fprofile-instr-generate")
# How clang compiles what runs once rather than at every step (hersey_module's ONCE), what tests hold of their own, and
# what fuzzers try: these see which branches their input reaches, and every access is checked.
set(HERSEY_FOR_SIZE "")
set(HERSEY_FOR_TESTS "")
set(HERSEY_INSTRUMENTED "")
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang" AND CMAKE_BUILD_TYPE STREQUAL "Release")
  set(HERSEY_FOR_SIZE -Oz)
  set(HERSEY_FOR_TESTS -O0)
  set(HERSEY_INSTRUMENTED -O1 -gline-tables-only -fno-omit-frame-pointer -fsanitize=fuzzer-no-link,address,undefined
                          -fno-sanitize-recover=undefined)
elseif(CMAKE_BUILD_TYPE STREQUAL "Coverage")
  set(HERSEY_FOR_TESTS -O0)  # counted as well: what stands in headers runs in tests, too
endif()

find_program(HERSEY_CCACHE ccache)
if(HERSEY_CCACHE)
  # Relative paths below the source directory, so that a second clone finds what the first has compiled.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime CCACHE_PCH_EXTSUM=1 ${HERSEY_CCACHE})
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  # The driver's own option instead of the compiler's inner one that CMake passes: the cache knows it for a path.
  set(CMAKE_CXX_COMPILE_OPTIONS_USE_PCH -include-pch <PCH_FILE>)
endif()
# A module's sources wait for nothing that the modules below it are linked to.
set(CMAKE_OPTIMIZE_DEPENDENCIES ON)

add_library(hersey_options INTERFACE)
# Files are named from the source directory on, whatever it is: messages tell no one's folders, and objects are the same
# bytes in every clone.
target_compile_options(hersey_options INTERFACE -fmacro-prefix-map=${CMAKE_SOURCE_DIR}/=)
target_compile_options(hersey_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                                                -Woverloaded-virtual -Wcast-qual
                                                # Designated initialisers leave the rest to the members' own defaults.
                                                -Wno-missing-field-initializers)
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  target_compile_options(hersey_options INTERFACE -Wno-overlength-strings)  # the report's page is one string
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(hersey_options INTERFACE -fpch-preprocess)
  # GCC 12 reports false positives inside Eigen's and the standard library's inlined code.
  target_compile_options(hersey_options INTERFACE -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overread
                                                  -Wno-restrict)
endif()
# For whoever builds once: several sources at a time are compiled as one, in half the time. A changed source takes its
# neighbours along, so that who works on the code builds one by one.
if(HERSEY_UNITY)
  set(CMAKE_UNITY_BUILD ON)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE 50)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(hersey_options INTERFACE -Wno-subobject-linkage)  # what is in no header has one user still
  endif()
endif()
if(HERSEY_WERROR)
  target_compile_options(hersey_options INTERFACE -Werror)
endif()
target_compile_features(hersey_options INTERFACE cxx_std_20)
