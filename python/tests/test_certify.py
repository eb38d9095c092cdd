"""Methods judged from Python."""

import json

import numpy as np
import pytest

import tunnelproof


def certified(kind, points, radii):
    hits = tunnelproof.decide(kind, points, radii)
    return hits.hit, hits.toi


def test_certified_path_passes_on_every_family():
    names = [family.name for family in tunnelproof.families()]
    certificate = tunnelproof.certify(certified, name="certified", families=names, count=50)
    assert certificate.failures == []
    results = certificate.results
    assert len(results["sources"]) == len(tunnelproof.families())
    assert results["total"]["queries"] >= 50 * len(results["sources"])
    assert "certified" in certificate.text and "<svg" in certificate.html or "<html" in certificate.html


def test_faults_are_found_and_named():
    def drops(kind, points, radii):
        hit, toi = certified(kind, points, radii)
        return hit & (toi < 0.9), toi

    certificate = tunnelproof.certify(drops, families=["uniform"], count=1000)
    assert any("tunnels" in failure for failure in certificate.failures)

    def invents(kind, points, radii):
        return np.ones(len(points), bool), np.zeros(len(points))

    certificate = tunnelproof.certify(invents, families=["uniform"], count=200)
    assert any("false hits" in failure for failure in certificate.failures)


def test_a_tolerance_is_declared_and_both_verdicts_are_there():
    def late(kind, points, radii):
        hit, toi = certified(kind, points, radii)
        return hit, np.minimum(toi + 1e-10, 1.0)

    within = tunnelproof.certify(late, families=["uniform"], count=200, late=1.01e-10)
    assert within.failures == []
    assert "late times of impact" in within.exact_failures[0]
    assert "passes with its tolerance, late=1.01e-10" in within.text
    beyond = tunnelproof.certify(late, families=["uniform"], count=200, late=0.99e-10)
    assert "beyond its tolerance" in beyond.failures[0]
    for name in ("near", "late"):
        with pytest.raises(ValueError, match=f"{name} is -1, not a number from 0"):
            tunnelproof.certify(late, families=["uniform"], count=1, **{name: -1.0})


def test_an_exception_is_counted_against_the_query_that_raises_it():
    def fragile(kind, points, radii):
        if (points[:, 0, 0] > 0.99).any():
            raise RuntimeError("out of range")
        return certified(kind, points, radii)

    certificate = tunnelproof.certify(fragile, families=["uniform"], count=2000)
    (subject,) = certificate.results["total"]["subjects"]
    points, _ = tunnelproof.queries("uniform", 2000)
    expected = int((points[:, 0, 0] > 0.99).sum())
    assert expected > 0
    assert subject["lapses"] == {"raised": expected}
    assert "out of range" in certificate.json


def test_answers_of_other_shapes_are_no_answers():
    certificate = tunnelproof.certify(
        lambda kind, points, radii: (np.zeros(3, bool), np.zeros(3)), families=["uniform"], count=10
    )
    (subject,) = certificate.results["total"]["subjects"]
    assert sum(subject["lapses"].values()) == 10


def test_what_a_method_does_not_take_is_not_judged():
    def edges_only(kind, points, radii):
        return certified(kind, points, radii) if kind == "edge-edge" else None

    certificate = tunnelproof.certify(
        edges_only, families=["uniform", "face_uniform"], count=100
    )
    (subject,) = certificate.results["total"]["subjects"]
    assert [sort["kind"] for sort in subject["refused"]] == ["vertex-face"]


def test_a_method_that_takes_nothing_is_told_so():
    def silent(kind, points, radii):
        return None

    certificate = tunnelproof.certify(silent, name="silent", families=["uniform"], count=123)
    said = "takes none of the 123 queries, so it gave no answer"
    assert certificate.failures == [f"silent: {said}"]
    for text in (certificate.text, certificate.details, certificate.html):
        assert said in text
    (row,) = [line for line in certificate.text.splitlines() if "FAILS" in line]
    assert "0" not in row.split("(")[0] and "not asked 123" in row


def test_families_are_those_that_a_method_takes():
    def names(method):
        return [source["name"] for source in tunnelproof.certify(method, count=2).results["sources"]]

    def faces(kind, points, radii):
        return certified(kind, points, radii) if kind == "vertex-face" and not radii.any() else None

    def edges(kind, points, radii):
        return certified(kind, points, radii) if kind == "edge-edge" else None

    assert names(edges) == names(certified) and "lattice" in names(edges)
    assert names(faces) and all(name.startswith("face_") for name in names(faces))


def test_a_find_comes_with_an_expression_that_explains_it(capsys):
    def blind(kind, points, radii):
        return np.zeros(len(points), bool), np.zeros(len(points))

    points, radii = tunnelproof.queries("uniform", 50)
    for settings in ({"families": ["uniform"]}, {"own": {"mine": ("edge-edge", points, radii)}}):
        certificate = tunnelproof.certify(blind, name="blind", **settings)
        (line,) = [line for line in certificate.text.splitlines() if "explain" in line and "print" in line]
        assert "cargo" not in certificate.text + certificate.json + certificate.html
        exec(line.strip(), {"tunnelproof": tunnelproof, "blind": blind, "method": blind})
        assert "blind" in capsys.readouterr().out
    with pytest.raises(ValueError, match="not a query"):
        tunnelproof.explain("nothing")


def test_own_queries_are_judged():
    points, radii = tunnelproof.queries("thick_uniform", 100, seed=9)
    own = {"mine": ("edge-edge", points, radii)}
    certificate = tunnelproof.certify(certified, families=[], own=own)
    assert certificate.failures == []
    assert certificate.results["total"]["queries"] == 100


def test_parts_make_the_whole_to_the_last_byte():
    settings = {"name": "certified", "families": ["uniform", "joint"], "count": 300, "seed": 4}
    whole = tunnelproof.certify(certified, **settings)
    parts = [tunnelproof.certify(certified, shard=(i, 3), **settings).json for i in (3, 1, 2)]
    merged = tunnelproof.merge(parts)
    assert merged.json == whole.json and merged.text == whole.text and merged.details == whole.details
    with pytest.raises(ValueError, match="missing"):
        tunnelproof.merge(parts[:2])
    with pytest.raises(ValueError, match="part 1"):
        tunnelproof.merge([json.dumps({})])
    other = tunnelproof.certify(certified, shard=(2, 3), late=1e-9, **settings).json
    with pytest.raises(ValueError, match="another tolerance"):
        tunnelproof.merge([parts[0], other, parts[1]])
    whole = json.loads(parts[0])
    whole["tolerances"] = []
    with pytest.raises(ValueError, match='list of subjects.* is "certified"'):
        tunnelproof.merge([json.dumps(whole)])


def test_what_is_no_certification_is_refused():
    with pytest.raises(ValueError, match='there is no family "none"'):
        tunnelproof.certify(certified, families=["none"])
    with pytest.raises(ValueError, match="shard"):
        tunnelproof.certify(certified, families=["uniform"], shard=(3, 2))
