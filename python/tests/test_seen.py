"""Pictures, explanations, the smallest queries and runs."""

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import tunnelproof

FALLING = [
    [-1, 0, 0], [1, 0, 0], [0.5, -1, 1], [0.5, 1, 1],
    [-1, 0, 0], [1, 0, 0], [0.5, -1, -3], [0.5, 1, -3],
]  # fmt: skip


def blind(kind, points, radii):
    return np.zeros(len(points), bool), np.zeros(len(points))


def is_svg(text):
    return ElementTree.fromstring(text).tag.endswith("svg")


def test_a_query_draws_itself():
    query = tunnelproof.Query("edge-edge", FALLING)
    assert is_svg(query.plot()) and query.plot()._repr_svg_() == query.plot()
    assert "data:image/svg+xml" in query._repr_html_()
    assert repr(query) == "<Query: edge-edge, hit at 0.25>"
    assert repr(tunnelproof.Query("edge-edge", FALLING, [0.25, 0.25])).startswith(
        "<Query: edge-edge, radius 0.25 + 0.25, hit at 0.125"
    )


@pytest.mark.parametrize(
    "arguments, message",
    [
        (("edge-edge", FALLING[:7]), r"points have the shape \(7, 3\), not \(8, 3\)"),
        (("edges", FALLING), 'kind is "edges"'),
        (("edge-edge", np.full((8, 3), np.nan)), "NaN"),
        (("edge-edge", FALLING, -1), "radius is -1"),
        (("edge-edge", FALLING, [1, 2, 3]), r"radius has the shape \(3,\), not \(\) or \(2,\)"),
    ],
)
def test_what_is_no_query_is_refused_when_it_is_made(arguments, message):
    with pytest.raises(ValueError, match=message):
        tunnelproof.Query(*arguments)


def test_an_explanation_has_the_exact_answer_and_the_own_method():
    explained = tunnelproof.explain(tunnelproof.Query("edge-edge", FALLING), blind)
    assert "0.25" in explained.text and "blind" in explained.text
    assert str(explained) == explained.text and is_svg(explained.plot())
    html = explained._repr_html_()
    assert "<pre>" in html and "<img" in html


def test_a_method_that_raises_is_explained_as_one_that_raised():
    def broken(kind, points, radii):
        raise RuntimeError("out of <range>")

    explained = tunnelproof.explain("lattice:1:4", broken)
    assert "raised: RuntimeError: out of <range>" in explained.text
    assert "panicked" not in explained.text
    assert "out of &lt;range&gt;" in explained._repr_html_()


def test_what_ends_a_program_is_no_answer_of_a_method():
    def interrupted(kind, points, radii):
        raise KeyboardInterrupt

    query = tunnelproof.Query("edge-edge", FALLING)
    for ask in (tunnelproof.explain, tunnelproof.shrink):
        with pytest.raises(KeyboardInterrupt):
            ask(query, interrupted)
    with pytest.raises(KeyboardInterrupt):
        tunnelproof.certify(interrupted, families=["uniform"], count=5)


@pytest.mark.parametrize("method", [3, "blind", []])
def test_what_cannot_be_called_is_no_method(method):
    query = tunnelproof.Query("edge-edge", FALLING)
    for ask in (tunnelproof.explain, tunnelproof.shrink):
        with pytest.raises(TypeError, match="cannot be called"):
            ask(query, method)
    with pytest.raises(TypeError, match="cannot be called"):
        tunnelproof.certify(method, families=["uniform"], count=5)


def test_mistakes_are_named():
    with pytest.raises(TypeError, match='families is "uniform", not a list'):
        tunnelproof.certify(blind, families="uniform", count=5)
    with pytest.raises(ValueError, match="no parts are given"):
        tunnelproof.merge([])
    with pytest.raises(TypeError, match="the query is 3, neither a Query nor a name"):
        tunnelproof.explain(3)


def test_the_smallest_query_shows_the_same_fault():
    shrunk = tunnelproof.shrink(tunnelproof.Query("edge-edge", FALLING), blind)
    assert shrunk.fault == "tunnel" and shrunk.is_minimal
    assert tunnelproof.exact(*shrunk.query.arrays).crosses.all()
    assert np.abs(shrunk.query.points).sum() < np.abs(FALLING).sum()
    assert "<table" in shrunk._repr_html_()
    assert tunnelproof.shrink("lattice:1:4", right) is None
    with pytest.raises(ValueError, match="near is -1"):
        tunnelproof.shrink("lattice:1:4", blind, near=-1)


def right(kind, points, radii):
    hits = tunnelproof.decide(kind, points, radii)
    return hits.hit, hits.toi


def test_gaps_are_zero_for_hits_and_bounds_for_misses():
    points, radii = tunnelproof.queries("uniform", 300)
    gaps = tunnelproof.gap("edge-edge", points, radii, width=1e-6)
    hit = tunnelproof.exact("edge-edge", points, radii).hit
    assert hit.any() and (gaps[hit] == 0).all() and (gaps[~hit, 0] > 0).all()
    assert (gaps[:, 1] - gaps[:, 0] <= 1e-6).all() and (gaps[:, 1] >= gaps[:, 0]).all()
    # Radii that are within and beyond the gap decide.
    (index, *_) = (~hit).nonzero()[0]
    below, above = gaps[index]
    found = tunnelproof.decide("edge-edge", points[[index, index]], [below / 2, above]).hit
    assert found.tolist() == [False, True]
    with pytest.raises(ValueError, match="width"):
        tunnelproof.gap("edge-edge", points, radii, width=-1)


