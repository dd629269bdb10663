//! Broken profiles are refused with their place and the reason.

use super::tests::{WHOLE, load};

/// A text of the valid profile, its replacement, and the place and words of the error.
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
        "least_infill_ratio = { value = 0.05, source = \"s\", sure = \"read\" }\nlayer_mm = { value",
        ":11:22: ",
        "is 0.05, outside 0.1 to 1",
    ),
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
        "excluded_corners = [{ corner = \"left\", size_mm = [1, 1], source = \"s\", \
         sure = \"read\" }]\n[numbers]",
        ":8:32: ",
        "unknown variant `left`, expected one of `front-left`",
    ),
    (
        "[numbers]",
        "excluded_corners = [{ corner = \"front-left\", size_mm = [500, 1], source = \"s\", \
         sure = \"read\" }]\n[numbers]",
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
        "walls_by_part_size = [\n\
            { up_to_mm = 100, wall_mm = 0.7, source = \"s\", sure = \"read\" },\n\
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
