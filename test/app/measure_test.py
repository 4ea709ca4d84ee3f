#!/usr/bin/env python3
"""slapstick quantities, measure, spectrum, and the statistics of diagram and continue.

    measure_test.py PROGRAM CASE
"""
import math
import os
import tempfile

from program import good, main, refused, run


def numbers(*words):
    """The JSON of a run, whatever the run says on standard error."""
    done = run(*words)
    assert done.status == 0, (words, done.err)
    return eval(done.out, {'true': True, 'false': False, 'null': None})


def test_every_quantity_of_every_model_can_be_measured():
    for model in ('vibro-impact', 'gear-pair', 'belt', 'falling-friction', 'two-sided-rattle'):
        names = [one['name'] for one in numbers('quantities', model)]
        assert len(names) == len(set(names)) > 8, names
        found = numbers('measure', model, '--periods', '5', '--transient', '5', '--of', ','.join(names))
        for name in names:
            assert any(key.startswith(name + ':') for key in found['values']), name


def test_an_unknown_quantity_is_answered_with_the_nearest():
    assert "did you mean 'F_stop'" in refused(2, 'measure', 'vibro-impact', '--of', 'F_stpo')
    assert "did you mean 'rms'" in refused(2, 'measure', 'vibro-impact', '--of', 'a1:rsm')
    assert '--of' in refused(2, 'measure', 'vibro-impact', '--of', 'a1::rms')
    assert '--of is needed' in refused(2, 'measure', 'vibro-impact')
    assert 'one quantity' in refused(2, 'spectrum', 'vibro-impact', '--of', 'a1,a2')
    assert 'at impacts' in refused(2, 'spectrum', 'vibro-impact', '--of', 'w')
    assert '--stretch' in refused(2, 'spectrum', 'vibro-impact', '--of', 'a1', '--stretch', '-1')
    assert 'choose one' in refused(2, 'measure', 'vibro-impact', '--of', 'a1', '--periods', '3', '--time', '3')
    assert 'longer than the motion' in refused(2, 'spectrum', 'vibro-impact', '--of', 'a1', '--periods', '3')


def test_a_cycle_is_measured_over_itself_and_a_chaos_over_periods():
    cycle = numbers('measure', 'shaken-table', '--of', 'F_table:mean')
    assert cycle['over']['kind'] == 'cycle' and cycle['over']['n'] == 1
    assert abs(cycle['values']['F_table:mean'] - 1) < 1e-13
    chaos = numbers('measure', 'vibro-impact', '--set', 'omega=6.69', '--of', 'a1:mean')
    assert chaos['over']['kind'] == 'motion' and chaos['over']['periods'] == 1000


def test_lines_of_impulses_do_not_decay_and_the_picture_is_there():
    with tempfile.TemporaryDirectory() as place:
        picture = os.path.join(place, 'a.png')
        found = numbers('spectrum', 'shaken-table', '--of', 'a', '--orders', '30', '--octaves', '3', '--plot', picture)
        assert os.path.getsize(picture) > 5000
    assert [round(line['amplitude'], 11) for line in found['lines'][2:]] == [2.0] * 29
    assert len(found['bands']) > 10


def test_a_diagram_of_statistics_needs_no_stop_and_has_no_order_of_threads():
    words = ('diagram', 'coulomb-oscillator', '--sweep', 'omega=0.5:1.5:5', '--y', 'F_friction:rms,x:peak_to_peak')
    one, two = (good(*words, '--threads', threads) for threads in ('1', '2'))
    assert one == two
    rows = one.splitlines()
    assert rows[0] == 'omega,direction,F_friction:rms,x:peak_to_peak' and len(rows) == 6
    for row in rows[1:]:
        assert float(row.split(',')[2]) <= 0.2 + 1e-12
    assert 'no statistic' in refused(2, 'diagram', 'coulomb-oscillator', '--sweep', 'omega=1:2:3', '--y', 'x')
    assert '--impacts' in refused(2, 'diagram', 'vibro-impact', '--sweep', 'omega=1:2:3', '--y', 'x1:rms', '--impacts', '3')


def test_a_branch_has_the_statistics_of_its_orbits_stable_or_not():
    branch = numbers('continue', 'impact-oscillator', '--set', 'omega=1', '--set', 'clearance=100', '--param', 'omega',
                     '--range', '0.5:2', '--step', '0.1', '--y', 'x:max,power_in:mean')
    for point in branch['points']:
        omega = point['param']
        amplitude = 1 / math.hypot(1 - omega**2, 0.2 * omega)
        assert abs(point['values']['x:max'] - amplitude) < 1e-11 * amplitude, omega
        assert abs(point['values']['power_in:mean'] - 0.1 * (omega * amplitude)**2) < 1e-11 * amplitude**2, omega


main({name: case for name, case in globals().items() if name.startswith('test_')})
