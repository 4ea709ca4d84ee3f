"""orbit, continue and curve from the command line: the stable part of their results, and what they refuse."""
import json
import os

from program import good, main, read, refused, run, says, table

PAPER = ('vibro-impact', '--set', 'omega=2.7')
HAMMER = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'orbit', 'models', 'hammer-drill.toml')


def number(text, key, which=0):
    """The K-th number of that key in a JSON text."""
    parts = text.split('"%s": ' % key)
    return float(parts[1 + which].split(',')[0].split('\n')[0].strip(' "}]'))


def test_orbit_has_the_stable_keys_of_the_command_line():
    text = good('orbit', *PAPER, '--orbit', '1-1')
    says(text, '"converged": true', '"class": "1-1-I"', '"period"', '"multipliers"', '"impacts"', '"time"', '"phase"', '"w"', '"state"')
    says(good('orbit', HAMMER), '"margins"', '"guard": "reversal"')


def test_unstable_orbits_are_found_where_simulation_leaves_them():
    says(good('orbit', 'vibro-impact', '--set', 'omega=2.9', '--orbit', '1-1'), '"stable": false')


def test_an_impact_of_an_orbit_is_a_state_to_start_from():
    text = good('orbit', *PAPER, '--orbit', '1-1')
    state = ','.join('%s=%.17g' % (name, number(text, name)) for name in ('x1', 'v1', 'x2', 'v2'))
    good('simulate', *PAPER, '--state', state, '--periods', '1')


def state_of(text, names):
    """The orbit's own state as --state takes it, and its numbers."""
    part = text[text.index('"state": {'):]
    numbers = [number(part, name) for name in names]
    return ','.join('%s=%.17g' % pair for pair in zip(names, numbers)), numbers


def comes_back(model, names, periods):
    """A simulation from the state that `orbit` gives is there again after the cycle."""
    text = good('orbit', *model)
    state, begin = state_of(text, names)
    good('simulate', *model, '--state', state, '--periods', str(periods), '--trajectory', 't.csv')
    columns, rows = table(read('t.csv'))
    end = [float(rows[-1][columns.index(name)]) for name in names]
    size = max(abs(x) for x in begin)
    assert all(abs(a - b) < 1e-9 * size for a, b in zip(begin, end)), (begin, end)


def test_a_simulation_from_the_state_of_an_orbit_is_the_orbit():
    names = ('x1', 'v1', 'x2', 'v2')
    comes_back(PAPER, names, 1)
    comes_back(('vibro-impact', '--set', 'omega=1.5'), names, 1)  # sticks on its way
    comes_back(('vibro-impact', '--set', 'omega=0.55'), names, 1)  # complete chatter
    comes_back(('coulomb-oscillator',), ('x', 'v'), 1)


def test_a_point_of_a_branch_or_curve_is_a_state_to_start_from():
    keys = ('class', 'n', 'p', 'sticking', 'stable', 'period', 'multipliers', 'is_motion', 'state')
    branch = good('continue', *PAPER, '--orbit', '1-1', '--param', 'omega', '--range', '2.65:2.9')
    curve = good('curve', *PAPER, '--orbit', '1-1', '--from', 'PD', '--params', 'omega,friction', '--range', 'omega=2.6:3', '--range', 'friction=0.14:0.16')
    for text, end in ((branch, '"special"'), (curve, '"met"')):
        points = text[text.index('"points"'):text.index(end)]
        count = points.count('"class"')
        assert count > 3
        for key in keys:
            assert points.count('"%s":' % key) == count, key
    first = branch[branch.index('"points"'):]  # at the low end
    state = ','.join('%s=%.17g' % (name, number(first, name)) for name in ('x1', 'v1', 'x2', 'v2'))
    end = good('simulate', 'vibro-impact', '--set', 'omega=%.17g' % number(first, 'param'), '--state', state, '--periods', '1')
    end = end[end.index('"end"'):]
    assert all(abs(number(end, name) - number(first, name)) < 1e-11 for name in ('x1', 'v1', 'x2', 'v2')), (state, end)


def test_a_branch_names_its_doubling_to_ten_digits():
    text = good('continue', *PAPER, '--orbit', '1-1', '--param', 'omega', '--range', '2.6:2.9')
    says(text, '"points"', '"special"', '"type": "PD"')
    special = text[text.index('"special"'):]
    assert abs(number(special, 'param') - 2.8459562956064) < 1e-10, number(special, 'param')


