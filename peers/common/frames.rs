//! A program that answers queries in the binary form of docs/bring-your-own.md, and times each
//! answer. At the end of its input it says how long the engine took, in one line of JSON on the
//! standard error.

use std::io::{self, Read, Write};
use std::time::{Duration, Instant};

/// A query as it is sent: points A B C D at the start of the step, then at its end.
pub struct Asked {
    pub is_face: bool,
    pub radii: [f64; 2],
    pub points: [[f64; 3]; 8],
}

/// What a body of a cast of a box is, without its radius.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Form {
    Sphere,
    Edge,
    Triangle,
    /// Its points are a corner and the three corners beside it.
    Box,
}

/// A body of a cast of a box.
pub struct Convex {
    pub form: Form,
    /// At the start of the step; as many of them as the form has.
    pub points: [[f64; 3]; 4],
    pub step: [f64; 3],
    /// By how much it is larger; of a box, with a skin alone.
    pub radius: f64,
}

impl Convex {
    /// The corners of a box: bit `i` of the number of one says whether it is at the far end of side `i`.
    pub fn corners(&self) -> [[f64; 3]; 8] {
        std::array::from_fn(|number| {
            let mut corner = self.points[0];
            for (side, along) in self.sides().into_iter().enumerate() {
                let length = along.iter().map(|x| x * x).sum::<f64>().sqrt();
                // Without a skin nothing is rounded.
                let by = if self.radius > 0.0 {
                    self.radius / length
                } else {
                    0.0
                };
                for (x, way) in corner.iter_mut().zip(along) {
                    *x += if number >> side & 1 == 1 {
                        way + by * way
                    } else {
                        -by * way
                    };
                }
            }
            corner
        })
    }

    /// The middle of a box along the axes and half of its sides; `None` for one that is turned.
    #[allow(dead_code, reason = "not every adapter has boxes of its own")]
    pub fn aligned(&self) -> Option<[[f64; 3]; 2]> {
        let [mut centre, mut half] = [self.points[0], [0.0; 3]];
        for along in self.sides() {
            let mut axes = (0..3).filter(|axis| along[*axis] != 0.0);
            let (axis, None) = (axes.next()?, axes.next()) else {
                return None;
            };
            centre[axis] += 0.5 * along[axis];
            half[axis] = 0.5 * along[axis].abs() + self.radius;
        }
        Some([centre, half])
    }

    /// From the corner to those beside it.
    fn sides(&self) -> [[f64; 3]; 3] {
        let [corner, beside @ ..] = &self.points;
        std::array::from_fn(|side| std::array::from_fn(|k| beside[side][k] - corner[k]))
    }
}

/// A query of two bodies that turn, as it is sent.
pub struct Turning {
    pub is_face: bool,
    pub radii: [f64; 2],
    /// The points in the frames of the bodies: two of each, or one and three.
    pub local: [[f64; 3]; 4],
    /// Of each body at the start and at the end: x y z of the centre, w x y z of a quaternion.
    pub poses: [[[f64; 7]; 2]; 2],
}

/// What an engine says.
pub enum Said {
    Hit(f64),
    Miss,
    Unsupported,
}

/// The times of all answers.
#[derive(Default)]
pub struct Clock {
    times: Vec<Duration>,
}

impl Clock {
    /// What `call` returns, timed. Only the engine's own call belongs in it.
    pub fn timed<T>(&mut self, call: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = call();
        self.times.push(start.elapsed());
        result
    }

    fn report(mut self) {
        self.times.sort_unstable();
        let Some(worst) = self.times.last() else {
            return;
        };
        let count = self.times.len();
        let at = |share: f64| self.times[((share * count as f64) as usize).min(count - 1)];
        let mean = self.times.iter().sum::<Duration>().as_nanos() as f64 / count as f64;
        let [median, p99] = [0.5, 0.99].map(|share| at(share).as_nanos());
        eprintln!(
            r#"{{"calls": {count}, "mean_ns": {mean:.1}, "median_ns": {median}, "p99_ns": {p99}, "worst_ns": {}}}"#,
            worst.as_nanos()
        );
    }
}

