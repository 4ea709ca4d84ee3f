"""Slow transients, and motions that advance. One CTest case per function `test_...`."""
from program import good, main, run, says

SLOW = """name = "slow"
omega = 2
[[coordinate]]
name = "x"
mass = 1
[[damper]]
between = ["x", "ground"]
coefficient = 3e-4
[[force]]
on = "x"
amplitude = 1
[start]
x = 0
v = 0.3
"""


def test_points_of_a_slow_transient_are_said_to_creep_and_others_not():
    with open('slow.toml', 'w') as file:
        file.write(SLOW)
    words = ('poincare', 'slow.toml', '--section', 'stroboscopic', '--out', 'points.csv')
    says(run(*words).err, 'still creep', '--transient')
    for quiet in (words + ('--transient', '20000'), ('poincare', 'vibro-impact', '--set', 'omega=4.805', '--out', 'p.csv'),
                  ('poincare', 'vibro-impact', '--set', 'omega=6.69', '--out', 'p.csv')):
        assert run(*quiet).err == '', quiet


def test_drift_is_there_for_models_with_a_translation_only():
    says(good('classify', 'sliding-block'), '"drift": {\n    "x": 0\n  }')
    assert 'drift' not in good('classify', 'vibro-impact')


main({name: case for name, case in globals().items() if name.startswith('test_')})
