"""What the program says when something is wrong with a number, a model file or a motion. One CTest case per function `test_...`."""
import json
import math
import os
import signal

from beside import Beside, second, shows_progress
from program import good, main, read, refused, run, says, table

HEAD = 'name = "m"\n'
COORDINATE = '[[coordinate]]\nname = "x"\nmass = %s\n'
FORCE = '[[force]]\non = "x"\namplitude = 1\n'


def write(path, text):
    with open(path, 'w', encoding='utf-8') as file:
        file.write(text)
    return path


def test_a_forcing_without_omega_is_said_where_it_stands():
    says(refused(2, 'check', write('f.toml', HEAD + COORDINATE % 1 + FORCE)), "f.toml:5: force 1: ", "no 'omega'")
    base = '[[base]]\nname = "b"\nharmonics = [{amplitude = 1, harmonic = 3}]\n[[spring]]\nbetween = ["x", "b"]\nstiffness = 1\n'
    says(refused(2, 'check', write('b.toml', HEAD + COORDINATE % 1 + base)), "b.toml:8: spring 1: its base", 'harmonic 3', "no 'omega'")
    good('check', write('c.toml', HEAD + COORDINATE % 1 + FORCE + 'harmonic = 0\n'))
    says(refused(2, 'check', write('z.toml', HEAD + 'omega = 0\n' + COORDINATE % 1 + FORCE)), 'z.toml:2:', 'omega = 0 is not positive')


def test_a_parameter_omega_is_not_the_forcing_frequency_until_the_file_says_so():
    text = HEAD + '%s[parameters]\nomega = 2\n' + COORDINATE % 1 + FORCE
    says(refused(2, 'check', write('o.toml', text % '')), "o.toml:7: force 1: ", 'write omega = "omega" above [parameters]')
    good('check', write('o.toml', text % 'omega = "omega"\n'))


def test_a_coefficient_that_follows_the_motion_is_told_from_a_misspelt_one():
    for name in ('x', 'v', 'time', 't'):
        says(refused(2, 'check', write('s.toml', HEAD + COORDINATE % '"1 + %s^2"' % name)), "s.toml:4: coordinate 'x': mass: ", "'%s' changes with the motion" % name, 'linear')
    says(refused(2, 'check', write('s.toml', HEAD + '[parameters]\nk = "x"\n' + COORDINATE % 1)), "s.toml:3: parameter 'k': ", "'x' changes with the motion")
    says(refused(2, 'check', write('s.toml', HEAD + COORDINATE % '"y"')), "unknown parameter 'y'")


def test_a_name_used_twice_is_said_before_what_follows_from_it():
    spring = '[[spring]]\nbetween = ["x", "y"]\nstiffness = "v"\n'
    says(refused(2, 'check', write('d.toml', HEAD + spring + COORDINATE % 1 + COORDINATE % 1)), "d.toml:8: coordinate 'x': name 'x' is used twice")
    velocity = '[[coordinate]]\nname = "v"\nmass = 1\n'
    says(refused(2, 'check', write('d.toml', HEAD + spring + COORDINATE % 1 + velocity)), "d.toml:8: coordinate 'v': name 'v' is used twice")
    stop = '[[stop]]\nname = "s%s"\nbetween = ["x", "ground"]\nclearance = 1\nrestitution = 0\ntwo_sided = %s\n'
    observable = '[[observable]]\nname = "o"\nvalue = "gap_s_upper + nonsense"\n'
    says(refused(2, 'check', write('d.toml', HEAD + COORDINATE % 1 + stop % ('', 'true') + stop % ('_upper', 'false') + observable)), "d.toml:11: stop 's_upper': name 's_upper' is used twice")


def test_a_file_without_coordinates_is_not_asked_for_their_names():
    for text in (HEAD, HEAD + FORCE, HEAD + '[start]\nx = 1\n'):
        says(refused(2, 'check', write('n.toml', text)), 'n.toml:1: model: the model has no coordinates')


