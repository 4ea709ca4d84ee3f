"""heyoka (Biscani and Izzo, MNRAS 504:2614, 2021) as a peer: the paper's oscillator by Taylor's method, events by its own detection.

A worker of bench/ratios.py: reads `KIND OMEGA PERIODS` from standard input, a line a run, and answers each with one line of `key=value`.
KIND is `scalar` (one trajectory) or `batch` (as many as the SIMD width, at omega (1 + 1e-3 k) each, so that lanes do not march in step).
Integrators are compiled once a process. Nothing of the compilation is in the times: each is CPU time of this process.

Relative coordinates as in bench/paper_oscillator.hpp: y = x1 - x2, w = y'. `hold` is 1 while the contact sticks, and on the closed stop `stop` too:
one right-hand side serves all modes, the parameters choose. An event of another mode is a constant.
"""
import math
import sys
import time

import heyoka as hy
import numpy as np

MASS, STIFFNESS, DASHPOT, DAMPING = 10.0, 5.0, 5.0, 0.1
STATIC = KINETIC = 0.15
RESTITUTION = 0.8
REST_SPEED = 1e-9  # as bench/peers.hpp: an impact that leaves slower ends the chatter
# An event is zero at its own instant. A reversal is zero at a release too, with a slope that rounding decides.
# heyoka would take the time to look away from that slope, and look away for good.
# All guards here come back to their zeros from the other side, so a moment is enough.
COOLDOWN = 1e-10
AT_LIMIT = 1.0 - 1e-10  # a contact that was just released does not hold at once: above the rounding of the time and of the force
START = (-0.5, 0.0, 0.0, 0.0)
FRICTION, HOLD, STOP, OMEGA = range(4)  # parameters


def holding_force(state, sine):
    """Eq. (6): positive when it pushes M1 in the -x direction."""
    base = 2.0 * DAMPING * DASHPOT * state[3] + STIFFNESS * state[2]
    return (MASS * sine + base) / (1.0 + MASS) - state[0]


def after_rest(state, parameters, t):
    """The mode after w = 0, into the parameters."""
    state[1] = 0.0
    force = holding_force(state, math.sin(parameters[OMEGA] * t))
    stop = state[0] >= 0.0
    if stop:
        state[0] = 0.0
    holds = force > -STATIC * AT_LIMIT if stop else abs(force) < STATIC * AT_LIMIT
    sign = 1.0 if force > 0.0 and not stop else -1.0
    parameters[FRICTION] = 0.0 if holds else sign * KINETIC
    parameters[HOLD] = 1.0 if holds else 0.0
    parameters[STOP] = 1.0 if holds and stop else 0.0


def impact(state, parameters, t):
    """Eq. (7), or the end of a chatter."""
    w = state[1]
    ends = RESTITUTION * w <= REST_SPEED
    state[3] += (1.0 + (0.0 if ends else RESTITUTION)) * w / (1.0 + MASS)
    state[0] = 0.0
    if ends:
        after_rest(state, parameters, t)
    else:
        state[1] = -RESTITUTION * w
        parameters[FRICTION] = -KINETIC


def release(state, parameters, t):
    force = holding_force(state, math.sin(parameters[OMEGA] * t))
    parameters[FRICTION] = KINETIC if force > 0.0 else -KINETIC
    parameters[HOLD] = parameters[STOP] = 0.0


def right_hand_side():
    y, w, x2, v2 = hy.make_vars("y", "w", "x2", "v2")
    friction, hold, omega = hy.par[FRICTION], hy.par[HOLD], hy.par[OMEGA]
    sine = hy.sin(omega * hy.time)
    base_force = 2.0 * DAMPING * DASHPOT * v2 + STIFFNESS * x2
    coupling = 2.0 * DAMPING * w + y + friction
    base = (coupling - base_force) / MASS
    free = 1.0 - hold
    system = [(y, w), (w, free * (sine - coupling - base)), (x2, v2), (v2, free * base + hold * (sine - base_force) / (1.0 + MASS))]
    force = (MASS * sine + base_force) / (1.0 + MASS) - y
    return system, (y, w, force)


