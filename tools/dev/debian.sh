# The Debian packages: made, checked, tried. Uses `packages`, `deb_packages` and `python_packages`.
. tools/dev/python_environment.sh

# debian_module: what python3-slapstick has, for Debian's own python3, in build/python/debian/module.
debian_module() {
  local parts=$PWD/build/python/debian version module
  version=$(sed -n 's/^project(slapstick VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
  module=$parts/module
  step "the extension for Debian's python3"
  rm -rf "$parts/library" "$module"
  quietly "$parts/library.log" cmake --install build --prefix "$parts/library" --component development
  quietly "$parts/build.log" cmake -S python -B "$parts/build" -G Ninja -D CMAKE_BUILD_TYPE=Release \
    -D Python_EXECUTABLE=/usr/bin/python3 -D nanobind_DIR="$(build/python/tools/bin/python -m nanobind --cmake_dir)" \
    -D SKBUILD_PROJECT_VERSION="$version" -D slapstick_ROOT="$parts/library"
  quietly "$parts/build.log" cmake --build "$parts/build" --parallel "$(jobs)"
  quietly "$parts/install.log" cmake --install "$parts/build" --strip --prefix "$module"
  cp python/slapstick/*.py python/slapstick/py.typed "$module/slapstick"
  mkdir "$module/slapstick-$version.dist-info"
  printf 'Metadata-Version: 2.1\nName: slapstick\nVersion: %s\nRequires-Dist: numpy\n' "$version" \
    >"$module/slapstick-$version.dist-info/METADATA"
}

# package_part: the packages, what Debian's checker says of them, and how they do.
package_part() {
  local begin=$SECONDS folder=build/packages
  find_python 10 "${python_packages[@]}"
  python_environment build/python/tools python/requirements.txt
  debian_module
  step "packages in $folder"
  rm -rf $folder/*.deb $folder/_CPack_Packages
  (cd build && quietly packages/cpack.log cpack -G DEB)
  ls -sh $folder/*.deb
  step "lintian"
  lintian --fail-on error --allow-root $folder/*.deb
  [ "$(id -u)" = 0 ] || { step "not installed: a Debian of their own wants root"; return; }
  step "install, use, remove"
  quietly $folder/try.log packaging/debian/try_packages $folder $folder/root
  grep '^==' $folder/try.log
  step "the packages took $((SECONDS - begin)) s"
}

verb_package() {
  need "${packages[@]}" "${deb_packages[@]}"
  build_preset release slapstick slapstick-verify
  package_part
}
