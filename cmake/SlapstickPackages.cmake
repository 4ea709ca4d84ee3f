# `cpack -G DEB` in the build folder: packages slapstick, libslapstick-dev and, if the extension was built for Debian's python3 (./dev package),
# python3-slapstick. packaging/debian has what is in them besides; ./dev package tests them in a Debian of their own.
set(SLAPSTICK_PACKAGER "The slapstick authors <slapstick@example.org>" CACHE STRING "Maintainer of the packages, with an address")
set(folder ${PROJECT_SOURCE_DIR}/packaging/debian)
set(SLAPSTICK_DEBIAN_PYTHON ${PROJECT_BINARY_DIR}/python/debian/module)

install(DIRECTORY ${SLAPSTICK_DEBIAN_PYTHON}/ DESTINATION lib/python3/dist-packages COMPONENT python EXCLUDE_FROM_ALL OPTIONAL)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME slapstick)
set(CPACK_PACKAGE_VENDOR slapstick)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own, the first line of its description
set(CPACK_PACKAGE_CONTACT "${SLAPSTICK_PACKAGER}")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_COMPONENTS_ALL development python)
if(TARGET slapstick_app)
  list(PREPEND CPACK_COMPONENTS_ALL programs)
endif()
set(CPACK_PROJECT_CONFIG_FILE ${folder}/at_cpack_time.cmake)
set(CPACK_PRE_BUILD_SCRIPTS ${folder}/finish.cmake)
set(CPACK_SLAPSTICK_SOURCE ${PROJECT_SOURCE_DIR})
set(CPACK_SLAPSTICK_PYTHON ${SLAPSTICK_DEBIAN_PYTHON})

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME slapstick)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot, fonts-dejavu-core")
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION "exact simulation of oscillators that stick, slip and hit stops
The program simulates machines with dry friction and impacts, exactly
between events and without missing an event. It classifies what a machine
settles on, follows periodic motions over parameters, and draws bifurcation
diagrams and charts. slapstick-verify proves certified runs.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libslapstick-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4), libsqlite3-dev, libtbb-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "C++20 library for oscillators with friction and impacts
Headers, the static library, and the files by which CMake and pkg-config
find them.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-slapstick)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, python3-pandas, python3-tqdm, python3-xarray")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${folder}/python/postinst;${folder}/python/prerm")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "oscillators with friction and impacts, for Python
The package slapstick: motions, attractors, periodic orbits, branches,
diagrams and charts as NumPy arrays, computed by the C++ library.")
include(CPack)
