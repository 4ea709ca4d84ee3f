"""Certificates of motions whose closed form is known, written by hand.

A certificate is a list of lines. `steps` finds parabolas below a guard from closed forms of h and h' and a bound on |h''|, with a safety far
above the rounding of a double, so that nothing here relies on the verifier.
"""
import math

DELTA = 2.0 ** -40


def number(x):
    """As %a writes it."""
    text = float(x).hex()
    if '.' not in text:
        return text
    mantissa, exponent = text.split('p')
    return mantissa.rstrip('0').rstrip('.') + 'p' + exponent


def line(*words):
    return ' '.join(number(w) if isinstance(w, float) else str(w) for w in words)


def steps(h, h1, M, limit, first=None, most=9.0):
    """`step` lines up to `limit`; `first` is (g, g', |g''|) at s = 0, or None where the guard is not zero there."""
    lines, s = [], 0.0
    while s < limit:
        a, b, c = first if s == 0.0 and first else (h(s), h1(s), M)
        a, b, c = a * (1 - 1e-12) - 1e-15, b - 1e-12 * abs(b) - 1e-15, c * 1.01
        d = min(limit - s, most)
        if not a + b * d - 0.5 * c * d * d > 0.0:
            d = 0.9 * 2.0 * a / (math.sqrt(b * b + 2.0 * c * a) - b)
        end = s + d >= limit
        lines.append(line('step', s, a, b, c, math.nextafter(d, 9.0) if end else d))
        if end:
            return lines
        assert d > 0.0 and len(lines) < 2000
        s = math.nextafter(s + d, 0.0)
    return lines


def head(name, m, d, period, stops, inertia):
    lines = [line('slapstick-certificate', 1), line('model', name), line('sizes', m, d), line('period', period)]
    lines += [line('stop', k, own, sign, r, title) for k, (own, sign, r, title) in enumerate(stops)]
    return lines + [line('inertia', i, *row) for i, row in enumerate(inertia)]


def mode(identity, name, rows, guards):
    lines = [line('mode', identity, name)]
    for word, table in (('row', rows), ('guard', [(g, kind, entries) for g, (kind, entries) in enumerate(guards)])):
        for *key, entries in table:
            lines.append(line(word, *key, len(entries), *(x for pair in entries for x in pair)))
    return lines


# A ball that falls onto a stop: X = (p, u, 1), gap = -p, u' = 1; bounces of restitution 1/2. All numbers are exact.
BALL = head('ball', 3, 1, 1.0, [(0, 1.0, 0.5, 'floor')], [[1.0]])
FALL = mode(0, 'falls', [(0, [(1, 1.0)]), (1, [(2, 1.0)])], [('gap', [(0, -1.0)])])
LIE = mode(1, 'lies still', [(0, [(1, 1.0)])], [('press', [(2, 1.0)])])
IMPACT = [line('end', 'zero', 0, DELTA), line('blow', 0, 0), line('event', 'impact', 'floor', 1.0)]


def ball():
    """Falls from 1/2 for one unit, bounces for another, and is cut half way up again."""
    limit = 1.0 - DELTA
    lines = BALL + FALL + [line('segment', 0, 0, 0, 0.0, 1.0), line('state', -0.5, 0.0, 1.0), line('prove', 0, 0, limit),
                           line('step', 0.0, 0.5, 0.0, 1.0, limit)] + IMPACT
    lines += [line('segment', 1, 0, 1, 0.0, 1.0), line('state', 0.0, -0.5, 1.0), line('prove', 0, 1, limit),
              line('step', 0.0, 0.5, -0.5, 0.0, limit), line('end', 'zero', 0, DELTA), line('blow', 0, 0),
              line('event', 'impact', 'floor', 0.5)]
    lines += [line('segment', 2, 0, 2, 0.0, 0.25), line('state', 0.0, -0.25, 1.0), line('prove', 0, 1, 0.25),
              line('step', 0.0, 0.25, -0.5, 0.0, 0.125), line('step', 0.125, 0.0234375, 0.125, 1.0, 0.125)]
    return lines + [line('end', 'cut'), line('done', 3)]


