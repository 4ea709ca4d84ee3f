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
    for model in ('vibro-impact', 'gear-pair', 'gear-rattle', 'belt', 'falling-friction', 'two-sided-rattle'):
        names = [one['name'] for one in numbers('quantities', model)]
        assert len(names) == len(set(names)) > 8, names
        found = numbers('measure', model, '--periods', '5', '--transient', '5', '--of', ','.join(names))
        for name in names:
            assert any(key.startswith(name + ':') for key in found['values']), name


def test_an_unknown_quantity_is_answered_with_the_nearest():
    assert "did you mean 'F_stop'" in refused(2, 'measure', 'vibro-impact', '--of', 'F_stpo')
    assert "did you mean 'rms'" in refused(2, 'measure', 'vibro-impact', '--of', 'a1:rsm')
    assert '--of' in refused(2, 'measure', 'vibro-impact', '--of', 'a1::rms')
    assert '--of Q[:STAT],.. is required' in refused(2, 'measure', 'vibro-impact')
    assert 'one quantity' in refused(2, 'spectrum', 'vibro-impact', '--of', 'a1,a2')
    assert 'at impacts' in refused(2, 'spectrum', 'vibro-impact', '--of', 'w')
    assert '--stretch' in refused(2, 'spectrum', 'vibro-impact', '--of', 'a1', '--stretch', '-1')
    assert '--periods: not with --time' in refused(2, 'measure', 'vibro-impact', '--of', 'a1', '--periods', '3', '--time', '3')
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
    assert 'no statistic' in refused(2, 'diagram', 'coulomb-oscillator', '--sweep', 'omega=1:2:3', '--y', 'x:rsm')
    assert '--impacts' in refused(2, 'diagram', 'vibro-impact', '--sweep', 'omega=1:2:3', '--y', 'x1:rms', '--impacts', '3')


def test_a_branch_has_the_statistics_of_its_orbits_stable_or_not():
    branch = numbers('continue', 'impact-oscillator', '--set', 'omega=1', '--set', 'clearance=100', '--param', 'omega',
                     '--range', '0.5:2', '--step', '0.1', '--y', 'x:max,power_in:mean')
    for point in branch['points']:
        omega = point['param']
        amplitude = 1 / math.hypot(1 - omega**2, 0.2 * omega)
        assert abs(point['values']['x:max'] - amplitude) < 1e-11 * amplitude, omega
        assert abs(point['values']['power_in:mean'] - 0.1 * (omega * amplitude)**2) < 1e-11 * amplitude**2, omega


def test_orbit_and_classify_measure_their_cycle_as_measure_does():
    of = ('--of', 'F_stop:mean,w:number,a1:rms,flight_stop:impulse')
    for omega, orbit in (('2.2', ()), ('2.9', ('--orbit', '1-1', '--unstable'))):
        words = ('vibro-impact', '--set', 'omega=' + omega, *orbit, *of)
        measured = numbers('measure', *words)
        assert numbers('orbit', *words)['values'] == measured['values']
        assert abs(measured['values']['flight_stop:impulse'] - 1) < 1e-12
        if not orbit:
            classified = numbers('classify', *words)
            for name, value in measured['values'].items():
                assert abs(classified['values'][name] - value) < 1e-9, name
    unstable = numbers('measure', 'vibro-impact', '--set', 'omega=2.9', '--orbit', '1-1', '--unstable', *of)
    settled = numbers('measure', 'vibro-impact', '--set', 'omega=2.9', *of)
    assert unstable['over']['class'] == '1-1-I' and settled['over']['class'] != '1-1-I'
    listed = numbers('orbit', 'vibro-impact', '--set', 'omega=2.9', '--all', '--starts', '4', *of)
    assert unstable['values']['w:number'] in [one['values']['w:number'] for one in listed['orbits']]
    assert '--periods: not with --orbit' in refused(2, 'measure', 'vibro-impact', '--orbit', '1-1', '--periods', '3', '--of', 'a1')
    assert '--of' in refused(2, 'orbit', 'vibro-impact', '--of', 'F_stpo')


