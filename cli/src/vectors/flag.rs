//! Flags: what is special about a vector, and what goes wrong there in which kind of
//! implementation.

use serde::Serialize;
use tunnelproof::contact::Case;
use tunnelproof::thesis::Erratum;

use super::method::Method;
use tunnelproof_reference::certify::tally::Fault;

/// One property of a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Flag {
    /// The motion is not general.
    Motion(Case),
    /// The first contact is at 0.
    ContactAtStart,
    /// The first contact is at 1.
    ContactAtEnd,
    /// The first contact is inside the step, without passing through.
    Graze,
    /// The first contact is a graze, a later one a crossing.
    LaterCrossing,
    /// An end of an edge touches.
    EndOfEdge,
    /// The vertex touches an edge or a corner of the face.
    BorderOfFace,
    /// With a radius: what touches passes through each other in the step.
    PassesThrough,
    /// The radius is a sum of two that no `f64` is.
    SumOfRadii,
    /// The edges touch in more than a point.
    Overlap,
    /// Parallel at the time of impact alone.
    TemporarilyParallel,
    /// An edge is a point at the time of impact alone.
    TemporarilyPoint,
    /// The time of impact is a multiple root of the cubic.
    MultipleRoot,
    /// The time of impact is no fraction.
    IrrationalTime,
    /// Products of coordinates leave the range of `f64`.
    ExtremeRange,
    /// A method gets it wrong.
    Failure(Fault, Method),
    /// A witness of an erratum of the thesis' text.
    Erratum(Erratum),
    /// A figure of the thesis.
    ThesisFigure,
    /// A situation that someone reported.
    PublicReport,
    /// One of two segments of a wire that another segment passes through.
    WireJoint,
}

/// What a flag means, in the header of a file.
#[derive(Debug, Serialize)]
pub(super) struct Note {
    bug_type: &'static str,
    description: String,
    effect: String,
}

impl Flag {
    pub(super) fn name(self) -> String {
        let name = match self {
            Flag::Motion(case) => return camel(case.name()) + "Motion",
            Flag::Failure(fault, method) => return camel(fault.name()) + "In" + method.name(),
            Flag::Erratum(erratum) => return "Erratum".to_owned() + &camel(erratum.name()),
            Flag::ContactAtStart => "ContactAtStart",
            Flag::ContactAtEnd => "ContactAtEnd",
            Flag::Graze => "Graze",
            Flag::LaterCrossing => "LaterCrossing",
            Flag::EndOfEdge => "EndOfEdge",
            Flag::BorderOfFace => "BorderOfFace",
            Flag::PassesThrough => "PassesThrough",
            Flag::SumOfRadii => "SumOfRadii",
            Flag::Overlap => "Overlap",
            Flag::TemporarilyParallel => "TemporarilyParallel",
            Flag::TemporarilyPoint => "TemporarilyPoint",
            Flag::MultipleRoot => "MultipleRoot",
            Flag::IrrationalTime => "IrrationalTime",
            Flag::ExtremeRange => "ExtremeRange",
            Flag::ThesisFigure => "ThesisFigure",
            Flag::PublicReport => "PublicReport",
            Flag::WireJoint => "WireJoint",
        };
        name.to_owned()
    }

    pub(super) fn note(self) -> Note {
        let (bug_type, description, effect) = match self {
            Flag::Motion(case) => return motion(case),
            Flag::Failure(fault, method) => return failure(fault, method),
            Flag::Erratum(erratum) => return self::erratum(erratum),
            Flag::ContactAtStart => (
                "boundary",
                "There is contact at t = 0; with a radius, the two are within it then.",
                "Implementations that look for roots in (0, 1] or for a change of sign report no contact \
                 or a later one.",
            ),
            Flag::ContactAtEnd => (
                "boundary",
                "The first contact is at t = 1.",
                "Implementations that look for roots in [0, 1) or round a root to more than 1 report no \
                 contact; the next step starts in contact.",
            ),
            Flag::Graze => (
                "boundary",
                "The first contact is inside the step, and the two do not pass through each other \
                 there: a double root, or contact at an end of an edge, or on the border of the face.",
                "Implementations that look for changes of sign, or compare rounded parameters with 0 \
                 and 1, report no contact.",
            ),
            Flag::LaterCrossing => (
                "boundary",
                "The first contact is a graze, and a later contact of the step is a crossing.",
                "An implementation that misses the graze and stops there lets them through.",
            ),
            Flag::EndOfEdge => (
                "boundary",
                "An end of an edge touches: u or v is exactly 0 or 1 at the time of impact.",
                "Parameters that round to less than 0 or more than 1 make it a miss.",
            ),
            Flag::BorderOfFace => (
                "boundary",
                "The vertex touches an edge or a corner of the face, or is nearest to one.",
                "Weights that round to less than 0 make it a miss, of both faces that share the edge: the \
                 vertex goes through a closed mesh.",
            ),
            Flag::PassesThrough => (
                "boundary",
                "With a radius: the midlines, or the vertex and the face, pass through each other in the \
                 step, at the time of impact or later.",
                "Who misses this contact lets them through.",
            ),
            Flag::SumOfRadii => (
                "rounding",
                "The radius is the sum of two numbers of which no f64 is the sum.",
                "Who adds them in f64 asks about another radius.",
            ),
            Flag::Overlap => (
                "degeneracy",
                "The edges touch in more than a point at the time of impact; with a radius, they are nearest in \
                 more than a point.",
                "The lines have no single common point: implementations that solve for u and v divide by \
                 0, and report no contact or one of the two ends.",
            ),
            Flag::TemporarilyParallel => (
                "degeneracy",
                "At the time of impact, and not for the whole step, the edges are parallel, or the face is a \
                 segment.",
                "Implementations that solve for u and v at the root divide by 0 or by what rounding left.",
            ),
            Flag::TemporarilyPoint => (
                "degeneracy",
                "An edge or the face is a point at the time of impact and not for the whole step.",
                "Implementations that normalise directions or solve for u and v divide by 0.",
            ),
            Flag::MultipleRoot => (
                "rounding",
                "The time of impact is a multiple root of the cubic that is 0 when the four points are coplanar.",
                "Half of the digits of a double root, two thirds of those of a triple root are lost to \
                 rounding, or the root is not found at all.",
            ),
            Flag::IrrationalTime => (
                "rounding",
                "The time of impact is an irrational root of an integer polynomial.",
                "No f64 is the time of impact: rounded up, it is past the contact.",
            ),
            Flag::ExtremeRange => (
                "range",
                "A coordinate that is not 0 is below 1e-60 or above 1e60 in magnitude.",
                "Products of three differences overflow or underflow: the cubic is infinite, NaN or 0.",
            ),
            Flag::ThesisFigure => (
                "origin",
                "A case of section 4.1 of the thesis, with coordinates that fulfil its caption.",
                "None of its own.",
            ),
            Flag::PublicReport => (
                "origin",
                "A situation from a public bug report, named in the comment, rebuilt as a query of its \
                 own with numbers that are exactly representable.",
                "What the report says of the implementation that it is about.",
            ),
            Flag::WireJoint => (
                "origin",
                "One of two consecutive segments of a wire, which the other edge passes at or near the \
                 node they share: a hit is due in at least one of the two.",
                "If both segments miss, the wire is passed through at its joint, though each miss alone \
                 may look like that of a graze.",
            ),
        };
        note(bug_type, description, effect)
    }
}

