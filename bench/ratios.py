#!/usr/bin/env python3
"""What a forcing period of the paper's system costs, beside general-purpose solvers, as ratios in one run.

    bench/ratios.py BUILD_FOLDER [--python INTERPRETER] [--rounds 15] [--out FOLDER] [--short]

Two workers run in turn, one run each at a time: `bench_worker` (slapstick, Boost.odeint, CVODE) and bench/heyoka_peer.py.
A round measures slapstick's motion and its lanes right before every other contender; `ratio` is that to the motion, `lanes_ratio` that to
the lanes, so that a machine whose speed drifts shifts all three. Printed and written are the median of the rounds and the quartiles.
Times are CPU time, without compilation (lanes make the words of their modes as they go); `wall_us` is the clock's.
The files: `<machine>-ratios.csv`, `<machine>-scaling.csv` and `<machine>-roofline.csv`.
"""
import argparse
import csv
import datetime
import os
import re
import statistics
import subprocess
import sys

PERIODS = 500
OMEGAS = ('2.2', '1.5', '4.9', '0.552')
# name: (worker, kind, repeats of a run).
CONTENDERS = {
    'Boost.odeint RKF 7(8), 1e-12': ('native', 'odeint', 1),
    'CVODE Adams, 1e-9': ('native', 'cvode', 1),
    'heyoka, 1e-15': ('heyoka', 'scalar', 1),
    'heyoka batch, 1e-15': ('heyoka', 'batch', 1),
}
CHAINS = ((1, 1), (2, 2), (4, 4), (8, 4), (8, 8), (16, 8), (32, 1), (32, 4), (32, 8), (32, 16))


class Worker:
    def __init__(self, *command):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def run(self, *words):
        print(*words, file=self.process.stdin, flush=True)
        line = self.process.stdout.readline()
        while line.startswith('['):  # heyoka's warnings
            line = self.process.stdout.readline()
        if not line:
            sys.exit(f'bench: the worker ended at {words}')
        return {key: float(value) for key, value in (item.split('=') for item in line.split())}

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def machine():
    text = open('/proc/cpuinfo').read()
    value = lambda key: (re.search(rf'^{key}\s*: (.*)$', text, re.M) or ['', 'unknown'])[1]
    name = f"{value('model name')} family {value('cpu family')} model {value('model')}"
    return re.sub(r'[^a-z0-9]+', '-', name.lower()).strip('-')


def spread(values):
    if len(values) == 1:
        return values[0], values[0], values[0]
    low, middle, high = statistics.quantiles(values, n=4, method='inclusive')
    return low, middle, high


def per_period(answer):
    return 1e6 * answer['cpu'] / (PERIODS * answer.get('trajectories', 1))


def compare(workers, omega, rounds):
    """Of each contender: CPU microseconds a period, and those of slapstick's motion and of its lanes in the runs before."""
    costs = {name: [] for name in CONTENDERS if CONTENDERS[name][0] in workers}
    answers = {}
    for _ in range(rounds):
        for name in costs:
            worker, kind, repeats = CONTENDERS[name]
            motion = workers['native'].run('slapstick', omega, PERIODS, 20)
            lanes = workers['native'].run('lanes', omega, PERIODS)
            other = workers[worker].run(kind, omega, PERIODS, repeats) if worker == 'native' else workers[worker].run(kind, omega, PERIODS)
            costs[name].append(tuple(map(per_period, (other, motion, lanes))))
            answers.update({'slapstick': motion, 'slapstick, lanes': lanes, name: other})
    return costs, answers


def ratio_row(omega, solver, answer, triples):
    """From triples of costs: the solver's, the motion's, the lanes'."""
    row = dict(omega=omega, solver=solver)
    for key, values in (('us_per_period', [cost for cost, _, _ in triples]), ('ratio', [cost / motion for cost, motion, _ in triples]),
                        ('lanes_ratio', [cost / lanes for cost, _, lanes in triples])):
        low, middle, high = spread(values)
        row.update({key: middle, f'{key}_low': low, f'{key}_high': high})
    return dict(row, impacts=answer['impacts'] / answer.get('trajectories', 1))


def ratio_rows(workers, rounds):
    for omega in OMEGAS:
        costs, answers = compare(workers, omega, rounds)
        own = [triple for triples in costs.values() for triple in triples]
        yield ratio_row(omega, 'slapstick', answers['slapstick'], [(motion, motion, lanes) for _, motion, lanes in own])
        yield ratio_row(omega, 'slapstick, lanes', answers['slapstick, lanes'], [(lanes, motion, lanes) for _, motion, lanes in own])
        for name, triples in costs.items():
            yield ratio_row(omega, name, answers[name], triples)


