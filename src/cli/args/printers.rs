//! The arguments of `printers` and `coupon`.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::weighed::weighed_infill;
use crate::coupon::WeighedInfill;

/// The arguments of `printers`.
#[derive(Debug, Args)]
pub struct PrintersArgs {
    /// The action; `None` lists the printers.
    #[command(subcommand)]
    pub action: Option<PrintersAction>,
}

/// An action on printers and their profiles.
#[derive(Debug, Clone, PartialEq, Subcommand)]
pub enum PrintersAction {
    /// List the known printers
    List {
        /// Print the table as in README
        #[arg(long)]
        markdown: bool,
    },
    /// Show every number of a printer with its source
    Show {
        /// A known printer's id, or a profile file
        id: String,
    },
    /// Check a profile file and name everything that is wrong with it
    Check {
        /// The profile file
        file: PathBuf,
    },
    /// Write a shop's own profile, based on a known printer or a slicer's files
    New(NewArgs),
    /// Import a printer, its materials and layers from a slicer: PrusaSlicer and SuperSlicer .ini,
    /// Cura .def.json, .xml.fdm_material and .inst.cfg
    Import(ImportArgs),
    /// Write the measurements of coupons into a shop's own profile, with the day and the lot
    Calibrate(CalibrateArgs),
}

/// The arguments of `printers new`.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct NewArgs {
    /// The printer's id or profile, or a slicer's files
    #[arg(long, value_name = "ID|FILE", required = true, num_args = 1..)]
    pub from: Vec<PathBuf>,
    /// The name of the printer in the slicer's files
    #[arg(long, value_name = "NAME")]
    pub printer: Option<String>,
    /// The new profile's id: lower-case letters, digits and hyphens [default: the file's name]
    #[arg(long)]
    pub id: Option<String>,
    /// The file to write
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// Replace the file if it exists
    #[arg(long)]
    pub force: bool,
}

/// The arguments of `printers import`.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct ImportArgs {
    /// The slicer's files, all at once
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// List the printers and materials in them
    #[arg(long, conflicts_with_all = ["printer", "id", "out"])]
    pub list: bool,
    /// The name of the printer in them
    #[arg(long, value_name = "NAME")]
    pub printer: Option<String>,
    /// The new profile's id: lower-case letters, digits and hyphens [default: the printer's name]
    #[arg(long)]
    pub id: Option<String>,
    /// The file to write [default: the standard output]
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Replace the file if it exists
    #[arg(long)]
    pub force: bool,
}

/// The arguments of `printers calibrate`.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct CalibrateArgs {
    /// The shop's own profile
    pub file: PathBuf,
    /// The material that was measured [default: the printer's]
    #[arg(long, value_name = "ID")]
    pub material: Option<String>,
    /// The lot of the material
    #[arg(long)]
    pub lot: String,
    /// The day, as 2026-11-21 [default: today]
    #[arg(long, value_name = "DAY")]
    pub date: Option<String>,
    /// The mass of a density coupon, g; once per coupon
    #[arg(long, value_name = "G", allow_hyphen_values = true)]
    pub weighed: Vec<f64>,
    /// The masses of the large and the small block of an infill, such as 15%=6.52g,2.12g. The solid
    /// one is alone: 100%=7.84g. Needs every infill of `equipoise coupon --density`
    #[arg(long, value_name = "P%=G,G", value_parser = weighed_infill)]
    pub infill: Vec<WeighedInfill>,
    /// The nominal volume of a density coupon, mm³ [default: that of `equipoise coupon`]
    #[arg(long, value_name = "MM3", allow_hyphen_values = true)]
    pub volume: Option<f64>,
    /// The clearance per side at which the pin goes in by hand, to be glued, mm
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    pub clearance: Option<f64>,
    /// The clearance per side at which the pin is pressed in and holds, mm
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    pub press: Option<f64>,
    /// The clearance per side at which the pin falls out, mm
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    pub loose: Option<f64>,
    /// The clearance per side of the first sleeve of `equipoise coupon --slide` that slides and
    /// stops, straight and bent, mm
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    pub slide: Option<f64>,
    /// The thinnest pin that stood, mm
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    pub pin: Option<f64>,
    /// The thinnest free wall that stood, mm
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    pub wall: Option<f64>,
}

/// The arguments of `coupon`.
#[derive(Debug, Args)]
pub struct CouponArgs {
    /// A known printer's id, or a profile file
    #[arg(long, value_name = "ID|FILE", required_unless_present = "cutter")]
    pub printer: Option<String>,
    /// A material that the printer offers [default: the printer's]
    #[arg(long, value_name = "ID")]
    pub material: Option<String>,
    /// Make blocks of every infill in place of the usual coupons, to weigh what is really laid
    #[arg(long, conflicts_with = "cutter")]
    pub density: bool,
    /// Make sleeves and a plunger in place of the usual coupons, to find the clearance with which
    /// the shells of a telescope slide
    #[arg(long, conflicts_with_all = ["cutter", "density"])]
    pub slide: bool,
    /// A known laser cutter's id, or a profile file, in place of a printer
    #[arg(long, value_name = "ID|FILE", requires = "sheet", conflicts_with_all = ["printer", "material"])]
    pub cutter: Option<String>,
    /// The sheet to be cut: a known id, or a profile file
    #[arg(long, value_name = "ID|FILE", requires = "cutter")]
    pub sheet: Option<String>,
    /// Write the coupons to this folder [default: the machine's id and -coupon]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace the folder if it exists
    #[arg(long)]
    pub force: bool,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::args::{Cli, Command};
    use clap::Parser;

    fn action(line: &str) -> Option<PrintersAction> {
        match Cli::try_parse_from(line.split_whitespace())
            .unwrap()
            .command
        {
            Command::Printers(args) => args.action,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn printers_takes_list_show_and_check() {
        assert_eq!(action("equipoise printers"), None);
        assert_eq!(
            action("equipoise printers list"),
            Some(PrintersAction::List { markdown: false })
        );
        let show = PrintersAction::Show {
            id: "prusa-mk4".into(),
        };
        assert_eq!(action("equipoise printers show prusa-mk4"), Some(show));
        assert_eq!(
            action("equipoise printers check a.toml"),
            Some(PrintersAction::Check {
                file: "a.toml".into()
            })
        );
    }

    #[test]
    fn coupons_are_weighed_one_by_one() {
        let line =
            "equipoise printers calibrate s.toml --lot A --weighed 9.8 --weighed 9.9 --wall 1.1";
        let Some(PrintersAction::Calibrate(args)) = action(line) else {
            panic!("{line}")
        };
        assert_eq!(
            (args.weighed, args.wall, args.pin),
            (vec![9.8, 9.9], Some(1.1), None)
        );
    }
}
