use super::*;
use crate::wire::collide::remesh;
use crate::wire::collide::wire_contacts::WireContacts;
use crate::wire::{
    Collisions, ContactSite, Material, Mode, Remesh, RemeshKind, Settings, StepRecord, Stop,
    Vector, WireId, WirePlan,
};

const RADIUS: f64 = 0.01;

fn weightless() -> World {
    World::new(Settings::default().with_gravity(Vector::zeros())).unwrap()
}

fn add(world: &mut World, route: &[[f64; 3]], stop: fn(Point) -> Stop, velocity: Vector) -> WireId {
    let route = route.iter().map(|&point| stop(point.into())).collect();
    let mut plan = WirePlan::new(Material::steel(RADIUS).chain(), 10.0, route);
    plan.resolution.adaptive = false;
    plan.velocity = velocity;
    world.add_wire(&plan).unwrap()
}

fn pair(segments: [(usize, usize); 2]) -> [SegmentId; 2] {
    segments.map(|(wire, segment)| {
        let wire = WireId(wire);
        SegmentId { wire, segment }
    })
}

fn thick(kappa: f64) -> Collisions<'static> {
    Collisions::default().with_guarded_thickness(kappa).unwrap()
}

fn distance(world: &World, two: [SegmentId; 2]) -> f64 {
    let [a, b] = two.map(|segment| segment.ends(world));
    let query = EdgeEdge::at_rest([a[0], a[1], b[0], b[1]], 0.0).unwrap();
    decide_discrete(&query).distance_low
}

#[test]
fn share_has_to_be_below_one() {
    for share in [-0.1, 1.0, f64::NAN, f64::INFINITY] {
        assert!(Collisions::default().with_guarded_thickness(share).is_err());
    }
    let thesis = Collisions::new(
        Mode::Thesis,
        Default::default(),
        &crate::certified::Certified,
    );
    let thesis = thesis.with_guarded_thickness(0.5).unwrap();
    assert_eq!(thesis.thickness(), Thickness::default());
}

/// At each distance of the scale and at its neighbours in `f64`.
#[test]
fn beyond_is_exact_at_every_step_of_the_scale() {
    let mut world = weightless();
    for z in [0.0, 1.0] {
        let across = if z == 0.0 {
            [1.0, 0.0, z]
        } else {
            [0.0, 1.0, z]
        };
        let from = [-across[0], -across[1], z];
        add(&mut world, &[from, across], Stop::Free, Vector::zeros());
    }
    let two = pair([(0, 0), (1, 0)]);
    let thickness = Thickness(0.37);
    for step in 1..=STEPS {
        let [r, s] = thickness.radii(&world, two, step);
        assert_eq!(r, s);
        let at = |z: f64| {
            let p = Point::new;
            let points = [
                p(-1.0, 0.0, 0.0),
                p(1.0, 0.0, 0.0),
                p(0.0, -1.0, z),
                p(0.0, 1.0, z),
            ];
            thickness.beyond(&world, two, points, STEPS).unwrap()
        };
        // The sum of two equal numbers is exact.
        let sum = r + s;
        let found = [sum.next_down(), sum, sum.next_up()].map(at);
        assert_eq!(found, [step - 1, step - 1, step]);
    }
}

/// A straight wire and half a circle are farther from themselves than they touch.
#[test]
fn bends_up_to_half_a_circle_touch_nothing() {
    for length in [0.3, 1.0, 1.9, 5.0].map(|diameters| diameters * 2.0 * RADIUS) {
        for bend in [0.0, 1.0, 3.0] {
            let mut world = weightless();
            // Twelve segments on an arc.
            let point = |k: usize| {
                let s = length * k as f64 / 12.0;
                let angle: f64 = bend * s / length;
                if bend == 0.0 {
                    [s, 0.0, 0.0]
                } else {
                    [
                        length / bend * angle.sin(),
                        length / bend * angle.cos(),
                        0.0,
                    ]
                }
            };
            let route: Vec<_> = (0..=12).map(point).collect();
            let wire = add(&mut world, &route, Stop::Free, Vector::zeros());
            for (i, j) in (0..12).flat_map(|j| (0..j).map(move |i| (i, j))) {
                let two = pair([(wire.0, i), (wire.0, j)]);
                let [a, b] = [0, 1].map(|k| two[k].site(&world, if k == 0 { 1.0 } else { 0.0 }));
                let touching = Thickness(0.5).touching(&world, two, &[a, b]);
                let apart = distance(&world, two);
                assert!(apart >= touching || j == i + 1, "{length} {bend} {i} {j}");
            }
        }
    }
}

#[test]
fn segments_shorter_than_the_wire_is_thick_are_known_by_the_stretch_between() {
    let mut world = weightless();
    let quarter = RADIUS / 2.0;
    let route: Vec<_> = (0..=20)
        .map(|k| [f64::from(k) * quarter, 0.0, 0.0])
        .collect();
    add(&mut world, &route, Stop::Free, Vector::zeros());
    let thickness = Thickness(0.5);
    let limit = |last| {
        let two = pair([(0, 0), (0, last)]);
        thickness.limit(&world, two, stretch_between(&world, two))
    };
    // Nothing between neighbours, a quarter of the diameter, and from pi / 2 diameters on all of it.
    assert_eq!([limit(1), limit(2)], [0, (16.0 * FRAC_2_PI) as u32]);
    assert_eq!([limit(7), limit(8)], [(96.0 * FRAC_2_PI) as u32, STEPS]);
}