def test_a_query_is_found_by_the_name_that_certificates_print():
    points, radii = tunnelproof.queries("lattice", 5)
    found = tunnelproof.query("lattice:1:4")
    assert (found.points == points[4]).all() and (found.radius == radii[4]).all()
    assert found.name == "lattice:1:4"
    line = '{"id": "mine", "kind": "edge-edge", "points": %s, "radius": [0.5, 0.25]}' % FALLING
    written = tunnelproof.query(line)
    assert written.name == "mine" and written.radius.tolist() == [0.5, 0.25]
    assert written.points.tolist() == FALLING
    with pytest.raises(ValueError, match="nowhere"):
        tunnelproof.query("nowhere:1:4")


def test_a_step_shows_its_pairs():
    mesh = tunnelproof.Mesh(faces=[[0, 1, 2]], vertex_count=4)
    start = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.25, 0.25, 1.0]])
    end = start - [[0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 2]]
    step = mesh.step(start, end, thickness=0.01)
    html = step._repr_html_()
    assert "vertex 3" in html and "face 0" in html and "ahead" in html
    assert "crossing" in mesh.all_contacts(start, end)._repr_html_()
    assert "A whole step" in mesh.step(start, start)._repr_html_()


def test_a_certificate_and_advances_show_tables():
    certificate = tunnelproof.certify(blind, families=["uniform"], count=50)
    assert "iframe" in certificate._repr_html_() and "tunnel" in certificate._repr_html_()
    assert "ahead" in tunnelproof.advance("edge-edge", [FALLING])._repr_html_()


def test_a_run_in_guard_mode_is_clean_and_the_one_beside_it_is_drawn():
    run = tunnelproof.simulate("basic-collision", duration=0.1, beside="discrete")
    summary = run.results["summary"]
    assert run.is_clean and summary["stopped"] is None and summary["prevented"] > 0
    assert run.times.shape == (6,) and run.wires[0][2].shape[1] == 3
    # The falling wire is held above the others.
    assert run.wires[-1][2][:, 2].min() > 0
    assert run.frame_count == 7 and is_svg(run.plot()) and run.plot(0) != run.plot(6)
    assert run.plot(-1) == run.plot(6)
    with pytest.raises(IndexError):
        run.plot(7)
    assert "discrete, guard mode" in run.html
    assert "srcdoc" in run._repr_html_()


def test_discrete_detection_lets_it_through_and_the_audit_says_so(capsys):
    run = tunnelproof.simulate("basic-collision", duration=0.1, narrow="discrete")
    assert run.is_clean is False and len(run.results["audit"]["standing"]) == 2
    assert run.wires[-1][2][:, 2].max() < 0
    # What it says to do is said in Python.
    assert "cargo" not in run.text and "echo" not in run.text
    (line, *_) = [line for line in run.text.splitlines() if "explain" in line]
    exec(line.strip(), {"tunnelproof": tunnelproof})
    assert "0.5909187621342502" in capsys.readouterr().out
    assert tunnelproof.simulate("basic-collision", duration=0.1, audit=False).is_clean is None


def test_a_scene_is_read_from_a_file(tmp_path):
    scene = tmp_path / "scene.toml"
    scene.write_text('title = "none"\nduration = "long"\n')
    with pytest.raises(ValueError, match="line 2"):
        tunnelproof.simulate(scene)
    with pytest.raises(FileNotFoundError, match="no file .*nowhere.toml.* scenes are basic-collision,"):
        tunnelproof.simulate(tmp_path / "nowhere.toml")
    with pytest.raises(ValueError, match="narrow"):
        tunnelproof.simulate("basic-collision", narrow="wide")


def test_the_extension_is_stripped():
    # It has 9 MB, with line tables 55.
    path = Path(tunnelproof._tunnelproof.__file__)
    assert path.stat().st_size < 15e6


def test_a_run_without_a_step_shows_its_start():
    run = tunnelproof.simulate("basic-collision", duration=1e-4)
    assert run.results["summary"]["steps"] == 0 and run.times.shape == (0,)
    assert run.frame_count == 1 and is_svg(run.plot()) and "falling" in run.html


def test_events_of_an_explanation_have_names():
    text = tunnelproof.explain(tunnelproof.Query("edge-edge", FALLING, 0.25)).text
    times = [line for line in text.splitlines() if line.startswith("  t = ")]
    assert times and all(": contact" not in line or line.split()[3] != ":" for line in times)
    assert any(line.split()[3] == "contact," for line in times), times


def test_ctrl_c_ends_a_judgement_soon():
    import signal
    import threading
    import time

    def slow(kind, points, radii):
        time.sleep(0.01)
        return np.zeros(len(points), bool), np.zeros(len(points))

    timer = threading.Timer(1.0, signal.raise_signal, [signal.SIGINT])
    timer.start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        tunnelproof.certify(slow, name="slow", count=200_000)
    assert time.monotonic() - start < 10.0
