//! What each file is for: by the job file, by its X2 file function, by its name.
//!
//! Every program names its layers differently, and people rename them. So three witnesses are
//! heard, in this order:
//!
//! 1. a Gerber job file (`.gbrjob`), which lists the files and their functions;
//! 2. the X2 attribute `.FileFunction` in the file itself (Gerber specification 2024.05 §5.6.3),
//!    also where KiCad and Eagle hide it in comments;
//! 3. the name, and where it tells nothing the one inside (`LN`): KiCad's `-F_Cu`, Altium's and
//!    Protel's `.GTL`, Eagle's `.cmp` and `copper_top`, EasyEDA's `Gerber_TopLayer`, DipTrace's
//!    `_Top`, gEDA's `.front` and `group1`, OrCAD's `.top`, what people call sides in other
//!    languages; also with an extension more, `.GTL.gbr`.
//!
//! Words of a name count only where they differ between the files: the board `solder-station` has
//! no back side for it.

mod function;
mod names;
mod tables;
mod words;

use crate::board::Side;

pub(super) use function::{Function, PARTIAL_HOLES, function_of, loaded_name, plating, role_by_function};
pub(super) use names::{
    draws_holes, is_gerber_by_extension, is_surely_aside, kind_by_name, role_by_extension, role_by_name,
    role_by_sure_name, side_by_name,
};
pub(super) use words::shared_start;

