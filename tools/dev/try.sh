# The tests of one folder, with the least that they need. Uses `packages`.

# try_names: the folders of test/ that have tests, on one line.
try_names() {
  local file names=()
  for file in test/*/CMakeLists.txt; do
    file=${file%/CMakeLists.txt}
    names+=("${file#test/}")
  done
  echo "${names[*]}"
}

# try_build NAME: builds the tests of NAME in build-try. That folder is configured if no ninja file is there: ninja runs
# cmake again by itself. What the compiler says is shown where it fails, from the first failure on.
try_build() {
  local log=build-try/build.log
  [ -f build-try/build.ninja ] || {
    step "configure in build-try/"
    quietly build-try/configure.log cmake --preset try
  }
  step "build the tests of test/$1: what is compiled stands in $log"
  cmake --build build-try --parallel "$(jobs)" --target "try_$1" >"$log" 2>&1 </dev/null && return
  if grep -q '^FAILED:' "$log"; then sed -n '/^FAILED:/,$p' "$log" | head -n 80; else tail -n 30 "$log"; fi >&2
  fail "the tests of test/$1 do not build: the whole output is in $PWD/$log"
}

# try_groups NAME: what FILTER is looked for in: the names of tests of NAME up to the last dot, on one line.
try_groups() {
  ctest --test-dir build-try -N -L "^$1\$" | sed -n 's/^ *Test *#[0-9]*: *//p' | sed 's/\.[^.]*$//' | sort -u | paste -s -d ' '
}

# try_run NAME [FILTER]: ctest's summary, and on failure all that it says of what failed.
try_run() {
  local log=build-try/test.log status=0
  ctest --test-dir build-try -L "^$1\$" ${2:+-R "$2"} -LE '^(slow|campaign)$' --output-on-failure --no-tests=error \
    --parallel "$(nproc)" >"$log" 2>&1 </dev/null || status=$?
  if [ $status = 0 ]; then
    sed -n '/ tests passed, /,$p' "$log"
  else
    grep -vE '^ +Start +[0-9]+: |^ *[0-9]+/[0-9]+ Test .* Passed ' "$log"
  fi
  return $status
}

# verb_try NAME [FILTER]: builds and runs what is in test/NAME, of which FILTER is in the name.
verb_try() {
  local status=0
  [ $# != 0 ] || fail "./dev try NAME [FILTER] builds and runs the tests of test/NAME; NAME is one of: $(try_names)"
  [ $# -le 2 ] || fail "./dev try takes a folder and one filter, but was given $#: $*"
  [ -f "test/$1/CMakeLists.txt" ] || fail "there are no tests in test/$1; NAME is one of: $(try_names)"
  need "${packages[@]}"
  try_build "$1"
  try_run "$@" || status=$?
  if grep -q '^No tests were found' build-try/test.log; then
    fail "no test of test/$1 matches '${2:-}'; FILTER is a regular expression, case matters, for names that begin with: $(try_groups "$1")"
  fi
  step "try $* took $SECONDS s"
  exit $status
}
