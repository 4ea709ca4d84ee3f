"""Programs beside a test: CPU time instead of seconds, so that a slow or busy machine changes no verdict."""

import functools
import os
import signal
import time

import slapstick

HANGS = 600  # seconds: a guard against what hangs; no test says with it how fast something is
TICK = 1 / os.sysconf("SC_CLK_TCK")


@functools.cache
def work():
    """CPU seconds of 50 000 periods of vibro-impact, the least of three: 0.1 on the machine where limits were set."""

    def once():
        begin = time.process_time()
        slapstick.simulate("vibro-impact", periods=50_000, samples=0)
        return time.process_time() - begin

    return min(once() for _ in range(3))


def fields(pid):
    with open(f"/proc/{pid}/stat", encoding="utf-8") as file:
        return file.read().rpartition(") ")[2].split()


def cpu_of(pid):
    """CPU seconds of a process until now, all its threads."""
    return TICK * (int(fields(pid)[11]) + int(fields(pid)[12]))


def wait_until(condition, running=None):
    """Waits for it; `running` must not end before."""
    end = time.monotonic() + HANGS
    while not condition():
        assert running is None or running.poll() is None, running.communicate()
        assert time.monotonic() < end, "what the test waits for does not come"
        time.sleep(0.005)


def interrupt(running):
    """Ctrl-C for a process that stands still. Returns the CPU seconds that it has used until then."""
    running.send_signal(signal.SIGSTOP)
    wait_until(lambda: fields(running.pid)[0] == "T", running)
    used = cpu_of(running.pid)
    running.send_signal(signal.SIGINT)
    running.send_signal(signal.SIGCONT)
    return used


def doubled(work_of, periods=20_000):
    """Calls work_of(periods), each time with twice as many, until it says that this was long enough."""
    while not work_of(periods):
        periods *= 2
        assert periods < 20_000_000, "it does not happen, however long the work is"
