"""slapstick basins: each start is what the other verbs say of it; its store, its numbers, its refusals."""
import json
import os
import re
import signal

from beside import Beside, second
from program import good, main, read, refused, says, table

PAPER = ('basins', 'vibro-impact', '--set', 'omega=2.82', '--x', 'x1=-0.6:0.1:15', '--y', 'v1=-1.2:1.2:13')


def basins(*words):
    return json.loads(good(*words))


def test_a_chart_over_parameters_of_the_start_has_the_same_classes():
    found = basins(*PAPER, '--table', 'a.csv')
    columns, rows = table(read('a.csv'))
    assert columns == ['x', 'y', 'basin', 'class'] and len(rows) == 15 * 13 == found['starts']
    with open('m.toml', 'w') as file:
        file.write(good('show', 'vibro-impact', '--set', 'omega=2.82').split('[start]')[0])
        file.write('[parameters.px]\nvalue = 0\n[parameters.pv]\nvalue = 0\n[start]\nx1 = "px"\nv1 = "pv"\n')
    chart = table(good('map', 'm.toml', '--x', 'px=-0.6:0:13', '--y', 'pv=-1.2:1.2:13'))[1]
    other = {(row[0], row[1]): row[2] for row in chart}
    same = [row for row in rows if (row[0], row[1]) in other]
    assert len(same) >= 13 * 6, len(same)  # the two grids have most of their numbers in common to the last bit
    for row in same:
        assert row[3] == other[row[0], row[1]], row
    for row in rows:
        assert (row[3] == 'not-admissible') == (float(row[0]) > 0), row


def test_the_state_of_a_basin_is_on_its_attractor():
    found = basins(*PAPER)
    for basin in found['basins']:
        start = ','.join('%s=%.17g' % pair for pair in basin['state'].items())
        alone = json.loads(good('classify', 'vibro-impact', '--set', 'omega=2.82', '--state', start, '--transient', '0'))
        assert alone['class'] == basin['class'] and alone['attractor'] == basin['attractor']
        assert abs(alone['exponent'] - basin['exponent']) < 1e-8
    assert sum(basin['starts'] for basin in found['basins']) + found['undecided'] + found['not_admissible'] == found['starts']
    assert abs(sum(basin['share'] for basin in found['basins']) - 1) < 1e-12 or found['undecided'] > 0


def test_the_same_bytes_for_any_number_of_threads_and_from_a_store():
    one = good(*PAPER, '--threads', '1', '--table', 'a.csv')
    assert one == good(*PAPER, '--threads', '3', '--table', 'b.csv', '--store', 'a.db')
    assert one == good(*PAPER, '--store', 'a.db', '--resume', '--table', 'c.csv')
    assert read('a.csv') == read('b.csv') == read('c.csv')
    assert json.loads(good('store', 'info', 'a.db'))['done'] == 15 * 13
    says(refused(2, *PAPER, '--store', 'a.db'), '--store', '--resume')
    says(refused(2, *PAPER, '--periods', '50', '--store', 'a.db', '--resume'), '--store', 'another run')
    says(refused(2, 'store', 'export', 'a.db', '--out', 'd.csv'), "'basins'")


def test_the_picture_has_the_shares():
    found = basins(*PAPER, '--plot', 'a.png')
    assert os.path.getsize('a.png') > 5000
    for basin in found['basins']:
        says(read('a.gp'), '%s  %.0f %%' % (basin['name'], 100 * basin['share']))
    says(read('a.gp'), 'not admissible', 'initial')


WALLS = '''name = "walls"
omega = 1.9
[[coordinate]]
name = "x"
mass = 1
[[spring]]
between = ["x", "ground"]
stiffness = 1
[[damper]]
between = ["x", "ground"]
coefficient = 0.1
[[force]]
on = "x"
amplitude = 3.2
[[stop]]
name = "wall"
between = ["x", "ground"]
clearance = 1
restitution = 0.7
two_sided = true
'''


def test_cycles_of_one_class_that_are_mirror_images_are_two():
    with open('walls.toml', 'w') as file:
        file.write(WALLS)
    found = basins('basins', 'walls.toml', '--x', 'x=-0.9:0.9:6', '--y', 'v=-3:3:6', '--table', 'a.csv')
    names = [basin['name'] for basin in found['basins']]
    assert names == ['1-2-I (1)', '1-2-I (2)']


def test_the_own_start_may_be_behind_the_stop_where_the_axes_have_others():
    found = basins('basins', 'impact-oscillator', '--set', 'clearance=-0.5', '--set', 'omega=1', '--x', 'x=-2:-1:3', '--y', 'v=0:1:3')
    assert found['not_admissible'] == 0 and found['starts'] == 9


def test_bad_input_is_named():
    before = os.listdir('.')
    says(refused(2, *PAPER[:4], '--y', 'v1=0:1:3'), '--x', 'required')
    says(refused(2, *PAPER[:6], '--y', 'w1=0:1:3'), "--y: 'w1'", 'x1, v1, x2, v2')
    says(refused(2, *PAPER[:6], '--y', 'x1=0:1:3'), "--y: 'x1'", 'axis')
    says(refused(2, *PAPER[:6], '--y', 'omega=1:2:3'), "--y: 'omega'", 'a map')
    says(refused(2, *PAPER[:6], '--y', 'v1=1:0:3'), '--y', 'below')
    says(refused(2, *PAPER[:6], '--y', 'v1=0:1:10000000'), '--x and --y', '1e8')
    says(refused(2, *PAPER, '--transient', '7'), '--transient', '--level full')
    says(refused(2, *PAPER, '--resume'), '--resume', '--store')
    says(refused(2, *PAPER, '--table', 'a.mat'), 'a.mat')
    says(refused(2, *PAPER, '--stop', 'none'), '--stop')
    says(refused(2, *PAPER[:4], '--x', 'x1=0.1:0.2:3', '--y', 'v1=0:1:3'), 'stops forbid every start')
    assert os.listdir('.') == before


def test_a_signal_ends_it_with_what_is_complete():
    endless = Beside('basins', 'vibro-impact', '--x', 'x1=-0.6:0:2000', '--y', 'v1=-1:1:2000', '--threads', '2', '--store', 'a.db', '--out', 'a.json', '--progress')
    assert endless.until(lambda: any(int(told) > 100 for told in re.findall('([0-9]+)/4000000 starts', endless.err()))), endless.err()
    done = endless.signalled(signal.SIGINT)
    assert done.status == 130, (done.status, done.err)
    assert done.cpu < 2 * 2 * second(), (done.cpu, second())
    says(done.err, 'stopped after')
    found = json.loads(read('a.json'))
    assert found['starts'] - found['not_computed'] > 100
    assert json.loads(good('store', 'info', 'a.db'))['done'] == found['starts'] - found['not_computed']


if __name__ == '__main__':
    main(globals())
