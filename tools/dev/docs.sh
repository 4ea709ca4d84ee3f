# The guide as HTML.
. tools/dev/python_environment.sh

# verb_docs [SPHINX ARGUMENT...]: the guide, with its time. Every warning is an error.
verb_docs() {
  need "${docs_packages[@]}"
  find_python 11 python3-venv
  local begin=$SECONDS parts=$PWD/build/docs-parts
  python_environment "$parts/tools" docs/requirements.txt docs/mathjax_alone.txt
  step "declarations of the public headers"
  rm -rf build/docs "$parts/xml" "$parts/static" "$parts/doctrees"
  mkdir -p "$parts/xml" "$parts/static/mathjax"
  (cat docs/_sphinx/Doxyfile && printf 'OUTPUT_DIRECTORY = %s\n' "$parts") >"$parts/Doxyfile"
  quietly "$parts/doxygen.log" doxygen "$parts/Doxyfile"
  cp "$parts"/tools/lib/python3*/site-packages/mathjax/static/mathjax/es5/tex-svg.js "$parts/static/mathjax/"
  step "pages"
  quietly build/docs-parts/sphinx.log env SLAPSTICK_DOCS_STATIC="$parts/static" SLAPSTICK_DOCS_XML="$parts/xml" \
    "$parts/tools/bin/python" -B -m sphinx -b html -W --keep-going -q -d "$parts/doctrees" "$@" docs build/docs
  step "the guide is build/docs/index.html; it took $((SECONDS - begin)) s"
}
