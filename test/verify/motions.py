"""Certificates of motions whose closed form is known, written by hand (docs/reference/certificate.md).

A certificate is a list of lines. All numbers of most of them are exact, so that the verifier must find every jump zero.
"""
import math


def number(x):
    """As %a writes it."""
    text = float(x).hex()
    if '.' not in text:
        return text
    mantissa, exponent = text.split('p')
    return mantissa.rstrip('0').rstrip('.') + 'p' + exponent


def line(*words):
    return ' '.join(number(w) if isinstance(w, float) else str(w) for w in words)


def head(name, masses, parts, numbers, omega=0.0, law='moreau'):
    """The model: `parts` are the records between coordinates and numbers, as tuples; stops whose restitution is constant without their count of
    corners, 0."""
    parts = [part[:5] + (0,) + part[5:] if part[0] == 'stop' and isinstance(part[5], str) else part for part in parts]
    lines = ['slapstick-certificate 3', line('model', name), line('size', len(masses)), line('omega', omega), line('law', law)]
    lines += [line('coordinate', i, mass, f'x{i + 1}') for i, mass in enumerate(masses)]
    return lines + [line(*part) for part in parts] + [line('number', *each) for each in numbers]


def segment(n, at, duration, states, p, u, *happens):
    return [line('segment', n, at[0], at[1], duration, *states), line('state', *p, *u)] + [line(*each) for each in happens]


def done(n, at, p, u):
    return [line('done', n, *at, *p, *u)]


EVENT, CUT = ('end', 'event'), ('end', 'cut')


def ball(gravity=1.0):
    """A ball falls from 1/2 for one unit, bounces with restitution 1/2 for another, and is cut half way up again."""
    lines = head('ball', [1.0], [('force', 0, 0, gravity, 0.0), ('stop', 0, -1, 0.0, 0.5, 'floor')], [(0, -1, 0.0, 0.0)])
    lines += [line('start', 0, 0.0, -0.5, 0.0)]
    lines += segment(0, (0, 0.0), 1.0, ['open'], [-0.5], [0.0], EVENT, ('blow', 0), ('impact', 0, 1.0))
    lines += segment(1, (1, 0.0), 1.0, ['open'], [0.0], [-0.5], EVENT, ('blow', 0), ('impact', 0, 0.5))
    lines += segment(2, (2, 0.0), 0.25, ['open'], [0.0], [-0.25], CUT)
    return lines + done(3, (2, 0.25), [-0.03125], [0.0])


def dead_ball():
    """With restitution 0 it lies still."""
    lines = head('dead ball', [1.0], [('force', 0, 0, 1.0, 0.0), ('stop', 0, -1, 0.0, 0.0, 'floor')], [(0, -1, 0.0, 0.0)])
    lines += [line('start', 0, 0.0, -0.5, 0.0)]
    lines += segment(0, (0, 0.0), 1.0, ['open'], [-0.5], [0.0], EVENT, ('blow', 0), ('impact', 0, 1.0))
    lines += segment(1, (1, 0.0), 2.0, ['closed'], [0.0], [0.0], CUT)
    return lines + done(2, (3, 0.0), [0.0], [0.0])


def chatter():
    """The ball leaves its first impact at 1/2: flights of 1, 1/2, 1/4, .., then it lies still."""
    lines = head('chatter', [1.0], [('force', 0, 0, 1.0, 0.0), ('stop', 0, -1, 0.0, 0.5, 'floor')], [(0, -1, 0.0, 0.0)])
    lines += [line('start', 0, 0.0, -0.5, 0.0)]
    lines += segment(0, (0, 0.0), 1.0, ['open'], [-0.5], [0.0], EVENT, ('blow', 0), ('impact', 0, 1.0), ('chatter', 0))
    lines += segment(1, (1, 0.0), 2.0, ['closed'], [0.0], [0.0], ('end', 'chatter', 0))
    lines += segment(2, (3, 0.0), 1.0, ['closed'], [0.0], [0.0], CUT)
    return lines + done(3, (4, 0.0), [0.0], [0.0])


