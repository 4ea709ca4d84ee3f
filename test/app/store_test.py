#!/usr/bin/env python3
"""Stores of long runs: no death loses a finished pixel, no damage goes unnoticed, no two runs are mixed.

    store_test.py PROGRAM CASE
"""
import glob
import os
import re
import signal
import subprocess
import time

from beside import Beside, bytes_of
from program import PROGRAM, good, main, read, refused, run, says, table

CHART = ('map', 'vibro-impact', '--x', 'omega=1:6:40', '--y', 'friction=0.05:0.3:30')
CARRY = (*CHART, '--start', 'carry', '--direction', 'both')


def hash_of(text):
    return re.search('"hash": "([0-9a-f]{16})"', text).group(1)


def done_in(text):
    return int(re.search('"done": ([0-9]+)', text).group(1))


class Numbers:
    """A row of numbers below `most` that looks random: the same at every run."""

    def __init__(self, seed):
        self.state = seed

    def below(self, most):
        self.state = (6364136223846793005 * self.state + 1442695040888963407) % 2 ** 64
        return (self.state >> 33) % most


def grown(name, size=40000):
    """For `until`: so much more is written for a store, with 40 kB the first tiles. No program is asked: the run would end meanwhile."""
    most = bytes_of(name) + size
    return lambda: bytes_of(name) >= most


def done_now(name):
    found = run('store', 'info', name)
    return done_in(found.out) if found.status == 0 else 0


def remove_all(start):
    for name in glob.glob(glob.escape(start) + '*'):
        os.remove(name)


def killed(words, name, size):
    """Killed when it has written so many bytes, or a moment later. Returns whether that hit a run at work."""
    process = Beside(*words, '--store', name, '--resume')
    process.until(grown(name, size))
    time.sleep(size % 8 / 1000)  # not only just after a write
    if not process.ended():
        os.kill(process.pid, signal.SIGKILL)
    return process.outcome().status == -signal.SIGKILL


def kill_often(words, kills, seed, share):
    """Resumed after each of so many kills that hit a run at work, within a share of what it writes; what was there stays there."""
    whole = good(*words, '--store', 'whole.db')
    written = 4 * os.path.getsize('whole.db')  # the log holds each page several times
    numbers, seen, hits = Numbers(seed), 0, 0
    while hits < kills:
        hits += killed(words, 'part.db', int(share * written * numbers.below(1000) / 1000))
        if os.path.exists('part.db'):
            found = run('store', 'info', 'part.db')
            if found.status == 0:  # else it died before it began
                assert done_in(found.out) >= seen, 'finished pixels are lost'
                seen = done_in(found.out)
                if seen == done_in(whole):
                    os.remove('part.db')
                    seen = 0
            else:
                assert seen == 0, found.err
    assert hash_of(good(*words, '--store', 'part.db', '--resume')) == hash_of(whole)


def test_killed_runs_lose_nothing_and_end_with_the_same_hash():
    kill_often(CHART, 4, 1, 0.8)
    os.remove('whole.db'), os.remove('part.db')
    kill_often(CARRY, 3, 2, 0.8)


def test_two_hundred_kills():
    kill_often(CHART, 120, 3, 0.6)
    os.remove('whole.db'), os.remove('part.db')
    kill_often(CARRY, 80, 4, 0.6)


def test_a_refined_run_resumes_with_the_same_hash_and_exports_what_it_would_have_written():
    refined = (*CHART, '--refine', '8')
    kill_often(refined, 3, 5, 0.5)
    whole = good('store', 'info', 'whole.db')
    assert '"complete": true' in whole and 0 < done_in(whole) < 1200
    done = run('store', 'export', 'part.db', '--out', 'a.csv', '--plot', 'a.png', '--show', 'class,computed')
    assert done.status == 0, done.err
    says(done.err, '%d of 1200 pixels' % done_in(whole), 'filled in')
    assert run(*refined, '--out', 'b.csv').status == 0
    assert read('a.csv') == read('b.csv')
    says(refused(2, *CHART, '--store', 'part.db', '--resume'), 'another run')


def test_an_interrupted_run_resumes_and_says_how():
    done = None
    while done is None or done_in(done.out) == 1200:  # until it is caught at work
        remove_all('a.db')
        process = Beside(*CHART, '--store', 'a.db')
        done = process.signalled(signal.SIGTERM) if process.until(grown('a.db')) else process.outcome()
    assert done.status == 130, (done.status, done.err)
    says(done.err, '--resume')
    assert 0 < done_in(done.out) < 1200 and not os.path.exists('a.db-wal')
    assert hash_of(good(*CHART, '--store', 'a.db', '--resume')) == hash_of(good(*CHART, '--store', 'b.db'))