def events(kind, make, count):
    """Contact, reversal, and the two limits of the holding force. `count`: what the callbacks count into."""
    _, (y, w, force) = right_hand_side()
    hold, stop = hy.par[HOLD], hy.par[STOP]
    free = 1.0 - hold

    def handled(handle, name):
        def scalar(ta, sign):
            count[name] += 1
            handle(ta.state, ta.pars, ta.time)
            return True

        def batch(ta, sign, lane):
            count[name] += 1
            handle(ta.state[:, lane], ta.pars[:, lane], ta.time[lane])
            return True

        return scalar if kind == "scalar" else batch

    rising, falling = hy.event_direction.positive, hy.event_direction.negative
    return [
        make(free * y - hold, callback=handled(impact, "impacts"), direction=rising, cooldown=COOLDOWN),
        make(free * (hy.par[FRICTION] / KINETIC) * w + hold, callback=handled(after_rest, "reversals"), direction=falling, cooldown=COOLDOWN),
        make(hold * (1.0 - stop) * (force - STATIC) - free - stop, callback=handled(release, "releases"), direction=rising, cooldown=COOLDOWN),
        make(hold * (force + STATIC) + free, callback=handled(release, "releases"), direction=falling, cooldown=COOLDOWN),
    ]


class Scalar:
    def __init__(self, tolerance):
        self.count = dict(impacts=0, reversals=0, releases=0)
        self.integrator = hy.taylor_adaptive(right_hand_side()[0], list(START), pars=[0.0] * 4, tol=tolerance,
                                             t_events=events("scalar", hy.t_event, self.count))

    def run(self, omega, periods):
        ta = self.integrator
        ta.reset_cooldowns()
        ta.time = 0.0
        ta.state[:] = START
        ta.pars[:] = (0.0, 0.0, 0.0, omega)
        after_rest(ta.state, ta.pars, 0.0)
        self.count.update(impacts=0, reversals=0, releases=0)
        begun = time.process_time()
        outcome, _, _, steps, _, _ = ta.propagate_until(periods * 2.0 * math.pi / omega)
        spent = time.process_time() - begun
        if outcome != hy.taylor_outcome.time_limit:
            raise RuntimeError(f"heyoka ends with {outcome}")
        return dict(cpu=spent, trajectories=1, steps=steps, **self.count)


class Batch:
    def __init__(self, tolerance):
        self.width = hy.recommended_simd_size()
        self.count = dict(impacts=0, reversals=0, releases=0)
        state = np.repeat(np.array(START)[:, None], self.width, axis=1)
        self.integrator = hy.taylor_adaptive_batch(right_hand_side()[0], state, pars=np.zeros((4, self.width)), tol=tolerance,
                                                   t_events=events("batch", hy.t_event_batch, self.count))

    def run(self, omega, periods):
        ta, width = self.integrator, self.width
        ta.reset_cooldowns()
        ta.set_time(np.zeros(width))
        omegas = omega * (1.0 + 1e-3 * np.arange(width))
        for lane in range(width):
            state, parameters = np.array(START), np.array([0.0, 0.0, 0.0, omegas[lane]])
            after_rest(state, parameters, 0.0)
            ta.state[:, lane], ta.pars[:, lane] = state, parameters
        self.count.update(impacts=0, reversals=0, releases=0)
        begun = time.process_time()
        ta.propagate_until(periods * 2.0 * math.pi / omegas)
        spent = time.process_time() - begun
        if any(r[0] != hy.taylor_outcome.time_limit for r in ta.propagate_res):
            raise RuntimeError(f"heyoka's batch ends with {ta.propagate_res}")
        return dict(cpu=spent, trajectories=width, steps=sum(r[3] for r in ta.propagate_res), **self.count)


def main():
    tolerance = 1e-15
    made = {}
    for line in sys.stdin:
        kind, omega, periods = line.split()
        if kind not in made:
            made[kind] = dict(scalar=Scalar, batch=Batch)[kind](tolerance)
        answer = made[kind].run(float(omega), int(periods))
        print(" ".join(f"{key}={value}" for key, value in answer.items()), flush=True)


if __name__ == "__main__":
    main()
