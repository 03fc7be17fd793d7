//! Values by the number of what they belong to, packed.

/// The values of many things, numbered from 0, side by side: two allocations, however many there
/// are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Groups<T> {
    /// Where the values of each begin; one more ends the last.
    starts: Vec<u32>,
    values: Vec<T>,
}

impl<T> Default for Groups<T> {
    fn default() -> Self {
        Self { starts: vec![0], values: Vec::new() }
    }
}

impl<T> Groups<T> {
    /// The values of each thing, one after the other.
    pub(crate) fn of_each<V: IntoIterator<Item = T>>(all: impl ExactSizeIterator<Item = V>) -> Self {
        let mut groups = Self::default();
        groups.starts.reserve_exact(all.len());
        all.for_each(|each| _ = groups.push(each));
        groups.values.shrink_to_fit();
        groups
    }

    /// Adds a thing with its values: its number.
    pub(crate) fn push(&mut self, values: impl IntoIterator<Item = T>) -> u32 {
        let thing = number(self.len());
        self.values.extend(values);
        self.starts.push(number(self.values.len()));
        thing
    }

    /// How many things there are.
    pub(crate) const fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// The values of the thing `i`, in order.
    pub(crate) fn of(&self, i: usize) -> &[T] {
        &self.values[self.starts[i] as usize..self.starts[i + 1] as usize]
    }

    /// The values of each thing.
    pub(crate) fn iter(&self) -> impl ExactSizeIterator<Item = &[T]> {
        (0..self.len()).map(|i| self.of(i))
    }
}

impl<T: Copy> Groups<T> {
    /// `pairs` of the number of a thing, of `count`, and a value of it: each thing has its own in
    /// their order.
    pub(crate) fn new(count: usize, pairs: impl Iterator<Item = (u32, T)> + Clone) -> Self {
        let mut starts = vec![0_u32; count + 1];
        pairs.clone().for_each(|(i, _)| starts[i as usize + 1] += 1);
        for i in 0..count {
            starts[i + 1] += starts[i];
        }
        let Some((_, any)) = pairs.clone().next() else { return Self { starts, values: Vec::new() } };
        let mut values = vec![any; starts[count] as usize];
        let mut free = starts.clone();
        for (i, value) in pairs {
            let next = &mut free[i as usize];
            values[*next as usize] = value;
            *next += 1;
        }
        Self { starts, values }
    }
}

fn number(count: usize) -> u32 {
    u32::try_from(count).expect("below 2³² values")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_grouped_as_each_thing_would_collect_its_own() {
        let pairs = [(2, 'a'), (0, 'b'), (2, 'c'), (3, 'd'), (0, 'e')];
        let each = [vec!['b', 'e'], vec![], vec!['a', 'c'], vec!['d'], vec![]];
        let groups = Groups::new(5, pairs.into_iter());
        assert_eq!(groups, Groups::of_each(each.clone().into_iter()));
        assert!(groups.iter().eq(each.iter().map(Vec::as_slice)), "{groups:?}");
        assert_eq!(Groups::<char>::new(0, [].into_iter()), Groups::default());
    }
}
