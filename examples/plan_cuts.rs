//! Plans the cuts and pins for voids of one's own: two balls of air in a block.
//!
//! `cargo run --example plan_cuts`

#![allow(clippy::print_stdout, reason = "an example prints what it found")]

use equipoise::base::verdict::Verdict;
use equipoise::cut::{GoalAxis, Hollowed, PlanRequest, parts, plan};
use equipoise::geom::{Point, Vector};
use equipoise::mesh::{Solid, primitives};
use equipoise::printer::Printer;

fn main() -> anyhow::Result<()> {
    let block = primitives::cuboid(
        &Point::new(-40.0, -20.0, 0.0),
        &Point::new(40.0, 20.0, 40.0),
    );
    let air = |x: f64| Solid::new(primitives::ball(&Point::new(x, 0.0, 20.0), 12.0, 4));
    let hollowed = Hollowed::new(Solid::new(block)?, vec![air(-20.0)?, air(20.0)?]);
    let axis = GoalAxis {
        point: Point::origin(),
        direction: Vector::z(),
    };
    let printer = Printer::find("prusa-mk4")?;
    let request = PlanRequest::for_printer(&printer, 80.0, axis);
    let plan = match plan(&hollowed, &request)? {
        Verdict::Found(plan) => plan,
        Verdict::No(obstacle) => anyhow::bail!("no plan: {obstacle}"),
    };
    for cut in &plan.cuts {
        println!(
            "{} at {:?} mm, normal {:?}",
            cut.id, cut.point_mm, cut.normal
        );
    }
    for joint in &plan.joints {
        let [below, above] = &joint.parts;
        println!("{below} on {above}: {} pins", joint.pins.len());
    }
    let Verdict::Found(parts) = parts(&hollowed, &plan, &request)? else {
        anyhow::bail!("the plan leaves a void closed");
    };
    for part in parts {
        println!(
            "{}: {} triangles",
            part.id,
            part.solid.mesh().triangles().len()
        );
    }
    Ok(())
}
