//! What parameters tell that the controller sets: where it is, what a probe found, what holds.

use crate::gcode::read::expression::Scope;
use crate::gcode::read::meaning::Distance;
use crate::gcode::read::variables::Name;
use crate::geometry::Nm;

use super::Machine;

impl Machine {
    /// A length on the board as the program counts.
    #[expect(clippy::cast_precision_loss, reason = "a small unit")]
    fn counted(&mut self, axis: usize, at: Option<Nm>) -> Option<f64> {
        let origin = self.axes[axis].origin(self.modal.system)?;
        Some((at? - origin).to_f64() / self.modal.unit as f64)
    }

    fn numbered(&mut self, number: u32) -> Option<Result<f64, String>> {
        let hidden = |what: &str| Some(Err(format!("#{number} is {what}, which only the controller knows")));
        let found = |value: Option<f64>, what: &str| {
            Some(value.ok_or_else(|| format!("#{number} is {what}, which the program does not give")))
        };
        match number {
            // LinuxCNC's and Mach3's.
            5061..=5063 | 2000..=2002 => {
                let axis = (number % 1000 - if number < 5000 { 0 } else { 61 }) as usize;
                let value = self.counted(axis, self.probed[axis]);
                found(value, "a probe result")
            }
            5070 => Some(Ok(1.0)),
            5161..=5186 => hidden("a machine position"),
            #[expect(clippy::cast_precision_loss, reason = "a small unit")]
            5211..=5213 => {
                let shift = self.axes[(number - 5211) as usize].shift();
                Some(Ok(shift.to_f64() / self.modal.unit as f64))
            }
            5220 => Some(Ok(f64::from(u32::try_from(self.modal.system + 1).unwrap_or(1)))),
            5221..=5390 => hidden("a coordinate system's zero"),
            5400 => Some(Ok(f64::from(self.tool.unwrap_or(0)))),
            5401..=5412 => hidden("the tool table"),
            5420..=5422 => {
                let axis = (number - 5420) as usize;
                let value = self.counted(axis, self.axes[axis].at);
                found(value, "where the tool is")
            }
            _ => None,
        }
    }

    fn named(&mut self, name: &str) -> Option<f64> {
        let truth = |truth: bool| f64::from(u8::from(truth));
        let axis = |letter: &str| ["_X", "_Y", "_Z"].iter().position(|name| *name == letter);
        if let Some(axis) = axis(name) {
            return self.counted(axis, self.axes[axis].at);
        }
        Some(match name {
            "_METRIC" => truth(self.modal.unit == 1_000_000),
            "_IMPERIAL" => truth(self.modal.unit != 1_000_000),
            "_ABSOLUTE" => truth(self.modal.distance == Distance::Absolute),
            "_INCREMENTAL" => truth(self.modal.distance == Distance::Incremental),
            "_SPINDLE_ON" => truth(self.modal.spinning),
            "_RPM" => f64::from(self.modal.speed?),
            "_CURRENT_TOOL" => f64::from(self.tool.unwrap_or(0)),
            "_SELECTED_TOOL" => f64::from(self.selected.unwrap_or(0)),
            // A program that runs, not one that is only looked at.
            "_TASK" => 1.0,
            _ => return None,
        })
    }
}

impl Scope for Machine {
    fn parameter(&mut self, name: &Name) -> Result<f64, String> {
        if let Some(value) = self.variables.get(name) {
            return Ok(value);
        }
        match name {
            Name::Text(text) => {
                let value = self.named(text);
                value
                    .ok_or_else(|| format!("nothing in the program gives #<{}> a value", text.to_lowercase()))
            }
            Name::Number(number) => self.numbered(*number).unwrap_or_else(|| {
                let what = format!("#{number} is read before the program gives it a value: zero is assumed");
                let line = self.line;
                self.listing.note(true, line, what);
                Ok(0.0)
            }),
        }
    }

    fn exists(&self, name: &Name) -> bool {
        self.variables.get(name).is_some()
    }
}
