# The explorer: its page, its tests. Uses `packages`, `wasm_packages` and `web_test_packages`.

# web_tools: the packages of web/package-lock.json in web/node_modules, anew when the lock has changed.
# None of them is in the page.
web_tools() {
  command -v npm >/dev/null || need npm
  [ "$(cat web/node_modules/stamp 2>/dev/null)" != "$(sha256sum <web/package-lock.json)" ] || return 0
  step "npm packages in web/node_modules"
  quietly build/web-npm.log npm ci --prefix web --ignore-scripts --no-audit --no-fund
  sha256sum <web/package-lock.json >web/node_modules/stamp
}

# npm_answers: whether the packages of the page are here, or can be had.
# A machine without npm's registry tests everything except the explorer.
npm_answers() {
  [ ! -f web/node_modules/stamp ] || return 0
  command -v npm >/dev/null || return 0  # web_tools installs npm
  npm ping --fetch-retries 1 --fetch-timeout 20000 >/dev/null 2>&1
}

# web_page: the engine as WebAssembly, the types checked, the page in build/web.
web_page() {
  export NODE_PATH=/usr/share/nodejs
  build_preset wasm engine
  web_tools
  step "the page in build/web"
  node web/node_modules/typescript/bin/tsc -p web
  node web/build.mjs build-wasm build/web
}

# verb_web [test|test-all]: the page, and its tests. What they print is in build/web-test.log too, for the counts.
verb_web() {
  need "${packages[@]}" "${wasm_packages[@]}"
  web_page
  case ${1:-} in
    "") step "done: build/web; build/slapstick explore serves it" ;;
    test | test-all)
      need "${web_test_packages[@]}"
      node web/test/run.mjs build/web "$@" | tee build/web-test.log
      step "the explorer took $SECONDS s"
      ;;
    *) fail "./dev web knows test and test-all, not '$1'" ;;
  esac
}
