//! The flags of the command line: the one file that words a setting as a flag.

use crate::base::setting::{Key, Setting, reword};
use crate::coupon::{
    Commands, CouponSet, CutCommands, CutCouponSet, DensityCommands, DensitySet, SlideCommands,
    SlideSet,
};
use crate::job::Job;

/// The flag of the most memory that a command may take.
pub const MAX_MEMORY: &str = "--max-memory";

/// Returns the flag of a setting, such as `--ballast=auto`.
pub fn flag(setting: &Setting) -> String {
    let name = name(setting.key);
    match &setting.value {
        // Only one command has it, and others ask for it.
        None if setting.key == Key::List => "equipoise printers import FILES --list".to_owned(),
        // A switch takes no value.
        Some(_) if matches!(setting.key, Key::Thicken | Key::Plugs) => format!("--{name}"),
        Some(value) => format!("--{name}={value}"),
        None => format!("--{name}"),
    }
}

/// Returns the flags of several settings, as they are typed.
pub fn flags(settings: &[Setting]) -> String {
    settings.iter().map(flag).collect::<Vec<_>>().join(" ")
}

/// Returns a message of the library with its settings worded as flags.
pub fn with_flags(text: &str) -> String {
    reword(text, flag)
}

/// Returns the command that writes a shop's own profile from a printer.
pub fn command_for_new_profile(id: &str) -> String {
    format!("equipoise printers new --from {id} --out shop.toml")
}

/// Returns the command that makes a kit by one of the plans of a job.
pub fn command_for_plan(job: &Job) -> String {
    format!(
        "equipoise prepare {} --goal {} --printer {} --cut plan1.toml, with the size and all else as before",
        job.model.path.display(),
        job.goal.kind,
        job.printer.id
    )
}

/// Returns the command that writes the coupons of a printer.
pub fn command_for_coupons(id: &str) -> String {
    format!("equipoise coupon --printer {id}")
}

/// Returns the commands that the sheet of a printer's coupons names.
pub fn commands_on_coupon_sheet(set: &CouponSet) -> Commands {
    let profile = format!("shop-{}.toml", set.printer);
    Commands {
        make_profile: format!(
            "equipoise printers new --from {0} --id shop-{0} --out {profile}",
            set.printer
        ),
        calibrate: format!(
            "equipoise printers calibrate {profile} --material {} --lot LOT \
             --weighed G --weighed G --weighed G \
             --clearance MM --press MM --loose MM --pin MM --wall MM",
            set.material
        ),
        choose_profile: format!("--printer {profile}"),
    }
}

/// Returns the commands that the sheet of a printer's density coupon names.
pub fn commands_on_density_sheet(set: &DensitySet) -> DensityCommands {
    let profile = format!("shop-{}.toml", set.printer);
    let masses = set.percents().into_iter().map(|percent| match percent {
        100.0 => format!(" --infill {percent}%=G"),
        _ => format!(" --infill {percent}%=G,G"),
    });
    let masses: String = masses.collect();
    DensityCommands {
        make_profile: format!(
            "equipoise printers new --from {0} --id shop-{0} --out {profile}",
            set.printer
        ),
        calibrate: format!(
            "equipoise printers calibrate {profile} --material {} --lot LOT{masses}",
            set.material
        ),
    }
}

/// Returns the commands that the sheet of a printer's slide coupon names.
pub fn commands_on_slide_sheet(set: &SlideSet) -> SlideCommands {
    let profile = format!("shop-{}.toml", set.printer);
    SlideCommands {
        make_profile: format!(
            "equipoise printers new --from {0} --id shop-{0} --out {profile}",
            set.printer
        ),
        calibrate: format!(
            "equipoise printers calibrate {profile} --material {} --lot LOT --slide MM",
            set.material
        ),
        choose_profile: format!("--printer {profile}"),
    }
}

/// Returns the command that writes a shop's own profile from a cutter or a sheet.
pub fn command_for_new_cutter(id: &str) -> String {
    format!("equipoise cutters new --from {id} --id shop-{id} --out shop-{id}.toml")
}

/// Returns the commands that the sheet of a cutter's coupons names.
pub fn commands_on_cut_coupon_sheet(set: &CutCouponSet) -> CutCommands {
    CutCommands {
        make_profiles: [&set.cutter, &set.sheet].map(|id| command_for_new_cutter(id)),
        calibrate: format!(
            "equipoise cutters calibrate shop-{}.toml --sheet shop-{}.toml --lot LOT --row MM \
             --thickness MM --thickness MM --thickness MM --weighed G",
            set.cutter, set.sheet
        ),
    }
}

