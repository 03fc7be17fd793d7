//! A closed tour through stretches, kept as an array, changed by exchanges that can be taken back.
//!
//! Stretch k has the ends 2k and 2k + 1; the tour lists for each the end by which it is entered,
//! and leaves it by the other (`end ^ 1`). Every end has one partner, the end linked to it through
//! the air:
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
    partners: Vec<End>,
    /// The exchanges since the last [`Tour::mark`].
    log: Vec<Exchange>,
}

/// Two links exchanged, a–b and c–d for a–c and b–d, and the first and last place of what was
/// reversed for it.
#[derive(Clone, Copy)]
struct Exchange {
    ends: [End; 4],
    places: Option<(u32, u32)>,
}

impl Tour {
    /// Through the stretches in this order, each given by the end it is entered by.
    pub(super) fn new(entered: Vec<End>) -> Self {
        let mut place = vec![0; entered.len()];
        for (index, &end) in (0_u32..).zip(&entered) {
            place[(end / 2) as usize] = index;
        }
        let mut partners = vec![0; 2 * entered.len()];
        for (&end, &next) in entered.iter().zip(entered.iter().cycle().skip(1)) {
            partners[(end ^ 1) as usize] = next;
            partners[next as usize] = end ^ 1;
        }
        Self { entered, place, partners, log: Vec::new() }
    }

    /// The ends by which the stretches are entered, in order.
    pub(super) fn entered(&self) -> &[End] {
        &self.entered
    }

    /// How many stretches there are.
    pub(super) fn count(&self) -> u32 {
        u32::try_from(self.entered.len()).expect("stretches are numbered in 32 bits")
    }

    /// Where the stretch of an end is in the order.
    pub(super) fn place(&self, end: End) -> u32 {
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
        self.partners[end as usize]
    }

    /// Whether the tour, from the stretch of `first` on, comes to that of `end` no later than to
    /// that of `last`.
    pub(super) fn is_between(&self, first: End, end: End, last: End) -> bool {
        let [first, end, last] = [first, end, last].map(|end| self.place(end));
        if first <= last { first <= end && end <= last } else { first <= end || end <= last }
    }

    /// Unlinks a from b and c from d, and links a to c and b to d. The pairs must be partners, and
    /// a must be an entry just where c is one.
    pub(super) fn exchange(&mut self, a: End, b: End, c: End, d: End) {
        let (first, last) = if self.is_entry(a) { (b, d) } else { (a, c) };
        let after = |place: u32| if place + 1 == self.count() { 0 } else { place + 1 };
        let places = self.reverse(after(self.place(first)), self.place(last));
        self.log.push(Exchange { ends: [a, b, c, d], places });
        self.join(a, c);
        self.join(b, d);
    }

    fn join(&mut self, a: End, b: End) {
        self.partners[a as usize] = b;
        self.partners[b as usize] = a;
    }

    /// Reverses the places from `first` through `last`, round the end if need be, or the rest,
    /// which gives the same tour walked the other way, if that is shorter; which places these were,
    /// if any.
    fn reverse(&mut self, first: u32, last: u32) -> Option<(u32, u32)> {
        let count = self.count();
        let inner = (last + count - first) % count + 1;
        let (i, j, length) = if inner * 2 <= count {
            (first, last, inner)
        } else {
            ((last + 1) % count, (first + count - 1) % count, count - inner)
        };
        (length > 0).then(|| {
            self.turn(i, j);
            (i, j)
        })
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

    /// Forgets the exchanges: what is now cannot be taken back.
    pub(super) fn mark(&mut self) {
        self.log.clear();
    }

    /// The ends whose links were exchanged since the mark, some more than once.
    pub(super) fn changed(&self) -> impl Iterator<Item = End> {
        self.log.iter().flat_map(|exchange| exchange.ends)
    }

    /// Takes back all exchanges since the mark.
    pub(super) fn take_back(&mut self) {
        while let Some(Exchange { ends: [a, b, c, d], places }) = self.log.pop() {
            if let Some((first, last)) = places {
                self.turn(first, last);
            }
            self.join(a, b);
            self.join(c, d);
        }
    }
}