def rubbing(static=1.5):
    """A ball in a tube: weight 5/2, friction 3/2. It leaves the stop at 1, slowed by 4, and returns by 1: half as fast, and after the impact a
    quarter. Flights of 1/4 + 1/2 times the speed: one unit of time in all. At rest the stop and friction carry the weight."""
    lines = head('rubbing', [1.0], [('force', 0, 0, 2.5, 0.0), ('stop', 0, -1, 0.0, 0.5, 'floor'),
                                    ('friction', 0, -1, 0.0, static, 1.5, 'tube')], [(0, -1, 0.0, 0.0)])
    lines += [line('start', 0, 0.0, -2.0, 0.0)]
    lines += segment(0, (0, 0.0), 2.0, ['open', 'slip+'], [-2.0], [0.0], EVENT, ('blow', 0), ('impact', 0, 2.0), ('chatter', 0))
    lines += segment(1, (2, 0.0), 1.0, ['closed', 'stick'], [0.0], [0.0], ('end', 'chatter', 0))
    lines += segment(2, (3, 0.0), 1.0, ['closed', 'stick'], [0.0], [0.0], CUT)
    return lines + done(3, (4, 0.0), [0.0], [0.0])


def two_balls(spring=0.0, slower=1.0):
    """The ball of `chatter` twice, joined by a spring: it has no force while they move alike. The second may be of another weight, with all
    its speeds and places in proportion: its limit is the same."""
    parts = [('spring', 0, 1, spring), ('force', 0, 0, 1.0, 0.0), ('force', 1, 0, slower, 0.0), ('stop', 0, -1, 0.0, 0.5, 'floor'),
             ('stop', 1, -1, 0.0, 0.5, 'table')]
    lines = head('two balls', [1.0, 1.0], parts, [(0, -1, 0.0, 0.0), (1, -1, 0.0, 0.0)])
    lines += [line('start', 0, 0.0, -0.5, 0.0, -0.5 * slower, 0.0)]
    lines += segment(0, (0, 0.0), 1.0, ['open', 'open'], [-0.5, -0.5 * slower], [0.0, 0.0], EVENT, ('blow', 0, 1),
                     ('impact', 0, 1.0), ('impact', 1, slower), ('chatter', 0, 1))
    lines += segment(1, (1, 0.0), 2.0, ['closed', 'closed'], [0.0, 0.0], [0.0, 0.0], ('end', 'chatter', 0, 1))
    lines += segment(2, (3, 0.0), 1.0, ['closed', 'closed'], [0.0, 0.0], [0.0, 0.0], CUT)
    return lines + done(3, (4, 0.0), [0.0, 0.0], [0.0, 0.0])


def oscillator():
    """x'' = -x from x = 0, x' = 1 to a stop at x = 1/2 after pi/6, with restitution 0.8, and back."""
    lines = head('oscillator', [1.0], [('spring', 0, -1, 1.0), ('stop', 0, -1, 0.5, 0.8, 'wall')], [(0, -1, 0.5, 0.0)])
    hit, w = math.pi / 6.0, math.cos(math.pi / 6.0)
    u = -0.8 * w
    lines += [line('start', 0, 0.0, 0.0, 1.0)]
    lines += segment(0, (0, 0.0), hit, ['open'], [-0.5], [1.0], EVENT, ('blow', 0), ('impact', 0, w))
    lines += segment(1, (0, hit), 2.0, ['open'], [0.0], [u], CUT)
    end = [math.cos(2.0) / 2 + u * math.sin(2.0) - 0.5, u * math.cos(2.0) - math.sin(2.0) / 2]
    return lines + done(2, (2, hit), end[:1], end[1:])


def released(static=0.5):
    """A block on a belt of speed 1, held by friction of 1/2 until cos(theta) = 1/2, theta = 3 pi/2 .. 5 pi/3; then it slips:
    u' = cos(theta) - 1/2."""
    lines = head('belt', [1.0], [('force', 0, 1, 1.0, math.pi / 2), ('friction', 0, -1, 1.0, static, 0.5, 'belt')], [(0, -1, 0.0, 1.0)], omega=1.0)
    duration, fraction = math.pi / 6.0, 5.0 / 6.0
    lines += [line('start', 0, 0.75, 0.25, 1.0)]
    lines += segment(0, (0, 0.75), duration, ['stick'], [0.25], [0.0], EVENT)
    lines += segment(1, (0, fraction), 1.0, ['slip+'], [0.25 + duration], [0.0], CUT)
    at, s = 5.0 * math.pi / 3.0, 1.0
    u = math.sin(at + s) - math.sin(at) - s / 2
    p = 0.25 + duration + s - math.cos(at + s) + math.cos(at) - math.sin(at) * s - s * s / 4
    return lines + done(2, (0, fraction + 0.5 / math.pi), [p], [u])


