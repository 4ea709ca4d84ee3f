"""Return maps on events, and certificates. One CTest case per function `test_...`."""
import math

from program import good, main, read, refused, says, table


def test_returns_of_the_belt_are_its_closed_form_period():
    columns, rows = table(good('poincare', 'belt', '--section', 'event', '--event', 'stick:belt', '--points', '5'))
    assert columns == ['time', 'return_time', 'w', 'x', 'v', 'contact'], columns
    D, v = 0.5, 0.5
    period = 2 * math.pi - 2 * math.atan(D / v) + 2 * D / v
    for row in rows[1:]:
        assert abs(float(row[1]) - period) < 1e-13 * period, row
        assert row[5] == 'belt', row


def test_event_sections_refuse_what_they_cannot_be():
    says(refused(2, 'poincare', 'belt'), '--section event')
    says(refused(2, 'poincare', 'belt', '--section', 'event'), '--event KIND')
    says(refused(2, 'poincare', 'belt', '--section', 'event', '--event', 'stik'), "'stik'", 'slip+, slip-, stick')
    says(refused(2, 'poincare', 'belt', '--section', 'event', '--event', 'stick:wall'), "no contact 'wall'", 'belt')
    says(refused(2, 'poincare', 'vibro-impact', '--event', 'stick'), '--event belongs to --section event')
    says(refused(2, 'poincare', 'belt', '--section', 'event', '--event', 'stick', '--stop', 'x'), '--stop')
    says(refused(3, 'poincare', 'belt', '--section', 'event', '--event', 'impact'), 'no such event in 10000 periods')
    says(refused(2, 'classify', 'belt'), 'poincare --section event')


def test_certificate_is_whole_and_its_tally_is_in_the_summary():
    summary = good('simulate', 'vibro-impact', '--set', 'omega=1.5', '--periods', '10', '--certify', 'proof.txt')
    says(summary, '"certificate"', '"unproved": 0')
    lines = read('proof.txt').splitlines()
    assert lines[0] == 'slapstick-certificate 1', lines[0]
    segments = sum(line.startswith('segment ') for line in lines)
    assert lines[-1] == 'done %d' % segments, lines[-1]
    assert '"segments": %d' % segments in summary.split('"certificate"')[1]


main({name: case for name, case in globals().items() if name.startswith('test_')})
