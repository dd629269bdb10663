//! Growing planes beside the paper's moving vertices.

use anyhow::Result;
use equipoise::base::verdict::Verdict;
use equipoise::base::watch::Watch;
use equipoise::polyhedra::Ground;
use equipoise::polyhedra::vertices::{StartSolid, VertexRequest, grow_by_vertices, prove_vertices};

use super::processor::timed;
use super::{DISTANCE_MM, Row, grown, without_limits};

/// Samples inside each edge while vertices move.
const SAMPLES_PER_EDGE: usize = 8;

/// Prints one row a model and method.
pub fn print(grounds: &[(&Row, Ground)]) -> Result<()> {
    println!("\n## Planes and vertices, without limits\n");
    println!(
        "| model | method | V/V(M) by samples | faces prove, mm | moved inward, mm | V/V(M) proved | s |"
    );
    println!("|---|---|---|---|---|---|---|");
    for (row, ground) in grounds {
        for &start in StartSolid::ALL {
            let cells = of_vertices(ground, start)?;
            println!("| {} | vertices:{start} | {cells} |", row.file);
        }
        let (polyhedron, seconds) = grown(ground, &without_limits())?;
        let share = polyhedron.volume_mm3() / ground.volume_mm3();
        let proved_mm = ground.obstacles().least_parted_mm(&polyhedron.planes());
        println!(
            "| {} | planes | | {proved_mm:.1} | 0 | {share:.3} | {seconds:.1} |",
            row.file
        );
    }
    Ok(())
}

/// Returns the cells of a row of moved vertices.
fn of_vertices(ground: &Ground, start: StartSolid) -> Result<String> {
    let request = VertexRequest {
        distance_mm: DISTANCE_MM,
        start,
        samples_per_edge: SAMPLES_PER_EDGE,
        room_mm: None,
    };
    let (grown, seconds) = timed(|| Ok(grow_by_vertices(ground, &request, &Watch::silent())?))?;
    let Verdict::Found(grown) = grown else {
        return Ok(format!("no room | | | | {seconds:.1}"));
    };
    let share = |mm3: f64| mm3 / ground.volume_mm3();
    let proved = prove_vertices(ground, &grown, &without_limits());
    let proved = proved.map_or_else(
        |_| "all | nothing".to_owned(),
        |proved| {
            let volume_mm3 = proved.polyhedron.volume_mm3();
            format!("{:.1} | {:.3}", proved.moved_mm, share(volume_mm3))
        },
    );
    Ok(format!(
        "{:.3} | {:.1} | {proved} | {seconds:.1}",
        share(grown.volume_mm3),
        grown.certified_mm
    ))
}
