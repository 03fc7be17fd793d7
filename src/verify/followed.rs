//! A program's text, followed: what any machine does with it, whatever it mills.

use crate::gcode::read::{self, Listing, Tally};

use super::declared::{Mounted, declared_setting};
use super::stream::{Feature, features, taken_at_once};
use super::{Cutter, Error, Placement, Program};

/// A program, followed.
#[derive(Debug)]
pub(super) struct Followed {
    pub(super) file: String,
    /// How what it is for lies on the machine.
    pub(super) placement: Placement,
    /// What it says; without its motions as soon as they were looked at.
    pub(super) listing: Listing,
    /// With what.
    pub(super) tools: Tools,
    /// The controller that it is for, where that is known.
    pub(super) controller: Option<String>,
    /// What of its lines some controllers take otherwise than it reads.
    pub(super) features: Vec<(Feature, Tally)>,
    /// Characters that its controller takes at once, wherever they stand.
    pub(super) at_once: Vec<(char, Tally)>,
}

impl Followed {
    /// Follows `program`, whose comments name the tools `mounted`.
    pub(super) fn read(
        program: &Program,
        mut mounted: Vec<Mounted>,
        placement: Placement,
    ) -> Result<Self, Error> {
        let text = read::without_own_code(&program.text);
        let listing =
            read::read(&text).map_err(|reason| Error::Read { file: program.file.clone(), reason })?;
        let point = declared_setting(&program.text, "drill-tip-angle");
        if let Some(degrees) = point.and_then(|angle| angle.strip_suffix("deg")?.parse::<f64>().ok()) {
            mounted.iter_mut().for_each(|tool| tool.cutter = tool.cutter.pointed(degrees));
        }
        let controller = program.dialect.clone().or_else(|| declared_setting(&program.text, "dialect"));
        Ok(Self {
            file: program.file.clone(),
            placement,
            features: features(&text, &listing),
            listing,
            tools: Tools { only: program.cutter, declared: mounted },
            at_once: controller.as_ref().map_or_else(Vec::new, |name| taken_at_once(program, name)),
            controller,
        })
    }
}

/// The tools of a program by line.
#[derive(Debug)]
pub(super) struct Tools {
    only: Option<Cutter>,
    declared: Vec<Mounted>,
}

impl Tools {
    /// Whether they are the same in the same order.
    pub(super) fn are(&self, other: &Self) -> bool {
        let declared = |tools: &Self| tools.declared.iter().map(|tool| tool.cutter).collect::<Vec<_>>();
        self.only == other.only && declared(self) == declared(other)
    }

    /// The tool that cuts in `line`.
    pub(super) fn at(&self, line: u32) -> Option<Cutter> {
        self.only.or_else(|| Some(self.mounted(line)?.cutter))
    }

    /// Its number, where comments say it.
    pub(super) fn number_at(&self, line: u32) -> Option<u32> {
        self.mounted(line)?.number
    }

    fn mounted(&self, line: u32) -> Option<&Mounted> {
        let before = self.declared.partition_point(|tool| tool.line <= line);
        before.checked_sub(1).map(|last| &self.declared[last])
    }
}