def test_shards_in_any_order_are_the_whole_and_duplicates_must_be_equal():
    whole = hash_of(good(*CHART, '--store', 'whole.db'))
    for shard in '123':
        good(*CHART, '--shard', shard + '/3', '--store', shard + '.db')
    for order in ('123', '312', '21131'):
        assert hash_of(good('store', 'merge', *(shard + '.db' for shard in order), '--out', order + '.db')) == whole
    good('store', 'merge', '1.db', 'whole.db', '--out', 'both.db')
    assert '"complete": false' in good('store', 'merge', '1.db', '3.db', '--out', 'part.db')
    good(*CHART, '--periods', '200', '--store', 'other.db')
    says(refused(2, 'store', 'merge', '1.db', 'other.db', '--out', 'no.db'), 'other.db', 'another run')


def test_a_store_is_not_mixed_with_another_run():
    good(*CHART, '--shard', '1/40', '--store', 'a.db')
    again = (*CHART, '--shard', '1/40', '--store', 'a.db')
    says(refused(2, *again), 'a.db', '--resume')
    good(*again, '--resume')
    good(*again, '--resume', '--set', 'restitution=0.8')  # what it is without --set too
    says(refused(2, *again, '--resume', '--periods', '200'), "'300'", "'200'", "'--periods'")
    says(refused(2, *again, '--resume', '--set', 'restitution=0.7'), 'model', '0.7')
    says(refused(2, *CHART, '--shard', '2/40', '--store', 'a.db', '--resume'), 'shard')
    says(refused(2, *CHART, '--shard', '1/40'), '--shard', '--store')
    says(refused(2, *CHART, '--resume'), '--resume', '--store')
    says(refused(2, *CHART, '--shard', '3/2', '--store', 'b.db'), '--shard')
    with open('text.db', 'w', encoding='utf-8') as file:
        file.write('this is no database, but a text that is long enough to be taken for one by its size. ' * 50)
    says(refused(4, *CHART, '--store', 'text.db', '--resume'), 'text.db')
    says(refused(4, 'store', 'info', 'text.db'), 'text.db')
    says(refused(4, 'store', 'info', 'none.db'), 'none.db')
    says(refused(2, 'store', 'look', 'a.db'), 'info, merge or export')


def test_a_killed_diagram_resumes_with_its_bytes():
    """Impacts, statistics and values at instants; the state is carried, so that a wrong start shows."""
    diagram = ('diagram', 'vibro-impact', '--sweep', 'omega=0.6:7:300', '--direction', 'both', '--transient', '200', '--impacts', '40')
    in_lanes = diagram[:4] + ('--start', 'reset') + diagram[6:]
    cases = ((diagram, ()), (diagram[:-2], ('--y', 'w:q95,x1:rms')), (diagram, ('--y', 'x1,v1', '--at', 'period')), (in_lanes, ()))
    for words, more in cases:
        whole = good(*words, *more, '--store', 'whole.db')
        for share in (0, 0.3, 0.3):  # the log of a run is larger than its store
            while not killed((*words, *more), 'a.db', 1 + int(share * os.path.getsize('whole.db'))):
                remove_all('a.db')
        assert good(*words, *more, '--store', 'a.db', '--resume') == whole
        assert good(*words, *more, '--store', 'a.db', '--resume', '--threads', '1') == whole
        says(refused(2, *words, *more, '--store', 'a.db', '--resume', '--set', 'restitution=0.7'), 'model', '0.7')
        remove_all('a.db'), remove_all('whole.db')
    says(refused(2, *diagram, '--resume'), '--resume', '--store')


def test_a_second_writer_is_refused_and_a_reader_is_not():
    endless = ('map', 'vibro-impact', '--x', 'omega=1:6:2000', '--y', 'friction=0.05:0.3:2000', '--level', 'full', '--store', 'a.db')
    process = Beside(*endless)
    assert process.until(lambda: run('store', 'info', 'a.db').status == 0), process.err()
    says(refused(4, *endless, '--resume'), 'a.db', 'another run writes it')
    assert done_in(good('store', 'info', 'a.db')) < 4000000
    assert not process.ended(), process.err()
    assert process.signalled(signal.SIGTERM).status == 130


