# Virtual environments of Python with locked packages, for the package, the guide and the benchmarks.

# find_python MINOR PACKAGE...: sets the global `python`, an interpreter of at least 3.MINOR.
# Debian's own gets the packages.
find_python() {
  local minor=$1
  shift
  python=$(command -v "${SLAPSTICK_PYTHON:-python3}") ||
    fail "no ${SLAPSTICK_PYTHON:-python3}: install python3, or name an interpreter by SLAPSTICK_PYTHON"
  [ "$(readlink -f "$python")" != "$(readlink -f /usr/bin/python3)" ] || need "$@"
  "$python" -c "import sys; sys.exit(sys.version_info < (3, $minor))" ||
    fail "$python is older than Python 3.$minor: name another interpreter by SLAPSTICK_PYTHON"
}

# python_environment FOLDER LOCK...: a virtual environment with what the locks name. The caller has set `python`.
# It is made anew unless it is there for the same interpreter and locks.
# A lock named .._alone.txt is installed without dependencies.
python_environment() {
  local folder=$1 stamp lock alone
  shift
  stamp=$("$python" -VV && cat "$@")
  [ "$(cat "$folder/stamp" 2>/dev/null)" = "$stamp" ] && return
  step "virtual environment $folder"
  rm -rf "$folder"
  quietly "$folder.log" "$python" -m venv "$folder"
  for lock in "$@"; do
    alone=()
    [ "${lock%_alone.txt}" = "$lock" ] || alone=(--no-deps)
    quietly "$folder.log" "$folder/bin/python" -m pip install --disable-pip-version-check --no-compile \
      --require-hashes "${alone[@]}" -r "$lock"
  done
  printf '%s' "$stamp" >"$folder/stamp"
}
