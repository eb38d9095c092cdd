//! How long a query takes.

use std::time::Instant;

use tunnelproof::query::{EdgeEdge, Point};
use tunnelproof::thesis::Repairs;

use super::lattice::Random;
use crate::field;
use crate::shadow::edge_edge;

fn uniform_query(random: &mut Random) -> EdgeEdge {
    let mut coordinate = || (random.next() >> 11) as f64 / (1_u64 << 53) as f64;
    let mut points = || [0; 4].map(|_| Point::from([0; 3].map(|_| coordinate())));
    EdgeEdge::new(points(), points(), 0.0).unwrap()
}

#[test]
#[ignore = "measures time: run it in release with --nocapture"]
fn shadow_time_on_uniform_queries() {
    let mut random = Random(5);
    let queries: Vec<EdgeEdge> = (0..20_000).map(|_| uniform_query(&mut random)).collect();
    let mut seconds = [0.0; 2];
    let mut counts = [0_u32; 2];
    for query in &queries {
        let start = Instant::now();
        let answer = edge_edge::<field::Default>(query, Repairs::ALL);
        let outcome = usize::from(answer.hit.is_some());
        seconds[outcome] += start.elapsed().as_secs_f64();
        counts[outcome] += 1;
    }
    let mean = |i: usize| seconds[i] * 1e6 / f64::from(counts[i]);
    println!(
        "miss {:.1} us ({}), hit {:.1} us ({})",
        mean(0),
        counts[0],
        mean(1),
        counts[1]
    );
}
