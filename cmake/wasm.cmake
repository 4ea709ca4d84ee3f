# The toolchain of the preset `wasm`: Debian's emscripten, with libc++ 14, for node and for browsers.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)

set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions -msimd128")
# -O3 would run wasm-opt for a minute; newer versions of emscripten say STACK_SIZE.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-fwasm-exceptions -O2 -sALLOW_MEMORY_GROWTH=1 -sTOTAL_STACK=1048576")
# The loader of this version asks fetch() for a path where there is one.
set(CMAKE_CROSSCOMPILING_EMULATOR node --no-experimental-fetch)

# Header-only packages of the host. Of /usr/include this compiler may see nothing else: the rest is another C library's.
set(Eigen3_DIR /usr/share/eigen3/cmake)
set(headers ${CMAKE_BINARY_DIR}/host_headers)
file(MAKE_DIRECTORY ${headers})
foreach(folder toml++ nlohmann)
  file(CREATE_LINK /usr/include/${folder} ${headers}/${folder} SYMBOLIC)
endforeach()
set(CMAKE_CXX_STANDARD_INCLUDE_DIRECTORIES ${headers})
