"""tools/check_paths must find a file that a paper names and that is not there, and only such."""
import sys

import trees

PAPERS = {name: '' for name in ('docs/developers/architecture.md', 'docs/developers/proofs.md', 'docs/reference/library.md', 'HACKING.md')}


def tree(line, files=()):
    return PAPERS | {'docs/developers/architecture.md': line + '\n'} | {name: '' for name in files}


CASES = [
    ('a file by its folder', tree('See `flow/motion.cpp`.', ['src/flow/motion.cpp']), None),
    ('a public header', tree('See `flow/motion.hpp`.', ['include/slapstick/flow/motion.hpp']), None),
    ('a file by its name', tree('See `motion.cpp`.', ['src/flow/motion.cpp']), None),
    ('a file that has moved', tree('See `attractor/motion.cpp`.', ['src/flow/motion.cpp']),
     'docs/developers/architecture.md:1: there is no attractor/motion.cpp'),
    ('a file that is gone', tree('First.\nSee `motion_events.cpp`.', ['src/flow/motion.cpp']), 'docs/developers/architecture.md:2: there is no motion_events.cpp'),
    ('no file', tree('`Motion::advance` and `orbit`'), None),
]

sys.exit(trees.run(sys.argv[1], CASES))
