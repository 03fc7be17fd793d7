//! What a controller says of itself → the TOML of a profile.

mod grbl;
mod linuxcnc;

use std::fmt::Write as _;

use crate::geometry::Nm;

/// The most travel that is written down: farther than any board is long, and within what a length
/// can be. Chosen.
const FAR: Nm = Nm::from_mm(1000);

/// Why no profile can be made of a text: the line, where there is one, and what was expected.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{message}", line.map_or(String::new(), |line| format!("line {line}: ")))]
pub struct ImportError {
    /// From 1.
    pub line: Option<usize>,
    /// What is wrong.
    pub message: String,
}

impl ImportError {
    fn at(line: usize, message: impl Into<String>) -> Self {
        Self { line: Some(line), message: message.into() }
    }

    fn whole(message: impl Into<String>) -> Self {
        Self { line: None, message: message.into() }
    }
}

/// A profile as it is written down: keys with their values, and what a person must know.
#[derive(Debug, Default)]
struct Draft {
    /// As comments above it.
    notes: Vec<String>,
    /// Key and value, the value as TOML has it.
    entries: Vec<(&'static str, String)>,
}

impl Draft {
    fn text(&mut self, key: &'static str, value: &str) {
        self.entries.push((key, toml::Value::from(value).to_string()));
    }

    fn number(&mut self, key: &'static str, value: u32) {
        self.entries.push((key, value.to_string()));
    }

    fn to_toml(&self) -> String {
        let mut text = String::new();
        for note in &self.notes {
            let _ = writeln!(text, "# {note}");
        }
        text.push_str("[machine]\n");
        for (key, value) in &self.entries {
            let _ = writeln!(text, "{key} = {value}");
        }
        text
    }
}

/// The profile of the machine whose settings these are: Grbl's answer to `$$`, or a LinuxCNC ini
/// file. `name` is what it is called where the settings do not say.
///
/// # Errors
///
/// [`ImportError`] for a text that is neither, for values that make no sense, and where speeds or
/// accelerations are missing.
pub fn import_machine(name: &str, text: &str) -> Result<String, ImportError> {
    let draft = if text.lines().any(|line| grbl::setting(line).is_some()) {
        grbl::read(name, text)
    } else if text.lines().any(|line| linuxcnc::section(line).is_some()) {
        linuxcnc::read(name, text)
    } else {
        Err(ImportError::whole(
            "neither Grbl's settings, lines such as `$110=500.000`, nor a LinuxCNC ini file with sections such as `[AXIS_X]`",
        ))
    }?;
    let text = draft.to_toml();
    // What is printed can be read.
    super::Profile::from_toml(&text).map_err(ImportError::whole)?;
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::super::Profile;
    use super::*;

    const DUMP: &str = "Grbl 1.1h ['$' for help]\n$11=0.020\n$30=8000\n$31=500\n$32=0\n$110=1000.000\n$111 = 900.5  (y max rate)\n$112=400.000\n$120=30.000\n$121=25.000\n$122=10.000\n$130=300.000\n$131=180.000\n$132=45.000\nok\n";

    const INI: &str = "[EMC]\nMACHINE = my-router\n[TRAJ]\nLINEAR_UNITS = inch # not mm\nMAX_LINEAR_VELOCITY = 1\n[AXIS_X]\nMAX_VELOCITY = 2\nMAX_ACCELERATION = 10\nMIN_LIMIT = -1\nMAX_LIMIT = 11\n[AXIS_Y]\nMAX_VELOCITY = 0.5\nMAX_ACCELERATION = 10\nMIN_LIMIT = 0\nMAX_LIMIT = 8\n[JOINT_2]\nMAX_VELOCITY = 0.25\nMAX_ACCELERATION = 5\nMIN_LIMIT = -3.5\nMAX_LIMIT = 0.5\n[SPINDLE_0]\nMAX_FORWARD_VELOCITY = 24000\n";

    fn profile(text: &str) -> Profile {
        let toml = import_machine("mine", text).expect("a profile");
        Profile::from_toml(&toml).expect("TOML")
    }

    #[test]
    fn grbls_settings_become_a_profile() {
        let profile = profile(DUMP);
        assert_eq!(
            profile.rapid.map(|x| x.to_string()).as_deref(),
            Some("1000mm/min,900.5mm/min,400mm/min"),
            "$110"
        );
        assert_eq!(
            profile.acceleration.map(|x| x.to_string()).as_deref(),
            Some("30mm/s2,25mm/s2,10mm/s2"),
            "$120"
        );
        assert_eq!(profile.travel.map(|x| x.to_string()).as_deref(), Some("300mm,180mm,45mm"), "$130");
        assert_eq!((profile.spindle_min, profile.spindle_max), (Some(500), Some(8000)), "$31 and $30");
        assert_eq!(profile.junction_deviation.map(|x| x.to_string()).as_deref(), Some("0.02mm"), "$11");
        assert_eq!(profile.dialect.map(|x| x.to_string()).as_deref(), Some("grbl"), "its dialect");
    }

    #[test]
    fn a_spindle_that_is_not_in_turns_and_laser_mode_are_pointed_out() {
        let text = DUMP.replace("$30=8000", "$30=1000").replace("$32=0", "$32=1");
        let toml = import_machine("mine", &text).expect("a profile");
        assert!(!toml.contains("spindle-max ="), "a thousand steps are no turns: {toml}");
        assert!(toml.contains("# $30") && toml.contains("# $32"), "said: {toml}");
    }

    #[test]
    fn linuxcncs_ini_becomes_a_profile_in_millimetres() {
        let profile = profile(INI);
        assert_eq!(profile.name, "my-router", "its name");
        let rapid = profile.rapid.map(|x| x.to_string());
        assert_eq!(
            rapid.as_deref(),
            Some("1524mm/min,762mm/min,381mm/min"),
            "the trajectory's limit holds for x"
        );
        assert_eq!(
            profile.travel.map(|x| x.to_string()).as_deref(),
            Some("304.8mm,203.2mm,101.6mm"),
            "limits"
        );
        assert_eq!(profile.spindle_max, Some(24_000), "the spindle");
    }

    #[test]
    fn what_cannot_be_a_machine_is_refused_with_its_line() {
        for (text, line, expected) in [
            (DUMP.replace("$110=1000.000\n", ""), None, "$110"),
            (DUMP.replace("$120=30.000", "$120=fast"), Some(9), "`fast`"),
            (DUMP.replace("$120=30.000", "$120=0"), Some(9), "`0`"),
            (DUMP.replace("ok", "$110=500.000"), Some(15), "twice"),
            (INI.replace("LINEAR_UNITS = inch # not mm\n", ""), None, "LINEAR_UNITS"),
            (INI.replace("= inch # not mm", "= furlong"), Some(4), "furlong"),
            (INI.replace("MAX_VELOCITY = 0.5", "MAX_VELOCITY = x"), Some(12), "`x`"),
            (INI.replace("MAX_VELOCITY = 0.5\n", ""), None, "[AXIS_Y]MAX_VELOCITY"),
            ("hello".to_owned(), None, "neither"),
        ] {
            let error = import_machine("mine", &text).expect_err(expected);
            assert_eq!(error.line, line, "{error}");
            assert!(error.to_string().contains(expected), "{error}");
        }
    }
}
