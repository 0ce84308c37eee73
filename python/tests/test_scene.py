import math

import numpy as np
import pytest

import breccia


def test_units_are_strings_or_pairs(burst):
    scene = breccia.Scene(burst)
    pairs = {**burst, "materials": {"glass": {"density": "1 kg/m^3", "E": (np.float64(1e-9), "GPa"), "nu": np.float32(0.25),
                                              "strength": {"tension": (0.6, "mPa")}}}}
    other = breccia.Scene(pairs, set={"materials.glass.nu": 0.2})
    assert scene.yaml == other.yaml
    assert "nu: 0.2" in scene.yaml and scene.warnings == []


def test_a_file_and_its_text_are_one_scene(burst, tmp_path):
    path = tmp_path / "scene.yaml"
    path.write_text(breccia.Scene(burst).yaml)
    assert breccia.Scene.load(path).yaml == breccia.Scene(burst).yaml
    changed = breccia.Scene.load(path).with_({"stages.0.solver.dynamic.steps": 7})
    assert "steps: 7" in changed.yaml and changed.yaml != breccia.Scene(burst).yaml


def test_arrays_become_lists(burst):
    box = {"box": {"size": (np.array([1.0, 1.0, 1.0]), "m")}}
    assert breccia.Scene({**burst, "bodies": [{**burst["bodies"][0], "shape": box}]}).yaml == breccia.Scene(burst).yaml


def test_all_errors_are_told_with_places_and_cures(burst):
    wrong = {**burst, "materials": {"glass": {**burst["materials"]["glass"], "E": "1 furlong"}}, "bodys": []}
    with pytest.raises(breccia.SceneError) as caught:
        breccia.Scene(wrong)
    problems = caught.value.problems
    assert [problem.source for problem in problems] == ['"E": "1 furlong",', '"bodys": []']
    assert problems[0].cure.startswith("expected a quantity in Pa") and not problems[0].is_warning
    assert "bodys" in str(caught.value) and isinstance(caught.value, ValueError)


def test_an_override_is_named(burst):
    with pytest.raises(breccia.SceneError) as caught:
        breccia.Scene(burst, set={"materials.glass.nu": 7})
    assert caught.value.problems[0].set == "materials.glass.nu=7" and "nu" in caught.value.problems[0].message


def test_a_missing_file_is_an_error():
    with pytest.raises(breccia.SceneError, match="nowhere.yaml"):
        breccia.Scene.load("nowhere.yaml")


def test_a_check_counts_and_prices(burst):
    scene = breccia.Scene(burst)
    price = scene.check(device="cpu")
    assert price.n_elements == 216 and price.n_bonds > 600 and price.device_bytes > 0
    assert 0 < price.least_seconds <= price.seconds <= price.most_seconds
    assert math.isnan(scene.check(trial=False).seconds)
    with pytest.raises(breccia.InputError, match="opencl:99"):
        scene.check(trial=False, device="opencl:99")


def test_the_cpu_is_always_there():
    assert [device.usable for device in breccia.devices() if device.selector == "cpu"] == [True]
    assert breccia.__version__.count(".") == 2
