# hersey_module(name [ONCE ALL|folders] [FUZZED ALL|paths] [DEPENDS modules] [LINK public libraries] [PRIVATE libraries])
#
# A module is libs/<name>: one static library with its own include root. It sees the headers of the modules it names
# and of those below them, and no others, so an include that runs up or sideways does not compile.
# Its tests, libs/<name>/test/*_test.cpp, become one executable, each case one test of ctest. Each of
# libs/<name>/fuzz/*_fuzz.cpp becomes the fuzzer <name>_<file>; the target `fuzzers` builds all of them.
#
# ONCE says that what the module does, or what lies in these folders of its src, is done once a run and not once a step:
# reading, writing, telling. clang then compiles it for size, in two thirds of the time
# (docs/decisions/0019-compilers.md).
#
# FUZZED says what fuzzers try of the module, or which files of its src, by how their paths begin. It is compiled once
# more for them, instrumented; the rest of a fuzzer is the program's own code.

# One precompiled header shared by all modules: standard library and Eigen only, never a module's own headers. What is
# compiled for size has one of its own, since compilers take none that other settings made.
function(hersey_precompiled_header target header)
  add_library(${target} OBJECT ${CMAKE_CURRENT_SOURCE_DIR}/cmake/pch.cpp)
  target_link_libraries(${target} PUBLIC $<BUILD_INTERFACE:hersey_options> Eigen3::Eigen)
  target_precompile_headers(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/cmake/${header})
  target_compile_options(${target} PRIVATE ${ARGN})
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    # clang's holds names of this clone's folders: the cache of compiled sources asks what it was made of instead.
    set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER ${CMAKE_CURRENT_SOURCE_DIR}/cmake/precompile)
  endif()
endfunction()
hersey_precompiled_header(hersey_pch pch.h)
set(HERSEY_PCH_ONCE hersey_pch)
set(HERSEY_PCH_TEST hersey_pch)
if(HERSEY_FOR_SIZE)
  hersey_precompiled_header(hersey_pch_once pch_for_size.h ${HERSEY_FOR_SIZE})
  set(HERSEY_PCH_ONCE hersey_pch_once)
endif()
if(HERSEY_FOR_TESTS AND BUILD_TESTING)
  hersey_precompiled_header(hersey_pch_test pch.h ${HERSEY_FOR_TESTS})
  set(HERSEY_PCH_TEST hersey_pch_test)
endif()
if(HERSEY_INSTRUMENTED)
  hersey_precompiled_header(hersey_pch_fuzzed pch.h ${HERSEY_INSTRUMENTED})
  set_target_properties(hersey_pch_fuzzed PROPERTIES EXCLUDE_FROM_ALL ON)
endif()

# What `target` does is done once a run: compiled for size, with the header precompiled so.
function(hersey_for_size target)
  hersey_settings(${target} ${HERSEY_PCH_ONCE} "${HERSEY_FOR_SIZE}")
endfunction()
# Its own options, and the precompiled header that was made with them.
function(hersey_settings target header options)
  target_compile_options(${target} PRIVATE ${options})
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE")
    # As position-independent as the modules, so that their precompiled header serves.
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    target_compile_options(${target} PRIVATE -fPIC)
  endif()
  target_precompile_headers(${target} REUSE_FROM ${header})
endfunction()

if(BUILD_TESTING)
  find_package(doctest REQUIRED)
  include(doctest)
  add_library(hersey_test_main STATIC ${CMAKE_CURRENT_SOURCE_DIR}/tests/main.cpp
                                      ${CMAKE_CURRENT_SOURCE_DIR}/tests/source_dir.cpp)
  set_source_files_properties(${CMAKE_CURRENT_SOURCE_DIR}/tests/source_dir.cpp PROPERTIES
                              COMPILE_DEFINITIONS HERSEY_SOURCE_DIR="${CMAKE_CURRENT_SOURCE_DIR}"
                              SKIP_UNITY_BUILD_INCLUSION ON)
  target_include_directories(hersey_test_main PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/tests/support)
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    # What is thrown is asked of expressions whose value nobody wants.
    target_compile_definitions(hersey_test_main PUBLIC DOCTEST_CONFIG_VOID_CAST_EXPRESSIONS)
  endif()
  target_link_libraries(hersey_test_main PUBLIC doctest::doctest $<BUILD_INTERFACE:hersey_options>)
