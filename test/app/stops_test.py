"""Sections, classes and pictures of models with several stops, and with compliant ones. One CTest case per function `test_...`."""
import math
import os

from program import good, main, read, refused, says, table

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..')

# A wall for x1, a meeting of both, a buffer for x2.
MIXED = '''name = "mixed"
omega = "omega"
[parameters]
omega = 1.3
[[coordinate]]
name = "x1"
mass = 1
[[coordinate]]
name = "x2"
mass = 2
[[spring]]
between = ["x1", "ground"]
stiffness = 1
[[spring]]
between = ["x2", "ground"]
stiffness = 2
[[damper]]
between = ["x1", "x2"]
coefficient = 0.1
[[force]]
on = "x1"
amplitude = 1
[[friction]]
name = "rub"
between = ["x1", "x2"]
static = 0.02
[[stop]]
name = "wall"
between = ["x1", "ground"]
clearance = 0.5
restitution = 0.7
[[stop]]
name = "meet"
between = ["x2", "x1"]
clearance = 0.6
restitution = 0.8
[[compliant_stop]]
name = "buffer"
between = ["x2", "ground"]
clearance = 0.1
stiffness = 20
'''


def mixed():
    with open('mixed.toml', 'w', encoding='utf-8') as file:
        file.write(MIXED)
    return 'mixed.toml'


def column(text, name):
    columns, rows = table(text)
    return [row[columns.index(name)] for row in rows]


def close(a, b):
    return abs(float(a) - float(b)) < 1e-9


def test_the_flights_of_one_side_are_those_of_both_added_up():
    words = ('poincare', 'two-sided-rattle', '--points')
    both = good(*words, '40')
    for side, other in (('stop_upper', 'stop_lower'), ('stop_lower', 'stop_upper')):
        own = good(*words, '20', '--stop', side)
        assert set(column(own, 'contact')) == {side}
        times = [time for time, contact in zip(column(both, 'time'), column(both, 'contact')) if contact == side]
        assert column(own, 'time')[:len(times)] == times
        assert good(*words, '40', '--stop', side, '--stop', other) == both
        for before, after, flight in zip(column(own, 'time'), column(own, 'time')[1:], column(own, 'flight')[1:]):
            assert close(flight, (float(after) - float(before)) * 1.5 / (2 * 3.141592653589793)), flight  # omega = 1.5


def test_every_verb_refuses_an_unknown_stop_and_lists_the_others():
    for verb in (('poincare',), ('classify',), ('diagram', '--sweep', 'omega=1:2:3'), ('simulate', '--plot', 'p.png')):
        words = (verb[0], 'two-sided-rattle', *verb[1:])
        says(refused(2, *words, '--stop', 'stop'), "--stop: model 'two-sided-rattle' has no stop 'stop'; the model has stop_upper, stop_lower")
        refused(2, *words, '--stop', '')
    says(refused(2, 'classify', 'coulomb-oscillator', '--stop', 'friction'), '--stop', 'nor any other')
    says(refused(2, 'simulate', 'two-sided-rattle', '--stop', 'stop_upper'), '--stop', '--plot')
    says(refused(2, 'simulate', 'two-sided-rattle', '--plot', 'p.png', '--stop', 'stop_upper', '--stop', 'stop_lower'), '--stop', 'one pair')
    says(refused(2, 'poincare', 'two-sided-rattle', '--section', 'stroboscopic', '--stop', 'stop_upper'), '--stop', '--plot')
    assert os.listdir('.') == []


def test_classify_says_which_stop_each_impact_was_on():
    both = good('classify', 'two-sided-rattle')
    says(both, '"class": "1-2-I"', '"contact": "stop_upper"', '"contact": "stop_lower"')
    for side, other in (('stop_upper', 'stop_lower'), ('stop_lower', 'stop_upper')):
        one = good('classify', 'two-sided-rattle', '--stop', side)
        says(one, '"class": "1-1-I"', '"p": 1,', '"contact": "%s"' % side)
        assert other not in one
        assert one.split('"state"')[-1] == both.split('"state"')[-1]
    assert '"contact"' not in good('classify', 'vibro-impact')  # one stop: nothing to tell apart


def test_every_library_model_with_a_stop_has_a_section():
    for name, values, contacts in (('bilinear-oscillator', ('omega=1.5',), None), ('gear-pair', ('omega=1',), {'tooth_upper'}),
                                   ('impact-pair', (), {'wall_upper', 'wall_lower'}), ('spool', (), None),
                                   ('impact-absorber', (), {'gap_upper', 'gap_lower'}), ('vibro-impact', (), None)):
        sets = [word for value in values for word in ('--set', value)]
        text = good('poincare', name, *sets, '--points', '20')
        assert len(table(text)[1]) == 20 and all(float(w) > 0 for w in column(text, 'w')), name
        if contacts is not None:
            assert set(column(text, 'contact')) <= contacts, name


