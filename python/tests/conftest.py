import pytest

BURST = {
    "version": 1,
    "materials": {"glass": {"density": (1, "kg/m^3"), "E": "1 Pa", "nu": 0.2, "strength": {"tension": (6e-4, "Pa")}}},
    "model": "dlsm",
    "fracture": {},
    "bodies": [{"name": "block", "shape": {"box": {"size": ["1 m", "1 m", "1 m"]}},
                "fill": {"noisy_grid": {"cells": [6, 6, 6], "spread": "90 %"}}, "material": "glass"}],
    "stages": [{"name": "burst", "solver": {"dynamic": {"steps": 120}},
                "initial": [{"velocity": {"gradient": {"x": ["2e-3 1/s", "5e-4 1/s", 0]}}}]},
               {"name": "after", "solver": {"dynamic": {"steps": 30}}}],
    "sensors": {"kinetic": {"energy": "kinetic"}, "broken": {"fracture": "broken"}},
    "measure": {"most": {"peak": {"of": "kinetic"}}},
    "output": {"frames": 3, "picture": False, "history_every": 40},
}


@pytest.fixture
def burst():
    """A block of 216 cells that breaks in a burst: 120 and 30 steps."""
    return BURST
