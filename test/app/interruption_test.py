"""Ctrl-C and SIGTERM end everything, also what cannot look up; so does a limit of files. One CTest case per function `test_...`."""
import json
import os
import signal
import subprocess

from beside import Beside
from program import PROGRAM, main, read, says


def write(path, text):
    with open(path, 'w', encoding='utf-8') as file:
        file.write(text)
    return path


def free_bodies(count):
    """The matrices of so many coordinates are one long step."""
    bodies = ''.join(f'[[coordinate]]\nname = "x{i}"\nmass = 1\n' for i in range(count))
    return write('many.toml', f'name = "b"\nomega = 1\n{bodies}[[force]]\non = "x0"\namplitude = 1\n')


def at_the_origin(clearance):
    """Stops at the origin, where a clearance of 1e-308 is one of zero but for its last digits."""
    return write('tiny.toml', 'name = "b"\nomega = 1\n[[coordinate]]\nname = "x1"\nmass = 1\n[[force]]\non = "x1"\namplitude = 1\n'
                              '[[spring]]\nbetween = ["x1", "ground"]\nstiffness = 1\n'
                              f'[[stop]]\nname = "s0"\nbetween = ["x1", "ground"]\nclearance = {clearance}\nrestitution = 0.5\n')


def ends(words, number):
    endless = Beside(*words)
    assert endless.until(endless.works), (words, endless.err())
    done = endless.signalled(number)
    assert done.status == 130, (words, done.status, done.err)
    assert done.err.count('\n') <= 1, done.err
    return done


def test_a_computation_that_does_not_look_up_is_ended():
    many, tiny = free_bodies(1000), at_the_origin('1e-308')
    for words in (('simulate', many, '--periods', '1', '--out', 'o.json', '--events', 'e.csv'), ('check', many),
                  ('simulate', tiny, '--periods', '100', '--out', 'o.json', '--events', 'e.csv')):
        for number in (signal.SIGINT, signal.SIGTERM):
            ends(words, number)
            assert sorted(set(os.listdir('.')) - {'e.csv', 'o.json'}) == ['many.toml', 'tiny.toml'], os.listdir('.')


def test_a_search_that_is_cut_short_says_130_and_blames_nobody():
    words = ('curve', 'vibro-impact', '--params', 'omega,restitution', '--from', 'PD', '--range', 'omega=1:5', '--range', 'restitution=0.3:1', '--out', 'c.json')
    done = ends(words, signal.SIGINT)
    assert 'no PD' not in done.err, done.err
    assert os.listdir('.') in ([], ['c.json']), os.listdir('.')  # the points so far, if there are any
    if os.path.exists('c.json'):
        assert json.loads(read('c.json'))['points']


def test_a_file_that_may_not_grow_is_an_error_and_no_death():
    words = ('simulate', 'vibro-impact', '--periods', '2000', '--events', 'e.csv')
    done = subprocess.run(['sh', '-c', 'ulimit -f 40; exec "$@"', 'sh', PROGRAM, *words], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False)
    assert done.returncode == 4, (done.returncode, done.stderr)
    says(done.stderr.decode(), "'e.csv'")
    assert os.listdir('.') == [], os.listdir('.')


main({name: case for name, case in globals().items() if name.startswith('test_')})
