//! Orders of plans in place of a kit.

use super::*;

#[test]
fn plans_are_written_beside_the_model_and_not_over_its_kit() {
    let kit = request(PREPARE).out;
    let plans = request(&format!("{PREPARE} --plans 2")).out;
    assert_eq!(kit, Path::new("elephant-top"));
    assert_eq!(plans, Path::new("elephant-plans"));
    let line = PREPARE.replace("prepare", "cuts");
    assert!(matches!(parse(&line).unwrap().command, Command::Cuts(_)));
    assert!(parse(&format!("{PREPARE} --plans 9")).is_err());
}

#[test]
fn plans_are_no_kit_and_what_only_a_kit_has_is_refused() {
    for (more, flag) in [("--tets part.msh", "--tets"), ("--slice", "--slice")] {
        let line =
            format!("equipoise cuts models/elephant.obj --printer prusa-mk4 --goal top {more}");
        let Command::Cuts(mut args) = parse(&line).unwrap().command else {
            panic!("{line}")
        };
        args.plans = Some(DEFAULT_PLANS);
        let said = args.request().unwrap_err().to_string();
        assert!(said.contains(&format!("{flag} is for a kit")), "{said}");
    }
}
