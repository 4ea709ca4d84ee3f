"""The limit of a complete chatter is proved where it is one, and refused wherever one of its conditions is forged (docs/certainty.md, section 8).

    chatter_limit_test.py PROGRAM test_NAME [SLAPSTICK]
"""
import os
import sys

import motions
from forgery import certificate_of, find, forged, proved, refused, unreadable, value, without
from motions import line


def test_chatter_without_what_must_be_there():
    lines = motions.chatter()
    refused(without(lines, 'blow 1'), 'the segment before has not brought stop floor to rest')
    refused(forged(lines, 'end chatter', {3: 1e-9}), 'ERROR = 1.0000000000000001e-09 is more than 2^-49 periods')
    falling = forged(lines, 'segment', {2: 0}, 1)
    refused(falling, 'stop floor is not at rest in the segment that stands for its chatter')
    refused(forged(lines, 'state', {1: -2.0 ** -60}, 1), 'stop floor is not at rest')
    unreadable(without(lines, 'tail'), '`tail` and `end chatter` belong together')
    i = find(lines, 'tail')
    unreadable(lines[:i] + [lines[i], 'end cut'] + lines[i + 2:], '`tail` and `end chatter` belong together')
    for k in (1, 2, 3):
        unreadable(forged(lines, 'tail', {k: 9}), 'mode 9 is not there')


def test_chatter_limit_that_comes_later_than_claimed():
    for motion in (motions.chatter, motions.rubbing, motions.neighbour):
        lines = motion()
        D = value(lines, 'tail', 4)
        refused(forged(lines, 'tail', {4: D * (1.0 - 2.0 ** -53)}), 'all flights together last up to', 'more than D')
        proved(forged(lines, 'tail', {4: D * 1.5}))
        n = find(lines, 'segment 1')
        for longer in (2.0 ** -50, -2.0 ** -50):
            moved = forged(lines[n:], 'segment 1', {5: D + longer})
            refused(lines[:n] + moved, 'the limit is between', 'further than ERROR')


def test_chatter_whose_accelerations_are_others():
    lines = motions.rubbing()
    for k in (5, 6, 7, 8):
        a = value(lines, 'tail', k)
        wrong = a * (1.0 + 2.0 ** -52) if k % 2 == 1 else a * (1.0 - 2.0 ** -52)
        refused(forged(lines, 'tail', {k: wrong}), 'the acceleration on the way', 'is claimed to be in')
    refused(forged(lines, 'tail', {7: 0.0}), 'an acceleration is not positive')
    # Bounds that are true and too far apart: neither the ratio nor the limit follows from them.
    refused(forged(lines, 'tail', {8: 16.0}), 'the impacts may get no slower: their ratio is up to 1')
    refused(forged(lines, 'tail', {5: 3.9375}), 'further than ERROR')


def test_chatter_with_another_restitution():
    for motion in (motions.chatter, motions.rubbing):
        refused(forged(motion(), 'stop', {4: 0.5 + 2.0 ** -40}), 'the limit is between')
        refused(forged(motion(), 'stop', {4: 0.0}), 'the pair does not leave stop floor')
    refused(forged(motions.chatter(), 'stop', {4: 1.0}), 'the impacts may get no slower: their ratio is up to 1')


def test_chatter_that_reaches_another_guard():
    for gap in (0.5, 4.0):
        refused(motions.neighbour(gap), 'stop wall may be reached or left before the limit')
    refused(motions.neighbour(4.0), 'guard 1 (gap) of the way away from stop floor: it may come to zero')
    # A contact elsewhere that slips at first, and is shaken.
    lines = motions.neighbour()
    i = find(lines, 'guard 1')
    slip = lambda u: lines[:i + 1] + [line('guard', 2, 'slip', 2, 3, -1.0, 4, u)] + lines[i + 1:]
    refused(slip(0.0), 'guard 2 (slip) of the way away from stop floor: it may come to zero, it is 0.5')
    refused(slip(64.0), 'guard 2 (slip): neither `prove` nor `rest`')  # only what is not of the chatter is missing


def test_chatter_that_friction_stops_in_the_air():
    lines = motions.rubbing()
    held = find(lines, 'guard 0 stick')
    for force in (1.0, 0.0):
        stuck = lines[:held] + [line('guard', 0, 'stick', 1, 2, force)] + lines[held + 1:]
        refused(stuck, 'friction may hold the pair off stop floor')
    refused(forged(lines, 'tail', {3: 1}), 'in the mode that would hold the pair off the stop it is not held')
    # Friction for one direction both ways
    refused(forged(lines, 'tail', {1: 0}), 'guard 1 (slip) of the way away from stop floor: it is for the other direction')
    refused(forged(lines, 'tail', {2: 1}), 'guard 0 (slip) of the way back to stop floor: it is for the other direction')
    refused(without(lines, 'guard 0 slip'), 'a mode of the tail is for both directions')


def test_chatter_that_leaves_the_state_elsewhere():
    # On the closed stop the second body is pulled at 1/2. Another pull is another state at the limit.
    lines = motions.neighbour()
    pulled = forged(lines, 'row 3', {4: -0.25})
    refused(pulled, 'number 3 of the state at the limit is known to', 'rounding is')
    # Impulses that shake it otherwise
    refused(forged(forged(lines, 'inertia 0', {3: 0.25}), 'inertia 1', {2: 0.25}), 'number 3 of the state at the limit')
    # A spring so stiff that nothing bounds the state for so long
    rows = [(0, [(2, 1.0)]), (1, [(3, 1.0)]), (2, [(4, 1.0)]), (3, [(1, -1024.0)])]
    stiff = motions.mode(2, 'stiff', rows, [])
    i = find(lines, 'mode 1')
    refused(forged(lines[:i] + stiff + lines[i:], 'tail', {1: 2, 2: 2, 3: 2}), 'the state may leave its box within D = 2')


# Complete chatter: of friction and stop on one pair, without friction, beside a block on a belt and a second stop.
HAMMER = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'hammer.toml')
CHATTER = ((['vibro-impact', '--set', 'omega=0.552', '--periods', '8'], 5), (['bouncing-ball', '--periods', '20'], 1), ([HAMMER, '--periods', '4'], 1))


def test_chatter_limits_of_the_engine():
    for words, limits in CHATTER:
        text = certificate_of(*words)
        if text is None:
            return
        assert f'chatter limits   {limits} proved' in proved(text), proved(text)
        lines = text.decode().splitlines()
        refused(forged(lines, 'tail', {4: 0.5 * value(lines, 'tail', 4)}), 'all flights together last up to')
        for k in (5, 6, 7, 8):
            off = 0.25 * (-1) ** k * value(lines, 'tail', k)
            refused(forged(lines, 'tail', {k: value(lines, 'tail', k) - off}), 'the acceleration on the way')
        n = find(lines, 'tail')
        moved = lines[:n + 1] + forged(lines[n + 1:], 'end chatter', {3: 2.0 ** -100})
        refused(moved, 'further than ERROR')


if __name__ == '__main__':
    globals()[sys.argv[2]]()
