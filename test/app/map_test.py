#!/usr/bin/env python3
"""slapstick map: its table, its picture, its refusals, its end on a signal.

    map_test.py PROGRAM CASE
"""
import math
import os
import re
import signal
import struct
import zlib

from beside import Beside, second, shows_progress
from program import good, main, read, refused, run, says, table

PAPER = ('map', 'vibro-impact', '--x', 'omega=1.2:3:5', '--y', 'friction=0.1:0.3:3')


def test_rows_are_pixels_from_the_lowest_row_on_and_say_what_classify_says():
    columns, rows = table(good(*PAPER))
    assert columns[:8] == ['x', 'y', 'class', 'attractor', 'n', 'p', 'chatter', 'exponent']
    assert [float(row[1]) for row in rows] == [0.1] * 5 + [0.2] * 5 + [0.3] * 5
    assert [float(row[0]) for row in rows[:5]] == [1.2, 1.65, 2.1, 2.55, 3.0]
    for row in rows[::4]:
        alone = good('classify', 'vibro-impact', '--set', 'omega=' + row[0], '--set', 'friction=' + row[1], '--quick', '300')
        assert '"class": "%s"' % row[2] in alone
        assert row[3] == re.search('"attractor": "([^"]*)"', alone).group(1)
        exponent = re.search('"exponent": ([-0-9.e]+)', alone)
        assert abs(float(exponent.group(1)) - float(row[7])) < 1e-8 if exponent else math.isnan(float(row[7]))  # two kernels, two roundings


def test_the_same_bytes_for_any_number_of_threads_and_in_every_format():
    one = good(*PAPER, '--threads', '1', '--of', 'x1:rms')
    assert one == good(*PAPER, '--threads', '3', '--of', 'x1:rms')
    assert ',x1:rms,' in one.splitlines()[0]
    for ending in ('npz', 'h5'):
        for file in ('a', 'b'):
            good(*PAPER, '--out', f'{file}.{ending}', '--threads', '1' if file == 'a' else '2')
        with open('a.' + ending, 'rb') as a, open('b.' + ending, 'rb') as b:
            assert a.read() == b.read()


def test_starts_are_told_apart():
    columns, rows = table(good(*PAPER, '--start', 'carry', '--direction', 'both'))
    assert len(rows) == 30 and [row[columns.index('direction')] for row in rows] == ['up'] * 15 + ['down'] * 15
    columns, rows = table(good(*PAPER, '--start', '3'))
    starts = {}
    for row in rows:
        starts[row[0], row[1]] = starts.get((row[0], row[1]), 0) + int(float(row[columns.index('starts')]))
    assert len(starts) == 15 and set(starts.values()) == {3}


def test_the_picture_is_there_with_its_shares():
    good(*PAPER, '--out', 'a.csv', '--plot', 'a.png', '--of', 'x1:rms', '--show', 'class,exponent,x1:rms')
    assert os.path.getsize('a.png') > 10000
    script = read('a.gp')
    classes = [row[2] for row in table(read('a.csv'))[1]]
    largest = max(set(classes), key=classes.count)
    says(script, '%s  %.0f %%' % (largest, 100 * classes.count(largest) / len(classes)))
    for panel in '123':
        assert os.path.exists('a-raster%s.png' % panel), os.listdir('.')


def test_a_chart_in_millimetres_fills_its_frame():
    """The axis of a small gap in metres gets a prefix, and the cells go with it."""
    model = good('show', 'impact-oscillator').replace('[parameters.clearance]', '[parameters.clearance]\nunit = "m"', 1)
    assert 'unit = "m"' in model
    with open('m.toml', 'w') as file:
        file.write(model)
    good('map', 'm.toml', '--x', 'omega=0.8:1.2:5', '--y', 'clearance=0.001:0.006:4', '--plot', 'a.png', '--out', 'a.csv',
         '--inset', 'clearance=0.002:0.003,omega=0.85:0.95')
    says(read('a.gp'), '[mm]', 'set yrange [2:3]', 'set xrange [0.85:0.95]')
    with open('a-raster1.png', 'rb') as file:
        png = file.read()
    width, height = struct.unpack('>II', png[16:24])
    data, at = b'', 8
    while at < len(png):
        length = struct.unpack('>I', png[at:at + 4])[0]
        data += png[at + 8:at + 8 + length] if png[at + 4:at + 8] == b'IDAT' else b''
        at += 12 + length
    rows = zlib.decompress(data)  # a filter of no effect, then an index of the palette for each pixel; 0 is paper
    assert len(rows) == height * (width + 1)
    painted = sum(width - rows[1 + j * (width + 1):(j + 1) * (width + 1)].count(0) for j in range(height))
    assert painted > 0.9 * width * height


