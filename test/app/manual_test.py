#!/usr/bin/env python3
"""The manual pages: man and mandoc read them without a complaint, and find every verb and option.

    manual_test.py PROGRAM CASE
"""
import os
import re
import subprocess
import sys

from program import HANGS, PROGRAM, good, main, refused

VERIFIER = os.path.join(os.path.dirname(PROGRAM), 'slapstick-verify')


def verbs():
    return eval(good('describe', '--json'), {'true': True, 'false': False, 'null': None})['verbs']


def pages():
    """(name, source) of every page."""
    yield 'slapstick', good('describe', '--man', 'slapstick')
    for verb in verbs():
        yield 'slapstick-' + verb['name'], good('describe', '--man', verb['name'])
    if os.path.exists(VERIFIER):
        yield 'slapstick-verify', subprocess.run([VERIFIER, '--man'], capture_output=True, check=True, timeout=HANGS).stdout.decode()


def formatted(source, *command):
    """(text, complaints) of a formatter, or None where it is not installed."""
    try:
        done = subprocess.run(command, input=source.encode(), capture_output=True, check=False, timeout=HANGS)
    except FileNotFoundError:
        print(f'{command[0]} is not here: pages are not read by it', file=sys.stderr)
        return None
    return done.stdout.decode(), done.stderr.decode()


def test_groff_has_no_warning():
    for name, source in pages():
        found = formatted(source, 'groff', '-ww', '-man', '-Tascii', '-P-c')
        assert found is None or found[1] == '', (name, found[1])


def test_mandoc_has_no_warning_but_of_the_date():
    for name, source in pages():
        found = formatted(source, 'mandoc', '-Tlint', '-W', 'warning')
        if found is not None:
            left = [line for line in found[0].splitlines() if 'missing date' not in line]
            assert left == [], (name, left)


def test_a_page_shows_every_argument_with_its_words():
    for verb in verbs():
        found = formatted(good('describe', '--man', verb['name']), 'groff', '-man', '-Tascii', '-P-c', '-P-b', '-P-u')
        if found is None:
            return
        text = re.sub(r'-\s*\n\s+|\s+', lambda gap: gap[0] if gap[0].startswith('-') else ' ', found[0])
        for argument in verb['arguments']:
            assert argument['name'] in text and argument.get('value', '') in text, (verb['name'], argument)
            assert argument['help'].split()[0] in text, (verb['name'], argument)


def test_examples_of_a_page_are_those_of_the_help():
    shown = 0
    for verb in verbs():
        for line in good('describe', '--man', verb['name']).splitlines():
            if line.startswith('slapstick '):
                assert line.replace('\\-', '-').replace('\\(ga', '`').replace('\\(aq', "'").replace('\\(ti', '~').replace('\\(ha', '^') in verb['notes'], line
                shown += 1
    assert shown > 15


def test_a_page_that_is_not_there_is_refused():
    assert "did you mean 'measure'?" in refused(2, 'describe', '--man', 'measur')
    assert '--man' in refused(2, 'describe', '--man', 'map', '--json')


def test_pages_and_scripts_lie_where_they_are_installed_from():
    share = os.path.join(os.path.dirname(PROGRAM), 'share')
    for name, source in pages():
        with open(os.path.join(share, 'man', 'man1', name + '.1'), encoding='utf-8') as file:
            assert file.read() == source, name
    for shell, place in (('bash', 'bash-completion/completions/slapstick'), ('zsh', 'zsh/site-functions/_slapstick'),
                         ('fish', 'fish/vendor_completions.d/slapstick.fish')):
        with open(os.path.join(share, *place.split('/')), encoding='utf-8') as file:
            assert file.read() == good('completion', shell), shell


main({name: case for name, case in globals().items() if name.startswith('test_')})