def cradle(law='moreau'):
    """A body runs into another that touches a wall; all of mass 1, all restitutions 1. By Moreau's law both stops are struck at once: D = (2 -1; -1 1),
    v = (1, 0), P = 2 (1, 1): the first body comes back, the second one stays."""
    parts = [('stop', 0, 1, 0.0, 1.0, 'bodies'), ('stop', 1, -1, 0.0, 1.0, 'wall')]
    lines = head('cradle', [1.0, 1.0], parts, [(0, 1, 0.0, 0.0), (1, -1, 0.0, 0.0)], law=law)
    lines += [line('start', 0, 0.0, -1.0, 1.0, 0.0, 0.0)]
    first = [EVENT, ('blow', 0, 1), ('impact', 0, 1.0)]
    if law == 'sequence':
        first = [EVENT, ('blow', 0), ('blow', 1), ('blow', 0), ('impact', 0, 1.0), ('impact', 1, 1.0), ('impact', 0, 1.0)]
    lines += segment(0, (0, 0.0), 1.0, ['open', 'closed'], [-1.0, 0.0], [1.0, 0.0], *first)
    lines += segment(1, (1, 0.0), 1.0, ['open', 'closed'], [0.0, 0.0], [-1.0, 0.0], CUT)
    return lines + done(2, (2, 0.0), [-1.0, 0.0], [-1.0, 0.0])


def squeezed(pairs=30):
    """By Newton's law one after another, without restitution: a body at speed 1 pushes another against a wall, which stops it, and so on for ever:
    each pair of blows halves the speed. After `pairs` of them the bodies are called at rest."""
    parts = [('stop', 0, 1, 0.0, 0.0, 'bodies'), ('stop', 1, -1, 0.0, 0.0, 'wall')]
    lines = head('squeezed', [1.0, 1.0], parts, [(0, 1, 0.0, 0.0), (1, -1, 0.0, 0.0)], law='sequence')
    lines += [line('start', 0, 0.0, -1.0, 1.0, 0.0, 0.0)]
    blows = [('blow', k) for _ in range(pairs) for k in (0, 1)] + [('pile-up', 0, 1)]
    speeds = [('impact', k, 2.0 ** -(i + k)) for i in range(pairs) for k in (0, 1)]
    lines += segment(0, (0, 0.0), 1.0, ['open', 'closed'], [-1.0, 0.0], [1.0, 0.0], EVENT, *blows, *speeds)
    lines += segment(1, (1, 0.0), 1.0, ['closed', 'closed'], [0.0, 0.0], [0.0, 0.0], CUT)
    return lines + done(2, (2, 0.0), [0.0, 0.0], [0.0, 0.0])


def touching():
    """A ball thrown up by a force that turns back at the stop: gap = (s - 1)^2 / 2 touches zero. Whether it does rounding could not say."""
    lines = head('touching', [1.0], [('force', 0, 0, -1.0, 0.0), ('stop', 0, -1, 0.0, 0.5, 'ceiling')], [(0, -1, 0.0, 0.0)])
    lines += [line('start', 0, 0.0, -0.5, 1.0)]
    lines += segment(0, (0, 0.0), 1.0, ['open'], [-0.5], [1.0], EVENT)
    lines += segment(1, (1, 0.0), 1.0, ['open'], [0.0], [0.0], CUT)
    return lines + done(2, (2, 0.0), [-0.5], [-1.0])


def bumper():
    """A ball without weight reaches a spring of stiffness 1 beyond x = 1/2, stays in it for pi, and leaves as fast."""
    lines = head('bumper', [1.0], [('compliant', 0, -1, 0.5, 1.0, 0.0, 0, 'bumper')], [(0, -1, 0.5, 0.0)])
    lines += [line('start', 0, 0.0, 0.0, 1.0)]
    lines += segment(0, (0, 0.0), 0.5, ['off'], [-0.5], [1.0], EVENT)
    lines += segment(1, (0, 0.5), math.pi, ['on'], [0.0], [1.0], EVENT)
    lines += segment(2, (3, 0.5 + math.pi - 3.0), 1.0, ['off'], [0.0], [-1.0], CUT)
    return lines + done(3, (4, 0.5 + math.pi - 3.0), [-1.0], [-1.0])


