//! The faults.

/// Whose sources a fault is planted in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Culprit {
    Thesis,
    Shadow,
    Oracle,
    Certified,
    /// The certified path with a radius above 0.
    Thick,
    /// Certified steps, of pairs and of meshes.
    Step,
}

/// A fault: a text that occurs once in a file, and what takes its place.
pub(crate) struct Mutant {
    pub(crate) culprit: Culprit,
    /// In the repository.
    pub(crate) file: &'static str,
    pub(crate) text: &'static str,
    pub(crate) replacement: &'static str,
    /// What is wrong then.
    pub(crate) fault: &'static str,
}

pub(crate) const MUTANTS: &[Mutant] = &[
    Mutant {
        culprit: Culprit::Thesis,
        file: "src/thesis/parallel.rs",
        text: "let beta = l.p - k.p;",
        replacement: "let beta = k.p - l.p;",
        fault: "Algorithm 10: a sign makes points meet before the step that meet in it",
    },
    Mutant {
        culprit: Culprit::Thesis,
        file: "src/thesis/parallel.rs",
        text: "negligible(t - other, same_root)",
        replacement: "negligible(t + other, same_root)",
        fault: "Algorithm 12: a sign loses the common roots of two equations",
    },
    Mutant {
        culprit: Culprit::Thesis,
        file: "src/thesis/planar.rs",
        text: "[(p0, p2, p3), (p1, p2, p3), (p2, p0, p1), (p3, p0, p1)]",
        replacement: "[(p0, p2, p3), (p1, p2, p3), (p2, p0, p1)]",
        fault: "Algorithm 18: one of four ends is forgotten",
    },
    Mutant {
        culprit: Culprit::Thesis,
        file: "src/thesis/solve.rs",
        text: "} else if sign_left == -sign_right {",
        replacement: "} else if sign_left > sign_right {",
        fault: "Solve: roots at which the polynomial rises are dropped",
    },
    Mutant {
        culprit: Culprit::Shadow,
        file: "reference/src/shadow/parallel.rs",
        text: "ab[0].compare(&cd[1]).is_le()",
        replacement: "ab[0].compare(&cd[1]).is_lt()",
        fault: "Algorithm 9: `<` for `<=`",
    },
    Mutant {
        culprit: Culprit::Shadow,
        file: "reference/src/shadow/planar.rs",
        text: "let l = [r.dot(&b), -s.dot(&b)];",
        replacement: "let l = [r.dot(&b), s.dot(&b)];",
        fault: "Algorithm 16: a sign in the normal equations",
    },
    Mutant {
        culprit: Culprit::Shadow,
        file: "reference/src/shadow/kind.rs",
        text: "before != after && edges().cut_inside_both()",
        replacement: "edges().cut_inside_both()",
        fault: "a double root is taken for a crossing",
    },
    Mutant {
        culprit: Culprit::Oracle,
        file: "reference/src/oracle/general.rs",
        text: "let mut contacts = times.filter_map(",
        replacement: "let mut contacts = times.take(2).filter_map(",
        fault: "the third root of the cubic is dropped",
    },
    Mutant {
        culprit: Culprit::Oracle,
        file: "reference/src/oracle/confined.rs",
        text: ".find(|time| time.sign_of(&self.between).is_le())",
        replacement: ".find(|time| time.sign_of(&self.between).is_lt())",
        fault: "an end that comes onto an end is no contact",
    },
    Mutant {
        culprit: Culprit::Oracle,
        file: "reference/src/oracle/edges.rs",
        text: "let d = self.m.add(&self.l).dot(&self.k);",
        replacement: "let d = self.m.sub(&self.l).dot(&self.k);",
        fault: "a sign puts D on the other side of C on the common line",
    },
    Mutant {
        culprit: Culprit::Certified,
        file: "src/certified/separate.rs",
        text: "let margin = m + l.smaller(E::both(0.0)) - k.larger(E::both(0.0));",
        replacement: "let margin = m + l.larger(E::both(0.0)) - k.larger(E::both(0.0));",
        fault: "a direction separates if it separates one end of CD",
    },
    Mutant {
        culprit: Culprit::Certified,
        file: "src/certified/cubic.rs",
        text: "error: 16.0 * U * permanent,",
        replacement: "error: 0.25 * U * permanent,",
        fault: "the error bound of the cubic is too small",
    },
    Mutant {
        culprit: Culprit::Certified,
        file: "src/certified/root.rs",
        text: "        self.isolate_in(lower, is_apart, found)?;\n",
        replacement: "        let _ = lower;\n",
        fault: "roots in the lower half of a part are dropped",
    },
    Mutant {
        culprit: Culprit::Certified,
        file: "src/certified/locate.rs",
        text: "20.0 * U + 5.0 * half_width",
        replacement: "0.25 * half_width",
        fault: "the error bound of the place at a root is too small",
    },
    Mutant {
        culprit: Culprit::Certified,
        file: "src/certified/refine.rs",
        text: "            high.next_down()\n",
        replacement: "            high\n",
        fault: "a time of impact is rounded up",
    },
    Mutant {
        culprit: Culprit::Certified,
        file: "src/certified/exact/confined.rs",
        text: "self.meets_line(time) && time.sign_of(&self.between).is_le()",
        replacement: "self.meets_line(time) && time.sign_of(&self.between).is_lt()",
        fault: "an end that comes onto an end is no contact",
    },
    Mutant {
        culprit: Culprit::Thick,
        file: "src/certified/thick/turning.rs",
        text: "let root = 2.0 * a / divisor * (1.0 - 16.0 * U);",
        replacement: "let root = 4.0 * a / divisor * (1.0 - 16.0 * U);",
        fault: "a plane is said to separate for twice as long",
    },
    Mutant {
        culprit: Culprit::Thick,
        file: "src/certified/edges.rs",
        text: "m + l.smaller(zero) - k.larger(zero)",
        replacement: "m + l.smaller(zero) - k.smaller(zero)",
        fault: "a direction separates if it separates one end of AB",
    },
    Mutant {
        culprit: Culprit::Thick,
        file: "src/certified/thick/refine_toi.rs",
        text: "let first = x / (2.0 * slope);",
        replacement: "let first = x / slope;",
        fault: "the last step to the contact is twice as long",
    },
    Mutant {
        culprit: Culprit::Thick,
        file: "src/certified/thick/nearness.rs",
        text: "(square > SMALLEST && least > 0.0).then_some(least)",
        replacement: "(!square.is_nan()).then(|| square.sqrt())",
        fault: "edges that may be parallel where they touch are said to be not",
    },
    Mutant {
        culprit: Culprit::Step,
        file: "src/certified/step.rs",
        text: "(side(0..K::FIRST) + side(K::FIRST..4)) * (1.0 + 8.0 * f64::EPSILON)",
        replacement: "(side(0..K::FIRST) + side(K::FIRST..4)) * 0.0",
        fault: "the time of impact is used as it is, without room for rounding",
    },
    Mutant {
        culprit: Culprit::Step,
        file: "src/certified/step.rs",
        text: "first_toi::<K>(&stored, kept).is_none()",
        replacement: "first_toi::<K>(&stored, Radius::ZERO).is_none()",
        fault: "stored motions are decided without the radius",
    },
    Mutant {
        culprit: Culprit::Step,
        file: "src/mesh/candidates.rs",
        text: "if !is_shared && !self.question.mesh.is_left_out(a, b) {",
        replacement: "if !is_shared && a[0] != 0 && !self.question.mesh.is_left_out(a, b) {",
        fault: "pairs of a mesh are dropped",
    },
    Mutant {
        culprit: Culprit::Step,
        file: "src/mesh/step.rs",
        text: "let largest = roomy_step.chain(tight_step).fold(1.0, f64::min);",
        replacement: "let largest = tight_step.chain(roomy_step).fold(0.0, f64::max);",
        fault: "a mesh takes the largest step of its pairs",
    },
];
