"""The program as its users meet it: exit status, messages, files. One CTest case per function `test_...`; named after its danger."""
import math
import os
import signal
import subprocess

from beside import Beside, bytes_of, second, shows_progress
from program import PROGRAM, good, main, read, refused, run, says, table

PAPER_STATE = ['x1', 'v1', 'x2', 'v2']
LONG_SWEEP = ('diagram', 'vibro-impact', '--sweep', 'omega=1:6:300000', '--transient', '2000')  # hours


def test_help_and_version_are_results_not_errors():
    for words in (['--help'], ['help'], ['simulate', '--help'], ['diagram', '-h'], ['help', 'poincare']):
        assert len(good(*words)) > 200
    says(good('--help'), 'models', 'simulate', 'Exit status')
    assert good('--version').startswith('slapstick ')


def test_every_verb_of_the_help_is_there():
    verbs = [line.split()[0] for line in good('--help').split('Verbs:\n')[1].split('\n\n')[0].splitlines()]
    assert {'models', 'new', 'show', 'check', 'simulate', 'poincare', 'diagram'} <= set(verbs)
    for verb in verbs:
        says(good(verb, '--help'), 'slapstick ' + verb)


def test_mistyped_names_suggest_the_nearest():
    says(refused(2, 'simulte', 'vibro-impact'), "'simulte'", "'simulate'")
    says(refused(2, 'simulate', 'vibro-impct'), "'vibro-impact'")
    says(refused(2, 'simulate', 'vibro-impact', '--peroids', '3'), "'--peroids'", "'--periods'")
    says(refused(2, 'simulate', 'vibro-impact', '--set', 'omga=3'), '--set', "'omga'", "'omega'")
    says(refused(2, 'simulate', 'vibro-impact', '--state', 'y1=3'), '--state', "'y1'")
    says(refused(2, 'diagram', 'vibro-impact', '--sweep', 'omga=1:2:3'), '--sweep', "'omega'")


def test_bad_values_name_their_argument():
    simulate = ('simulate', 'vibro-impact')
    for bad in ('omega', 'omega=', '=3', 'omega=abc', 'omega=nan', 'omega=1e999', 'omega=-1', 'restitution=1.5', ''):
        says(refused(2, *simulate, '--set', bad), '--set')
    for bad in ('x1', 'x1=', 'x1=a', 'x1=inf', 'x1=1', 'x1=-1,x1=-2', ','):
        says(refused(2, *simulate, '--state', bad), '--state')
    for bad in ('-1', '1.5', 'many', '', '99999999999999999999'):
        says(refused(2, *simulate, '--periods', bad), '--periods')
    for bad in ('-1', 'nan', '1e300'):
        says(refused(2, *simulate, '--time', bad), '--time')
    for bad in ('omega', 'omega=1:2', 'omega=1:2:1', 'omega=2:1:5', 'omega=1:2:5:6', 'omega=1:nan:5', 'omega=1:2:1e18', 'omega=1:2:10000001', 'omega=0:2:5', '='):
        says(refused(2, 'diagram', 'vibro-impact', '--sweep', bad), '--sweep')
    says(refused(2, 'diagram', 'vibro-impact', '--sweep', 'omega=1:2:5', '--direction', 'left'), '--direction')
    says(refused(2, 'poincare', 'vibro-impact', '--section', 'stroboscopic', '--phase', '1'), '--phase')


def test_extreme_numbers_end_at_once_with_a_reason():
    names = [line.split('"')[1] for line in good('check', 'vibro-impact').split('"units"')[0].split('"parameters"')[1].splitlines()[1:] if '":' in line]
    assert len(names) == 11
    for name in names:
        for value in ('1e-300', '1e-12', '1e12', '1e100', '1e160', '1e307'):
            done = Beside('simulate', 'vibro-impact', '--set', name + '=' + value, '--periods', '10').outcome()
            assert done.cpu < 20 * second(), (name, value, done.cpu, second())
            assert done.status in (0, 2, 3) and done.err.count('\n') == (done.status != 0), (name, value, done.err)
            if done.status != 0:
                says(done.err, name)
            if float(value) > 1e50 and name != 'phase':
                assert done.status == 2, (name, value)
    slow = ('--set', 'omega=1e-12')
    for words in (('simulate', '--periods', '10'), ('simulate', '--time', '1e13'), ('classify',), ('poincare',),
                  ('poincare', '--section', 'stroboscopic')):
        says(refused(2, words[0], 'vibro-impact', *slow, *words[1:]), '--set omega=1e-12: ', 'windows', 'lower --')
    says(refused(2, 'diagram', 'vibro-impact', '--sweep', 'omega=1e-12:1:3'), '--sweep omega=1e-12', 'windows')
    good('simulate', 'vibro-impact', *slow, '--time', '100')  # a small part of one period is no hard work
    says(refused(2, 'simulate', 'vibro-impact', '--state', 'v1=1e200'), '--state', 'v1', '1e50')
    says(refused(2, 'simulate', 'vibro-impact', '--set', 'clearance=1e16'), 'clearance', 'rounding')