/// A wire that passes another one within a step, and never meets it.
#[test]
fn wire_does_not_pass_within_what_is_guarded() {
    let run = |kappa| {
        let mut world = weightless();
        let along = |y: f64, z: f64| [[-1.0, y, z], [1.0, y, z]];
        add(&mut world, &along(0.0, 0.0), Stop::Pinned, Vector::zeros());
        let velocity = Vector::new(0.0, 12.0, 0.0);
        add(&mut world, &along(-0.1, 0.008), Stop::Free, velocity);
        let record = world.step_colliding(&mut thick(kappa), &[]).unwrap();
        (record, world)
    };
    let (free, _) = run(0.3);
    assert!(free.collisions.crossings.is_empty());
    assert_eq!(free.wires[1].after[0].y, 0.1);
    let (held, world) = run(0.5);
    assert!(!held.collisions.crossings.is_empty());
    assert_eq!(held.collisions.crossings[0].radii, [0.005; 2]);
    assert!(distance(&world, pair([(0, 0), (1, 0)])) > 0.0199);
}

/// Two wires that start inside of it are pushed apart, and come no nearer on the way.
#[test]
fn wires_that_start_near_come_no_nearer() {
    let mut world = weightless();
    add(
        &mut world,
        &[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]],
        Stop::Pinned,
        Vector::zeros(),
    );
    let velocity = Vector::new(0.0, 0.0, -1.0);
    add(
        &mut world,
        &[[0.0, -1.0, 0.004], [0.0, 1.0, 0.004]],
        Stop::Free,
        velocity,
    );
    let two = pair([(0, 0), (1, 0)]);
    let mut collisions = thick(0.5);
    let mut last = 0.004;
    for _ in 0..60 {
        world.step_colliding(&mut collisions, &[]).unwrap();
        let now = distance(&world, two);
        assert!(now > last - 0.01 / 64.0, "{last} {now}");
        last = now;
    }
    assert!(last > 0.0199, "{last}");
}

/// A chain of segments a quarter as long as it is thick, laid on itself.
#[test]
fn chain_of_short_segments_that_lies_on_itself_is_pushed_apart() {
    let quarter = RADIUS / 2.0;
    let mut world = weightless();
    // Along, up by half of the thickness, and back over itself.
    let there = (0..30).map(|k| [f64::from(k) * quarter, 0.0, 0.0]);
    let back = (0..30).rev().map(|k| [f64::from(k) * quarter, 0.0, RADIUS]);
    let route: Vec<_> = there.chain(back).collect();
    add(&mut world, &route, Stop::Free, Vector::zeros());
    let mut collisions = thick(0.25);
    let on_itself = |record: &StepRecord| {
        let of = |site: ContactSite| match site {
            ContactSite::Wire { arc, .. } => arc,
            _ => f64::NAN,
        };
        let contacts = record.contacts.iter();
        contacts
            .filter(|c| (of(c.contact.a) - of(c.contact.b)).abs() > 0.0)
            .count()
    };
    let mut contacts = 0;
    for _ in 0..90 {
        contacts += on_itself(&world.step_colliding(&mut collisions, &[]).unwrap());
    }
    assert!(contacts > 0);
    // The ends are half of the thickness apart at first.
    let ends = distance(&world, pair([(0, 0), (0, 58)]));
    assert!(ends > 1.9 * RADIUS, "{ends}");
}

/// It would bring its wire down to one that stands below, by less than is guarded or by more.
#[test]
fn change_of_resolution_that_comes_near_is_refused() {
    let mut world = weightless();
    let corner = [[0.0, 0.0, 0.0], [1.0, 0.3, 0.0], [2.0, 0.0, 0.0]];
    add(&mut world, &corner, Stop::Free, Vector::zeros());
    add(
        &mut world,
        &[[1.0, -0.008, -1.0], [1.0, -0.008, 1.0]],
        Stop::Free,
        Vector::zeros(),
    );
    let arcs = [0, 1, 2].map(|k| world.wires()[0].nodes()[k].arc);
    let change = Remesh {
        wire: WireId(0),
        kind: RemeshKind::Merge,
        triangle: corner.map(Point::from),
        arcs,
    };
    let meets = |kappa| remesh::meets(&world, &change, None, Thickness(kappa)).unwrap();
    assert_eq!(
        [0.0, 0.3, 0.39, 0.41, 0.5].map(meets),
        [false, false, false, true, true]
    );
}

/// The segments after the nodes at which it is are neighbours.
#[test]
fn contact_at_two_nodes_stays_with_the_segments_that_it_is_of() {
    let mut world = weightless();
    let turn = [
        [-1.0, 0.0, 0.0],
        [0.0, 0.0, 0.0],
        [0.0, 0.0, 0.02],
        [-1.0, 0.0, 0.2],
    ];
    add(&mut world, &turn, Stop::Free, Vector::zeros());
    let node = |at: usize| WireSite {
        wire: WireId(0),
        arc: world.wires()[0].nodes()[at].arc,
    };
    for ends in [[1, 2], [2, 1]] {
        let sites = ends.map(node);
        let mut contacts = WireContacts::default();
        let contact = contacts.make(sites, Vector::z());
        let key = contact.key;
        contacts.list.push(contact);
        for _ in 0..2 {
            contacts.refresh(&world, Thickness(0.5));
        }
        let [kept] = contacts.list.as_slice() else {
            panic!("{:?}", contacts.list);
        };
        assert_eq!((kept.key, kept.sites), (key, sites));
    }
    // Neighbours and nothing else: no contact.
    let sites = [0, 1].map(node);
    let mut contacts = WireContacts::default();
    let contact = contacts.make(sites, Vector::z());
    contacts.list.push(contact);
    contacts.refresh(&world, Thickness(0.5));
    assert!(contacts.list.is_empty());
}
