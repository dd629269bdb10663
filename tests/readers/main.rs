//! Every reader of a stranger's file answers whatever it is given: it reads it or refuses it, in
//! bounded time and without a panic.
//!
//! `EQUIPOISE_MUTATIONS=10000 cargo test --release --test command readers` damages each file that
//! often.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stdout, reason = "the counts are shown with --nocapture")]

mod damage;
mod scenes;
mod seeds;
mod volumes;

use std::fs;
use std::io::Cursor;
use std::path::Path;
use std::time::{Duration, Instant};

use damage::damaged;
use equipoise::base::dialect::Dialect;
use equipoise::base::watch::Watch;
use equipoise::cutter::{AnyProfile, Fastener};
use equipoise::field::read_text;
use equipoise::geom::Point;
use equipoise::io::gcode::{Options, read_plates};
use equipoise::io::glb::decode_glb;
use equipoise::io::layers::read_layers;
use equipoise::io::threemf::{decode_orders, decode_plate};
use equipoise::io::{
    DataChoice, DrawnLine, DrawnShape, Volume, decode_axes, decode_curve, decode_cut_svg,
    decode_dxf, decode_model, decode_points, decode_sites, decode_tetgen, decode_volume,
};
use equipoise::job::core_kit::CoreJob;
use equipoise::job::telescope::TelescopeJob;
use equipoise::job::{Job, read_plan};
use equipoise::mesh::{Solid, primitives::cuboid};
use equipoise::polyhedra::{BasePlan, ConnectorRequest, Ground, Limits, Request};
use equipoise::printer::Printer;
use equipoise::skeleton::Skeleton;
use equipoise::telescope::PoseFile;

/// Damaged files for each reader, if nothing else is asked for.
const USUAL: u64 = 300;
/// The most time for one small file, in a test that waits for its end.
const PATIENCE: Duration = Duration::from_secs(10);

/// Returns how often each file is damaged.
fn rounds() -> u64 {
    let asked = std::env::var("EQUIPOISE_MUTATIONS").ok();
    asked.map_or(USUAL, |count| count.parse().unwrap())
}

/// Damages each seed, and lets a reader answer. Returns how many it read.
fn fuzz(name: &str, seeds: &[Vec<u8>], reads: impl Fn(&[u8]) -> bool) -> u64 {
    let mut read = 0;
    for (kind, seed) in (0_u64..).zip(seeds) {
        assert!(reads(seed), "{name}: seed {kind} is sound");
        for round in 0..rounds() {
            let bytes = damaged(seed, kind << 32 | round);
            let start = Instant::now();
            read += u64::from(reads(&bytes));
            assert!(start.elapsed() < PATIENCE, "{name}: {kind}, {round} hangs");
        }
    }
    let all = rounds() * seeds.len() as u64;
    println!("{name}: {read} of {all} damaged files were read, the others refused");
    read
}

/// Damages the seeds as files of this name, for a reader of paths.
fn fuzz_files(name: &str, file: &str, seeds: &[Vec<u8>], reads: impl Fn(&Path) -> bool) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(file);
    fuzz(name, seeds, |bytes| {
        fs::write(&path, bytes).unwrap();
        reads(&path)
    });
}

/// Returns whether a model is read; what is read is finite.
fn reads_model(bytes: &[u8]) -> bool {
    let Ok(mesh) = decode_model(bytes) else {
        return false;
    };
    let is_finite = |x: &f64| x.is_finite();
    assert!(mesh.vertices().iter().all(|p| p.iter().all(is_finite)));
    let count = mesh.vertices().len() as u32;
    assert!(mesh.triangles().iter().flatten().all(|&at| at < count));
    true
}

#[test]
fn models_as_stl_obj_ply_and_3mf() {
    fuzz("stl, binary", &[seeds::binary_stl()], reads_model);
    fuzz("stl, text", &[seeds::text_stl()], reads_model);
    fuzz("obj", &[seeds::obj()], reads_model);
    fuzz(
        "ply",
        &[seeds::text_ply(), seeds::binary_ply()],
        reads_model,
    );
    fuzz("3mf, model", &[seeds::model_part()], |part| {
        reads_model(&seeds::package_of(part))
    });
    fuzz(
        "3mf",
        &[seeds::package(), seeds::package_of_components()],
        reads_model,
    );
}