def at_rest(n, closed, period, duration, state, guard, end):
    """Segment n, in which constant guards last: (0, h) .."""
    lines = [line('segment', n, closed, period, 0.0, duration), line('state', *state)]
    for g, h in enumerate(guard if duration > 0.0 else ()):
        lines += [line('prove', g, 0, duration), line('step', 0.0, h, 0.0, 0.0, duration)]
    return lines + end


def chatter():
    """The ball leaves its first impact at 1/2: flights of 1, 1/2, 1/4, .., then it lies still."""
    lines = BALL + FALL + [line('segment', 0, 0, 0, 0.0, 1.0), line('state', -0.5, 0.0, 1.0), line('prove', 0, 0, 1.0 - DELTA),
                           line('step', 0.0, 0.5, 0.0, 1.0, 1.0 - DELTA)] + IMPACT + [line('blow', 1, 0)] + LIE
    end = [line('tail', 0, 0, 0, 2.0, 1.0, 1.0, 1.0, 1.0), line('end', 'chatter', 0, 2.0 ** -60)]
    lines += at_rest(1, 1, 1, 2.0, (0.0, 0.0, 1.0), [1.0], end)
    return lines + at_rest(2, 1, 3, 1.0, (0.0, 0.0, 1.0), [1.0], [line('end', 'cut')]) + [line('done', 3)]


def rubbing():
    """A ball in a tube: weight 5/2, friction 3/2. It leaves the stop at 1, slowed by 4, and returns by 1: half as fast, and after the impact a
    quarter. Flights of 1/4 + 1/2 times the speed: one unit of time in all. At rest the stop and friction carry the weight."""
    slide = [(0, [(1, 1.0)])]
    lines = head('rubbing', 3, 1, 1.0, [(0, 1.0, 0.5, 'floor')], [[1.0]])
    lines += mode(0, 'slip+', slide + [(1, [(2, 1.0)])], [('gap', [(0, -1.0)]), ('slip', [(1, 1.0)])])
    lines += [line('segment', 0, 0, 0, 0.0, 2.0), line('state', -2.0, 0.0, 1.0), line('prove', 0, 0, 2.0 - DELTA),
              line('step', 0.0, 2.0, 0.0, 1.0, 2.0 - DELTA), line('prove', 1, 1, 2.0), line('step', 0.0, 1.0, 0.0, 0.0, 2.0),
              line('end', 'zero', 0, DELTA), line('blow', 0, 0), line('event', 'impact', 'floor', 2.0), line('blow', 1, 0)]
    lines += mode(1, 'slip-', slide + [(1, [(2, 4.0)])], [('slip', [(1, -1.0)])])
    lines += mode(2, 'stick', slide, [('stick', [(2, -1.0)])])
    lines += mode(3, 'stick|closed', slide, [('press', [(2, 4.0)])])
    end = [line('tail', 1, 0, 2, 1.0, 4.0, 4.0, 1.0, 1.0), line('end', 'chatter', 0, 2.0 ** -60)]
    lines += at_rest(1, 3, 2, 1.0, (0.0, 0.0, 1.0), [4.0], end)
    return lines + at_rest(2, 3, 3, 0.0, (0.0, 0.0, 1.0), [], [line('end', 'cut')]) + [line('done', 3)]


def neighbour(gap=64.0):
    """The ball of `chatter` shakes a second body, by half of its own changes of speed, that has a stop of its own at a distance. X = (p1, p2, u1, u2, 1)."""
    lines = head('neighbour', 5, 2, 1.0, [(0, 1.0, 0.5, 'floor'), (1, 1.0, 0.5, 'wall')], [[1.0, 0.5], [0.5, 1.0]])
    move = [(0, [(2, 1.0)]), (1, [(3, 1.0)])]
    lines += mode(0, 'free', move + [(2, [(4, 1.0)])], [('gap', [(0, -1.0)]), ('gap', [(1, -1.0)])])
    lines += [line('segment', 0, 0, 0, 0.0, 1.0), line('state', -0.5, -gap, 0.0, 0.0, 1.0), line('prove', 0, 0, 1.0 - DELTA),
              line('step', 0.0, 0.5, 0.0, 1.0, 1.0 - DELTA), line('prove', 1, 0, 1.0), line('step', 0.0, gap, 0.0, 0.0, 1.0)] + IMPACT
    lines += [line('blow', 1, 0)] + mode(1, 'closed', move + [(3, [(4, -0.5)])], [('press', [(4, 1.0)]), ('gap', [(1, -1.0)])])
    lines += [line('segment', 1, 1, 1, 0.0, 2.0), line('state', 0.0, -gap, 0.0, -0.5, 1.0), line('prove', 0, 0, 2.0),
              line('step', 0.0, 1.0, 0.0, 0.0, 2.0), line('prove', 1, 0, 2.0), line('step', 0.0, gap, 0.5, 0.5, 2.0)]
    lines += [line('tail', 0, 0, 0, 2.0, 1.0, 1.0, 1.0, 1.0), line('end', 'chatter', 0, 2.0 ** -60)]
    lines += [line('segment', 2, 1, 3, 0.0, 0.0), line('state', 0.0, -gap - 2.0, 0.0, -1.5, 1.0)]
    return lines + [line('end', 'cut'), line('done', 3)]