def test_a_table_is_for_people():
    text = good('continue', *PAPER, '--orbit', '1-1', '--param', 'omega', '--range', '2.6:2.9', '--table')
    says(text, 'BR', 'TY', 'omega', 'PD', '2.84595629561', 'stable', 'unstable', 'range')


def test_special_points_say_what_grows_there():
    words = ('continue', *PAPER, '--orbit', '1-1', '--param', 'omega', '--range', '2.6:2.9')
    says(good(*words, '--table'), 'period doubling, supercritical, c = ')
    text = good(*words)
    says(text, '"normal_form": "supercritical"')
    assert number(text, 'coefficient_error') < 1e-4 * number(text, 'coefficient')


def test_a_table_has_sensitivities_and_the_classes_around_a_change():
    words = ('continue', 'vibro-impact', '--set', 'omega=1.5', '--orbit', '1-1', '--param', 'omega', '--range', '1.4:1.5', '--sensitivity', 'friction')
    text = good(*words)
    special = text[text.index('"special"'):]
    says(special, '"class_before": "1-1-I"', '"class_behind": "1-1-II"')
    says(good(*words, '--table'), '1-1-I -> 1-1-II; persistence; d omega / d friction = %.5g' % number(special[special.index('"sensitivity"'):], 'friction'))


def test_a_table_is_in_the_order_of_the_branch_and_says_how_well_places_are_known():
    lines = good('continue', 'coulomb-oscillator', '--param', 'amplitude', '--range', '0.05:1', '--table').splitlines()
    assert [line.split()[2] for line in lines[1:-1]] == ['SL', 'EP', 'SL', 'EP'], lines  # the motion dies out below its first point
    values = [float(line.split()[3]) for line in lines[1:-1]]
    assert values == sorted(values), values
    spool = good('continue', 'spool', '--set', 'preload=8.26', '--param', 'preload', '--range', '8.23:8.3', '--table').splitlines()
    onset = [line for line in spool if ' CH ' in line]
    assert len(onset) == 1 and '; known to ' in onset[0], onset
    table = good('continue', 'shaken-table', '--set', 'restitution=0.3', '--param', 'acceleration', '--range', '1.1:2', '--table').splitlines()
    onset = [line for line in table if ' CH ' in line]  # by equations of its own: to the last digit
    assert len(onset) == 1 and ' 1.94693848031 ' in onset[0] and 'known to' not in onset[0], onset


def test_a_group_whose_members_differ_has_no_value():
    for words in (('continue', 'two-blocks-on-belt', '--param', 'friction', '--range', '0.5:1.5'),
                  ('continue', 'two-blocks-on-belt', '--param', 'coupling', '--range', '1:1.5', '--sensitivity', 'friction')):
        says(refused(2, *words), 'members of friction differ: static_friction = 1, kinetic_friction = 0.6', '--set friction=VALUE')


def test_a_broken_symmetry_is_followed_once():
    text = good('continue', 'two-sided-rattle', '--set', 'omega=1.6', '--param', 'omega', '--range', '1.2:1.7', '--branches', '3', '--table')
    says(text, "a symmetry breaks: the crossing branch's sides are images of one another", 'beyond the symmetric orbit at 1.47422312')
    branches = [[line.split()[3] for line in part.splitlines() if ' GR ' in line] for part in text.split(' points; ')[1:]]
    places = [tuple(sorted(branch)) for branch in branches if branch]
    assert places and len(set(places)) == len(places), places


def test_the_onset_of_chatter_reads_the_same_from_both_sides():
    for start in ('0.0052', '0.0055'):
        lines = run('continue', 'vibro-impact', '--set', 'omega=2.2', '--set', 'restitution=' + start, '--param', 'restitution', '--range', '0.005:0.0056', '--table').out.splitlines()
        onset = [line for line in lines if ' CH ' in line]
        assert len(onset) == 1, lines
        says(onset[0], 'at the onset of a complete chatter; 1-inf-II -> 1-', '; persistence')
        nearest = [line for line in lines if 'one of infinitely many changes' in line]
        assert all('->' not in line for line in nearest), nearest


def test_a_branch_that_is_born_says_where():
    words = ('continue', *PAPER, '--orbit', '1-1', '--param', 'omega', '--range', '2.6:2.87', '--branches', '2')
    says(good(*words, '--table'), '\n  2 is born at omega = 2.84595629561 (PD of 1)\n')
    text = good(*words)
    born = text[text.index('"born_at"'):]
    says(born, '"branch": 1', '"type": "PD"')
    assert abs(number(born, 'param') - 2.8459562956064) < 1e-10