def test_a_start_behind_a_stop_is_told_how_to_begin_elsewhere():
    stop = '[[stop]]\nname = "wall"\nbetween = ["x", "ground"]\nclearance = "gap"\nrestitution = 0.5\n[parameters]\ngap = 1\n'
    model = write('w.toml', HEAD + 'omega = 2\n' + COORDINATE % 1 + FORCE + stop)
    for verb in ('simulate', 'classify', 'poincare', 'orbit'):
        says(refused(2, verb, model, '--set', 'gap=-0.5'), '--set gap=-0.5', "stop 'wall' is violated", '--state x=..', '[start]')
    says(refused(2, 'diagram', model, '--sweep', 'gap=-1:1:3'), '--sweep gap=-1', "stop 'wall' is violated", '--state x=..', '[start]')
    good('classify', model, '--set', 'gap=-0.5', '--state', 'x=-1', '--transient', '10')
    says(refused(2, 'simulate', model, '--state', 'V=1'), "did you mean 'v'?")


def test_a_comma_or_a_unit_in_a_number_is_recognised():
    comma, unit = 'decimals have a point: 0.5, not 0,5', 'no unit'
    for words in (('simulate', 'vibro-impact', '--set', 'omega=%s'), ('simulate', 'vibro-impact', '--time', '%s'),
                  ('diagram', 'vibro-impact', '--sweep', 'omega=%s:1:3')):
        says(refused(2, *words[:-1], words[-1] % '0,5'), words[-2], "'0,5' is not a number", comma)
        for text in ('1 kg', '1kg', '1.5e3m'):
            says(refused(2, *words[:-1], words[-1] % text), words[-2], "'%s' is not a number" % text, unit)
    says(refused(2, 'simulate', 'vibro-impact', '--state', 'x1=-0,5,v1=0'), '--state', comma)
    says(refused(2, 'simulate', 'vibro-impact', '--set', 'omega=0.5,restitution=1'), 'one number')
    assert '(' not in refused(2, 'simulate', 'vibro-impact', '--set', 'omega=kg')
    for text, remedy in (('0,5', 'mass: write 0.5, not 0,5'), ('-10,25  # kg', 'mass: write -10.25, not -10,25'), ('1 kg', "'1 kg' is no number: a number has no unit"),
                         ('2 * k', 'in quotes, mass = "2 * k"'), ('max(1, k)', 'in quotes, mass = "max(1, k)"'), ('-k', 'in quotes, mass = "-k"')):
        says(refused(2, 'check', write('u.toml', HEAD + COORDINATE % text)), 'u.toml:4: mass: ', remedy)
    for text, remedy in (('{ value = 0,5, min = 0 }', 'value: write 0.5'), ('{ min = 0, value = 2 * k }', 'value = "2 * k"')):
        says(refused(2, 'check', write('u.toml', HEAD + '[parameters]\nk = %s\n' % text)), 'u.toml:3: value: ', remedy)
    says(refused(2, 'check', write('u.toml', HEAD + 'summary = "a = b, c = 0,5"\n' + COORDINATE % '0,5')), 'u.toml:5: mass: ')
    says(refused(2, 'check', write('q.toml', HEAD + COORDINATE % '"0,5"')), 'q.toml:4: ', 'write 0.5, not 0,5')
    says(refused(2, 'check', write('q.toml', HEAD + COORDINATE % '"1 kg"')), 'q.toml:4: ', '"kg"', 'no unit')


def test_a_model_file_that_cannot_be_read_is_status_4():
    os.mkdir('folder.toml')
    os.mkdir('folder')
    for verb in ('check', 'show', 'simulate', 'classify', 'poincare'):
        says(refused(4, verb, 'nothing.toml'), "'nothing.toml': no such file")
    says(refused(4, 'check', 'no/such/m.toml'), 'no/such/m.toml')
    for folder in ('folder.toml', 'folder', 'folder/', '.', '..'):
        says(refused(4, 'check', folder), repr(folder), 'a folder, not a file')
    says(refused(4, 'diagram', 'nothing.toml', '--sweep', 'a=1:2:3'), 'no such file')
    os.mkfifo('pipe.toml')
    says(refused(4, 'check', 'pipe.toml'), 'not a regular file')
    write('m.txt', HEAD + COORDINATE % 1)
    says(refused(2, 'check', 'm.txt'), "'m.txt'", 'must end in .toml')


