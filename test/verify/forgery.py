"""What the tests of slapstick-verify share: asking it about a certificate, and forging one.

sys.argv: the test's script, PROGRAM, test_NAME, [SLAPSTICK].
"""
import os
import subprocess
import sys
import tempfile

import motions
from motions import line

PROGRAM = sys.argv[1]
HANGS = 600  # seconds: a guard against a verifier that hangs; no test says with it how fast it is
ALL = [motions.ball, motions.dead_ball, motions.chatter, motions.rubbing, motions.oscillator, motions.released, motions.cradle,
       lambda: motions.cradle('sequence'), motions.bumper, motions.kink, motions.loop, motions.zone, motions.bounded,
       motions.two_restitutions, motions.lifted, motions.pressed_by_a_spring]


def check(lines):
    """(exit status, everything printed) for a certificate."""
    text = lines if isinstance(lines, bytes) else ('\n'.join(lines) + '\n').encode()
    done = subprocess.run([PROGRAM, '-'], input=text, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False, timeout=HANGS)
    return done.returncode, done.stdout.decode()


def proved(lines):
    status, text = check(lines)
    assert status == 0 and text.endswith('\nproved\n') and 'line ' not in text, text
    return text


def proved_but_for(lines, what):
    status, text = check(lines)
    assert status == 3 and text.endswith(f'\nproved but for {what}\n') and 'line ' not in text, text
    return text


def refused(lines, *reasons):
    """Not proved; one line of the answer has all the reasons."""
    status, text = check(lines)
    assert status == 1 and '\nnot proved: ' in text, (status, text)
    assert any(all(r in answer for r in reasons) for answer in text.splitlines() if answer.startswith('line ')), (reasons, text)


def unreadable(lines, *reasons):
    status, text = check(lines)
    assert status == 2 and all(r in text for r in reasons), (status, reasons, text)


def find(lines, start, nth=0):
    return [i for i, text in enumerate(lines) if text.startswith(start)][nth]


def forged(lines, start, words, nth=0):
    """The certificate with words of one line, by their index, replaced."""
    lines = list(lines)
    i = find(lines, start, nth)
    parts = lines[i].split(' ')
    for k, value in words.items():
        parts[k] = line(value)
    lines[i] = ' '.join(parts)
    return lines


def value(lines, start, k, nth=0):
    return float.fromhex(lines[find(lines, start, nth)].split(' ')[k])


def without(lines, start, nth=0):
    lines = list(lines)
    del lines[find(lines, start, nth)]
    return lines


def certificate_of(*words):
    """What `slapstick simulate` certifies, as bytes; or None where there is no program."""
    if len(sys.argv) < 4:
        return None
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, 'run.txt')
        subprocess.run([sys.argv[3], 'simulate', *words, '--certify', name], stdout=subprocess.DEVNULL, check=True)
        with open(name, 'rb') as file:
            return file.read()