def test_a_run_ends_at_the_event_that_is_asked_for():
    with tempfile.TemporaryDirectory() as place:
        events = os.path.join(place, 'e.csv')
        found = numbers('simulate', 'vibro-impact', '--until', 'impact:stop:7', '--events', events)
        rows = open(events).read().splitlines()
        assert [row.split(',')[1] for row in rows].count('impact') == 7 and rows[-1].split(',')[1] == 'impact'
        assert found['until'] == {'event': 'impact:stop', 'number': 7, 'met': True}
        assert found['end']['time'] == float(rows[-1].split(',')[0])
    late = run('simulate', 'vibro-impact', '--until', 'impact:7', '--periods', '2')
    assert late.status == 3 and 'only 2' in late.err and '"met": false' in late.out
    assert 'no kind of event' in refused(2, 'simulate', 'vibro-impact', '--until', 'impct')
    assert '--until K' in refused(2, 'simulate', 'vibro-impact', '--until', 'impact:0')


def test_columns_of_a_trajectory_are_quantities_on_the_motion():
    with tempfile.TemporaryDirectory() as place:
        path = os.path.join(place, 't.csv')
        words = ('--set', 'omega=1.5', '--periods', '3', '--samples', '40', '--trajectory', path)
        good('simulate', 'vibro-impact', *words, '--columns', 'w_stop,kinetic_energy,F_friction,F_stop,a1-a2,omega')
        rows = [row.split(',') for row in open(path).read().splitlines()]
    assert rows[0] == ['time', 'x1', 'v1', 'x2', 'v2', 'mode', 'w_stop', 'kinetic_energy', 'F_friction', 'F_stop', 'a1-a2', 'omega']
    slipping = 0
    for row in rows[1:]:
        v1, v2 = float(row[2]), float(row[4])
        w, kinetic, friction, stop, apart, omega = map(float, row[6:])
        assert abs(w - (v1 - v2)) < 1e-13 and abs(kinetic - (v1 * v1 + 10 * v2 * v2) / 2) < 1e-13 and omega == 1.5
        assert (abs(friction) <= 0.15 + 1e-12) and stop >= -1e-12
        if row[5] in ('slip+', 'slip-'):
            slipping += 1
            assert friction == (0.15 if row[5] == 'slip+' else -0.15)
        elif row[5] == 'stick':
            assert abs(apart) < 1e-12
    assert slipping > 20
    assert 'no function of time' in refused(2, 'simulate', 'vibro-impact', '--trajectory', 't.csv', '--columns', 'impulse')
    assert 'only with --trajectory' in refused(2, 'simulate', 'vibro-impact', '--columns', 'a1')


def table(text):
    rows = [row.split(',') for row in text.splitlines()]
    return rows[0], rows[1:]


def test_a_diagram_of_values_has_those_of_the_section():
    sweep = ('diagram', 'vibro-impact', '--sweep', 'omega=2.2:2.3:2', '--start', 'reset', '--transient', '50', '--impacts', '6')
    head, rows = table(good(*sweep, '--y', 'x2,v1,w,F_friction'))
    impacts_head, impacts = table(good(*sweep))
    assert head == ['omega', 'direction', 'x2', 'v1', 'w', 'F_friction'] and len(rows) == 12
    second = [row for row in impacts if row[0] == impacts[-1][0]]
    shown = [row for row in rows if row[0] == impacts[-1][0]]
    assert len(shown) == len(second) == 6
    for value, impact in zip(shown, second):
        for name in ('x2', 'v1', 'w'):
            assert value[head.index(name)] == impact[impacts_head.index(name)], name
        assert abs(float(value[5])) == 0.15


