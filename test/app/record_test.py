#!/usr/bin/env python3
"""Measures of a record: what is looked at by default, and what is refused. One CTest case per function `test_...`."""
import re

from program import good, main, refused, run, says

PUSH = """name = "push"
[parameters]
gain = 1
[[coordinate]]
name = "x"
mass = 1
[[signal]]
name = "s"
points = [[1, 0], [2, 1], [3, 0]]
[[force]]
on = "x"
signal = "s"
amplitude = "gain"
"""


def value(text, key):
    return float(re.search('"' + key + '": ([-+.0-9e]+)', text).group(1))


def pushed():
    with open('push.toml', 'w') as out:
        out.write(PUSH)
    return 'push.toml'


def test_measures_look_at_the_record():
    model = pushed()
    found = good('measure', model, '--of', 'a:mean')
    assert (value(found, 'transient'), value(found, 'periods')) == (1.0, 2.0)
    assert abs(value(found, 'a:mean') - 0.5) < 1e-15
    assert abs(value(good('measure', model, '--of', 'a:mean', '--transient', '1.5'), 'a:mean') - 0.875 / 1.5) < 1e-15


def test_a_diagram_of_measures_has_those_of_measure():
    model = pushed()
    rows = [line.split(',') for line in good('diagram', model, '--sweep', 'gain=1:3:3', '--y', 'a:rms').splitlines()[1:]]
    for row in rows:
        assert float(row[-1]) == value(good('measure', model, '--set', 'gain=' + row[0], '--of', 'a:rms'), 'a:rms')


def test_a_transient_that_leaves_nothing_of_the_record_is_refused():
    model = pushed()
    says(refused(2, 'measure', model, '--of', 'a', '--transient', '500'), '--transient', "'s'", 'ends after 3')
    says(refused(2, 'measure', model, '--of', 'a', '--transient', '-1'), '--transient')
    says(refused(2, 'spectrum', model, '--of', 'a'), 'choose a shorter one')
    done = run('measure', model, '--of', 'a', '--transient', '500', '--periods', '10')
    assert done.status == 0
    says(done.err, "'s'", 'ends before what is measured')


main({name: case for name, case in globals().items() if name.startswith('test_')})
