import numpy as np
import pytest

import breccia


@pytest.fixture
def results(burst, tmp_path):
    return breccia.Scene(burst).run(tmp_path, device="cpu")


def test_tables(results):
    histories = results.histories()
    assert list(histories.columns) == ["stage", "step", "stage_time", "time_s", "kinetic [J]", "broken [-]"]
    assert list(histories["step"]) == [0, 40, 80, 120, 0, 30]
    columns = results.history()
    assert np.array_equal(columns["kinetic [J]"], histories["kinetic [J]"])
    assert results.measures == {"most": histories["kinetic [J]"][histories["stage"] == 1].max()}
    cracks = results.cracks()
    assert len(cracks) == histories["broken [-]"].iloc[-1] > 0 and set(cracks["mode"]) <= {"tension", "detached"}
    fragments = results.fragments()
    assert set(fragments["frame"]) == set(range(len(results.frames)))


def test_frames(results):
    frames = results.frames
    assert len(frames) == 7 and frames[0].time == 0 and frames[-1].time > frames[1].time
    assert frames[0].field("displacement").shape == (216, 3) and "von_mises" in frames[0].names
    with pytest.raises(KeyError, match="voltage"):
        frames[0].field("voltage")


def test_a_folder_that_holds_none(tmp_path):
    with pytest.raises(FileNotFoundError):
        breccia.Results(tmp_path)