def kink():
    """A body at speed 1 on a polyline: no force below x = 1/2, stiffness 1 above. It turns there and comes back."""
    lines = head('kink', [1.0], [('polyline', 0, -1, 'displacement', 0.0, 1.0, 1, 0.5, 0.0, 'kink')], [(0, -1, 0.0, 0.0)])
    lines += [line('start', 0, 0.0, 0.0, 1.0)]
    lines += segment(0, (0, 0.0), 0.5, [0], [0.0], [1.0], EVENT)
    lines += segment(1, (0, 0.5), math.pi, [1], [0.5], [1.0], EVENT)
    lines += segment(2, (3, 0.5 + math.pi - 3.0), 1.0, [0], [0.5], [-1.0], CUT)
    return lines + done(3, (4, 0.5 + math.pi - 3.0), [-0.5], [-1.0])


def stranded(slips=False):
    """A block slides up against a force of 3/4, slowed by kinetic friction of 1/4: it comes to rest after 1/2. Static friction of 1 holds it there.
    That it slides back at once (`slips`) Coulomb's law would allow; the rule is that it sticks."""
    lines = head('stranded', [1.0], [('force', 0, 0, 0.75, 0.0), ('friction', 0, -1, 0.0, 1.0, 0.25, 'slope')], [(0, -1, 0.0, 0.0)])
    lines += [line('start', 0, 0.0, 0.0, -0.5)]
    lines += segment(0, (0, 0.0), 0.5, ['slip-'], [0.0], [-0.5], EVENT)
    lines += segment(1, (0, 0.5), 1.0, ['slip+' if slips else 'stick'], [-0.125], [0.0], CUT)
    return lines + done(2, (1, 0.5), [0.125 if slips else -0.125], [0.5 if slips else 0.0])


def stack(upper):
    """A body on a body on the ground, pulled by 1: the ground cannot hold both (3/4). The upper one slips on the lower (kinetic friction 1/2), or
    both slip on the ground (kinetic friction 1/2) and the upper is held by 3/4 of 1. One contact slips in either."""
    parts = [('force', 0, 0, 1.0, 0.0), ('friction', 0, 1, 0.0, 1.0, 0.5, 'upper'), ('friction', 1, -1, 0.0, 0.75, 0.5, 'ground')]
    lines = head('stack', [1.0, 1.0], parts, [(0, 1, 0.0, 0.0), (1, -1, 0.0, 0.0)])
    lines += [line('start', 0, 0.0, 0.0, 0.0, 0.0, 0.0)]
    lines += segment(0, (0, 0.0), 1.0, ['slip+', 'stick'] if upper else ['stick', 'slip+'], [0.0, 0.0], [0.0, 0.0], CUT)
    return lines + done(1, (1, 0.0), *(([0.25, 0.0], [0.5, 0.0]) if upper else ([0.0, 0.125], [0.0, 0.25])))


def loop():
    """Three bodies that move together, each pair of them held by friction: under forces 3/4, -3/4, 0 the loop is redundant. The shares of least norm
    are 1/2, 1/4 and 1/4: the force 3/4 on the first body is 1/2 + 1/4."""
    lines = head('loop', [1.0, 1.0, 1.0], [('force', 0, 0, 0.75, 0.0), ('force', 1, 0, -0.75, 0.0)]
                 + [('friction', a, b, 0.0, 0.75, 0.75, f'f{a}{b}') for a, b in ((0, 1), (1, 2), (0, 2))],
                 [(0, 1, 0.0, 0.0), (1, 2, 0.0, 0.0), (2, -1, 0.0, 0.0), (0, 2, 0.0, 0.0)])
    lines += [line('start', 0, 0.0, 0.0, 0.5, 0.0, 0.5, 0.0, 0.5)]
    lines += segment(0, (0, 0.0), 1.0, ['stick'] * 3, [0.0] * 4, [0.0, 0.0, 0.5, 0.0], CUT)
    return lines + done(1, (1, 0.0), [0.0, 0.0, 0.5, 0.0], [0.0, 0.0, 0.5, 0.0])


def zone():
    """A body at speed 1 comes to a damper of coefficient 1 that acts beyond x = 1/2: there its speed is exp(-s)."""
    lines = head('zone', [1.0], [('polyline', 0, -1, 'zones', 0.0, 0.0, 1, 0.5, 1.0, 'zone')], [(0, -1, 0.0, 0.0)])
    lines += [line('start', 0, 0.0, 0.0, 1.0)]
    lines += segment(0, (0, 0.0), 0.5, [0], [0.0], [1.0], EVENT)
    lines += segment(1, (0, 0.5), 1.0, [1], [0.5], [1.0], CUT)
    return lines + done(2, (1, 0.5), [1.5 - math.exp(-1.0)], [math.exp(-1.0)])


