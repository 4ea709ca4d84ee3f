# The Python package: sdist, wheel, their tests. Uses `packages` and `python_packages`.
. tools/dev/python_environment.sh

# refresh FROM TO: TO becomes a copy of FROM; a file that is the same keeps its time, so that ninja sees what changed.
refresh() {
  local file
  mkdir -p "$2"
  (cd "$1" && find . -type f) | while read -r file; do
    cmp -s "$1/$file" "$2/$file" || { mkdir -p "$2/${file%/*}" && cp "$1/$file" "$2/$file" && touch "$2/$file"; }
  done
  (cd "$2" && find . -type f) | while read -r file; do [ -f "$1/$file" ] || rm "$2/$file"; done
}

# python_package: the sdist, and from what is in it the wheel, against the built library, both in dist/.
python_package() {
  local tools=$PWD/build/python/tools/bin parts=$PWD/build/python
  step "library for the extension in build/python/library"
  rm -rf dist "$parts/library" "$parts/sdist" "$parts/wheel"
  quietly build/python/library.log cmake --install build --prefix "$parts/library" --component development
  step "sdist"
  quietly build/python/sdist.log "$tools/python" -m build --no-isolation --sdist --outdir dist .
  mkdir -p "$parts/sdist"
  tar -xzf dist/*.tar.gz -C "$parts/sdist" --strip-components 1
  refresh "$parts/sdist" "$parts/source"
  step "wheel"
  quietly build/python/wheel.log env PATH="$tools:$PATH" CMAKE_BUILD_PARALLEL_LEVEL="$(jobs)" \
    "$tools/python" -m build --no-isolation --wheel --outdir "$parts/wheel" -C build-dir="$parts/extension" \
    -C cmake.define.slapstick_ROOT="$parts/library" "$parts/source"
  quietly build/python/auditwheel.log env PATH="$tools:$PATH" \
    auditwheel repair --strip --wheel-dir dist "$parts"/wheel/*.whl
  "$tools/auditwheel" show dist/*.whl | grep -E 'consistent|platform tag|manylinux' | head -n 3
  ls -sh dist
}

# install_quietly PYTHON PIP ARGUMENT...: pip of that interpreter, without a word unless it fails.
install_quietly() {
  local interpreter=$1
  shift
  quietly build/python/install.log "$interpreter" -m pip install --disable-pip-version-check --no-compile "$@"
}

# python_examples: the docstrings, where only numpy is, in an empty environment of `python` (find_python sets it).
python_examples() {
  local empty=$PWD/build/python/empty
  step "examples of the docstrings, where only numpy is"
  rm -rf "$empty"
  quietly build/python/empty.log "$python" -m venv "$empty"
  awk '/^[a-z]/ { wanted = /^numpy==/ } wanted' python/requirements.txt >build/python/numpy.txt
  install_quietly "$empty/bin/python" --require-hashes -r build/python/numpy.txt
  install_quietly "$empty/bin/python" --no-deps --no-index dist/*.whl
  (cd build/python && "$empty/bin/python" ../../python/tests/run_doctests.py)
}

# python_tests [PYTEST ARGUMENT...]: the types, then all tests with everything. Counts are in build/python/tests.xml.
python_tests() {
  local tools=$PWD/build/python/tools/bin
  install_quietly "$tools/python" --no-deps --no-index --force-reinstall dist/*.whl
  step "types and stubs"
  (cd build/python && "$tools/python" -m mypy --config-file ../../pyproject.toml -p slapstick &&
    "$tools/python" ../../python/tests/stubtest.py slapstick._core --ignore-disjoint-bases \
      --allowlist ../../python/tests/stubtest_allowlist.txt)
  step "tests"
  PATH="$tools:$PATH" SLAPSTICK_PROGRAMS="$PWD/build" \
    "$tools/python" -m pytest -q --junitxml="$PWD/build/python/tests.xml" "$@"
}

# verb_python [PYTEST ARGUMENT...]: all of it, with its time.
verb_python() {
  need "${packages[@]}"
  build_preset release slapstick slapstick-verify
  find_python 10 "${python_packages[@]}"
  local begin=$SECONDS
  python_environment build/python/tools python/requirements.txt
  python_package
  python_examples
  python_tests "$@"
  step "Python: $((SECONDS - begin)) s"
}
