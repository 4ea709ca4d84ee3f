"""A page does what it prints: every `$ command` is run, its output compared with the lines below it.

Commands stand in ```console blocks or are indented by four columns; a line that begins with "> " goes on with a command. Of an indented line `slapstick ..` without a `$` only the exit status is looked at. A block of a page below a line that ends with "`NAME.toml`:" is that file. `<!-- files: FOLDER -->` names a folder of the repository whose files are there.
Numbers may differ in the tenth digit, words may not. Only what Debian's python3-minimal has is used.
"""
import math
import os
import re
import shutil
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
HANGS = 600  # seconds: a guard against a command that hangs; no test says with it how fast one is
FILE = re.compile(r'`([\w-]+\.\w+)`:?$')
FOLDER = re.compile(r'<!-- files: (\S+) -->')


def fences(text):
    """(what stands behind ```, lines, the line of text before) of every fenced block; None, a run of lines, '' of what lies between."""
    kind, lines, before = None, [], ''
    for line in text.splitlines():
        if line.startswith('```'):
            yield kind, lines, before
            kind = line[3:].strip() if kind is None else None
            lines = []
        else:
            lines.append(line)
        if kind is None and line.strip() and not line.startswith('```'):
            before = line
    yield kind, lines, before


def commands(lines, indent):
    """[command, printed lines] of lines that begin with `indent` and "$ "."""
    found = []
    for line in lines:
        if line.startswith(indent + '> ') and found and found[-1] is not None and found[-1][1] == []:
            found[-1][0] += '\n' + line[len(indent) + 2:]
        elif line.startswith(indent + '$ '):
            found.append([line[len(indent) + 2:], []])
        elif line.startswith(indent + 'slapstick ') and not re.search(r'VERB|MODEL', line) and (not found or found[-1] is None):
            found += [[line[len(indent):], None], None]
        elif line.startswith(indent) and found and found[-1] is not None:
            found[-1][1].append(line[len(indent):])
        elif found and found[-1] is not None:
            found.append(None)
    return [block for block in found if block is not None]


def blocks(text):
    """(command, printed lines) of a page, in order."""
    found = []
    for kind, lines, _ in fences(text):
        if kind is None:
            found += commands(lines, '    ')
        elif kind == 'console':
            found += commands(lines, '')
    return found


def write_files(text, folder):
    """Puts the files of a page into a folder: those of the folders that the page names, and those that the page shows."""
    for named in FOLDER.findall(text):
        shutil.copytree(os.path.join(ROOT, named), folder, dirs_exist_ok=True)
    for kind, lines, before in fences(text):
        shown = FILE.search(before.rstrip())
        if kind in ('toml', 'csv') and shown:
            with open(os.path.join(folder, shown[1]), 'w', encoding='utf-8') as file:
                file.write('\n'.join(lines) + '\n')


def pictures(text):
    """(names of the page's pictures, those of them that its Python draws: their name, or it without the ending, stands there in quotes)."""
    names = re.findall(r'!\[[^\]]*\]\((?:\.\./)?images/([\w-]+\.png)\)', text)
    program = '\n'.join('\n'.join(lines) for kind, lines, _ in fences(text) if kind == 'python')
    return names, [name for name in names if f'"{name}"' in program or f'"{name[:-4]}"' in program]


def number(word):
    try:
        return float(word.strip('",'))
    except ValueError:
        return None


def same(printed, now):
    words, other = re.split('[ ,]+', printed.rstrip()), re.split('[ ,]+', now.rstrip())
    if len(words) != len(other):
        return False
    for a, b in zip(words, other):
        x, y = number(a), number(b)
        if a != b and (x is None or y is None or not math.isclose(x, y, rel_tol=1e-9, abs_tol=1e-9)):
            return False
    return True


def check(program, text, folder):
    """Runs the commands of a page's text in a folder."""
    environment = dict(os.environ, PATH=os.path.dirname(program) + ':' + os.environ['PATH'], LC_ALL='C')
    found = blocks(text)
    assert found, 'the page shows no command'
    write_files(text, folder)
    for command, printed in found:
        done = subprocess.run(['sh', '-c', command], cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              stdin=subprocess.DEVNULL, check=False, timeout=HANGS)
        assert printed is not None or done.returncode == 0, (command, done.returncode)
        if printed is None:
            continue
        lines = done.stdout.decode().splitlines()
        assert done.stderr == b'', (command, done.stderr)
        assert len(lines) == len(printed) and all(map(same, printed, lines)), (command, printed, lines)
