"""Who writes a certificate chooses the last bit of each state, where segments are cut, and how contacts are numbered: no false motion may come of it.

    last_bit_test.py PROGRAM test_NAME [SLAPSTICK]
"""
import math
import sys

import motions
from forgery import find, forged, proved, proved_but_for, refused, unreadable
from motions import CUT, EVENT, done, head, line, segment

SLOPE = [('force', 0, 0, 0.75, 0.0), ('friction', 0, -1, 0.0, 1.0, 0.25, 'slope')]
CEILING = [('force', 0, 0, -1.0, 0.0), ('stop', 0, -1, 0.0, 0.5, 'ceiling')]
TINY = 2.0 ** -60


def hovering(parts, numbers, start, p, u, bodies=1):
    """Cut each 2^-10, and put back: body 0 never falls, though a force of 1 acts on it."""
    lines = head('hovering', [1.0] * bodies, [('force', 0, 0, 1.0, 0.0)] + parts, numbers) + [line('start', 0, 0.0, *start)]
    states = ['open' for part in parts if part[0] == 'stop']
    for k in range(64):
        lines += segment(k, (0, k / 1024), 1 / 1024, states, p(k / 1024), u, CUT)
    return lines + done(64, (0, 0.0625), p(0.0625), u)


# Choice of the mode.

def test_choice_behind_a_segment_without_duration():
    start = head('rest', [1.0], SLOPE, [(0, -1, 0.0, 0.0)]) + [line('start', 0, 0.0, 0.0, 0.0)]
    slides = segment(1, (0, 0.0), 1.0, ['slip+'], [0.0], [0.0], CUT) + done(2, (1, 0.0), [0.25], [0.5])
    for end in (CUT, EVENT):
        refused(start + segment(0, (0, 0.0), 0.0, ['slip+'], [0.0], [0.0], end) + slides, 'contacts slip or open that could stick or stay closed')
    short = segment(0, (0, 0.0), TINY, ['slip+'], [0.0], [0.0], CUT) + segment(1, (0, TINY), 1.0, ['slip+'], [0.0], [0.0], CUT)
    refused(start + short + done(2, (1, 0.0), [0.25], [0.5]), 'contacts slip or open that could stick or stay closed')
    # A number of several lawful choices is not lost either.
    lines = motions.stack(True)
    again = segment(0, (0, 0.0), 0.0, ['slip+', 'stick'], [0.0, 0.0], [0.0, 0.0], CUT) + segment(1, (0, 0.0), 1.0, ['slip+', 'stick'], [0.0, 0.0], [0.0, 0.0], CUT)
    proved_but_for(lines[:find(lines, 'segment')] + again + done(2, (1, 0.0), [0.25, 0.0], [0.5, 0.0]), '1 choice among lawful modes')


def test_choice_of_a_velocity_that_is_nearly_zero():
    lines = motions.stranded(True)
    i = find(lines, 'segment 1')
    refused(lines[:i] + segment(1, (0, 0.5), 1.0, ['slip+'], [-0.125], [TINY], CUT) + done(2, (1, 0.5), [0.125], [0.5]),
            'contacts slip or open that could stick or stay closed')


def test_choice_of_a_slip_that_begins_at_its_limit():
    """Two contacts bear 0.9 at rest and 0.8 in slip, under a load 1.2 sin t. Slip from 0.8 on begins without acceleration, and is not lawful before 0.9."""
    parts = [('tone', 0, 1.0, 1.2, 0.0), ('friction', 0, -1, 0.0, 0.6, 0.5, 'one'), ('friction', 0, -1, 0.0, 0.3, 0.3, 'other')]
    lines = head('two', [1.0], parts, [(0, -1, 0.0, 0.0)]) + [line('start', 0, 0.0, 0.0, 0.0)]
    def slips_from(load, *states):
        t, end = math.asin(load / 1.2), 0.95
        p = 1.2 * (math.cos(t) * (end - t) - math.sin(end) + math.sin(t)) - 0.4 * (end - t) ** 2
        u = 1.2 * (math.cos(t) - math.cos(end)) - 0.8 * (end - t)
        slip = segment(1, (0, t), end - t, ['slip+', 'slip+'], [0.0], [0.0], CUT)
        return lines + segment(0, (0, 0.0), t, states, [0.0], [0.0], EVENT) + slip + done(2, (0, end), [p], [u])
    proved(slips_from(0.9, 'stick', 'stick'))
    refused(slips_from(0.8, 'slip+', 'stick'), 'contacts slip or open that could stick or stay closed')