def test_a_full_disk_ends_the_run_and_loses_nothing():
    line = 'trap "" XFSZ; ulimit -f 240; exec "$@"'  # files of 120 kB at most
    done = subprocess.run(['sh', '-c', line, 'sh', PROGRAM, *CHART, '--store', 'a.db'], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    assert done.returncode == 4, (done.returncode, done.stderr)
    says(done.stderr.decode(), "cannot write 'a.db'")
    part = done_in(good('store', 'info', 'a.db'))
    assert 0 < part < 1200
    assert hash_of(good(*CHART, '--store', 'a.db', '--resume')) == hash_of(good(*CHART, '--store', 'b.db'))


def test_changed_bytes_are_noticed():
    small = (*CHART[:2], '--x', 'omega=1:6:8', '--y', 'friction=0.1:0.3:5', '--store', 'a.db')
    whole = hash_of(good(*small))
    with open('a.db', 'rb') as file:
        sound = file.read()
    numbers, noticed = Numbers(5), 0
    for _ in range(150):
        place, bit = numbers.below(len(sound)), 1 << numbers.below(8)
        with open('b.db', 'wb') as file:
            file.write(sound[:place] + bytes([sound[place] ^ bit]) + sound[place + 1:])
        found = run('store', 'info', 'b.db')
        if found.status == 0:
            assert hash_of(found.out) == whole, 'a wrong store is taken for a right one: byte %d, bit %d' % (place, bit)
        else:
            assert found.status == 4 and found.out == '', (found.status, found.err)
            noticed += 1
    assert noticed > 20, noticed  # the rest lies in free space of pages
    for length in (0, 100, 4096, len(sound) // 2, len(sound) - 1):
        with open('b.db', 'wb') as file:
            file.write(sound[:length])
        found = run('store', 'info', 'b.db')
        assert found.status == 4, (length, found.out)


def test_a_page_in_the_place_of_another_is_noticed_by_all_who_read():
    """Every page twice, over its neighbour, and gone: each cell that is left is sound, and others are lost."""
    small = (*CHART[:2], '--x', 'omega=1:6:20', '--y', 'friction=0.05:0.3:12')
    good(*small, '--store', 'a.db')
    whole, size = good('store', 'export', 'a.db'), 4096
    with open('a.db', 'rb') as file:
        sound = file.read()
    pages = [sound[at:at + size] for at in range(0, len(sound), size)]
    noticed = 0
    for i in range(len(pages)):
        for wrong in (pages[:i] + [pages[i]] + pages[i:], pages[:i] + [pages[i - 1]] + pages[i + 1:], pages[:i] + pages[i + 1:]):
            remove_all('b.db')
            with open('b.db', 'wb') as file:
                file.write(b''.join(wrong))
            found = run('store', 'export', 'b.db')
            assert found.status == 4 or found.out == whole, 'page %d of %d' % (i, len(pages))
            noticed += found.status == 4
            resumed = run(*small, '--store', 'b.db', '--resume', '--out', 'b.csv')
            assert resumed.status == 4 or read('b.csv') == whole, 'page %d of %d' % (i, len(pages))
    assert noticed > 2 * len(pages), (noticed, len(pages))


def test_an_export_is_what_the_run_itself_would_have_written():
    good(*CARRY, '--of', 'x1:rms', '--store', 'a.db')
    good('store', 'export', 'a.db', '--out', 'a.csv', '--plot', 'a.png')
    assert read('a.csv') == good(*CARRY, '--of', 'x1:rms') == good('store', 'export', 'a.db')
    assert len(table(read('a.csv'))[1]) == 2400
    good(*CARRY, '--of', 'x1:rms', '--out', 'b.h5')
    good('store', 'export', 'a.db', '--out', 'a.h5')
    with open('a.h5', 'rb') as a, open('b.h5', 'rb') as b:
        assert a.read() == b.read()


def test_the_script_of_a_cluster_does_the_whole_also_where_a_task_is_killed():
    """Each task as Slurm would run it, without Slurm; `./dev cluster` has the real one."""
    os.mkdir("it's here")
    script = good(*CHART, '--slurm', '3', '--store', "it's here/chart.db", '--out', 'chart.csv')
    with open('chart.sh', 'w', encoding='utf-8') as file:
        file.write(script)
    says(script, '#SBATCH --array=1-3', '#SBATCH --requeue', "it'\\''s here")
    task = lambda number, **options: Beside('chart.sh', number, command=('bash',), **options)  # noqa: E731
    assert task('3').outcome().status == 0
    shard, done = "it's here/chart-1.db", 0
    while not 0 < done < 400:  # until it is killed at work
        remove_all(shard[:-3])
        ended = task('1', start_new_session=True)
        if ended.until(grown(shard)):
            os.killpg(ended.pid, signal.SIGKILL)
        ended.outcome()
        done = done_now(shard)
    stopped = task('1')
    if stopped.until(grown(shard)):
        os.kill(stopped.pid, signal.SIGTERM)
    assert stopped.outcome().status in (0, 130, 143)
    assert not os.path.exists("it's here/chart.db")
    both = [task('1'), task('2')]
    assert [one.outcome().status for one in both] == [0, 0]
    assert hash_of(good('store', 'info', "it's here/chart.db")) == hash_of(good(*CHART, '--store', 'b.db'))
    assert read('chart.csv') == good('store', 'export', 'b.db')
    says(refused(2, *CHART, '--slurm', '3'), '--slurm', '--store')
    says(refused(2, *CHART, '--slurm', '3', '--store', 'c.db', '--shard', '1/2'), '--shard')
    says(refused(2, *CHART, '--slurm', '0', '--store', 'c.db'), '--slurm')


if __name__ == '__main__':
    main(globals())
