//! Random scenes of every sort in which wires meet.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A sort of scenes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sort {
    /// Wires anywhere.
    Generic,
    /// Everything in one plane, and a wire across it at times.
    Planar,
    /// Places and ways per step are multiples of a quarter: nodes meet nodes.
    Lattice,
    /// Ends pinned to one of two points.
    Pins,
    /// Wires pinned together at the nodes of a net, and one thrown at it.
    Net,
    /// Wires whose ends are one point.
    Loops,
    /// On a lattice, far from the origin.
    Far,
    /// Wires a tenth of a millimetre thick and less, on a lattice.
    Thin,
    /// Eyes on bodies that turn.
    Turning,
    /// Wires over the edge of a box, with contact nodes.
    ContactNodes,
    /// Short wires that are thrown past the ends of others.
    OffEnds,
    /// Bent wires so fast that they pass several times in a step.
    Several,
    /// Wires whose resolution changes as they meet.
    Remeshed,
}

pub(crate) const SORTS: [Sort; 13] = [
    Sort::Generic,
    Sort::Planar,
    Sort::Lattice,
    Sort::Pins,
    Sort::Net,
    Sort::Loops,
    Sort::Far,
    Sort::Thin,
    Sort::Turning,
    Sort::ContactNodes,
    Sort::OffEnds,
    Sort::Several,
    Sort::Remeshed,
];

const STEP: f64 = 0.0625;

type Point = [f64; 3];

/// A scene as the text of its file.
pub(crate) fn scene(sort: Sort, seed: u64) -> String {
    let mut draft = Draft::new(seed);
    match sort {
        Sort::Generic => draft.generic(1.0, 8.0),
        Sort::Planar => draft.planar(),
        Sort::Lattice => draft.lattice([0.0; 3], 0.25, 0.005),
        Sort::Pins => draft.pins(),
        Sort::Net => draft.net(),
        Sort::Loops => draft.loops(),
        Sort::Far => draft.far(),
        Sort::Thin => draft.thin(),
        Sort::Turning => draft.turning(),
        Sort::ContactNodes => draft.contact_nodes(),
        Sort::OffEnds => draft.off_ends(),
        Sort::Several => draft.several(),
        Sort::Remeshed => draft.remeshed(),
    }
    draft.text(sort)
}

struct Draft {
    rng: ChaCha8Rng,
    gravity: f64,
    steps: u32,
    head: String,
    bodies: String,
    wires: String,
    count: usize,
    radius: f64,
    adaptive: bool,
}

fn list([x, y, z]: Point) -> String {
    format!("[{x:?}, {y:?}, {z:?}]")
}

fn add(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|h| a[h] + b[h])
}

/// A stop that is fixed, or not.
fn stop(kind: &str, at: Point) -> String {
    format!("{{ {kind} = {} }}", list(at))
}

impl Draft {
    fn new(seed: u64) -> Self {
        Draft {
            rng: ChaCha8Rng::seed_from_u64(seed),
            gravity: 0.0,
            steps: 4,
            head: String::new(),
            bodies: String::new(),
            wires: String::new(),
            count: 0,
            radius: 0.005,
            adaptive: false,
        }
    }

    fn text(&self, sort: Sort) -> String {
        let Draft {
            gravity,
            head,
            bodies,
            wires,
            ..
        } = self;
        let duration = STEP * f64::from(self.steps);
        format!(
            "title = \"{sort:?}\"\nduration = {duration:?}\n{head}[settings]\nstep = {STEP:?}\n\
             gravity = [0, 0, {gravity:?}]\n{bodies}{wires}"
        )
    }

    fn wire(&mut self, resolution: f64, velocity: Point, route: &[String]) {
        let Draft {
            count,
            radius,
            adaptive,
            ..
        } = self;
        self.wires += &format!(
            "[[wires]]\nname = \"w{count}\"\nmaterial = {{ radius = {radius:?}, bend_modulus = 0, \
             stretch_modulus = 1e7, density = 1000 }}\nresolution = {resolution:?}\n\
              adaptive = {adaptive}\n\
             velocity = {}\nroute = [{}]\n",
            list(velocity),
            route.join(", ")
        );
        self.count += 1;
    }

