# What every verb of ./dev speaks with: steps, failures, quiet commands, the number of jobs.

step() { printf '==> %s\n' "$*"; }
fail() { printf './dev: %s\n' "$*" >&2; exit 1; }

# quietly LOG COMMAND...: output goes to LOG; on failure its end is shown and its path named.
quietly() {
  local log=$1 status=0
  shift
  mkdir -p "$(dirname "$log")"
  "$@" >"$log" 2>&1 </dev/null || status=$?
  [ $status = 0 ] && return
  tail -n 30 "$log" >&2
  printf './dev: failed (exit %s): %s\n./dev: the whole output is in %s\n' $status "$*" "$PWD/$log" >&2
  return $status
}

# One job per core, but no more than one per 1.5 GiB of memory: a file heavy with templates needs that much.
jobs() {
  local cores fit
  cores=$(nproc)
  fit=$(awk '/^MemTotal/ { print int($2 / 1572864) }' /proc/meminfo 2>/dev/null || echo "$cores")
  [ "${fit:-0}" -ge 1 ] || fit=1
  echo $((cores < fit ? cores : fit))
}