def test_the_argument_at_fault_is_named():
    says(refused(2, 'simulate', 'vibro-impact', '--set', 'omega=3', '--set', 'kinetic_friction=0.5'), 'slapstick: --set kinetic_friction=0.5: ', 'exceeds')
    says(refused(2, 'simulate', 'vibro-impact', '--set', 'omega=3', '--set', 'clearance=-1'), 'slapstick: --set clearance=-1: ', 'violated')
    both = refused(2, 'check', 'vibro-impact', '--set', 'static_friction=0.2', '--set', 'kinetic_friction=0.5', '--set', 'omega=3')
    says(both, '--set kinetic_friction=0.5: ')
    for line in (both, refused(2, 'diagram', 'vibro-impact', '--sweep', 'clearance=-1:1:3'), refused(2, 'diagram', 'vibro-impact', '--sweep', 'kinetic_friction=0:1:3')):
        assert 'built in' not in line, line


def test_contradictions_are_refused():
    refused(2)
    refused(2, 'simulate')
    refused(2, 'simulate', 'vibro-impact', 'more')
    says(refused(2, 'simulate', 'vibro-impact', '--periods', '3', '--time', '3'), '--time', '--periods')
    says(refused(2, 'simulate', 'vibro-impact', '--periods', '3', '--periods', '4'), '--periods')
    says(refused(2, 'simulate', 'vibro-impact', '--set', 'omega=1', '--set', 'omega=2'), '--set')
    says(refused(2, 'diagram', 'vibro-impact', '--sweep', 'omega=1:2:3', '--set', 'omega=2'), '--sweep')
    says(refused(2, 'diagram', 'vibro-impact', '--sweep', 'omega=1:2:3', '--direction', 'both', '--start', 'reset'), '--direction')
    says(refused(2, 'diagram', 'belt', '--sweep', 'belt_speed=1:2:3'), 'no stop', 'simulate')
    says(refused(2, 'diagram', 'coulomb-oscillator', '--sweep', 'omega=1:2:3'), 'no stop', 'poincare')
    says(refused(2, 'poincare', 'belt'), 'stop')
    says(refused(2, 'poincare', 'belt', '--section', 'stroboscopic'), 'forcing')


def test_hostile_words_stay_on_one_line():
    for bad in ('a\nb', '\x1b[31m', '\xff' * 5000, '--', '-', '--set'):
        refused(2, bad)
        refused(2, 'simulate', 'vibro-impact', '--set', bad + '=1')
        refused(2 if bad.startswith('-') else 4, 'simulate', bad + '.toml')


def test_status_3_says_where_and_leaves_no_file():
    line = refused(3, *endless('--periods', '1', '--events', 'e.csv', '--out', 'o.json'))
    says(line, 'period 0', 'state')
    assert os.listdir('.') == []


def endless(*words, omega='omega=1e-5', restitution='restitution=0.999999999'):
    """More than a million bounces in one period, where nothing of that is changed."""
    values = [omega, restitution, 'load=10', 'cosine=0', 'damping_ratio=0']
    return ['simulate', 'impact-oscillator', '--state', 'x=-0.001', *[word for value in values for word in ('--set', value)], *words]


def test_each_remedy_for_too_many_events_is_one():  # it said "raise the budget", for which there is no option
    says(refused(3, *endless('--periods', '1')), 'lower restitution', 'shorter forcing period', 'earlier end')
    good(*endless('--periods', '1', restitution='restitution=0.9'))
    good(*endless('--periods', '1', omega='omega=1'))
    good(*endless('--time', '10'))


