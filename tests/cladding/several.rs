//! Two polyhedra on both sides of a waist: no unit there leaves past the other side, and yet all
//! comes together.

use equipoise::base::watch::Watch;
use equipoise::cladding::{
    Bolt, BoltKit, BoundKind, CladShell, CladdingError, ShellRequest, ShellStyle, Sides, bolts,
};
use equipoise::cutter::Fastener;
use equipoise::geom::{Point, Vector};
use equipoise::mesh::{TriMesh, primitives};
use equipoise::panels::PanelSet;
use equipoise::polyhedra::{BasePlan, ConnectorRequest, Ground, Limits, Request};

use super::scenes::{
    MOST_ON_THE_WAY_MM3, SHEET_MM, ground, on_the_way_mm3, overlap_mm3, panel_request, panels,
    unit_bodies, united,
};
use super::{GAP_MM, WALL_MM};

/// The distance of the balls' middles from the plane between them, mm.
const AWAY_MM: f64 = 120.0;
/// The gap between the panels that bear on each other, mm.
const BEARING_MM: f64 = 0.1;

/// Returns two balls that overlap.
fn waisted() -> Ground {
    let ball = |x: f64| primitives::ball(&Point::new(x, 0.0, 0.0), 150.0, 4);
    ground(united(&[ball(-AWAY_MM), ball(AWAY_MM)]))
}

/// Returns a base with a polyhedron in each ball. Beside the plane its faces lean over it.
fn plan(ground: &Ground) -> BasePlan {
    let polyhedron = |side: f64| {
        let face = |normal: Vector, offset_mm: f64, locked: bool| {
            let normal = normal.normalize();
            let middle = Vector::x() * (side * AWAY_MM);
            let offset_mm = offset_mm + normal.dot(&middle);
            let [x, y, z] = <[f64; 3]>::from(normal);
            format!(
                "[[polyhedron.face]]\nnormal = [{x:?}, {y:?}, {z:?}]\noffset_mm = {offset_mm:?}\n\
                 locked = {locked}\n"
            )
        };
        let across = [Vector::y(), -Vector::y(), Vector::z(), -Vector::z()];
        let sides = [-0.5, 0.5].map(|x| {
            let leaning = across.map(|way| face(way + Vector::x() * x, 80.0, false));
            leaning.concat()
        });
        let ends = [
            face(-Vector::x() * side, AWAY_MM - 0.5 * BEARING_MM, true),
            face(Vector::x() * side, 110.0, false),
        ];
        format!("[[polyhedron]]\n{}{}", sides.concat(), ends.concat())
    };
    let split = "[[split]]\nnormal = [1.0, 0.0, 0.0]\noffset_mm = 0.0\nbelow = \"Q1\"\n\
                 above = \"Q2\"\n";
    let text = format!("{split}{}{}", polyhedron(-1.0), polyhedron(1.0));
    let connector = ConnectorRequest {
        radius_mm: 20.0,
        gap_mm: BEARING_MM,
        rods: None,
    };
    let request = Request::new(10.0, Limits::NONE);
    BasePlan::from_toml(["base.toml", &text], ground, &request, &connector).unwrap()
}

fn clad(ground: &Ground, plan: &BasePlan) -> CladShell {
    let kit = super::kit();
    let request = ShellRequest {
        wall_mm: WALL_MM,
        style: ShellStyle::Solid,
        crumb_mm3: 100.0,
        room_mm: None,
        kit: Some(&kit),
        pins: None,
        up: Vector::z(),
    };
    let sets: Vec<PanelSet> = plan.polyhedra.iter().map(panels).collect();
    let sides = Sides::new(ground, plan, GAP_MM).unwrap();
    sides.clad(&sets, &request, &Watch::silent()).unwrap()
}

