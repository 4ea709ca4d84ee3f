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
    unreadable(forged(motions.ball(), 'done', {1: 4}), 'line 31: 4 is not')


def test_every_line_is_needed():
    for motion in ALL:
        if motion is motions.rattle:
            continue  # a far side that is held leads away as well
        lines = motion()
        struck = any(text.startswith('blow') for text in lines)
        for n, text in enumerate(lines):
            if text.startswith('event') and 'impact' not in text or text.startswith('stop') and not struck:
                continue  # tells the reader what follows from the rest, or names what nothing happens to
            assert check(lines[:n] + lines[n + 1:])[0] != 0, text


def test_numbers_that_are_none():
    lines = motions.ball()
    for bad in ('nan', '-nan', 'inf', '-inf', '1', '0.5', '1e3', '0x1p+5000', '0x1', '0x1.00000000000001p+0', '', '0x1p+0 0x1p+0', 'x', '+0x1p+0',
                '0x1p+0\t', '\0'):
        for start, k in (('step', 2), ('step', 5), ('state', 1), ('segment', 5), ('end', 3), ('inertia', 2), ('period', 1), ('row', 4)):
            i = find(lines, start)
            parts = lines[i].split(' ')
            parts[k] = bad
            status, text = check(lines[:i] + [' '.join(parts)] + lines[i + 1:])
            assert status == 2 and f'line {i + 1}: ' in text, (start, k, bad, status, text)
    for bad in ('-1', '7', '1.0', '0x1p+0', '99999999999999999999', ''):
        for start, k in (('sizes', 2), ('stop', 1), ('row', 2), ('row', 3), ('guard', 1), ('segment', 2), ('prove', 1), ('blow', 2)):
            i = find(lines, start)
            parts = lines[i].split(' ')
            parts[k] = bad
            status, text = check(lines[:i] + [' '.join(parts)] + lines[i + 1:])
            assert status == 2, (start, k, bad, status, text)


def test_garbage():
    unreadable(b'\x00\xff' * 5000, 'line 1')
    unreadable(['slapstick-certificate 2'] + motions.ball()[1:], 'line 1: 2 is not in the range 1 .. 1')
    for n, text in enumerate(motions.ball()):
        lines = motions.ball()
        lines[n] = 'nonsense' + text
        unreadable(lines, f'line {n + 1}: ', 'nonsense')
        lines[n] = text + ' nonsense'
        if not text.startswith(('model', 'mode', 'stop')):
            unreadable(lines, f'line {n + 1}: ')


def test_huge_numbers_end_in_a_refusal():
    lines = motions.ball()
    refused(forged(lines, 'segment', {5: 1e300}), 'is too long to be followed')
    refused(forged(lines, 'row 1', {4: 1e300}), 'segment 0')
    refused(forged(lines, 'state', {1: -1e300}), 'segment 0')
    refused(forged(lines, 'state', {2: 1e308}), 'segment 0')
    refused(forged(lines, 'step', {2: 1e308}), 'h >= 1e+308 claimed')
    refused(forged(lines, 'end', {3: 1e300}), 'DELTA = 1.0000000000000001e+300 is too long to be followed')
    refused(forged(motions.touching(), 'end', {3: 1e300}), 'NOISE = 1.0000000000000001e+300, rounding explains')


def test_usage():
    done = subprocess.run([PROGRAM, '--help'], stdout=subprocess.PIPE, check=False)
    assert done.returncode == 0 and b'slapstick-verify FILE' in done.stdout
    for words in ([], ['a', 'b'], ['/nonexistent']):
        done = subprocess.run([PROGRAM, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
        assert done.returncode == 2 and done.stdout == b'' and done.stderr, words


if __name__ == '__main__':
    globals()[sys.argv[2]]()
