//! Which part of a drawing is which layer of a board.

use crate::artwork::{Artwork, Drawn, Figure, diameter};
use crate::board::Side;
use crate::geometry::Nm;
use crate::import::error::Error;
use crate::import::layers::{self, Role};

/// The widest circle among bare lines that is a hole. Chosen: of boards and panels drawn so, the
/// widest hole for a screw; a wider circle is cut out.
const WIDEST_HOLE: Nm = Nm::from_um(6_500);

/// The figures of one role.
#[derive(Clone, Debug)]
pub(in crate::import) struct Part {
    pub(in crate::import) role: Role,
    pub(in crate::import) figures: Vec<Figure>,
}

/// The layers of a drawing by role.
#[derive(Clone, Debug, Default)]
pub(in crate::import) struct Parts {
    pub(in crate::import) parts: Vec<Part>,
    /// Layers that are ignored, with their role where it is known.
    pub(in crate::import) aside: Vec<(String, Option<&'static str>)>,
    /// What was guessed, in words; none where the names decided.
    pub(in crate::import) guess: Option<&'static str>,
    /// How many figures that cover something are in no layer, where there is one of copper.
    pub(in crate::import) stray: usize,
}

impl Parts {
    /// The parts of `artwork` by the names of its layers, or by what is drawn.
    pub(in crate::import) fn of(artwork: Artwork) -> Self {
        let roles: Vec<Option<Role>> = artwork.layers.iter().map(|layer| role_of(&layer.name)).collect();
        let is_known =
            |role: &Option<Role>| matches!(role, Some(Role::Copper(_) | Role::Outline | Role::Drill));
        if !roles.iter().any(is_known) {
            return Self::guessed(artwork);
        }
        let mut parts = Self::default();
        let has_copper = roles.iter().any(|role| matches!(role, Some(Role::Copper(_))));
        for (layer, role) in artwork.layers.into_iter().zip(roles) {
            if has_copper && layer.name.is_empty() {
                parts.stray = layer.figures.iter().filter(|figure| covers(figure)).count();
            }
            match role {
                Some(Role::Other(what)) => parts.aside.push((layer.name, Some(what))),
                None | Some(Role::Group(_)) => parts.aside.push((layer.name, None)),
                Some(role) => parts.add(role, layer.figures),
            }
        }
        parts
    }

    fn add(&mut self, role: Role, figures: Vec<Figure>) {
        match self.parts.iter_mut().find(|part| part.role == role) {
            Some(part) => part.figures.extend(figures),
            None => self.parts.push(Part { role, figures }),
        }
    }

    /// Areas are copper of the front; bare lines are the edge, small circles among them holes.
    fn guessed(artwork: Artwork) -> Self {
        let mut parts = Self::default();
        let figures = artwork.into_figures();
        if figures.iter().any(covers) {
            parts.guess = Some("all of it is read as front copper");
            parts.add(Role::Copper(Side::Front), figures);
            return parts;
        }
        let circles = |figure: &Figure| match figure.paths() {
            [path] => diameter(path).map(|(_, diameter)| diameter),
            _ => None,
        };
        let is_hole = |figure: &Figure| circles(figure).is_some_and(|diameter| diameter <= WIDEST_HOLE);
        let (holes, edge): (Vec<Figure>, Vec<Figure>) = figures.into_iter().partition(is_hole);
        if edge.is_empty() {
            parts.guess = Some("its circles are read as holes");
        } else if holes.is_empty() {
            parts.guess = Some("its lines are read as the outline");
        } else {
            parts.guess = Some("its lines are read as the outline, its circles up to 6.5 mm as holes");
        }
        for (role, figures) in [(Role::Outline, edge), (Role::Drill, holes)] {
            if !figures.is_empty() {
                parts.add(role, figures);
            }
        }
        parts
    }
}

/// Whether a figure covers anything.
fn covers(figure: &Figure) -> bool {
    match &figure.drawn {
        Drawn::Area(_) => true,
        Drawn::Line(line) => line.width > Nm::ZERO,
    }
}

/// The layer `name` of a drawing, alone.
pub(in crate::import) fn layer(artwork: Artwork, shown: &str, name: &str) -> Result<Artwork, Error> {
    match artwork.into_layer(name) {
        Ok(layer) => Ok(Artwork { layers: vec![layer] }),
        Err(artwork) => Err(no_layer(&artwork, shown, name)),
    }
}

fn no_layer(artwork: &Artwork, shown: &str, name: &str) -> Error {
    /// Layers that a message lists. Chosen: fits two lines.
    const SHOWN: usize = 12;
    let names: Vec<&str> =
        artwork.layers.iter().map(|layer| layer.name.as_str()).filter(|name| !name.is_empty()).collect();
    let more = if names.len() > SHOWN { ", …" } else { "" };
    let listed = names.iter().take(SHOWN).copied().collect::<Vec<_>>().join(", ");
    let what = format!("the drawing has no layer `{name}`, or nothing is on it");
    let hint = if names.is_empty() {
        "its layers have no names".to_owned()
    } else {
        format!("it has {listed}{more}")
    };
    Error::content(shown, what, hint)
}

/// What a layer is for, by its name; none where that does not tell.
pub(in crate::import) fn role_of(name: &str) -> Option<Role> {
    // Fritzing numbers copper from below.
    match name.to_ascii_lowercase().as_str() {
        "copper0" => return Some(Role::Copper(Side::Back)),
        // One side drawn by itself, as `draw --stage copper` does.
        "copper1" | "copper" => return Some(Role::Copper(Side::Front)),
        "hole" | "drills" | "bohrungen" => return Some(Role::Drill),
        "board" => return Some(Role::Outline),
        _ => {}
    }
    // As a file of no known extension.
    let role = layers::role_by_name(&format!("{}.layer", name.replace('.', "_")), 0);
    role.filter(|role| !matches!(role, Role::Group(_)))
}

/// Whether a group `name` within one `above` is a layer by itself: copper, edge or holes by KiCad's
/// name, where the other is set aside.
pub(in crate::import) fn leaves(name: &str, above: &str) -> bool {
    let is_milled = matches!(
        layers::role_by_sure_name(&format!("{name}.gbr")),
        Some(Role::Copper(_) | Role::Outline | Role::Drill)
    );
    is_milled && matches!(role_of(above), Some(Role::Other(_)))
}