def test_a_section_without_points_ends_soon_and_leaves_nothing():
    words = ('poincare', 'vibro-impact', '--set', 'clearance=9')
    with open('out.csv', 'wb') as out:
        refused(3, *words, out=out)
    assert read('out.csv') == ''
    for more in ((), ('--out', 'p.csv'), ('--out', 'p.csv', '--plot', 'p.png')):
        says(refused(3, *words, *more), 'no impacts in 10000 periods', '--state', '--most-periods', '--section stroboscopic')
    says(refused(3, *words, '--most-periods', '20'), 'no impacts in 20 periods')
    says(refused(3, *words, '--most-periods', '30000'), 'no impacts in 30000 periods')
    says(refused(3, 'poincare', 'bouncing-ball', '--transient', '1000'), 'no impacts', 'a shorter --transient')
    endless = Beside(*words, '--most-periods', '1000000000', '--out', 'p.csv')
    assert endless.until(endless.works), endless.err()
    done = endless.signalled(signal.SIGINT)
    assert done.status == 130, (done.status, done.err)
    assert os.listdir('.') == ['out.csv'], os.listdir('.')
    done = run('poincare', 'bouncing-ball', '--transient', '0')  # it comes to rest after some points
    assert done.status == 0 and 3 < done.out.count('\n') < 1000, done.status
    says(done.err, 'only %d impacts' % (done.out.count('\n') - 1))


def test_a_sweep_that_fails_everywhere_leaves_no_table():
    endless = ['omega=1e-5', 'load=10', 'cosine=0', 'restitution=0.999999999']
    words = [word for value in endless for word in ('--set', value)]
    line = refused(3, 'diagram', 'impact-oscillator', *words, '--state', 'x=-0.001', '--sweep', 'damping_ratio=0:1e-9:2', '--transient', '1', '--out', 'd.csv')
    says(line, '2 of 2 values failed, first damping_ratio = 0')
    assert os.listdir('.') == []


def plotted_times(name):
    """Of the picture of `simulate`: the times of the curve of its second panel, the longest line there."""
    columns, rows = table(read(name))
    best = []
    for k in range(len(columns)):
        column = [float(row[k]) for row in rows if row[k] not in ('', 'NaN')]
        if columns[k].startswith('"panel 2 line') and columns[k].endswith(' x"') and len(column) > len(best):
            best = column
    return best


def test_ctrl_c_plots_the_last_periods_that_there_are():
    for omega, periods in (('4.9', '10000000000'), ('1e-4', '3000000')):  # some events per period; a stage of many windows
        endless = Beside('simulate', 'vibro-impact', '--set', 'omega=' + omega, '--periods', periods, '--plot', 'p.png', '--progress')
        assert endless.until(shows_progress(endless)), endless.err()
        done = endless.signalled(signal.SIGINT)
        assert done.status == 130 and all(' left' in line for line in done.err.splitlines()), (done.status, done.err)
        assert done.cpu < 20 * second(), (omega, done.cpu, second())
        end = float(done.out.split('"periods": ')[1].split(',')[0])
        assert os.path.getsize('p.png') > 1000
        times = plotted_times('p-plot.csv')
        base = int(read('p.gp').split('/ T \u2212 ')[1].split("'")[0]) if '/ T \u2212 ' in read('p.gp') else 0
        assert all(b - a > -1e-9 for a, b in zip(times, times[1:])) and times[0] + base >= end - 20.1 and abs(times[-1] + base - end) < 0.1, (omega, end, times[0], times[-1])
        assert len(times) > 400 or end < 20, (omega, len(times))


def test_numbers_may_be_written_as_powers_of_ten_and_expressions():
    assert '"end"' in good('simulate', 'vibro-impact', '--periods', '1e1')
    same = good('simulate', 'vibro-impact', '--set', f'omega={math.pi / 2!r}', '--periods', '10')
    assert good('simulate', 'vibro-impact', '--set', 'omega=pi/2', '--periods', '10') == same
    says(refused(2, 'simulate', 'vibro-impact', '--periods', '1e12'), 'lower --periods')
    says(refused(2, 'simulate', 'vibro-impact', '--set', 'omega=2*friction'), '--set omega', 'not a number')


