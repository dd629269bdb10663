//! The command line: arguments in, text and exit codes out. Nothing else in the library prints.

pub mod args;
pub mod bars;
pub mod bound;
mod broken;
pub mod cells;
mod cells_error;
mod cells_order;
mod cells_picture;
mod cells_printed;
pub mod core_kit;
pub mod coupon;
mod cuts;
pub mod cutters;
pub mod dithered;
mod exit;
mod field_facts;
mod flags;
mod if_solid;
pub mod inspect;
pub mod inspect_volume;
pub mod manual;
mod mass_facts;
mod memory;
mod new_files;
pub mod prepare;
mod print_time;
pub mod printers;
pub mod printers_markdown;
pub mod profiles;
pub mod questions;
mod quoted;
mod replay;
pub mod scale;
pub mod shop;
pub mod show;
pub mod signals;
pub mod skeleton;
mod skeleton_picture;
pub mod slice;
mod summary;
pub mod telescope;
pub mod tets_file;
mod toolpaths;
mod usual;
mod values;
pub mod verify;
pub mod voice;
mod volume_facts;
pub mod wing;
mod wrap;

use std::error::Error;

pub use exit::Exit;

use core_kit::CoreWing;
use telescope::TelescopeWing;
use wing::Ends;

use args::{Cli, Command, DEFAULT_PLANS, PrepareArgs};
use prepare::PrepareError;
use signals::{Limits, Stop};
use voice::{Manner, Voice};

/// Runs the command on the number of threads it orders, and prints its result on the standard
/// output.
pub fn run(cli: Cli, manner: Manner) -> Result<Exit, Box<dyn Error + Send + Sync>> {
    let threads = cli.global.threads.map_or(0, usize::from);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()?;
    pool.install(|| dispatch(cli, manner))
}

fn dispatch(cli: Cli, manner: Manner) -> Result<Exit, Box<dyn Error + Send + Sync>> {
    let voice = Voice {
        manner,
        json: cli.global.json,
    };
    let out = &mut std::io::stdout();
    let limits = Limits {
        time: cli.global.timeout,
        memory_bytes: cli.global.max_memory,
    };
    let stop = || Stop::within(limits);
    match cli.command {
        Command::Prepare(args) => match args.plans {
            Some(count) => show_plans(*args, count, voice, &stop()),
            None => Ok(prepare::prepare(*args, voice, &stop(), out)?),
        },
        Command::Cuts(mut args) => {
            let count = *args.plans.get_or_insert(DEFAULT_PLANS);
            show_plans(*args, count, voice, &stop())
        }
        Command::Telescope(args) => {
            let stop = &stop();
            let ends = Ends { voice, stop, out };
            Ok(wing::run::<TelescopeWing>(args.order(), ends)?)
        }
        Command::Core(args) => {
            let stop = &stop();
            let ends = Ends { voice, stop, out };
            Ok(wing::run::<CoreWing>(args.order(), ends)?)
        }
        Command::Inspect(args) => {
            stop().end_process();
            Ok(inspect::inspect(&args, voice, out)?)
        }
        Command::Printers(args) => {
            printers::run(args.action, voice.json, out)?;
            Ok(Exit::Kept)
        }
        Command::Cutters(args) => {
            cutters::run(args.action, voice.json, out)?;
            Ok(Exit::Kept)
        }
        Command::Coupon(args) => Ok(coupon::coupon(&args, voice, &stop(), out)?),
        Command::Skeleton(args) => Ok(skeleton::skeleton(&args, voice, &stop(), out)?),
        Command::Cells(args) => Ok(cells::divide(&args, voice, &stop(), out)?),
        Command::Slice(args) => Ok(slice::slice(&args, voice, &stop(), out)?),
        Command::ScaleExtrusion(args) => Ok(scale::scale_extrusion(&args, voice, &stop(), out)?),
        Command::Verify(args) => {
            stop().end_process();
            Ok(verify::verify(&args, voice, out)?)
        }
        Command::Completions(args) => {
            manual::completions(args.shell, out)?;
            Ok(Exit::Kept)
        }
        Command::Man(args) => {
            manual::page(args.command.as_deref(), out)?;
            Ok(Exit::Kept)
        }
    }
}

/// Writes so many plans of cuts side by side.
fn show_plans(
    args: PrepareArgs,
    count: u8,
    voice: Voice,
    stop: &Stop,
) -> Result<Exit, Box<dyn Error + Send + Sync>> {
    let request = args.request().map_err(PrepareError::from)?;
    let count = usize::from(count);
    Ok(cuts::cuts(&request, count, voice, stop)?)
}