def lift(order):
    """A guard that starts with a zero of order 2 (s^2 / 2) or 3 (s^3 / 6): p1'' = -1, or p1'' = -p2 with p2 = s."""
    force = [(4, -1.0)] if order == 2 else [(1, -1.0)]
    lines = head('lift', 5, 2, 1.0, [(0, 1.0, 0.5, 'floor')], [[1.0, 0.0], [0.0, 1.0]])
    lines += mode(0, 'rises', [(0, [(2, 1.0)]), (1, [(3, 1.0)]), (2, force)], [('gap', [(0, -1.0)])])
    lines += [line('segment', 0, 0, 0, 0.0, 1.0), line('state', 0.0, 0.0, 0.0, 1.0, 1.0), line('prove', 0, order, 1.0)]
    value = {2: lambda s: s * s / 2, 3: lambda s: s ** 3 / 6}[order]
    rate = {2: lambda s: s, 3: lambda s: s * s / 2}[order]
    lines += steps(value, rate, 1.0, 1.0, (value(1.0), 0.0, 0.0), most=0.25)
    return lines + [line('end', 'cut'), line('done', 1)]


def oscillator():
    """x'' = -x from x = 0, x' = 1 to a stop at x = 1/2 after pi/6, with restitution 0.8, and back."""
    period, hit = 2.0 * math.pi, math.pi / 6.0
    lines = head('oscillator', 3, 1, period, [(0, 1.0, 0.8, 'wall')], [[1.0]])
    lines += mode(7, 'free', [(0, [(1, 1.0)]), (1, [(0, -1.0), (2, -0.5)])], [('gap', [(0, -1.0)])])
    w = math.cos(hit)
    lines += [line('segment', 0, 7, 0, 0.0, hit), line('state', -0.5, 1.0, 1.0), line('prove', 0, 0, hit - 1e-11)]
    lines += steps(lambda s: 0.5 - math.sin(s), lambda s: -math.cos(s), 0.5, hit - 1e-11)
    lines += [line('end', 'zero', 0, 1e-11), line('blow', 0, 0), line('event', 'impact', 'wall', w)]
    u = -0.8 * w
    # Now x = cos(s)/2 + u sin(s): gap = (1 - cos s)/2 - u sin s, k = 1: g(0) = -u, g'(0) = 1/4, |g''| <= max |gap'''| / 3.
    lines += [line('segment', 1, 7, 0, hit / period, 2.0), line('state', 0.0, u, 1.0), line('prove', 0, 1, 2.0)]
    lines += steps(lambda s: 0.5 - math.cos(s) / 2 - u * math.sin(s), lambda s: math.sin(s) / 2 - u * math.cos(s), 0.9, 2.0,
                   (-u, 0.25, 0.3))
    return lines + [line('end', 'cut'), line('done', 2)]


