"""Several threads at once: the GIL is released, and results are those of one thread."""

import threading
import time
from concurrent.futures import ThreadPoolExecutor

import slapstick
from beside import doubled

MODEL = slapstick.load("vibro-impact")
OMEGAS = [0.8 + 0.1 * i for i in range(24)]


def turns_during(periods):
    """How often another thread of Python gets its turn while the library works."""
    turns, stop = 0, threading.Event()

    def count():
        nonlocal turns
        while not stop.is_set():
            turns += 1
            time.sleep(0.001)

    other = threading.Thread(target=count)
    other.start()
    before = turns
    slapstick.simulate(MODEL, periods=periods, samples=0)
    during = turns - before
    stop.set()
    other.join()
    return during


def test_python_goes_on_while_the_library_works():
    doubled(lambda periods: turns_during(periods) > 50)  # with the GIL held there would be one or two, however long it works


def test_threads_that_share_a_model_get_the_results_of_one_thread():
    def work(omega):
        orbit = slapstick.simulate(MODEL, periods=60, samples=20, omega=omega)
        return slapstick.classify(MODEL, omega=omega).label, orbit.y.tobytes(), orbit.events.t.tobytes()

    alone = [work(omega) for omega in OMEGAS]
    with ThreadPoolExecutor(6) as pool:
        assert list(pool.map(work, OMEGAS)) == alone


def test_diagrams_and_branches_from_two_threads_at_once():
    def diagram(_):
        return slapstick.diagram(MODEL, omega=(2.6, 3.1, 8), impacts=10).w.tobytes()

    def branch(_):
        return slapstick.continuation(MODEL, "omega", (2.6, 2.9), orbit="1-1", omega=2.7).value.tobytes()

    with ThreadPoolExecutor(4) as pool:
        diagrams, branches = list(pool.map(diagram, range(4))), list(pool.map(branch, range(4)))
    assert set(diagrams) == {diagram(0)} and set(branches) == {branch(0)}
