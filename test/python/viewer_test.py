# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages of the viewer, pictures by matplotlib, and bars of progress."""
import html
import io
import json
import os
import pathlib
import re
import stat
import sys

import numpy as np
import pytest
from support import run_program, uniform, write_points

import kinetri


def run_data(page):
    """The run that a page plays: the JSON in it."""
    found = re.findall(r'<script[^>]*type="application/json"[^>]*>(.*?)</script>', page.content.decode(),
                       re.S)
    assert len(found) == 1
    return json.loads(found[0])


def square():
    return kinetri.KineticDelaunay([[0, 0], [2, 0], [1, 2], [1, -3]], [[0, 0], [0, 0], [0, 0], [0, 1]])


def test_a_page_plays_the_run():
    kd = square()
    page = kd.play(until=2.75, title="A flip", height=300)
    assert kd.time == 2.75
    content = page.content.decode()
    assert content.lstrip().lower().startswith("<!doctype html>") and "A flip" in content
    assert not re.search(r"""(src|href)=["']?(https?:)?//""", content)
    assert "flip" in json.dumps(run_data(page))
    frame = page._repr_html_()
    assert frame.startswith("<iframe") and 'height="300"' in frame
    source = re.fullmatch(r'<iframe srcdoc="([^"]*)".*</iframe>', frame, re.S).group(1)
    assert html.unescape(source) == content
    assert repr(page) == f"<Page of {len(page.content)} bytes>"


def test_the_page_is_that_of_the_program(tmp_path):
    positions, velocities = uniform(30, 1)
    write_points(tmp_path / "points.csv", x=positions[:, 0], y=positions[:, 1], vx=velocities[:, 0],
                 vy=velocities[:, 1])
    run_program("simulate", "points.csv", "--until", "1", "--html", "run.html", directory=tmp_path)
    page = kinetri.KineticDelaunay(positions, velocities).play(until=1)
    written = run_data(kinetri.Page((tmp_path / "run.html").read_bytes()))
    data = run_data(page)
    for data_of in (written, data):
        data_of.pop("title", None)
    assert data == written
    assert dict(zip(data["events"]["kinds"], data["events"]["colors"])) == kinetri.event_colors


@pytest.mark.parametrize("title", ["</script><b>", "<!--", "\\u2028", '"quoted" & \'more\'', "Größe ∂"])
def test_titles_and_names_are_only_text(title):
    page = square().play(until=3, title=title, names=[title, "b", "c", "d"])
    data = json.dumps(run_data(page), ensure_ascii=False)
    assert json.dumps(title, ensure_ascii=False)[1:-1] in data


def test_pages_of_all_kinds(tmp_path):
    for points in (kinetri.KineticDelaunay([], []), kinetri.KineticDelaunay([[0, 0]], [[1, 1]]),
                   kinetri.KineticDelaunay(*uniform(20, 2), acceleration=uniform(20, 3)[1]),
                   kinetri.KineticRegular(*uniform(20, 2), radius=np.arange(20), growth=0.5),
                   kinetri.Simulation(*uniform(20, 2), radius=2, box=(0, 0, 100, 100), collisions="elastic"),
                   kinetri.Simulation(*uniform(20, 2), radius=np.arange(20) / 9, collisions="log")):
        expected = points.snapshot().restore()
        expected.advance_to(2)
        run_data(points.play(until=2))
        assert np.array_equal(points.edges(), expected.edges()) and points.audit()


def test_a_long_run_is_thinned():
    kd = kinetri.KineticDelaunay(*uniform(100, 3))
    again = kd.snapshot().restore()
    assert run_data(kd.play(until=3, most_events=50))["thinned"] is not None
    assert run_data(again.play(until=3))["thinned"] is None
    assert np.array_equal(kd.edges(), again.edges())


def test_a_page_is_saved_whole_or_not_at_all(tmp_path):
    page = square().play(until=1)
    for path in (tmp_path / "run.html", str(tmp_path / "other.html")):
        page.save(path)
        assert pathlib.Path(path).read_bytes() == page.content
    mask = os.umask(0)
    os.umask(mask)
    assert stat.S_IMODE(os.stat(tmp_path / "run.html").st_mode) == 0o666 & ~mask
    (tmp_path / "folder").mkdir()
    for path in (tmp_path / "none" / "run.html", tmp_path / "folder"):
        with pytest.raises(kinetri.OutputError, match="expected a writable path"):
            page.save(path)
    assert sorted(os.listdir(tmp_path)) == ["folder", "other.html", "run.html"]


# ---- matplotlib ----

@pytest.fixture
def axes():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots()
    yield axes
    figure.savefig(io.BytesIO(), format="png")
    pyplot.close("all")


def test_a_plot_has_edges_discs_and_ids(axes):
    from matplotlib.collections import EllipseCollection, LineCollection

    sim = kinetri.Simulation([[0, 0], [10, 0], [5, 8], [5, 4]], [[0, 0]] * 4, radius=[1, 2, 1, 1])
    sim.erase(3)
    assert sim.plot(axes, ids=True, color="red") is axes
    lines = [c for c in axes.collections if isinstance(c, LineCollection)]
    drawn = sorted(tuple(map(tuple, segment.tolist())) for segment in lines[0].get_segments())
    places = sim.positions()
    assert drawn == sorted(tuple(map(tuple, places[edge].tolist())) for edge in sim.edges())
    assert lines[0].get_color().tolist() == [[1, 0, 0, 1]]
    discs = [c for c in axes.collections if isinstance(c, EllipseCollection)]
    assert len(discs) == 1 and discs[0].get_offsets().tolist() == places[:3].tolist()
    assert [text.get_text() for text in axes.texts] == ["0", "1", "2"]
    assert axes.get_aspect() in ("equal", 1)
    low, high = axes.get_xlim()
    assert low < 0 and high > 10


def test_points_that_coincide_have_one_text(axes):
    kinetri.KineticDelaunay([[5, 5], [0, 0], [5, 5], [9, 0]], [[0, 0]] * 4).plot(axes, ids=True)
    assert [text.get_text() for text in axes.texts] == ["0, 2", "1", "3"]


def test_plots_of_few_points(axes):
    from matplotlib import pyplot

    for points in (kinetri.KineticDelaunay([], []), kinetri.KineticDelaunay([[1, 2]], [[0, 0]]),
                   kinetri.KineticRegular([[0, 0], [5, 5]], [[0, 0]] * 2, radius=3)):
        assert points.plot() is pyplot.gca()


# ---- progress ----

def test_progress_is_told_times_in_order():
    times = []
    kd = kinetri.KineticDelaunay(*uniform(200, 4))
    kd.advance_to(5, progress=times.append)
    assert len(times) > 0 and times == sorted(times) and times[-1] == 5
    assert all(type(time) is float for time in times)


@pytest.mark.parametrize("has_tqdm", [True, False])
def test_a_bar_is_written_to_standard_error(has_tqdm, capsys, monkeypatch):
    if has_tqdm:
        pytest.importorskip("tqdm")
    else:
        monkeypatch.setitem(sys.modules, "tqdm", None)
        monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    kd = kinetri.KineticDelaunay(*uniform(30, 4))
    assert kd.advance_to(2, progress=True) > 0
    out, err = capsys.readouterr()
    assert out == "" and err != ""
    assert kd.advance_to(2, progress=True) == 0
    assert kd.advance_to(3, progress=False) > 0
    assert err.endswith("t = 2 of 2\n") != has_tqdm