/// The command that writes several plans with their figures.
pub const OTHER_PLANS: &str = "equipoise cuts";

/// The flags of which `printers calibrate` needs one.
pub const MEASUREMENTS: &str =
    "--weighed, --infill, --clearance, --press, --loose, --slide, --pin or --wall";

/// The mark before the table of printers in README.
pub const TABLE_BEGIN: &str = "<!-- equipoise printers list --markdown -->";

/// Returns an option's name on the command line.
fn name(key: Key) -> String {
    match key {
        Key::Plan => "cut".to_owned(),
        Key::Factor => "scale".to_owned(),
        Key::Goal => "goal".to_owned(),
        Key::Speed => "speed".to_owned(),
        Key::Grade => "grade".to_owned(),
        Key::HardwareMass => "hardware-mass".to_owned(),
        Key::JointPrice => "joint-price".to_owned(),
        Key::LeastLean => "least-lean".to_owned(),
        Key::LeastAngle => "least-angle".to_owned(),
        _ => key.word().replace('_', "-"),
    }
}

#[cfg(test)]
mod tests {
    use clap::{CommandFactory, Parser};

    use super::*;
    use crate::cli::args::Cli;
    use crate::printer::Printer;

    #[test]
    fn every_setting_has_a_flag_that_its_command_knows() {
        let knows = |command: &clap::Command, key: Key| {
            let long = name(key);
            command
                .get_arguments()
                .any(|argument| argument.get_long() == Some(long.as_str()))
        };
        let cli = Cli::command();
        let find = |command: &clap::Command, name| command.find_subcommand(name).cloned().unwrap();
        let prepare = find(&cli, "prepare");
        let import = find(&find(&cli, "printers"), "import");
        let telescope = find(&cli, "telescope");
        let core = find(&cli, "core");
        let inspect = find(&cli, "inspect");
        for &key in Key::ALL {
            let command = match key {
                Key::List => &import,
                Key::Data => &inspect,
                _ => &prepare,
            };
            let others = knows(&telescope, key) || knows(&core, key);
            assert!(knows(command, key) || others, "{key}");
        }
    }

    #[test]
    fn the_commands_on_the_sheet_of_the_coupons_can_be_typed() {
        let printer = Printer::find("prusa-mk4").unwrap();
        let set = CouponSet::of(&printer, printer.material(None).unwrap());
        let sheet = commands_on_coupon_sheet(&set);
        let measured = sheet.calibrate.replace(" MM", " 1").replace(" G", " 1");
        let prepare = format!(
            "equipoise prepare a.stl --goal top {}",
            sheet.choose_profile
        );
        for line in [sheet.make_profile, measured, prepare] {
            let parsed = Cli::try_parse_from(line.split_whitespace());
            assert!(parsed.is_ok(), "{line}: {parsed:?}");
        }
    }

    #[test]
    fn the_commands_on_the_sheet_of_the_density_coupon_can_be_typed() {
        let printer = Printer::find("prusa-mk4").unwrap();
        let set = DensitySet::of(&printer, printer.material(None).unwrap()).unwrap();
        let sheet = commands_on_density_sheet(&set);
        let measured = sheet.calibrate.replace("=G", "=2").replace(",G", ",1");
        assert_eq!(measured.matches("--infill").count(), set.percents().len());
        for line in [sheet.make_profile, measured] {
            let parsed = Cli::try_parse_from(line.split_whitespace());
            assert!(parsed.is_ok(), "{line}: {parsed:?}");
        }
    }

    #[test]
    fn the_advice_to_list_printers_names_the_command_that_does() {
        let command = flag(&Setting::open(Key::List)).replace("FILES", "a.ini b.ini");
        let parsed = Cli::try_parse_from(command.split_whitespace());
        assert!(parsed.is_ok(), "{command}: {parsed:?}");
    }

    #[test]
    fn a_message_names_flags_on_the_command_line() {
        let up = Setting::new(Key::Up, "-0.1,0,1");
        let message = format!("give `{up}` or `{}`", Setting::open(Key::SpinPoint));
        assert_eq!(with_flags(&message), "give --up=-0.1,0,1 or --spin-point");
        assert_eq!(
            flags(&[up, Setting::new(Key::Size, "62mm")]),
            "--up=-0.1,0,1 --size=62mm"
        );
    }
}
