//! Disjoint sets (union-find) whose representative is the smallest member.

/// A partition of 0..n that only ever grows coarser (union-find).
///
/// # Guarantees
///
/// The representative of a set is its smallest member, whatever the order of the unions.
#[derive(Clone, Debug, Default)]
pub struct DisjointSets {
    /// Towards the representative; never upwards, so the chains end.
    parent: Vec<u32>,
}

impl DisjointSets {
    /// Every member alone.
    ///
    /// # Panics
    ///
    /// For more than 2³² members.
    #[must_use]
    pub fn new(members: usize) -> Self {
        Self { parent: (0..u32::try_from(members).expect("fewer than 2³² members")).collect() }
    }

    /// Another member, alone: the number of those before it.
    pub(crate) fn push(&mut self) -> u32 {
        let member = u32::try_from(self.parent.len()).expect("fewer than 2³² members");
        self.parent.push(member);
        member
    }

    /// The representative of the set that `member` is in. Halves the way there for the next to ask.
    pub fn find(&mut self, mut member: u32) -> u32 {
        while self.parent[member as usize] != member {
            let above = self.parent[self.parent[member as usize] as usize];
            self.parent[member as usize] = above;
            member = above;
        }
        member
    }

    /// Makes one set of the two that `a` and `b` are in; false if they were one already.
    pub fn union(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b) as usize] = a.min(b);
        a != b
    }

    /// The representative of every member.
    #[must_use]
    pub fn representatives(mut self) -> Vec<u32> {
        for member in (0..).take(self.parent.len()) {
            self.parent[member as usize] = self.find(member);
        }
        self.parent
    }

    /// The finest partition that is coarser than both.
    pub(super) fn merged(mut self, other: Self) -> Self {
        for (member, &above) in (0_u32..).zip(&other.parent) {
            self.union(member, above);
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smallest_member_represents_its_set() {
        let mut sets = DisjointSets::new(6);
        assert!(sets.union(5, 3), "they were apart");
        assert!(sets.union(3, 1), "so were these");
        assert!(!sets.union(1, 5), "now they are not");
        assert_eq!([0, 1, 2, 3, 4, 5].map(|member| sets.find(member)), [0, 1, 2, 1, 4, 1], "three joined");
        assert_eq!((sets.push(), sets.union(6, 5)), (6, true), "one more");
        assert_eq!(sets.representatives(), [0, 1, 2, 1, 4, 1, 1], "four joined");
    }
}
