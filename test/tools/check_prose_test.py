"""tools/check_prose must find each kind of violation, and only violations; and what it wraps must keep its words."""
import os
import re
import subprocess
import sys
import tempfile

import trees

CHECK = sys.argv[1]
LONG = '/// ' + 'A sentence about springs and dampers that goes on and on. ' * 3


def tree(text, path='src/flow/motion.cpp'):
    return {path: text}


CASES = [
    ('a source that says what it is for', tree('/// Runs motions.\n#include <cmath>\n'), None),
    ('a header that does', tree('#pragma once\n/// What motions are.\n#include <cmath>\n', 'include/slapstick/a.hpp'), None),
    ('a test need not', tree('#include <cmath>\n', 'test/flow/a_test.cpp'), None),
    ('a long line of code', tree('/// Says much.\nconst char* text = "' + 'x' * 130 + '";\n'), None),
    ('an address in a string', tree('/// Says much.\nconst char* text = "http://' + 'x' * 130 + '";\n'), None),

    ('a source that does not', tree('#include <cmath>\n'), 'src/flow/motion.cpp:1: does not open'),
    ('a header that does not', tree('#pragma once\n#include <cmath>\n/// Later.\n', 'src/flow/a.hpp'), 'does not open'),
    ('one word', tree('/// Motions\n#include <cmath>\n'), 'which says nothing'),
    ('a wide comment', tree('/// Runs motions.\n' + LONG + '\n'), 'src/flow/motion.cpp:2: its comment ends in column'),
    ('a wide comment behind code', tree('/// Runs motions.\nint a;  ' + LONG + '\n'), 'its comment ends in column'),
    ('a wide comment of a test', tree(LONG + '\n', 'test/flow/a_test.cpp'), 'test/flow/a_test.cpp:1: its comment ends in column'),
    ('nothing to check', {'README.md': ''}, 'no C++ file'),
]


def wrapped(text):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'a.cpp')
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text)
        subprocess.run([sys.executable, '-B', CHECK, '--wrap', path], check=True)
        with open(path, encoding='utf-8') as file:
            return file.read()


def words(text):
    return re.sub(r'///<?|//', ' ', text).split()


def keeps_words():
    before = LONG + '\n/// and its end.\nint a;  ///< ' + LONG[4:] + '\n  /// - ' + LONG[4:] + '\n'
    after = wrapped(before)
    kept = sorted(words(before)) == sorted(words(after)) and all(len(line) <= 120 for line in after.splitlines())
    again = wrapped(after) == after
    formula = wrapped('/// ' + 'so that ' * 13 + 'h = a + b + c\n')
    together = 'h = a + b + c' in formula
    for what, true in (('words and widths', kept), ('nothing more to do', again), ('formulas', together)):
        print('ok' if true else 'FAILED', what)
    return kept and again and together


status = trees.run(CHECK, CASES)
sys.exit(status if keeps_words() else 1)