fn note(bug_type: &'static str, description: &str, effect: &str) -> Note {
    Note {
        bug_type,
        description: description.to_owned(),
        effect: effect.to_owned(),
    }
}

fn motion(case: Case) -> Note {
    let (description, effect) = match case {
        Case::General => (
            "No degeneracy lasts for the whole step.",
            "None of its own.",
        ),
        Case::Parallel => (
            "The edges are parallel for the whole step, on two lines.",
            "The cubic is 0 or noise at all times, and the lines never meet in one point.",
        ),
        Case::Coplanar => (
            "All four points share a plane for the whole step.",
            "The cubic is identically 0: implementations that look for its roots find none, or those \
             that rounding makes.",
        ),
        Case::Collinear => (
            "All four points share a line for the whole step.",
            "The cubic and the cross product of the edges are identically 0.",
        ),
        Case::SharedStart => (
            "A and C are the same point for the whole step.",
            "The edges touch at 0 whatever else they do; the cubic is identically 0.",
        ),
        Case::Degenerate => (
            "An edge is a point, or the face has no area, for the whole step.",
            "The cubic is identically 0, and the edge has no direction or the face no normal.",
        ),
    };
    note("degeneracy", description, effect)
}

fn failure(fault: Fault, method: Method) -> Note {
    let (wrong, effect) = match fault {
        Fault::Tunnel => (
            "A crossing that is missed",
            "The edges pass through each other unnoticed.",
        ),
        Fault::JointTunnel => (
            "A wire that is passed at a joint and missed by both segments",
            "The wire is passed through unnoticed.",
        ),
        Fault::MissedGraze => (
            "A contact without crossing that is missed",
            "A contact is not responded to.",
        ),
        Fault::FalseHit => (
            "A contact that does not exist is reported",
            "The step is cut short, and what is apart is pushed apart.",
        ),
        Fault::NearHit => (
            "A contact is reported that does not exist, within the distance that the method allows \
             itself",
            "The step is cut short.",
        ),
        Fault::NoAnswer => (
            "No answer, or one without meaning",
            "The simulation cannot go on.",
        ),
        Fault::WrongCase => ("The motion is taken for another case", "None by itself."),
        Fault::Differs => (
            "Hit and miss are right, something else of the answer is not",
            "The response is at a wrong time or place.",
        ),
        Fault::Late => (
            "A time of impact that is later than the exact one",
            "Who advances to it is past the contact.",
        ),
        Fault::Early => (
            "A time of impact that is earlier than the exact one",
            "The step is cut short.",
        ),
    };
    Note {
        bug_type: "known failure",
        description: format!("{wrong} by {}.", method.description()),
        effect: effect.to_owned(),
    }
}

fn erratum(erratum: Erratum) -> Note {
    Note {
        bug_type: "known failure",
        description: format!(
            "A witness of the erratum {erratum} of Algorithm {} of the thesis. {}",
            erratum.algorithm(),
            erratum.description()
        ),
        effect: "docs/errata.md says what an implementation of the text to the letter answers."
            .to_owned(),
    }
}

/// `missed-graze` and `missed graze` as `MissedGraze`.
fn camel(name: &str) -> String {
    let words = name.split([' ', '-']);
    let capital = |word: &str| {
        let (first, rest) = word.split_at(1);
        first.to_ascii_uppercase() + rest
    };
    words.map(capital).collect()
}
