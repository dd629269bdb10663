//! Makes the models of the documentation and the tests as binary STL files in mm:
//!
//! ```text
//! cargo run --example make_models -- OUTDIR
//! ```

#![allow(
    clippy::print_stdout,
    reason = "an example talks to the person who runs it"
)]

mod models;

use std::path::Path;

use anyhow::{Context, Result};
use equipoise::io::stl;

fn main() -> Result<()> {
    let folder = std::env::args_os()
        .nth(1)
        .context("give the folder to write the models to")?;
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder)
        .with_context(|| format!("cannot make the folder {}", folder.display()))?;
    for (name, make) in models::MODELS {
        let solid = models::solid(make).context(name)?;
        let path = folder.join(name).with_extension("stl");
        stl::write(&path, solid.mesh(), name)?;
        println!(
            "{}: {} triangles",
            path.display(),
            solid.mesh().triangles().len()
        );
    }
    Ok(())
}