def test_status_4_before_the_work_starts():
    for option in ('--out', '--plot', '--events', '--trajectory'):
        line = refused(4, 'simulate', 'vibro-impact', '--periods', '1000000000', option, 'no/such/folder/f.png')
        says(line, 'no/such/folder/f.png')
    refused(4, *LONG_SWEEP, '--out', '/proc/nothing.csv')
    os.mkdir('folder.csv')
    says(refused(4, *LONG_SWEEP, '--out', 'folder.csv'), 'folder.csv')


def test_full_or_closed_standard_output_is_status_4():
    with open('/dev/full', 'wb') as full:
        for words in (['models'], ['--help'], ['poincare', 'vibro-impact', '--points', '100']):
            refused(4, *words, out=full)


def test_old_output_survives_a_failure():
    with open('e.csv', 'w', encoding='utf-8') as file:
        file.write('precious\n')
    refused(4, 'simulate', 'vibro-impact', '--events', 'e.csv', '--trajectory', 'no/t.csv')
    refused(2, 'simulate', 'vibro-impact', '--set', 'omega=-1', '--events', 'e.csv')
    refused(2, 'diagram', 'vibro-impact', '--sweep', 'restitution=0:2:5', '--out', 'e.csv')
    assert read('e.csv') == 'precious\n'
    assert os.listdir('.') == ['e.csv'], os.listdir('.')


def test_one_file_for_two_roles_is_refused():
    with open('m.toml', 'w', encoding='utf-8') as file:
        file.write(good('show', 'vibro-impact'))
    model = read('m.toml')
    says(refused(2, 'simulate', 'm.toml', '--events', './m.toml'), 'm.toml', 'MODEL')
    says(refused(2, 'simulate', 'm.toml', '--events', 'a.csv', '--trajectory', './a.csv'), '--events')
    says(refused(2, 'simulate', 'm.toml', '--events', 'a-plot.csv', '--plot', 'a.png'), '--events', '--plot')
    assert read('m.toml') == model and os.listdir('.') == ['m.toml']


def test_a_table_and_a_picture_of_one_name_do_not_clash():
    good('diagram', 'vibro-impact', '--sweep', 'omega=2:3:3', '--impacts', '5', '--plot', 'd.png', '--out', 'd.csv')
    assert sorted(os.listdir('.')) == ['d-plot.csv', 'd.csv', 'd.gp', 'd.png']
    says(read('d.gp'), './d-plot.csv')
    says(read('d.csv'), 'omega,direction')


def test_a_picture_without_points_is_missed_aloud():
    words = ('vibro-impact', '--plot', 'p.png', '--out', 'p.csv')
    sweep = ('--sweep', 'clearance=8:9:2', '--direction', 'both')
    done = run('diagram', *words, *sweep)
    assert done.status == 3, done.status
    says(done.err, '--plot: there are no points', 'no impacts at 2 (up) and 2 (down) of the values, first clearance = 8')
    assert os.listdir('.') == ['p.csv']


def test_a_missing_gnuplot_is_noticed_before_the_work():
    for words in ((*LONG_SWEEP, '--plot', 'p.png'), ('simulate', 'vibro-impact', '--periods', '1000000000', '--plot', 'p.png'),
                  ('poincare', 'vibro-impact', '--points', '1000000000', '--plot', 'p.png'), ('reproduce', '--out', 'out')):
        says(refused(4, *words, env={'PATH': '/nowhere'}), 'gnuplot not found: install gnuplot-nox')
    assert os.listdir('.') == []


def test_json_numbers_have_17_digits_and_are_finite():
    text = good('classify', 'vibro-impact', '--set', 'omega=0.552', '--set', 'friction=0.2') + good('simulate', 'vibro-impact')
    says(text, '"static_friction": 0.20000000000000001')
    assert ': nan' not in text and ': -inf' not in text and ': inf' not in text


def test_events_have_the_stable_columns():
    good('simulate', 'vibro-impact', '--set', 'omega=0.552', '--periods', '30', '--events', 'e.csv', '--out', 'o.json')
    columns, rows = table(read('e.csv'))
    assert columns == ['time', 'kind', 'contact', 'w'] + PAPER_STATE
    kinds = {row[1] for row in rows}
    assert kinds <= {'impact', 'slip+', 'slip-', 'stick', 'release', 'graze', 'chatter'} and {'impact', 'chatter', 'release'} <= kinds
    times = [float(row[0]) for row in rows]
    assert times == sorted(times) and times[-1] <= 30 * 2 * math.pi / 0.552
    for row in rows:
        time, kind, contact, w, x1, v1, x2, v2 = row
        if kind == 'impact':
            assert contact == 'stop' and float(w) > 0 and abs(float(v1) - float(v2) - float(w)) < 1e-14 and abs(float(x1) - float(x2)) < 1e-14
        assert repr(float(time)) == repr(float('%.17g' % float(time)))
    summary = read('o.json')
    for kind in kinds:
        says(summary, '"%s": %d' % (kind, sum(row[1] == kind for row in rows)))


