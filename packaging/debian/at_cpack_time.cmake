# Read by cpack before it begins: the Python package is made if the extension was built, and depends on the Python that it was built for.
file(GLOB modules ${CPACK_SLAPSTICK_PYTHON}/slapstick/_core.cpython-3*.so)
if(modules MATCHES "cpython-3([0-9]+)-")
  math(EXPR next "${CMAKE_MATCH_1} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${CMAKE_MATCH_1}), python3 (<< 3.${next}), python3-numpy (>= 1:1.24)")
else()
  list(REMOVE_ITEM CPACK_COMPONENTS_ALL python)
endif()
