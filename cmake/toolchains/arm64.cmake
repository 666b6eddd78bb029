# Compiles for 64-bit ARM on another machine: clang, and Debian's own packages for arm64 below HERSEY_SYSROOT. What is built runs
# there by qemu, so that tests can be listed and run. packaging/try_on_arm64 makes the folder and says which packages it needs.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(triple aarch64-linux-gnu)

set(HERSEY_SYSROOT "" CACHE PATH "Where a Debian for arm64 lies")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES HERSEY_SYSROOT)
if(NOT IS_DIRECTORY "${HERSEY_SYSROOT}/usr/lib/${triple}")
  message(FATAL_ERROR "HERSEY_SYSROOT names no Debian for arm64: '${HERSEY_SYSROOT}'; packaging/try_on_arm64 --prepare makes one")
endif()
set(CMAKE_SYSROOT ${HERSEY_SYSROOT})

set(CMAKE_C_COMPILER clang)
set(CMAKE_CXX_COMPILER clang++)
set(CMAKE_C_COMPILER_TARGET ${triple})
set(CMAKE_CXX_COMPILER_TARGET ${triple})
# Debian's GNU tools know the machine's own kind of programs only.
foreach(kind EXE SHARED MODULE)
  set(CMAKE_${kind}_LINKER_FLAGS_INIT -fuse-ld=lld)
endforeach()
set(CMAKE_AR llvm-ar CACHE FILEPATH "")
set(CMAKE_RANLIB llvm-ranlib CACHE FILEPATH "")

# Programs are this machine's, all else is the other's.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)

set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static -L ${HERSEY_SYSROOT})
