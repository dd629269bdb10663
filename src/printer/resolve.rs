//! A profile, what it inherits from and its materials put together into one printer.

use std::path::Path;

use toml::Spanned;

use super::{
    Faults, Printer, Problem, ProfileError,
    complete::{complete, consistent},
    error::suggestion,
    layer::Layer,
    library::{Library, PROFILE_ENDING, Profile, by_id, ids},
    materials::materials,
    profile::{ProfileText, Reader},
};
use crate::base::digest::sha256_hex;
use crate::base::toml_text::TextFault;

/// The printer that `profile` describes, with what it inherits; or everything that is wrong with
/// it. What is missing is told once what is there is right.
pub(super) fn resolve(library: &Library, profile: Profile) -> Result<Printer, ProfileError> {
    let mut reader = Reader::new(profile.file, profile.text);
    let mut way = Way {
        library,
        names: Vec::new(),
        ids: Vec::new(),
        texts: Vec::new(),
    };
    let layer = way.layer_of(profile, &mut reader)?;
    let materials = materials(library, &mut reader, &layer)?;
    refuse_faults(&mut reader)?;
    consistent(&mut reader, &layer);
    let printer = complete(&mut reader, layer, materials);
    refuse_faults(&mut reader)?;
    let texts: Vec<&[u8]> = way.texts.iter().map(String::as_bytes).collect();
    let profile_sha256 = sha256_hex(&texts);
    // Without a fault everything a printer needs was there.
    let printer = printer.ok_or_else(|| ProfileError::Broken(Faults(Vec::new())))?;
    Ok(Printer {
        profile_sha256,
        ..printer
    })
}

/// Fails with what was noted, if anything was.
fn refuse_faults(reader: &mut Reader) -> Result<(), ProfileError> {
    if reader.faults.is_empty() {
        Ok(())
    } else {
        Err(Faults(std::mem::take(&mut reader.faults)).into())
    }
}

/// The way from a profile up to the last it inherits from.
struct Way<'l, 'a> {
    library: &'l Library<'a>,
    /// The files on the way, from the profile up; built-in profiles by their ids.
    names: Vec<String>,
    /// Their ids, in the same order.
    ids: Vec<String>,
    /// Their texts, in the same order.
    texts: Vec<String>,
}

/// What a profile inherits from.
enum Parent<'a> {
    Process(Profile<'a>),
    Printer(Profile<'a>),
    /// A file, with its text.
    File(String, String),
}

impl<'a> Way<'_, 'a> {
    /// What the profile says, over what it inherits.
    fn layer_of(&mut self, profile: Profile, reader: &mut Reader) -> Result<Layer, ProfileError> {
        let text: ProfileText = reader.parse()?;
        let layer = Layer::read(reader, &text);
        self.names.push(self.name_on_way(&profile));
        self.ids.push(text.id.get_ref().clone());
        self.texts.push(profile.text.to_owned());
        let Some(id) = &text.inherits else {
            return Ok(layer);
        };
        let Some(parent) = self.parent(reader, profile.file, id) else {
            refuse_faults(reader)?;
            return Ok(layer);
        };
        let above = match &parent {
            Parent::Process(process) => self.process(*process, reader)?,
            Parent::Printer(printer) => self.above(*printer, reader)?,
            Parent::File(file, text) => self.above(
                Profile {
                    id: file,
                    file,
                    text,
                },
                reader,
            )?,
        };
        Ok(layer.over(above))
    }

    /// The layer of a parent; its faults join those of the child.
    fn above(&mut self, parent: Profile, child: &mut Reader) -> Result<Layer, ProfileError> {
        let mut reader = Reader::new(parent.file, parent.text);
        let layer = self.layer_of(parent, &mut reader)?;
        child.faults.append(&mut reader.faults);
        Ok(layer)
    }

    /// What a process says; its faults join those of the printer.
    fn process(&mut self, process: Profile, child: &mut Reader) -> Result<Layer, TextFault> {
        let mut reader = Reader::new(process.file, process.text);
        let text: ProfileText = reader.parse()?;
        let layer = Layer::read(&mut reader, &text);
        if let Some(parent) = &text.inherits {
            let problem = Problem::ProcessInherits {
                id: layer.id.clone(),
                parent: parent.get_ref().clone(),
            };
            reader.note(parent.span().start, problem);
        }
        self.texts.push(process.text.to_owned());
        child.faults.append(&mut reader.faults);
        Ok(layer.into_defaults())
    }

    /// What a profile is called when a circle is looked for.
    fn name_on_way(&self, profile: &Profile) -> String {
        let is_built_in =
            by_id(self.library.printers, profile.id).is_some_and(|p| p.file == profile.file);
        if is_built_in {
            profile.id.to_owned()
        } else {
            one_form(Path::new(profile.file))
        }
    }

    /// What the profile in `file` inherits from; a parent that is none is noted.
    fn parent(&self, reader: &mut Reader, file: &str, id: &Spanned<String>) -> Option<Parent<'a>> {
        let at = id.span().start;
        let parent = id.get_ref();
        let known = ids(self.library.processes);
        let path = parent
            .ends_with(PROFILE_ENDING)
            .then(|| beside(file, parent));
        let name = path.clone().unwrap_or_else(|| parent.clone());
        if let Some(first) = self.names.iter().position(|on_way| *on_way == name) {
            reader.note(at, circle(&self.names[first..], &known));
            return None;
        }
        if let Some(path) = path {
            return match std::fs::read_to_string(&path) {
                Ok(text) => Some(Parent::File(path, text)),
                Err(_) => {
                    reader.note(at, Problem::UnreadableParent { parent: path });
                    None
                }
            };
        }
        let process =
            by_id(self.library.processes, parent).map(|process| Parent::Process(*process));
        let printer = by_id(self.library.printers, parent).map(|printer| Parent::Printer(*printer));
        let found = process.or(printer);
        if let (None, Some(first)) = (&found, self.ids.iter().position(|id| id == parent)) {
            reader.note(at, circle(&self.ids[first..], &known));
        } else if found.is_none() {
            let all: Vec<&str> = known
                .into_iter()
                .chain(ids(self.library.printers))
                .collect();
            reader.note(
                at,
                Problem::UnknownParent {
                    remedy: suggestion(parent, &all),
                    parent: parent.clone(),
                },
            );
        }
        found
    }
}