def test_the_curve_behind_a_boundary_is_where_the_linear_oscillator_grazes():
    """Without impacts the amplitude is 1 / sqrt((1 - omega^2)^2 + (2 zeta omega)^2): there the stop is touched."""
    done = run('map', 'impact-oscillator', '--set', 'damping_ratio=0.8', '--x', 'omega=0.5:1.5:24', '--y', 'clearance=0.3:1:18', '--out', 'a.csv', '--plot', 'a.png', '--curves', '1')
    assert done.status == 0, done.err
    found = re.search('GR between .* and .*: ([0-9]+) boundary edges; .* differ at ([0-9]+) places and are alike at ([0-9]+)', done.err)
    edges, differ, alike = (int(number) for number in found.groups())
    assert edges > 30 and differ > 10 and alike <= differ // 10, done.err
    points = [line.split(',')[:2] for line in read('a-plot.csv').splitlines()[1:]]
    points = [(float(x), float(y)) for x, y in points if x not in ('', 'NaN')]
    assert len(points) > 20
    for omega, clearance in points:
        amplitude = 1 / math.hypot(1 - omega ** 2, 2 * 0.8 * omega)
        assert abs(clearance - amplitude) < 1e-9 * amplitude, (omega, clearance, amplitude)


BROAD = ('map', 'vibro-impact', '--x', 'omega=1.3:2.6:49', '--y', 'friction=0.1:0.2:33')


def told(*words):
    """A run that must succeed; returns what it tells on standard error."""
    done = run(*words)
    assert done.status == 0, (words, done.err)
    return done.err


def test_a_refined_chart_is_the_whole_one_and_marks_what_it_filled_in():
    columns, whole = table(good(*BROAD))
    err = told(*BROAD, '--refine', '8', '--out', 'a.csv', '--plot', 'a.png', '--show', 'class,computed,exponent')
    marked, rows = table(read('a.csv'))
    assert marked == columns + ['computed'] and len(rows) == len(whole) == 49 * 33
    computed = [row for row in rows if row[-1] == '1']
    says(err, '%d of %d pixels' % (len(computed), len(rows)), 'filled in')
    assert 0 < len(computed) < len(rows) / 2
    taken_over = [columns.index(name) for name in ('x', 'y', 'class', 'attractor', 'n', 'p', 'chatter', 'sticking')]
    for row, other in zip(rows, whole):
        assert [row[k] for k in taken_over] == [other[k] for k in taken_over]
        if row[-1] == '1':
            assert row[:-1] == other
        else:
            assert row[columns.index('exponent')] == row[columns.index('multiplier_re')] == 'nan'
    says(read('a.gp'), '%.0f %% of the pixels computed' % (100 * len(computed) / len(rows)), 'filled in')
    told(*BROAD, '--refine', '8', '--out', 'b.csv', '--threads', '3')
    assert read('a.csv') == read('b.csv')


def test_refinement_is_refused_where_it_has_no_meaning():
    says(refused(2, *PAPER, '--refine', '4', '--start', 'carry'), '--refine', 'only with --start reset')
    says(refused(2, *PAPER, '--refine', '4', '--start', '3'), '--refine', 'only with --start reset')
    says(refused(2, *PAPER, '--refine', '4', '--store', 'a.db', '--shard', '1/2'), '--refine', '--shard')
    says(refused(2, *PAPER, '--refine', '4', '--store', 'a.db', '--slurm', '2'), '--refine', '--slurm')
    says(refused(2, *PAPER, '--refine', '1'), '--refine')
    says(refused(2, *PAPER, '--plot', 'a.png', '--show', 'computed'), '--show', 'computed')
    assert os.listdir('.') == []


def test_insets_are_in_every_panel_and_of_stores_too():
    good(*PAPER, '--store', 'a.db', '--out', 'a.csv', '--plot', 'a.png', '--show', 'class,exponent', '--inset', 'omega=1.3:1.7,friction=0.1:0.14')
    good('store', 'export', 'a.db', '--plot', 'b.png', '--show', 'class,exponent', '--inset', 'friction=0.1:0.14,omega=1.3:1.7')
    assert read('a.gp') == read('b.gp').replace('b-raster', 'a-raster').replace("'b.", "'a.").replace('./b.', './a.').replace(' b.gp', ' a.gp')
    for panel in '12':
        with open('a-raster%s-inset1.png' % panel, 'rb') as a, open('b-raster%s-inset1.png' % panel, 'rb') as b:
            assert a.read() == b.read()
    says(good(*PAPER, '--store', 'a.db', '--plot', 'a.png', '--inset', 'omega=1.3:1.7,friction=0.1:0.14', '--slurm', '3'), '--inset omega=1.3:1.7,friction=0.1:0.14')


