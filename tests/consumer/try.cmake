# cmake -D BUILD_DIR=dir -D WORK=dir -D COMPILER=c++ -D "LAUNCHER=command|..." -D SOURCE=dir -P try.cmake
#
# Installs the build into a fresh prefix and builds and runs a program that finds hersey there and nowhere else.
# LAUNCHER: what the compiler is started by, if anything.
cmake_minimum_required(VERSION 3.24)
set(prefix ${WORK}/prefix)
file(REMOVE_RECURSE ${WORK})

# Runs one command; a failure ends the test with everything it said.
function(must_work)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# Not optimised: what counts is that it compiles, links and finds what it needs.
string(REPLACE "|" ";" LAUNCHER "${LAUNCHER}")
set(ENV{CMAKE_CXX_COMPILER_LAUNCHER} "${LAUNCHER}")
function(must_build source folder)
  must_work(${CMAKE_COMMAND} -S ${source} -B ${folder} -G Ninja -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=-O0 -DNDEBUG"
            -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${COMPILER})
  must_work(${CMAKE_COMMAND} --build ${folder})
endfunction()

must_work(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
must_work(${prefix}/bin/hersey --version)
foreach(file LICENSE THIRD_PARTY.md)
  if(NOT EXISTS ${prefix}/share/doc/hersey/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
must_build(${SOURCE} ${WORK}/build)
must_work(${WORK}/build/consumer)
if(NOT output MATCHES "peak pressure [1-9]\\.[0-9]+ MPa")
  message(FATAL_ERROR "the consumer printed: ${output}")
endif()
message(STATUS "${output}")

# The programs of docs/cpp-library.md: they stand there as they are here, and do what the page says.
set(programs ${SOURCE}/../../examples/cpp_library)
file(READ ${SOURCE}/../../docs/cpp-library.md page)
foreach(file bearing.cpp mechanism.cpp rotor.cpp run.cpp CMakeLists.txt)
  file(READ ${programs}/${file} text)
  string(FIND "${page}" "${text}" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "docs/cpp-library.md does not show examples/cpp_library/${file} as it is")
  endif()
endforeach()
must_build(${programs} ${WORK}/programs)
function(must_print pattern)
  must_work(${ARGN})
  if(NOT output MATCHES "${pattern}")
    message(FATAL_ERROR "${ARGN} printed: ${output}")
  endif()
endfunction()
must_print("eccentricity ratio +0\\.[0-9]+\nthinnest film +[0-9.]+ um" ${WORK}/programs/bearing)
must_print("swings: 0\\.(0999|1000) rad" ${WORK}/programs/mechanism)
must_print("film [0-9.]+ um, at the end [0-9.]+ um" ${WORK}/programs/rotor ${programs}/rotor.yaml)
must_print("^[0-9]+ steps, results in .*rotor.h5" ${WORK}/programs/run ${programs}/rotor.yaml ${WORK}/new/rotor.h5 "simulation.duration=4 ms")
