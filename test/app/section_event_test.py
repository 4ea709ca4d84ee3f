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
    says(refused(2, 'poincare', 'vibro-impact', '--event', 'stick'), '--event: only with --section event')
    says(refused(2, 'poincare', 'belt', '--section', 'event', '--event', 'stick', '--stop', 'x'), '--stop')
    says(refused(3, 'poincare', 'belt', '--section', 'event', '--event', 'graze'), 'no such event in 10000 periods')


def test_a_kind_that_no_contact_can_have_is_refused_with_those_that_it_can():
    words = ('poincare', 'vibro-impact', '--section', 'event', '--points', '3', '--event')
    for wrong, possible in (('slip+:stop', 'impact, stick, release, graze, chatter'), ('impact:friction', 'slip+, slip-, stick, release, graze'),
                            ('engage', 'impact, slip+, slip-, stick, release, graze, chatter')):
        line = refused(2, *words, wrong)
        says(line, '--event', "cannot have '%s'" % wrong.split(':')[0])
        assert line.endswith('; the model can have ' + possible + '\n'), line
    says(refused(2, *words[:1], 'bilinear-oscillator', *words[2:], 'impact'), 'the model can have engage, disengage, separate')
    for right in ('impact', 'impact:stop', 'slip+:friction', 'stick', 'release'):
        good(*words, right, '--set', 'omega=1.5')


def plotted(*words):
    good('poincare', *words, '--out', 'p.csv', '--plot', 'p.png')
    return [[float(word) for word in row[:2]] for row in table(read('p-plot.csv'))[1] if row[0]]


def test_the_return_map_of_a_stop_shows_what_varies():
    """The displacement at a stop is its clearance: w, or the time between points, is drawn instead."""
    words = ('--section', 'event', '--transient', '10', '--points', '20', '--event')
    for w, after in plotted('vibro-impact', '--set', 'omega=4.9', *words, 'impact:stop'):
        assert w > 0.01 and after > 0.01
    columns, rows = table(read('p.csv'))
    w = [float(row[columns.index('w')]) for row in rows]
    assert [list(pair) for pair in zip(w, w[1:])] == plotted('vibro-impact', '--set', 'omega=4.9', *words, 'impact:stop')
    returns = plotted('vibro-impact', '--set', 'omega=0.552', *words, 'chatter')
    assert len(returns) == 18 and all(abs(t - 11.38) < 0.01 for pair in returns for t in pair), returns
    assert all(abs(x) > 0.4 for pair in plotted('belt', *words, 'stick')[1:] for x in pair)


def test_certificate_is_whole_and_its_tally_is_in_the_summary():
    summary = good('simulate', 'vibro-impact', '--set', 'omega=1.5', '--periods', '10', '--certify', 'proof.txt')
    says(summary, '"certificate"', '"unproved": 0')
    lines = read('proof.txt').splitlines()
    assert lines[0] == 'slapstick-certificate 3', lines[0]
    segments = sum(line.startswith('segment ') for line in lines)
    assert lines[-1].startswith('done %d ' % segments), lines[-1]
    assert '"segments": %d' % segments in summary.split('"certificate"')[1]


main({name: case for name, case in globals().items() if name.startswith('test_')})
