//! `num-bigint` against GMP.

use arbitrary::{Arbitrary, Unstructured};
use num_bigint::BigInt;
use tunnelproof::query::Query;
use tunnelproof::thesis::Repairs;

use tunnelproof_reference::field::Integer;
use tunnelproof_reference::{oracle, shadow};

type Gmp = rug::Integer;

/// Both judges on both.
pub(super) fn judges(query: &Query) -> Option<String> {
    let Query::EdgeEdge(edges) = query else {
        return None;
    };
    let pure = oracle::decide::<BigInt>(query).written();
    let gmp = oracle::decide::<Gmp>(query).written();
    if pure != gmp {
        return Some("the oracle differs".to_owned());
    }
    let pure = shadow::edge_edge::<BigInt>(edges, Repairs::ALL);
    let gmp = shadow::edge_edge::<Gmp>(edges, Repairs::ALL);
    (pure != gmp).then(|| "the shadow differs".to_owned())
}

/// Every operation on two integers and a number of bits.
pub(super) fn integers(bytes: &[u8]) -> Option<String> {
    let mut bytes = Unstructured::new(bytes);
    let bits = u64::from(u8::arbitrary(&mut bytes).unwrap_or(0));
    let [a, b] = [(); 2].map(|()| decimal(&mut bytes));
    let (pure, gmp) = (
        results::<BigInt>(&a, &b, bits),
        results::<Gmp>(&a, &b, bits),
    );
    if !estimates_agree(&a, &b) {
        return Some(format!("the estimates of {a} and {b}"));
    }
    let difference = pure.iter().zip(&gmp).position(|(pure, gmp)| pure != gmp)?;
    let [pure, gmp] = [&pure, &gmp].map(|results| &results[difference]);
    Some(format!("of {a}, {b} and {bits}: {pure}, by GMP {gmp}"))
}

fn decimal(bytes: &mut Unstructured) -> String {
    let limbs = usize::from(u8::arbitrary(bytes).unwrap_or(0) % 6);
    let value = (0..limbs).fold(BigInt::from(0), |value, _| {
        // Words of all ones and all zeros are where carries run.
        let word = match u8::arbitrary(bytes).unwrap_or(0) % 4 {
            0 => 0,
            1 => u64::MAX,
            _ => u64::arbitrary(bytes).unwrap_or(0),
        };
        (value << 64u32) + BigInt::from(word)
    });
    let sign = if bool::arbitrary(bytes).unwrap_or(false) {
        "-"
    } else {
        ""
    };
    format!("{sign}{value}")
}

fn results<Z: Integer>(a: &str, b: &str, bits: u64) -> Vec<String> {
    let (Some(a), Some(b)) = (Z::from_decimal(a), Z::from_decimal(b)) else {
        return vec!["not read".to_owned()];
    };
    let mut sum = a.clone();
    sum.add_assign(&b);
    sum.add_product(&a, &b);
    sum.sub_assign(&b);
    sum.sub_product(&b, &b);
    let mut integers = vec![
        a.add(&b),
        a.sub(&b),
        a.mul(&b),
        a.neg(),
        a.abs(),
        sum,
        a.shl(bits),
        a.shr_floor(bits),
        a.gcd(&b),
    ];
    if !b.is_zero() {
        integers.push(a.div_floor(&b.abs()));
        integers.push(a.mul(&b).div_exact(&b));
    }
    let facts = format!(
        "{:?} {:?} {} {} {:?}",
        a.cmp(&b),
        a.sign(),
        a.bits(),
        a.trailing_zeros(),
        a.to_i64()
    );
    let mut texts: Vec<_> = integers.iter().map(Z::to_string).collect();
    texts.push(facts);
    texts
}

/// Whether the estimates of both backends are the same to 51 bits.
fn estimates_agree(a: &str, b: &str) -> bool {
    [a, b].into_iter().all(|text| {
        let pure = BigInt::from_decimal(text).map(|z| z.approximate());
        let gmp = Gmp::from_decimal(text).map(|z| z.approximate());
        match (pure, gmp) {
            (Some((m, e)), Some((n, f))) => {
                let n = n * 2f64.powi((f - e).clamp(-2, 2) as i32);
                (m - n).abs() <= 2.0 * f64::EPSILON * m.abs()
            }
            _ => false,
        }
    })
}