def test_a_picture_says_which_branch_and_which_special_point_is_which():
    good('continue', *PAPER, '--orbit', '1-1', '--param', 'omega', '--range', '2.6:2.95', '--branches', '3', '--table', '--out', 't.txt', '--plot', 'b.png')
    script = read('b.gp')
    for text in ('stable', 'unstable', 'PD', '1: 1-1', '2: 2-2', '3: 4-4'):
        assert "set label '%s' at screen" % text in script, text
    colours = {line.split("lc rgb '")[1][:7] for line in script.splitlines() if 'with lines' in line and ' lw 0.3 ' not in line}
    assert len(colours) == 3, colours
    numbers = [line.split("'")[1] for line in script.splitlines() if line.strip().startswith('set label') and 'boxed' in line]
    assert sorted(numbers) == ['1', '2', '3'], numbers
    assert 'set arrow from 2.' not in script  # no lines through the whole frame


def test_axes_have_the_units_that_the_model_states():
    good('continue', HAMMER, '--param', 'frequency', '--range', '13:15', '--out', 'c.json', '--plot', 'b.png')
    says(read('b.gp'), 'impact speed {/:Italic w} [m/s]', 'frequency [Hz]')
    good('simulate', HAMMER, '--periods', '5', '--out', 's.json', '--plot', 's.png')
    says(read('s.gp'), 'm]', 'm/s]', "'t / T'")
    good('diagram', HAMMER, '--sweep', 'frequency=13:15:2', '--impacts', '3', '--out', 'd.csv', '--plot', 'd.png')
    says(read('d.gp'), 'w at impact [m/s]')
    good('continue', *PAPER, '--param', 'omega', '--range', '2.6:2.75', '--out', 'c.json', '--plot', 'b.png')
    assert '[' not in [line.split("'")[1] for line in read('b.gp').splitlines() if 'impact speed' in line][0]  # it states none


def test_a_picture_shows_the_range_asked_for_and_where_a_branch_ends():
    good('continue', HAMMER, '--param', 'force', '--range', '20:200', '--table', '--out', 't.txt', '--plot', 'b.png')
    lines = read('t.txt').splitlines()
    end = next(line.split() for line in lines if 'jump' in line and line.split()[2] == 'SL')
    last = next(line.split() for line in lines if line.split()[2] == 'EP')
    assert 20.0 < float(end[3]) < float(last[3]), (end, last)  # it ends behind its last point
    says(read('b.gp'), 'set xrange [20:200]')
    columns, rows = table(read('b-plot.csv'))
    assert 'points' in columns[0] and 'line' in columns[2], columns
    assert float('%.12g' % float(rows[0][0])) == float(end[3]), rows[0]  # its marker
    assert rows[0][0] in (rows[0][2], [row[2] for row in rows if row[2]][-1])  # to which the line goes


def test_what_a_curve_meets_is_named_in_its_picture():
    words = ('curve', 'vibro-impact', '--set', 'omega=4.78', '--orbit', '4-2', '--from', 'NS', '--params', 'omega,friction')
    text = good(*words, '--range', 'omega=4.4:4.9', '--range', 'friction=0.1:0.5', '--plot', 'c.png')
    says(text, '"type": "R2"', 'resonance 1:2: both multipliers are -1', 'no torus beyond')
    says(read('c.gp'), "set label '1:2'")


def test_a_picture_of_a_curve_is_of_its_motions_only():
    ranges = ('--range', 'frequency=8:20', '--range', 'gap=0.001:0.006')
    text = good('curve', HAMMER, '--from', 'SL', '--params', 'frequency,gap', *ranges, '--plot', 'c.png')
    says(text, '"is_motion": true', '"is_motion": false')
    pieces = text[text.index('"points"'):text.index('"met"')].split('"frequency"')[1:]
    motions = [float(piece[1:piece.index(',')]) for piece in pieces if '"is_motion": true' in piece]
    _, rows = table(read('c-plot.csv'))
    met, line = ([(row[k], row[k + 1]) for row in rows if row[k] and row[k] != 'NaN'] for k in (0, 2))
    assert met and set(met) <= set(line), (met, line)  # each at the line
    drawn = {float(x) for x, _ in line} - {float(x) for x, _ in met}
    assert len(drawn) > 10 and drawn <= set(motions)
    assert text.count('"after"') > len(met)  # others lie where there is no motion


def points_drawn(*words):
    """The first column of the picture's data that is no line's: x of the cloud, then y."""
    good('continue', *words, '--table', '--out', 't.txt', '--plot', 'b.png')
    assert os.path.getsize('b.png') > 0
    return table(read('b-plot.csv'))


