"""The verifier proves motions whose closed form is known, and refuses every forgery of them for the stated reason.

    verify_test.py PROGRAM test_NAME [SLAPSTICK]
"""
import sys

import motions
from forgery import ALL, certificate_of, find, forged, proved, proved_but_for, refused, unreadable, value, without
from motions import line


def test_closed_forms_are_proved():
    for motion in ALL:
        text = proved(motion())
        assert 'largest jump' in text


def test_exact_motions_have_no_jump():
    for motion in (motions.ball, motions.dead_ball, motions.chatter, motions.rubbing, motions.cradle, motions.loop):
        assert 'largest jump     0 of what rounding is allowed, 0 periods of the clock (0 all together)' in proved(motion()), motion


def test_the_report_counts_what_was_there():
    text = proved(motions.ball())
    assert 'events           2, 2 impacts' in text and 'segments         3, ' in text and 'periods          0 to 2.25' in text, text
    assert 'chatter limits   1' in proved(motions.chatter())


# What the laws forbid, told as a whole run.

def test_run_without_restitution_under_a_header_with_it():
    dead = forged(motions.dead_ball(), 'stop', {4: 0.8})
    refused(dead, 'number 1 of the state is 0.8', 'from where it must be')
    i = find(dead, 'impact')
    for word in ('pile-up', 'chatter'):
        hidden = dead[:i - 1] + [line(word, 0)] + dead[i + 1:]
        reason = 'no impact of the instant was at it' if word == 'pile-up' else 'brought to rest by a chatter that nothing proves'
        refused(hidden, reason)


def test_blows_that_are_written_three_times():
    lines = forged(forged(motions.ball(), 'stop', {4: 0.5 ** (1 / 3)}), 'segment', {})
    for i in reversed([k for k, text in enumerate(lines) if text.startswith('blow')]):
        lines[i:i + 2] = lines[i:i + 2] * 3
    refused(lines, 'no stop of this blow approaches')


def test_contact_that_is_left_out_of_the_model():
    wall = without(motions.oscillator(), 'stop')
    unreadable(wall, 'no contact and no coordinate has the number of 0 -1')
    unreadable(forged(wall, 'number', {3: 0.0}), '`open` is too much here')
    lines = forged(motions.oscillator(), 'stop', {3: 0.75})
    unreadable(lines, 'there is no number of contact wall')
    refused(forged(lines, 'number', {3: 0.75}), 'segment 0, number 0 of the state is')


def test_numbers_of_the_model():
    for record, word, other in (('coordinate', 2, 1.5), ('spring', 3, 1.0 + 2.0 ** -20), ('stop', 4, 0.81)):
        refused(forged(motions.oscillator(), record, {word: other}), 'segment')
    for record, word, other in (('force', 3, 1.01), ('force', 4, 1.6), ('omega', 1, 1.01), ('friction', 4, 0.51)):
        refused(forged(motions.released(), record, {word: other}), 'segment')
    refused(forged(motions.bumper(), 'compliant', {4: 1.01}), 'segment 1')
    refused(forged(motions.kink(), 'polyline', {5: 1.01}), 'segment 1')
    unreadable(forged(motions.cradle(), 'coordinate', {2: 0.0}), 'the masses are not positive definite')


# One claim at a time.

def test_start_and_end():
    refused(forged(motions.ball(), 'start', {3: -0.5 - 1e-9}), 'segment 0, number 0 of the state')
    refused(forged(motions.ball(), 'start', {2: 0.25}), 'the run does not begin at its start')
    refused(forged(motions.ball(), 'done', {4: -0.032}), 'number 0 of the state')
    refused(forged(motions.ball(), 'done', {3: 0.26}), 'begins 0.01')


def test_clock():
    lines = motions.oscillator()
    refused(forged(lines, 'segment', {3: value(lines, 'segment', 3, 1) + 1e-12}, 1), 'segment 1, begins', 'periods from where')
    refused(forged(motions.ball(), 'segment', {2: 2}, 1), 'segment 1, begins 1 periods from where')


def test_displaced_state():
    refused(forged(motions.ball(), 'state', {2: -0.5 - 2.0 ** -30}, 1), 'segment 1, number 1 of the state')
    held = motions.released()
    refused(forged(held, 'state', {1: value(held, 'state', 1, 1) + 1e-9}, 1), 'number 0 of the state')
    refused(forged(motions.loop(), 'state', {4: 1e-9}), 'from what it follows from')


def test_event_that_is_not_there():
    early = forged(motions.dead_ball(), 'segment', {4: 0.75})
    refused(early, 'nothing ends the segment: no condition of its mode is zero')
    refused(forged(motions.ball(), 'end', {1: 'cut'}), "something happens at `end cut`")