def test_chatter_whose_flights_are_no_more_than_rounding():
    """A flight of 2^-20 under a ceiling at 3/2, back from its lowest point: with that gap at zero the body might stay, stuck and closed.
    The floor at -1/2 is the nearer contact, by which the body is numbered."""
    t, numbers = 2.0 ** -21, [(0, -1, 1.5, 0.0), (-1, 0, 0.5, 0.0)]
    parts = [('force', 0, 0, 1.0, 0.0), ('stop', 0, -1, 1.5, 0.5, 'ceiling'), ('stop', -1, 0, 0.5, 0.5, 'floor'), ('friction', 0, -1, 0.0, 0.5, 0.25, 'wall')]
    lines = head('flight', [1.0], parts, numbers) + [line('start', 0, 0.0, 1.5, -1.25 * t)]
    both = lambda x, v: ([x, -x - 2.0], [v, -v])
    lines += segment(0, (0, 0.0), t, ['open', 'open', 'slip-'], *both(0.0, -1.25 * t), EVENT)
    lines += segment(1, (0, t), t / 2, ['open', 'open', 'slip+'], *both(-0.625 * t * t, 0.0), CUT)
    proved_but_for(lines + done(2, (0, 1.5 * t), *both(-0.53125 * t * t, 0.375 * t)), '1 choice among lawful modes')


# Touches and impacts.

def test_touch_at_a_cut():
    touching = motions.touching()
    proved_but_for([text.replace('end event', 'end cut') for text in touching], '1 undecided sign')
    i = find(touching, 'segment 1')
    nothing = segment(1, (1, 0.0), 0.0, ['open'], [0.0], [0.0], EVENT) + segment(2, (1, 0.0), 1.0, ['open'], [0.0], [0.0], CUT)
    refused(touching[:i] + nothing + done(3, (2, 0.0), [-0.5], [-1.0]), 'an event that lasts no time has changed nothing')


def test_impact_that_is_hidden_in_rounding():
    """The gap dips to -2^-42: an impact with w = 6.7e-7. It ends the segment at the bottom, and is put to zero there."""
    u = math.sqrt(1.0 + 2.0 ** -41)
    lines = head('graze', [1.0], CEILING, [(0, -1, 0.0, 0.0)]) + [line('start', 0, 0.0, -0.5, u)]
    for end in (CUT, EVENT):
        proved_but_for(lines + segment(0, (0, 0.0), 1.0, ['open'], [-0.5], [u], end) + segment(1, (1, 0.0), 1.0, ['open'], [0.0], [0.0], CUT)
                       + done(2, (2, 0.0), [-0.5], [-1.0]), '1 undecided sign')


def test_impacts_that_are_made_up():
    lines = motions.cradle()
    i = find(lines, 'impact')
    for w in (0.0, -0.25):
        refused(lines[:i + 1] + [line('impact', 1, w)] + lines[i + 1:], 'wall')
    # A stop that moves apart transmits the impulse; it has no impact.
    parts = [('stop', 0, 1, 0.0, 1.0, 'bodies'), ('stop', 1, -1, 0.0, 1.0, 'wall')]
    apart = head('apart', [1.0, 1.0], parts, [(0, 1, 0.0, 0.0), (1, -1, 0.0, 0.0)]) + [line('start', 0, 0.0, 0.0, 1.0, 0.0, -0.25)]
    blows = [('blow', 0, 1), ('impact', 0, 1.25), ('impact', 1, -0.25), ('blow', 1), ('impact', 1, 0.25)]
    apart += segment(0, (0, 0.0), 0.0, ['open', 'open'], [0.0, 0.0], [1.25, -0.25], EVENT, *blows)
    apart += segment(1, (0, 0.0), 1.0, ['open', 'open'], [0.0, 0.0], [-0.75, -0.25], CUT) + done(2, (1, 0.0), [-0.75, -0.25], [-0.75, -0.25])
    refused(apart, 'an impact at wall that does not approach')
    proved(apart[:find(apart, 'impact 1')] + apart[find(apart, 'impact 1') + 1:])


def test_events_that_are_made_up():
    lines = motions.dead_ball()
    i = find(lines, 'segment 1')
    forged_lines = lines[:i]
    for k in range(5):
        forged_lines += segment(1 + k, (1, 0.0), 0.0, ['open'], [0.0], [0.0], EVENT)
    forged_lines += segment(6, (1, 0.0), 2.0, ['closed'], [0.0], [0.0], CUT) + done(7, (3, 0.0), [0.0], [0.0])
    refused(forged_lines, 'an event that lasts no time has changed nothing')
    # One that changes the mode says nothing false, and is none.
    once = lines[:i] + segment(1, (1, 0.0), 0.0, ['open'], [0.0], [0.0], EVENT) + segment(2, (1, 0.0), 2.0, ['closed'], [0.0], [0.0], CUT)
    assert 'events           1, 1 impacts' in proved(once + done(3, (3, 0.0), [0.0], [0.0]))


