//! The map of the code: questions that a new reader asks, and the files that answer them.
//!
//! Every file lies below `src`. A room's `mod.rs` says what else is in it. `tests/architecture`
//! checks that the files and names below exist.
//!
//! | question | answer |
//! | --- | --- |
//! | What happens to a job, in which order? | `prepare` in `prepare/mod.rs`, a line of seven stages |
//! | Where is a broken mesh mended, and who says what was changed? | `repair` in `repair/ladder.rs`; `Repairs` in `repair/report.rs` counts the changes |
//! | What becomes of a file that no rung mends? | `redraw` in `mend/redraw.rs` draws a new surface by the winding numbers of `mesh/winding.rs`, `farthest` in `mend/redraw/stray.rs` measures it both ways |
//! | How thick is the wall, and why? | `quantise_wall` in `printer/wall.rs`; `Shell` in `shell/wall.rs` keeps it |
//! | Where does a request become a frame with a support? | `place` in `goal/place.rs`, then the goal's own file, say `goal/top.rs` |
//! | Who decides if a top needs a tip, and which? | `choose_contact` in `prepare/place.rs`; `Lean` in `goal/lean.rs` says how far it leans, `TipPlace` in `goal/tips.rs` picks the pin |
//! | Where is the bound computed? | `Visit` in `hollow/dual/visit.rs` evaluates the dual, `climb` in `hollow/dual/ascent.rs` raises it |
//! | Where is a density that varies integrated? | `measure` in `field/measure.rs`, over the signed cones of `mass/cones.rs` and the rays of `mass/rays.rs` |
//! | Who says that tetrahedra fill a solid once, and what do they weigh? | `Tets::new` in `tets/volume.rs`, over `tets/faces.rs` and `tets/overlap.rs`; files are read in `io/volume/read.rs` |
//! | Where is a solid filled with tetrahedra? | `stuff` in `tets/stuffing.rs`, cut by `Clipper` in `tets/clip.rs`; `NestedDensity` in `tets/nested.rs` gives them the levels of a print |
//! | Which infill is enough, and which is nearest to a wished one? | `greatest_low` in `hollow/range.rs`, `least_change` in `hollow/change.rs`, in steps by `least_level_change` in `hollow/levels.rs` |
//! | How is a ramp or a wave fitted to a goal, and how is it printed? | `fit_all` in `hollow/family/starts.rs`, `regions` in `hollow/family/regions.rs`; `with_field` in `prepare/fields.rs` puts it into a print |
//! | Where are the regions of a skin or of a `field.toml` drawn? | `draw_field` in `open/field_bodies.rs`: by `Cavity` at the depth, or by `DensityField` in `voids/density_field.rs`; `drawn` in `prepare/drawn.rs` puts them into a print |
//! | Where does a match get its numbers, and who says that they are met? | `resolved` in `prepare/like.rs` reads the file, `Mismatch` in `verify/handling.rs` compares; `MatchMiss` in `hollow/miss.rs` words what is out of reach |
//! | How dense is printed infill, and how does a shop measure it? | `laid_ratio` in `printer/infill.rs`; `core_ratios` in `coupon/density/weighed.rs` takes the masses of blocks |
//! | Where does a model get two materials, pixel by pixel? | `dither_model` in `slice/dither/run.rs`, by `Diffusion` in `raster/dither.rs`; `slice/dither/correct.rs` makes the moments right |
//! | What is tried if the goal cannot be met? | `remedies` in `prepare/advise.rs`; the trials are in `advice/remedy.rs` |
//! | Which cut is better than another, and by how much? | `penalty` and `Term` in `cut/planner/score.rs` |
//! | What of a seam is seen, and what does it cost? | `look` in `cut/seam/look.rs` weighs the outside, `Skin` in `cut/seam/skin.rs` prices a seam |
//! | When does a plan give way to one with hidden seams? | `hide_seams` in `open/ladder/hidden.rs`, within `seam_loss_ratio` of `run/policy.rs` |
//! | Where is the pin's diameter decided? | `size_pairs` in `cut/joints/pin_size.rs`, from the profile by `cut/for_printer.rs` |
//! | What happens if no cut opens a void? | `Obstacle::Unopenable` of `cut/planner/search.rs` makes `open/clean.rs` keep the void solid and solve again |
//! | On what are plans compared, and on what are they built? | `open/search.rs` climbs on a coarse copy of the body (`open/proxy.rs`); `open/build.rs` builds what it finds |
//! | When does a search for plans end? | `Budget` in `open/budget.rs` counts work, `Effort` in `job/effort.rs` limits it |
//! | What happens if a joint has no room for pins? | `Ladder::climb` in `open/ladder.rs` tries each `Rung` of `run/policy.rs` |
//! | Who holds the parts while glue sets if pins do not? | `jigs` in `cut/joints/jig.rs`, judged by `measure_jigs` in `verify/jigs.rs` |
//! | Which ends of voids would catch resin in a vat, and what becomes of them? | `find_hollow_cups` in `cut/pieces/cups.rs` finds them in the best pose, `clean_and_drain` in `open/drain.rs` keeps them solid |
//! | Where are the drain holes of an uncut piece? | `Printer::drain_need` in `printer/drains.rs` counts them, `cut/drains/place.rs` chooses among the places that `cut/drains/bore.rs` finds, `open/drained.rs` keeps the rest solid; `verify/drains.rs` measures them |
//! | What closes a drain hole? | `CutPlan::plug_bodies` in `cut/drains/plug.rs`, made parts in `cut/pieces/part.rs`; `verify/plugs.rs` measures their gaps and `verify/shape.rs` their surfaces; `page/plugging.rs` says how they go in |
//! | Where do the files of the parts come from? | `make` in `make/parts.rs` writes, reads back and corrects them |
//! | Who says that a promise is kept, and within which limit? | `checks` in `verify/checks.rs`; each limit has its reason in `verify/limits.rs` |
//! | Who says that the papers are those of the files? | `verify` in `press/again.rs` prints them again from a `Layout` of `press/layout.rs`, `find_false_job` in `press/job.rs` compares job and profile |
//! | Where does a number on the job sheet come from? | `sheet/from_run/checklist.rs` fills the `Checklist` that `page/job_sheet.rs` prints |
//! | Which words does a remedy use for an option? | `Setting` in `base/setting.rs` is the option, `flag` in `cli/flags.rs` its word |
//! | What is left behind when a run is killed? | `Staging` in `kit/staging.rs`, swept by the next run |
//! | What does a printer's number rest on? | `Sourced` in `base/sourced.rs`; the profiles lie in `profiles`, read by `printer/library.rs` |
//! | Where is a curve met by a chain of tubes? | `fit` in `curve/fit/mod.rs`, from the starts of `curve/fit/starts.rs` down by `descend` in `curve/fit/descent.rs` |
//! | How thick is a shell of a telescope, and why? | `Telescope::nest` in `telescope/nest.rs` adds clearances and walls from `telescope/sizes.rs` |
//! | Who says that a telescope opens without a collision? | `Telescope::open_in` in `telescope/motion.rs`, over the gaps of `telescope/clearance.rs` |
//! | What happens to a curve, in which order? | `prepare` in `telescope/prepare/mod.rs`, a line of six stages |
//! | Who says that a telescope's kit is right? | `judge_telescope` in `verify/telescope/facts.rs`, with its own screws in `verify/telescope/motion.rs` |
//! | Which strokes bring a tip to a place, and what if none do? | `Network::reach` in `telescope/pose.rs`; `Poser` in `telescope/prepare/posing.rs` sweeps the way, `telescope/prepare/unreached.rs` words the answer, `verify/telescope/poses.rs` judges it |
//! | How does a shop find out which clearance slides? | `SlideSet` in `coupon/slide/set.rs`, bodies in `coupon/slide/bodies.rs`; `printer/calibrate.rs` writes it to the material |
//! | How does a tube slide along its own axis? | `Helix` in `curve/helix.rs`: frames along a helix compose, so it slides in itself |
//! | Where does a limb of a model begin and end, and how thick is it? | `Skeleton::of` in `skeleton/tree.rs`, by the contraction of `skeleton/flow.rs` and the pruning of `skeleton/tidy.rs` |
//! | How is a limb held by its juncture? | `Telescope::socket` and `Telescope::peg` in `telescope/mount.rs`, bodies in `telescope/prepare/network/bodies.rs` |
//! | What happens to a juncture larger than the printer's room? | `Divider::divide` in `telescope/prepare/network/divide.rs` hands it to the planner, `divide_around` in `cut/planner/fit.rs` keeps off its sockets; `verify/telescope/divided.rs` judges the parts |
//! | In which order do the limbs of a figure open? | `Bodies::sequence` in `telescope/prepare/network/sweep.rs` |
//! | Which limbs become telescopes, and which stay solid? | `mark_solid` in `skeleton/solid.rs` and `Limbs` in `skeleton/limbs.rs` |
//! | What does a print lay down, and where? | `read_gcode` in `io/gcode/open.rs` unpacks, `Machine` in `io/gcode/machine.rs` follows the nozzle, `Bead` in `mass/bead.rs` is weighed |
//! | Which part of a solid is nearest to a site? | `cells` in `cells/diagram.rs`, of a `Room` (`cells/room.rs`); `relax` in `cells/lloyd.rs` moves the sites, by the energies of `cells/energy.rs` |
//! | Where do the first sites of cells lie, and what is written of cells? | `poisson_sites` in `cells/poisson.rs`; `bodies` in `cells/parts.rs` cuts them as meshes, `cells/files.rs` writes them |
//! | How is a model of cells printed, and how does every cell drain? | `build` in `comb/build.rs`: voids of `comb/rooms.rs`, openings of `comb/doors.rs`, holes of `comb/escapes.rs`, ways of `comb/flow.rs` |
//! | How is the inside of a kit made of cells? | `with_cells` in `prepare/inner_cells.rs` measures their density, `InnerCells::within` in `comb/inner.rs` draws them in every round, `verify/cell_walls.rs` judges them |
//! | Which part of a large object is its base? | `grow_polyhedron` in `polyhedra/inscribe.rs`; `Growth` in `polyhedra/growth.rs` moves the faces, `drop_cheapest` in `polyhedra/dropping.rs` leaves few |
//! | Who says that a base stays inside the model? | `Separation::check` in `polyhedra/separation.rs`, one face for each triangle |
//! | What happens to a model larger than the printer, in which order? | `prepare` in `core_kit/mod.rs`; `core_kit/build.rs` joins base, panels, shell and sheets |
//! | Who says that a kit with a base is right? | `judge_core` in `verify/core_kit/facts.rs`, with its own seams in `verify/core_kit/shell.rs` |
//! | Which printed part leaves with which panel, and in which order? | `cells` in `cladding/cells.rs` gives each face its space, `Scene::assembly` in `cladding/ordering.rs` orders what leaves, and `cladding/knot.rs` names what cannot |
//! | Where is a base parted into several? | `grow_polyhedra` in `polyhedra/plan.rs`; `polyhedra/connection.rs` joins them |
//! | How wide is a laser's cut? | `Cutter::kerf` in `cutter/machine.rs`, from the profiles that `cutter/library.rs` lists |