def released():
    """A block held by friction on a belt of speed 1 until cos(theta) = 1/2, theta = pi .. 5 pi/3; then it slips, u' = cos(theta) - 1/2.

    X = (p, u, cos, sin, 1). Held: h = 1/2 - cos, and u, which stays zero. Slipping: h = u has a zero of order 2 but for rounding.
    """
    period = 2.0 * math.pi
    belt = (0, [(1, 1.0), (4, 1.0)])
    clock = [(2, [(3, -1.0)]), (3, [(2, 1.0)])]
    lines = head('belt', 5, 1, period, [], [[1.0]])
    lines += mode(0, 'held', [belt] + clock, [('stick', [(2, -1.0), (4, 0.5)]), ('slip', [(1, 1.0)])])
    lines += mode(1, 'slips', [belt, (1, [(2, 1.0), (4, -0.5)])] + clock, [('slip', [(1, 1.0)])])
    duration, limit = 2.0 * math.pi / 3.0, 2.0 * math.pi / 3.0 - 1e-11
    lines += [line('segment', 0, 0, 0, 0.5, duration), line('state', 0.25, 0.0, -1.0, 0.0, 1.0), line('rest', 1), line('prove', 0, 0, limit)]
    lines += steps(lambda s: 0.5 + math.cos(s), lambda s: -math.sin(s), 1.0, limit)
    lines += [line('end', 'zero', 0, 1e-11), line('event', 'release', 'belt', 0.0)]
    fraction = 5.0 / 6.0
    cosine, sine = math.cos(2.0 * math.pi * fraction), math.sin(2.0 * math.pi * fraction)
    lines += [line('segment', 1, 1, 0, fraction, 1.0), line('state', 0.25 + duration, 0.0, cosine, sine, 1.0), line('prove', 0, 2, 1.0)]
    value = lambda s: math.sin(5.0 * math.pi / 3.0 + s) + math.sqrt(0.75) - s / 2
    rate = lambda s: math.cos(5.0 * math.pi / 3.0 + s) - 0.5
    # h = sqrt(3)/4 s^2 - s^3/12 - ..: g(0) = sqrt(3)/4, g'(0) = -1/12, |g''| <= |h''''| / 12.
    lines += steps(value, rate, 1.0, 1.0, (math.sqrt(3.0) / 4.0, -1.0 / 12.0, 0.09))
    return lines + [line('end', 'cut'), line('done', 2)]


def twins():
    """Two stops on one displacement, seen twice: they are struck together, and D is singular."""
    lines = head('twins', 5, 2, 1.0, [(0, 1.0, 0.5, 'one'), (1, 1.0, 0.5, 'two')], [[1.0, 1.0], [1.0, 1.0]])
    lines += mode(0, 'falls', [(0, [(2, 1.0)]), (1, [(3, 1.0)]), (2, [(4, 1.0)]), (3, [(4, 1.0)])],
                  [('gap', [(0, -1.0)]), ('gap', [(1, -1.0)])])
    limit = 1.0 - DELTA
    proof = [line('step', 0.0, 0.5, 0.0, 1.0, limit)]
    lines += [line('segment', 0, 0, 0, 0.0, 1.0), line('state', -0.5, -0.5, 0.0, 0.0, 1.0), line('prove', 0, 0, limit)] + proof
    lines += [line('prove', 1, 0, limit)] + proof + [line('end', 'zero', 0, DELTA), line('blow', 0, 0, 1)]
    lines += [line('event', 'impact', 'one', 1.0), line('event', 'impact', 'two', 1.0)]
    lines += [line('segment', 1, 0, 1, 0.0, 0.5), line('state', 0.0, 0.0, -0.5, -0.5, 1.0)]
    for g in (0, 1):
        lines += [line('prove', g, 1, 0.5), line('step', 0.0, 0.5, -0.5, 0.0, 0.5)]
    return lines + [line('end', 'cut'), line('done', 2)]


def touching():
    """The ball thrown up by a force that turns: gap = (s - 1)^2 / 2 on [0, 1] touches zero. Whether it does rounding could not say."""
    limit = 1.0 - 2.0 ** -22
    lines = BALL + mode(0, 'slows', [(0, [(1, 1.0)]), (1, [(2, -1.0)])], [('gap', [(0, -1.0)])])
    lines += [line('segment', 0, 0, 0, 0.0, 1.0), line('state', -0.5, 1.0, 1.0), line('prove', 0, 0, limit)]
    lines += steps(lambda s: (1.0 - s) ** 2 / 2, lambda s: s - 1.0, 1.0, limit)
    lines += [line('end', 'touch', 0, 2.0 ** -43), line('event', 'graze', 'floor', 0.0)]
    lines += [line('segment', 1, 0, 1, 0.0, 1.0), line('state', 0.0, 0.0, 1.0), line('prove', 0, 2, 1.0), line('step', 0.0, 0.5, 0.0, 0.0, 0.5),
              line('step', 0.5, 0.125, 0.5, 1.0, 0.5)]
    return lines + [line('end', 'cut'), line('done', 2)]


