//! The options of a job as arguments: what the library lists, read by clap.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Arg, ArgMatches, Args, Command, FromArgMatches, Id};
use serde::de::value::Error;
use serde::de::{DeserializeOwned, IntoDeserializer};
use voromill::gcode::dialect::{Blend, ToolChange};
use voromill::geometry::Nm;
use voromill::job::{
    AreaChoice, DialectChoice, DistanceFor, DrillSide, Drills, Length, MachineChoice, Narrow, Options,
    Origin, OutputName, Overlap, OwnLines, Place, Sites, Strategy, StrategyFor, Tiles, ToolChangeAt,
    ToolChoice, Topology, Triple, Wait, names, turns,
};
use voromill::toolpath::{Angle, Direction, Feed, Material};
use voromill::topology::Pattern;

macro_rules! arguments {
    ($($heading:literal {$(
        $(#[doc = $about:tt])+
        #[arg($($argument:tt)*)]
        $(#[serde($($key:tt)*)])?
        $(#[instead_of($($other:ident),+)])?
        $(#[needs($need:ident)])?
        #[changes($($output:ident),+)]
        pub $name:ident: $kind:ty $(= $usual:ident)?,
    )+})+) => {
        #[derive(Args)]
        struct Arguments {
            $($(
                $(#[doc = $about])+
                #[arg(help_heading = $heading)]
                $(#[arg(conflicts_with_all = [$(stringify!($other)),+])])?
                #[arg($($argument)*)]
                $name: $kind,
            )+)+
        }

        impl From<Arguments> for Options {
            fn from(given: Arguments) -> Self {
                Self { $($($name: given.$name,)+)+ ..Self::default() }
            }
        }
    };
}

voromill::job_options!(arguments);

/// The options that were given on the command line.
pub(super) struct Given(pub(super) Options);

impl FromArgMatches for Given {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        Arguments::from_arg_matches(matches).map(|given| Self(given.into()))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl Args for Given {
    fn augment_args(command: Command) -> Command {
        Arguments::augment_args(command)
    }

    fn augment_args_for_update(command: Command) -> Command {
        Arguments::augment_args_for_update(command)
    }
}

/// An option of a job, by its key in a settings file, as it is written on the command line.
pub(super) fn flag(key: &str) -> String {
    let given = Given::augment_args(Command::new("options"));
    let long =
        given.get_arguments().find(|argument| key_of(argument.get_id()) == key).and_then(Arg::get_long);
    format!("--{}", long.unwrap_or(key))
}

/// The key in a settings file of the option that clap knows by this name.
pub(super) fn key_of(id: &Id) -> String {
    id.as_str().replace('_', "-")
}

/// Reads one of the words that an enumeration of the library has.
pub(super) fn choice<T: DeserializeOwned + Clone + Send + Sync + 'static>() -> impl TypedValueParser<Value = T>
{
    PossibleValuesParser::new(names::of::<T>()).try_map(|word| of_word(&word))
}

/// What an enumeration of the library has for a word.
pub(super) fn of_word<T: DeserializeOwned>(word: &str) -> Result<T, Error> {
    T::deserialize(word.into_deserializer())
}

/// A length of something that is there.
pub(super) fn above_zero(text: &str) -> Result<Nm, String> {
    length_if(text, |length| length > Nm::ZERO, "expected a length above zero")
}

/// A length that may be zero.
pub(super) fn not_below_zero(text: &str) -> Result<Nm, String> {
    length_if(text, |length| length >= Nm::ZERO, "expected a length of zero or more")
}

/// A length that fits what is `expected`.
pub(super) fn length_if(text: &str, fits: impl Fn(Nm) -> bool, expected: &str) -> Result<Nm, String> {
    let length = text.parse::<Nm>().map_err(|error| error.to_string())?;
    if fits(length) { Ok(length) } else { Err(expected.to_owned()) }
}
