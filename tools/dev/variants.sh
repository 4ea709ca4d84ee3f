# Builds of other kinds, each with its tests: sanitizers, memory, WebAssembly, coverage.
# Uses the lists of packages.sh, and `around` of presets.sh.

# verb_sanitize [CTEST ARGUMENT...]: without arguments all tests but the slow ones, which take an hour under sanitizers.
verb_sanitize() {
  need "${packages[@]}" "${clang_packages[@]}"
  [ $# != 0 ] || set -- -LE '^(slow|campaign)$'
  test_preset asan "$@"
}

# verb_memory [-R REGEX]: the commands of test/memory/commands.txt, by the ordinary program and by one with sanitizers.
verb_memory() {
  need "${packages[@]}"
  group_if_fresh
  build_preset release slapstick
  build_preset memory slapstick
  step "memory: commands with two fillings of the heap, and with sanitizers"
  tools/memory list build/slapstick
  tools/memory run build/slapstick build-memory/slapstick "$@"
  step "memory took $SECONDS s"
}

# verb_tsan [CTEST ARGUMENT...]: without arguments the folders whose tests start threads.
verb_tsan() {
  local folders=(event io batch sweep chart catalogue app)
  need "${packages[@]}"
  # GCC 12's ThreadSanitizer does not start where the kernel randomises addresses widely.
  if setarch -R true 2>/dev/null; then around=(setarch -R); fi
  build_preset tsan "${folders[@]/#/try_}"
  [ $# != 0 ] || set -- -L "^($(IFS='|'; echo "${folders[*]}"))\$" -LE '^(slow|campaign)$'
  step "test (tsan)"
  exec "${around[@]}" ctest --preset tsan --parallel "$(nproc)" "$@"
}

verb_wasm() {
  need "${packages[@]}" "${wasm_packages[@]}"
  export NODE_PATH=/usr/share/nodejs  # what em++ asks node for, where node is not Debian's
  (test_preset wasm "$@")
  step "WebAssembly took $SECONDS s"
}

verb_coverage() {
  need "${packages[@]}" "${coverage_packages[@]}"
  build_preset coverage
  find build-coverage -name '*.gcda' -delete
  step "test (coverage)"
  quietly build-coverage/test.log ctest --preset coverage --parallel "$(nproc)" "$@" || true
  step "lines by folder, branches of the event kernel and the mode graph"
  tools/coverage build-coverage
}