def bounded():
    """A ball at speed 1 enters a spring of stiffness 1 with a damper of 4, bounded by the spring's force: it feels 2 delta, until 4 delta' = delta.
    Then spring and damper act: delta'' = -4 delta' - delta."""
    lines = head('bounded', [1.0], [('compliant', 0, -1, 0.5, 1.0, 4.0, 2, 'pad')], [(0, -1, 0.5, 0.0)])
    w, a, b = math.sqrt(2.0), -2.0 + math.sqrt(3.0), -2.0 - math.sqrt(3.0)
    s = math.atan(4.0 * w) / w
    p, u = math.sin(w * s) / w, math.cos(w * s)
    A, B = (u - b * p) / (a - b), (u - a * p) / (b - a)
    lines += [line('start', 0, 0.0, 0.0, 1.0)]
    lines += segment(0, (0, 0.0), 0.5, ['off'], [-0.5], [1.0], EVENT)
    lines += segment(1, (0, 0.5), s, ['bounded'], [0.0], [1.0], EVENT)
    at = 0.5 + s
    lines += segment(2, (int(at), at - int(at)), 0.125, ['on'], [p], [u], CUT)
    end = [A * math.exp(a / 8) + B * math.exp(b / 8), a * A * math.exp(a / 8) + b * B * math.exp(b / 8)]
    at += 0.125
    return lines + done(3, (int(at), at - int(at)), end[:1], end[1:])


def two_restitutions():
    """A ball whose restitution is 1/2 up to a speed of 1/2, and falls to 1/4 at 3/2: 3/8 at the first impact, whose speed is 1, then 1/2."""
    parts = [('force', 0, 0, 1.0, 0.0), ('stop', 0, -1, 0.0, 0.5, 2, 0.5, 0.5, 1.5, 0.25, 'floor')]
    lines = head('two restitutions', [1.0], parts, [(0, -1, 0.0, 0.0)]) + [line('start', 0, 0.0, -0.5, 0.0)]
    lines += segment(0, (0, 0.0), 1.0, ['open'], [-0.5], [0.0], EVENT, ('blow', 0), ('impact', 0, 1.0))
    lines += segment(1, (1, 0.0), 0.75, ['open'], [0.0], [-0.375], EVENT, ('blow', 0), ('impact', 0, 0.375))
    lines += segment(2, (1, 0.75), 0.25, ['open'], [0.0], [-0.1875], CUT)
    return lines + done(3, (2, 0.0), [-0.015625], [0.0625])


def lifted():
    """A block that slides is pressed by 1 - y, y the path of a body at speed 1: after one unit of time nothing presses it any more."""
    parts = [('friction', 0, -1, 0.0, 0.5, 0.5, 'sole'), ('normal', 0, 1.0, -1, 1, 1, -1.0, 0.0)]
    lines = head('lifted', [1.0, 1.0], parts, [(0, -1, 0.0, 0.0), (1, -1, 0.0, 0.0)]) + [line('start', 0, 0.0, 0.0, 1.0, 0.0, 1.0)]
    lines += segment(0, (0, 0.0), 1.0, ['slip+'], [0.0, 0.0], [1.0, 1.0], EVENT)
    lines += segment(1, (1, 0.0), 1.0, ['unloaded'], [5.0 / 6.0, 1.0], [0.75, 1.0], CUT)
    return lines + done(2, (2, 0.0), [5.0 / 6.0 + 0.75, 2.0], [0.75, 1.0])


def pressed_by_a_spring():
    """A block at rest, pulled by 1/4, under a spring of force 4 that a second body, at rest too, leans against: held by a static coefficient of 1/8."""
    parts = [('force', 0, 0, 0.25, 0.0), ('force', 1, 0, 4.0, 0.0), ('friction', 0, -1, 0.0, 0.125, 0.125, 'sole'), ('compliant', 1, -1, 0.0, 8.0, 0.0, 0, 'pad'),
             ('normal', 0, 0.0, 0, 0)]
    lines = head('pressed', [1.0, 1.0], parts, [(1, -1, 0.0, 0.0), (0, -1, 0.0, 0.0)]) + [line('start', 0, 0.0, 0.0, 0.0, 0.5, 0.0)]
    return lines + segment(0, (0, 0.0), 1.0, ['stick', 'on'], [0.5, 0.0], [0.0, 0.0], CUT) + done(1, (1, 0.0), [0.5, 0.0], [0.0, 0.0])
