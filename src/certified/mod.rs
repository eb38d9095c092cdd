//! cascade (in work)
mod cubic;
mod locate;
mod motion;
mod refine;
mod root;
mod separate;
use crate::query::EdgeEdge;
/// stage
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)]
pub enum T {
    Boxes,
    Centres,
    Signs,
    Roots,
    Hit(f64),
    HitX,
    Search,
    Exact(u8),
}
/// test
pub fn filter(q: &EdgeEdge) -> T {
    let bx = separate::SweptBoxes::new(q);
    if bx.are_disjoint {
        return T::Boxes;
    }
    let m = motion::Motion::new(q);
    if m.is_separated_by_centres(&bx) {
        return T::Centres;
    }
    let search = |k| {
        if m.is_separated_by_search(&bx) {
            T::Search
        } else {
            T::Exact(k)
        }
    };
    let Some(c) = cubic::Cubic::new(&m) else {
        return search(0);
    };
    if c.has_no_root() {
        return T::Signs;
    }
    let Some(b) = c.isolate() else {
        return search(1);
    };
    for b in b.as_slice() {
        match m.place(b) {
            locate::Place::Apart => {}
            locate::Place::Inside { .. } => {
                return match refine::round_down(q, &c, b) {
                    Some(x) => T::Hit(x),
                    None => T::HitX,
                };
            }
            locate::Place::Unclear => return search(2),
        }
    }
    T::Roots
}
/// t
pub fn only(q: &EdgeEdge, n: u8) -> bool {
    let bx = separate::SweptBoxes::new(q);
    if bx.are_disjoint {
        return true;
    }
    if n == 0 {
        return false;
    }
    let m = motion::Motion::new(q);
    if m.is_separated_by_centres(&bx) {
        return true;
    }
    if n == 1 {
        return false;
    }
    let Some(c) = cubic::Cubic::new(&m) else {
        return false;
    };
    if c.has_no_root() {
        return true;
    }
    if n == 2 {
        return false;
    }
    let Some(b) = c.isolate() else { return false };
    if n == 3 {
        return false;
    }
    for b in b.as_slice() {
        match m.place(b) {
            locate::Place::Apart => {}
            locate::Place::Inside { .. } => {
                return if n == 4 {
                    true
                } else {
                    refine::round_down(q, &c, b).is_some()
                };
            }
            locate::Place::Unclear => return false,
        }
    }
    true
}
/// t
pub fn debug(q: &EdgeEdge) -> String {
    let m = motion::Motion::new(q);
    let Some(c) = cubic::Cubic::new(&m) else {
        return "none".into();
    };
    format!(
        "{:?} {:?}",
        c.bernstein.map(|b| b / c.error),
        c.isolate().map(|b| b.as_slice().to_vec())
    )
}
