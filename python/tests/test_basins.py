"""Basins: the program's numbers, a store that both go on with, and pictures of starts that belong to no basin."""

import json

import numpy as np
import pytest
import slapstick
from test_same_as_program import assert_same_table

X, Y = ("x1", -0.6, 0.1, 11), ("v1", -1.2, 1.2, 9)
WORDS = ("--set", "omega=2.82", "--x", "x1=-0.6:0.1:11", "--y", "v1=-1.2:1.2:9")


@pytest.mark.parametrize(
    ("options", "words"),
    [({}, ()), ({"level": "full", "most_periods": 2000, "box": 2}, ("--level", "full", "--most-periods", 2000, "--box", 2))],
)
def test_basins_have_the_numbers_of_the_program(program, tmp_path, options, words):
    ran = program("basins", "vibro-impact", *WORDS, *words, "--table", tmp_path / "b.csv")
    assert ran.returncode == 0, ran.stderr
    found = slapstick.basins("vibro-impact", X, Y, omega=2.82, **options)
    assert_same_table(found.to_pandas(), program.table(tmp_path / "b.csv"))
    told = json.loads(ran.stdout)
    assert [basin["name"] for basin in told["basins"]] == [basin.name for basin in found.basins]
    for basin, one in zip(told["basins"], found.basins):
        for key in ("starts", "share", "share_from", "share_to", "exponent"):
            assert basin[key] == getattr(one, key), key
        assert list(basin["state"].values()) == one.state.tolist()
    assert told["entropy"]["whole"] == found.entropy and told["entropy"]["box"] == found.box
    assert told["uncertainty"]["shares"] == found.uncertain.tolist()


def test_the_program_goes_on_with_a_store_of_python(program, tmp_path):
    store = tmp_path / "b.db"
    found = slapstick.basins("vibro-impact", X, Y, omega=2.82, store=store)
    ran = program("basins", "vibro-impact", *WORDS, "--store", store, "--resume")
    assert ran.returncode == 0, ran.stderr
    assert json.loads(ran.stdout)["basins"][0]["starts"] == found.basins[0].starts
    again = slapstick.basins("vibro-impact", X, Y, omega=2.82, store=store, resume=True)
    assert np.array_equal(again.of, found.of)


def test_starts_without_a_basin_have_words_of_their_own():
    found = slapstick.basins("vibro-impact", X, Y, omega=2.82)
    assert set(found.names[:, -1]) == {"not admissible"}
    assert (found.of[:, -1] == -2).all() and (found.of[:, 0] >= 0).any()
    assert sum(basin.starts for basin in found.basins) + int((found.of < 0).sum()) == found.of.size
    with pytest.raises(slapstick.InputError, match="forbid every start"):
        slapstick.basins("vibro-impact", ("x1", 0.1, 0.2, 2), Y, omega=2.82)