    fn vector(&mut self, size: f64) -> Point {
        [0; 3].map(|_| self.rng.random_range(-size..=size))
    }

    /// A multiple of a step in each coordinate.
    fn grid(&mut self, most: i32, unit: f64) -> Point {
        [0; 3].map(|_| f64::from(self.rng.random_range(-most..=most)) * unit)
    }

    fn kind(&mut self, pinned: f64) -> &'static str {
        if self.rng.random_bool(pinned) {
            "pinned"
        } else {
            "free"
        }
    }

    fn generic(&mut self, size: f64, speed: f64) {
        self.gravity = [0.0, -9.8][self.rng.random_range(0..2)];
        for _ in 0..self.rng.random_range(2..=3) {
            let mut route = Vec::new();
            for _ in 0..self.rng.random_range(2..=4) {
                let (kind, at) = (self.kind(0.25), self.vector(size));
                route.push(stop(kind, at));
            }
            let velocity = self.vector(speed);
            let resolution = self.rng.random_range(0.2..1.0) * size;
            self.wire(resolution, velocity, &route);
        }
    }

    /// Zigzags in planes one above the other, of which one goes through the others as it is; or
    /// side by side in one plane, where they fold and go past each other.
    fn planar(&mut self) {
        let in_one = self.rng.random_bool(0.1);
        for k in 0..self.rng.random_range(2..=3) {
            let (above, beside) = if in_one { (0.0, 0.5) } else { (0.25, 0.0) };
            let (above, beside) = (above * f64::from(k), beside * f64::from(k));
            let mut route = Vec::new();
            for i in 0..self.rng.random_range(2..=4) {
                let kind = self.kind(if in_one { 0.3 } else { 0.0 });
                let kind = if k == 0 && !in_one { "pinned" } else { kind };
                let [x, y, _] = self.vector(0.2);
                let along = f64::from(i) * 0.5 - 0.7;
                route.push(stop(kind, [along + x, beside + y, above]));
            }
            let [x, y, _] = self.vector(3.0);
            let towards = if in_one { -3.0 * f64::from(k) } else { 0.0 };
            let down = if in_one { 0.0 } else { -4.0 * f64::from(k) };
            self.wire(0.4, [x, y + towards, down], &route);
        }
    }

    /// A pinned wire, and others that go through it, node to node or not.
    fn lattice(&mut self, origin: Point, unit: f64, radius: f64) {
        self.radius = radius;
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let turn = self.rng.random_range(0..3);
        let axis = |k: usize| axes[(k + turn) % 3].map(|x: f64| x * 4.0 * unit);
        let start = add(origin, self.grid(3, unit));
        let along = |k: f64| add(start, axis(0).map(|x| x * k));
        self.wire(
            unit * 4.0,
            [0.0; 3],
            &[0.0, 1.0, 2.0, 3.0].map(|k| stop("pinned", along(k))),
        );
        for _ in 0..1 + u32::from(self.rng.random_bool(0.1)) {
            let target = along([1.0, 2.0, 1.5, 0.25][self.rng.random_range(0..4)]);
            let place = [1.0, 1.0, 1.5, 0.5][self.rng.random_range(0..4)];
            let place = if self.rng.random_bool(0.005) {
                0.0
            } else {
                place
            };
            let skew = f64::from(self.rng.random_range(-1..=1));
            let way = add(axis(1), axis(0).map(|x| x * skew));
            let mut velocity = self.grid(1, unit / STEP);
            velocity[(2 + turn) % 3] = -2.0 * unit / STEP;
            let time = STEP * f64::from(self.rng.random_range(1..=6)) / 2.0;
            let from = [0, 1, 2].map(|h| target[h] - velocity[h] * time - way[h] * place);
            let route = [0.0, 1.0, 2.0].map(|k| stop("free", add(from, way.map(|x| x * k))));
            let resolution = unit * [2.0, 16.0][self.rng.random_range(0..2)];
            self.wire(resolution, velocity, &route);
        }
    }

    fn far(&mut self) {
        let (size, unit) = [(6.4e6, 0.25), (1e8, 0.25), (1e9, 1.0)][self.rng.random_range(0..3)];
        let origin = [0; 3].map(|_| f64::from(self.rng.random_range(-1..=1)) * size);
        self.lattice(origin, unit, 0.005);
    }

    fn thin(&mut self) {
        let radius = [1e-4, 1e-5, 1e-6][self.rng.random_range(0..3)];
        let origin =
            [1e4, 0.0, 6.4e6].map(|size| if self.rng.random_bool(0.5) { size } else { 0.0 });
        self.lattice(origin, 0.25, radius);
    }

    fn pins(&mut self) {
        self.gravity = [0.0, -9.8][self.rng.random_range(0..2)];
        let points = [[0.0; 3], self.vector(1.0)];
        for _ in 0..self.rng.random_range(2..=3) {
            let first = points[self.rng.random_range(0..2)];
            let mut route = vec![stop("pinned", first)];
            // With one there would be two segments in one place.
            for _ in 0..self.rng.random_range(2..=3) {
                let at = self.vector(1.0);
                route.push(stop("free", at));
            }
            if self.rng.random_bool(0.5) {
                let last = points[self.rng.random_range(0..2)];
                route.push(stop("pinned", last));
            }
            let velocity = self.vector(8.0);
            let resolution = [0.3, 0.5, 3.0][self.rng.random_range(0..3)];
            self.wire(resolution, velocity, &route);
        }
    }

    /// Three by three nodes, fixed, with a wire each way through or piece by piece.
    fn net(&mut self) {
        let at = |i: i32, j: i32| [f64::from(i) * 0.5, f64::from(j) * 0.5, 0.0];
        let pieces = self.rng.random_bool(0.5);
        for k in -1..=1 {
            for along in [true, false] {
                let node = |i: i32| stop("pinned", if along { at(i, k) } else { at(k, i) });
                if pieces {
                    self.wire(1.0, [0.0; 3], &[node(-1), node(0)]);
                    self.wire(1.0, [0.0; 3], &[node(0), node(1)]);
                } else {
                    self.wire(1.0, [0.0; 3], &[node(-1), node(0), node(1)]);
                }
            }
        }
        let (from, to) = (self.vector(0.7), self.vector(0.7));
        let above = |mut at: Point| {
            at[2] = at[2] / 8.0 + 0.3;
            at
        };
        let velocity = add(self.vector(2.0), [0.0, 0.0, -8.0]);
        let resolution = [0.3, 3.0][self.rng.random_range(0..2)];
        self.wire(
            resolution,
            velocity,
            &[stop("free", above(from)), stop("free", above(to))],
        );
    }

    fn loops(&mut self) {
        for _ in 0..2 {
            let start = self.vector(0.4);
            let mut route = vec![stop("pinned", start)];
            for _ in 0..self.rng.random_range(2..=4) {
                let at = self.vector(1.0);
                route.push(stop("free", at));
            }
            route.push(stop("pinned", start));
            let velocity = self.vector(12.0);
            self.wire(0.6, velocity, &route);
        }
    }

    fn turning(&mut self) {
        for k in 0..2 {
            let (at, turn) = (self.vector(0.5), self.vector(20.0));
            self.bodies += &format!(
                "[[bodies]]\nname = \"b{k}\"\nshape = {{ sphere = {{ radius = 0.05 }} }}\n\
                 position = {}\n\
                 drive = {{ kinematic = [{{ from = 0, velocity = [0, 0, 0], \
                  angular_velocity = {} }}] }}\n",
                list(at),
                list(turn)
            );
        }
        let eye = |body: u32, local: Point| {
            format!(
                "{{ eye = {{ body = \"b{body}\", local = {} }} }}",
                list(local)
            )
        };
        let shared = self.vector(0.5);
        for _ in 0..self.rng.random_range(2..=3) {
            let (own, free, other) = (self.vector(0.5), self.vector(1.0), self.vector(0.5));
            let first = if self.rng.random_bool(0.4) {
                shared
            } else {
                own
            };
            let last = match self.rng.random_range(0..3) {
                0 => eye(1, other),
                1 => stop("free", other),
                _ => eye(0, if first == shared { own } else { shared }),
            };
            let route = match self.rng.random_bool(0.5) {
                true => vec![eye(0, first), stop("free", free), last],
                false => vec![eye(0, first), stop("free", free)],
            };
            let velocity = self.vector(6.0);
            self.wire(0.5, velocity, &route);
        }
    }

    fn contact_nodes(&mut self) {
        self.head = "friction = 0.1\ncontact_nodes = true\n".to_owned();
        self.gravity = -9.8;
        self.steps = 8;
        self.adaptive = true;
        self.bodies = "[[bodies]]\nname = \"cube\"\nshape = { box = { half = [0.5, 0.5, 0.5] } }\n\
                       position = [0, 0, -0.5]\n"
            .to_owned();
        let y = self.rng.random_range(-0.2..0.2);
        let over = [[0.0, y, 0.005], [0.505, y, 0.005], [0.505, y, -1.5]];
        self.wire(0.2, [0.0; 3], &over.map(|at| stop("free", at)));
        for _ in 0..2 {
            let x = self.rng.random_range(-0.2..0.45);
            let tilt = self.rng.random_range(-0.4..0.4);
            let z = self.rng.random_range(0.05..0.3);
            let velocity = [
                self.rng.random_range(-1.0..2.0),
                0.0,
                self.rng.random_range(-10.0..-3.0),
            ];
            let route = [[x, -0.8, z], [x + tilt, 0.8, z + 0.1]];
            self.wire(0.2, velocity, &route.map(|at| stop("free", at)));
        }
    }

    fn off_ends(&mut self) {
        let exact = self.rng.random_bool(0.15);
        for _ in 0..3 {
            let (at, way, velocity) = match exact {
                true => (self.grid(2, 0.125), self.grid(2, 0.25), self.grid(2, 2.0)),
                false => {
                    // Their middles come near the origin after two steps.
                    let (at, way, turn) = (self.vector(0.4), self.vector(0.3), self.vector(1.0));
                    let from = [0, 1, 2].map(|h| at[h] - way[h] / 2.0);
                    let velocity = [0, 1, 2].map(|h| turn[h] - at[h] / (2.0 * STEP));
                    (from, way, velocity)
                }
            };
            let none = way == [0.0; 3];
            let way = if none { [0.5, 0.0, 0.0] } else { way };
            let route = [stop("free", at), stop("free", add(at, way))];
            self.wire(4.0, velocity, &route);
        }
    }

    /// Zigzags that go through each other.
    fn several(&mut self) {
        for k in 0..2 {
            let mut route = Vec::new();
            for i in 0..6 {
                let side = if i % 2 == 0 { 0.3 } else { -0.3 };
                let jitter = self.vector(0.1);
                let along = f64::from(i) * 0.2 - 0.5;
                let at = if k == 0 {
                    [along, side, 0.0]
                } else {
                    [along, 0.0, side]
                };
                route.push(stop("free", add(at, jitter)));
            }
            let velocity = self.vector(16.0);
            self.wire(4.0, velocity, &route);
        }
    }

    fn remeshed(&mut self) {
        self.adaptive = true;
        self.gravity = -9.8;
        self.steps = 16;
        let tense = self.vector(0.3);
        let from = [-1.0, tense[0], 0.0];
        let to = [1.0, tense[1], tense[2]];
        self.wire(0.1, [0.0; 3], &[stop("pinned", from), stop("pinned", to)]);
        for _ in 0..2 {
            let mut route = Vec::new();
            for _ in 0..3 {
                let (kind, at) = (self.kind(0.4), self.vector(0.6));
                route.push(stop(kind, at));
            }
            let velocity = self.vector(8.0);
            self.wire(0.1, velocity, &route);
        }
    }
}