def test_events_do_not_depend_on_what_else_is_written():
    words = ('simulate', 'vibro-impact', '--set', 'omega=4.9', '--periods', '300')
    good(*words, '--events', 'a.csv', '--out', 'a.json')
    good(*words, '--events', 'b.csv', '--out', 'b.json', '--trajectory', 't.csv', '--samples', '7', '--plot', 'p.png')
    assert read('a.csv') == read('b.csv') and read('a.json') == read('b.json')
    columns, rows = table(read('t.csv'))
    assert columns == ['time'] + PAPER_STATE + ['mode'] and len(rows) == 300 * 7 + 1
    assert os.path.getsize('p.png') > 1000 and os.path.exists('p.gp')


def test_several_contacts_keep_their_tables_whole():
    for model in ('bilinear-oscillator', 'two-blocks-on-belt'):  # compliant events; a mode name of two friction contacts
        good('simulate', model, '--time', '20', '--trajectory', 't.csv', '--samples', '50', '--events', 'e.csv', '--out', 'o.json')
        header, *rows = [line.split(',') for line in read('t.csv').splitlines()]
        assert all(len(row) == len(header) for row in rows), model
        times = [float(row[0]) for row in rows]
        steps = {round((b - a) * 1e6) for a, b in zip(times, times[1:])}
        assert len(steps) <= 2, (model, steps)  # of equal length, up to a rounding
    good('simulate', 'bilinear-oscillator', '--periods', '20', '--events', 'e.csv', '--out', 'o.json')
    kinds = [line.split(',')[1] for line in read('e.csv').splitlines()[1:]]
    for kind in ('engage', 'disengage'):
        assert kinds.count(kind) > 0
        says(read('o.json'), '"%s": %d' % (kind, kinds.count(kind)))


def test_sections_of_several_stops_say_which_was_hit():
    good('poincare', 'two-sided-rattle', '--points', '40', '--out', 'p.csv')
    good('diagram', 'two-sided-rattle', '--sweep', 'omega=1:1.2:3', '--impacts', '20', '--out', 'd.csv')
    for name in ('p.csv', 'd.csv'):
        header, *rows = [line.split(',') for line in read(name).splitlines()]
        assert header[-1] == 'contact'
        assert {row[-1] for row in rows} == {'stop_upper', 'stop_lower'}, name


def test_observables_are_columns_of_the_trajectory():
    with open('m.toml', 'w', encoding='utf-8') as file:
        file.write(good('show', 'impact-oscillator') + '[[observable]]\nname = "energy"\nvalue = "(x^2 + v^2) / 2"\n'
                   '[[observable]]\nname = "late"\nvalue = "time - gap_stop"\n')
    says(good('show', 'm.toml'), '[[observable]]', 'value = "(x^2 + v^2) / 2"')
    good('simulate', 'm.toml', '--periods', '5', '--trajectory', 't.csv', '--events', 'e.csv', '--out', 'o.json')
    columns, rows = table(read('t.csv'))
    assert columns == ['time', 'x', 'v', 'mode', 'energy', 'late']
    for time, x, v, _, energy, late in rows:
        assert abs(float(energy) - (float(x) ** 2 + float(v) ** 2) / 2) < 1e-14
        assert abs(float(late) - (float(time) + float(x))) < 1e-14  # clearance = 0
    good('simulate', 'impact-oscillator', '--periods', '5', '--events', 'f.csv', '--out', 'p.json')
    assert read('e.csv') == read('f.csv')


