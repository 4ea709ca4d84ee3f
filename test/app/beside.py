"""Runs of the program beside a test, which waits for what a run does and never for seconds.

What is done after a signal is told by CPU time, beside that of a fixed piece of work in the same test.
"""
import os
import signal
import subprocess
import tempfile
import time

from program import HANGS, PROGRAM, Outcome

TICK = 1 / os.sysconf('SC_CLK_TCK')


class Beside:
    """A run that goes on while the test does something else. What it prints lies in files: no pipe is ever full."""

    def __init__(self, *words, command=(PROGRAM,), **options):
        # pylint: disable=consider-using-with
        self._out, self._err = tempfile.TemporaryFile(), tempfile.TemporaryFile()
        self._process = subprocess.Popen([*command, *words], stdin=subprocess.DEVNULL, stdout=self._out, stderr=self._err, **options)
        self._hangs = time.monotonic() + HANGS
        self.pid = self._process.pid
        self.status = None  # until it has ended; negative: the signal that ended it
        self._used = 0.0

    def ended(self, how=os.WNOHANG):
        if self.status is None:
            pid, status, usage = os.wait4(self.pid, how)
            if pid == self.pid:
                self.status = self._process.returncode = os.WEXITSTATUS(status) if os.WIFEXITED(status) else -os.WTERMSIG(status)
                self._used = usage.ru_utime + usage.ru_stime
        return self.status is not None

    def until(self, condition):
        """Waits for it. Returns whether it came true before the run ended."""
        while not condition():
            if self.ended():
                return False
            assert time.monotonic() < self._hangs, 'the test hangs: what it waits for does not come'
            time.sleep(0.001)
        return not self.ended()

    def cpu(self):
        """Seconds of CPU until now, all threads; after the end also those of programs that it has waited for."""
        if self.ended():
            return self._used
        fields = self._stat()
        return TICK * (int(fields[11]) + int(fields[12]))

    def works(self):
        """Has it come from its start to its work? It has used several times the CPU time of a run without work."""
        return self.cpu() > max(0.05, 4 * cpu_of('simulate', 'vibro-impact', '--periods', '0'))

    def err(self):
        return text_of(self._err)

    def stand_still(self):
        """Returns once no thread of it runs any more."""
        os.kill(self.pid, signal.SIGSTOP)
        self.until(lambda: self._stat()[0] in 'TZ')

    def signalled(self, *numbers):
        """Its outcome after these signals, which arrive together; `cpu` is what it has used since."""
        self.stand_still()
        before = self.cpu()
        if not self.ended():
            for number in (*numbers, signal.SIGCONT):
                os.kill(self.pid, number)
        done = self.outcome()
        done.cpu -= before
        return done

    def outcome(self):
        """Its outcome at its own end; `cpu` is what it has used."""
        self.until(lambda: False)
        done = Outcome(self.status, text_of(self._out), self.err())
        done.cpu = self.cpu()
        return done

    def _stat(self):
        with open(f'/proc/{self.pid}/stat', encoding='utf-8') as file:
            return file.read().rpartition(') ')[2].split()


def text_of(file):
    return os.pread(file.fileno(), os.fstat(file.fileno()).st_size, 0).decode()


_used = {}


def cpu_of(*words):
    """Seconds of CPU of a run, the least of three."""
    if words not in _used:
        runs = []
        for _ in range(3):
            runs.append(Beside(*words))
            assert runs[-1].outcome().status == 0, (words, runs[-1].err())
        _used[words] = min(one.cpu() for one in runs)
    return _used[words]


def second():
    """CPU time of what takes a second on a machine of 2023: the promises to a person at the keyboard are in it."""
    return 3 * cpu_of('simulate', 'vibro-impact', '--periods', '250000')


def shows_progress(run):
    """For `until`: the run has printed how far it is, so it is at work."""
    return lambda: '/s, ' in run.err()


def bytes_of(name):
    """How much has been written for a file: also to the temporary one beside it, or to the log of a store."""
    folder, start = os.path.split(name)
    total = 0
    for one in os.scandir(folder or '.'):
        if one.name.startswith(start) and not one.name.endswith('-shm'):
            try:
                total += one.stat().st_size
            except FileNotFoundError:  # between the two looks
                pass
    return total
