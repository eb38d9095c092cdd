//! Groups of what is tied together, by union-find.

/// A forest: each member's parent. The root of a group is its least member.
#[derive(Clone, Debug)]
pub(in crate::wire) struct UnionFind {
    parent: Vec<usize>,
}

impl UnionFind {
    /// Every member is a group of its own.
    pub(in crate::wire) fn new(count: usize) -> Self {
        UnionFind {
            parent: (0..count).collect(),
        }
    }

    /// How many members there are.
    pub(in crate::wire) fn len(&self) -> usize {
        self.parent.len()
    }

    /// The root of a member's group.
    pub(in crate::wire) fn root(&self, mut member: usize) -> usize {
        while self.parent[member] != member {
            member = self.parent[member];
        }
        member
    }

    /// Whether a member is the root of its group.
    pub(in crate::wire) fn is_root(&self, member: usize) -> bool {
        self.parent[member] == member
    }

    /// Makes the groups of two members one; the root that stays, and the other one.
    pub(in crate::wire) fn join(&mut self, a: usize, b: usize) -> [usize; 2] {
        let [root, other] = [self.root(a), self.root(b)];
        let [root, other] = [root.min(other), root.max(other)];
        self.parent[other] = root;
        // So that ways to the root stay short.
        for mut member in [a, b] {
            while member != root {
                member = std::mem::replace(&mut self.parent[member], root);
            }
        }
        [root, other]
    }
}
