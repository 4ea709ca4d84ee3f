"""A certificate is a file from anywhere: cut off, with lines missing, with words that are no numbers, it is refused and never crashes the verifier.

    certificate_file_test.py PROGRAM test_NAME [SLAPSTICK]
"""
import subprocess
import sys

import motions
from forgery import ALL, PROGRAM, check, find, forged, refused, unreadable


def test_file_that_ends_too_early():
    for motion in ALL:
        lines = motion()
        for n in range(len(lines)):
            unreadable(lines[:n] if n else b'', 'the file ends here, without `done`')
    text = '\n'.join(motions.ball())
    for n in range(len(text) - 6):
        assert check(text[:n].encode())[0] != 0, n
    unreadable(motions.ball() + ['done 3'], 'something follows `done`')
    unreadable(forged(motions.ball(), 'done', {1: 4}), '4 is not in the range 3 .. 3')


def test_every_line_is_needed():
    for motion in ALL:
        lines = motion()
        for n, text in enumerate(lines):
            if motion is motions.pressed_by_a_spring and text.startswith('force 0 '):
                continue  # static friction holds the block without that pull as well
            assert check(lines[:n] + lines[n + 1:])[0] != 0, text


def test_numbers_that_are_none():
    lines = motions.ball()
    for bad in ('nan', '-nan', 'inf', '-inf', '1', '0.5', '1e3', '0x1p+5000', '0x1', '0x1.00000000000001p+0', '', '0x1p+0 0x1p+0', 'x', '+0x1p+0',
                '0x1p+0\t', '\0'):
        for start, k in (('omega', 1), ('coordinate', 2), ('force', 3), ('stop', 4), ('number', 3), ('start', 3), ('segment', 4), ('state', 1), ('done', 4)):
            if (start, bad) in (('coordinate', '0x1p+0 0x1p+0'), ('stop', '0x1p+0 0x1p+0')):
                continue  # the second one is a name
            i = find(lines, start)
            parts = lines[i].split(' ')
            parts[k] = bad
            status, text = check(lines[:i] + [' '.join(parts)] + lines[i + 1:])
            assert status == 2 and f'line {i + 1}: ' in text, (start, k, bad, status, text)
    for bad in ('-2', '7', '1.0', '0x1p+0', '99999999999999999999', ''):
        for start, k in (('size', 1), ('coordinate', 1), ('force', 1), ('stop', 1), ('number', 2), ('segment', 1), ('blow', 1), ('impact', 1)):
            i = find(lines, start)
            parts = lines[i].split(' ')
            parts[k] = bad
            status, text = check(lines[:i] + [' '.join(parts)] + lines[i + 1:])
            assert status == 2, (start, k, bad, status, text)


def test_words_that_are_none():
    for start, k in (('law', 1), ('segment', 5), ('end', 1)):
        unreadable(forged(motions.ball(), start, {k: 'nothing'}), 'nothing')
    unreadable(forged(motions.kink(), 'polyline', {3: 'time'}), 'time')
    unreadable(forged(motions.kink(), 'segment', {5: 2}), '2 is not in the range 0 .. 1')


def test_model_that_is_none():
    unreadable(forged(motions.ball(), 'stop', {4: 1.5}), 'the restitution is not in [0, 1]')
    unreadable(forged(motions.ball(), 'stop', {2: 0}), 'a pair of one body')
    unreadable(forged(motions.released(), 'friction', {5: 0.75}), 'kinetic friction is greater than static friction')
    unreadable(forged(motions.released(), 'omega', {1: 0.0}), 'a harmonic force needs omega > 0')
    unreadable(forged(motions.cradle(), 'number', {1: 1, 2: -1}), 'there is no number of contact bodies')


def test_garbage():
    unreadable(b'\x00\xff' * 5000, 'line 1')
    unreadable(['slapstick-certificate 2'] + motions.ball()[1:], 'line 1: 2 is not in the range 3 .. 3')
    for n, text in enumerate(motions.ball()):
        lines = motions.ball()
        lines[n] = 'nonsense' + text
        unreadable(lines, f'line {n + 1}: ', 'nonsense')
        lines[n] = text + ' nonsense'
        if not text.startswith(('model', 'coordinate', 'stop')):
            unreadable(lines, f'line {n + 1}: ')


def test_huge_numbers_end_in_a_refusal():
    lines = motions.ball()
    refused(forged(lines, 'segment', {4: 1e300}), 'is too long to be followed')
    refused(forged(lines, 'force', {3: 1e300}), 'segment 0')
    refused(forged(lines, 'state', {1: -1e300}), 'segment 0')
    refused(forged(lines, 'state', {2: 1e308}), 'segment 0')
    refused(forged(lines, 'coordinate', {2: 1e-300}), 'segment 0')


def test_usage():
    done = subprocess.run([PROGRAM, '--help'], stdout=subprocess.PIPE, check=False)
    assert done.returncode == 0 and b'slapstick-verify FILE' in done.stdout
    for words in ([], ['a', 'b'], ['/nonexistent']):
        done = subprocess.run([PROGRAM, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
        assert done.returncode == 2 and done.stdout == b'' and done.stderr, words


if __name__ == '__main__':
    globals()[sys.argv[2]]()