#[test]
fn moving_scenes_as_glb() {
    let reads = |bytes: &[u8]| {
        decode_glb(bytes).is_ok_and(|scene| {
            let still = scene.nodes.iter().map(|node| node.place);
            let moved = scene.animations.iter();
            let moved = moved.flat_map(|own| scene.places(own, 0.5));
            for place in still.chain(moved) {
                assert!(place.axes.iter().all(|x| x.is_finite()));
                assert!((place.axes.determinant() - 1.0).abs() < 1e-6);
            }
            true
        })
    };
    fuzz("glb", &[scenes::glb()], reads);
}

/// Returns true for a volume mesh whose moments are finite, and whose densities are some.
fn is_sound_volume(volume: &Volume) -> bool {
    let tets = &volume.tets;
    assert!(tets.moments().0.iter().all(|moment| moment.is_finite()));
    let densities = (0..tets.cells().len()).flat_map(|cell| tets.densities_of(cell));
    for density in densities {
        assert!((-1e-5..1.00001).contains(&density), "{density}");
    }
    assert!(tets.solid_moments().volume() > 0.0);
    true
}

#[test]
fn volume_meshes_as_msh_vtk_and_tetgen() {
    let reads = |bytes: &[u8]| {
        decode_volume(bytes, &DataChoice::Auto).is_ok_and(|volume| is_sound_volume(&volume))
    };
    fuzz("msh, text", &volumes::text_msh(), reads);
    fuzz("msh, binary", &volumes::binary_msh(), reads);
    fuzz("vtk, text", &volumes::text_vtk(), reads);
    fuzz("vtk, binary", &volumes::binary_vtk(), reads);
    let [node, ele] = volumes::tetgen();
    let reads_pair = |files: [&[u8]; 2]| {
        decode_tetgen(files, &DataChoice::Auto).is_ok_and(|volume| is_sound_volume(&volume))
    };
    fuzz("node", &[node.to_vec()], |bytes| reads_pair([bytes, ele]));
    fuzz("ele", &[ele.to_vec()], |bytes| reads_pair([node, bytes]));
}

#[test]
fn orders_of_plates_in_the_words_of_every_slicer() {
    for dialect in [Dialect::Prusa, Dialect::Orca, Dialect::Cura] {
        let plate = seeds::plate(dialect);
        for (name, part) in seeds::text_parts(&plate) {
            fuzz(&format!("plate, {dialect}, {name}"), &[part], |part| {
                let plate = seeds::repacked(&plate, &name, part);
                let orders = decode_orders(&plate);
                let Ok(objects) = decode_plate(&plate) else {
                    return false;
                };
                let percents = objects.iter().flat_map(|it| &it.regions);
                assert!(percents.into_iter().all(|it| it.percent.is_finite()));
                orders.is_ok()
            });
        }
    }
}

#[test]
fn curves_as_points_lines_and_edges() {
    let is_finite = |points: &[Point]| {
        assert!(points.iter().all(|p| p.iter().all(|x| x.is_finite())));
        true
    };
    let hook = fs::read("examples/models/hook.csv").unwrap();
    fuzz("csv", &[hook], |bytes| {
        decode_points(bytes).is_ok_and(|points| is_finite(&points))
    });
    let lines = [seeds::obj_lines(), seeds::ply_edges()];
    fuzz("lines", &lines, |bytes| {
        decode_curve(bytes).is_ok_and(|points| is_finite(&points))
    });
}

