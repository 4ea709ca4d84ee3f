"""Runs the built program in a folder of its own. Only what Debian's python3-minimal has is used (no json, no unittest)."""
import os
import signal
import subprocess
import sys
import tempfile

PROGRAM = os.path.abspath(sys.argv[1])
HANGS = 600  # seconds: a guard against a run that hangs; no test says with it how fast a run is
SEARCHES = ('orbit', 'continue', 'curve')


class Outcome:
    def __init__(self, status, out, err):
        self.status, self.out, self.err = status, out, err


def unhurried(words):
    """A search ends after ten seconds if the caller says nothing else: here it ends for what it has tried, however slow the machine."""
    if len(words) < 3 or words[0] not in SEARCHES or {'--starts', '--seconds'} & set(words):
        return words
    return (words[0], '--seconds', '1000000', *words[1:])


def run(*words, **options):
    """slapstick WORDS; `out` is a file to take standard output instead."""
    done = subprocess.run([PROGRAM, *unhurried(words)], stdin=subprocess.DEVNULL, stdout=options.get('out', subprocess.PIPE),
                          stderr=subprocess.PIPE, check=False, timeout=HANGS, env=options.get('env'))
    return Outcome(done.returncode, (done.stdout or b'').decode(), done.stderr.decode())


def good(*words):
    """A run that must succeed and say nothing on standard error; returns its standard output."""
    done = run(*words)
    assert done.status == 0, (words, done.status, done.err)
    assert done.err == '', (words, done.err)
    return done.out


def refused(status, *words, **options):
    """A run that must fail with `status`, one line on standard error and nothing on standard output; returns the line."""
    done = run(*words, **options)
    assert done.status == status, (words, done.status, done.err)
    assert done.err.startswith('slapstick: ') and done.err.count('\n') == 1 and done.err.endswith('\n'), (words, done.err)
    assert done.out == '', (words, done.out)
    return done.err


def says(line, *parts):
    for part in parts:
        assert part in line, (part, line)


def read(path):
    with open(path, encoding='utf-8') as file:
        return file.read()


def table(text):
    """(column names, rows as lists of words) of a CSV text; every row is whole."""
    assert text.endswith('\n'), text[-100:]
    lines = text.splitlines()
    rows = [line.split(',') for line in lines[1:]]
    columns = lines[0].split(',')
    assert all(len(row) == len(columns) for row in rows)
    return columns, rows


def main(cases):
    """argv: PROGRAM CASE. Runs the function of that name in an empty folder."""
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a background shell may have it ignored, and children would inherit that
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        cases[sys.argv[2]]()
        os.chdir('/')
