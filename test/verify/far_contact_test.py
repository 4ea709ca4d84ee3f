"""What is far away explains no rounding of what is near: forgeries with a stop, or a belt, that is never reached.

    far_contact_test.py PROGRAM test_NAME [SLAPSTICK]
"""
import math
import sys
import tempfile

import motions
from forgery import certificate_of, proved, refused, unreadable
from motions import CUT, EVENT, line

NEAR, HALF = 0.5, 0.5


def thrown(far, order, gap, cut_at=None):
    """A ball thrown from -1 at speed 1 towards a stop at 1/2, before one at `far`; `gap` by how much the near stop's number is lied about, from
    the start on, or from a cut on. Without a lie all numbers are those of the motion."""
    numbers = [(0, -1, far, 0.0), (0, -1, NEAR, 0.0)]
    lines = motions.head('thrown', [1.0], [('stop', 0, -1, far, HALF, 'far'), ('stop', 0, -1, NEAR, HALF, 'near')],
                         [numbers[k] for k in order])
    lines += [line('start', 0, 0.0, -1.0, 1.0)]
    clock = lambda t: (int(t), t - int(t))
    at = lambda x, lie: [[x - far, x - NEAR + lie][k] for k in order]
    hit, end = 1.5 - gap, 3.0
    n, begin = 0, 0.0
    if cut_at is not None:
        lines += motions.segment(n, clock(0.0), cut_at, ['open', 'open'], at(-1.0, 0.0), [1.0, 1.0], CUT)
        n, begin = 1, cut_at
    lines += motions.segment(n, clock(begin), hit - begin, ['open', 'open'], at(begin - 1.0, gap), [1.0, 1.0], EVENT, ('blow', 1), ('impact', 1, 1.0))
    x = NEAR - gap
    lines += motions.segment(n + 1, clock(hit), end - hit, ['open', 'open'], [[x - far, 0.0][k] for k in order], [-HALF, -HALF], CUT)
    back = HALF * (end - hit)
    return lines + motions.done(n + 2, (3, 0.0), [[x - back - far, -back][k] for k in order], [-HALF, -HALF])


def test_a_far_stop_is_no_hindrance():
    for far in (2.0 ** 10, 2.0 ** 20):
        for order in ((0, 1), (1, 0)):
            proved(thrown(far, order, 0.0))
            proved(thrown(far, order, 0.0, cut_at=0.25))


def test_a_far_stop_explains_no_lie_about_a_near_gap():
    for far, lie in ((1e9, 1e-6), (1e9, 1e-4), (1e12, 1e-3), (1e12, 0.75), (3e14, 0.3), (3e14, 0.03), (3e14, 1e-6), (1e15, 1e-9)):
        for order in ((0, 1), (1, 0)):
            refused(thrown(far, order, lie), 'segment 0, number')
            refused(thrown(far, order, lie, cut_at=0.25), 'segment 1, number')


def test_a_fast_belt_explains_no_lie_about_a_near_velocity():
    # A ball flies on to its stop; a belt of no friction is on its pair.
    for belt, lie in ((1e9, 1e-6), (1e9, 1e-4), (1e10, 1e-3)):
        for order in ((0, 1), (1, 0)):
            numbers = [(0, -1, 0.0, belt), (0, -1, NEAR, 0.0)]
            lines = motions.head('belt', [1.0], [('stop', 0, -1, NEAR, HALF, 'near'), ('friction', 0, -1, belt, 0.0, 0.0, 'belt')],
                                 [numbers[k] for k in order])
            lines += [line('start', 0, 0.0, -1.0, 1.0)]
            state = lambda x, v: ([[x, x - NEAR][k] for k in order], [[v - belt, v][k] for k in order])
            lines += motions.segment(0, (0, 0.0), 0.25, ['open', 'slip-'], *state(-1.0, 1.0), CUT)
            p, u = state(-0.75, 1.0)
            honest = lines + motions.segment(1, (0, 0.25), 0.25, ['open', 'slip-'], p, u, CUT) + motions.done(2, (0, 0.5), *state(-0.5, 1.0))
            if belt == 1e9:
                proved(honest)
            u[order.index(1)] += lie
            end = state(-0.75 + 0.25 * (1.0 + lie), 1.0)
            end[1][order.index(1)] += lie
            end[0][order.index(0)] = -0.5
            refused(lines + motions.segment(1, (0, 0.25), 0.25, ['open', 'slip-'], p, u, CUT) + motions.done(2, (0, 0.5), *end), 'segment 1, number')


def test_a_clock_without_a_period_is_that_of_the_motion():
    # x'' = -rate^2 x in a unit of time that is long beside its motion: 2^-49 of the unit is 2^-29 radians.
    rate = 2.0 ** 20
    lines = motions.head('fast', [1.0], [('spring', 0, -1, rate * rate)], [(0, -1, 0.0, 0.0)]) + [line('start', 0, 0.0, 1.0, 0.0)]
    T = 2.0 ** -20
    at = lambda radians: ([math.cos(radians)], [-rate * math.sin(radians)])

    def run(late):
        return (lines + motions.segment(0, (0, 0.0), T, [], *at(0.0), CUT) + motions.segment(1, (0, T + late), T, [], *at(1.0), CUT) +
                motions.done(2, (0, 2.0 * T + late), *at(2.0)))
    proved(run(0.0))
    refused(run(2.0 ** -49), 'periods from where')


def test_more_frequencies_than_memory_holds_are_refused_in_words():
    forces = [('force', 0, j, 1.0, 0.0) for j in range(1, 5001)]
    lines = motions.head('many', [1.0], forces, [(0, -1, 0.0, 0.0)], omega=1.0) + [line('start', 0, 0.0, 0.0, 0.0)]
    unreadable(lines + motions.segment(0, (0, 0.0), 1.0, [], [0.0], [0.0], CUT) + motions.done(1, (0, 0.5), [0.0], [0.0]),
               'has 10003 numbers', 'takes at most 2000')


def test_the_program_writes_what_is_proved_with_a_far_stop_first():
    for belt, far in (('1e3', '1e3'), ('1e3', '1e9')):
        with tempfile.NamedTemporaryFile('w', suffix='.toml') as file:
            file.write(f'''name = "far"
[[coordinate]]
name = "x"
mass = 1
[[spring]]
between = ["x", "ground"]
stiffness = 1
[[friction]]
name = "belt"
between = ["x", "ground"]
static = 0.25
belt_speed = {belt}
[[stop]]
name = "far"
between = ["x", "ground"]
clearance = {far}
restitution = 0.5
[[stop]]
name = "near"
between = ["x", "ground"]
clearance = 0.3
restitution = 0.5
[start]
x = -1
''')
            file.flush()
            text = certificate_of(file.name, '--time', '10')
        if text is not None:
            proved(text)


if __name__ == '__main__':
    globals()[sys.argv[2]]()
