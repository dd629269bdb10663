//! Describes a printer of one's own: a profile that inherits from a shipped machine.
//!
//! `cargo run --example custom_printer`

#![allow(clippy::print_stdout, reason = "an example prints what it found")]

use equipoise::printer::Printer;

/// The shop measured its own walls and weighed its own resin; the rest is the machine's.
const PROFILE: &str = r#"
id = "room-2"
name = "The PolyJet machine in room 2"
inherits = "objet-connex350"
default_material = "lot-7"

[numbers]
min_wall_mm = { value = 1.2, source = "thinner walls broke in the water jet", sure = "own-choice" }

[[material]]
id = "lot-7"
name = "White resin, lot 7"
density_g_cm3 = { value = 1.182, source = "a weighed coupon of 8 cm³", sure = "computed" }
density_spread_ratio = { value = 0.01, source = "five coupons", sure = "computed" }
"#;

fn main() -> anyhow::Result<()> {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("room-2.toml");
    std::fs::write(&file, PROFILE)?;
    let printer = Printer::read(&file)?;
    let wall = printer.quantise_wall(None, 100.0)?;
    println!(
        "{}: a wall of {} mm, {}",
        printer.name, wall.wall_mm, wall.why
    );
    for (quantity, number) in printer.numbers() {
        println!("{:<24} {}", quantity.key(), number.provenance());
    }
    let material = printer.material(None)?;
    println!("{}: {} g/cm³", material.name, material.density_g_cm3.value);
    Ok(())
}
