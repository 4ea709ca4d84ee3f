# Fuzzing: searches for inputs that crash, and the corpus that is kept. Uses `packages` and `clang_packages`.

# Those about bytes first, at some thousand executions a second. The program's verbs, the verifier and the engine take
# longer.
fuzz_targets=(expression model_file values state arguments certificate motion)
declare -A longest_input=([expression]=420 [model_file]=2048 [values]=200 [state]=200 [arguments]=1024
  [certificate]=4096 [motion]=256)

# fuzz_target NAME LIMIT: searches from the kept corpus on, with inputs no longer than `longest_input`.
# What crashes lies in build-fuzz/findings/, what it learns in build-fuzz/corpus/.
fuzz_target() {
  local target=$1 limit=-max_total_time=$2 dictionary=() status=0
  local grown=build-fuzz/corpus/$target findings=build-fuzz/findings/$target log=build-fuzz/$target.log
  [ "${2%runs}" = "$2" ] || limit=-runs=${2%runs}
  mkdir -p "$grown" "$findings"
  if [ "$target" = model_file ]; then
    build-fuzz/fuzz_dictionary >build-fuzz/model_file.dict
    dictionary=(-dict=build-fuzz/model_file.dict)
  fi
  step "fuzz $target ($2)"
  ASAN_OPTIONS=quarantine_size_mb=16 UBSAN_OPTIONS=print_stacktrace=1 "build-fuzz/fuzz_$target" "$limit" -timeout=10 \
    -rss_limit_mb=2048 -max_len="${longest_input[$target]}" -print_final_stats=1 -artifact_prefix="$findings/" \
    "${dictionary[@]}" "$grown" "test/fuzz/corpus/$target" >"$log" 2>&1 </dev/null || status=$?
  grep -E 'executed_units|average_exec|peak_rss' "$log" || true
  [ $status = 0 ] || {
    tail -n 30 "$log"
    fail "fuzz_$target ended with status $status: the input is in $findings, the whole output in $log"
  }
}

# keep_corpus NAME: the smallest set of inputs that reaches all that the kept and the grown corpus reach becomes the
# kept one. What has a name of its own (bug_...) stays beside them.
keep_corpus() {
  local kept=test/fuzz/corpus/$1 merged=build-fuzz/merged/$1
  rm -rf "$merged"
  mkdir -p "$merged" "build-fuzz/corpus/$1"
  quietly "build-fuzz/$1-merge.log" "build-fuzz/fuzz_$1" -set_cover_merge=1 -use_counters=0 -timeout=10 \
    -rss_limit_mb=2048 "$merged" "$kept" "build-fuzz/corpus/$1"
  find "$kept" -type f ! -name 'bug_*' -delete
  mv "$merged"/* "$kept"
  step "$kept: $(find "$kept" -type f | wc -l) inputs, $(du -sb --apparent-size "$kept" | cut -f 1) bytes"
}

verb_fuzz() {
  local limit=${1:-60} target
  [ $# = 0 ] || shift
  [ $# = 0 ] || fuzz_targets=("$@")
  need "${packages[@]}" "${clang_packages[@]}"
  build_preset fuzz "${fuzz_targets[@]/#/fuzz_}" fuzz_dictionary
  for target in "${fuzz_targets[@]}"; do
    if [ "$limit" = keep ]; then keep_corpus "$target"; else fuzz_target "$target" "$limit"; fi
  done
}
