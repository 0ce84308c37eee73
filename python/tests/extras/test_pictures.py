import numpy as np
import pytest
import pyvista
import xarray

import breccia


@pytest.fixture
def results(burst, tmp_path):
    return breccia.Scene(burst).run(tmp_path, device="cpu")


def test_fields_are_labelled(results):
    data = results.fields("velocity", "stress", "damage")
    assert isinstance(data, xarray.Dataset) and data["velocity"].dims == ("frame", "element", "component")
    assert data["stress"].sel(tensor="xx").shape == (7, 216) and data["stress"].attrs["unit"] == "Pa"
    assert np.array_equal(data["velocity"].isel(frame=-1), results.frames[-1].field("velocity"))
    assert float(data["time"][-1]) == results.frames[-1].time
    assert set(results.fields(frames=[0]).data_vars) == set(results.frames[0].names)


def test_frames_are_meshes(results):
    mesh = results.frames[0].mesh()
    assert isinstance(mesh, pyvista.UnstructuredGrid) and mesh.n_cells == 216
    assert mesh.bounds == pytest.approx((0, 1, 0, 1, 0, 1), abs=1e-6)
    assert (mesh.celltypes == 42).all() and mesh.volume == pytest.approx(1, rel=1e-6)
    assert sum(mesh.clip("x", invert=side).volume for side in (True, False)) == pytest.approx(1, rel=1e-4)  # as tests/commands/test_frames.py asks of VTK's own reader
    moved = results.frames[-1].mesh(scale=1.0)
    assert np.allclose(moved.points - results.frames[-1].mesh().points, moved.point_data["displacement"])
    assert results.frames[-1].cracks().n_cells > 0


def test_a_cut_is_drawn(results, tmp_path):
    assert results.frames[0].cut().area == pytest.approx(1, rel=1e-6)  # the whole section of the cube, once
    cut = results.frames[-1].cut(normal="x", scale=50.0)
    assert len(set(cut.cell_data["element_id"])) >= 36 and cut.cell_data["damage"].max() > 0
    plotter = pyvista.Plotter(off_screen=True)
    plotter.add_mesh(cut, scalars="damage")
    plotter.screenshot(tmp_path / "cut.png")
    picture = pyvista.read(tmp_path / "cut.png").point_data.active_scalars
    assert len(np.unique(picture.reshape(-1, picture.shape[-1]), axis=0)) > 10
