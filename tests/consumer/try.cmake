# cmake -D BUILD_DIR=dir -D WORK=dir -D COMPILER=c++ -D SOURCE=dir -P try.cmake
#
# Installs the build into a fresh prefix and builds and runs a program that finds hersey there and nowhere else.
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

must_work(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
must_work(${prefix}/bin/hersey --version)
foreach(file LICENSE THIRD_PARTY.md)
  if(NOT EXISTS ${prefix}/share/doc/hersey/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
must_work(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G Ninja -DCMAKE_BUILD_TYPE=Release
          -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${COMPILER})
must_work(${CMAKE_COMMAND} --build ${WORK}/build)
must_work(${WORK}/build/consumer)
if(NOT output MATCHES "peak pressure [1-9]\\.[0-9]+ MPa")
  message(FATAL_ERROR "the consumer printed: ${output}")
endif()
message(STATUS "${output}")
