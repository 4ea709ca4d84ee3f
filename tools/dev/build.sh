# The release build: the programs alone, or everything that tests need. Uses `packages`, and `settings` of presets.sh.

verb_build() {
  need "${packages[@]}"
  settings=("$@")
  group_if_fresh
  build_preset release slapstick slapstick-verify
  if [ -x build/slapstick ]; then step "done: build/slapstick, build/slapstick-verify"; fi
}

verb_build_all() {
  need "${packages[@]}"
  settings=("$@")
  group_if_fresh
  build_preset release
}

verb_clean() {
  step "remove dist/, build/, build-*/ and web/node_modules"
  rm -rf dist build web/node_modules build-debug build-try build-asan build-tsan build-lint build-bench build-fuzz \
    build-coverage build-planted build-wasm build-memory
}
