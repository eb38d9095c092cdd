//! A cloth falls on a ball. What touches sticks; every step is proved to touch nothing.
//!
//! `cargo run --release --example cloth`

use std::error::Error;
use std::f64::consts::{PI, TAU};

use tunnelproof::nalgebra::Vector3;
use tunnelproof::{Clearance, Mesh};

const N: usize = 24;
const THICKNESS: f64 = 0.01;
const DT: f64 = 0.01;
const STEPS: usize = 100;

/// The triangles of a grid of N by N vertices.
fn grid(first: usize) -> impl Iterator<Item = [u32; 3]> {
    let corners = (0..N * (N - 1)).filter(|i| i % N + 1 < N);
    corners.flat_map(move |i| {
        let [a, b, c, d] = [i, i + 1, i + N, i + N + 1].map(|i| (first + i) as u32);
        [[a, b, c], [b, d, c]]
    })
}

fn main() -> Result<(), Box<dyn Error>> {
    // A square of 1 m, and a ball of radius 0.3 m that stays: a group left out with itself.
    let places = |at: fn(f64, f64) -> [f64; 3]| {
        let size = (N - 1) as f64;
        (0..N * N).map(move |i| at((i / N) as f64 / size, (i % N) as f64 / size))
    };
    let mut x: Vec<_> = places(|u, v| [u - 0.5, v - 0.5, 0.35]).collect();
    x.extend(places(|u, v| {
        let (t, p) = (0.1 + (PI - 0.2) * u, TAU * v);
        [t.sin() * p.cos(), t.sin() * p.sin(), t.cos()].map(|x| 0.3 * x)
    }));
    let faces: Vec<_> = grid(0).chain(grid(N * N)).collect();
    let mut mesh = Mesh::new(x.len(), &[], &faces)?;
    let groups: Vec<u32> = (0..x.len()).map(|i| (i < N * N).into()).collect();
    mesh.set_groups(&groups)?;
    mesh.leave_out(0, 0)?;

    let at = |x: &[[f64; 3]], i: u32| Vector3::from(x[i as usize]);
    let edges = mesh.edges().iter();
    let edges = edges.filter(|edge| edge.iter().all(|&i| groups[i as usize] == 1));
    let spring = |&[a, b]: &[u32; 2]| (a, b, (at(&x, b) - at(&x, a)).norm());
    let springs: Vec<_> = edges.map(spring).collect();
    let mut velocity = vec![Vector3::zeros(); N * N];
    let mut made = 0.0;
    for _ in 0..STEPS {
        let mut wanted = x.clone();
        for (wanted, velocity) in wanted.iter_mut().zip(&mut velocity) {
            velocity.z -= 9.81 * DT;
            *wanted = (Vector3::from(*wanted) + *velocity * DT).into();
        }
        // Each spring goes a part of the way to its length, ten times.
        for &(a, b, rest) in springs.iter().cycle().take(10 * springs.len()) {
            let way = at(&wanted, b) - at(&wanted, a);
            let pull = way * (1.0 - rest / way.norm()) / 4.0;
            wanted[a as usize] = (at(&wanted, a) + pull).into();
            wanted[b as usize] = (at(&wanted, b) - pull).into();
        }
        // What would touch stays where it is.
        for _ in 0..4 {
            for hit in mesh.all_contacts(&x, &wanted, THICKNESS)? {
                for i in mesh.vertices_of(hit.pair).into_iter().flatten() {
                    wanted[i as usize] = x[i as usize];
                }
            }
        }
        let step = mesh.step_with_clearance(&x, &wanted, THICKNESS, Clearance::Share(0.2))?;
        assert!(mesh.is_free(&x, &step.positions, THICKNESS)?);
        made += step.step;
        for (i, velocity) in (0..).zip(&mut velocity) {
            *velocity = (at(&step.positions, i) - at(&x, i)) * 0.98 / DT;
        }
        x = step.positions;
    }
    let lowest = x[..N * N].iter().map(|x| x[2]).fold(f64::MAX, f64::min);
    let triangles = faces.len();
    println!("{STEPS} steps of {triangles} triangles, {made:.1} of them made; none touched");
    println!("the lowest point of the cloth is at {lowest:.2} m");
    Ok(())
}
