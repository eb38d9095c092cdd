//! Laws of multipliers that are not free: linear in pieces.
//!
//! A row's multiplier is a function of its excess `e = G v - target`. A bilateral row has `e / Sigma`; a chain's, which never
//! pushes, the same for `e > 0` and nothing below. A wire that turns over a contact node has friction that takes
//! up any slip, as far as its bound goes; and it slides no further in a step than there is wire for. All of them rise, so they
//! are the derivatives of convex functions, which are quadratic in pieces.

/// How a row's multiplier follows from its excess.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Law {
    /// In proportion.
    Free,
    /// In proportion where the excess is above 0, else none: a pull, never a push.
    Pulls,
    /// Friction against the speed of sliding.
    Grips {
        /// Which share of two other multipliers it may have, without those that push.
        share: f64,
        /// These two, by their unknowns.
        tensions: [usize; 2],
        /// The largest magnitude of the friction, in N s: the share of the two as they were last.
        bound: f64,
        /// The fastest that the wire may slide towards lower and higher arc lengths, in m/s.
        reach: [f64; 2],
    },
}

/// One piece of a law: `held`, and in addition `(e - start) / Sigma` if it is active.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    /// Whether the multiplier rises with the excess.
    pub(super) active: bool,
    /// The excess from which it rises.
    pub(super) start: f64,
    /// The multiplier that is there whatever the excess is, in N s.
    pub(super) held: f64,
    /// From which to which excess the piece is the law.
    pub(super) range: [f64; 2],
}

impl Piece {
    /// A row that does not count.
    pub(super) const NONE: Piece = Piece {
        active: false,
        start: 0.0,
        held: 0.0,
        range: [f64::NEG_INFINITY, 0.0],
    };

    /// A row that counts.
    pub(super) const FULL: Piece = Piece {
        active: true,
        start: 0.0,
        held: 0.0,
        range: [0.0, f64::INFINITY],
    };

    /// `Sigma` times the multiplier.
    pub(super) fn load(&self, excess: f64, sigma: f64) -> f64 {
        let counts = if self.active { 1.0 } else { 0.0 };
        counts * (excess - self.start) + sigma * self.held
    }

    /// Whether an excess is outside of its range by more than rounding.
    pub(super) fn is_left(&self, excess: f64, rounding: f64) -> bool {
        excess < self.range[0] - rounding || excess > self.range[1] + rounding
    }
}

/// The bound of friction that has this share of two pulls, in N s. With a share from 1 on the wire sticks whatever they are.
pub(super) fn friction(share: f64, pulls: [f64; 2]) -> f64 {
    if share < 1.0 {
        share * (pulls[0].max(0.0) + pulls[1].max(0.0))
    } else {
        f64::INFINITY
    }
}

impl Law {
    /// The bound of friction, and the one that follows from a solution.
    pub(super) fn bounds(&self, x: &[f64]) -> Option<[f64; 2]> {
        match *self {
            Law::Grips {
                share,
                tensions,
                bound,
                ..
            } => Some([bound, friction(share, tensions.map(|at| x[at]))]),
            _ => None,
        }
    }

    /// Sets the bound of friction to the one that follows from a solution.
    pub(super) fn follow(&mut self, x: &[f64]) {
        let bounds = self.bounds(x);
        if let (Law::Grips { bound, .. }, Some([_, due])) = (self, bounds) {
            *bound = due;
        }
    }

    /// The piece that holds at an excess.
    pub(super) fn piece(&self, excess: f64, sigma: f64) -> Piece {
        match *self {
            Law::Free => Piece {
                range: [f64::NEG_INFINITY, f64::INFINITY],
                ..Piece::FULL
            },
            Law::Pulls if excess > 0.0 => Piece::FULL,
            Law::Pulls => Piece::NONE,
            Law::Grips { bound, reach, .. } => {
                let (side, reach) = if excess < 0.0 {
                    (-1.0, reach[0])
                } else {
                    (1.0, reach[1])
                };
                let stick = sigma * bound;
                let reach = reach.max(stick);
                let toward = |range: [f64; 2]| {
                    if side < 0.0 {
                        [-range[1], -range[0]]
                    } else {
                        range
                    }
                };
                if excess.abs() <= stick {
                    Piece {
                        range: [-stick, stick],
                        ..Piece::FULL
                    }
                } else if excess.abs() <= reach {
                    Piece {
                        active: false,
                        start: 0.0,
                        held: side * bound,
                        range: toward([stick, reach]),
                    }
                } else {
                    Piece {
                        active: true,
                        start: side * reach,
                        held: side * bound,
                        range: toward([reach, f64::INFINITY]),
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grips(bound: f64) -> Law {
        Law::Grips {
            share: 0.1,
            tensions: [0, 1],
            bound,
            reach: [1.0, 2.0],
        }
    }

    #[test]
    fn laws_rise_without_jumps_and_pieces_meet_at_their_ends() {
        let sigma = 0.5;
        let grips = grips(0.2);
        for law in [Law::Free, Law::Pulls, grips] {
            let mut last = f64::NEG_INFINITY;
            for i in -400..400 {
                let excess = f64::from(i) / 100.0 + 0.005;
                let piece = law.piece(excess, sigma);
                assert!(!piece.is_left(excess, 0.0), "{law:?} {excess}");
                let load = piece.load(excess, sigma);
                assert!(load >= last && load - last <= 0.010_001 || i == -400);
                last = load;
                for end in piece.range.into_iter().filter(|end| end.is_finite()) {
                    let [below, above] = [-1e-9, 1e-9].map(|by| law.piece(end + by, sigma));
                    let [below, above] = [below, above].map(|piece| piece.load(end, sigma));
                    assert!((below - above).abs() < 1e-12, "{law:?} {end}");
                }
            }
        }
    }

    #[test]
    fn friction_is_a_share_of_what_pulls_and_has_no_end_from_the_whole_on() {
        assert_eq!(friction(0.25, [4.0, 2.0]), 1.5);
        assert_eq!(friction(0.25, [4.0, -2.0]), 1.0);
        for share in [1.0, f64::INFINITY] {
            assert_eq!(friction(share, [0.0, 0.0]), f64::INFINITY);
        }
        let mut law = grips(0.0);
        law.follow(&[30.0, 20.0]);
        assert_eq!(law.bounds(&[10.0, 0.0]), Some([5.0, 1.0]));
    }

    #[test]
    fn friction_takes_up_slip_to_its_bound_and_stops_what_reaches_its_end() {
        let grips = grips(4.0);
        let multiplier = |excess| grips.piece(excess, 0.125).load(excess, 0.125) / 0.125;
        assert_eq!(multiplier(0.25), 2.0);
        assert_eq!([0.75, 2.0].map(multiplier), [4.0; 2]);
        assert_eq!([-0.75, -1.0].map(multiplier), [-4.0; 2]);
        assert_eq!(multiplier(2.5), 8.0);
        assert_eq!(multiplier(-1.5), -8.0);
    }
}
