"""Tries tools/memory with small programs that have one thing wrong each (or nothing).

    memory_test.py TOOL
"""
import json
import os
import subprocess
import sys
import tempfile

TOOL = os.path.abspath(sys.argv[1])
HANGS = 600  # seconds: a guard against a run that hangs

# A program that knows two verbs, and says which endings there are where it refuses one.
PROGRAM = '''#!{python}
import json, os, sys
verb, words = sys.argv[1], sys.argv[2:]
if verb == 'describe':
    print(json.dumps({{'verbs': {verbs}}}))
elif '--trajectory' in words:
    sys.exit("slapstick: cannot write 'x.npy': tables are .csv, .npz or .h5, and .npy is not one of them")
elif '--plot' in words:
    sys.exit("slapstick: --plot: 'x.npy' must end in .png, .pdf or .tex")
else:
    filling = os.environ.get('MALLOC_PERTURB_', 'none')
    {does}
'''
VERBS = [{'name': 'simulate', 'arguments': [{'name': 'MODEL'}, {'name': '--level', 'words': ['low', 'high']}]},
         {'name': 'show', 'arguments': [{'name': '--out'}]}]
LINES = ['simulate a --level low', 'simulate a --level high x.csv x.npz x.h5', '', 'show --out x.png x.pdf x.tex']


def script(path, does='print(verb)', verbs=VERBS):
    with open(path, 'w', encoding='utf-8') as file:
        file.write(PROGRAM.format(python=sys.executable, verbs=json.dumps(verbs), does=does))
    os.chmod(path, 0o755)
    return path


def outcome(verb, lines, does='print(verb)', verbs=VERBS, sanitized='print(verb)'):
    """(status, what the tool prints) for a list of these lines and programs that do this."""
    with tempfile.TemporaryDirectory() as folder:
        commands = os.path.join(folder, 'commands.txt')
        with open(commands, 'w', encoding='utf-8') as file:
            file.write('\n'.join(lines) + '\n')
        programs = [script(os.path.join(folder, 'ordinary'), does, verbs), script(os.path.join(folder, 'sanitized'), sanitized, verbs)]
        done = subprocess.run([sys.executable, '-B', TOOL, verb, *programs, '--list', commands], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, universal_newlines=True, check=False, timeout=HANGS)
        return done.returncode, done.stdout


def listed(expected, lines=LINES, **how):
    """What the list lacks is named. Keys of the model file are lacking in each of these lists."""
    status, said = outcome('list', lines, **how)
    assert status == 1 and expected in said, (expected, status, said)


def ran(expected, does='print(verb)', sanitized=None, lines=('simulate a',)):
    """A run that must find a fault, or none if nothing is expected."""
    status, said = outcome('run', lines, does=does, sanitized=sanitized or does)
    assert status == bool(expected) and (expected or 'are right') in said, (expected, status, said)


def others(said):
    return [line for line in said.splitlines() if not line.startswith(('key of a model file: ', 'memory: '))]


# The list.
assert others(outcome('list', LINES)[1]) == [], outcome('list', LINES)
listed('verb: show: no command', LINES[:2])
listed('verb: show: no command', [*LINES[:2], '2: show --out x.png x.pdf x.tex'])  # a refusal runs nothing of a verb
listed('argument: show --out: no command', [*LINES[:2], 'show x.png x.pdf x.tex'])
listed('argument: simulate --level high: no command', ['simulate a --level low x.csv x.npz x.h5', LINES[3]])
listed('format: .npz of --trajectory', ['simulate a --level low x.csv x.h5', 'simulate a --level high', LINES[3]])
listed('format: .tex of --plot', [*LINES[:2], 'show --out x.png x.pdf'])
listed('key of a model file: compliant_stop.law = pulls', [*LINES, 'show driven.toml'])
listed('key of a model file: stop.restitution_over_speed', [*LINES, 'show driven.toml'])
assert 'key of a model file: signal.column:' not in outcome('list', [*LINES, 'show driven.toml'])[1]

# Runs.
ran('')
ran('standard output differs: malloc 191 / malloc 63', does='print(filling)')
ran('f.txt differs: malloc 191 / malloc 63', does='open("f.txt", "w").write(filling)')
ran('standard output differs: malloc 191 = malloc 63 / sanitized', sanitized='print(1)')
ran('message differs', does='sys.exit(filling)', lines=('1: simulate a',))
ran('status 1, not 0', does='sys.exit(1)')
ran('sanitized: a.cpp:3: runtime error: index 7', sanitized='print("a.cpp:3: runtime error: index 7", file=sys.stderr)')
ran('ERROR: AddressSanitizer: heap-use-after-free', sanitized='print("=1=ERROR: AddressSanitizer: heap-use-after-free", file=sys.stderr)')
ran('', does='print(os.getcwd())')  # where a command runs is no difference
ran('', does='print(os.path.abspath(__file__))')  # nor what the program is called
ran('', does='print(open("f.txt").read() if verb == "show" else open("f.txt", "w").write("1"))', lines=('simulate a', 'show a'))
status, said = outcome('run', ['simulate a'], does='print(filling)')
assert 'WRONG slapstick simulate a' in said and '0 of 1 commands are right' in said, said
print('tools/memory finds what it is for')
