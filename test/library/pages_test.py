#!/usr/bin/env python3
"""A page of docs/models does what it prints: every `$ command` is run, its output compared with the lines below it.

    pages_test.py PROGRAM PAGE

Numbers may differ in the tenth digit, words may not. Only what Debian's python3-minimal has is used.
"""
import os
import subprocess
import sys
import tempfile

PROGRAM, PAGE = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])


def blocks(text):
    """(command, printed lines) of the indented lines that begin with "$ "."""
    found = []
    for line in text.splitlines():
        if line.startswith('    $ '):
            found.append((line[6:], []))
        elif line.startswith('    ') and found and found[-1] is not None:
            found[-1][1].append(line[4:])
        elif found and found[-1] is not None:
            found.append(None)
    return [block for block in found if block is not None]


def number(word):
    try:
        return float(word.strip('",'))
    except ValueError:
        return None


def same(printed, now):
    words, other = printed.split(), now.split()
    if len(words) != len(other):
        return False
    for a, b in zip(words, other):
        x, y = number(a), number(b)
        if a != b and (x is None or y is None or abs(x - y) > 1e-9 * max(1.0, abs(x))):
            return False
    return True


def main():
    with open(PAGE, encoding='utf-8') as file:
        text = file.read()
    name = os.path.basename(PAGE)[:-len('.md')]
    for part in ('\n## Equations\n', '\n## Source\n', '\n## Numbers\n', 'images/%s.png' % name, '--plot %s.png' % name):
        assert part in text, (PAGE, 'has no', part)
    assert os.path.getsize(os.path.join(os.path.dirname(PAGE), 'images', name + '.png')) > 1000
    environment = dict(os.environ, PATH=os.path.dirname(PROGRAM) + ':' + os.environ['PATH'], LC_ALL='C')
    found = blocks(text)
    assert sum(bool(printed) for _, printed in found) > 0, 'the page shows no number'
    with tempfile.TemporaryDirectory() as folder:
        for command, printed in found:
            done = subprocess.run(['sh', '-c', command], cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  stdin=subprocess.DEVNULL, check=False, timeout=250)
            lines = done.stdout.decode().splitlines()
            assert done.stderr == b'', (command, done.stderr)
            assert len(lines) == len(printed) and all(map(same, printed, lines)), (command, printed, lines)
        assert os.path.getsize(os.path.join(folder, name + '.png')) > 1000


main()