/// What a file is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Role {
    /// The copper of a side.
    Copper(Side),
    /// A group of layers of gEDA's `pcb`, which numbers them from the component side.
    Group(u32),
    /// The edge of the board.
    Outline,
    /// Holes.
    Drill,
    /// Anything that is not milled, with its name: `solder mask`, `inner copper`.
    Other(&'static str),
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRONT: Role = Role::Copper(Side::Front);
    const BACK: Role = Role::Copper(Side::Back);

    #[test]
    fn names_of_thirty_years_are_known() {
        let cases = [
            ("ecc83-pp-F_Cu.gbr", FRONT),
            ("multivibrator-B.Cu.gbr", BACK),
            ("amp-Edge.Cuts.gbr", Role::Outline),
            ("amp-In1_Cu.gbr", Role::Other("inner copper")),
            ("amp-F_Mask.gbr", Role::Other("solder mask")),
            ("amp-PTH.drl", Role::Drill),
            ("SE_SG_IF_V2.GTL", FRONT),
            ("pic18f14k50.gbl", BACK),
            ("pic18f14k50.gm1", Role::Outline),
            ("pic18f14k50.GP1", Role::Other("inner copper")),
            ("arduino-uno.cmp", FRONT),
            ("arduino-uno.sol", BACK),
            ("arduino-uno.stc", Role::Other("solder mask")),
            ("copper_top.gbr", FRONT),
            ("soldermask_top.gbr", Role::Other("solder mask")),
            ("solderpaste_bottom.gbr", Role::Other("paste")),
            ("silkscreen_bottom.gbr", Role::Other("silkscreen")),
            ("profile.gbr", Role::Outline),
            ("drills.xln", Role::Drill),
            ("Gerber_TopLayer.GTL", FRONT),
            ("Gerber_BoardOutlineLayer.GKO", Role::Outline),
            ("Gerber_InnerLayer1.G1", Role::Other("inner copper")),
            ("keyboard_Bottom.gbr", BACK),
            ("keyboard_BoardOutline.gbr", Role::Outline),
            ("keyboard_TopMask.gbr", Role::Other("solder mask")),
            ("hellboard.front.gbr", FRONT),
            ("hellboard.plated-drill.cnc", Role::Drill),
            ("hellboard.frontsilk.gbr", Role::Other("silkscreen")),
            ("numpres.pcb.output_group1.grb", Role::Group(1)),
            ("numpres.pcb.output_componentmask.grb", Role::Other("solder mask")),
            ("rs232_cm.top", FRONT),
            ("rs232_cm.bot", BACK),
            ("thruhole.tap", Role::Drill),
            ("top-cop.gbx", FRONT),
            ("IRNASIoTbank1.2.Top", FRONT),
            ("IRNASIoTbank1.2.StopTop", Role::Other("solder mask")),
            ("IRNASIoTbank1.2.PosiBot", Role::Other("silkscreen")),
            ("IRNASIoTbank1.2.Outline", Role::Outline),
            ("IRNASIoTbank1.2.Drill", Role::Drill),
            ("EtchLayerTop.gdo", FRONT),
            ("EtchLayerBottom.gdo", BACK),
            ("EtchLayer1Top.gdo", FRONT),
            ("EtchLayer2Bottom.gdo", BACK),
            ("etchlayer2bottom.gdo", BACK),
            ("PCBBottom.gbr", BACK),
            ("copper-top1.gbr", FRONT),
            ("BoardOutlline.gdo", Role::Outline),
            ("BOTTOM.art", BACK),
            ("PASTEMASK_TOP.art", Role::Other("solder mask")),
            ("clock - CADCAM Top Copper.TXT", FRONT),
            ("clock - CADCAM Top Solder Resist.TXT", Role::Other("solder mask")),
            ("clock - CADCAM Mechanical 1.TXT", Role::Outline),
            ("amp_COPPER-BOTTOM.gbr", BACK),
            ("amp_OUTLINES.gbr", Role::Outline),
            ("amp.toplayer.ger", FRONT),
            ("amp.internalplane1.ger", Role::Other("inner copper")),
            ("amp_Copper_Signal_Bot.gbr", BACK),
            ("amp_Pads_Top.gbr", Role::Other("pad master")),
            ("Conductive-2.gbr", Role::Group(2)),
            ("art001.pho", Role::Group(1)),
            ("amp-L4.gbr", Role::Group(4)),
            ("amp_copperTop.gtl", FRONT),
            ("amp_contour.gm1", Role::Outline),
            ("amp.global.boundary.uroute.9.gbr", Role::Outline),
            ("amp.intern.copper.none.5.gbr", Role::Other("inner copper")),
            ("amp.global.virtual.udrill.none.gbr", Role::Drill),
            ("GLOBAL_BOUNDARY_UROUTE_7", Role::Outline),
            ("amp_BoardFigure.gbr", Role::Outline),
            ("amp-pad_master.gbr", Role::Other("pad master")),
            ("amp-drill_map.gbr", Role::Other("drill map")),
            ("amp.GTL.gbr", FRONT),
            ("amp-B_Cu.gbl.gbr", BACK),
            ("amp.gts.txt", Role::Other("solder mask")),
            ("amp_Kupfer oben.gbr", FRONT),
            ("amp_Lötstopp unten.gbr", Role::Other("solder mask")),
            ("Unterseite.gbr", BACK),
            ("Bestückung_oben.gbr", Role::Other("silkscreen")),
            ("dessous.gbr", BACK),
            ("perçage.gbr", Role::Drill),
            ("cara superior.gbr", FRONT),
        ];
        for (name, role) in cases {
            assert_eq!(role_by_name(name, 0), Some(role), "{name}");
        }
        assert_eq!(role_by_name("example.grb", 0), None, "a name that tells nothing");
    }

    #[test]
    fn words_that_all_files_share_tell_nothing() {
        let names = ["solder-station.gbr", "solder-station-extra.gbr"];
        assert_eq!(shared_start(&names), "solder-".len(), "up to a mark");
        assert_eq!(role_by_name("solder-station.gbr", 7), None, "the board's name is no side");
        assert_eq!(shared_start(&["one.gbr"]), 0, "one file shares nothing");
        let alike = ["comp1", "comp1", "comp1-extra"];
        assert_eq!((shared_start(&alike), shared_start(&alike[..2])), (5, 0), "two may be of one layer");
    }

    #[test]
    fn file_functions_are_read_from_commands_and_comments() {
        for text in ["%TF.FileFunction,Copper,L2,Bot*%\n", "G04 #@! TF.FileFunction,Copper,L2,Bot,Signal*\n"]
        {
            let function = function_of(text.as_bytes()).expect("a function");
            assert_eq!(role_by_function(&function), Some(BACK), "{text}");
        }
        assert_eq!(role_by_function("Copper,L2,Inr"), Some(Role::Other("inner copper")), "an inner layer");
        assert_eq!(role_by_function("Profile,NP"), Some(Role::Outline), "the edge");
        assert_eq!(role_by_function("NonPlated,1,2,NPTH"), Some(Role::Drill), "holes");
        assert_eq!(role_by_function("Vcut,Top"), Some(Role::Other("documentation")), "not milled");
        for damaged in ["CoppeX,L2,Bot,Mixed", "Copper,L2,BoX,Mixed", "CopperXL2,Bot", ""] {
            assert_eq!(role_by_function(damaged), None, "{damaged}: the name decides");
        }
    }
}
