use proptest::prelude::*;

use super::*;

fn vector() -> impl Strategy<Value = Vector> {
    [-1.0..1.0, -1.0..1.0, -1.0..1.0].prop_map(Vector::from)
}

proptest! {
    /// Where a contact slides, Newton's method comes to Coulomb's law, from which projections do not lead away.
    #[test]
    fn sliding_contact_obeys_coulombs_law(
        rows in [vector(), vector(), vector()],
        others in vector(),
        friction in 0.05..0.8,
    ) {
        let root = Matrix3::from_columns(&rows);
        let mobility = root * root.transpose() + Matrix3::identity() * 0.3;
        let others = Vector::new(-others.x.abs() - 0.1, others.y, others.z);
        let start = Vector::zeros();
        let factor = mobility.cholesky();
        let impulse = solve_block(&mobility, factor.as_ref(), &others, friction, &start);
        let slides = |impulse: &Vector| impulse.yz().norm() > friction * impulse.x * (1.0 - 1e-9);
        prop_assume!(slides(&impulse));
        let velocity = mobility * impulse + others;
        let (along, sliding) = (impulse.yz().normalize(), velocity.yz());
        let across = along.x * sliding.y - along.y * sliding.x;
        // Where it is not found so, projections may need more than one solve.
        prop_assume!(slide(&mobility, &others, friction, &start).is_some());
        let rounding = 1e-12 * impulse.x.max(1.0);
        prop_assert!(velocity.x.abs() < rounding, "{velocity}");
        prop_assert!((impulse.yz().norm() - friction * impulse.x).abs() < rounding);
        prop_assert!(across.abs() < rounding, "{across}");
        prop_assert!(along.dot(&sliding) <= 0.0);
        let projected = project(&mobility, &others, friction, &impulse);
        prop_assert!((projected - impulse).amax() < rounding, "{projected} {impulse}");
    }
}

/// Newton's method is the usual way.
#[test]
fn sliding_contact_is_found_by_newtons_method() {
    let mobility = Matrix3::new(2.0, 0.3, -0.2, 0.3, 1.5, 0.1, -0.2, 0.1, 1.0);
    let others = Vector::new(-1.0, 2.0, -1.0);
    let found = slide(&mobility, &others, 0.5, &Vector::zeros()).unwrap();
    let mut projected = found;
    for _ in 0..20 {
        projected = project(&mobility, &others, 0.5, &projected);
    }
    assert!((projected - found).amax() < 1e-14, "{projected} {found}");
}