/// The fault of a profile that is its own ancestor by this way up.
fn circle(way: &[String], known: &[&str]) -> Problem {
    let id = way.first().cloned().unwrap_or_default();
    Problem::Cycle {
        way: format!("{} → {id}", way.join(" → ")),
        id,
        known: known.join(", "),
    }
}

/// The path of a parent that is named in `file`, in the one form that the same file always has.
fn beside(file: &str, parent: &str) -> String {
    let folder = Path::new(file).parent().unwrap_or(Path::new(""));
    one_form(&folder.join(parent))
}

/// The absolute path without links and dots; the path itself where there is no such file.
fn one_form(path: &Path) -> String {
    std::fs::canonicalize(path)
        .unwrap_or_else(|_| path.to_owned())
        .to_string_lossy()
        .into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::printer::library::BUILT_IN;

    /// A whole printer that inherits from a process, in the shape every broken one below is made
    /// from.
    const WHOLE: &str = r#"id = "test"
name = "Test printer"
inherits = "polyjet"
materials = ["vero-white", "pla"]
default_material = "pla"
build_volume_mm = { value = [200, 100, 150], source = "s", sure = "read" }

[numbers]
pixel_x_mm = { dpi = 600, source = "s", sure = "paper" }
pixel_y_mm = { value = 0.05, source = "s", sure = "third-party" }
layer_mm = { value = 0.03, source = "s", sure = "recalled" }

[[material]]
id = "own"
name = "Own resin"
density_g_cm3 = { value = 1.2, source = "weighed coupon", sure = "read" }
density_spread_ratio = { value = 0.01, source = "weighed coupon", sure = "read" }
"#;

    fn load(text: &str) -> Result<Printer, ProfileError> {
        resolve(
            &BUILT_IN,
            Profile {
                id: "t.toml",
                file: "t.toml",
                text,
            },
        )
    }

    #[test]
    fn a_whole_profile_takes_its_own_numbers_first_and_the_process_defaults_after() {
        let printer = load(WHOLE).unwrap();
        assert_eq!(printer.pixel_y_mm.provenance(), "third party: s");
        assert!(
            printer
                .min_wall_mm
                .provenance()
                .starts_with("read, default of polyjet: Hubs")
        );
        assert_eq!(
            printer.build_volume_mm.unwrap().value,
            [200.0, 100.0, 150.0]
        );
        let ids: Vec<&str> = printer
            .materials
            .iter()
            .map(|material| material.id.as_str())
            .collect();
        assert_eq!(
            ids,
            ["pla", "vero-white", "own"],
            "the default comes first, own materials last"
        );
    }

    #[test]
    fn an_own_material_replaces_the_known_one_of_its_id() {
        let printer = load(&WHOLE.replace("\"own\"", "\"pla\"")).unwrap();
        assert_eq!(printer.materials.len(), 2);
        assert_eq!(
            printer.material(Some("pla")).unwrap().density_g_cm3.value,
            1.2
        );
    }

    #[test]
    fn a_list_of_materials_does_not_take_over_the_default_of_another_list() {
        let text = WHOLE
            .replace("default_material = \"pla\"\n", "")
            .replace("\"vero-white\", \"pla\"", "\"pla\"");
        assert_eq!(load(&text).unwrap().material(None).unwrap().id, "pla");
    }

    #[test]
    fn a_profile_without_a_process_must_say_everything() {
        let error = load(&WHOLE.replace("inherits = \"polyjet\"\n", "")).unwrap_err();
        let ProfileError::Broken(Faults(faults)) = error else {
            panic!("{error}")
        };
        let missing =
            |fault: &&crate::printer::Fault| matches!(fault.problem, Problem::Missing { .. });
        assert_eq!(
            (faults.len(), faults.iter().filter(missing).count()),
            (13, 13)
        );
        assert!(
            faults[0]
                .to_string()
                .starts_with("t.toml:1:1: `min_wall_mm` is not set"),
            "{}",
            faults[0]
        );
    }

    /// What to replace in the whole profile, by what, and what the message must then say, the place
    /// first.
    const BROKEN: &[(&str, &str, &str, &str)] = &[
        ("id = \"test\"\n", "", ":1:1: ", "missing field `id`"),
        (
            "name = \"Test printer\"\n",
            "",
            ":1:1: ",
            "missing field `name`",
        ),
        (
            "\"test\"",
            "\"My Printer\"",
            ":1:6: ",
            "may only have lower-case letters",
        ),
        (
            "\"test\"",
            "\"\"",
            ":1:6: ",
            "may only have lower-case letters",
        ),
        ("\"Test printer\"", "\"  \"", ":2:8: ", "`name` is empty"),
        (
            "id = \"test\"",
            "id = ",
            ":1:6: ",
            "string values must be quoted",
        ),
        (
            "id = \"test\"",
            "id = \"test\"\nid = \"again\"",
            ":2:1: ",
            "duplicate key",
        ),
        (
            "id = \"test\"",
            "ID = \"test\"",
            ":1:1: ",
            "unknown field `ID`",
        ),
        ("inherits", "inherit", ":3:1: ", "did you mean `inherits`"),
        (
            "\"polyjet\"",
            "\"polyjt\"",
            ":3:12: ",
            "no process or printer `polyjt`; remedy: did you mean `polyjet`?",
        ),
        (
            "\"polyjet\"",
            "\"laser-tag\"",
            ":3:12: ",
            "use one of fdm, mjf, mjp, polyjet, sla, sls, bambu",
        ),
        (
            "\"polyjet\"",
            "\"test\"",
            ":3:12: ",
            "`test` inherits from itself",
        ),
        (
            "\"polyjet\"",
            "\"prusa-mk5\"",
            ":3:12: ",
            "did you mean `prusa-mk4`?",
        ),
        (
            "\"polyjet\"",
            "\"gone.toml\"",
            ":3:12: ",
            "cannot read the parent gone.toml",
        ),
        (
            "\"polyjet\"",
            "[\"polyjet\"]",
            ":3:12: ",
            "invalid type: sequence",
        ),
        (
            "\"vero-white\", \"pla\"",
            "",
            ":5:20: ",
            "default material `pla` is not among",
        ),
        (
            "\"vero-white\", \"pla\"",
            "\"pla\", \"vero-wite\"",
            ":4:21: ",
            "did you mean `vero-white`?",
        ),
        (
            "\"vero-white\", \"pla\"",
            "\"pla\", \"pla\"",
            ":4:21: ",
            "`pla` appears twice",
        ),
        (
            "default_material = \"pla\"",
            "default_material = \"abs\"",
            ":5:20: ",
            "not among the printer's materials",
        ),
        (
            "default_material",
            "support = \"waterjet\"\ndefault_material",
            ":5:11: ",
            "did you mean `water-jet`",
        ),
        (
            "default_material",
            "print_pose = \"up\"\ndefault_material",
            ":5:14: ",
            "unknown variant `up`",
        ),
        (
            "default_material",
            "grid = 7\ndefault_material",
            ":5:8: ",
            "wanted string or table",
        ),
        (
            "default_material",
            "cleaning = \"\"\ndefault_material",
            ":5:12: ",
            "`cleaning` is empty",
        ),
        (
            "[200, 100, 150]",
            "[200, 100]",
            ":6:29: ",
            "invalid length 2",
        ),
        (
            "[200, 100, 150]",
            "[200, -100, 150]",
            ":6:19: ",
            "`build_volume_mm` is -100, but must be positive",
        ),
        (
            "[200, 100, 150]",
            "[20, 10, 0.15]",
            ":6:19: ",
            "outside 10 to 10000",
        ),
        (
            "pixel_x_mm",
            "pixel_x",
            ":9:1: ",
            "did you mean `pixel_x_mm`",
        ),
        (
            "dpi = 600, source = \"s\", ",
            "dpi = 600, ",
            ":9:14: ",
            "`pixel_x_mm` has no source",
        ),
        (
            "dpi = 600, source = \"s\"",
            "dpi = 600, source = \" \"",
            ":9:14: ",
            "`pixel_x_mm` has no source",
        ),
        (
            "sure = \"paper\"",
            "sure = \"certain\"",
            ":9:48: ",
            "unknown variant `certain`",
        ),
        (
            ", sure = \"paper\"",
            "",
            ":9:14: ",
            "does not say how sure it is",
        ),
        ("dpi = 600, ", "", ":9:14: ", "`pixel_x_mm` has no value"),
        (
            "dpi = 600",
            "dpi = 600, value = 0.04",
            ":9:14: ",
            "has both value and dpi",
        ),
        (
            "dpi = 600",
            "dpi = 0",
            ":9:14: ",
            "is inf, but must be positive and finite",
        ),
        (
            "dpi = 600",
            "value = nan",
            ":9:14: ",
            "is NaN, but must be positive and finite",
        ),
        (
            "dpi = 600",
            "value = \"fine\"",
            ":9:24: ",
            "invalid type: string",
        ),
        (
            "dpi = 600",
            "value = 42.3",
            ":9:14: ",
            "outside 0.001 to 2; remedy: check the unit",
        ),
        ("layer_mm", "min_wall_mm", ":1:1: ", "`layer_mm` is not set"),
        (
            "layer_mm = { value",
            "chamfer_mm = { dpi",
            ":11:14: ",
            "`chamfer_mm` cannot be given in dpi",
        ),
        (
            "{ value = 0.03, source = \"s\", sure = \"recalled\" }",
            "0.03",
            ":11:12: ",
            "invalid type: floating point",
        ),
        (
            "value = 1.2,",
            "value = 1200,",
            ":16:17: ",
            "outside 0.05 to 25",
        ),
        ("id = \"own\"\n", "", ":13:1: ", "missing field `id`"),
        (
            "value = 1.2,",
            "value = 0,",
            ":16:17: ",
            "`density_g_cm3` is 0, but must be positive",
        ),
        (
            "value = 1.2,",
            "value = -1.2,",
            ":16:17: ",
            "`density_g_cm3` is -1.2, but must be positive",
        ),
        (
            "value = 1.2,",
            "value = 1e300,",
            ":16:17: ",
            "is 1e300, outside 0.05 to 25",
        ),
        (
            "value = 1.2,",
            "value = inf,",
            ":16:17: ",
            "is inf, but must be positive and finite",
        ),
        (
            "value = 1.2,",
            "value = \"1.2 g\",",
            ":16:27: ",
            "invalid type: string",
        ),
        (
            "density_g_cm3 =",
            "density_kg_m3 =",
            ":16:1: ",
            "did you mean `density_g_cm3`",
        ),
        (
            "density_g_cm3 =",
            "# density_g_cm3 =",
            ":13:1: ",
            "missing field `density_g_cm3`",
        ),
        (
            "sure = \"read\" }\ndensity_spread",
            "sure = \"measured\" }\ndensity_spread",
            ":16:17: ",
            "no measured_on; remedy",
        ),
        (
            "density_spread",
            "measured_on = 12:00:00\ndensity_spread",
            ":17:15: ",
            "must be a day",
        ),
        (
            "density_spread",
            "measured_on = \"soon\"\ndensity_spread",
            ":17:15: ",
            "invalid type: string",
        ),
        (
            "density_spread",
            "measured_on = 2026-02-31\ndensity_spread",
            ":17:",
            "date",
        ),
        (
            "density_spread",
            "lot = \" \"\ndensity_spread",
            ":17:7: ",
            "`lot` is empty",
        ),
        (
            "dpi = 600",
            "value = 1e300",
            ":9:14: ",
            "is 1e300, outside 0.001 to 2",
        ),
        (
            "dpi = 600",
            "value = -0.0",
            ":9:14: ",
            "must be positive and finite",
        ),
        (
            "dpi = 600",
            "dpi = nan",
            ":9:14: ",
            "is NaN, but must be positive",
        ),
        (
            "dpi = 600",
            "dpi = 1e-300",
            ":9:14: ",
            "`pixel_x_mm` is 2.54e301, outside",
        ),
        (
            "layer_mm =",
            "layer_least_mm = { value = 0.1, source = \"s\", sure = \"read\" }\nlayer_mm =",
            ":1:1: ",
            "`layer_least_mm` is 0.1, but `layer_mm` is 0.03",
        ),
        (
            "[numbers]",
            "largest_part_mm = { value = [300, 50, 50], source = \"s\", sure = \"read\" }\n[numbers]",
            ":1:1: ",
            "`largest_part_mm` is 300, but the build volume is 200 there",
        ),
        (
            "[numbers]",
            "excluded_corners = [{ corner = \"left\", size_mm = [1, 1], source = \"s\", sure = \"read\" }]\n[numbers]",
            ":8:32: ",
            "unknown variant `left`, expected one of `front-left`",
        ),
        (
            "[numbers]",
            "excluded_corners = [{ corner = \"front-left\", size_mm = [500, 1], source = \"s\", sure = \"read\" }]\n[numbers]",
            ":1:1: ",
            "`excluded_corners.size_mm` is 500, but the build volume is 200",
        ),
        (
            "[numbers]",
            "walls_by_part_size = [{ up_to_mm = 100, wall_mm = 0.7, sure = \"read\" }]\n[numbers]",
            ":8:23: ",
            "`walls_by_part_size` has no source",
        ),
        (
            "[numbers]",
            "walls_by_part_size = [\n{ up_to_mm = 100, wall_mm = 0.7, source = \"s\", sure = \"read\" },\n\
            { up_to_mm = 50, wall_mm = 0.7, source = \"s\", sure = \"read\" }]\n[numbers]",
            ":1:1: ",
            "`walls_by_part_size.up_to_mm` is 50, but the one before it is 100",
        ),
        (
            "[numbers]",
            "compensates_shrinkage = true\n[numbers]",
            ":8:25: ",
            "invalid type: boolean",
        ),
    ];

    #[test]
    fn every_broken_profile_is_refused_with_its_place_and_its_reason() {
        let mut wrong = Vec::new();
        for &(from, to, place, reason) in BROKEN {
            assert!(WHOLE.contains(from), "{from}");
            let error = load(&WHOLE.replacen(from, to, 1))
                .expect_err(to)
                .to_string();
            if !error.contains(reason) || !error.contains(&format!("t.toml{place}")) {
                wrong.push(format!("{from} → {to} (t.toml{place}{reason}): {error}"));
            }
        }
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    }

    #[test]
    fn the_example_in_the_documentation_can_be_used() {
        let page = include_str!("mod.rs")
            .split("//! ```")
            .nth(1)
            .unwrap()
            .trim_start_matches("toml");
        let example: String = page
            .lines()
            .map(|line| line.trim_start_matches("//!").to_owned() + "\n")
            .collect();
        let printer = load(&example).unwrap();
        assert_eq!(
            (printer.id.as_str(), printer.materials[0].id.as_str()),
            ("shop-jet", "lot-7")
        );
    }

    #[test]
    fn all_faults_are_told_at_once() {
        let text = WHOLE
            .replace("dpi = 600", "value = -1")
            .replace("value = 0.05", "value = 0");
        let ProfileError::Broken(Faults(faults)) = load(&text).unwrap_err() else {
            panic!()
        };
        assert_eq!(faults.len(), 2);
    }

    #[test]
    fn a_number_without_a_source_is_refused_wherever_it_stands() {
        for (from, to) in [
            ("source = \"weighed coupon\", ", ""),
            ("source = \"s\", ", ""),
            ("150], source = \"s\"", "150]"),
        ] {
            let error = load(&WHOLE.replacen(from, to, 1)).unwrap_err().to_string();
            assert!(error.contains("has no source"), "{error}");
        }
    }

    /// A folder with these profiles, each made of the whole one by its id and its parent.
    fn shop(profiles: &[(&str, &str)]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for (name, parent) in profiles {
            let text = WHOLE
                .replace("\"test\"", &format!("\"{name}\""))
                .replace("polyjet", parent);
            std::fs::write(folder.path().join(format!("{name}.toml")), text).unwrap();
        }
        folder
    }

    #[test]
    fn a_profile_may_inherit_from_a_printer_and_from_a_file_beside_it() {
        let text = "id = \"mine\"\nname = \"Mine\"\ninherits = \"prusa-mk4\"\n[numbers]\n\
                    min_wall_mm = { value = 1.3, source = \"s\", sure = \"measured\" }\n";
        let mine = load(text).unwrap();
        assert_eq!(
            (mine.inherits.join(" "), mine.process.as_deref()),
            ("prusa-mk4 fdm".into(), Some("fdm"))
        );
        assert_eq!((mine.min_wall_mm.value, mine.pixel_x_mm.value), (1.3, 0.45));
        assert_eq!(
            mine.pixel_x_mm.process_default_of, None,
            "the machine's own number is no process default"
        );
        assert_eq!(
            mine.min_feature_mm.process_default_of.as_deref(),
            Some("fdm")
        );
        let folder = shop(&[("first", "formlabs-form4"), ("second", "first.toml")]);
        let second = Printer::read(&folder.path().join("second.toml")).unwrap();
        assert_eq!(second.inherits, ["first", "formlabs-form4", "sla"]);
    }

    #[test]
    fn a_circle_of_parents_is_told_with_its_way_however_the_files_are_named() {
        let folder = shop(&[("a", "b.toml"), ("b", "c.toml"), ("c", "../NAME/a.toml")]);
        let name = folder.path().file_name().unwrap().to_str().unwrap();
        let last = folder.path().join("c.toml");
        std::fs::write(
            &last,
            std::fs::read_to_string(&last)
                .unwrap()
                .replace("NAME", name),
        )
        .unwrap();
        let error = Printer::read(&folder.path().join("a.toml"))
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("c.toml:3:12: ") && error.contains("inherits from itself ("),
            "{error}"
        );
        assert_eq!(error.matches(" → ").count(), 3, "{error}");
    }

    #[test]
    fn a_process_that_inherits_is_refused_in_its_own_file() {
        let process = "id = \"deep\"\nname = \"Deep\"\ninherits = \"polyjet\"\n";
        let processes = [Profile {
            id: "deep",
            file: "deep.toml",
            text: process,
        }];
        let library = Library {
            processes: &processes,
            ..BUILT_IN
        };
        let text = WHOLE.replace("polyjet", "deep");
        let error = resolve(
            &library,
            Profile {
                id: "t.toml",
                file: "t.toml",
                text: &text,
            },
        )
        .unwrap_err();
        assert!(
            error
                .to_string()
                .starts_with("deep.toml:3:12: the process `deep` inherits from `polyjet`"),
            "{error}"
        );
    }

    #[test]
    fn the_hash_covers_the_profile_and_its_process() {
        let plain = load(WHOLE).unwrap().profile_sha256;
        assert_eq!(plain.len(), 64);
        assert_ne!(
            plain,
            load(&format!("{WHOLE}\n# a remark"))
                .unwrap()
                .profile_sha256
        );
        assert_ne!(
            plain,
            load(&WHOLE.replace("polyjet", "sla"))
                .unwrap()
                .profile_sha256
        );
    }

    proptest::proptest! {
        #[test]
        fn a_profile_damaged_anywhere_is_read_or_refused_without_a_panic(at in 0..WHOLE.len(), by in "\\PC{0,3}") {
            let damaged = format!("{}{by}{}", &WHOLE[..at], &WHOLE[(at + 1).min(WHOLE.len())..]);
            if let Err(error) = load(&damaged) {
                proptest::prop_assert!(error.to_string().contains("t.toml:"), "{error}");
            }
        }
    }
}