def test_stop_that_is_put_off_its_gap():
    """Masses 1 and 4 at a closed wall: by Moreau's law both stops are struck. Struck one by one the velocities are others."""
    parts = [('stop', 0, 1, 0.0, 1.0, 'bodies'), ('stop', 1, -1, 0.0, 1.0, 'upper'), ('stop', -1, 1, 4.0, 1.0, 'lower')]
    lines = head('wall', [1.0, 4.0], parts, [(0, 1, 0.0, 0.0), (1, -1, 0.0, 0.0), (-1, 1, 4.0, 0.0)]) + [line('start', 0, 0.0, -1.0, 1.0, 0.0, 0.0)]
    states = ['open', 'closed', 'open']
    before = ([-1.0, 0.0, -4.0], [1.0, 0.0, 0.0])
    proved(lines + segment(0, (0, 0.0), 1.0, states, *before, EVENT, ('blow', 0, 1), ('impact', 0, 1.0))
           + segment(1, (1, 0.0), 1.0, states, [0.0, 0.0, -4.0], [-1.0, 0.0, 0.0], CUT) + done(2, (2, 0.0), [-1.0, 0.0, -4.0], [-1.0, 0.0, 0.0]))
    a, b = -3.0 / 5.0, 2.0 / 5.0
    lines += segment(0, (0, 0.0), 1.0, states, *before, EVENT, ('blow', 0), ('impact', 0, 1.0))
    lines += segment(1, (1, 0.0), TINY / b, ['open'] * 3, [0.0, -TINY, -4.0], [a - b, b, -b], EVENT, ('blow', 1), ('impact', 1, b))
    lines += segment(2, (1, 0.0), 1.0, ['open'] * 3, [0.0, 0.0, -4.0], [a + b, -b, b], CUT)
    refused(lines + done(3, (2, 0.0), [a + b, -b, b - 4.0], [a + b, -b, b]), 'stop upper was closed, and does not touch in the state that follows')


def test_pile_up_of_a_stop_that_nothing_has_struck():
    parts = [('stop', 0, -1, 0.0, 0.5, 'a'), ('stop', 1, -1, 0.0, 0.5, 'b')]
    fast, slow = 2.0 ** 20, 0.75
    lines = head('two', [1.0, 1.0], parts, [(0, -1, 0.0, 0.0), (1, -1, 0.0, 0.0)], law='sequence') + [line('start', 0, 0.0, -fast, fast, -slow, slow)]
    lines += segment(0, (0, 0.0), 1.0, ['open', 'open'], [-fast, -slow], [fast, slow], EVENT, ('blow', 0), ('pile-up', 1), ('impact', 0, fast))
    lines += segment(1, (1, 0.0), 1.0, ['open', 'closed'], [0.0, 0.0], [-fast / 2, 0.0], CUT)
    refused(lines + done(2, (2, 0.0), [-fast / 2, 0.0], [-fast / 2, 0.0]), 'stop b comes to rest, and no impact of the instant was at it or acts on it')


# Clock and numbers.

def test_clock_that_creeps():
    lines = head('clock', [1.0], [('force', 0, 1, 1.0, 0.0)], [(0, -1, 0.0, 0.0)], omega=1.0) + [line('start', 0, 0.0, 0.0, 0.0)]
    for k in range(50):
        lines += segment(k, (0, k * 2.0 ** -48), 0.0, [], [0.0], [0.0], CUT)
    refused(lines + done(50, (0, 50 * 2.0 ** -48), [0.0], [0.0]), 'the clock has moved in a segment that lasts no time')


def test_numbers_that_nothing_needs():
    floor = ('stop', 0, -1, 0.0, 0.5, 'floor')
    big = 2.0 ** 30
    unreadable(hovering([floor], [(0, -1, big, big), (0, -1, 0.0, 0.0)], (-0.5, 0.0), lambda t: [-big - 0.5, -0.5], [-big, 0.0]),
               'no contact and no coordinate has the number of 0 -1')
    far = 2.0 ** 44
    unreadable(hovering([], [(0, 1, 0.0, 0.0), (1, -1, 0.0, 0.0)], (0.0, 0.0, far, far), lambda t: [-far * (1 + t), far * (1 + t)], [-far, far], 2),
               'no contact and no coordinate has the number of 0 1')


def test_numbers_of_contacts_that_are_never_reached():
    """A clearance of 2^30, and a belt of that speed, would let rounding in their numbers explain whatever the coordinate does."""
    big = 2.0 ** 30
    parts = [('stop', 0, -1, big, 0.5, 'far'), ('friction', 0, -1, big, 0.0, 0.0, 'belt')]
    lines = hovering(parts, [(0, -1, big, 0.0), (0, -1, 0.0, big)], (-0.5, 0.0), lambda t: [-big - 0.5, -0.5], [0.0, -big])
    lines = [text.replace(' open', ' open slip-') if text.startswith('segment') else text for text in lines]
    refused(lines, 'segment 1, number 2 of the state is', 'from where it must be')  # the far stop's, which the belt does not drive


