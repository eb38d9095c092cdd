"""The list of claims."""

import doubled
import filters
import others
import places
import thick
from prove import Claim, Lemma
from rounded import H, U

# The model of a rounding, of the format itself: name, of what, under which condition, and how far off.
LEMMAS = [
    ("a rounding", "f64", "|x| in [1b-1021, 1b1023]", "x", "-/", U),
    ("a rounding, underflow", "f64", "|x| <= 1b-1021", "x", "-", U**20 / 2**15),
    ("a sum", "f64", "@FIX(a, -1074) /\\ @FIX(b, -1074)", "a + b", "-/", U),
]

MEETING = ("n", "u", "v", "before_b", "before_d")


def all_claims():
    """Each claim with what states its goals, given the sources."""
    add = []

    def claim(name, where, build, *arguments, unit=U, unit_name="u", **more):
        add.append((Claim(name, where, unit, unit_name), lambda engine, claim: build(engine, claim, *arguments, **more)))

    for lemma in LEMMAS:
        add.append((Lemma(*lemma), lambda engine, claim: None))
    edges = ("separate", "Motion", filters.EDGE_MARGINS, ("smaller", "larger"))
    face = ("face/separate", None, filters.FACE_MARGINS, ("smaller", "smaller"))
    for name, of in (("edges", edges), ("a face", face)):
        claim(f"margin of {name}", f"{of[0]}.rs", filters.separated, *of)
        claim(f"margin of {name}, underflow", f"{of[0]}.rs", filters.separated, *of, underflows=True, unit=None)
    for i in range(4):
        claim(f"Bernstein coefficient {i}", "cubic.rs", filters.bernstein, i)
    for i in range(4):
        claim(f"Bernstein coefficient {i}, underflow", "cubic.rs", filters.bernstein_underflow, i, unit=None)
    claim("subdivision, one level", "root.rs", filters.subdivision)
    claim("subdivision, all levels", "root.rs", filters.parts, unit=1, unit_name="error")
    claim("value", "root.rs", filters.value, 0, "value_error", unit=1, unit_name="error")
    claim("slope", "root.rs", filters.value, 1, "slope_error", unit=1, unit_name="error")
    claim("curvature", "root.rs", filters.curvature, unit=1, unit_name="error")
    claim("side of a contact", "thick/contact.rs", filters.side, unit=1, unit_name="error")
    claim("vector at a time", "locate.rs", places.at_time)
    claim("vector at a time, underflow", "locate.rs", places.at_time_underflow, unit=None)
    for field in MEETING:
        claim(f"meeting, {field}", "locate.rs", places.meeting, field, part="rounding")
        claim(f"meeting, {field}, width", "locate.rs", places.meeting, field, part="width")
    for field in MEETING:
        claim(f"meeting, {field}, underflow", "locate.rs", places.meeting, field, underflows=True, unit=None)
    for i in range(3):
        claim(f"weight {'bcd'[i]} of a face", "face/place.rs", places.weights, i, part="rounding")
        claim(f"weight {'bcd'[i]} of a face, width", "face/place.rs", places.weights, i, part="width")
    for i in range(3):
        claim(f"weight {'bcd'[i]} of a face, underflow", "face/place.rs", places.weights, i, underflows=True, unit=None)
    for name in ("add", "sub", "mul"):
        claim(f"double-double {name}", "double.rs", doubled.double_operation, name, unit=H, unit_name="h")
    claim("difference at a time", "refine.rs", doubled.refined_difference, unit=H, unit_name="h")
    claim("difference at a time, underflow", "refine.rs", doubled.refined_difference, underflows=True, unit=None)
    claim("value in double-double", "refine.rs", doubled.refined_value, unit=H, unit_name="h")
    claim("value in double-double, underflow", "refine.rs", doubled.refined_value, underflows=True, unit=None)
    for field in MEETING:
        claim(f"minor, {field}", "refine.rs", doubled.refined_meeting, field, unit=H, unit_name="h", part="rounding")
        claim(f"minor, {field}, width", "refine.rs", doubled.refined_meeting, field, part="width")
    for field in MEETING:
        claim(f"minor, {field}, underflow", "refine.rs", doubled.refined_meeting, field, underflows=True, unit=None)
    for kind in thick.LEAST_CORNERS:
        claim(f"margin with a radius, {kind}", "thick/advance.rs", thick.thick_margin, kind, part="margin")
        claim(f"margin with a radius, {kind}, R", "thick/advance.rs", thick.thick_margin, kind, part="radius", unit=1, unit_name="R |d|")
    claim("difference at a place", "thick/advance.rs", thick.difference_at_place)
    claim("velocity at a place", "thick/instant.rs", thick.velocity_at_place)
    for direction in thick.DIRECTIONS:
        claim(f"slope {direction}", "thick/nearness.rs", thick.slope_of, direction, part="rounding")
        claim(f"slope {direction}, while", "thick/nearness.rs", thick.slope_of, direction, part="width")
    claim("size of a slope", "thick/nearness.rs", thick.slope_size, unit=1, unit_name="")
    claim("component of a slope, underflow", "thick/nearness.rs", thick.component_underflow, unit=None)
    claim("slope, underflow", "thick/nearness.rs", thick.slope_underflow, unit=None)
    claim("least normal", "thick/nearness.rs", thick.least_normal, part="rounding")
    claim("least normal, while", "thick/nearness.rs", thick.least_normal, part="width")
    claim("slope of the distance", "thick/refine_toi.rs", thick.slope_of_distance)
    claim("difference in double-double", "thick/doubled.rs", thick.excess_at_time, unit=H, unit_name="h")
    claim("slope in double-double", "thick/doubled.rs", thick.doubled_slopes, unit=H, unit_name="h")
    claim("normal in double-double", "thick/doubled.rs", thick.doubled_normal, unit=H, unit_name="h")
    for kind in thick.LEAST_CORNERS:
        claim(f"corner in double-double, {kind}", "thick/sharp_plane.rs", thick.sharp_corner, kind, unit=H, unit_name="h")
    claim("change in a step", "thick/instant.rs", thick.change_in_a_step)
    for kind in thick.LEAST_CORNERS:
        for i in range(3):
            claim(f"turning plane, {kind}, {'abc'[i]}", "thick/turning.rs", thick.turning, kind, i, part="margin")
            unit, name = (U, "u") if i == 1 else (1, "R |n|" if i == 0 else "R d d/|n|")
            claim(f"turning plane, {kind}, {'abc'[i]}, R", "thick/turning.rs", thick.turning, kind, i, part="radius", unit=unit, unit_name=name)
    claim("difference at an instant", "discrete.rs", others.instant_difference)
    claim("distance at an instant", "discrete.rs", others.instant_distance)
    claim("distance at an instant, underflow", "discrete.rs", others.instant_distance, underflows=True, unit=None)
    for name in ("plus", "minus", "times", "cross"):
        claim(f"bounded vector, {name}", "normal/bounded.rs", others.bounded_operation, name, part="roundings")
        claim(f"bounded vector, {name}, errors", "normal/bounded.rs", others.bounded_operation, name, part="errors", unit=1, unit_name="")
    claim("bounded vector, difference", "normal/bounded.rs", others.bounded_difference, part="roundings")
    claim("bounded vector, difference, late", "normal/bounded.rs", others.bounded_difference, part="errors", unit=1, unit_name="")
    claim("stored position", "step.rs", others.stored)
    claim("stored position, overflow", "step.rs", others.stored, is_finite=False)
    claim("stored position, underflow", "step.rs", others.stored, underflows=True, unit=None)
    return add
