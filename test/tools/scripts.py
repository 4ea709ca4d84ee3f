"""Loads a program of tools/, which has no ending, as a module; runs cases and counts those that fail."""
import importlib.machinery
import importlib.util
import sys
import traceback


def load(path):
    sys.dont_write_bytecode = True
    loader = importlib.machinery.SourceFileLoader('tool', path)
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader('tool', loader))
    loader.exec_module(module)
    return module


def run(cases, *arguments):
    """Calls each case with the arguments. Any exception is a failure. Returns the exit status."""
    wrong = 0
    for case in cases:
        try:
            case(*arguments)
        except Exception:  # pylint: disable=broad-except
            wrong += 1
            print(f'FAILED {case.__name__.replace("_", " ")}:')
            traceback.print_exc(file=sys.stdout)
    print(f'{len(cases)} cases, {wrong} failed')
    return 1 if wrong or not cases else 0
