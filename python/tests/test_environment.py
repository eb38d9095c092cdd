"""The same bits in every rounding mode of the caller, which stays as it was."""

import ctypes
import platform

import numpy as np
import pytest

import tunnelproof

# From <fenv.h>: downward, upward and toward zero.
MODES = {"x86_64": [0x400, 0x800, 0xC00], "aarch64": [0x800000, 0x400000, 0xC00000]}


@pytest.fixture
def libm():
    libm = ctypes.CDLL("libm.so.6")
    yield libm
    libm.fesetround(0)


def mesh_questions():
    rng = np.random.default_rng(24)
    start = rng.uniform(-1, 1, (64, 3))
    end = start + rng.uniform(-0.5, 0.5, start.shape)
    mesh = tunnelproof.Mesh(edges=np.arange(64).reshape(-1, 2), faces=np.arange(63).reshape(-1, 3))
    pairs = rng.permuted(np.tile(np.arange(64), (200, 1)), axis=1)[:, :4]
    return lambda: (
        mesh.step(start, end, 1e-3).positions,
        mesh.all_contacts(start, end).toi,
        mesh.first_contact(start, end).toi,
        mesh.is_free(start, end),
        tunnelproof.advance_pairs(start, end, pairs[:100], pairs[100:], share=0.5).positions,
    )


def pair_questions(family):
    points, radii = tunnelproof.queries(family.name, 100, seed=24)

    def ask():
        hits = tunnelproof.decide(family.kind, points, radii)
        moved = tunnelproof.advance(family.kind, points, radii, share=0.5)
        exact = tunnelproof.exact(family.kind, points, radii)
        drawn = tunnelproof.queries(family.name, 100, seed=24)
        return hits.toi, hits.normal, hits.first.point, moved.points, exact.toi, *drawn

    return ask


def turning_questions(kind):
    rng = np.random.default_rng(29)
    world = 2 if kind == "edge-turning-edge" else 1
    points, local = rng.uniform(-1, 1, (200, 2 * world, 3)), rng.uniform(-1, 1, (200, 4 - world, 3))
    poses = rng.uniform(-0.25, 0.25, (200, 2, 7))
    poses[:, :, 3] = 1
    radii = rng.choice([0, 1e-3, 5e-324], (200, 2))

    def ask():
        hits = tunnelproof.decide_rigid(kind, points, local, poses, radii)
        return hits.hit, hits.toi, hits.toi_above, hits.first.weights, hits.first.point, hits.place_error

    return ask


def judge():
    def method(kind, points, radii):
        hits = tunnelproof.decide(kind, points, radii)
        return hits.hit, hits.toi

    return tunnelproof.certify(method, families=["uniform", "face_uniform"], count=50).text


def minus_a_third():
    """Another number where this thread rounds downward."""
    return -1.0 / float("3")


def same(ask, libm):
    """Whether all answers are those of the default mode."""
    expected = ask()
    for mode in MODES.get(platform.machine(), []):
        libm.fesetround(mode)
        found = ask()
        left = libm.fegetround()
        libm.fesetround(0)
        assert left == mode
        for a, b in zip(found, expected, strict=True):
            assert np.asarray(a).tobytes() == np.asarray(b).tobytes()


@pytest.mark.parametrize(
    "name", ["uniform", "lattice", "scales", "face_grazing", "thick_uniform", "thick_face_lattice"]
)
def test_answers_are_the_same_in_every_rounding_mode(name, libm):
    [family] = [family for family in tunnelproof.families() if family.name == name]
    same(pair_questions(family), libm)


def test_meshes_are_the_same_in_every_rounding_mode(libm):
    same(mesh_questions(), libm)


@pytest.mark.parametrize("kind", ["edge-turning-edge", "vertex-turning-face"])
def test_bodies_that_turn_are_the_same_in_every_rounding_mode(kind, libm):
    ask = turning_questions(kind)
    assert 5 < ask()[0].sum() < 195
    same(ask, libm)


def test_a_method_that_changes_the_mode_is_judged_as_any_other(libm):
    expected = judge()
    third = minus_a_third()
    found_before = []

    def method(kind, points, radii):
        found_before.append(minus_a_third())
        hits = tunnelproof.decide(kind, points, radii)
        libm.fesetround(MODES.get(platform.machine(), [0])[0])
        return hits.hit, hits.toi

    found = tunnelproof.certify(method, families=["uniform", "face_uniform"], count=50).text
    assert found == expected and set(found_before) == {third}
