# Builds of other kinds, each with its tests: sanitizers, clang, WebAssembly, coverage.
# Uses the lists of packages.sh, and `around` of presets.sh.

verb_sanitize() {
  need "${packages[@]}"
  test_preset asan "$@"
}

verb_tsan() {
  need "${packages[@]}"
  # GCC 12's ThreadSanitizer does not start where the kernel randomises addresses widely.
  if setarch -R true 2>/dev/null; then around=(setarch -R); fi
  test_preset tsan "$@"
}

verb_clang() {
  need "${packages[@]}" "${clang_packages[@]}"
  test_preset clang "$@"
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