def test_branches_are_drawn_over_the_motions_that_settle():
    words = (*PAPER, '--orbit', '1-1', '--param', 'omega', '--range', '2.6:2.9')
    bare, _ = points_drawn(*words)
    columns, rows = points_drawn(*words, '--diagram', '7')
    assert len(columns) == len(bare) + 2, (bare, columns)
    values = sorted({round(float(row[0]), 12) for row in rows if row[0]})
    assert values == [round(2.6 + 0.05 * i, 12) for i in range(7)], values
    columns, rows = points_drawn('coulomb-oscillator', '--param', 'omega', '--range', '0.7:0.9', '--diagram', '3')  # no stop: its turning points
    heights = [abs(float(row[1])) for row in rows if row[0]]
    assert heights and min(heights) > 1.0, heights


def test_the_same_command_gives_the_same_bytes():
    words = ('continue', *PAPER, '--orbit', '1-1', '--param', 'friction', '--range', '0.05:0.25')
    assert good(*words) == good(*words)


def test_a_group_may_be_swept_and_its_sensitivity_is_the_slope_of_the_curve():
    text = good('continue', *PAPER, '--orbit', '1-1', '--param', 'omega', '--range', '2.6:2.9', '--sensitivity', 'friction')
    slope = number(text[text.index('"sensitivity"'):], 'friction')
    at = []
    for friction in ('0.149', '0.151'):
        other = good('continue', *PAPER, '--set', 'friction=' + friction, '--orbit', '1-1', '--param', 'omega', '--range', '2.6:2.9')
        at.append(number(other[other.index('"special"'):], 'param'))
    assert abs((at[1] - at[0]) / 0.002 - slope) < 1e-5, (at, slope)


def test_a_curve_starts_at_its_point_and_ends_at_its_range():
    text = good('curve', *PAPER, '--orbit', '1-1', '--from', 'PD', '--params', 'omega,friction', '--range', 'omega=2.6:3', '--range', 'friction=0.1:0.2')
    says(text, '"type": "PD"', '"points"', '"ended": "down: range; up: range"')


def test_a_curve_is_the_same_from_either_of_its_points():
    """Both branch points at restitution 0.7 lie on one curve with a fold between them, beside which two crossings are near."""
    seen = []
    for which in ('1', '2'):
        curve = json.loads(good('curve', 'two-sided-rattle', '--from', 'BP', '--which', which, '--params', 'omega,restitution',
                                '--range', 'omega=0.5:3', '--range', 'restitution=0.3:0.9'))
        assert curve['ended'] == 'down: range; up: range'
        (turn,) = curve['met']
        points = sorted((point['restitution'], point['omega']) for point in curve['points'])
        assert turn['type'] == 'turn' and turn['restitution'] <= points[0][0] + 1e-7
        seen.append(sorted(omega for restitution, omega in points if restitution == 0.9) + [turn['restitution']])
    assert len(seen[0]) == 3 and all(abs(a - b) < 1e-7 for a, b in zip(*seen)), seen


def test_a_class_with_stick_is_not_one_without():
    says(good('orbit', *PAPER, '--orbit', '1-1-I'), '"class": "1-1-I"')
    says(refused(3, 'orbit', *PAPER, '--orbit', '1-1-II', '--starts', '4'), 'no 1-1-II orbit', 'settles on 1-1-I')


def test_a_bounce_is_found_beside_a_motion_that_rests_at_phase_zero():
    text = good('orbit', 'shaken-table', '--set', 'acceleration=1.304', '--state', 'x=0,v=0', '--orbit', '1-1')
    says(text, '"class": "1-1-I"', '"stable": true', '"settles": false', '"ended": "found"')


def test_conditions_choose_among_orbits_of_one_class():
    rattle = ('two-sided-rattle', '--set', 'omega=1.4')
    says(good('orbit', *rattle), '"stable": true', '"symmetric": false', '"settles": true')
    says(good('orbit', *rattle, '--orbit', '1-2', '--symmetric'), '"stable": false', '"symmetric": true', '"settles": false')
    state, _ = state_of(good('orbit', *rattle, '--orbit', '1-2', '--unstable'), ('x', 'v'))
    says(good('orbit', *rattle, '--orbit', '1-2', '--nearest', '--state', state, '--starts', '8'), '"stable": false', '"settles": false')
    branch = good('continue', *rattle, '--orbit', '1-2', '--unstable', '--param', 'omega', '--range', '1.39:1.41')
    says(branch[branch.index('"points"'):branch.index('"special"')], '"stable": false')