def test_engagements_are_the_points_of_compliant_stops():
    words = ('bilinear-oscillator', '--set', 'omega=1.5')
    good('simulate', *words, '--periods', '60', '--events', 'e.csv', '--out', 'o.json')
    columns, rows = table(read('e.csv'))
    engaged = [row for row in rows if row[1] == 'engage' and float(row[3]) > 0]
    section = good('poincare', *words, '--transient', '0', '--points', str(len(engaged)))
    assert column(section, 'time') == [row[0] for row in engaged] and column(section, 'w') == [row[3] for row in engaged]
    diagram = good('diagram', 'bilinear-oscillator', '--sweep', 'omega=1.4:1.5:2', '--impacts', '6')
    last = good('poincare', *words, '--points', '1')
    assert any(close(w, column(last, 'w')[0]) for w in column(diagram, 'w')[6:])
    p = int(good('classify', *words).split('"p": ')[1].split(',')[0])
    assert p == good('classify', *words).count('"phase": ') > 0


def test_both_kinds_of_stops_make_one_section_or_each_their_own():
    all_of_them = good('poincare', mixed(), '--points', '300')
    assert set(column(all_of_them, 'contact')) == {'wall', 'meet', 'buffer'}
    for name in ('wall', 'meet', 'buffer'):
        own = good('poincare', 'mixed.toml', '--points', '20', '--stop', name)
        both = zip(column(all_of_them, 'time'), column(all_of_them, 'contact'))
        assert [time for time, contact in both if contact == name][:20] == column(own, 'time'), name
        swept = good('diagram', 'mixed.toml', '--sweep', 'omega=1.3:1.4:2', '--impacts', '5', '--stop', name)
        assert set(column(swept, 'contact')) == {name}
    says(good('check', 'mixed.toml'), '"stops": 2', '"compliant_stops": 1')


def test_a_picture_is_about_the_chosen_stop():
    labels = {'wall': ('x_{1}', 'v_{1}'), 'meet': ('x_{2} − x_{1}', 'v_{2} − v_{1}'), 'buffer': ('x_{2}', 'v_{2}')}
    for name, (x, v) in labels.items():
        good('simulate', mixed(), '--periods', '30', '--plot', 's.png', '--stop', name, '--out', 'o.json')
        good('poincare', 'mixed.toml', '--points', '50', '--section', 'stroboscopic', '--plot', 'p.png', '--stop', name, '--out', 'p.csv')
        for script in ('s.gp', 'p.gp'):
            says(read(script), "label '%s' at" % x, "label '%s' at" % v)
        good('poincare', 'mixed.toml', '--points', '50', '--plot', 'p.png', '--stop', name, '--out', 'p.csv')
        says(read('p.gp'), 'engagement of buffer' if name == 'buffer' else 'impact on ' + name)
    good('poincare', 'mixed.toml', '--points', '50', '--plot', 'p.png', '--out', 'p.csv')
    says(read('p.gp'), 'w just before the contact', 'wall', 'meet', 'buffer')
    good('diagram', 'two-sided-rattle', '--sweep', 'omega=1:1.2:3', '--impacts', '5', '--stop', 'stop_lower', '--plot', 'd.png', '--out', 'd.csv')
    flights = [line.split(',')[3] for line in read('d-plot.csv').splitlines()[1:]]
    assert flights == ['%r' % float(flight) for flight in column(read('d.csv'), 'flight')] or all(
        close(a, b) for a, b in zip(flights, column(read('d.csv'), 'flight')))
    says(read('d.gp'), 'w at impact on stop')