def flat(depth=2.0 ** -47, flown=2.0 ** -24, delta=1.5 * 2.0 ** -24):
    """The same ball, thrown so that its gap (s - 1)^2 / 2 - depth dips below zero by no more than rounding: where it does is known to DELTA only."""
    duration = 1.0 - flown
    limit = duration - delta
    lines = BALL + mode(0, 'slows', [(0, [(1, 1.0)]), (1, [(2, -1.0)])], [('gap', [(0, -1.0)])])
    lines += [line('segment', 0, 0, 0, 0.0, duration), line('state', -0.5 + depth, 1.0, 1.0), line('prove', 0, 0, limit)]
    # At s = 1 - q the guard is q^2 / 2 - depth, its slope -q; steps of a power of two up to q / 3 lose no digit.
    q = 1.0
    while 1.0 - q < limit:
        d = min(2.0 ** math.floor(math.log2(q / 3.0)), limit - (1.0 - q))
        lines.append(line('step', 1.0 - q, q * q / 2.0 - depth, -q, 1.0, d))
        q -= d
    lines += [line('end', 'zero', 0, delta), line('blow', 0, 0), line('event', 'impact', 'floor', flown)]
    lines += [line('segment', 1, 0, 0, duration, 0.0), line('state', 0.0, -flown / 2.0, 1.0)]
    return lines + [line('end', 'cut'), line('done', 2)]


def tie(gap=2.0 ** -50):
    """Two bodies without forces, the second one behind the first by less than the clock can tell, reach their stops at one instant."""
    flight = 2.0 ** -40
    lines = head('tie', 5, 2, 1.0, [(0, 1.0, 0.5, 'one'), (1, 1.0, 0.5, 'two')], [[1.0, 0.0], [0.0, 1.0]])
    lines += mode(0, 'flies', [(0, [(2, 1.0)]), (1, [(3, 1.0)])], [('gap', [(0, -1.0)]), ('gap', [(1, -1.0)])])
    lines += [line('segment', 0, 0, 0, 0.0, flight), line('state', -flight, -flight - gap, 1.0, 1.0, 1.0)]
    limit = flight * 0.5
    lines += [line('prove', 0, 0, limit), line('step', 0.0, flight, -1.0, 0.0, limit)]
    lines += [line('prove', 1, 0, flight), line('step', 0.0, flight + gap, -1.0, 0.0, flight), line('end', 'zero', 0, limit)]
    lines += [line('blow', 0, 0, 1), line('event', 'impact', 'one', 1.0), line('event', 'impact', 'two', 1.0)]
    lines += [line('segment', 1, 0, 0, flight, 0.0), line('state', 0.0, 0.0, -0.5, -0.5, 1.0)]
    return lines + [line('end', 'cut'), line('done', 2)]


def rattle():
    """A mass that slides to the upper of two walls, slowed by friction: u' = -1/4 from 3. The lower wall sees it from the other side, and is
    not watched while the slip guard lasts. X = (p, -1 - p, u, -u, cos, sin, 1): the phases have nothing to do with it."""
    period = 2.0 * math.pi
    lines = head('rattle', 7, 2, period, [(0, 1.0, 0.5, 'upper'), (1, 1.0, 0.5, 'lower')], [[1.0, -1.0], [-1.0, 1.0]])
    lines += mode(0, 'slip+', [(0, [(2, 1.0)]), (1, [(3, 1.0)]), (2, [(6, -0.25)]), (3, [(6, 0.25)]), (4, [(5, -1.0)]), (5, [(4, 1.0)])],
                  [('gap', [(0, -1.0)]), ('slip', [(2, 1.0)])])
    lines += [line('segment', 0, 0, 0, 0.25, 0.25), line('state', -1.0, 0.0, 3.0, -3.0, 0.0, 1.0, 1.0)]
    lines += [line('prove', 1, 0, 0.25), line('step', 0.0, 3.0, -0.25, 0.0, 0.25), line('prove', 0, 0, 0.25)]
    lines += [line('step', 0.0, 1.0, -3.0, 0.25, 0.125), line('step', 0.125, 0.625, -2.96875, 0.25, 0.125)]
    return lines + [line('end', 'cut'), line('done', 1)]