def test_a_model_in_place_of_a_verb_is_recognised():
    for model in ('vibro-impact', 'mine.toml'):
        says(refused(2, model), f'slapstick simulate {model}')


def test_check_tells_units_and_natural_frequencies():
    told = json.loads(good('check', 'impact-oscillator', '--set', 'damping_ratio=0.25'))
    assert set(told['units']) == {'time', 'x', 'parameters'}
    (mode,) = told['natural_modes']
    assert abs(mode['frequency'] - 1) < 1e-14 and abs(mode['damping_ratio'] - 0.25) < 1e-14


def test_options_that_quick_leaves_no_meaning_are_refused():
    for option in ('--transient', '--most-periods', '--exponent-periods'):
        says(refused(2, 'classify', 'vibro-impact', '--quick', '100', option, '500'), option, '--quick')


def test_certificates_hold_every_law():
    damper = '[[damper]]\nbetween = ["x", "ground"]\ncoefficient = 1\nwithin = [0, 1]\nname = "grease"\n'
    dry = '[[friction]]\nname = "pad"\nbetween = ["x", "ground"]\nstatic = 1\nnormal_force = { constant = 1, x = 1 }\n'
    wall = '[[stop]]\nname = "wall"\nbetween = ["x", "ground"]\nclearance = 9\nrestitution_over_speed = [[1, 0.5], [2, 0.4]]\n'
    rubber = '[[compliant_stop]]\nname = "rubber"\nbetween = ["x", "ground"]\nclearance = 9\nstiffness = 1\ndamping = 1\nlaw = "bounded"\n'
    for part, words in ((damper, ' zones '), (dry, '\nnormal 0 '), (wall, ' 2 0x1p+0 0x1p-1 0x1p+1 '), (rubber, ' 2 rubber\n')):
        good('simulate', write('p.toml', HEAD + COORDINATE % 1 + part), '--periods', '1', '--certify', 'p.txt')
        assert words in read('p.txt'), (words, read('p.txt'))


def test_friction_along_a_rigid_stop_is_refused_with_what_to_write_instead():
    dry = '[[friction]]\nname = "pad"\nbetween = ["x", "ground"]\nstatic = 1\nnormal_force = { stop = "wall" }\n'
    says(refused(2, 'check', write('p.toml', HEAD + COORDINATE % 1 + dry)), "p.toml:9: friction 'pad': normal_force: stop: ", 'constraint force', '[[compliant_stop]]')


def test_check_names_what_can_feed_energy():
    damper = '[[damper]]\nbetween = ["x", "ground"]\ncoefficient = -1\n'
    says(refused(2, 'check', write('p.toml', HEAD + COORDINATE % 1 + damper)), "p.toml:7: damper 1: coefficient = -1 is negative")
    assert '"damper 1"' in good('check', write('p.toml', HEAD + COORDINATE % 1 + damper + 'feeds = true\n'))
    assert '"feeds_energy": []' in good('check', 'vibro-impact')
    two = HEAD + COORDINATE % 1 + (COORDINATE % 1).replace('"x"', '"y"')
    coupled = '[matrix]\n%s = [[1, 2], [2, 1]]\n'  # least eigenvalue -1, no negative number
    ground = '[[%s]]\nbetween = ["%s", "ground"]\n%s = %g\n'
    for key, kind, number, found in (('damping', 'damper', 'coefficient', 'feeds_energy'), ('stiffness', 'spring', 'stiffness', 'falling_forces')):
        def told(each):
            return json.loads(good('check', write('p.toml', two + coupled % key + ''.join(ground % (kind, end, number, each) for end in 'xy'))))
        assert told(0.99)[found] == ['matrix ' + key] and told(1)[found] == [], key
    bent = '[[spring]]\nname = "dome"\nbetween = ["x", "ground"]\ncharacteristic = [[-1, 0], [0, 1], [1, 0]]\n'
    assert json.loads(good('check', write('p.toml', HEAD + COORDINATE % 1 + bent)))['falling_forces'] == ["characteristic 'dome'"]


