//! The profiles that are built in, each as the TOML that `voromill machine show` prints.
//!
//! Typical figures, not measured ones: machines of one name differ, and people change their
//! settings.

/// Name and text of each.
pub const READY: &[(&str, &str)] = &[
    ("3018", include_str!("profiles/3018.toml")),
    ("shapeoko", include_str!("profiles/shapeoko.toml")),
    ("linuxcnc-router", include_str!("profiles/linuxcnc-router.toml")),
    ("pcb-mill", include_str!("profiles/pcb-mill.toml")),
];
