# The format of the sources, and what clang-tidy says of them. Uses `packages`, `lint_packages` and `python_packages`.
# clang-tidy is PyPI's, pinned: Debian's walks through the headers of all libraries with each check, for each source.
. tools/dev/python_environment.sh

# format_files CLANG-FORMAT ARGUMENT...: clang-format on every C++ file.
format_files() {
  find include src apps web/engine verify campaign python test fuzz bench examples -name '*.[ch]pp' -print0 |
    xargs -0 -r -n 16 -P "$(nproc)" clang-format "$@"
}

# verb_format [--check]
verb_format() {
  need clang-format
  if [ "${1:-}" = --check ]; then
    step "check the format"
    format_files --dry-run -Werror || fail "the format differs: run ./dev format"
  else
    step "clang-format in place"
    format_files -i
  fi
}

verb_lint() {
  need "${packages[@]}" "${lint_packages[@]}"
  find_python 10 "${python_packages[@]}"
  step "check the pages"
  tools/check_english
  tools/check_links
  verb_format --check
  step "configure (lint) in build-lint/"
  quietly build-lint/configure.log cmake --preset lint
  python_environment build-lint/tools tools/lint_requirements.txt
  step "clang-tidy"
  find src apps verify campaign -name '*.cpp' ! -path '*/peers/*' -print0 |
    xargs -0 -r -n 1 -P "$(nproc)" build-lint/tools/bin/clang-tidy -p build-lint --quiet
}
