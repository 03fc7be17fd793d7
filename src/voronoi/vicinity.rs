//! The sites of two owners about a place: a boundary asks for them at every step, and they are
//! sought once for many.

use std::cell::RefCell;

use super::near::Near;
use super::plane::Spot;
use super::seed::Sites;

/// An index of all sites that remembers what it was last asked.
pub(super) struct Vicinity<'a> {
    pub(super) near: &'a Near,
    known: RefCell<Known>,
    /// How much farther than asked it looks, in nanometres.
    spare: f64,
}

/// The entries of the index that belong to either of two owners and come within a disc, in the
/// index's order.
#[derive(Default)]
struct Known {
    owners: [u32; 2],
    center: Spot,
    radius: f64,
    entries: Vec<u32>,
}

impl Known {
    fn covers(&self, owners: [u32; 2], p: Spot, bound: f64) -> bool {
        // Inside copper the bound is negative, and what is sought holds `p` itself.
        self.owners == owners && (p - self.center).length() + bound.max(0.0) <= self.radius
    }
}

impl<'a> Vicinity<'a> {
    pub(super) fn new(near: &'a Near, spare: f64) -> Self {
        Self { near, known: RefCell::default(), spare }
    }

    /// The site that is nearer to `p` than `bound`, in nanometres, among those of two owners whose
    /// labels are accepted: the nearest such. `p` lies on no copper.
    pub(super) fn nearer(
        &self,
        sites: &Sites,
        p: Spot,
        bound: f64,
        owners: [u32; 2],
        accept: impl Fn(u32) -> bool,
    ) -> Option<u32> {
        let mut known = self.known.borrow_mut();
        if !known.covers(owners, p, bound) {
            let radius = bound.max(0.0) + self.spare;
            known.entries.clear();
            self.near.visit(sites, p, radius, |entry, owner| {
                if owners.contains(&owner) {
                    known.entries.push(entry);
                }
            });
            (known.owners, known.center, known.radius) = (owners, p, radius);
        }
        self.near.nearest_of(sites, &known.entries, p, bound, accept)
    }
}
