# Compiler settings shared by every target of this project.
# -ffp-contract=off: a*b+c is rounded twice everywhere, so that vector width and optimisation level do not change a bit. What is worth wider vectors than
# the baseline's is compiled for each instruction set and chosen at run time (src/event/CMakeLists.txt).
add_library(slapstick_options INTERFACE)
target_compile_features(slapstick_options INTERFACE cxx_std_20)
# The private headers, for the library, its programs and its tests.
target_include_directories(slapstick_options INTERFACE ${PROJECT_SOURCE_DIR}/src)
target_compile_options(slapstick_options INTERFACE -Wall -Wextra -Wpedantic $<$<NOT:$<BOOL:${SLAPSTICK_GROUPED}>>:-Wshadow> -Wconversion -Wno-sign-conversion -Werror -ffp-contract=off -fno-math-errno)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # GCC 12 warns inside its own AVX-512 intrinsics (its bug 105593) and std::string concatenation (105651).
  target_compile_options(slapstick_options INTERFACE -Wno-maybe-uninitialized -Wno-restrict)
endif()
# Vectors of eight doubles: no part of them crosses the library's interface by value, and std::array of them is meant.
target_compile_options(slapstick_options INTERFACE -Wno-psabi -Wno-ignored-attributes)
if(SLAPSTICK_SANITIZE)
  list(JOIN SLAPSTICK_SANITIZE "," sanitizers)
  target_compile_options(slapstick_options INTERFACE -fsanitize=${sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(slapstick_options INTERFACE -fsanitize=${sanitizers})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    target_compile_options(slapstick_options INTERFACE -fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/tools/ubsan.ignore)
  endif()
endif()
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_CXX_EXTENSIONS OFF)
if(NOT EMSCRIPTEN)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)  # the library goes into Python modules too
endif()
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})

# slapstick_group(TARGET): with SLAPSTICK_GROUPED, up to SLAPSTICK_GROUP neighbouring sources of one folder are compiled together, since most of the
# time goes into the headers and templates that they share. A source keeps to itself with the property SKIP_UNITY_BUILD_INCLUSION. Names in
# anonymous namespaces are then those of a group: the build says where two are one.
function(slapstick_group target)
  if(NOT SLAPSTICK_GROUPED)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # What one source calls its own is no fault of its neighbours: builds without groups ask for this, and for shadows.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  get_target_property(sources ${target} SOURCES)
  set(index 0)
  foreach(source IN LISTS sources)
    math(EXPR group "${index} / ${SLAPSTICK_GROUP}")
    math(EXPR index "${index} + 1")
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP "group_${group}")
  endforeach()
endfunction()

# slapstick_precompile(TARGET [FROM TARGET | HEADER...]): with SLAPSTICK_PRECOMPILED, headers of others that most sources of the target
# read are read once; FROM takes those of another target. Builds without groups find a source that does not name what it needs.
# Not with ccache, which would keep no object that depends on such a file.
function(slapstick_precompile target)
  cmake_parse_arguments(PARSE_ARGV 1 headers "" "FROM" "")
  if(NOT SLAPSTICK_PRECOMPILED OR CMAKE_CXX_COMPILER_LAUNCHER)
    return()
  endif()
  if(headers_FROM)
    target_precompile_headers(${target} REUSE_FROM ${headers_FROM})
    # Objects of programs are as those of libraries, for which the headers were read.
    get_target_property(type ${target} TYPE)
    if(type STREQUAL EXECUTABLE AND CMAKE_POSITION_INDEPENDENT_CODE)
      set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
      target_compile_options(${target} PRIVATE -fPIC)
    endif()
  else()
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <atomic> <cmath> <complex> <cstdio> <filesystem>
      <functional> <map> <memory> <optional> <span> <string> <string_view> <utility> <vector> ${headers_UNPARSED_ARGUMENTS})
  endif()
  # GCC 12's false alarm about std::string (its bug 105651) has other names where headers were read before.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow -Wno-array-bounds>)
endfunction()

# slapstick_headers(NAME HEADER...): with SLAPSTICK_PRECOMPILED, a target that others take precompiled headers FROM. They are compiled alike.
function(slapstick_headers name)
  if(SLAPSTICK_PRECOMPILED)
    file(CONFIGURE OUTPUT ${name}.cpp CONTENT "// Has what ${name} reads.\n")
    add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
    target_link_libraries(${name} PRIVATE slapstick_inside)
    slapstick_precompile(${name} <Eigen/Core> ${ARGN})
  endif()
endfunction()

# slapstick_thin(TARGET): what holds no numerics of its own is not worth the time of a full optimisation.
function(slapstick_thin target)
  if(TARGET ${target})
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()

# Objects come from ccache where there is one.
find_program(SLAPSTICK_CCACHE ccache)
if(SLAPSTICK_CCACHE AND PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${SLAPSTICK_CCACHE})
endif()

# Instruction sets that the kernels of windows and of batches are compiled for; the widest that the processor has is chosen at run time.
set(slapstick_flags_sse4 -msse4.2)
set(slapstick_flags_avx2 -mavx2)
set(slapstick_flags_avx512 -mavx2 -mavx512f -mavx512dq -mavx512vl)
set(SLAPSTICK_KERNELS scalar sse4 avx2 avx512 CACHE STRING "Instruction sets of the kernels: scalar, and on x86-64 which of sse4, avx2, avx512")
if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$" OR NOT CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang" OR EMSCRIPTEN)
  set(SLAPSTICK_KERNELS scalar)
endif()

# slapstick_choose_kernels(SOURCE): the source that takes one of them at run time.
function(slapstick_choose_kernels source)
  set(definitions)
  foreach(target IN LISTS SLAPSTICK_KERNELS)
    string(TOUPPER ${target} name)
    list(APPEND definitions SLAPSTICK_KERNEL_${name})
  endforeach()
  set_source_files_properties(${source} PROPERTIES COMPILE_DEFINITIONS "${definitions}" SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