def test_event_that_is_hidden():
    # The ball falls through the floor at s = 1 and is cut at 1.5.
    start = motions.ball()[:find(motions.ball(), 'segment')]
    through = start + motions.segment(0, (0, 0.0), 1.5, ['open'], [-0.5], [0.0], motions.CUT) + motions.done(1, (1, 0.5), [0.625], [1.5])
    refused(through, 'segment 0, gap of stop floor: fails at s = 1')
    # A force that turns its limit over: it is let go later than it must be.
    held = motions.released()
    late = forged(held, 'segment', {4: value(held, 'segment', 4) + 1e-3})
    refused(late, 'hold of friction contact belt: fails at s = 0.5235')


def test_contact_that_is_in_another_state():
    refused(forged(motions.dead_ball(), 'segment', {5: 'open'}, 1), 'gap of stop floor: fails at once', 'its derivative of order 2 is -1')
    refused(forged(motions.touching(), 'segment', {5: 'closed'}, 1), 'push of stop ceiling: fails at the start: the value is -1')
    refused(forged(motions.ball(), 'segment', {5: 'closed'}), 'stop floor is not at rest where it is called closed')
    refused(forged(motions.released(), 'segment', {5: 'slip+'}), 'slip of friction contact belt: fails at once')
    refused(forged(motions.released(), 'segment', {5: 'slip-'}, 1), 'slip of friction contact belt: fails at once')
    refused(forged(motions.released(), 'segment', {5: 'stick'}, 1), 'hold of friction contact belt: fails at once')
    refused(forged(motions.bumper(), 'segment', {5: 'on'}), 'depth of compliant stop bumper: fails at the start')
    refused(forged(motions.bumper(), 'segment', {5: 'off'}, 1), 'gap of compliant stop bumper: fails at once')
    refused(forged(motions.bumper(), 'segment', {5: 'detached'}, 1), 'missing pull of compliant stop bumper: fails at once')
    refused(forged(motions.kink(), 'segment', {5: 0}, 1), 'corner of polyline kink: fails at once')
    pulling = forged(motions.bumper(), 'compliant', {6: 1})
    proved(pulling)
    unreadable(forged(pulling, 'segment', {5: 'detached'}, 1), 'pulls, and is never detached')


def test_rest_that_is_none():
    refused(forged(motions.released(), 'state', {2: 2.0 ** -60}), 'friction contact belt is not at rest where it is said to stick')


def test_mode_that_changes_without_an_event():
    lines = motions.dead_ball()
    i = find(lines, 'done')
    two = lines[:i] + motions.segment(2, (3, 0.0), 1.0, ['open'], [0.0], [0.0], motions.CUT)
    refused(two + motions.done(3, (4, 0.0), [0.0], [0.0]), 'segment 2, the mode has changed at `end cut`')


def test_impacts_and_their_speeds():
    lines = motions.ball()
    refused(forged(lines, 'impact', {2: 1.1}), 'no blow belongs to this impact at floor with w = 1.1')
    refused(without(lines, 'impact'), 'the impact at floor with w = 1 is not listed')
    i = find(lines, 'impact')
    refused(lines[:i] + [lines[i]] + lines[i:], 'no blow belongs to this impact')
    refused(without(lines, 'blow'), 'segment 1, number 1 of the state is')
    refused(forged(lines, 'state', {2: -0.6}, 1), 'segment 1, number 1 of the state is')


def test_blow_in_the_air():
    lines = forged(motions.ball(), 'segment', {4: 0.5})
    refused(lines, 'stop floor is struck with a gap of 0.375')


def test_moreaus_law():
    lines = motions.cradle()
    alone = forged(lines, 'blow', {})
    alone[find(alone, 'blow')] = 'blow 0'
    refused(alone, "Moreau's law: stop wall touches, and gets no impulse that it needs")
    refused(forged(lines, 'law', {1: 'sequence'}), 'by the law of the model one stop is struck after the other')
    inelastic = forged(lines, 'stop', {4: 0.5})
    refused(inelastic, 'segment 1, number')


def test_impulse_that_pulls():
    """Two bodies at walls of their own, one on its way off: a blow at both turns it back, and obeys the law but for the sign of its impulse."""
    parts = [('stop', 0, -1, 0.0, 0.5, 'a'), ('stop', 1, -1, 0.0, 0.5, 'b')]
    lines = motions.head('two', [1.0, 1.0], parts, [(0, -1, 0.0, 0.0), (1, -1, 0.0, 0.0)]) + [line('start', 0, 0.0, 0.0, 1.0, 0.0, -0.5)]
    at = lambda *blows: motions.segment(0, (0, 0.0), 0.0, ['open', 'open'], [0.0, 0.0], [1.0, -0.5], motions.EVENT, *blows)
    off = lambda v: motions.segment(1, (0, 0.0), 1.0, ['open', 'open'], [0.0, 0.0], [-0.5, v], motions.CUT) + motions.done(2, (1, 0.0), [-0.5, v], [-0.5, v])
    proved(lines + at(('blow', 0), ('impact', 0, 1.0)) + off(-0.5))
    refused(lines + at(('blow', 0, 1), ('blow', 1), ('impact', 0, 1.0), ('impact', 1, 0.25)) + off(-0.125), 'an impulse of this blow pulls')


