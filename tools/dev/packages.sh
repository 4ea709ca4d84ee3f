# The Debian packages that slapstick needs, by what they are for, and how they are installed.
# Verbs take these lists; a new package is added here and nowhere else.

packages=(g++ cmake ninja-build libeigen3-dev libtbb-dev libtomlplusplus-dev nlohmann-json3-dev libcli11-dev libfmt-dev
  libhdf5-dev libsqlite3-dev gnuplot-nox libcpp-httplib-dev libboost-dev libmpfr-dev libgmp-dev libgtest-dev
  librapidcheck-dev libflint-arb-dev fonts-dejavu-core python3 git)
bench_packages=(libsundials-dev)
clang_packages=(clang libclang-rt-14-dev)
wasm_packages=(emscripten nodejs)
web_test_packages=(chromium)
coverage_packages=(python3)
docs_packages=(doxygen)
cluster_packages=(slurmctld slurmd slurm-client munge parallel)
python_packages=(python3-dev python3-venv)
manual_packages=(groff-base mandoc zsh fish)  # the pages of man and the completion are tried with them, where they are
deb_packages=(dpkg-dev lintian debootstrap python3-numpy)
lint_packages=(clang clang-format)

# missing_of PACKAGE...: those of them that are not installed, one on a line. One question to dpkg for all.
missing_of() {
  local installed name
  installed=$(dpkg-query -W -f='|${Package} ${db:Status-Status}|' "$@" 2>/dev/null || true)
  for name in "$@"; do
    [[ $installed == *"|$name installed|"* ]] || echo "$name"
  done
}

# need PACKAGE...: installs the Debian packages that are missing, and does nothing when none is.
need() {
  local missing sudo=()
  command -v dpkg-query >/dev/null || { step "no dpkg here: taking for granted what Debian calls $*"; return; }
  mapfile -t missing < <(missing_of "$@")
  [ ${#missing[@]} = 0 ] && return
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || fail "missing packages; as root, run
apt-get update && apt-get install -y --no-install-recommends ${missing[*]}"
    sudo=(sudo)
    sudo -v
  fi
  step "install ${missing[*]}"
  local apt=("${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600)
  quietly build/apt-update.log "${apt[@]}" update ||
    step "apt-get update failed; trying with the package lists there are"
  quietly build/apt.log "${apt[@]}" install -y --no-install-recommends "${missing[@]}"
}