endif()

if(HERSEY_INSTRUMENTED)
  add_custom_target(fuzzers)
else()
  add_custom_target(fuzzers COMMAND ${CMAKE_COMMAND} -E echo "fuzzers are built by clang, in the preset release" COMMAND false)
endif()

# Sources of the modules that HERSEY_UNITY_EXCEPT names are compiled one by one.
function(hersey_one_by_one target name)
  if(name IN_LIST HERSEY_UNITY_EXCEPT)
    set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
  endif()
endfunction()

# hersey_<name>_<part>: objects of some sources of the module `name`, to be compiled with settings of their own.
function(hersey_part name part)
  set(dir ${CMAKE_CURRENT_SOURCE_DIR}/libs/${name})
  add_library(hersey_${name}_${part} OBJECT ${ARGN})
  hersey_one_by_one(hersey_${name}_${part} ${name})
  target_include_directories(hersey_${name}_${part} PRIVATE ${dir}/src ${dir}/include)
  target_link_libraries(hersey_${name}_${part} PRIVATE $<TARGET_PROPERTY:hersey_${name},LINK_LIBRARIES> hersey_options)
endfunction()

# What fuzzers try of the module `name`, compiled for them, and its fuzzers: M_FUZZED, M_DEPENDS and M_PRIVATE are those
# of hersey_module.
function(hersey_fuzzers name)
  set(dir ${CMAKE_CURRENT_SOURCE_DIR}/libs/${name})
  set(instrumented "")
  foreach(below ${M_DEPENDS})
    get_target_property(theirs hersey_${below} HERSEY_FUZZED)
    list(APPEND instrumented ${theirs})
  endforeach()
  if(M_FUZZED)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${dir}/src/*.cpp)
    if(NOT M_FUZZED STREQUAL "ALL")
      list(JOIN M_FUZZED "|" paths)
      list(FILTER sources INCLUDE REGEX "^${dir}/src/(${paths})")
    endif()
    hersey_part(${name} fuzzed ${sources})
    hersey_settings(hersey_${name}_fuzzed hersey_pch_fuzzed "${HERSEY_INSTRUMENTED}")
    # Units of half the size: else one core waits for the largest. clang-tidy looks at the module's own.
    set_target_properties(hersey_${name}_fuzzed PROPERTIES EXCLUDE_FROM_ALL ON UNITY_BUILD_BATCH_SIZE 25
                                                           EXPORT_COMPILE_COMMANDS OFF)
    list(APPEND instrumented $<TARGET_OBJECTS:hersey_${name}_fuzzed>)
  endif()
  list(REMOVE_DUPLICATES instrumented)
  set_target_properties(hersey_${name} PROPERTIES HERSEY_FUZZED "${instrumented}")

  file(GLOB fuzzers CONFIGURE_DEPENDS ${dir}/fuzz/*_fuzz.cpp)
  foreach(source ${fuzzers})
    cmake_path(GET source STEM fuzzer)
    add_executable(${name}_${fuzzer} EXCLUDE_FROM_ALL ${source} ${instrumented})
    target_include_directories(${name}_${fuzzer} PRIVATE ${dir}/src)
    target_link_libraries(${name}_${fuzzer} PRIVATE hersey_${name} ${M_PRIVATE} $<BUILD_INTERFACE:hersey_options>)
    target_compile_options(${name}_${fuzzer} PRIVATE ${HERSEY_INSTRUMENTED})
    set_target_properties(${name}_${fuzzer} PROPERTIES EXPORT_COMPILE_COMMANDS OFF)
    # Of what is there twice, the linker keeps the first: the instrumented.
    target_link_options(${name}_${fuzzer} PRIVATE -fsanitize=fuzzer,address,undefined LINKER:-z,muldefs)
    add_dependencies(fuzzers ${name}_${fuzzer})
  endforeach()
endfunction()

set_property(GLOBAL PROPERTY HERSEY_MODULES "")

function(hersey_module name)
  cmake_parse_arguments(M "" "" "ONCE;FUZZED;DEPENDS;LINK;PRIVATE" ${ARGN})
  set(dir ${CMAKE_CURRENT_SOURCE_DIR}/libs/${name})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${dir}/src/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${dir}/include/hersey/${name}/*.h)
  file(GLOB tests CONFIGURE_DEPENDS ${dir}/test/*_test.cpp)
  if(NOT sources)
    file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/empty_${name}.cpp "")
    set(sources ${CMAKE_CURRENT_BINARY_DIR}/empty_${name}.cpp)
  endif()
  set(once "")
  if(HERSEY_FOR_SIZE AND M_ONCE AND NOT M_ONCE STREQUAL "ALL")
    list(JOIN M_ONCE "|" folders)
    set(once ${sources})
    list(FILTER once INCLUDE REGEX "^${dir}/src/(${folders})/")
    list(REMOVE_ITEM sources ${once})
  endif()
  add_library(hersey_${name} STATIC ${sources})
  add_library(hersey::${name} ALIAS hersey_${name})
  hersey_one_by_one(hersey_${name} ${name})
  target_compile_features(hersey_${name} PUBLIC cxx_std_20)
  set_target_properties(hersey_${name} PROPERTIES EXPORT_NAME ${name} LINKER_LANGUAGE CXX)
  target_sources(hersey_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${dir}/include FILES ${headers})
  target_include_directories(hersey_${name} PRIVATE ${dir}/src)
  set(modules ${name})  # this one and all below
  foreach(below ${M_DEPENDS})
    if(NOT TARGET hersey_${below})
      message(FATAL_ERROR "module ${name} depends on ${below}, which is not below it (docs/architecture.md)")
    endif()
    target_link_libraries(hersey_${name} PUBLIC hersey_${below})
    get_target_property(theirs hersey_${below} HERSEY_WITH_BELOW)
    list(APPEND modules ${theirs})
  endforeach()
  list(REMOVE_DUPLICATES modules)
  set_target_properties(hersey_${name} PROPERTIES HERSEY_WITH_BELOW "${modules}")
  target_link_libraries(hersey_${name} PUBLIC ${M_LINK} PRIVATE ${M_PRIVATE} $<BUILD_INTERFACE:hersey_options>)
  if(once)
    hersey_part(${name} once ${once})
    hersey_for_size(hersey_${name}_once)
    target_sources(hersey_${name} PRIVATE $<TARGET_OBJECTS:hersey_${name}_once>)
  endif()
  if(M_ONCE STREQUAL "ALL")
    hersey_for_size(hersey_${name})
  else()
    target_precompile_headers(hersey_${name} REUSE_FROM hersey_pch)
  endif()
  include(${dir}/module.cmake OPTIONAL)  # what only this module needs, such as generated sources
  install(TARGETS hersey_${name} EXPORT herseyTargets ARCHIVE COMPONENT dev FILE_SET HEADERS COMPONENT dev)
  set_property(GLOBAL APPEND PROPERTY HERSEY_MODULES ${name})

  if(HERSEY_INSTRUMENTED)
    hersey_fuzzers(${name})
  endif()

  if(BUILD_TESTING AND tests)
    add_executable(${name}_test ${tests})
    file(GLOB verification CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/verification/*.h)
    target_include_directories(${name}_test PRIVATE ${dir}/src ${CMAKE_CURRENT_SOURCE_DIR}/verification)
    target_link_libraries(${name}_test PRIVATE hersey_${name} hersey_test_main ${M_PRIVATE})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      # GCC 12 takes strings that are put together for copies into their short form.
      target_compile_options(${name}_test PRIVATE -Wno-stringop-overflow)
    endif()
    hersey_settings(${name}_test ${HERSEY_PCH_TEST} "${HERSEY_FOR_TESTS}")
    # Of a function that tests and modules both hold, the linker keeps the first copy: tests are to run what the program runs.
    get_target_property(modules hersey_${name} HERSEY_WITH_BELOW)
    list(TRANSFORM modules REPLACE "(.+)" "$<TARGET_FILE:hersey_\\1>")
    target_link_options(${name}_test PRIVATE LINKER:--whole-archive ${modules} LINKER:--no-whole-archive)
    # Each case is a test of its own, `<module>.<case>`; a filter that selects no case must not pass.
    doctest_discover_tests(${name}_test TEST_PREFIX "${name}." PROPERTIES FAIL_REGULAR_EXPRESSION "test cases: +0 [|]")
  endif()
endfunction()