def test_the_documented_contact_force_is_the_one_that_acts():
    """docs/reference/model_file.md: the force of a compliant stop as an observable. Momentum is the integral of the forces."""
    with open('pad.toml', 'w', encoding='utf-8') as file:
        file.write('name = "pad"\nomega = 3\n[[coordinate]]\nname = "x"\nmass = 1\n[[force]]\non = "x"\namplitude = 1\nharmonic = 0\n'
                   '[[force]]\non = "x"\namplitude = 6\n[[compliant_stop]]\nname = "pad"\nbetween = ["x", "ground"]\nclearance = 0.1\nstiffness = 9\n'
                   'damping = 2\n[[observable]]\nname = "pressed"\nvalue = "gap_pad < 0 ? max(0, -9 * gap_pad + 2 * v) : 0"\n'
                   '[[observable]]\nname = "driven"\nvalue = "1 + 6 * sin(3 * time)"\n[start]\nx = -1\n')
    good('simulate', 'pad.toml', '--periods', '40', '--samples', '2000', '--trajectory', 't.csv', '--events', 'e.csv', '--out', 'o.json')
    time, v, pressed, driven = ([float(value) for value in column(read('t.csv'), name)] for name in ('time', 'v', 'pressed', 'driven'))
    impulse = sum((driven[i] - pressed[i] + driven[i + 1] - pressed[i + 1]) / 2 * (time[i + 1] - time[i]) for i in range(len(time) - 1))
    onsets = [after for before, after in zip(pressed, pressed[1:]) if before == 0 < after]
    bound = sum(onsets) * time[1] / 2 + 1e-4  # where the force jumps, the trapezoid is wrong by half a step of it at most
    assert abs(v[-1] - v[0] - impulse) < bound < 1, (v[-1] - v[0], impulse, bound)
    engaged = sum(kind == 'engage' for kind in column(read('e.csv'), 'kind'))
    assert engaged == len(onsets) > 10, (engaged, onsets)


def test_a_short_bounce_is_a_curve_not_a_polygon():
    """3 periods with chatter: between its points no curve is farther from the motion than a thousandth of the frame."""
    good('simulate', 'vibro-impact', '--set', 'omega=0.552', '--periods', '3', '--events', 'e.csv', '--plot', 'p.png', '--out', 's.json',
         '--trajectory', 't.csv', '--samples', '4000')
    columns, rows = table(read('p-plot.csv'))
    at = next(k for k, name in enumerate(columns) if name == '"panel 2 line 1 x"')
    curve = [(float(row[at]), float(row[at + 1])) for row in rows if row[at] not in ('', 'NaN')]
    times = [t for t, _ in curve]
    period = 2 * math.pi / 0.552
    impacts = [float(row[0]) / period for row in table(read('e.csv'))[1] if row[1] == 'impact']
    short = [(a, b) for a, b in zip(impacts, impacts[1:]) if 0.01 < b - a < 0.04]
    assert len(short) > 3, impacts
    for a, b in short:
        assert sum(a < t < b for t in times) >= 8, (a, b)
    assert len(times) < 3 * 1000, len(times)  # long flights are thinner
    names, samples = table(read('t.csv'))
    motion = [(float(row[0]) / period, float(row[names.index('x1')]) - float(row[names.index('x2')])) for row in samples]
    extent = max(y for _, y in motion) - min(y for _, y in motion)
    k = worst = 0
    for t, y in motion:
        while k + 2 < len(curve) and curve[k + 1][0] < t:
            k += 1
        (t0, y0), (t1, y1) = curve[k], curve[k + 1]
        if t0 < t < t1:
            worst = max(worst, abs(y - y0 - (y1 - y0) * (t - t0) / (t1 - t0)))
    assert worst < 1e-3 * extent, (worst, extent)


def test_the_picture_says_where_contacts_stick_and_rest():
    """The shaded spans of the picture are those between the events of the table; impacts are its discs."""
    words = ('simulate', 'vibro-impact', '--set', 'omega=0.552', '--periods', '30', '--out', 's.json')
    good(*words, '--window', '28:30', '--events', 'e.csv', '--plot', 'p.png')
    period = 2 * math.pi / 0.552
    events = [(float(row[0]) / period, row[1]) for row in table(read('e.csv'))[1]]
    spans = [line.split() for line in read('p.gp').splitlines() if 'set object rectangle' in line]
    spans = sorted({(float(span[4].rstrip(',')), float(span[8].rstrip(','))) for span in spans})
    rests = [(t, next(u for u, what in events if u > t and what == 'release')) for t, kind in events if kind == 'chatter' and t > 28]
    for begin, end in rests:
        assert any(abs(a - begin) < 1e-6 and abs(b - end) < 1e-6 for a, b in spans), (begin, end, spans)
    assert len(rests) == 2, rests
    columns, rows = table(read('p-plot.csv'))
    discs = next(k for k, name in enumerate(columns) if name.startswith('"panel 2 points') and name.endswith('x"'))
    marked = [float(row[discs]) for row in rows if row[discs] not in ('', 'NaN')]
    assert len(marked) == sum(kind == 'impact' and t >= 28 for t, kind in events), (len(marked), events)
    says(read('p.gp'), 'set xrange [28:30]', "'impact'", "'contact'")
    good(*words, '--show', 'x1-x2:v1-v2,x1,gap_stop', '--plot', 'q.png')
    says(read('q.gp'), "label 'x_{1} \u2212 x_{2}' at", "label 'x_{1}' at", 'gap')
    says(refused(2, *words, '--show', 'x3', '--plot', 'q.png'), '--show', 'x3')
    says(refused(2, *words, '--show', 'impulse', '--plot', 'q.png'), '--show', 'impulse', 'at impacts only')
    says(refused(2, *words, '--window', '31:40', '--plot', 'q.png'), '--window', '30')


