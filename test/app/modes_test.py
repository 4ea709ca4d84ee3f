"""modes: natural frequencies with contacts held. One CTest case per function `test_...`."""
import math
import os

from program import good, main, refused, run, says, table

ROW = """name = 'row'
[parameters]
k = 6
[[coordinate]]
name = 'a'
mass = 1
[[coordinate]]
name = 'b'
mass = 2
[[spring]]
between = ['a', 'ground']
stiffness = 'k'
[[spring]]
between = ['b', 'a']
stiffness = 4
[[friction]]
name = 'pad'
between = ['b', 'a']
static = 1
[[stop]]
name = 'wall'
between = ['a', 'ground']
clearance = 1
restitution = 1
"""
COLUMNS = ['mode', 'frequency', 'damping_ratio', 'decay', 'cycles', 'a', 'a:phase', 'b', 'b:phase']


def row_modes(*words):
    with open('row.toml', 'w', encoding='utf-8') as file:
        file.write(ROW)
    columns, rows = table(good('modes', 'row.toml', *words))
    return columns, [[float(word) for word in row] for row in rows]


def test_modes_of_held_contacts_are_those_of_what_is_left():
    columns, (first, second) = row_modes()
    assert columns == COLUMNS
    # det (K - w^2 M) = 2 w^4 - 24 w^2 + 24
    for row, square in ((first, 6 - math.sqrt(24)), (second, 6 + math.sqrt(24))):
        assert abs(row[1] - math.sqrt(square)) < 1e-14 and abs(row[4] - math.sqrt(square) / (2 * math.pi)) < 1e-14
        assert row[3] == 0 and max(row[5], row[7]) == 1
    (stuck,) = row_modes('--stuck', 'pad')[1]
    assert abs(stuck[1] - math.sqrt(2)) < 1e-14 and abs(stuck[5] - stuck[7]) < 1e-15
    (closed,) = row_modes('--closed', 'wall')[1]
    assert abs(closed[1] - math.sqrt(2)) < 1e-14 and closed[5] == 0 and closed[7] == 1


def test_modes_over_a_parameter_are_those_of_each_value():
    columns, rows = row_modes('--sweep', 'k=1:9:5')
    assert columns == ['k', *COLUMNS] and len(rows) == 10
    for k in (1, 3, 5, 7, 9):
        assert [row[1:] for row in rows if row[0] == k] == row_modes('--set', 'k=%d' % k)[1]
    good('modes', 'row.toml', '--sweep', 'k=1:9:5', '--out', 'modes.csv', '--plot', 'modes.png')
    assert os.path.exists('modes.png') and os.path.exists('modes.gp')


SQUEAL = """name = 'pad'
omega = 1
[parameters]
mu = 0.3
[[coordinate]]
name = 'x'
mass = 1
[[coordinate]]
name = 'y'
mass = 1
[[spring]]
between = ['x', 'ground']
stiffness = 1
[[compliant_stop]]
name = 'disc'
between = ['y', 'ground']
clearance = 0
stiffness = 2
[[friction]]
name = 'shoe'
between = ['x', 'ground']
static = 'mu'
belt_speed = -1
normal_force = { compliant_stop = 'disc' }
[[force]]
on = 'y'
amplitude = 1
harmonic = 0
"""


def test_modes_say_that_friction_without_its_normal_force_does_nothing():
    with open('squeal.toml', 'w', encoding='utf-8') as file:
        file.write(SQUEAL)
    outcome = run('modes', 'squeal.toml')
    assert outcome.status == 0
    says(outcome.err, "friction 'shoe' has no normal force, and does nothing: --closed disc makes it press")
    good('modes', 'squeal.toml', '--closed', 'disc')


def test_modes_say_that_nothing_can_move():
    row_modes()
    outcome = run('modes', 'row.toml', '--closed', 'wall', '--stuck', 'pad')
    assert outcome.status == 0 and table(outcome.out)[1] == []
    says(outcome.err, 'nothing can move')


def test_modes_name_the_value_of_a_sweep_that_the_model_refuses():
    with open('mass.toml', 'w', encoding='utf-8') as file:
        file.write(ROW.replace('mass = 2', "mass = 'k'"))
    says(refused(2, 'modes', 'mass.toml', '--sweep', 'k=-1:1:3'), '--sweep k=-1', 'mass')


def test_modes_refuse_what_they_cannot_be():
    row_modes()
    says(refused(2, 'modes', 'row.toml', '--stuck', 'wall'), '--stuck', "no friction contact 'wall'", 'the model has pad')
    says(refused(2, 'modes', 'row.toml', '--closed', 'wall,pad'), '--closed', "no stop 'pad'", 'the model has wall')
    says(refused(2, 'modes', 'row.toml', '--plot', 'm.png'), '--plot', '--sweep')
    says(refused(2, 'modes', 'row.toml', '--sweep', 'k=1:9:5', '--set', 'k=2'), '--sweep', "'k'", '--set')
    says(refused(2, 'modes', 'row.toml', '--sweep', 'q=1:9:5'), "'q'")


main(globals())
