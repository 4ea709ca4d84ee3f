"""tools/rotation must run every slow test in exactly one slice, of like cost, the same for the same commit."""
import contextlib
import io
import json
import os
import subprocess
import sys
import tempfile

import scripts

COSTS = {f'cascade.Case.{number}': 400.0 / (number + 1) for number in range(60)}


def shown(names):
    """What ctest --show-only=json-v1 says of slow tests, between others that are not slow or have no labels."""
    slow = [{'name': name, 'properties': [{'name': 'TIMEOUT', 'value': 600.0}, {'name': 'LABELS', 'value': ['orbit', 'slow']}]} for name in names]
    return {'tests': [{'name': 'base.fast', 'properties': [{'name': 'LABELS', 'value': ['fast']}]}, *slow, {'name': 'bare'}]}


def every_slow_test_is_in_exactly_one_slice(tool):
    names = tool.slow_tests(shown([*COSTS, 'store.new']))
    assert sorted(names) == sorted([*COSTS, 'store.new'])
    slices = tool.deal(names, COSTS)
    assert len(slices) == tool.SLICES
    assert sorted(name for each in slices for name in each) == sorted(names)


def slices_are_even_within_the_largest_test(tool):
    loads = [sum(COSTS[name] for name in each) for each in tool.deal(COSTS, COSTS)]
    assert max(loads) - min(loads) <= max(COSTS.values()), loads
    loads = [len(each) for each in tool.deal([f'test_{number}' for number in range(101)], {})]
    assert sorted(set(loads)) == [5, 6], loads


def fewer_tests_than_slices_are_one_a_slice(tool):
    assert sorted(map(len, tool.deal(list(COSTS)[:7], COSTS))) == [0] * 13 + [1] * 7


def the_order_in_which_tests_are_listed_does_not_matter(tool):
    names = [*COSTS, 'b', 'a', 'c']  # those without a cost are equal, and go by name
    assert tool.deal(names, COSTS) == tool.deal(names[::-1], COSTS) == tool.deal(sorted(names), COSTS)


def another_list_of_tests_is_dealt_as_surely(tool):
    names = [*list(COSTS)[:31], 'store.kills']
    slices = tool.deal(names, COSTS)
    assert slices == tool.deal(names[::-1], COSTS)
    assert sorted(name for each in slices for name in each) == sorted(names)


def the_same_commit_gives_the_same_slice(tool):
    number = int('4988b92702e5' + 'f' * 28, 16)
    assert tool.chosen(number, None)[0] == tool.chosen(number, '')[0] == [number % 20]
    assert {tool.chosen(number + k, None)[0][0] for k in range(20)} == set(range(20))


def no_commit_gives_the_first_slice(tool):
    assert tool.chosen(None, None)[0] == [0]
    with tempfile.TemporaryDirectory() as folder:
        os.environ['GIT_CEILING_DIRECTORIES'] = os.path.dirname(folder)
        assert tool.commit(folder) is None


def the_environment_names_another_slice_or_all(tool):
    assert tool.chosen(5, '19')[0] == [19]
    assert tool.chosen(5, 'all')[0] == list(range(20))
    for wrong in ('20', '-1', 'none', '1.5'):
        try:
            tool.chosen(5, wrong)
        except SystemExit as error:
            assert wrong in str(error), error
        else:
            raise AssertionError(f'slice {wrong} was taken')


def each_slice_has_each_campaign_with_one_of_its_seeds(tool):
    listed = {'noise': {'count': 1000, 'seeds': 20}, 'balls': {'count': 25, 'seeds': 3}}
    runs = tool.campaigns(listed, [4])
    assert runs == {'rotation.noise.seed_5': ['noise', '--count', '1000', '--seed', '5', '--threads', '1', '--quiet'],
                    'rotation.balls.seed_2': ['balls', '--count', '25', '--seed', '2', '--threads', '1', '--quiet']}
    everything = tool.campaigns(listed, range(20))
    assert {each[4] for each in everything.values() if each[0] == 'noise'} == {str(seed) for seed in range(1, 21)}
    assert {each[4] for each in everything.values() if each[0] == 'balls'} == {'1', '2', '3'}


