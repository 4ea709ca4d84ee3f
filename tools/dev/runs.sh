# Long runs of the built programs: the cluster, the paper, the benchmarks, the campaigns. Uses the lists of packages.sh.
. tools/dev/python_environment.sh

verb_cluster() {
  need "${packages[@]}" "${cluster_packages[@]}"
  build_preset release slapstick
  [ "$(id -u)" = 0 ] || { step "no cluster: Slurm's daemon wants root"; exit 0; }
  local begin=$SECONDS
  tools/cluster build/slapstick build/cluster
  step "the cluster took $((SECONDS - begin)) s"
}

# verb_reproduce [ARGUMENT...]: arguments are those of slapstick reproduce; --out is out/ unless they name it.
verb_reproduce() {
  need "${packages[@]}"
  build_preset release slapstick
  step "reproduce the paper"
  case " $* " in *" --out"[\ =]*) ;; *) set -- --out out "$@" ;; esac
  exec build/slapstick reproduce "$@"
}

verb_bench() {
  need "${packages[@]}" "${bench_packages[@]}" "${python_packages[@]}"
  build_preset bench bench_worker bench_roofline bench_batch compare_peers
  python=$(command -v "${SLAPSTICK_PYTHON:-python3}")  # for python_environment
  python_environment build-bench/python bench/requirements.txt
  step "the peers agree on the impacts"
  quietly build-bench/compare_peers.log build-bench/compare_peers
  step "ratios, scaling, roofline"
  exec build-bench/python/bin/python bench/ratios.py build-bench --python build-bench/python/bin/python "$@"
}

# verb_campaign [NAME ARGUMENT...]: one campaign in full, or the list of them.
verb_campaign() {
  need "${packages[@]}"
  if [ "${1:-}" = peers ]; then
    need "${bench_packages[@]}"
    build_preset bench slapstick_campaign_peers
    exec build-bench/slapstick-campaign-peers "$@"
  fi
  build_preset release slapstick_campaign
  [ $# != 0 ] || step "besides: peers, contact queries through slapstick, CVODE and odeint"
  exec build/slapstick-campaign "$@"
}
