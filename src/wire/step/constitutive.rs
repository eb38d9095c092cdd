//! Constitutive laws of rows: piecewise linear functions from a row's excess to its multiplier.
//!
//! A row's multiplier is a function of its excess `e = G v - target`. A bilateral row has `e /
//! Sigma`. So has one of stretch, but it pushes no more than what buckles its segment, and a chain's
//! never does. A wire that turns
//! over a contact node has friction that takes up any slip, as far as its bound goes; and it slides
//! no further in a step than there is wire for. All of them rise, so they are the derivatives of
//! convex functions, which are piecewise quadratic.

/// How a row's multiplier follows from its excess.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ConstitutiveLaw {
    /// In proportion.
    Linear,
    /// In proportion, but a push is `most` N s at most.
    LimitedPush {
        /// 0 for a chain, which pulls only.
        most: f64,
    },
    /// Friction against the speed of sliding.
    Friction {
        /// The bound is this factor, `tanh(f D/2)`, times the sum of two pulls; one that pushes
        /// counts as 0.
        factor: f64,
        /// The multipliers of these two, by their unknowns.
        tensions: [usize; 2],
        /// What the pulls have beside them, in N s.
        weights: [f64; 2],
        /// The friction of what presses beside the pulls, in N s.
        pressed: f64,
        /// The largest magnitude of the friction, in N s: from the two as they were last.
        bound: f64,
        /// The fastest that the wire may slide towards lower and higher arc lengths, in m/s.
        reach: [f64; 2],
    },
}

/// One branch of a law: `offset`, and in addition `(e - start) / Sigma` if it is active.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Branch {
    /// Whether the multiplier rises with the excess.
    pub(super) active: bool,
    /// The excess from which it rises.
    pub(super) start: f64,
    /// The multiplier that is there whatever the excess is, in N s.
    pub(super) offset: f64,
    /// The lowest and highest excess at which the branch is the law.
    pub(super) range: [f64; 2],
}

impl Branch {
    /// A row that does not count.
    pub(super) const INACTIVE: Branch = Branch {
        active: false,
        start: 0.0,
        offset: 0.0,
        range: [f64::NEG_INFINITY, 0.0],
    };

    /// A row that counts.
    pub(super) const ACTIVE: Branch = Branch {
        active: true,
        start: 0.0,
        offset: 0.0,
        range: [0.0, f64::INFINITY],
    };

    /// A row that counts whatever its excess is.
    pub(super) const ALWAYS: Branch = Branch {
        range: [f64::NEG_INFINITY, f64::INFINITY],
        ..Branch::ACTIVE
    };

    /// The branch that holds at an excess of a law that rises from `start` on, and pushes with `most` N s at most.
    pub(super) fn of_push(excess: f64, start: f64, sigma: f64, most: f64) -> Branch {
        let end = start - sigma * most;
        if excess > end {
            Branch {
                start,
                range: [end, f64::INFINITY],
                ..Branch::ACTIVE
            }
        } else {
            Branch {
                offset: -most,
                range: [f64::NEG_INFINITY, end],
                ..Branch::INACTIVE
            }
        }
    }

    /// `Sigma` times the multiplier.
    pub(super) fn load(&self, excess: f64, sigma: f64) -> f64 {
        let counts = if self.active { 1.0 } else { 0.0 };
        counts * (excess - self.start) + sigma * self.offset
    }

    /// Whether it is one of friction that lets a wire slide beyond the end at which sliding ends,
    /// either way, or drives it to that end.
    pub(super) fn slides_too_far(&self, excess: f64, rounding: f64) -> bool {
        let along = excess * self.offset.signum();
        let [inner, outer] = match self.offset < 0.0 {
            true => [-self.range[1], -self.range[0]],
            false => self.range,
        };
        match self.active {
            false => along.abs() > outer + rounding,
            true => self.start != 0.0 && along < inner - rounding,
        }
    }

    /// Whether an excess is outside of its range by more than rounding.
    pub(super) fn is_left(&self, excess: f64, rounding: f64) -> bool {
        excess < self.range[0] - rounding || excess > self.range[1] + rounding
    }
}

/// The bound of friction in N s: the factor times the sum of two pulls, and the friction of what
/// presses beside them; nothing less than 0. With a factor of at least 1 the wire sticks at any
/// tension.
pub(super) fn friction_bound(factor: f64, pulls: [f64; 2], pressed: f64) -> f64 {
    if factor < 1.0 {
        (factor * (pulls[0].max(0.0) + pulls[1].max(0.0)) + pressed).max(0.0)
    } else {
        f64::INFINITY
    }
}

impl ConstitutiveLaw {
    /// The two pulls beside friction, in N s.
    pub(super) fn pulls(&self, x: &[f64]) -> [f64; 2] {
        match *self {
            ConstitutiveLaw::Friction {
                tensions, weights, ..
            } => [0, 1].map(|side| x[tensions[side]] + weights[side]),
            _ => [0.0; 2],
        }
    }

