"""mypy's stubtest, told what functions and classes of nanobind are."""

import sys

from mypy import stubtest

known = stubtest.is_probably_a_function
stubtest.is_probably_a_function = lambda value: known(value) or type(value).__name__ in ("nb_func", "nb_method")
stubtest._verify_metaclass = lambda *_, **__: iter(())  # nb_type, of which stubs know nothing
sys.exit(stubtest.main())