def test_order_of_impacts_in_sequence():
    lines = motions.cradle('sequence')
    i = find(lines, 'blow')
    refused(lines[:i] + ['blow 1'] + lines[i:], 'stop bodies approaches too, and comes first')
    both = forged(lines, 'start', {6: 1.0})
    refused(forged(forged(both, 'state', {4: 1.0}), 'state', {3: 0.0}), 'segment 0')


def test_pile_up_that_is_no_assumption_but_a_lie():
    lines = motions.ball()
    i = find(lines, 'blow', 1)
    rest = lines[:i] + ['pile-up 0'] + lines[i + 2:]
    refused(forged(rest, 'state', {2: 0.0}, 2), 'comes to rest, and no impact of the instant was at it or acts on it')


def test_impacts_without_end_are_proved_but_for_the_pile_up():
    proved_but_for(motions.squeezed(), '1 pile-up')
    refused(motions.squeezed(8), 'is not slow beside the fastest impact of the instant')
    # However many impacts there are at one instant, none may be hidden or be of another speed.
    for nth in (0, 2, 9, 24):
        refused(without(motions.squeezed(), 'impact', nth), 'is not listed')
        refused(forged(motions.squeezed(), 'impact', {2: 1.01 * value(motions.squeezed(), 'impact', 2, nth)}, nth), 'no blow belongs to this impact')


def test_touch_is_proved_but_for_its_sign():
    proved_but_for(motions.touching(), '1 undecided sign')
    high = forged(forged(motions.touching(), 'start', {3: -0.5 - 2.0 ** -30}), 'state', {1: -0.5 - 2.0 ** -30})
    refused(high, 'nothing ends the segment')


def test_release_before_static_friction_is_reached():
    # With a greater static friction the same force holds the block on.
    refused(motions.released(0.6), 'nothing ends the segment')


def test_choice_of_the_mode():
    proved(motions.stranded())
    refused(motions.stranded(True), 'contacts slip or open that could stick or stay closed')
    proved_but_for(motions.stack(True), '1 choice among lawful modes')
    proved_but_for(motions.stack(False), '1 choice among lawful modes')
    refused(forged(motions.stack(True), 'segment', {5: 'slip+', 6: 'slip+'}), 'segment 0')


def test_share_of_redundant_forces():
    refused(forged(motions.loop(), 'friction', {4: 0.4375, 5: 0.25}), 'hold of friction contact f01: fails at the start: the value is -0.0625')
    proved(forged(motions.loop(), 'friction', {4: 0.5625, 5: 0.25}))


def test_segments_out_of_order():
    lines = motions.ball()
    a, b, c, e = find(lines, 'segment 0'), find(lines, 'segment 1'), find(lines, 'segment 2'), find(lines, 'done')
    unreadable(lines[:a] + lines[b:c] + lines[a:b] + lines[c:], '1 is not in the range 0 .. 0')
    later = [text.replace('segment 1', 'segment 0').replace('segment 2', 'segment 1').replace('done 3', 'done 2') for text in lines[b:]]
    refused(lines[:a] + later, 'segment 0, number 0 of the state', 'from where it must be')
    unreadable(lines[:c] + lines[e:], '3 is not in the range 2 .. 2')


def test_segment_that_is_flown_for_too_long():
    refused(forged(motions.oscillator(), 'segment', {4: 1e300}, 1), 'is too long to be followed')


ENGINE = (['vibro-impact', '--set', 'omega=2.2', '--periods', '40'], ['vibro-impact', '--set', 'omega=0.552', '--periods', '8'],
          ['vibro-impact', '--set', 'omega=4.9', '--periods', '50'])
MODELS = ('belt', 'bilinear-oscillator', 'bouncing-ball', 'colliding-blocks', 'coulomb-oscillator', 'falling-friction', 'friction-rattle', 'gear-pair',
          'impact-absorber', 'impact-friction-oscillator', 'impact-oscillator', 'impact-pair', 'shaken-table', 'sliding-block', 'sliding-pair', 'spool',
          'stick-slip-impact', 'two-blocks-on-belt', 'two-sided-rattle', 'vibro-impact')


def test_certificates_of_the_engine_are_proved():
    for words in ENGINE + tuple([model, '--periods', '20'] for model in MODELS):
        text = certificate_of(*words)
        if text is not None:
            proved(text)


if __name__ == '__main__':
    globals()[sys.argv[2]]()
