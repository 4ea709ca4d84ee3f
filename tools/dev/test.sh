# ./dev test, its parts, of which Python runs beside the light ones, and what a release needs besides. Uses `packages` and `manual_packages`.
. tools/dev/web.sh

# run_part PART WORD...: ./dev WORD... as a process of its own; tools/budget measures it as PART, in build/parts.json.
# A part that fails is added to `failed`, an array of the caller.
run_part() {
  local part=$1
  shift
  step "part $part: ./dev $*"
  tools/budget run "$part" -- "$BASH" dev "$@" || failed+=("$part")
}

# python_beside COMMAND...: the part `python` beside COMMAND, which starts its own parts: most of either is one processor's work.
# What python prints is in build/python/part.log, and follows.
python_beside() {
  local log=build/python/part.log python
  step "part python: ./dev python, beside the parts that follow"
  mkdir -p build/python
  tools/budget run python -- "$BASH" dev python >"$log" 2>&1 </dev/null &
  python=$!
  "$@"
  wait "$python" || failed+=(python)
  step "part python"
  cat "$log"
}

light_parts() {
  run_part format format --check
  run_part docs docs
  run_part cluster cluster
}

# run_parts: all parts of ./dev test. Those that fail are added to the caller's `failed`. Without a build no other runs,
# and with it none builds the release again (build_preset).
# The parts of ./dev test-all that do more have names of their own: the budget is that of ./dev test.
run_parts() {
  local web=${SLAPSTICK_WEB:-test} rotation=rotation
  [ "${SLAPSTICK_SLICE:-}" != all ] || rotation=rotation-all
  run_part build build-all
  [ ${#failed[@]} = 0 ] || return 0
  export SLAPSTICK_BUILT=release
  run_part memory memory
  run_part wasm wasm
  python_beside light_parts
  if npm_answers; then
    run_part "${web/#test/web}" web "$web"  # its tests run the Python that the page shows
  else
    step "no registry of npm answers: the explorer is not tested"
  fi
  run_part test test -LE '^(slow|campaign)$' --output-junit "$PWD/build/ctest.xml"
  run_part "$rotation" rotation
}

# verb_test [CTEST ARGUMENT...]: without arguments all parts, then the budget and one line of counts.
verb_test() {
  local failed=() counts
  # What the parts need is installed before the first: no part is charged for it.
  need "${packages[@]}" "${manual_packages[@]}"
  [ $# != 0 ] || need "${wasm_packages[@]}" "${web_test_packages[@]}" "${cluster_packages[@]}" "${docs_packages[@]}" clang-format
  if [ $# != 0 ]; then
    group_if_fresh
    test_preset release "$@"
  fi
  rm -f build/parts.json build/ctest.xml build/python/tests.xml build/web-test.log build/rotation/{slice,ctest.xml}
  run_parts
  tools/budget report || failed+=("budget")
  counts=$(tools/counts build)
  [ ${#failed[@]} = 0 ] || fail "$counts; failed parts: $(printf '%s\n' "${failed[@]}" | paste -s -d , | sed 's/,/, /g')"
  step "$counts; no part failed"
}

# verb_rotation [ARGUMENT...]: a twentieth of what is slow, chosen by the commit. Arguments are those of tools/rotation.
verb_rotation() {
  need "${packages[@]}"
  group_if_fresh
  build_preset release
  step "rotation"
  exec tools/rotation build "$@"
}

verb_test_all() {
  local part
  for part in test package sanitize tsan lint; do
    step "./dev $part"
    SLAPSTICK_SLICE=all SLAPSTICK_WEB=test-all ./dev "$part"
  done
}
