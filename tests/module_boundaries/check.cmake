# cmake -D MODULE=name -D SOURCE_DIR=dir -D COMPILER=c++ -D "INCLUDES=dir|dir|..." -D WORK=dir -P check.cmake
#
# What a module can include, asked of the compiler with the include directories the module is compiled with, against
# the table of docs/architecture.md: the headers of the modules below it and its own are found, no other module's are.
cmake_minimum_required(VERSION 3.24)

# The table is written down a second time on purpose: a dependency added in CMakeLists.txt alone must fail here.
set(core)
set(fmi core)
set(circuit core)
set(solver core)
set(film core solver)
set(fem core solver)
set(mbd core solver fem)
set(bearing core circuit solver fem mbd film)
set(model ${bearing} bearing fmi)
set(results core)
set(run ${model} model results)
set(study ${run} run)
set(report ${run} run)
set(session ${study} study)
set(workbench ${session} session report)
set(modules core fmi circuit solver film fem mbd bearing model results run study report session workbench)
if(NOT MODULE IN_LIST modules)
  message(FATAL_ERROR "module ${MODULE} has no line in tests/module_boundaries/check.cmake")
endif()

string(REPLACE "|" ";-I;" includes "${INCLUDES}")
file(MAKE_DIRECTORY ${WORK})

# Preprocesses a source that includes one header; sets `found` and, on failure, `message`.
function(try_include header)
  file(WRITE ${WORK}/${MODULE}.cpp "#include \"${header}\"\n")
  execute_process(COMMAND ${COMPILER} -std=c++20 -E -I ${includes} ${WORK}/${MODULE}.cpp
                  RESULT_VARIABLE status ERROR_VARIABLE message OUTPUT_QUIET)
  set(found FALSE PARENT_SCOPE)
  if(status EQUAL 0)
    set(found TRUE PARENT_SCOPE)
  endif()
  set(message "${message}" PARENT_SCOPE)
endfunction()

# Every header of every module in one translation unit: the preprocessor says which can be reached.
set(claims "")
set(count 0)
foreach(other ${modules})
  file(GLOB headers RELATIVE ${SOURCE_DIR}/libs/${other}/include ${SOURCE_DIR}/libs/${other}/include/hersey/${other}/*.h)
  set(expected 0)
  if(other STREQUAL MODULE OR other IN_LIST ${MODULE})
    set(expected 1)
  endif()
  foreach(header ${headers})
    string(APPEND claims "#if __has_include(\"${header}\") != ${expected}\n"
                         "#error ${MODULE} and ${header}: reachable must be ${expected}\n#endif\n")
    math(EXPR count "${count} + 1")
    # The nearest forbidden and allowed header are also included for good.
    set(sample_${expected} ${header})
  endforeach()
endforeach()
file(WRITE ${WORK}/${MODULE}_all.cpp "${claims}")
execute_process(COMMAND ${COMPILER} -std=c++20 -E -I ${includes} ${WORK}/${MODULE}_all.cpp
                RESULT_VARIABLE status ERROR_VARIABLE message OUTPUT_QUIET)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "the boundaries of module ${MODULE} are open or blocked:\n${message}")
endif()

if(DEFINED sample_0)
  try_include(${sample_0})
  if(found OR NOT message MATCHES "No such file or directory|file not found")
    message(FATAL_ERROR "${MODULE} including ${sample_0} must fail for want of the header; got:\n${message}")
  endif()
endif()
if(DEFINED sample_1)
  try_include(${sample_1})
  if(NOT found)
    message(FATAL_ERROR "${MODULE} may include ${sample_1}, but this fails:\n${message}")
  endif()
endif()
message(STATUS "${MODULE}: ${count} headers tried")