def test_a_member_of_a_family_stays_and_is_said_to_be_one():
    resting = ('coulomb-oscillator', '--set', 'amplitude=0.1')
    text = good('orbit', *resting, '--state', 'x=0.05,v=0')
    says(text, '"family": 1', '"stable": true', '"x": 0.050000000000000003')
    every = good('orbit', *resting, '--all', '--starts', '20')
    assert every.count('"family"') == 1, every.count('"family"')
    branch = good('continue', *resting, '--state', 'x=0.05,v=0', '--param', 'omega', '--range', '0.7:0.9')
    assert branch.count('"x": 0.050000000000000003') == branch.count('"family": 1') > 50, branch.count('"family": 1')
    text = good('continue', *resting, '--state', 'x=0.05,v=0', '--param', 'amplitude', '--range', '0:0.5', '--table')
    says(text, 'SL                0.15', 'from there on it is one of a family')  # friction 0.2 less the spring's 0.05


def test_an_orbit_has_its_state_at_every_event():
    text = good('orbit', 'coulomb-oscillator', '--set', 'amplitude=0.3', '--set', 'omega=0.2')
    events = text[text.index('"events"'):text.index('"impacts"')]
    assert events.count('"state"') == events.count('"kind"') > 2, events
    says(text, '"sticks": ', '"reversals": ', '"chatters": 0')


def test_a_search_that_finds_nothing_ends_in_time_and_says_what_it_tried():
    words = ('orbit', 'bilinear-oscillator', '--set', 'omega=0.930642', '--orbit', '2-1')
    line = refused(3, *words, '--starts', '6')
    says(line, 'no 2-1 orbit', 'the motion settles on', ' tried 6 motions, ', ' near returns, ', "runs of Newton's method (", '--seconds')
    assert 'not by itself' not in line, line
    line = refused(3, *words, '--seconds', '1e-9')  # over before it begins, on every machine
    says(line, 'the time was over', ' tried 0 motions', 'ended after 1e-09 s (--seconds), not by itself')


def test_what_cannot_be_is_refused_by_name():
    says(refused(2, 'orbit', *PAPER, '--orbit', '1:1'), '--orbit', '1:1')
    says(refused(2, 'orbit', *PAPER, '--orbit', '0-1'), '--orbit')
    says(refused(3, 'orbit', 'belt', '--orbit', '1-1', '--starts', '4'), 'no 1-1 orbit', 'free-0-II')
    says(refused(2, 'continue', *PAPER, '--param', 'omgea', '--range', '2:3'), 'omgea')
    says(refused(2, 'continue', *PAPER, '--param', 'omega', '--range', '3:4'), '--range', '2.7')
    says(refused(2, 'continue', *PAPER, '--param', 'omega', '--range', '3'), '--range', 'A:B')
    says(refused(2, 'continue', *PAPER, '--param', 'omega', '--range', '2.6:2.9', '--diagram', '9'), '--diagram', '--plot')
    says(refused(2, 'continue', *PAPER, '--param', 'omega', '--range', '2.6:2.9', '--diagram', '1', '--plot', 'b.png'), '--diagram')
    says(refused(2, 'curve', *PAPER, '--params', 'omega', '--range', 'omega=2:3'), '--params')
    says(refused(2, 'curve', *PAPER, '--params', 'omega,friction', '--range', 'omega=2:3'), 'friction')
    says(refused(3, 'orbit', *PAPER, '--orbit', '1-7', '--starts', '2'), '1-7')
    says(refused(2, 'orbit', *PAPER, '--orbit', '1-1-III'), '--orbit', '1-1-III')
    says(refused(2, 'orbit', *PAPER, '--stable', '--unstable'), '--stable', '--unstable')
    says(refused(3, 'orbit', 'belt', '--unstable', '--starts', '4'), 'no unstable periodic orbit', 'free-0-II')
    says(refused(2, 'orbit', *PAPER, '--seconds', '-1'), '--seconds')


def test_the_energy_of_a_slider_has_its_name():
    """The area of its loop, 4 f (a - f / k)."""
    damper = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'examples', 'friction-damper', 'friction_damper.toml')
    found = json.loads(good('orbit', damper, '--of', 'x:max'))
    limit, stiffness, swing = 0.05, 0.2, found['values']['x:max']
    energy = found['energy']
    assert abs(energy['friction']['damper'] - 4 * limit * (swing - limit / stiffness)) < 1e-12, energy
    assert abs(energy['input'] - energy['damping'] - energy['friction']['damper']) < 1e-12 and energy['damping'] > 0, energy


if __name__ == '__main__':
    main({name: case for name, case in globals().items() if name.startswith('test_')})
