"""Runs a check on small trees of files made for it, each with one thing wrong (or nothing)."""
import os
import subprocess
import sys
import tempfile


def outcome(check, files):
    """(exit status, output) of `check` on a tree of {path: text}."""
    with tempfile.TemporaryDirectory() as root:
        for path, text in files.items():
            path = os.path.join(root, path)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, 'w', encoding='utf-8') as file:
                file.write(text)
        done = subprocess.run([sys.executable, '-B', check, root], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              universal_newlines=True, check=False)
        return done.returncode, done.stdout


def run(check, cases):
    """`cases`: (name, files, expected line of output, or None if the tree is in order). Returns the exit status."""
    wrong = 0
    for name, files, expected in cases:
        status, output = outcome(check, files)
        good = status == 0 if expected is None else status == 1 and expected in output
        if not good:
            wrong += 1
            print(f'FAILED {name}: expected {expected or "no violation"}, got status {status} and\n{output}')
    print(f'{len(cases)} trees, {wrong} judged wrongly')
    return 1 if wrong or not cases else 0