def test_coordinate_that_rounding_alone_moves():
    """A body rests at zero, where its contact number is -1/2: of its last bit nothing is said, and the verdict tells."""
    lines = head('still', [1.0], [('spring', 0, -1, 1.0), ('stop', 0, -1, 0.5, 0.5, 'far')], [(0, -1, 0.5, 0.0)]) + [line('start', 0, 0.0, 0.0, 0.0)]
    lines += segment(0, (0, 0.0), 1.0, ['open'], [-0.5], [0.0], CUT)
    for off, what in ((0.0, None), (2.0 ** -54, '1 coordinate moved by rounding alone'), (2.0 ** -36, 'from where it must be')):
        p, u = -0.5 + off * math.cos(1.0), -off * math.sin(1.0)
        moved = lines + segment(1, (1, 0.0), 1.0, ['open'], [-0.5 + off], [0.0], CUT) + done(2, (2, 0.0), [p], [u])
        if off == 0.0:
            proved(moved)
        elif off < 2.0 ** -40:
            proved_but_for(moved, what)
        else:
            refused(moved, what)


def test_coordinate_beside_a_far_stop():
    """A body stands at -1/2, its contact number at -1024.5: the rounding of that number is counted, four times as much is refused."""
    lines = head('far', [1.0], [('stop', 0, -1, 1024.0, 0.5, 'far')], [(0, -1, 1024.0, 0.0)]) + [line('start', 0, 0.0, -0.5, 0.0)]
    lines += segment(0, (0, 0.0), 1.0, ['open'], [-1024.5], [0.0], CUT)
    moved = lambda off: lines + segment(1, (1, 0.0), 1.0, ['open'], [-1024.5 + off], [0.0], CUT) + done(2, (2, 0.0), [-1024.5 + off], [0.0])
    proved(moved(2.0 ** -42))
    proved_but_for(moved(2.0 ** -40), '1 coordinate moved by rounding alone')
    refused(moved(2.0 ** -38), 'coordinate 0 jumps by')


def test_allowances_of_a_body_that_is_not_coupled():
    """A far body with two numbers of its own explains nothing about another that has two."""
    far = 2.0 ** 44
    parts = [('stop', 0, -1, 0.0, 0.5, 'floor'), ('stop', -1, 0, 4.0, 0.5, 'ceiling'), ('stop', 1, -1, 2.0 * far, 0.5, 'far')]
    numbers = [(0, -1, 0.0, 0.0), (1, -1, 2.0 * far, 0.0), (-1, 0, 4.0, 0.0), (1, -1, 0.0, 0.0)]
    at = lambda t: [-0.5, far * (t - 1.0), -3.5, far * (1.0 + t)]
    refused(hovering(parts, numbers, (-0.5, 0.0, far, far), at, [0.0, far, -0.0, far], 2), 'number 0 of the state is', 'from where it must be')


def test_start_that_is_displaced_beside_a_far_body():
    far = 2.0 ** 46
    lines = head('two', [1.0, 1.0], [], [(0, -1, 0.0, 0.0), (1, -1, 0.0, 0.0)]) + [line('start', 0, 0.0, 0.0, 0.0, far, 0.0)]
    refused(lines + segment(0, (0, 0.0), 1.0, [], [0.25, far], [0.0, 0.0], CUT) + done(1, (1, 0.0), [0.25, far], [0.0, 0.0]),
            'segment 0, number 0 of the state is')


def test_end_whose_numbers_contradict_each_other():
    parts = [('stop', 0, -1, 0.0, 0.5, 'floor'), ('stop', -1, 0, 4.0, 0.5, 'ceiling')]
    lines = head('between', [1.0], parts, [(0, -1, 0.0, 0.0), (-1, 0, 4.0, 0.0)]) + [line('start', 0, 0.0, -1.0, -0.25)]
    lines += segment(0, (0, 0.0), 1.0, ['open', 'open'], [-1.0, -3.0], [-0.25, 0.25], CUT)
    proved(lines + done(1, (1, 0.0), [-1.25, -2.75], [-0.25, 0.25]))
    refused(lines + done(1, (1, 0.0), [-1.25, -2.75 - 2.0 ** -30], [-0.25, 0.25]), 'from what it follows from')


def test_name_that_writes_on_the_terminal():
    unreadable([text.replace('model ball', 'model \x1b[2Jball') for text in motions.ball()], 'characters that are not printable')
    unreadable([text.replace('floor', 'fl\x7foor') for text in motions.ball()], 'characters that are not printable')
    assert forged(motions.ball(), 'model', {1: 'b'})[1] == 'model b'


if __name__ == '__main__':
    globals()[sys.argv[2]]()