def test_a_diagram_of_values_needs_no_stop_and_no_forcing():
    head, rows = table(good('diagram', 'coulomb-oscillator', '--sweep', 'omega=0.5:1.5:3', '--y', 'x,F_friction', '--impacts', '4'))
    assert head == ['omega', 'direction', 'x', 'F_friction'] and len(rows) == 12
    belt = ('--sweep', 'belt_speed=0.5:1:2', '--transient', '40', '--impacts', '3', '--start', 'reset')
    head, rows = table(good('diagram', 'belt', *belt, '--y', 'x,w_belt', '--at', 'stick:belt'))
    assert len(rows) == 6 and all(abs(float(row[3])) < 1e-12 for row in rows)
    one, two = (good('diagram', 'belt', *belt, '--y', 'x', '--at', 'stick', '--threads', threads) for threads in ('1', '2'))
    assert one == two
    assert '--at impact' in refused(2, 'diagram', 'belt', *belt, '--y', 'x', '--at', 'impact')
    assert 'no kind of event' in refused(2, 'diagram', 'belt', *belt, '--y', 'x', '--at', 'stik')
    assert 'mixes' in refused(2, 'diagram', 'belt', *belt, '--y', 'x,v:rms')
    assert 'statistic' in refused(2, 'diagram', 'vibro-impact', '--sweep', 'omega=1:2:2', '--y', 'impulse')


def test_points_of_sections_have_quantities_and_these_are_axes():
    words = ('poincare', 'vibro-impact', '--set', 'omega=4.9', '--transient', '50', '--points', '30')
    plain, with_of = table(good(*words)), table(good(*words, '--of', 'w_stop,a1,F_stop'))
    assert with_of[0] == plain[0] + ['w_stop', 'a1', 'F_stop']
    for bare, row in zip(plain[1], with_of[1]):
        assert row[:len(bare)] == bare
        assert abs(float(row[-3]) - float(bare[plain[0].index('w')])) < 1e-13 and float(row[-1]) == 0
    with tempfile.TemporaryDirectory() as place:
        for section in (('impact',), ('stroboscopic',), ('event', '--event', 'stick')):
            picture, data = os.path.join(place, section[0] + '.png'), os.path.join(place, section[0] + '-plot.csv')
            head, rows = table(good('poincare', 'vibro-impact', '--set', 'omega=1.5', '--transient', '50', '--points', '4',
                                    '--section', *section, '--of', 'x2,a2', '--plot', picture))
            points = [list(map(float, line.split(',')[-2:])) for line in open(data).read().splitlines() if line and line[0] in '-0123456789']
            assert sorted(points) == sorted([float(row[-2]), float(row[-1])] for row in rows), section
    assert 'no function of time' in refused(2, *words, '--of', 'impulse')


def test_bands_say_whether_they_are_whole_and_what_they_add_up_to():
    words = ('spectrum', 'gear-rattle', '--of', 'F_teeth_upper', '--octaves', '3', '--reference', '1e-6')
    orders, hertz = numbers(*words, '--orders', '50'), numbers(*words, '--to', '4000')
    assert orders['bands'] == hertz['bands'] and orders['total_level'] == hertz['total_level']
    assert [band['whole'] for band in orders['bands']] == [True] * (len(orders['bands']) - 1) + [False]
    power = sum(band['rms']**2 for band in orders['bands'])
    assert abs(orders['total_level'] - 10 * math.log10(power / 1e-12)) < 1e-9
    assert '--orders: not with --to' in refused(2, *words, '--orders', '50', '--to', '4000')


def test_histograms_count_every_impact_once():
    found = numbers('measure', 'vibro-impact', '--set', 'omega=6.69', '--periods', '300', '--of', 'w', '--bins', '12')
    assert found['complete'] is True
    stop = found['impacts']['stop']
    for name in ('w', 'impulse', 'energy_lost'):
        edges, counts = stop[name]['histogram']['edges'], stop[name]['histogram']['counts']
        assert len(edges) == 13 and len(counts) == 12 and sum(counts) == stop['number'] > 100
        assert edges[0] == stop[name]['min'] and edges[-1] == stop[name]['max'] and counts[0] > 0 and counts[-1] > 0
    # half of the impacts lie below the median
    below = sum(count for edge, count in zip(stop['w']['histogram']['edges'][1:], stop['w']['histogram']['counts']) if edge <= stop['w']['q50'])
    assert 0 < below <= stop['number'] / 2
    assert 'histogram' not in numbers('measure', 'shaken-table', '--of', 'w')['impacts']['table']['w']


main({name: case for name, case in globals().items() if name.startswith('test_')})