#[test]
fn polyhedra_at_a_waist_come_together_though_their_units_bar_each_other() {
    let ground = waisted();
    let plan = plan(&ground);
    assert_eq!(plan.connections.len(), 1);
    assert_eq!(plan.connections[0].polyhedra, [0, 1]);
    let shell = clad(&ground, &plan);
    let assembly = &shell.assembly;
    let bodies = unit_bodies(&shell);
    let refs = |units: &[usize]| -> Vec<&TriMesh> {
        units.iter().flat_map(|&unit| &bodies[unit]).collect()
    };
    let before = &assembly.order[..assembly.order.len() - assembly.last];
    let group = |polyhedron: usize| -> Vec<usize> {
        let own = before.iter().copied();
        own.filter(|&unit| assembly.units[unit].polyhedron == polyhedron)
            .collect()
    };
    // Every part stays on its side of the plane.
    for part in &shell.parts {
        let split = part
            .region
            .bounds()
            .iter()
            .find(|bound| bound.kind == BoundKind::Split);
        let plane = split.unwrap().plane;
        assert!(
            part.body
                .vertices()
                .iter()
                .all(|p| plane.distance(p) < 1e-9)
        );
    }
    // Units that lean over the plane run into the other side; they are not the last ones.
    let leans = |unit: usize| {
        let of = &assembly.units[unit];
        let toward = if of.polyhedron == 0 { 1.0 } else { -1.0 };
        of.way.x * toward > 0.1 && !of.parts.is_empty()
    };
    let others = [refs(&group(1)), refs(&group(0))];
    for (unit, of) in assembly.units.iter().enumerate() {
        let overlap_mm3 = on_the_way_mm3(&refs(&[unit]), &others[of.polyhedron], of.way);
        let is_last = !before.contains(&unit);
        if leans(unit) {
            assert!(
                overlap_mm3 > 100.0 && !is_last,
                "unit {unit}: {overlap_mm3}"
            );
        }
        assert!(
            !is_last || overlap_mm3 <= MOST_ON_THE_WAY_MM3,
            "{overlap_mm3}"
        );
    }
    // Each comes apart for itself, and both from each other.
    for polyhedron in 0..2 {
        let own = group(polyhedron);
        for (at, &unit) in own.iter().enumerate() {
            let way = assembly.units[unit].way;
            let overlap_mm3 = on_the_way_mm3(&refs(&[unit]), &refs(&own[..at]), way);
            assert!(
                overlap_mm3 <= MOST_ON_THE_WAY_MM3,
                "unit {unit}: {overlap_mm3}"
            );
        }
    }
    let [join] = assembly.joins.as_slice() else {
        unreachable!("one plane joins two")
    };
    let both = [&join.moving, &join.standing].map(|side| refs(&group(side[0])));
    assert!(on_the_way_mm3(&both[0], &both[1], join.way) <= MOST_ON_THE_WAY_MM3);
    assert!(assembly.last >= 2);
}

#[test]
fn bolts_pass_both_panels_clear_of_their_joints_and_far_apart() {
    let ground = waisted();
    let plan = plan(&ground);
    let sets = plan.polyhedra.iter().enumerate();
    let sets = sets.map(|(at, body)| (panels(body), plan.faces_before(at)));
    let set = PanelSet::joined(sets);
    let stock = Fastener::all().unwrap();
    let kit = BoltKit::choose(&stock, 4.0, 2.0 * SHEET_MM + BEARING_MM).unwrap();
    // Two sheets, the gap, two washers of 0.8 mm and a nut of 3.2 mm.
    assert!((kit.grip_mm() - 14.9).abs() < 1e-9);
    assert_eq!(kit.screw.id, "screw-m4x16");
    assert!(BoltKit::choose(&stock, 4.0, 40.0).is_none());
    let found: Vec<Bolt> = bolts(&plan, &set, &panel_request(), &kit).unwrap();
    assert!(found.len() >= 2, "{found:?}");
    for bolt in &found {
        let [a, b] = [0, 1].map(|side| {
            let panel = &set.panels[bolt.panels[side]];
            let [x, y] = bolt.at_mm[side];
            panel.frame.to_model(&Point::new(x, y, 0.0))
        });
        assert!(((a - b).norm() - BEARING_MM).abs() < 1e-9, "{a} {b}");
        // Washer and nut as one block inside: no panel is there.
        for side in 0..2 {
            let panel = &set.panels[bolt.panels[side]];
            let [x, y] = bolt.at_mm[side];
            let place = |p: &Point| {
                let local = Point::new(x + p.x, y + p.y, -SHEET_MM - 1e-3 - p.z);
                panel.frame.to_model(&local)
            };
            let head = primitives::cylinder(4.5, 8.0, 24).map_vertices(place);
            let head = head.reversed();
            for other in &set.panels {
                assert!(overlap_mm3(&head, &other.body()) < 1e-6);
            }
        }
    }
    let apart = |a: &Bolt, b: &Bolt| {
        let [p, q] = [a.at_mm[0], b.at_mm[0]];
        (p[0] - q[0]).hypot(p[1] - q[1])
    };
    for (at, bolt) in found.iter().enumerate() {
        assert!(found[..at].iter().all(|other| apart(bolt, other) >= 18.0));
    }
    // Panels too small for two bolts are told.
    let thick = BoltKit::choose(&stock, 5.0, 18.0).unwrap();
    let wide = Fastener {
        shape: equipoise::cutter::FastenerShape::Washer {
            thread_mm: 5.0,
            diameter_mm: 60.0,
            bore_mm: 5.3,
            thickness_mm: 1.0,
        },
        ..thick.washer.clone()
    };
    let stock = [thick.screw.clone(), thick.nut.clone(), wide];
    let huge = BoltKit::choose(&stock, 5.0, 1.0).unwrap();
    let why = bolts(&plan, &set, &panel_request(), &huge).unwrap_err();
    assert!(matches!(why, CladdingError::NoBolts { .. }), "{why}");
}
