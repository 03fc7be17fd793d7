//! The free space of the copper, walked once for all that is asked of it.
//!
//! Level sets need all edges of the space that passes run in, up to a wall beyond them. Those
//! between owners are the boundaries between nets, as far as the wall is no nearer than copper: one
//! diagram answers for both, and for the passes of every tool.
//!
//! ```text
//!   ┌─ wall ──────────────┐
//!   │  ┌─ board ───────┐  │
//!   │  │ ▓ A ▓ │ ▓ B ▓ │  │
//!   │  └───────┴───────┘  │
//!   └─────────────────────┘
//! ```

use std::sync::{Arc, PoisonError};

use crate::board::Copper;
use crate::geometry::{BoxTree, Nm, Rect};
use crate::topology::Nets;

use super::certified::Owned;
use super::exact::{Chain, Diagram as Walk, Kind, Space, WALL};
use super::plane::{sides, spanned};
use super::{BEYOND, Diagram, FARTHEST, FLOOR, NOBODY, Settings, SiteKind};

/// The wall's edges keep so far from the board. Chosen: more than chords leave curves.
const ASIDE: Nm = Nm::from_um(1);

/// Copper's free space, as far as it has been walked.
pub(super) struct Walked {
    pub(super) diagram: Arc<Walk>,
    kind: Kind,
    wall: Rect,
}

impl Walked {
    /// The space within `wall`, and what is `asked` of it; none where it contradicts itself.
    pub(super) fn new<T>(
        owned: &Owned<'_>,
        kind: Kind,
        wall: Rect,
        asked: impl Fn(&Walk) -> Option<T>,
    ) -> (Self, Option<T>) {
        let (diagram, answer) = owned.diagram(kind, Space::Within, Some(wall), asked);
        (Self { diagram: Arc::new(diagram), kind, wall }, answer)
    }

    /// Whether all edges are there that one of this `kind` has within `wall`.
    fn covers(&self, kind: Kind, wall: Rect) -> bool {
        let has_all = match (self.kind, kind) {
            (Kind::Above(known), Kind::Above(wanted)) | (Kind::Between(known), Kind::Between(wanted)) => {
                known <= wanted
            }
            _ => false,
        };
        has_all && self.wall.union(wall) == self.wall
    }
}

/// Where a wall stands that level sets within `bounds` do not see, which run no farther from copper
/// than this.
pub(super) fn wall(bounds: Rect, farthest: Nm) -> Rect {
    // Where copper is nearer than that, the wall is not.
    bounds.inflate(farthest.min(FARTHEST) * 3 + BEYOND)
}

/// Whether no place of `board` is nearer to the wall than to copper.
fn is_copper_nearer(chains: &[Chain], board: Rect) -> bool {
    let window = BoxTree::new([sides(board.inflate(ASIDE))].into_iter());
    let mut of_wall = chains.iter().filter(|chain| [chain.left, chain.right].contains(&WALL));
    of_wall.all(|chain| !chain.samples.windows(2).any(|pair| window.meets(spanned(pair[0].at, pair[1].at))))
}

/// The certified diagram of a board.
pub(super) struct Certified {
    pub(super) diagram: Arc<Walk>,
    /// Its chains, where they had to be found to certify it.
    pub(super) found: Option<Vec<Chain>>,
    /// What was walked for it of the copper's free space.
    pub(super) walked: Option<Walked>,
}

impl Certified {
    /// That of what lies within `bounds`, on a `board`.
    pub(super) fn new(owned: &Owned<'_>, settings: &Settings, bounds: Rect, board: Rect) -> Self {
        let Settings { limit, enclosed, .. } = *settings;
        let is_of_copper = settings.sites == SiteKind::Copper;
        // No place of the board is farther from copper.
        let reach = board.union(bounds).width() + board.union(bounds).height();
        let passes = settings.passes.filter(|_| is_of_copper).into_iter().flatten();
        let levels = limit.into_iter().chain(passes.map(|far| far.min(reach)));
        let range = levels.clone().min().zip(levels.max());
        let space = range.map(|(least, most)| {
            let (kind, wall) = (settings.kind(FLOOR.min(least / 2)), wall(bounds, most));
            Walked::new(owned, kind, wall, |diagram| match limit {
                Some(limit) => diagram.limited_chains(limit.to_f64(), NOBODY, enclosed),
                None => Some(diagram.chains()),
            })
        });
        let (walked, found) = space.map_or((None, None), |(walked, found)| (Some(walked), found));
        let does_serve =
            limit.is_some() || found.as_ref().is_some_and(|chains| is_copper_nearer(chains, board));
        match walked {
            Some(walked) if does_serve => {
                let diagram = Arc::clone(&walked.diagram);
                Self { diagram, found, walked: Some(walked).filter(|_| is_of_copper) }
            }
            walked => {
                let (diagram, _) = owned.diagram(Kind::Owners, Space::Window(board), None, |_| Some(()));
                Self { diagram: Arc::new(diagram), found: None, walked }
            }
        }
    }
}

impl Diagram {
    /// The copper's free space within `wall`, and what is `asked` of it; none where it contradicts
    /// itself. What is known of it already is not walked again.
    pub(super) fn walked<T>(
        &self,
        (copper, nets): (&Copper, &Nets),
        kind: Kind,
        wall: Rect,
        asked: impl Fn(&Walk) -> Option<T>,
    ) -> (Arc<Walk>, Option<T>) {
        let lock = || self.walked.lock().unwrap_or_else(PoisonError::into_inner);
        // What does not serve is gone before more is walked: two take twice the memory.
        let known = lock().take().filter(|known| known.covers(kind, wall));
        let known = known.and_then(|known| {
            let answer = asked(&known.diagram)?;
            Some((known, Some(answer)))
        });
        let (walked, answer) = known.unwrap_or_else(|| {
            let owned = Owned::copper(copper, nets, |feature| self.kept[nets.of(feature).index()]);
            Walked::new(&owned, kind, wall, asked)
        });
        let diagram = Arc::clone(&walked.diagram);
        *lock() = Some(walked);
        (diagram, answer)
    }
}