@contextlib.contextmanager
def built(campaign):
    """A build folder: slow tests `slow.0` to `.39`, number 7 fails; one that is not slow and fails; a campaign."""
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, 'CTestTestfile.cmake'), 'w', encoding='utf-8') as file:
            file.write('add_test(quick sh -c "exit 1")\n')
            for number in range(40):
                file.write(f'add_test(slow.{number} sh -c "test {number} != 7")\nset_tests_properties(slow.{number} PROPERTIES LABELS slow)\n')
        program = os.path.join(folder, 'slapstick-campaign')
        with open(program, 'w', encoding='utf-8') as file:
            file.write(f'#!/bin/sh\n{campaign}\n')
        os.chmod(program, 0o755)
        yield folder


def outcome(tool, build, *arguments, asked=''):
    done = subprocess.run([sys.executable, '-B', tool.__file__, build, *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          universal_newlines=True, env={**os.environ, 'SLAPSTICK_SLICE': asked}, check=False)
    return done.returncode, done.stdout


def slice_of(tool, name):
    return next(k for k, each in enumerate(tool.deal([f'slow.{number}' for number in range(40)], {})) if name in each)


def seed_of(tool, k):
    """The seed of campaign noise in slice k, by tools/rotation.json."""
    with open(os.path.join(tool.ROOT, 'tools', 'rotation.json'), encoding='utf-8') as file:
        return k % json.load(file)['campaigns']['noise']['seeds'] + 1


def a_slice_runs_its_tests_and_the_campaigns(tool):
    k = (slice_of(tool, 'slow.7') + 1) % 20
    with built('exit 0') as build:
        status, output = outcome(tool, build, asked=str(k))
        assert status == 0 and f'slice {k} of 20' in output and '2 of 40 slow tests' in output, output
        assert '100% tests passed' in output and f'rotation.noise.seed_{seed_of(tool, k)} ' in output and 'quick' not in output, output
        with open(os.path.join(build, 'rotation', 'slice'), encoding='utf-8') as file:
            assert file.read() == str(k)


def a_failed_test_fails_its_slice_and_says_how_to_run_it_again(tool):
    with built('exit 0') as build:
        status, output = outcome(tool, build, asked=str(slice_of(tool, 'slow.7')))
        assert status != 0 and f"to run it again: ctest --test-dir {build} --output-on-failure -R '^slow\\.7$'" in output, output


def a_failed_campaign_fails_its_slice_and_its_output_is_shown(tool):
    k = (slice_of(tool, 'slow.7') + 1) % 20
    with built('echo "what went wrong in $1"; test $1 != noise') as build:
        status, output = outcome(tool, build, asked=str(k))
        assert status != 0 and 'what went wrong in noise' in output and 'what went wrong in balls' not in output, output
        assert f'to run it again: {build}/slapstick-campaign noise --count ' in output and f'--seed {seed_of(tool, k)} ' in output, output


def all_slices_run_everything_that_is_slow(tool):
    with built('exit 0') as build:
        status, output = outcome(tool, build, asked='all')
        assert status != 0 and '1 tests failed' in output and '40 of 40 slow tests' in output, output


def listed_alone_nothing_runs(tool):
    with built('exit 1') as build:
        status, output = outcome(tool, build, '--list', asked='3')
        assert status == 0 and 'slapstick-campaign noise' in output and 'seed 4' in output, output
        assert not os.path.exists(os.path.join(build, 'rotation')), output


CASES = [value for name, value in list(globals().items()) if callable(value) and getattr(value, '__module__', '') == __name__
         and name not in ('shown', 'built', 'outcome', 'slice_of', 'seed_of')]

sys.exit(scripts.run(CASES, scripts.load(sys.argv[1])))
