#!/usr/bin/env python3
"""slapstick measure and orbit --sensitivity, and spectrum --sweep.

    sensitivity_test.py PROGRAM CASE
"""
import os
import tempfile

from program import good, main, read, refused


def numbers(*words):
    return eval(good(*words), {'true': True, 'false': False, 'null': None, 'nan': float('nan')})


def test_derivatives_are_differences_of_the_program_itself():
    words = ('measure', 'vibro-impact', '--of', 'x1:rms,F_stop:mean,w:mean,x2:max')
    found = numbers(*words, '--set', 'omega=2.6', '--sensitivity', 'omega', '--sensitivity', 'friction')
    h = 1e-5
    for name, value in (('omega', 2.6), ('friction', 0.15)):
        other = [] if name == 'omega' else ['--set', 'omega=2.6']
        above, below = (numbers(*words, *other, '--set', f'{name}={value + by!r}')['values'] for by in (h, -h))
        for key, rate in found['sensitivity'][name]['values'].items():
            difference = (above[key] - below[key]) / (2 * h)
            assert abs(rate - difference) < 1e-6 * (1 + abs(difference)), (name, key, rate, difference)
    assert set(found['sensitivity']['omega']['impacts']['stop']) == {'w', 'impulse', 'energy_lost'}


def test_an_orbit_that_is_not_stable_has_derivatives_too():
    found = numbers('orbit', 'vibro-impact', '--set', 'omega=2.9', '--orbit', '1-1', '--unstable', '--of', 'w:mean', '--sensitivity', 'omega')
    assert abs(found['sensitivity']['omega']['values']['w:mean']) > 1e-3


def test_what_has_no_derivative_is_refused_in_a_line():
    of = ('--of', 'x1:rms', '--sensitivity', 'omega')
    assert 'only for a cycle' in refused(2, 'measure', 'vibro-impact', *of, '--periods', '10')
    assert 'settles on none' in refused(2, 'measure', 'vibro-impact', '--set', 'omega=6.69', *of)
    assert "did you mean 'omega'" in refused(2, 'measure', 'vibro-impact', '--of', 'x1:rms', '--sensitivity', 'omga')
    assert '--of' in refused(2, 'orbit', 'vibro-impact', '--orbit', '1-1', '--sensitivity', 'omega')
    assert 'is a parameter' in refused(2, 'measure', 'vibro-impact', '--of', 'omega', '--sensitivity', 'omega')


def test_a_run_up_has_a_table_and_a_waterfall():
    with tempfile.TemporaryDirectory() as place:
        table, picture = os.path.join(place, 'map.csv'), os.path.join(place, 'map.png')
        good('spectrum', 'vibro-impact', '--sweep', 'omega=2:3', '--over', '60', '--hold', '6', '--settle', '2', '--of', 'a1',
             '--orders', '3', '--out', table, '--plot', picture, '--plot-size', '120mm')
        rows = read(table).splitlines()
        assert rows[0] == 'omega,time,order,frequency,amplitude' and len(rows) == 1 + 10 * 13
        assert os.path.getsize(picture) > 20000
        last = [float(word) for word in rows[-1].split(',')]
        assert last[0] == 3.0 and last[2] == 3.0 and abs(last[3] - 3 * 3 / 6.283185307179586) < 1e-12


def test_options_that_a_run_up_does_not_have_are_refused():
    words = ('spectrum', 'vibro-impact', '--of', 'a1', '--sweep', 'omega=2:3', '--over', '60')
    assert '--periods' in refused(2, *words, '--periods', '3')
    assert '--octaves' in refused(2, *words, '--octaves', '3')
    assert '--settle: only with --sweep' in refused(2, 'spectrum', 'vibro-impact', '--of', 'a1', '--settle', '3')
    assert 'settle' in refused(2, *words, '--hold', '2', '--settle', '2')
    assert '--log: only with --sweep' in refused(2, 'simulate', 'vibro-impact', '--periods', '3', '--log')
    assert 'no equal ratios' in refused(2, 'simulate', 'vibro-impact', '--sweep', 'clearance=0:1', '--over', '4', '--log')


main({name: case for name, case in globals().items() if name.startswith('test_')})