/// How much larger the first body is asked to be, in metres.
pub fn skin() -> f64 {
    let text = std::env::var("PEERS_SKIN").unwrap_or_default();
    text.parse().unwrap_or(0.0)
}

/// An engine, or a method of one.
pub trait Engine {
    /// Answers a query of bodies that are translated.
    fn answer(&self, asked: &Asked, clock: &mut Clock) -> Said;

    /// Answers a cast of a box.
    fn cast(&self, _bodies: &[Convex; 2], _clock: &mut Clock) -> Said {
        Said::Unsupported
    }

    /// Answers a query of bodies that turn.
    fn turning(&self, _asked: &Turning, _clock: &mut Clock) -> Said {
        Said::Unsupported
    }
}

/// Answers until the input ends.
///
/// # Errors
///
/// What the pipes say.
pub fn serve(engine: impl Engine) -> io::Result<()> {
    let (mut input, mut output) = (io::stdin().lock(), io::stdout().lock());
    let mut clock = Clock::default();
    let mut length = [0; 4];
    while let Ok(()) = input.read_exact(&mut length) {
        let mut frame = vec![0; u32::from_le_bytes(length) as usize];
        input.read_exact(&mut frame)?;
        let said = match frame[8] {
            0 | 1 => engine.answer(&asked(&frame), &mut clock),
            2 => engine.cast(&bodies(&frame), &mut clock),
            5 | 6 => engine.turning(&turning(&frame), &mut clock),
            _ => Said::Unsupported,
        };
        let (verdict, toi) = match said {
            Said::Miss => (0u64, 0.0),
            Said::Hit(toi) => (1, toi),
            Said::Unsupported => (2, 0.0),
        };
        let mut reply = 24u32.to_le_bytes().to_vec();
        reply.extend_from_slice(&frame[..8]);
        reply.extend_from_slice(&verdict.to_le_bytes());
        reply.extend_from_slice(&toi.to_le_bytes());
        output.write_all(&reply)?;
        output.flush()?;
    }
    clock.report();
    Ok(())
}

fn number(frame: &[u8], i: usize) -> f64 {
    let mut bytes = [0; 8];
    bytes.copy_from_slice(&frame[16 + 8 * i..24 + 8 * i]);
    f64::from_le_bytes(bytes)
}

fn point(frame: &[u8], i: usize) -> [f64; 3] {
    std::array::from_fn(|k| number(frame, 2 + 3 * i + k))
}

fn asked(frame: &[u8]) -> Asked {
    Asked {
        is_face: frame[8] == 1,
        radii: [number(frame, 0), number(frame, 1)],
        points: std::array::from_fn(|i| point(frame, i)),
    }
}

fn turning(frame: &[u8]) -> Turning {
    let pose = |i: usize| std::array::from_fn(|k| number(frame, 14 + 7 * i + k));
    Turning {
        is_face: frame[8] == 6,
        radii: [number(frame, 0), number(frame, 1)],
        local: std::array::from_fn(|i| point(frame, i)),
        poses: [[pose(0), pose(1)], [pose(2), pose(3)]],
    }
}

/// Both bodies. The skin is that of the first body with a radius or, without one, of the first box.
fn bodies(frame: &[u8]) -> [Convex; 2] {
    let mut bodies = [0, 1].map(|i| Convex {
        form: match frame[12 + 2 * i] {
            0 => Form::Sphere,
            1 => Form::Edge,
            2 => Form::Triangle,
            _ => Form::Box,
        },
        points: std::array::from_fn(|k| point(frame, 5 * i + k)),
        step: point(frame, 5 * i + 4),
        radius: number(frame, i),
    });
    let round = bodies.iter().position(|body| body.radius > 0.0);
    let first = bodies.iter().position(|body| body.form == Form::Box);
    if let Some(body) = round.or(first) {
        bodies[body].radius += skin();
    }
    bodies
}
