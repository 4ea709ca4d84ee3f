"""tools/budget must fail a part that needs more than 1.5 times its budget alone. No clock decides a case here."""
import contextlib
import io
import json
import os
import subprocess
import sys
import tempfile

import scripts

KEPT = {'units': {'wasm': 100.0, 'docs': 200.0}}


def note(part, cpu, unit=2.0, status=0):
    return {'part': part, 'wall': cpu, 'cpu': cpu, 'unit': unit, 'status': status, 'unit_after': unit, 'ended': 0}


@contextlib.contextmanager
def tree(notes=(), kept=None):
    """A folder with budgets and notes: (options for the tool, reader of one of its files)."""
    with tempfile.TemporaryDirectory() as folder:
        for name, value in (('budget.json', KEPT if kept is None else kept), ('parts.json', list(notes))):
            with open(os.path.join(folder, name), 'w', encoding='utf-8') as file:
                json.dump(value, file)

        def read(name):
            with open(os.path.join(folder, name), encoding='utf-8') as file:
                return json.load(file)
        yield ['--folder', folder, '--budget', os.path.join(folder, 'budget.json')], read


def outcome(tool, options, *arguments):
    """(exit status, output) of the tool, called in this process."""
    with contextlib.redirect_stdout(io.StringIO()) as output:
        status = tool.main([*options, *arguments])
    return status, output.getvalue()


def report(tool, *notes, kept=None):
    with tree(notes, kept) as (options, _):
        return outcome(tool, options, 'report')


@contextlib.contextmanager
def costs(tool, part, *units):
    """A tool for which a part costs `part` CPU seconds, and the reference loop one after another of `units`."""
    real, left = (tool.spent, tool.unit), list(units)
    tool.spent, tool.unit = (lambda *commands, **options: (0, 1.0, part)), (lambda: left.pop(0))
    try:
        yield
    finally:
        tool.spent, tool.unit = real


def measured(tool, part, *units):
    """CPU time in units that `run` notes."""
    with tree() as (options, read), costs(tool, part, *units):
        assert outcome(tool, options, 'run', 'wasm', '--', 'true')[0] == 0
        [written] = read('parts.json')
        return tool.needed(written)


def twice_the_budget_fails(tool):
    status, output = report(tool, note('wasm', 400.0), note('docs', 400.0))
    assert status == 1, output
    assert 'part wasm needs 200.0 units, 2.00 times its budget of 100.0' in output, output
    assert output.count('times its budget') == 1, output


def a_fifth_above_the_budget_passes(tool):
    status, output = report(tool, note('wasm', 240.0))
    assert status == 0 and '120 %' in output, output


def half_above_the_budget_and_five_units_pass_and_a_little_more_fails(tool):
    assert report(tool, note('wasm', 310.0))[0] == 0
    assert report(tool, note('wasm', 310.1))[0] == 1


def a_part_whose_results_were_there_already_is_no_fault(tool):
    assert report(tool, note('wasm', 0.1))[0] == 0


def a_part_without_a_budget_passes_and_says_so(tool):
    status, output = report(tool, note('package', 1e6))
    assert status == 0 and 'no budget' in output, output


def no_part_is_a_fault(tool):
    assert report(tool)[0] == 1


def the_last_note_of_a_part_counts(tool):
    assert report(tool, note('wasm', 400.0), note('wasm', 200.0))[0] == 0
    assert report(tool, note('wasm', 200.0), note('wasm', 400.0))[0] == 1


def switched_off_it_only_reports(tool):
    os.environ['SLAPSTICK_BUDGET'] = 'off'
    try:
        status, output = report(tool, note('wasm', 400.0))
    finally:
        del os.environ['SLAPSTICK_BUDGET']
    assert status == 0 and '2.00 times its budget' in output, output


def a_machine_twice_as_slow_needs_the_same_units(tool):
    assert measured(tool, 40.0, 4.0, 4.0) == measured(tool, 20.0, 2.0, 2.0) == 10.0


def a_reference_twice_as_slow_halves_the_units(tool):
    assert measured(tool, 20.0, 4.0, 4.0) == measured(tool, 20.0, 2.0, 2.0) / 2


def the_reference_is_the_mean_of_before_and_after(tool):
    assert measured(tool, 20.0, 1.0, 3.0) == 10.0


def the_reference_after_a_part_is_the_one_before_the_next(tool):
    with tree() as (options, read):
        tool.time.time, real = (lambda: 1000.0), tool.time.time
        try:
            with costs(tool, 20.0, 1.0, 3.0, 5.0):
                for part in ('wasm', 'docs'):
                    outcome(tool, options, 'run', part, '--', 'true')
        finally:
            tool.time.time = real
        assert [each['unit'] for each in read('parts.json')] == [2.0, 4.0]


def what_passed_becomes_the_new_budget(tool):
    with tree([note('wasm', 40.0), note('docs', 4.0, status=1), note('web', 6.0)]) as (options, read):
        assert outcome(tool, options, 'keep')[0] == 0
        assert read('budget.json')['units'] == {'wasm': 20.0, 'docs': 200.0, 'web': 3.0}
        assert outcome(tool, options, 'report')[0] == 0


def a_cheap_slice_does_not_lower_the_budget_of_the_rotation(tool):
    for units, expected in ((4.0, 8.0), (12.0, 12.0)):
        with tree([note('rotation', 2.0 * units)], {'units': {'rotation': 8.0}}) as (options, read):
            assert outcome(tool, options, 'keep')[0] == 0
            assert read('budget.json')['units'] == {'rotation': expected}


def the_reference_and_the_command_are_really_measured(tool):
    """Burns CPU time by its own account, however long that takes, and ends with a status of its own."""
    burn = 'import sys, time\nwhile time.process_time() < 0.5: pass\nsys.exit(7)'
    with tree() as (options, read):
        done = subprocess.run([sys.executable, '-B', tool.__file__, *options, 'run', 'wasm', '--', sys.executable, '-c', burn],
                              stdout=subprocess.PIPE, universal_newlines=True, check=False)
        [written] = read('parts.json')
        assert done.returncode == written['status'] == 7, done
        assert written['cpu'] > 0.45 and written['unit'] > 0, written
        assert 'part wasm: ' in done.stdout and 'status 7' in done.stdout, done.stdout


def a_command_that_is_killed_has_failed(tool):
    assert tool.spent(['sh', '-c', 'kill -9 $$'])[0] == 137


CASES = [value for name, value in list(globals().items()) if callable(value) and getattr(value, '__module__', '') == __name__
         and name not in ('note', 'tree', 'outcome', 'report', 'costs', 'measured')]

sys.exit(scripts.run(CASES, scripts.load(sys.argv[1])))
