//! The words by which programs name layers, and people.

use super::Role;
use crate::board::Side;

/// Extensions that say it all.
pub(super) const EXTENSIONS: &[(&str, Role)] = &[
    ("gtl", Role::Copper(Side::Front)),
    ("cmp", Role::Copper(Side::Front)),
    ("top", Role::Copper(Side::Front)),
    ("gbl", Role::Copper(Side::Back)),
    ("sol", Role::Copper(Side::Back)),
    ("bot", Role::Copper(Side::Back)),
    ("gko", Role::Outline),
    ("gm1", Role::Outline),
    ("gml", Role::Outline),
    ("oln", Role::Outline),
    ("mil", Role::Outline),
    ("dim", Role::Outline),
    ("drl", Role::Drill),
    ("drd", Role::Drill),
    ("xln", Role::Drill),
    ("exc", Role::Drill),
    ("tap", Role::Drill),
    ("cnc", Role::Drill),
    ("ncd", Role::Drill),
    ("gts", Role::Other("solder mask")),
    ("gbs", Role::Other("solder mask")),
    ("stc", Role::Other("solder mask")),
    ("sts", Role::Other("solder mask")),
    ("smt", Role::Other("solder mask")),
    ("smb", Role::Other("solder mask")),
    ("tsm", Role::Other("solder mask")),
    ("bsm", Role::Other("solder mask")),
    ("tsp", Role::Other("paste")),
    ("bsp", Role::Other("paste")),
    ("tsk", Role::Other("silkscreen")),
    ("bsk", Role::Other("silkscreen")),
    ("gtp", Role::Other("paste")),
    ("gbp", Role::Other("paste")),
    ("crc", Role::Other("paste")),
    ("crs", Role::Other("paste")),
    ("spt", Role::Other("paste")),
    ("spb", Role::Other("paste")),
    ("gto", Role::Other("silkscreen")),
    ("gbo", Role::Other("silkscreen")),
    ("plc", Role::Other("silkscreen")),
    ("pls", Role::Other("silkscreen")),
    ("ast", Role::Other("documentation")),
    ("asb", Role::Other("documentation")),
    ("sst", Role::Other("silkscreen")),
    ("ssb", Role::Other("silkscreen")),
    ("gpt", Role::Other("pad master")),
    ("gpb", Role::Other("pad master")),
    ("gd1", Role::Other("drill drawing")),
    ("gg1", Role::Other("drill guide")),
    ("ipc", Role::Other("netlist")),
    ("apr_lib", Role::Other("aperture macros")),
];

/// How KiCad's names end, old and new, with `.` and `-` written as `_`.
pub(super) const KICAD: &[(&str, Role)] = &[
    ("f_cu", Role::Copper(Side::Front)),
    ("b_cu", Role::Copper(Side::Back)),
    ("edge_cuts", Role::Outline),
    ("pcb_edges", Role::Outline),
    ("f_mask", Role::Other("solder mask")),
    ("b_mask", Role::Other("solder mask")),
    ("f_paste", Role::Other("paste")),
    ("b_paste", Role::Other("paste")),
    ("f_silks", Role::Other("silkscreen")),
    ("b_silks", Role::Other("silkscreen")),
    ("f_silkscreen", Role::Other("silkscreen")),
    ("b_silkscreen", Role::Other("silkscreen")),
    ("f_adhes", Role::Other("glue")),
    ("b_adhes", Role::Other("glue")),
    ("f_fab", Role::Other("documentation")),
    ("b_fab", Role::Other("documentation")),
    ("f_crtyd", Role::Other("documentation")),
    ("b_crtyd", Role::Other("documentation")),
    ("margin", Role::Other("documentation")),
    ("dwgs_user", Role::Other("documentation")),
    ("cmts_user", Role::Other("documentation")),
    ("eco1_user", Role::Other("documentation")),
    ("eco2_user", Role::Other("documentation")),
];

