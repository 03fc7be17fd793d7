//! Numbers of tools: each tool has one in all programs of a job, and no other tool has it.
//!
//! A machine's operator then prepares a table once, and T2 in the program that drills is not the
//! cutter of T2 in the one before.

use crate::toolpath::{Program, Tool, ToolKind};

use super::tools::Library;

/// Gives the tools of `programs` their numbers: those of one's own the ones that their tables say,
/// the others the lowest that are free, in the order in which they are first used.
pub(super) fn number<'a>(programs: impl Iterator<Item = &'a mut Program>, library: &Library) {
    let taken = library.numbers();
    let mut free = (1..).filter(|number| !taken.contains(number));
    let mut given: Vec<(Identity, u32)> = Vec::new();
    for tool in programs.flat_map(|program| &mut program.sections).map(|section| &mut section.tool) {
        let identity = Identity::of(tool, library);
        let known = given.iter().find(|(other, _)| *other == identity).map(|(_, number)| *number);
        tool.number = known.unwrap_or_else(|| {
            let own = identity.own.as_deref().and_then(|name| library.number(name));
            let number = own.or_else(|| free.next()).expect("numbers do not end");
            given.push((identity, number));
            number
        });
    }
}

/// What makes two tools the same: their shape, and for those of one's own the name.
#[derive(PartialEq, Eq)]
struct Identity {
    kind: ToolKind,
    own: Option<String>,
}

impl Identity {
    fn of(tool: &Tool, library: &Library) -> Self {
        Self { kind: tool.kind, own: library.has(&tool.name).then(|| tool.name.clone()) }
    }
}
