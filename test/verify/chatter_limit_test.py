"""The limit of a complete chatter is proved where it is one, and refused wherever one of its conditions is forged (docs/developers/proofs.md, section 8).

    chatter_limit_test.py PROGRAM test_NAME [SLAPSTICK]
"""
import os
import sys

import motions
from forgery import certificate_of, find, forged, proved, refused, value, without
from motions import CUT, EVENT, line


def neighbour(gap=64.0, far=0.0):
    """The ball of `chatter` on a body of mass 1 that is pushed by 1/2 and has a wall at a distance: impacts of the ball shake it."""
    parts = [('force', 0, 0, 1.0, 0.0), ('force', 1, 0, far, 0.0), ('stop', 0, 1, 0.0, 0.5, 'floor'), ('stop', 1, -1, gap, 0.5, 'wall')]
    lines = motions.head('neighbour', [1.0, 1.0], parts, [(0, 1, 0.0, 0.0), (1, -1, gap, 0.0)])
    lines += [line('start', 0, 0.0, -0.5, 0.0, 0.0, 0.0)]
    # x1 - x2 grows from -1/2 under 1: one unit; u = 1 and -1/2, shared by the masses; then flights of 1/2 v (1 + 1) = v: two units.
    lines += motions.segment(0, (0, 0.0), 1.0, ['open', 'open'], [-0.5, -gap], [0.0, 0.0], EVENT, ('blow', 0), ('impact', 0, 1.0), ('chatter', 0))
    lines += motions.segment(1, (1, 0.0), 2.0, ['closed', 'open'], [0.0, -gap], [0.0, 0.5], ('end', 'chatter', 0))
    lines += motions.segment(2, (3, 0.0), 1.0, ['closed', 'open'], [0.0, 2.0 - gap], [0.0, 1.5], CUT)
    return lines + motions.done(3, (4, 0.0), [0.0, 3.75 - gap], [0.0, 2.0])


def test_chatter_without_what_must_be_there():
    lines = motions.chatter()
    refused(without(lines, 'chatter 0'), 'the segment before has not brought stop floor to rest')
    refused([text.replace('end chatter 0', 'end cut') for text in lines], 'brought to rest by a chatter that nothing proves')
    refused(forged(lines, 'segment', {5: 'open'}, 1), 'stop floor is not at rest at the limit of its chatter')
    refused(forged(lines, 'state', {1: -2.0 ** -60}, 1), 'stop floor is not at rest')


def test_chatter_limit_that_comes_at_another_time():
    for motion in (motions.chatter, motions.rubbing):
        lines = motion()
        n = find(lines, 'segment 1')
        for longer in (2.0 ** -45, -2.0 ** -45, 0.5):
            moved = forged(lines, 'segment 1', {4: value(lines, 'segment 1', 4) + longer})
            refused(moved, 'the limit is between', 'further than 2^-49 periods from DURATION')
        assert n > 0


def test_chatter_with_another_restitution():
    for motion in (motions.chatter, motions.rubbing):
        refused(forged(motion(), 'stop', {4: 0.5 + 2.0 ** -40}), 'the limit is between')
        refused(forged(motion(), 'stop', {4: 0.0}), 'the pair does not leave the stop')
    refused(forged(motions.chatter(), 'stop', {4: 1.0}), 'the impacts may get no slower: their ratio is up to 1')


def test_chatter_that_reaches_another_stop():
    proved(neighbour())
    refused(neighbour(1.0), 'stop wall may be reached or left before the limit')


def test_chatter_that_shakes_what_it_lies_on():
    # A spring under the floor: what the impacts do to it is more than rounding, and the state at the limit is not known.
    lines = neighbour()
    i = find(lines, 'force')
    refused(lines[:i] + [line('spring', 1, -1, 2.0 ** -20)] + lines[i:], 'of the state at the limit is known to')
    # So stiff that nothing bounds the state for so long.
    refused(lines[:i] + [line('spring', 1, -1, 1024.0)] + lines[i:], 'no box is found')


def test_chatter_of_two_balls_from_one_instant_on():
    proved(motions.two_balls())
    proved(motions.two_balls(slower=0.5))
    proved(motions.two_balls(2.0 ** -60))  # what one does to the other is less than rounding
    lines = motions.two_balls()
    refused(forged(lines, 'stop 1', {4: 0.75}), 'the limit is between', 'further than 2^-49 periods from DURATION')
    refused([text.replace('end chatter 0 1', 'end chatter 0') for text in lines], 'brought to rest by a chatter that nothing proves')
    refused(motions.two_balls(1.0), 'no box is found')


def test_chatter_that_friction_stops_in_the_air():
    refused(motions.rubbing(2.5), 'friction may hold the pair off the stop')
    refused(motions.rubbing(3.0), 'friction may hold the pair off the stop')
    proved(motions.rubbing(2.25))


# Complete chatter: of friction and stop on one pair, without friction, beside a block on a belt and a second stop.
HAMMER = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'hammer.toml')
CHATTER = ((['vibro-impact', '--set', 'omega=0.552', '--periods', '8'], 5), (['bouncing-ball', '--periods', '20'], 1), ([HAMMER, '--periods', '4'], 1))


def test_chatter_limits_of_the_engine():
    for words, limits in CHATTER:
        text = certificate_of(*words)
        if text is None:
            return
        assert f'chatter limits   {limits}, ' in proved(text), proved(text)
        lines = text.decode().splitlines()
        n = find(lines, 'chatter')
        for factor in (1.0 + 2.0 ** -10, 0.5):
            moved = lines[:n] + forged(lines[n:], 'segment', {4: factor * value(lines[n:], 'segment', 4)})
            refused(moved, 'further than 2^-49 periods')
        stop = {4: 0.75 * value(lines, 'stop', 4)}
        refused(forged(lines, 'stop', stop), 'segment')


if __name__ == '__main__':
    globals()[sys.argv[2]]()
