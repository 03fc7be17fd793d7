//! The options of a job, each known once: its name on the command line is its key in
//! `voromill.toml` and in the report, its text is read by the same parser everywhere.

use serde::{Deserialize, Serialize};

use crate::gcode::dialect::{Blend, ToolChange};
use crate::toolpath::{Angle, Direction, Feed, Material, ToolKind};
use crate::topology::Pattern;

use super::area_choice::AreaChoice;
use super::choice::{DialectChoice, DrillSide, Narrow, Origin, Sites, Strategy, Topology};
use super::distance_for::DistanceFor;
use super::machine::{MachineChoice, in_settings};
use super::merge::{self, Open};
use super::names;
use super::need::Need;
use super::output_name::OutputName;
use super::overlap::Overlap;
use super::own_lines::OwnLines;
use super::quantity::{Drills, Length, Place, Tiles, ToolChangeAt, Triple, Wait, list, text};
use super::reach::Reach;
use super::strategy_for::StrategyFor;
use super::tools::{Library, ToolChoice};
use super::turns;

/// The type, and the value, of an option that may be open, and of one that has a usual value.
macro_rules! complete {
    ($kind:ty) => {
        $kind
    };
    ($kind:ty, usual) => {
        <$kind as Open>::Held
    };
    ($given:expr, $other:expr) => {
        $given
    };
    ($given:expr, $other:expr, usual) => {
        $given.or($other).expect("the defaults say it")
    };
}

/// The structure of the options, for serde, and what the list says of each.
macro_rules! structure {
    ($($heading:literal {$(
        $(#[doc = $about:tt])+
        #[arg($($argument:tt)*)]
        $(#[serde($($key:tt)*)])?
        $(#[instead_of($($other:ident),+)])?
        $(#[needs($need:ident)])?
        #[changes($($output:ident),+)]
        pub $name:ident: $kind:ty $(= $usual:ident)?,
    )+})+) => {
        /// What a person asked for; what they left open is none.
        #[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
        pub struct Options {
            $($(
                $(#[doc = $about])+
                $(#[serde($($key)*)])?
                pub $name: $kind,
            )+)+

            /// One's own tools: tables of the settings file alone.
            #[serde(skip_serializing)]
            pub tools: Library,
        }

        /// The options where the defaults fill what is open: those of which they say something have
        /// a value.
        #[derive(Clone, Debug)]
        pub(super) struct Complete {
            $($(pub(super) $name: complete!($kind $(, $usual)?),)+)+
            pub(super) tools: Library,
        }

        /// What each option changes, in the order of the keys.
        const REACHES: &[Reach] = &[$($(Reach::NONE$(.and(Reach::$output))+,)+)+];

        impl Options {
            /// These, and where they leave something open, `others`.
            #[must_use]
            pub fn or(self, mut others: Self) -> Self {
                $($($($(merge::replace(
                    (&self.$name, &self.$other),
                    (&mut others.$name, &mut others.$other),
                );)+)?)+)+
                let tools = self.tools.clone().with(self.yielding(others.tools));
                Self { $($($name: self.$name.otherwise(others.$name),)+)+ tools }
            }

            /// Those that change any of this, and one's own tools without the depths to which they
            /// isolate.
            pub(super) fn of_reach(self, reach: Reach) -> Self {
                let mut changes = REACHES.iter().map(|changes| changes.meets(reach));
                Self {
                    $($($name: if changes.next() == Some(true) { self.$name } else { Default::default() },)+)+
                    tools: self.tools.each(|tool| tool.depth = None),
                }
            }

            /// These, and the defaults where they leave something open.
            pub(super) fn complete(self) -> Complete {
                let usual = Self::defaults();
                Complete { $($($name: complete!(self.$name, usual.$name $(, $usual)?),)+)+ tools: self.tools }
            }

            /// Two that are set and say the same in different ways, if there are such.
            pub(super) fn contradiction(&self) -> Option<[&'static str; 2]> {
                $($($($(
                    if !self.$name.is_open() && !self.$other.is_open() {
                        return Some([stringify!($other), stringify!($name)]);
                    }
                )+)?)+)+
                None
            }

            /// What each option that is set needs, by its key.
            pub(super) fn needs(&self) -> Vec<(&'static str, Need)> {
                let needs: &[(bool, &[Need])] =
                    &[$($((self.$name.is_open(), &[$(Need::$need)?]),)+)+];
                let of_set = Self::keys().zip(needs).filter(|(_, (is_open, _))| !is_open);
                of_set.flat_map(|(key, (_, needs))| needs.iter().map(move |&need| (key, need))).collect()
            }
        }
    };
}

crate::job_options!(structure);

impl Options {
    /// Every key of a settings file that is an option on the command line, too.
    pub(super) fn keys() -> impl Iterator<Item = &'static str> {
        names::of::<Self>().iter().copied().filter(|key| *key != "tools")
    }

    /// What the option of this key changes, if there is one.
    #[must_use]
    pub fn reach(key: &str) -> Option<Reach> {
        Self::keys().zip(REACHES).find(|(known, _)| *known == key).map(|(_, &reach)| reach)
    }

    /// Every option that is set, by name, as it is written.
    #[must_use]
    pub fn listed(&self) -> Vec<(String, String)> {
        let Ok(serde_json::Value::Object(options)) = serde_json::to_value(self) else { return Vec::new() };
        let shown =
            |value: serde_json::Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        let set = options.into_iter().filter(|(_, value)| !value.is_null() && value != "");
        set.map(|(key, value)| (key, shown(value))).collect()
    }

    /// The same of those that change any of this.
    #[must_use]
    pub fn listed_for(&self, reach: Reach) -> Vec<(String, String)> {
        self.listed()
            .into_iter()
            .filter(|(key, _)| Self::reach(key).is_some_and(|changes| changes.meets(reach)))
            .collect()
    }

    /// These tools; what the options say for every tool of a kind, no table says.
    fn yielding(&self, tools: Library) -> Library {
        tools.each(|tool| {
            let (plunge, spindle) = match tool.kind {
                ToolKind::Drill { .. } => (self.drill_plunge.is_some(), self.drill_spindle.is_some()),
                ToolKind::VBit { .. } | ToolKind::EndMill { .. } => {
                    (self.plunge.is_some(), self.spindle.is_some())
                }
            };
            tool.feed = tool.feed.filter(|_| self.feed.is_none());
            tool.plunge = tool.plunge.filter(|_| !plunge);
            tool.spindle = tool.spindle.filter(|_| !spindle);
            tool.depth = tool.depth.filter(|_| self.depth.is_none() && self.kerf.is_none());
        })
    }
}
