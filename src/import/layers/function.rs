//! What a file says of itself: its X2 file function, and the name inside.

use super::Role;
use crate::board::{Plating, Side};
use crate::import::excellon;

/// The value of `.FileFunction`, wherever in the head of a file it stands.
pub(in crate::import) fn function_of(bytes: &[u8]) -> Option<String> {
    value_of(&bytes[..bytes.len().min(64 * 1024)], b"TF.FileFunction,")
}

/// What stands behind the first `name` in `head`, up to the end of the command or line.
fn value_of(head: &[u8], name: &[u8]) -> Option<String> {
    let start = head.windows(name.len()).position(|window| window == name)? + name.len();
    let value = head[start..].split(|b| matches!(b, b'*' | b'%' | b'\r' | b'\n')).next()?;
    Some(value.iter().map(|&b| char::from(b)).collect::<String>().trim().to_owned())
}

/// The name that a Gerber file calls its layer by, if it does (`LN`, specification 2024.05 §8.1.5):
/// `GLOBAL_BOUNDARY_UROUTE_7`.
pub(in crate::import) fn loaded_name(bytes: &[u8]) -> Option<String> {
    value_of(&bytes[..bytes.len().min(4 * 1024)], b"%LN")
}

/// File functions of what is not milled (Gerber specification 2024.05 §5.6.3).
const DOCUMENTATION: &[&str] = &[
    "ArrayDrawing",
    "AssemblyDrawing",
    "Carbonmask",
    "Component",
    "Depthrout",
    "Drawing",
    "FabricationDrawing",
    "Glue",
    "Goldmask",
    "Heatsinkmask",
    "Other",
    "OtherDrawing",
    "Pads",
    "Peelablemask",
    "Silvermask",
    "Tinmask",
    "Vcut",
    "Vcutmap",
    "Viafill",
];

/// What holes are called that do not go through the board.
pub(in crate::import) const PARTIAL_HOLES: &str = "blind or buried holes";

/// What a file function says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::import) struct Function {
    /// What the file is for.
    pub(in crate::import) role: Role,
    /// The side, of a layer of any kind.
    pub(in crate::import) side: Option<Side>,
}

impl Function {
    /// None for one that the specification has not.
    pub(in crate::import) fn read(function: &str) -> Option<Self> {
        let side = function.split(',').find_map(|field| match field.trim() {
            "Top" => Some(Side::Front),
            "Bot" => Some(Side::Back),
            _ => None,
        });
        Some(Self { role: role_by_function(function)?, side })
    }
}

/// The role that a file function names; none for one that the specification has not, as a damaged
/// byte makes it: then the name of the file decides.
pub(in crate::import) fn role_by_function(function: &str) -> Option<Role> {
    let mut fields = function.split(',').map(str::trim);
    Some(match fields.next()? {
        "Copper" => match (fields.next()?, fields.next()) {
            (_, Some("Top")) => Role::Copper(Side::Front),
            (_, Some("Bot")) => Role::Copper(Side::Back),
            (_, Some("Inr")) => Role::Other("inner copper"),
            _ => return None,
        },
        "Profile" => Role::Outline,
        "Plated" | "NonPlated" | "MixedPlating" => {
            let is_partial = fields.any(|field| matches!(field, "Blind" | "Buried"));
            if is_partial { Role::Other(PARTIAL_HOLES) } else { Role::Drill }
        }
        "Soldermask" => Role::Other("solder mask"),
        "Paste" => Role::Other("paste"),
        "Legend" => Role::Other("silkscreen"),
        "Drillmap" => Role::Other("drill map"),
        other if DOCUMENTATION.contains(&other) => Role::Other("documentation"),
        _ => return None,
    })
}

/// The plating that a drill file's function or name tells.
pub(in crate::import) fn plating(function: Option<&str>, name: &str) -> Plating {
    function.map_or_else(|| excellon::plating_by_name(name), excellon::plating_by_function)
}