def test_check_tells_by_how_much_a_laid_law_is_off():
    dry = '[[friction]]\nname = "pad"\nbetween = ["x", "ground"]\nstribeck = { static = 3, kinetic = 1, speed = 0.5, corners = %d }\n%s'
    for corners in (1, 7, 40):
        for load, factor in (('', 1), ('normal_force = { constant = 5 }\n', 5)):
            error = json.loads(good('check', write('p.toml', HEAD + COORDINATE % 1 + dry % (corners, load))))['laid_errors']['pad']
            assert 0.97 < error / (factor * 2 / (1 + math.sqrt(2) * corners) ** 2) < 1.03, (corners, error)
    assert json.loads(good('check', 'vibro-impact'))['laid_errors'] == {}


def test_a_velocity_under_the_name_of_another_coordinate_is_found():
    for key, state in (('v_x', 'v_x=1'), ('vx', 'vx=1')):
        says(refused(2, 'check', write('v.toml', HEAD + COORDINATE % 1 + '[start]\n%s = 1\n' % key)), 'v.toml:6: start:', "did you mean 'v'?")
        says(refused(2, 'simulate', write('w.toml', HEAD + COORDINATE % 1), '--time', '1', '--state', state), '--state', "did you mean 'v'?")


def test_a_unit_that_is_none_is_said_where_it_stands():
    text = HEAD + '[parameters.k]\nvalue = 1\nunit = "furlong"\n' + COORDINATE % '"k"'
    says(refused(2, 'check', write('u.toml', text)), "u.toml:3: parameter 'k': unknown unit 'furlong'")


def test_a_long_line_is_read_and_one_that_is_too_deep_is_not():
    points = ', '.join('[%.17g, %.17g]' % (k + 1 / 3, math.sin(k)) for k in range(100))
    long = HEAD + COORDINATE % 1 + '[[signal]]\nname = "s"\npoints = [%s]\n[[force]]\non = "x"\namplitude = 1\nsignal = "s"\n' % points
    assert max(map(len, long.splitlines())) > 4096
    good('check', write('long.toml', long))
    says(refused(2, 'check', write('deep.toml', HEAD + 'a' + '.a' * 3000 + ' = 1\n')), 'deep.toml:2:', 'dots or brackets in one place')


def test_a_row_that_touches_is_said_to_differ_by_law():
    balls = ''.join('[[coordinate]]\nname = "x%d"\nmass = 1\n' % k for k in range(5))
    stops = ''.join('[[stop]]\nname = "s%d"\nbetween = ["x%d", "x%d"]\nclearance = 0\nrestitution = 1\n' % (k, k, k + 1) for k in range(4))
    left = {'moreau': [-0.6, 0.4, 0.4, 0.4, 0.4], 'sequence': [0, 0, 0, 0, 1]}  # momentum 1 and energy 1/2 in both
    for law, speeds in left.items():
        path = write('cradle.toml', HEAD + 'impact_law = "%s"\n' % law + balls + stops + '[start]\nx0 = -1\nv0 = 1\n')
        found = json.loads(good('check', path))
        assert found['impact_law'] == law and found['struck_together'] == ['s1', 's2', 's3'], found
        says(found['note'], 'sequence', 'moreau', 'cradle')
        end = json.loads(good('simulate', path, '--time', '2'))['end']['state']
        assert all(abs(end['v%d' % k] - speed) < 1e-12 for k, speed in enumerate(speeds)), end
    assert 'struck_together' not in json.loads(good('check', 'vibro-impact'))


def test_a_table_in_a_file_of_another_format_is_refused():
    words = ('continue', 'vibro-impact', '--set', 'omega=2.2', '--orbit', '1-1', '--param', 'omega', '--range', '2:2.4', '--table', '--out')
    for name in ('br.json', 'br.npz', 'br.h5'):
        says(refused(2, *words, name), '--out', name, '--table')
    assert os.listdir('.') == []


main({name: case for name, case in globals().items() if name.startswith('test_')})
