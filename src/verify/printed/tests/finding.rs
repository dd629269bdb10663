//! Parts are found in toolpaths by label, shape or place, or a file is refused.

use super::*;

#[test]
fn right_toolpaths_weigh_what_the_kit_does() {
    let found = judged(&kit(), RIGHT.trays(LABELS));
    assert_right(&found);
    assert!(
        found
            .parts
            .iter()
            .all(|part| part.found_by == MatchedBy::Label)
    );
    assert_eq!(found.notes, Vec::<String>::new());
}

#[test]
fn plates_of_a_file_each_are_put_together() {
    let one = |i: usize| RIGHT.gcode(&[(LABELS[i], LOWS_MM[0], &TRAY)]);
    let found = judge(&kit(), &[one(1), one(0)]).unwrap();
    assert_right(&found);
    // The second part lies where the first should.
    assert!(found.parts[1].is_moved && found.notes[0].contains("placed by its box: P02"));
}

#[test]
fn parts_without_labels_are_found_by_their_places() {
    let moved = Print {
        shift_mm: [-3.0, 14.0],
        ..RIGHT
    };
    for print in [RIGHT, moved] {
        let found = judged(&kit(), print.trays([None, None]));
        assert_right(&found);
        assert!(
            found
                .parts
                .iter()
                .all(|part| part.found_by == MatchedBy::Place)
        );
    }
}

#[test]
fn a_part_may_be_turned_on_the_plate() {
    let turned = TRAY.map(|(low, size)| {
        let low = [40.0 - low[1] - size[1], low[0], low[2]];
        (low, [size[1], size[0], size[2]])
    });
    let text = RIGHT.gcode(&[
        (LABELS[0], [20.0, 15.0], turned.as_slice()),
        (LABELS[1], LOWS_MM[1], &TRAY),
    ]);
    let found = judged(&kit(), text);
    assert_right(&found);
    assert!(found.parts[0].is_turned && !found.parts[0].is_mirrored);
}

/// Turns all moves by an angle about a point.
fn turned_by(text: &str, deg: f64, about: [f64; 2]) -> String {
    let (sin, cos) = deg.to_radians().sin_cos();
    let value = |word: &str, letter: char| word.strip_prefix(letter)?.parse::<f64>().ok();
    let turn = |line: &str| {
        let find = |letter| line.split(' ').find_map(|word| value(word, letter));
        let (Some(x), Some(y)) = (find('X'), find('Y')) else {
            return line.to_owned();
        };
        let (x, y) = (x - about[0], y - about[1]);
        let [x, y] = [x * cos - y * sin + about[0], x * sin + y * cos + about[1]];
        let rest = line
            .split(' ')
            .filter(|word| !word.starts_with(['X', 'Y', 'G']));
        let rest: Vec<&str> = rest.collect();
        format!("G1 X{x} Y{y} {}", rest.join(" "))
    };
    let lines: Vec<String> = text.lines().map(turn).collect();
    lines.join("\n")
}

#[test]
fn a_part_may_be_turned_by_any_angle() {
    let evidence = tripod_kit();
    for label in [LABELS[0], None] {
        for deg in [7.0, 45.0, -130.0] {
            let text = RIGHT.gcode(&[(label, LOWS_MM[0], &TRIPOD)]);
            let found = judged(&evidence, turned_by(&text, deg, [50.0, 40.0]));
            let part = &found.parts[0];
            assert!(part.is_turned && !part.is_mirrored, "{deg}: {part:?}");
            assert!(part.center_off_mm < 0.05, "{deg}: {part:?}");
            assert_eq!(kinds(&found), [], "{deg}: {:?}", found.causes);
        }
        let mirrored = Print {
            is_mirrored: true,
            ..RIGHT
        };
        let text = mirrored.gcode(&[(label, LOWS_MM[0], &TRIPOD)]);
        let found = judged(&evidence, turned_by(&text, 30.0, [50.0, 40.0]));
        assert_eq!(kinds(&found), [CauseKind::Mirror]);
    }
}

#[test]
fn equal_parts_are_not_told_apart_without_label_and_place() {
    let text = RIGHT.gcode(&[(None, [45.0, 50.0], &TRAY)]);
    let error = judge(&kit(), &[text]).unwrap_err().to_string();
    assert!(error.contains("fits P01 and P02"), "{error}");
    // In the place of one it is that one.
    let text = RIGHT.gcode(&[(None, LOWS_MM[1], &TRAY)]);
    assert_eq!(judged(&kit(), text).missing, ["P01"]);
}

#[test]
fn files_of_other_kits_and_files_given_twice_are_named() {
    let said = |texts: &[String]| judge(&kit(), texts).unwrap_err().to_string();
    let other = RIGHT.gcode(&[(LABELS[0], LOWS_MM[0], TRIPOD.as_slice())]);
    assert!(said(&[other]).contains("its P01 has another shape"));
    let stranger = RIGHT.gcode(&[(Some("cube"), LOWS_MM[0], TRIPOD.as_slice())]);
    assert!(said(&[stranger]).contains("fits no part of this kit: it prints cube of"));
    let unlabelled = RIGHT.gcode(&[(None, LOWS_MM[0], TRIPOD.as_slice())]);
    assert!(said(&[unlabelled]).contains("the size of no part or plate"));
    let both = RIGHT.gcode(&[(Some("P01+P02"), LOWS_MM[0], &TRAY)]);
    assert!(said(&[both]).contains("fits P01 and P02"));
    let text = RIGHT.trays(LABELS);
    let twice = said(&[text.clone(), text]);
    assert!(twice.contains("P01 is printed in") && twice.contains("give one of them only"));
    for empty in ["", "; nothing\n", "G28\n"] {
        assert!(judge(&kit(), &[empty.to_owned()]).is_err());
    }
    assert!(judge(&kit(), &[]).is_err());
}

#[test]
fn a_stranger_beside_the_parts_is_left_out() {
    let text = RIGHT.gcode(&[
        (LABELS[0], LOWS_MM[0], &TRAY),
        (LABELS[1], LOWS_MM[1], &TRAY),
        (Some("tower"), [150.0, 10.0], TRIPOD.as_slice()),
    ]);
    let found = judged(&kit(), text);
    assert_right(&found);
    assert!(found.notes[0].starts_with("not of this kit, and left out: tower"));
}

#[test]
fn a_missing_half_is_named_with_its_plate() {
    let found = judged(&kit(), RIGHT.gcode(&[(LABELS[0], LOWS_MM[0], &TRAY)]));
    assert_eq!(
        (broken(&found), found.toolpaths),
        (vec!["printed parts".to_owned()], None)
    );
    assert_eq!(found.causes[0].parts, ["P02"]);
    assert!(found.causes[0].remedy.contains("plate.3mf"));
}