def test_physical_tables_are_the_models_times_its_scale():
    with open('m.toml', 'w', encoding='utf-8') as file:
        file.write(good('show', 'vibro-impact') + '[scale]\nlength = { value = 2, unit = "mm" }\ntime = { value = 0.25, unit = "s" }\n'
                   '[[observable]]\nname = "slip"\nvalue = "v1 - v2"\nunit = "m/s"\n')
    words = ('simulate', 'm.toml', '--periods', '20', '--out', 'o.json')
    good(*words, '--events', 'e.csv', '--trajectory', 't.csv')
    good(*words, '--events', 'pe.csv', '--trajectory', 'pt.csv', '--physical')
    factors = {'time': 0.25, 'w': 8, 'x1': 2, 'v1': 8, 'x2': 2, 'v2': 8, 'slip': 0.008, 'kind': None, 'contact': None, 'mode': None}
    for plain, physical in (('e.csv', 'pe.csv'), ('t.csv', 'pt.csv')):
        names, rows = table(read(plain))
        headings, converted = table(read(physical))
        assert [heading.split(' [')[0] for heading in headings] == names and len(rows) == len(converted)
        for row, other in zip(rows, converted):
            for name, value, number in zip(names, row, other):
                assert number == value if factors[name] is None else abs(float(number) - factors[name] * float(value)) <= 1e-15 * abs(float(number))
    assert headings == ['time [s]', 'x1 [mm]', 'v1 [mm/s]', 'x2 [mm]', 'v2 [mm/s]', 'mode', 'slip [m/s]']
    says(refused(2, *words, '--physical'), '--physical', 'only with --events or --trajectory')
    says(refused(2, 'simulate', 'vibro-impact', '--physical', '--events', 'x.csv'), '--physical', 'no [scale]')


def test_time_and_periods_are_the_same_length():
    a = good('simulate', 'vibro-impact', '--set', 'omega=2', '--periods', '7')
    b = good('simulate', 'vibro-impact', '--set', 'omega=2', '--time', repr(7 * math.pi))
    assert a.split('"end"')[1].split('"mode"')[0] == b.split('"end"')[1].split('"mode"')[0]


def test_show_set_and_check_go_round():
    good('show', 'vibro-impact', '--set', 'omega=4.9', '--set', 'friction=0.2', '--out', 'm.toml')
    says(good('check', 'm.toml'), '"sound": true', '"omega": 4.9', '"kinetic_friction": 0.2')
    words = ('simulate', '--periods', '40', '--events')
    good(*words, 'a.csv', '--out', 'o', 'm.toml')
    good(*words, 'b.csv', '--out', 'o', 'vibro-impact', '--set', 'omega=4.9', '--set', 'friction=0.2')
    assert read('a.csv') == read('b.csv')
    for name in [line.split('"')[3] for line in good('models').splitlines() if '"name"' in line]:
        says(good('check', name), '"sound": true')
    with open('bad.toml', 'w', encoding='utf-8') as file:
        file.write(read('m.toml').replace('restitution = "restitution"', 'restitutoin = "restitution"'))
    says(refused(2, 'check', 'bad.toml'), 'bad.toml:', 'restitutoin')


def test_new_writes_a_file_that_works_and_overwrites_none():
    says(good('new', 'mine'), '"written": "mine.toml"', 'slapstick check mine.toml')
    says(good('check', 'mine.toml'), '"sound": true', '"name": "mine"')
    good('simulate', 'mine.toml', '--trajectory', 't.csv', '--out', 'o.json')
    columns, rows = table(read('t.csv'))
    assert columns == ['time', 'x1', 'v1', 'mode', 'energy'] and len(rows) == 10001
    says(good('diagram', 'mine.toml', '--sweep', 'omega=0.8:1:2', '--impacts', '2', '--transient', '20'), 'omega,direction')
    before = read('mine.toml')
    for again in ('mine', 'mine.toml', './mine'):
        says(refused(4, 'new', again), 'mine.toml', 'exists')
    assert read('mine.toml') == before
    os.symlink('nowhere', 'link.toml')
    says(refused(4, 'new', 'link'), 'exists')
    says(refused(4, 'new', 'no/such/folder/m'), 'no/such/folder/m.toml')
    for bad in ('', 'a b', 'a"b', 'a\nb', 'x' * 65, '.toml', 'a/'):
        says(refused(2, 'new', bad), 'NAME')
    assert sorted(os.listdir('.')) == ['link.toml', 'mine.toml', 'o.json', 't.csv']


def test_sections_are_those_of_the_motion():
    columns, rows = table(good('poincare', 'vibro-impact', '--points', '5'))
    assert columns == ['time', 'phase', 'w', 'flight', 'sliding'] + PAPER_STATE and len(rows) == 5
    assert all(abs(float(row[3]) - 1) < 1e-11 and abs(float(row[4]) - 1) < 1e-11 for row in rows)
    columns, rows = table(good('poincare', 'vibro-impact', '--points', '5', '--section', 'stroboscopic', '--phase', '0.25'))
    assert columns == ['time', 'phase'] + PAPER_STATE + ['mode']
    assert all(row[1] == '0.25' for row in rows)