#[test]
fn sites_and_axes_of_cells() {
    let table = b"x_mm,y_mm,z_mm\n1,2,3\n-4.5,0.25,6e1\n7 ,8, 9\n".to_vec();
    fuzz("sites", &[table, seeds::obj()], |bytes| {
        decode_sites(bytes).is_ok_and(|sites| {
            let mut lines = sites.windows(2);
            assert!(lines.all(|pair| pair[0].line < pair[1].line));
            let mut all = sites.iter().flat_map(|site| site.value.iter());
            assert!(all.all(|x| x.is_finite()));
            true
        })
    });
    let axes = b"0,0,1,1,0,0,0,1,0\n5,5,5,0.6,0.8,0,0,0,1\n".to_vec();
    fuzz("axes", &[axes], |bytes| {
        decode_axes(bytes).is_ok_and(|axes| {
            let mut all = axes.iter().flat_map(|row| row.value);
            assert!(all.all(f64::is_finite));
            true
        })
    });
}

#[test]
fn toolpaths_and_layer_images() {
    let options = Options::default();
    let reads_gcode = |bytes: &[u8]| {
        read_plates(Cursor::new(bytes), &options, &Watch::silent()).is_ok_and(|plates| {
            let moments = plates
                .iter()
                .flat_map(|plate| plate.toolpath.part_moments().0);
            assert!(moments.into_iter().all(f64::is_finite));
            true
        })
    };
    fuzz("g-code", &[seeds::gcode()], reads_gcode);
    fuzz("bgcode", &[seeds::binary_gcode()], reads_gcode);
    let reads_images = |path: &Path| {
        read_layers(path, &Watch::silent()).is_ok_and(|plates| {
            let moments = plates.iter().flat_map(|plate| plate.whole.moments.0);
            assert!(moments.into_iter().all(f64::is_finite));
            true
        })
    };
    fuzz_files("sl1", "plate.sl1", &[seeds::sl1()], reads_images);
    // Sums of an archive stop most damage: so its parts are damaged, and packed soundly.
    let folder = tempfile::tempdir().unwrap();
    let packed = folder.path().join("packed.sl1");
    let reads_packed = |bytes: Vec<u8>| {
        fs::write(&packed, bytes).unwrap();
        reads_images(&packed)
    };
    fuzz("sl1, image", &[seeds::image()], |image| {
        reads_packed(seeds::sl1_of(seeds::SL1_SETTINGS.as_bytes(), image))
    });
    fuzz("sl1, settings", &[seeds::SL1_SETTINGS.into()], |settings| {
        reads_packed(seeds::sl1_of(settings, &seeds::image()))
    });
    let folder = tempfile::tempdir().unwrap();
    seeds::write_stack(folder.path());
    let list = folder.path().join("layers.json");
    let seed = fs::read(&list).unwrap();
    fuzz("layers.json", &[seed], |bytes| {
        fs::write(&list, bytes).unwrap();
        reads_images(&list)
    });
}

#[test]
fn profiles_of_printers_cutters_sheets_and_fasteners() {
    let folder_of = |folder: &str| {
        let entries = fs::read_dir(Path::new("profiles").join(folder)).unwrap();
        let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
        paths.sort();
        paths.retain(|path| path.extension().is_some_and(|end| end == "toml"));
        paths
    };
    let texts = |folder: &str, count: usize| -> Vec<Vec<u8>> {
        let paths = folder_of(folder).into_iter().take(count);
        paths.map(|path| fs::read(path).unwrap()).collect()
    };
    fuzz_files("printer", "own.toml", &texts("printers", 3), |path| {
        Printer::read(path).is_ok()
    });
    for folder in ["cutters", "sheets"] {
        fuzz_files(folder, "own.toml", &texts(folder, 2), |path| {
            AnyProfile::read(path).is_ok()
        });
    }
    let kinds = texts("fasteners", 5);
    assert_eq!(kinds.len(), 5);
    fuzz_files("fasteners", "own.toml", &kinds, |path| {
        Fastener::read(path).is_ok_and(|all| {
            for one in &all {
                assert!(one.mass_g > 0.0 && one.shape.volume_mm3() > 0.0, "{one:?}");
                let mut sizes_mm = one.shape.sizes_mm().into_iter();
                assert!(
                    sizes_mm.all(|(_, mm)| mm > 0.0 && mm.is_finite()),
                    "{one:?}"
                );
            }
            true
        })
    });
}

