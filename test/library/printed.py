"""A page does what it prints: every `$ command` is run, its output compared with the lines below it.

Numbers may differ in the tenth digit, words may not. Only what Debian's python3-minimal has is used.
"""
import os
import re
import subprocess


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
    words, other = re.split('[ ,]+', printed), re.split('[ ,]+', now)
    if len(words) != len(other):
        return False
    for a, b in zip(words, other):
        x, y = number(a), number(b)
        if a != b and (x is None or y is None or abs(x - y) > 1e-9 * max(1.0, abs(x))):
            return False
    return True


def check(program, text, folder):
    """Runs the commands of a page's text in a folder."""
    environment = dict(os.environ, PATH=os.path.dirname(program) + ':' + os.environ['PATH'], LC_ALL='C')
    found = blocks(text)
    assert sum(bool(printed) for _, printed in found) > 0, 'the page shows no number'
    for command, printed in found:
        done = subprocess.run(['sh', '-c', command], cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              stdin=subprocess.DEVNULL, check=False, timeout=250)
        lines = done.stdout.decode().splitlines()
        assert done.stderr == b'', (command, done.stderr)
        assert len(lines) == len(printed) and all(map(same, printed, lines)), (command, printed, lines)
