# Builds and tests of a preset of CMakePresets.json.
# Two globals are set here, and a verb may set them before it calls build_preset or test_preset.

settings=()  # of cmake, beside those of the preset
around=()  # a command that the programs of a preset must run under

# group_if_fresh: sets `settings`, so that a build/ which is not configured yet compiles sources in groups.
group_if_fresh() { [ -f build/CMakeCache.txt ] || settings=(-D SLAPSTICK_GROUPED=ON "${settings[@]}"); }

# build_preset PRESET [TARGET...]: configures with `settings`, and builds under `around`. SLAPSTICK_BUILT names a preset
# all of which is built: the parts of ./dev test have one build, which two of them at once may use.
build_preset() {
  local preset=$1 folder=build
  shift
  [ "${SLAPSTICK_BUILT:-}" != "$preset" ] || return 0
  [ "$preset" = release ] || folder=build-$preset
  step "configure ($preset) in $folder/"
  quietly "$folder/configure.log" cmake --preset "$preset" "${settings[@]}"
  step "build ($preset)"
  "${around[@]}" cmake --build "$folder" --parallel "$(jobs)" ${1:+--target "$@"}
}

# test_preset PRESET [CTEST ARGUMENT...]: builds the preset and becomes ctest, under `around`.
# The summary of ctest is the last thing printed, and its exit status is ours.
test_preset() {
  local preset=$1
  shift
  build_preset "$preset"
  step "test ($preset)"
  exec "${around[@]}" ctest --preset "$preset" --parallel "$(nproc)" "$@"
}
