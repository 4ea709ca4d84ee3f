"""Certificates of parts whose law has more than one piece: dampers in a zone, bounded dampers, restitution over speed, friction with a normal force.

    features_test.py PROGRAM test_NAME [SLAPSTICK]
"""
import os
import sys

import motions
from forgery import certificate_of, forged, proved, refused, unreadable

HYSTERESIS = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'hysteresis.toml')


def test_damper_in_a_zone():
    proved(motions.zone())
    refused(forged(motions.zone(), 'polyline', {8: 1.01}), 'number 0 of the state')
    refused(forged(motions.zone(), 'polyline', {3: 'displacement'}), 'number 0 of the state')
    refused(forged(motions.zone(), 'polyline', {4: 0.01}), 'segment 1, number 0 of the state')
    refused(forged(motions.zone(), 'segment', {5: 0}, 1), 'corner of polyline zone: fails at once')


def test_damper_that_is_bounded():
    proved(motions.bounded())
    refused(forged(motions.bounded(), 'segment', {5: 'on'}, 1), 'bound of compliant stop pad: fails at the start')
    refused(forged(motions.bounded(), 'segment', {5: 'bounded'}, 2), 'bound of compliant stop pad: fails at once')
    refused(forged(motions.bounded(), 'compliant', {5: 3.9}), 'segment 1, bound of compliant stop pad: fails at s = 0.98')
    refused(forged(motions.bounded(), 'compliant', {5: 4.1}), 'nothing ends the segment')
    unreadable(forged(motions.bounded(), 'compliant', {6: 0}), 'compliant stop pad has no bound')
    unreadable(forged(motions.bounded(), 'compliant', {6: 3}), '3 is not in the range 0 .. 2')


def test_restitution_over_speed():
    text = proved(motions.two_restitutions())
    assert 'largest jump     0 of what rounding is allowed' in text, text
    for other in ({4: 0.49, 7: 0.49}, {9: 0.26}, {8: 1.4}, {6: 0.6}):
        refused(forged(motions.two_restitutions(), 'stop', other), 'segment 1, number 1 of the state')
    refused(forged(motions.two_restitutions(), 'stop', {4: 0.49, 7: 0.49}), 'segment 2, number 1 of the state')
    unreadable(forged(motions.two_restitutions(), 'stop', {4: 0.49}), 'the restitution is not that of the first corner')
    unreadable(forged(motions.two_restitutions(), 'stop', {9: 1.5}), 'the restitution is not in [0, 1]')
    unreadable(forged(motions.two_restitutions(), 'stop', {8: 0.5}), 'corners do not ascend')


def test_friction_that_is_lifted():
    proved(motions.lifted())
    refused(forged(motions.lifted(), 'segment', {5: 'slip+'}, 1), 'load of friction contact sole: fails at once')
    refused(forged(motions.lifted(), 'segment', {5: 'unloaded'}), 'missing load of friction contact sole: fails at the start')
    for k, other in ((2, 1.01), (6, -1.01), (7, 0.01)):
        refused(forged(motions.lifted(), 'normal', {k: other}), 'segment')
    unreadable([text for text in motions.lifted() if not text.startswith('normal')], 'has no normal force, and is never unloaded')


def test_friction_under_a_spring():
    proved(motions.pressed_by_a_spring())
    refused(forged(motions.pressed_by_a_spring(), 'friction', {4: 0.06, 5: 0.06}), 'hold of friction contact sole: fails at the start')
    refused(forged(motions.pressed_by_a_spring(), 'segment', {6: 'off'}), 'gap of compliant stop pad: fails at the start')
    # Nothing presses: the block is not held, and says so.
    refused(forged(motions.pressed_by_a_spring(), 'normal', {3: -1}), 'load of friction contact sole: fails at the start')
    slides = forged(motions.pressed_by_a_spring(), 'friction', {5: 0.03125})
    proved(slides)
    refused(forged(forged(forged(slides, 'segment', {5: 'slip+'}), 'done', {5: 0.0625}), 'done', {7: 0.125}), 'contacts slip or open that could stick')


def test_models_of_all_features():
    """Brake, pressed block, a pad with hysteresis: friction of a normal force, at a spring and over the state."""
    for model in ('mode-coupling-brake', 'pressed-block', HYSTERESIS):
        text = certificate_of(model, '--periods', '40')
        if text is not None:
            assert b'normal ' in text
            proved(text)


if __name__ == '__main__':
    globals()[sys.argv[2]]()