def test_a_picture_shows_forces_and_accelerations():
    """The loop of a friction damper lies within its limit; an acceleration goes as far as in a dense table."""
    def drawn(axis):
        columns, rows = table(read('f-plot.csv'))
        places = [k for k, name in enumerate(columns) if name.startswith('"panel 1 line') and name.endswith(axis + '"')]
        return [float(row[k]) for row in rows for k in places if row[k] not in ('', 'NaN')]

    damper = os.path.join(ROOT, 'examples', 'friction-damper', 'friction_damper.toml')
    good('simulate', damper, '--periods', '40', '--window', '38:40', '--out', 's.json', '--show', 'x:F_damper', '--plot', 'f.png')
    assert abs(max(drawn('y')) - 0.05) < 1e-15 and abs(min(drawn('y')) + 0.05) < 1e-15, (max(drawn('y')), min(drawn('y')))
    with open('o.toml', 'w', encoding='utf-8') as file:
        file.write(read(damper) + '[[observable]]\nname = "twice"\nvalue = "2 * F_damper + 0 * time"\n')
    good('simulate', 'o.toml', '--periods', '40', '--window', '38:40', '--out', 's.json', '--show', 'x:twice', '--plot', 'f.png')
    assert abs(max(drawn('y')) - 0.1) < 1e-15 and abs(min(drawn('y')) + 0.1) < 1e-15, (max(drawn('y')), min(drawn('y')))
    words = ('simulate', 'vibro-impact', '--set', 'omega=0.552', '--periods', '30', '--window', '28:30', '--out', 's.json')
    good(*words, '--show', 'a1', '--plot', 'f.png', '--trajectory', 't.csv', '--samples', '2000', '--columns', 'a1')
    values = [float(row[-1]) for row in table(read('t.csv'))[1][-4001:]]
    for end in (max, min):
        assert abs(end(drawn('y')) - end(values)) < 1e-3 * (max(values) - min(values)), (end(drawn('y')), end(values))


def test_a_picture_of_another_format_keeps_the_script_of_the_first():
    words = ('poincare', 'vibro-impact', '--points', '20', '--out', 'p.csv')
    good(*words, '--plot', 'p.png')
    script = read('p.gp')
    good(*words, '--set', 'omega=3', '--plot', 'p.svg', '--plot-size', '60x50mm')
    assert read('p.gp') == script and os.path.exists('p-svg.gp') and os.path.exists('p-svg-plot.csv')
    says(read('p-svg.gp'), 'size 227,189')
    for size in ('85', 'mm', '85m', '1mm', '85x', 'x5mm'):
        says(refused(2, *words, '--plot', 'p.svg', '--plot-size', size), '--plot-size')
    says(refused(2, *words, '--plot-size', '85mm'), '--plot-size', '--plot')


def test_pictures_without_a_period_have_no_phase_and_no_period_on_their_axes():
    good('poincare', 'bouncing-ball', '--transient', '0', '--points', '10', '--out', 'b.csv', '--plot', 'b.png')
    pairs = [[float(word) for word in row[:2]] for row in table(read('b-plot.csv'))[1]]
    diagonal = [row[2:] for row in table(read('b-plot.csv'))[1] if row[2]]
    assert len(diagonal) == 2 and all(x == y for x, y in diagonal), diagonal
    assert len(pairs) == 9 and all(abs(after - 0.8 * w) < 1e-12 for w, after in pairs), pairs
    good('diagram', 'bouncing-ball', '--sweep', 'restitution=0.5:0.9:5', '--start', 'reset', '--transient', '0', '--impacts', '5', '--most-periods', '50', '--out', 'd.csv', '--plot', 'd.png')
    script = read('d.gp')
    says(script, "label 'flight [s]' at")
    assert 'period' not in script.split('multiplot')[1]


main({name: case for name, case in globals().items() if name.startswith('test_')})
