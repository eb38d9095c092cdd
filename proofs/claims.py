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
    claim("difference in double-double", "thick/refine_toi.rs", thick.excess_at_time, unit=H, unit_name="h")
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


# Functions that proofs by hand speak of: their text is kept, so that a change of one asks for its proof.
BY_HAND = [
    ("separate", None, "span"),
    ("separate", "SweptBoxes", "around"),
    ("separate", "SweptBoxes", "is_certain"),
    ("cubic", "Cubic", "is_valid"),
    ("cubic", None, "have_one_sign"),
    ("root", "Cubic", "isolate_in"),
    ("root", "Cubic", "is_settled"),
    ("root", "Cubic", "bracket"),
    ("root", "Cubic", "within"),
    ("root", "Cubic", "least_slope"),
    ("root", "Cubic", "sharpen"),
    ("root", "Part", "falls_or_rises"),
    ("locate", "Meeting", "is_apart"),
    ("locate", "Meeting", "place"),
    ("face/place", None, "of_edges"),
    ("face/place", "RawWeights", "signs"),
    ("face/place", "RawWeights", "are_apart"),
    ("face/place", "RawWeights", "place"),
    ("double", None, "two_sum"),
    ("double", None, "two_difference"),
    ("double", None, "two_product"),
    ("double", "Double", "sum"),
    ("refine", "Root", "new"),
    ("refine", "Root", "round_down"),
    ("start", None, "common_end"),
    ("discrete", "Edges", "distance"),
    ("discrete", None, "length"),
    ("normal/bounded", "Bounded", "of"),
    ("normal/bounded", "Bounded", "normal"),
    ("step", None, "coordinate"),
    ("step", None, "rounding"),
    ("step", None, "coordinate_in"),
    ("step", None, "rounding_in"),
    ("step", None, "with_room"),
    ("thick/mod", "Moving", "is_ordinary"),
    ("thick/mod", "Moving", "is_within"),
    ("thick/advance", "Moving", "stays_apart_by"),
    ("thick/advance", "Moving", "advance"),
    ("thick/turning", "Moving", "stays_apart_turning"),
    ("thick/turning", None, "stays_positive"),
    ("thick/nearness", "Moving", "slopes"),
    ("thick/nearness", None, "least_normal"),
    ("thick/nearness", "Moving", "nearness"),
    ("thick/nearness", "Moving", "nearness_of_parallel"),
    ("thick/nearness", None, "alone"),
    ("thick/nearness", None, "beside"),
    ("thick/nearness", None, "inside"),
    ("thick/refine_toi", None, "refine_toi"),
    ("thick/refine_toi", None, "excess"),
    ("cubic", "Cubic", "is_not_identically_0"),
    ("cubic", "Cubic", "has_no_root"),
    ("refine", "Root", "near_f64"),
    ("step", None, "rounding_of"),
    ("step", None, "with"),
    ("step", "Limit", "decided"),
    ("thick/advance", None, "rounded_up"),
    ("thick/contact", None, "passage"),
    ("edges", "EdgeEdge", "place"),
    ("edges", None, "crossing"),
    ("face/mod", "VertexFace", "place"),
    ("face/mod", None, "crossing"),
    ("thick/advance", "Moving", "margins"),
    ("exact/integer", "Integer", "approximate"),
    ("exact/integer", "Integer", "approximate_shifted"),
    ("exact/integer", None, "ratio"),
    ("exact/integer", None, "scale"),
    ("exact/integer", None, "power"),
    ("exact/unlimited", "Boxed", "to_f64"),
    ("exact/width", "Wide", "to_f64"),
    ("exact/roots", None, "cut_between"),
    ("exact/mod", None, "edge_hit"),
    ("exact/face", "Face", "hit"),
    ("exact/thick/mod", None, "edge_hit"),
    ("exact/thick/mod", None, "face_hit"),
    ("exact/rigid/mod", None, "decide_turning_edges"),
    ("exact/rigid/mod", None, "decide_turning_face"),
    ("exact/thick/parallel", None, "near_start_of_parallel_edges"),
    ("exact/thick/parallel", None, "contact_of_parallel_edges"),
    ("exact/thick/parallel", None, "hit"),
    ("exact/thick/parallel", "Quadratic", "at"),
    ("exact/thick/parallel", "Quadratic", "sign_at"),
    ("exact/thick/parallel", "Quadratic", "share_of"),
    ("rigid", None, "bend"),
    ("rigid", "Moving", "new"),
    ("rigid", "MovingFirst", "far"),
    ("rigid", "MovingBody", "far"),
    ("rigid", "MovingBody", "stray"),
    ("rigid/ball", "Ball", "sum_of"),
    ("rigid/ball", "Ball", "mul"),
    ("rigid/ball", "Ball", "widened"),
    ("rigid/ball", "Ball", "rounded"),
    ("rigid/ball", "Ball", "sign"),
    ("rigid/ball", "Ball", "most"),
    ("rigid/ball", "Ball", "least"),
    ("rigid/rough", "Rough", "add"),
    ("rigid/rough", "Rough", "mul"),
    ("rigid/series", "Series", "sign_within"),
    ("rigid/series", "Series", "slope_sign_within"),
    ("rigid/series", "Series", "rest"),
    ("rigid/root", None, "root_after"),
    ("rigid/root", None, "step"),
    ("rigid/root", None, "bracket"),
    ("rigid/root", None, "is_only"),
    ("rigid/place", None, "inside"),
    ("rigid/place", None, "quotient"),
    ("rigid/normal", "Turning", "normal"),
    ("rigid/normal", "Differences", "at"),
    ("rigid/contact", None, "touch_near"),
    ("rigid/contact", "Part", "touch"),
    ("rigid/contact", "Part", "holds_until"),
    ("rigid/contact", "Part", "is_clear"),
]

# Files of which all functions are kept so: the filters of the integer stage, normals, one instant, points in space and bodies that turn.
WHOLE_BY_HAND = [
    "contact",
    "discrete",
    "normal",
    "normal/bounded",
    "exact/bracket/quotient",
    "exact/enclosure",
    "exact/fraction",
    "exact/grid_time",
    "exact/isolate_f64",
    "exact/time",
    "rigid",
    "rigid/ball",
    "rigid/contact",
    "rigid/differences",
    "rigid/features",
    "rigid/normal",
    "rigid/place",
    "rigid/root",
    "rigid/rough",
    "rigid/series",
    "thick/refine_toi",
]
