"""What the tests share: the program that the package is held against."""

import csv
import io
import json
import os
import pathlib
import subprocess
import sys

import matplotlib
import matplotlib.pyplot
import numpy as np
import pytest

matplotlib.use("Agg")
ROOT = pathlib.Path(__file__).parents[2]


class Program:
    """build/slapstick of the same tree."""

    path = pathlib.Path(os.environ.get("SLAPSTICK_PROGRAMS", ROOT / "build")) / "slapstick"

    def __call__(self, *words):
        return subprocess.run([self.path, *map(str, words)], capture_output=True, text=True, check=False)

    def json(self, *words):
        ran = self(*words)
        assert ran.returncode == 0, ran.stderr
        return json.loads(ran.stdout)

    def table(self, path_or_text):
        """The columns of a CSV table: numbers where all cells are."""
        text = path_or_text.read_text() if isinstance(path_or_text, pathlib.Path) else path_or_text
        head, *rows = csv.reader(io.StringIO(text))
        columns = {}
        for name, column in zip(head, zip(*rows)):
            try:
                columns[name] = np.array([float(cell) for cell in column])
            except ValueError:
                columns[name] = np.array(column)
        return columns

    def complaint(self, *words):
        """The line of an error, without the program's name."""
        ran = self(*words)
        assert ran.returncode in (2, 3, 4), ran
        return ran.stderr.strip().removeprefix("slapstick: ")


@pytest.fixture(autouse=True)
def figures_are_closed():
    """pyplot keeps every figure, and warns at the 21st."""
    yield
    matplotlib.pyplot.close("all")


@pytest.fixture(scope="session")
def program():
    return Program()


@pytest.fixture
def script(tmp_path):
    """Starts a Python program; standard output is a pipe."""

    def start(text):
        path = tmp_path / "script.py"
        path.write_text(text)
        return subprocess.Popen([sys.executable, path], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    return start
