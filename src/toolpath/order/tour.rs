//! A closed tour through stretches, kept as an array, changed by reversals that can be taken back.
//!
//! Stretch k has the ends 2k and 2k + 1; the tour lists for each the end by which it is entered, and leaves it by
//! the other (`end ^ 1`). Every end has one partner, the end linked to it through the air:
//!
//! ```text
//!    ──in══out──▶──in══out──▶──        out and the next in are partners
//! ```

/// An end of a stretch.
pub(super) type End = u32;

/// The tour.
pub(super) struct Tour {
    entered: Vec<End>,
    place: Vec<u32>,
    /// The reversals since the last [`Tour::mark`], each by its first and last place.
    log: Vec<(u32, u32)>,
}

impl Tour {
    /// Through the stretches in this order, each given by the end it is entered by.
    pub(super) fn new(entered: Vec<End>) -> Self {
        let mut place = vec![0; entered.len()];
        for (index, &end) in (0_u32..).zip(&entered) {
            place[(end / 2) as usize] = index;
        }
        Self { entered, place, log: Vec::new() }
    }

    /// The ends by which the stretches are entered, in order.
    pub(super) fn entered(&self) -> &[End] {
        &self.entered
    }

    /// How many stretches there are.
    pub(super) fn count(&self) -> u32 {
        u32::try_from(self.entered.len()).expect("stretches are numbered in 32 bits")
    }

    fn place(&self, end: End) -> u32 {
        self.place[(end / 2) as usize]
    }

    fn entered_at(&self, place: u32) -> End {
        self.entered[place as usize]
    }

    /// Whether the tour comes to its stretch by this end.
    pub(super) fn is_entry(&self, end: End) -> bool {
        self.entered_at(self.place(end)) == end
    }

    /// The end at the other side of the air.
    pub(super) fn partner(&self, end: End) -> End {
        let (place, last) = (self.place(end), self.count() - 1);
        if self.entered_at(place) == end {
            self.entered_at(if place == 0 { last } else { place - 1 }) ^ 1
        } else {
            self.entered_at(if place == last { 0 } else { place + 1 })
        }
    }

    /// How many stretches lie between two ends, the shorter way round.
    pub(super) fn span(&self, a: End, b: End) -> u32 {
        let apart = self.place(a).abs_diff(self.place(b));
        apart.min(self.count() - apart)
    }

    /// Unlinks a from b and c from d, and links a to c and b to d. The pairs must be partners, and a must be an
    /// entry just where c is one.
    pub(super) fn exchange(&mut self, a: End, b: End, c: End, d: End) {
        let (first, last) = if self.is_entry(a) { (b, d) } else { (a, c) };
        let after = |place: u32| if place + 1 == self.count() { 0 } else { place + 1 };
        self.reverse(after(self.place(first)), self.place(last));
    }

    /// Reverses the places from `first` through `last`, round the end if need be, or the rest, which gives
    /// the same tour walked the other way, if that is shorter.
    fn reverse(&mut self, first: u32, last: u32) {
        let count = self.count();
        let inner = (last + count - first) % count + 1;
        let (i, j, length) = if inner * 2 <= count {
            (first, last, inner)
        } else {
            ((last + 1) % count, (first + count - 1) % count, count - inner)
        };
        if length > 0 {
            self.log.push((i, j));
            self.turn(i, j);
        }
    }

    /// Reverses exactly these places, round the end if need be.
    fn turn(&mut self, first: u32, last: u32) {
        let count = self.count();
        let length = (last + count - first) % count + 1;
        let (mut i, mut j) = (first, last);
        for _ in 0..length / 2 {
            let (a, b) = (self.entered_at(i), self.entered_at(j));
            self.put(i, b ^ 1);
            self.put(j, a ^ 1);
            i = if i + 1 == count { 0 } else { i + 1 };
            j = if j == 0 { count - 1 } else { j - 1 };
        }
        if length % 2 == 1 {
            self.put(i, self.entered_at(i) ^ 1);
        }
    }

    fn put(&mut self, place: u32, end: End) {
        self.entered[place as usize] = end;
        self.place[(end / 2) as usize] = place;
    }

    /// Forgets the reversals: what is now cannot be taken back.
    pub(super) fn mark(&mut self) {
        self.log.clear();
    }

    /// How many reversals could be taken back.
    pub(super) fn changes(&self) -> usize {
        self.log.len()
    }

    /// Takes back all reversals but the first `keep`.
    pub(super) fn take_back(&mut self, keep: usize) {
        while self.log.len() > keep {
            let (i, j) = self.log.pop().expect("longer than `keep`");
            self.turn(i, j);
        }
    }
}