#[test]
fn drawings_of_sheets() {
    let is_finite = |lines: &[DrawnLine]| {
        let points = |shape: &DrawnShape| match shape {
            DrawnShape::Closed(points) | DrawnShape::Open(points) => points.clone(),
            DrawnShape::Circle {
                center_mm,
                radius_mm,
            } => vec![*center_mm, [*radius_mm, 0.0]],
        };
        let mut all = lines.iter().flat_map(|line| points(&line.shape));
        assert!(all.all(|point| point.iter().all(|x| x.is_finite())));
        true
    };
    let [dxf, svg] = seeds::drawings();
    fuzz("dxf", &[dxf], |bytes| {
        decode_dxf(bytes).is_ok_and(|lines| is_finite(&lines))
    });
    fuzz("svg", &[svg], |bytes| {
        decode_cut_svg(bytes).is_ok_and(|(lines, size_mm)| {
            assert!(size_mm.iter().all(|x| x.is_finite()));
            is_finite(&lines)
        })
    });
}

#[test]
fn orders_of_cuts_jobs_skeletons_and_poses() {
    fuzz_files("cuts", "cuts.toml", &[seeds::cuts()], |path| {
        read_plan(path).is_ok()
    });
    fuzz_files("job", "job.toml", &[seeds::job()], |path| {
        Job::read(path).is_ok()
    });
    fuzz_files(
        "telescope job",
        "job.toml",
        &[seeds::telescope_job()],
        |path| TelescopeJob::read(path).is_ok(),
    );
    fuzz_files("core job", "job.toml", &[seeds::core_job()], |path| {
        CoreJob::read(path).is_ok()
    });
    let reads = |bytes: &[u8]| {
        std::str::from_utf8(bytes).is_ok_and(|text| Skeleton::from_toml("s.toml", text).is_ok())
    };
    fuzz("skeleton", &[seeds::skeleton()], reads);
    fuzz("pose", &[seeds::pose()], |bytes| {
        let Ok(text) = std::str::from_utf8(bytes) else {
            return false;
        };
        let Ok(pose) = PoseFile::from_toml("pose.toml", text) else {
            return false;
        };
        let joints = pose.joints.iter();
        let numbers = joints.flat_map(|joint| [joint.stroke_mm, joint.turn_deg]);
        assert!(numbers.into_iter().all(f64::is_finite));
        true
    });
}

#[test]
fn bases_of_large_objects() {
    let solid = Solid::new(cuboid(&Point::origin(), &Point::new(300.0, 90.0, 80.0))).unwrap();
    let ground = Ground::new(&solid).unwrap();
    let request = Request::new(5.0, Limits::NONE);
    let connector = ConnectorRequest {
        radius_mm: 20.0,
        gap_mm: 0.1,
        rods: None,
    };
    let reads = |bytes: &[u8]| {
        let read = |text| BasePlan::from_toml(["base.toml", text], &ground, &request, &connector);
        let plan = std::str::from_utf8(bytes)
            .ok()
            .and_then(|text| read(text).ok());
        plan.is_some_and(|plan| {
            // What is read is proved: the polyhedra are in the box, and apart.
            assert!(plan.volume_mm3() <= 290.0 * 80.0 * 70.0 + 1e-6);
            assert!(plan.parted_mm() > 0.0);
            true
        })
    };
    fuzz("base", &[seeds::base()], reads);
}

#[test]
fn fields_of_densities() {
    let solid = Solid::new(cuboid(&Point::origin(), &Point::new(3.0, 2.0, 1.0))).unwrap();
    let reads = |bytes: &[u8]| {
        let text = std::str::from_utf8(bytes);
        let order = text.is_ok_and(|text| read_text("field.toml", text).is_ok());
        if order {
            let order = read_text("field.toml", text.unwrap()).unwrap();
            assert!(!order.on(&solid).at(&Point::new(1.0, 1.0, 0.5)).is_nan());
        }
        order
    };
    fuzz("field", &[seeds::field()], reads);
}
