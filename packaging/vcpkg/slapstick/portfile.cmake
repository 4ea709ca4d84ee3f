# The port builds the tree it lies in; one of vcpkg's own registry would call vcpkg_from_github here. Not run here: written from the documents.
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../../.." ABSOLUTE)

vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}" OPTIONS -DSLAPSTICK_BUILD_APP=OFF -DSLAPSTICK_BUILD_VERIFIER=OFF -DSLAPSTICK_BUILD_TESTS=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME slapstick CONFIG_PATH lib/cmake/slapstick)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
