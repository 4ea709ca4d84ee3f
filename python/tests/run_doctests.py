"""Runs the examples of all docstrings, with the standard library and numpy alone."""

import doctest
import importlib
import pkgutil
import sys

import slapstick

modules = [slapstick] + [
    importlib.import_module(f"slapstick.{found.name}") for found in pkgutil.iter_modules(slapstick.__path__)
]
results = [doctest.testmod(module) for module in modules]
failed, tried = sum(result.failed for result in results), sum(result.attempted for result in results)
print(f"{tried} examples in {len(modules)} modules, {failed} failed")
if tried < 10:
    sys.exit("the examples are not found")
foreign = sorted({"matplotlib", "pandas", "xarray", "tqdm"} & set(sys.modules))
if foreign:
    sys.exit(f"importing slapstick brings {foreign}")
sys.exit(failed != 0)