def test_an_inset_of_a_diagram_is_in_the_panel_of_its_quantity():
    words = ('diagram', 'impact-oscillator', '--sweep', 'omega=2:4:30', '--out', 'a.csv', '--plot', 'a.png')
    good(*words, '--inset', 'omega=2.5:2.7,flight=0.9:1.1')
    assert read('a.gp').count('# ---- inset') == 1 and '# ---- inset 1 of panel 2' in read('a.gp')
    good(*words, '--y', 'x:rms,x:max', '--inset', 'x:rms=0.1:0.3,omega=2.5:2.7')
    assert read('a.gp').count('# ---- inset') == 1 and '# ---- inset 1 of panel 1' in read('a.gp')
    says(refused(2, *words, '--inset', 'omega=2.5:2.7,x=0:1'), '--inset', "'x'", "'w' or 'flight'")


def test_insets_that_cannot_be_drawn_are_refused_before_the_work():
    for text, *why in (('omega=1.3:1.7', 'X=A:B,Y=A:B'), ('omega=1.3:1.7,omega=1.3:1.7', "'friction'"), ('omega=1.7:1.3,friction=0.1:0.2', 'not below'),
                       ('omega=0:1.7,friction=0.1:0.2', 'leaves the picture'), ('omega=1.3:1.7,fraction=0.1:0.2', "'fraction'"), ('omega=a:b,friction=0.1:0.2', "'a'")):
        says(refused(2, *PAPER, '--plot', 'a.png', '--inset', text), '--inset', *why)
    says(refused(2, *PAPER, '--plot', 'a.png', '--inset', 'omega=1.2:3,friction=0.1:0.3'), '--plot', 'inset 1', 'smaller rectangle')
    says(refused(2, *PAPER, '--plot', 'a.png', *(('--inset', 'omega=1.3:1.4,friction=0.1:0.12') * 5)), '--inset', 'four')
    says(refused(2, *PAPER, '--inset', 'omega=1.3:1.7,friction=0.1:0.2'), '--inset', '--plot')
    assert os.listdir('.') == []


def test_bad_input_is_named():
    says(refused(2, 'map', 'vibro-impact', '--x', 'omega=1:2:3'), '--y')
    says(refused(2, *PAPER[:4], '--y', 'omega=1:2:3'), '--y', "'omega'")
    says(refused(2, *PAPER[:4], '--y', 'frictoin=1:2:3'), 'frictoin')
    says(refused(2, *PAPER[:4], '--y', 'friction=1:2'), '--y', 'NAME=A:B:COUNT')
    says(refused(2, *PAPER[:4], '--y', 'friction=2:1:3'), '--y', 'is not below')
    says(refused(2, *PAPER, '--set', 'omega=3'), '--x', '--set')
    says(refused(2, *PAPER, '--start', 'both'), '--start')
    says(refused(2, *PAPER, '--start', '1'), '--start')
    says(refused(2, *PAPER, '--direction', 'up'), '--direction', '--start carry')
    says(refused(2, *PAPER, '--transient', '7'), '--transient', '--level full')
    says(refused(2, *PAPER, '--level', 'full', '--periods', '70'), '--periods')
    says(refused(2, *PAPER, '--of', 'x1'), '--of', 'x1:rms')
    says(refused(2, *PAPER, '--of', 'x1:rsm'), '--of')
    says(refused(2, *PAPER, '--show', 'clas'), '--show', "'class'")
    says(refused(2, *PAPER, '--seed', '2'), '--seed')
    says(refused(2, *PAPER, '--curves', '2'), '--curves', '--plot')
    says(refused(2, 'map', 'vibro-impact', '--x', 'omega=1:2:100000', '--y', 'friction=0.1:0.2:100000'), 'pixels')
    says(refused(2, *PAPER, '--out', 'a.mat'), 'a.mat')
    assert os.listdir('.') == []


def done_of(progress):
    """How many pixels the last line of progress tells of."""
    told = re.findall('([0-9]+)/4000000 pixels', progress)
    return int(told[-1]) if told else 0


def test_a_signal_ends_it_within_two_seconds_with_what_is_complete():
    big = ('map', 'vibro-impact', '--x', 'omega=1:6:2000', '--y', 'friction=0.05:0.3:2000', '--threads', '2', '--out', 'a.csv', '--progress')
    for number in (signal.SIGINT, signal.SIGTERM):
        endless = Beside(*big)
        assert endless.until(lambda run=endless: done_of(run.err()) > 100), endless.err()
        done = endless.signalled(number)
        assert done.status == 130, (done.status, done.err)
        assert done.cpu < 2 * 2 * second(), (done.cpu, second())  # of two threads
        says(done.err, 'stopped after', 'pixels (', '/s', 'left')
        rows = table(read('a.csv'))[1]
        assert len(rows) == int(re.search('stopped after ([0-9]+) of 4000000', done.err).group(1)) > 100


if __name__ == '__main__':
    main(globals())
