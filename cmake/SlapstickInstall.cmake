# The installed package: `find_package(slapstick)` gives the target slapstick::slapstick. test/package proves it.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Public headers may use Eigen types, whose alignment Eigen derives from -march. A library built for one machine and a program built
# for the baseline would disagree and corrupt the heap, so it is fixed, at what Debian's own Eigen users have. The choice between malloc and
# Eigen's own aligned allocator depends on -march too: always the latter, on both sides. And of a function of Eigen's that both have, the linker
# keeps one: a program's vectorised one would give the library other bits. So neither vectorises Eigen, nor asks for the size of caches.
target_compile_definitions(slapstick PUBLIC EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MAX_STATIC_ALIGN_BYTES=16
                                            EIGEN_MALLOC_ALREADY_ALIGNED=0 EIGEN_DONT_VECTORIZE EIGEN_NO_CPUID)

# Which package an imported target comes from. A static library needs its private dependencies when it is linked, so the
# config file looks for them too; for a shared one only the public ones.
set(package_of_Eigen3::Eigen Eigen3)
set(package_of_TBB::tbb TBB)
set(package_of_fmt::fmt fmt)
set(package_of_fmt::fmt-header-only fmt)
set(package_of_tomlplusplus::tomlplusplus tomlplusplus)
set(package_of_nlohmann_json::nlohmann_json nlohmann_json)
set(package_of_SQLite::SQLite3 SQLite3)
set(package_of_Threads::Threads Threads)

get_target_property(slapstick_type slapstick TYPE)
get_target_property(slapstick_links slapstick INTERFACE_LINK_LIBRARIES)
set(slapstick_dependencies)
foreach(link IN LISTS slapstick_links)
  if(link MATCHES "BUILD_INTERFACE|^::@" OR (slapstick_type STREQUAL SHARED_LIBRARY AND link MATCHES "LINK_ONLY"))
    continue()
  endif()
  string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" link "${link}")
  if(DEFINED package_of_${link})
    list(APPEND slapstick_dependencies ${package_of_${link}})
  elseif(link MATCHES "::")
    message(FATAL_ERROR "cmake/SlapstickInstall.cmake does not know which package has the target ${link}")
  endif()
endforeach()
list(REMOVE_DUPLICATES slapstick_dependencies)
list(TRANSFORM slapstick_dependencies REPLACE "^(.+)$" "find_dependency(\\1)")
list(JOIN slapstick_dependencies "\n" SLAPSTICK_FIND_DEPENDENCIES)

set(slapstick_cmake_folder ${CMAKE_INSTALL_LIBDIR}/cmake/slapstick)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)  # the library by itself: cmake --install build --component development
install(TARGETS slapstick EXPORT slapstick-targets)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/slapstick DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(FILES ${PROJECT_SOURCE_DIR}/models/model.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/slapstick)
install(EXPORT slapstick-targets NAMESPACE slapstick:: DESTINATION ${slapstick_cmake_folder})
if(TARGET slapstick_verify)
  install(TARGETS slapstick_verify COMPONENT programs)
endif()
if(TARGET slapstick_app)
  install(TARGETS slapstick_app COMPONENT programs)
  # Manual pages and completion, written by the programs after they were linked.
  install(DIRECTORY ${PROJECT_BINARY_DIR}/share/ DESTINATION ${CMAKE_INSTALL_DATADIR} COMPONENT programs OPTIONAL)
  # The explorer, if it was built (./dev web).
  install(DIRECTORY ${PROJECT_BINARY_DIR}/web DESTINATION ${CMAKE_INSTALL_DATADIR}/slapstick COMPONENT programs OPTIONAL)
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/slapstick-config.cmake.in
  ${PROJECT_BINARY_DIR}/package/slapstick-config.cmake INSTALL_DESTINATION ${slapstick_cmake_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/slapstick-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/slapstick-config.cmake ${PROJECT_BINARY_DIR}/package/slapstick-config-version.cmake
  DESTINATION ${slapstick_cmake_folder})

# The same for pkg-config.
set(slapstick_pc_requires "Requires: eigen3")
foreach(needed "TBB tbb" "SQLite3 sqlite3")
  separate_arguments(needed)
  list(GET needed 0 package)
  list(GET needed 1 module)
  if(slapstick_dependencies MATCHES "${package}")
    string(APPEND slapstick_pc_requires " ${module}")
  endif()
endforeach()
get_target_property(slapstick_pc_definitions slapstick INTERFACE_COMPILE_DEFINITIONS)
list(TRANSFORM slapstick_pc_definitions PREPEND -D)
list(JOIN slapstick_pc_definitions " " slapstick_pc_definitions)
configure_file(${PROJECT_SOURCE_DIR}/cmake/slapstick.pc.in ${PROJECT_BINARY_DIR}/package/slapstick.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/package/slapstick.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