/// Parts of words, the decisive first: what a name means that holds one of them.
pub(super) const PARTS: &[(&str, Role)] = &[
    ("mask", Role::Other("solder mask")),
    ("resist", Role::Other("solder mask")),
    ("paste", Role::Other("paste")),
    ("cream", Role::Other("paste")),
    ("stencil", Role::Other("paste")),
    ("silk", Role::Other("silkscreen")),
    ("legend", Role::Other("silkscreen")),
    ("overlay", Role::Other("silkscreen")),
    ("assembly", Role::Other("documentation")),
    ("drawing", Role::Other("documentation")),
    ("document", Role::Other("documentation")),
    ("courtyard", Role::Other("documentation")),
    ("drillmap", Role::Other("drill map")),
    ("inner", Role::Other("inner copper")),
    ("internal", Role::Other("inner copper")),
    ("drill", Role::Drill),
    ("npth", Role::Drill),
    ("padmaster", Role::Other("pad master")),
    ("outline", Role::Outline),
    // As Siemens' tools spell it.
    ("outlline", Role::Outline),
    ("profile", Role::Outline),
    ("contour", Role::Outline),
    ("border", Role::Outline),
    // pcb-rnd's.
    ("boundary", Role::Outline),
    ("dimension", Role::Outline),
    ("cutout", Role::Outline),
    ("perimeter", Role::Outline),
    // Zuken's.
    ("boardfigure", Role::Outline),
    // As people name files in German, French, Spanish and Italian.
    ("stopp", Role::Other("solder mask")),
    ("masque", Role::Other("solder mask")),
    ("maschera", Role::Other("solder mask")),
    ("bestuck", Role::Other("silkscreen")),
    ("siebdruck", Role::Other("silkscreen")),
    ("serigra", Role::Other("silkscreen")),
    ("bohr", Role::Drill),
    ("percage", Role::Drill),
    ("taladro", Role::Drill),
    ("foratura", Role::Drill),
    ("umris", Role::Outline),
    ("kontur", Role::Outline),
    ("contorno", Role::Outline),
];

/// Whole words that set a layer aside, whatever else its name says: `StopTop`, `PosiBot`,
/// `TopAssy`.
pub(super) const ASIDE: &[(&str, Role)] = &[
    ("stop", Role::Other("solder mask")),
    ("posi", Role::Other("silkscreen")),
    ("pads", Role::Other("pad master")),
    ("fab", Role::Other("documentation")),
    ("assy", Role::Other("documentation")),
    ("mid", Role::Other("inner copper")),
    ("intern", Role::Other("inner copper")),
    ("plane", Role::Other("inner copper")),
];

/// Whole words, also with a number behind, by which a name means a layer that nobody mills, and no
/// copper that only sounds like one: `soldermask`, and not `unmasked`.
pub(super) const NEVER_MILLED: [&str; 23] = [
    "mask",
    "soldermask",
    "solderresist",
    "resist",
    "stop",
    "paste",
    "solderpaste",
    "pastemask",
    "cream",
    "stencil",
    "silk",
    "silkscreen",
    "legend",
    "overlay",
    "assembly",
    "assy",
    "fab",
    "document",
    "documentation",
    "drawing",
    "drawings",
    "drillmap",
    "courtyard",
];

/// Whole words for the side of a layer of any kind.
pub(super) const SIDE_WORDS: &[(Side, &[&str])] = &[
    (Side::Front, &["top", "front", "toplayer", "oben", "oberseite", "dessus", "superior", "sopra"]),
    (
        Side::Back,
        &["bottom", "bot", "back", "bottomlayer", "unten", "unterseite", "dessous", "inferior", "sotto"],
    ),
];

/// Whole words; where a name holds several of these or of the sides, the last counts.
pub(super) const WORDS: &[(&str, Role)] = &[
    ("component", Role::Copper(Side::Front)),
    ("comp", Role::Copper(Side::Front)),
    ("solder", Role::Copper(Side::Back)),
    ("edge", Role::Outline),
    ("edges", Role::Outline),
    ("mechanical", Role::Outline),
    ("pth", Role::Drill),
    ("holes", Role::Drill),
];

/// Words before the number of a layer that is counted from the component side: gEDA's `group1`,
/// Zuken's `Conductive-1`, PADS' `art001`, and `L1`.
pub(super) const COUNTED: [&str; 5] = ["group", "layer", "conductive", "art", "l"];

/// Extensions of layers on one side.
pub(super) const SIDES: &[(Side, &[&str])] = &[
    (
        Side::Front,
        &[
            "gtl", "cmp", "top", "gts", "stc", "smt", "tsm", "tsp", "tsk", "gtp", "crc", "spt", "gto", "plc",
            "sst", "gpt",
        ],
    ),
    (
        Side::Back,
        &[
            "gbl", "sol", "bot", "gbs", "sts", "smb", "bsm", "bsp", "bsk", "gbp", "crs", "spb", "gbo", "pls",
            "ssb", "gpb",
        ],
    ),
];