def scaling_rows(worker, rounds, short):
    for name, words, scale, key in (('system', ('system', '2.2', 500), 1.0, 'cpu'), ('system with the modes of a run', ('system', '2.2', 500), 1.0, 'with_modes')):
        low, middle, high = spread([1e6 * worker.run(*words)[key] for _ in range(rounds)])
        yield dict(what=name, coordinates=2, contacts=2, threads=1, us=middle, us_low=low, us_high=high)
    for coordinates, contacts in CHAINS[:3] if short else CHAINS:
        periods = max(20, 2000 // coordinates)
        answers = [worker.run('chain', coordinates, contacts, periods, 1) for _ in range(max(3, rounds // 3))]
        low, middle, high = spread([1e6 * a['cpu'] / periods for a in answers])
        yield dict(what='chain, a period', coordinates=coordinates, contacts=contacts, threads=1, us=middle, us_low=low, us_high=high,
                   events=answers[0]['events'] / periods, windows=answers[0]['windows'] / periods)
    for name, threads, exponent in (('chart in lanes, a period', 1, 0), ('chart in lanes with exponents, a period', 1, 1), ('chart in lanes, a period', os.cpu_count() or 1, 0)):
        answers = [worker.run('chart', 16 if short else 40, 300, threads, exponent) for _ in range(max(3, rounds // 3))]
        of = lambda key: [1e6 * a[key] / (a['trajectories'] * 300) for a in answers]
        low, middle, high = spread(of('cpu'))
        yield dict(what=name, coordinates=2, contacts=2, threads=threads, us=middle, us_low=low, us_high=high, lane_steps=1e-6 * spread(of('lane_steps'))[1],
                   wall_us=spread(of('wall'))[1])
    count = 1
    while count <= (os.cpu_count() or 1):
        answers = [worker.run('threads', count, '2.2', 20000) for _ in range(rounds)]
        of = lambda key: [1e6 * a[key] / (a['trajectories'] * 20000) for a in answers]
        low, middle, high = spread(of('cpu'))
        yield dict(what='motions side by side, a period', coordinates=2, contacts=2, threads=count, us=middle, us_low=low, us_high=high,
                   wall_us=spread(of('wall'))[1])
        count *= 2


def roofline_rows(build, ratios):
    """Operations of the kernels in a period, and their share of the peak at the measured time."""
    lines = subprocess.run([os.path.join(build, 'bench_roofline')], check=True, capture_output=True, text=True).stdout.splitlines()
    peak = float(lines[0].split('=')[1])
    cost = {row['omega']: row['us_per_period'] for row in ratios if row['solver'] == 'slapstick'}
    for line in lines[1:]:
        of = dict(item.split('=') for item in line.split())
        operations = float(of['operations'])
        yield dict(omega=of['omega'], operations=operations, us_per_period=cost[of['omega']], gflops=1e-3 * operations / cost[of['omega']],
                   peak_gflops=1e-9 * peak, share=1e6 * operations / cost[of['omega']] / peak)


def write(path, head, rows):
    names = list(dict.fromkeys(key for row in rows for key in row))
    with open(path, 'w', newline='') as file:
        file.write(head)
        table = csv.DictWriter(file, names, lineterminator='\n')
        table.writeheader()
        for row in rows:
            table.writerow({key: f'{value:.4g}' if isinstance(value, float) else value for key, value in row.items()})
    print('   ', path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('build')
    parser.add_argument('--python', help='an interpreter that has heyoka; without it heyoka is left out')
    parser.add_argument('--rounds', type=int, default=15)
    parser.add_argument('--out', default='bench/results')
    parser.add_argument('--short', action='store_true', help='few chains')
    given = parser.parse_args()
    here = os.path.dirname(os.path.abspath(__file__))
    workers = {'native': Worker(os.path.join(given.build, 'bench_worker'))}
    if given.python:
        workers['heyoka'] = Worker(given.python, os.path.join(here, 'heyoka_peer.py'))
    ratios = []
    for row in ratio_rows(workers, given.rounds):
        ratios.append(row)
        print(f"omega {row['omega']:>6}  {row['solver']:30} {row['us_per_period']:9.3f} us a period  {row['ratio']:8.2f} motions"
              f"  ({row['ratio_low']:.2f} .. {row['ratio_high']:.2f})  {row['lanes_ratio']:8.2f} lanes ({row['lanes_ratio_low']:.2f} .. {row['lanes_ratio_high']:.2f})"
              f"  impacts {row['impacts']:.0f}", flush=True)
    scaling = []
    for row in scaling_rows(workers['native'], given.rounds, given.short):
        scaling.append(row)
        print(f"{row['what']:32} coordinates {row['coordinates']:3}  contacts {row['contacts']:3}  threads {row['threads']:2}  {row['us']:10.3f} us"
              f"  ({row['us_low']:.3f} .. {row['us_high']:.3f})", flush=True)
    roofline = list(roofline_rows(given.build, ratios))
    for row in roofline:
        print(f"omega {row['omega']:>6}  {row['operations']:8.0f} operations in kernels a period, {row['gflops']:.2f} of {row['peak_gflops']:.1f} GFLOP/s:"
              f" {100 * row['share']:.1f} %")
    for worker in workers.values():
        worker.close()
    commit = subprocess.run(['git', 'rev-parse', '--short', 'HEAD'], capture_output=True, text=True, cwd=here).stdout.strip()
    head = f'# ./dev bench --rounds {given.rounds}, {datetime.date.today()}, commit {commit}; medians and quartiles of CPU time\n'
    os.makedirs(given.out, exist_ok=True)
    for name, rows in (('ratios', ratios), ('scaling', scaling), ('roofline', roofline)):
        write(os.path.join(given.out, f'{machine()}-{name}.csv'), head, rows)


if __name__ == '__main__':
    main()