def test_diagram_is_the_same_bytes_for_any_number_of_threads():
    words = ('diagram', 'vibro-impact', '--sweep', 'omega=0.6:6:25', '--transient', '50', '--impacts', '20', '--direction', 'both')
    one = good(*words, '--threads', '1')
    columns, rows = table(one)
    assert columns == ['omega', 'direction', 'w', 'flight', 'sliding', 'phase'] + PAPER_STATE
    assert len(rows) == 2 * 25 * 20 and {row[1] for row in rows} == {'up', 'down'}
    for threads in ('2', '3', '7', '0'):
        assert good(*words, '--threads', threads) == one
    good(*words, '--out', 'd.csv', '--plot', 'picture.png')
    assert read('d.csv') == one and os.path.getsize('picture.png') > 1000


def test_ctrl_c_writes_whole_rows_and_says_130():
    for number in (signal.SIGINT, signal.SIGTERM):
        sweep = Beside(*LONG_SWEEP, '--impacts', '30', '--out', 'd.csv', '--progress')
        assert sweep.until(shows_progress(sweep)), sweep.err()  # a value is done, and a million are not
        done = sweep.signalled(number)
        assert done.status == 130, (done.status, done.err)
        columns, rows = table(read('d.csv'))
        values = {row[0] for row in rows}
        assert 0 < len(values) < 300000
        assert all(sum(row[0] == value for row in rows) == 30 for value in list(values)[:5])
    endless = Beside('simulate', 'vibro-impact', '--periods', '10000000000', '--events', 'e.csv')
    assert endless.until(lambda: bytes_of('e.csv') > 0)
    done = endless.signalled(signal.SIGINT)
    assert done.status == 130 and '"complete": false' in done.out
    table(read('e.csv'))
    assert sorted(os.listdir('.')) == ['d.csv', 'e.csv']


def test_ctrl_c_within_a_forcing_period_of_minutes():
    slow = ('--set', 'omega=1e-9')
    for words in (('simulate', 'vibro-impact', *slow, '--periods', '2', '--trajectory', 't.csv', '--samples', '1'),
                  ('classify', 'vibro-impact', *slow, '--transient', '0'),
                  ('poincare', 'vibro-impact', *slow, '--transient', '2'),
                  ('poincare', 'vibro-impact', *slow, '--transient', '2', '--points', '1', '--section', 'stroboscopic'),
                  ('diagram', 'vibro-impact', '--sweep', 'omega=1e-9:2e-9:2', '--transient', '2')):
        endless = Beside(*words)
        assert endless.until(endless.works), (words, endless.err())
        done = endless.signalled(signal.SIGINT)
        assert done.status == 130, (words, done.status, done.err)
        assert done.cpu < 2 * second(), (words, done.cpu, second())
    assert os.listdir('.') == ['t.csv'], os.listdir('.')


def test_a_second_signal_ends_at_once_and_leaves_no_temporary_file():
    words = ('simulate', 'vibro-impact', '--periods', '1000000000', '--events', 'e.csv', '--trajectory', 't.csv', '--out', 'o.json')
    for both in ((signal.SIGINT, signal.SIGTERM), (signal.SIGTERM, signal.SIGINT)):
        endless = Beside(*words)
        assert endless.until(lambda: len(os.listdir('.')) == 3), endless.err()  # it writes all three
        assert endless.signalled(*both).status == 130  # the first is not acted upon before the second
        assert os.listdir('.') == [], os.listdir('.')


def test_progress_is_silent_when_nobody_looks():
    words = ('diagram', 'vibro-impact', '--sweep', 'omega=1:6:600', '--transient', '1500', '--impacts', '1', '--out', 'd.csv')
    assert good(*words) == ''
    done = run(*words, '--progress')
    assert done.status == 0 and ('left' in done.err or done.err == '')
    endless = Beside('classify', 'vibro-impact', '--transient', '1000000000', '--progress')
    assert endless.until(shows_progress(endless)), endless.err()
    says(endless.signalled(signal.SIGINT).err, 'periods at most', 'left')


main({name: case for name, case in globals().items() if name.startswith('test_')})