    /// The bound of friction, and the one that follows from a solution.
    pub(super) fn bounds(&self, x: &[f64]) -> Option<[f64; 2]> {
        match *self {
            ConstitutiveLaw::Friction {
                factor,
                pressed,
                bound,
                ..
            } => Some([bound, friction_bound(factor, self.pulls(x), pressed)]),
            _ => None,
        }
    }

    /// The bound of friction, to be set.
    pub(super) fn bound_mut(&mut self) -> Option<&mut f64> {
        match self {
            ConstitutiveLaw::Friction { bound, .. } => Some(bound),
            _ => None,
        }
    }

    /// The branch that holds at an excess.
    pub(super) fn branch(&self, excess: f64, sigma: f64) -> Branch {
        match *self {
            ConstitutiveLaw::Linear => Branch::ALWAYS,
            ConstitutiveLaw::LimitedPush { most } => Branch::of_push(excess, 0.0, sigma, most),
            ConstitutiveLaw::Friction { bound, reach, .. } => {
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
                    Branch {
                        range: [-stick, stick],
                        ..Branch::ACTIVE
                    }
                } else if excess.abs() <= reach {
                    Branch {
                        active: false,
                        start: 0.0,
                        offset: side * bound,
                        range: toward([stick, reach]),
                    }
                } else {
                    Branch {
                        active: true,
                        start: side * reach,
                        offset: side * bound,
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

    fn friction_law(bound: f64) -> ConstitutiveLaw {
        ConstitutiveLaw::Friction {
            factor: 0.1,
            tensions: [0, 1],
            weights: [0.0; 2],
            pressed: 0.0,
            bound,
            reach: [1.0, 2.0],
        }
    }

    #[test]
    fn friction_slides_too_far_beyond_the_end_and_on_the_way_to_it() {
        let law = friction_law(0.2);
        // Sticks up to 0.1, slides up to 1 and 2.
        let [back, stuck, forth, end] =
            [-0.5, 0.05, 0.5, 2.5].map(|excess: f64| law.branch(excess, 0.5));
        let too_far = |branch: Branch| {
            [-3.0, -0.5, 0.05, 0.5, 3.0].map(|excess: f64| branch.slides_too_far(excess, 1e-9))
        };
        assert_eq!(too_far(back), [true, false, false, false, true]);
        assert_eq!(too_far(stuck), [false; 5]);
        assert_eq!(too_far(forth), [true, false, false, false, true]);
        assert_eq!(too_far(end), [true, true, true, true, false]);
    }

    #[test]
    fn laws_rise_without_jumps_and_pieces_meet_at_their_ends() {
        let sigma = 0.5;
        let friction = friction_law(0.2);
        for law in [
            ConstitutiveLaw::Linear,
            ConstitutiveLaw::LimitedPush { most: 0.0 },
            ConstitutiveLaw::LimitedPush { most: 1.5 },
            friction,
        ] {
            let mut last = f64::NEG_INFINITY;
            for i in -400..400 {
                let excess = f64::from(i) / 100.0 + 0.005;
                let branch = law.branch(excess, sigma);
                assert!(!branch.is_left(excess, 0.0), "{law:?} {excess}");
                let load = branch.load(excess, sigma);
                assert!(load >= last && load - last <= 0.010_001 || i == -400);
                last = load;
                for end in branch.range.into_iter().filter(|end| end.is_finite()) {
                    let [below, above] = [-1e-9, 1e-9].map(|by| law.branch(end + by, sigma));
                    let [below, above] = [below, above].map(|branch| branch.load(end, sigma));
                    assert!((below - above).abs() < 1e-12, "{law:?} {end}");
                }
            }
        }
    }

    #[test]
    fn friction_is_a_share_of_what_pulls_and_has_no_end_from_the_whole_on() {
        assert_eq!(friction_bound(0.25, [4.0, 2.0], 0.0), 1.5);
        assert_eq!(friction_bound(0.25, [4.0, -2.0], 0.5), 1.5);
        assert_eq!(friction_bound(0.25, [4.0, 2.0], -2.0), 0.0);
        for factor in [1.0, f64::INFINITY] {
            assert_eq!(friction_bound(factor, [0.0, 0.0], 0.0), f64::INFINITY);
        }
        let mut law = friction_law(0.0);
        *law.bound_mut().unwrap() = 5.0;
        assert_eq!(law.bounds(&[10.0, 0.0]), Some([5.0, 1.0]));
        assert_eq!(ConstitutiveLaw::Linear.bounds(&[10.0, 0.0]), None);
    }

    #[test]
    fn friction_takes_up_slip_to_its_bound_and_stops_what_reaches_its_end() {
        let friction = friction_law(4.0);
        let multiplier = |excess| friction.branch(excess, 0.125).load(excess, 0.125) / 0.125;
        assert_eq!(multiplier(0.25), 2.0);
        assert_eq!([0.75, 2.0].map(multiplier), [4.0; 2]);
        assert_eq!([-0.75, -1.0].map(multiplier), [-4.0; 2]);
        assert_eq!(multiplier(2.5), 8.0);
        assert_eq!(multiplier(-1.5), -8.0);
    }
}
