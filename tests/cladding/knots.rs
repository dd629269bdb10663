//! Parts that hook into each other: no order takes them apart, but a cut that is named does.

use equipoise::cladding::{CladdingError, FreeingCut, Part, Scene};
use equipoise::geom::{Point, Vector};
use equipoise::mesh::{TriMesh, bodies, primitives};
use equipoise::polyhedra::Ground;

use super::scenes::{MOST_ON_THE_WAY_MM3, base, block, csg, cube, ground, on_the_way_mm3, united};
use super::{GAP_MM, divided};

/// The half sides of the base, mm.
const BASE_MM: [f64; 3] = [70.0, 65.0, 60.0];

/// A block with an arm from its side over its top, and a hook from its top over that arm.
fn knotted() -> Ground {
    ground(united(&[
        block([-100.0, -101.0, -102.0], [100.0, 101.0, 102.0]),
        block([90.0, -12.0, -12.0], [180.0, 12.0, 12.0]),
        block([165.0, -11.0, 0.0], [179.0, 11.0, 214.0]),
        block([-20.0, -10.0, 200.0], [178.0, 10.0, 215.0]),
        block([-12.0, 40.0, 95.0], [12.0, 60.0, 245.0]),
        block([-11.0, -13.0, 228.0], [11.0, 59.0, 244.0]),
    ]))
}

/// Returns true if bodies leave one after the other, each along one of its ways.
fn come_apart(mut staying: Vec<(&TriMesh, Vec<Vector>)>) -> bool {
    while !staying.is_empty() {
        let free = (0..staying.len()).find(|&at| {
            let others = staying.iter().enumerate().filter(|(other, _)| *other != at);
            let others: Vec<&TriMesh> = others.map(|(_, (body, _))| *body).collect();
            let (body, ways) = &staying[at];
            let mut ways = ways.iter();
            ways.any(|way| on_the_way_mm3(&[*body], &others, *way) <= MOST_ON_THE_WAY_MM3)
        });
        match free {
            Some(at) => staying.remove(at),
            None => return false,
        };
    }
    true
}

/// Cuts a part as it is told; returns the piece that leaves first, then what stays.
fn cut(part: &Part, by: &FreeingCut) -> [TriMesh; 2] {
    let (above, below) = csg(&part.body).split_by_plane(&by.plane).unwrap();
    let [above, below] = [above, below].map(|half| bodies(&half.to_mesh().unwrap()));
    let far = |body: &TriMesh| (body.aabb().center() - by.piece).norm();
    let (pieces, others): (Vec<TriMesh>, Vec<TriMesh>) =
        above.into_iter().partition(|body| far(body) < 1e-6);
    assert_eq!(pieces.len(), 1);
    let rest = [others, below].concat();
    let rest = rest.into_iter().reduce(|a, b| a.joined(&b)).unwrap();
    [pieces.into_iter().next().unwrap(), rest]
}

#[test]
fn an_arm_under_a_hook_is_a_knot_whose_parts_are_named_with_a_cut_that_frees_them() {
    let ground = knotted();
    let base = base(&ground, 10.0, &cube(BASE_MM));
    let scene = Scene::new(&ground, &base, GAP_MM).unwrap();
    let parts = divided(&scene, 0.0);
    let ways = |part: &Part| vec![scene.normal(part.face)];
    assert_eq!(parts.len(), 7);
    assert!(!come_apart(
        parts.iter().map(|part| (&part.body, ways(part))).collect()
    ));
    let why = scene.assembly(&parts, &Vector::z()).unwrap_err();
    let CladdingError::Cycle {
        faces,
        parts: named,
        cut: Some(by),
    } = &why
    else {
        panic!("{why:?}")
    };
    // The arm waits for the top, the top for the arm, and the side for the arm that hangs on it.
    assert_eq!(faces, &[0, 4, 4]);
    let top = |part: &Part| part.face == 4;
    let hooked: Vec<&Part> = parts.iter().filter(|part| top(part)).collect();
    assert_eq!(named.len(), 2);
    for part in &hooked {
        let middle = part.body.aabb().center();
        assert!(
            named
                .iter()
                .any(|one| one.face == 4 && one.middle == middle)
        );
    }
    assert!(
        why.to_string().contains("the part over face 5 about ("),
        "{why}"
    );
    // It goes through the arm or through the hook, which are 20 by 15 and 22 by 16 mm.
    let area = by.area_mm2;
    assert!(area > 1.0 && area < 353.0, "{area}");
    let at = hooked
        .iter()
        .position(|part| part.body.aabb().center() == by.part.middle);
    let [piece, rest] = cut(hooked[at.unwrap()], by);
    assert!((piece.signed_volume_mm3() - by.volume_mm3).abs() < 1e-6 * by.volume_mm3);
    assert!((by.way.norm() - 1.0).abs() < 1e-9);
    let all: Vec<&TriMesh> = parts.iter().map(|part| &part.body).collect();
    let others = all
        .iter()
        .filter(|body| **body != &hooked[at.unwrap()].body);
    let others: Vec<&TriMesh> = others.copied().chain([&rest]).collect();
    let met_mm3 = on_the_way_mm3(&[&piece], &others, by.way);
    assert!(met_mm3 <= MOST_ON_THE_WAY_MM3, "{met_mm3}");
    let left = parts
        .iter()
        .filter(|part| part.body != hooked[at.unwrap()].body);
    let left = left.map(|part| (&part.body, ways(part)));
    assert!(come_apart(
        left.chain([(&rest, ways(hooked[at.unwrap()]))]).collect()
    ));
}

#[test]
fn two_links_that_no_single_cut_frees_are_named_without_one() {
    // A second arm and hook on the other side: each knot needs a cut of its own.
    let one = knotted();
    let mesh = one.solid().mesh();
    let other = mesh
        .map_vertices(|p| Point::new(-p.x, -p.y, -p.z))
        .reversed();
    let whole = ground(united(&[mesh.clone(), other]));
    let base = base(&whole, 10.0, &cube(BASE_MM));
    let scene = Scene::new(&whole, &base, GAP_MM).unwrap();
    let why = scene
        .assembly(&divided(&scene, 0.0), &Vector::z())
        .unwrap_err();
    let CladdingError::Cycle { faces, parts, cut } = &why else {
        panic!("{why:?}")
    };
    assert_eq!((faces.len(), parts.len()), (6, 2));
    assert_eq!(*cut, None);
}

#[test]
fn a_block_without_an_arm_is_no_knot() {
    let ground = ground(primitives::cuboid(
        &Point::from([-100.0; 3]),
        &Point::from([100.0; 3]),
    ));
    let base = base(&ground, 10.0, &cube(BASE_MM));
    let scene = Scene::new(&ground, &base, GAP_MM).unwrap();
    assert!(scene.assembly(&divided(&scene, 0.0), &Vector::z()).is_ok());
}
