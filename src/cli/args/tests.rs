//! Command lines and the jobs they make.

mod plans;

use std::path::Path;

use clap::CommandFactory;

use super::*;
use crate::goal::{Contact, GoalKind, Objective, SpinPoint, TipChoice, Up};
use crate::job::{CutMode, ModelUnit, PartFormat, Scaling};

fn parse(line: &str) -> Result<Cli, clap::Error> {
    Cli::try_parse_from(line.split_whitespace())
}

fn request(line: &str) -> Request {
    match parse(line).unwrap().command {
        Command::Prepare(args) => args.request().unwrap(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_typed_line_of_an_order_ends_with_the_answers() {
    let Command::Prepare(mut args) = parse(PREPARE).unwrap().command else {
        panic!("{PREPARE}")
    };
    args.answered = vec!["--size=90mm".to_owned()];
    let typed = args.request().unwrap().typed;
    assert_eq!(typed.last().map(String::as_str), Some("--size=90mm"));
    let asked_nothing = request(PREPARE).typed;
    assert_eq!(typed[..typed.len() - 1], asked_nothing);
}

const PREPARE: &str = "equipoise prepare models/elephant.obj --printer objet-connex350 --goal top";

#[test]
fn the_definition_of_the_arguments_is_consistent() {
    Cli::command().debug_assert();
}

#[test]
fn hardware_and_the_weights_of_the_functional_reach_the_job() {
    let top = request(&format!(
        "{PREPARE} --tip 4mmx12mmx5mm --stem 5x30 --objective spin-it:0.5,2"
    ))
    .job
    .goal;
    assert_eq!(
        top.objective,
        Objective::SpinIt {
            gamma_c: 0.5,
            gamma_i: 2.0
        }
    );
    let hardware = top.hardware.unwrap();
    assert_eq!(
        (top.tip.to_string(), hardware.axle),
        ("4mmx12mmx5mm".to_owned(), None)
    );
    assert_eq!(request(PREPARE).job.goal.hardware, None);
}

#[test]
fn the_promises_of_a_top_reach_the_job_and_its_tip_may_be_left_out() {
    let plain = request(PREPARE).job.goal;
    assert_eq!(
        (plain.contact, plain.tip),
        (Some(Contact::Auto), TipChoice::Auto)
    );
    assert_eq!(plain.promised_lean_deg(), Some(10.0));
    let goal = request(&format!("{PREPARE} --tip none --least-lean 7.5"))
        .job
        .goal;
    assert_eq!((goal.tip, goal.least_lean_deg), (TipChoice::None, 7.5));
    assert_eq!(goal.promised_lean_deg(), Some(0.0));
    for wrong in [
        "--least-lean -1",
        "--least-lean 1e3",
        "--least-angle 4",
        "--least-lean 5mm",
    ] {
        let parsed = parse(&format!("{PREPARE} {wrong}")).map(|cli| match cli.command {
            Command::Prepare(args) => args.request().is_ok(),
            other => panic!("{other:?}"),
        });
        assert!(!parsed.unwrap_or(false), "{wrong}");
    }
}

#[test]
fn the_readme_command_makes_the_job_it_says() {
    let request = request(&format!(
        "{PREPARE} --up z --contact center --size 100mm --wall 1mm"
    ));
    let job = &request.job;
    assert_eq!(job.model.path, Path::new("models/elephant.obj"));
    assert_eq!(job.model.scaling, Scaling::Size("100mm".parse().unwrap()));
    assert_eq!((job.goal.kind, job.goal.up), (GoalKind::Top, Up::Z));
    assert_eq!(job.goal.contact, Some(Contact::Center));
    assert_eq!(job.goal.objective, Objective::CriticalSpeed);
    assert_eq!(job.wall.unwrap().mm(), 1.0);
    assert_eq!(
        (request.out.as_path(), request.force),
        (Path::new("elephant-top"), false)
    );
}

#[test]
fn missing_arguments_get_the_documented_defaults() {
    let job = request(PREPARE).job;
    assert_eq!(job.model.scaling, Scaling::Unit(ModelUnit::Mm));
    assert_eq!(
        (job.goal.up, job.goal.contact, job.goal.spin_point),
        (Up::Natural, Some(Contact::Auto), None)
    );
    let rotor = request(&PREPARE.replace("top", "balance")).job.goal;
    assert_eq!(rotor.up, Up::Natural);
    assert_eq!(
        (job.wall, job.pitch, job.printer.material),
        (None, None, None)
    );
    assert_eq!((job.cut, job.format), (CutMode::Auto, PartFormat::Both));
}

#[test]
fn directions_may_begin_with_a_minus_sign() {
    let up = |up: &str| request(&format!("{PREPARE} {up}")).job.goal.up;
    assert_eq!(up("--up=-0.1,-0.19,0.98"), Up::Along([-0.1, -0.19, 0.98]));
    assert_eq!(up("--up -0.1,-0.19,0.98"), Up::Along([-0.1, -0.19, 0.98]));
    assert_eq!(up("--up -y"), Up::NegY);
    assert_eq!(up("--up=-y"), Up::NegY);
    assert_eq!(up("--up principal"), Up::Principal);
}

#[test]
fn every_argument_arrives_in_the_job() {
    let line = "equipoise prepare m.stl --printer my.toml --material pla --goal yoyo --up x --spin-point -1,2,3 \
                --objective dominance --scale 2.5 --wall 0.1cm --pitch 0.2 --cut never --out k --force --format stl";
    let request = request(line);
    let job = &request.job;
    assert_eq!(
        (job.printer.id.as_str(), job.printer.material.as_deref()),
        ("my.toml", Some("pla"))
    );
    assert_eq!(job.goal.spin_point, Some(SpinPoint::At([-1.0, 2.0, 3.0])));
    assert_eq!(job.goal.objective, Objective::Dominance);
    assert_eq!(job.model.scaling, Scaling::Factor(2.5));
    assert_eq!(
        (job.wall.unwrap().mm(), job.pitch.unwrap().mm()),
        (1.0, 0.2)
    );
    assert_eq!((job.cut, request.force), (CutMode::Never, true));
    assert_eq!(request.out, Path::new("k"));
}

#[test]
fn bad_arguments_are_refused_with_exit_code_2_and_clear_words() {
    let cases = [
        ("--size 100mm --scale 2", "cannot be used with"),
        ("--unit in --scale 2", "cannot be used with"),
        ("--wall -1mm", "`-1mm` is not a positive, finite length"),
        ("--wall 0", "`0` is not a positive, finite length"),
        ("--wall nan", "`nan` is not a positive, finite length"),
        ("--wall 1furlong", "`furlong` in `1furlong` is not a unit"),
        ("--size inf", "positive, finite"),
        ("--scale 0", "`0` is not a positive, finite factor"),
        ("--scale -2", "`-2` is not a positive, finite factor"),
        ("--scale NaN", "`NaN` is not a positive, finite factor"),
        ("--up 0,0,0", "has no direction"),
        ("--up nan,0,1", "not finite"),
        ("--up", "a value is required"),
        ("--up --contact", "`--contact` is not a direction"),
        ("--contact highest", "is not a contact point"),
        ("--unit ft", "possible values: mm, cm, m, in"),
        ("--objective fastest", "invalid value 'fastest'"),
        ("--threads 0", "invalid value '0'"),
        ("--threads 100000", "invalid value '100000'"),
        ("--wal 1", "a similar argument exists: '--wall'"),
        ("-q -v", "cannot be used with"),
        ("--job job.toml", "cannot be used with"),
        ("second.stl", "unexpected argument 'second.stl'"),
    ];
    for (arguments, says) in cases {
        let error = parse(&format!("{PREPARE} {arguments}")).expect_err(arguments);
        assert_eq!(error.exit_code(), 2, "{arguments}");
        assert!(error.to_string().contains(says), "{arguments}: {error}");
    }
}

#[test]
fn required_arguments_are_asked_for() {
    for (line, says) in [
        ("equipoise prepare m.stl --printer prusa-mk4", "the goal"),
        (
            "equipoise prepare --printer prusa-mk4 --goal top",
            "the model",
        ),
    ] {
        let Command::Prepare(args) = parse(line).unwrap().command else {
            panic!("{line}")
        };
        let error = args.request().unwrap_err().to_string();
        assert!(error.contains(says), "{line}: {error}");
        let typed = "type equipoise prepare";
        assert!(error.contains(typed), "{line}: {error}");
    }
    for (line, says) in [
        (
            "equipoise prepare m.stl --printer prusa-mk4 --goal chair",
            "possible values: top, yoyo, stand, float, balance",
        ),
        (
            "equipoise prepare m.stl --printer prusa-mk4 --goal spin",
            "did you mean top or yoyo?",
        ),
        (
            "equipoise prepare m.stl --goal stnad",
            "did you mean `stand`?",
        ),
        ("equipoise frobnicate", "unrecognized subcommand"),
    ] {
        let error = parse(line).expect_err(line);
        assert_eq!(error.exit_code(), 2, "{line}");
        assert!(error.to_string().contains(says), "{line}: {error}");
    }
}

#[test]
fn parts_of_a_goal_that_do_not_go_together_are_refused() {
    for (arguments, says) in [
        (
            "--goal stand --objective spin-it",
            "use toppling-angle or lowest-center",
        ),
        (
            "--goal yoyo --contact lowest",
            "a contact point goes with the goal top, not with yoyo",
        ),
        (
            "--goal stand --spin-point center",
            "a spin point goes with the goal yoyo or balance",
        ),
        (
            "--goal stand --waterline 30mm",
            "a liquid or waterline goes with the goal float",
        ),
        (
            "--goal top --speed 3000",
            "a speed, grade or bore goes with the goal balance",
        ),
    ] {
        let line = format!("equipoise prepare m.stl --printer prusa-mk4 {arguments}");
        let Command::Prepare(args) = parse(&line).unwrap().command else {
            panic!("{line}")
        };
        let error = args.request().unwrap_err().to_string();
        assert!(error.contains(says), "{arguments}: {error}");
    }
}

#[test]
fn without_a_printer_the_shops_own_is_used_or_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("m.stl");
    let line = format!("equipoise prepare {} --goal top", model.display());
    let Command::Prepare(args) = parse(&line).unwrap().command else {
        panic!("{line}")
    };
    // The user who runs the tests may have an equipoise.toml.
    match args.request() {
        Err(error) => assert!(error.to_string().contains("equipoise.toml"), "{error}"),
        Ok(request) => assert!(!request.job.printer.id.is_empty()),
    }
    std::fs::write(
        folder.path().join("equipoise.toml"),
        "printer = \"prusa-mk4\"\nmaterial = \"asa\"\n",
    )
    .unwrap();
    let printer = request(&line).job.printer;
    assert_eq!(
        (printer.id.as_str(), printer.material.as_deref()),
        ("prusa-mk4", Some("asa"))
    );
    let printer = request(&format!("{line} --printer objet-connex350"))
        .job
        .printer;
    assert_eq!(
        (printer.id.as_str(), printer.material),
        ("objet-connex350", None)
    );
}

#[test]
fn a_job_is_replayed_and_its_model_may_lie_elsewhere() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("job.toml");
    let original = request(&format!("{PREPARE} --size 4in --wall 1.2")).job;
    std::fs::write(&path, original.to_toml().unwrap()).unwrap();
    let path = path.to_str().unwrap();
    let again = request(&format!("equipoise prepare --job {path} --out again"));
    assert_eq!(
        (again.job, again.out.as_path()),
        (original.clone(), Path::new("again"))
    );
    let moved = request(&format!("equipoise prepare other/b.obj --job {path}"));
    assert_eq!(moved.job.model.path, Path::new("other/b.obj"));
    assert_eq!(
        (moved.job.wall, moved.out.as_path()),
        (original.wall, Path::new("b-top"))
    );
}

#[test]
fn global_flags_stand_before_or_after_the_command() {
    for line in [
        "equipoise -q --threads 2 --json printers",
        "equipoise printers --json --threads 2 -q",
    ] {
        let global = parse(line).unwrap().global;
        assert!(global.quiet && global.json, "{line}");
        assert_eq!(global.threads, Some(2));
    }
    assert_eq!(
        parse("equipoise inspect a.stl -vv").unwrap().global.verbose,
        2
    );
}

#[test]
fn the_rules_for_seams_reach_the_job() {
    let plain = request(PREPARE).job;
    assert_eq!((plain.seam.word(), plain.keep_clear.len()), ("hidden", 0));
    assert_eq!(plain.least_part.to_string(), "2%");
    assert_eq!(plain.effort.word(), "normal");
    let line =
        "--seam level --least-part 5% --keep-clear -1,2,3,4 --keep-clear=0,0,9,1.5 --effort quick";
    let ruled = request(&format!("{PREPARE} {line}")).job;
    let balls: Vec<String> = ruled.keep_clear.iter().map(ToString::to_string).collect();
    assert_eq!((ruled.seam.word(), ruled.effort.word()), ("level", "quick"));
    assert_eq!(ruled.least_part.to_string(), "5%");
    assert_eq!(balls, ["-1,2,3,4", "0,0,9,1.5"]);
    let refused = parse(&format!("{PREPARE} --keep-clear 1,2,3")).unwrap_err();
    assert!(refused.to_string().contains("X,Y,Z,R"), "{refused}");
}

#[test]
fn numbers_take_the_units_that_people_type() {
    let line = "equipoise prepare m.stl --printer a --goal balance --speed 3000rpm --grade G1";
    let rotor = request(line).job.goal.rotor.unwrap();
    assert_eq!((rotor.speed_rpm, rotor.grade_mm_s), (3000.0, 1.0));
    let apart = ["equipoise", "m.stl", "--size", "100 mm"].map(Into::into);
    let Command::Prepare(args) = Cli::read(apart.to_vec()).unwrap().command else {
        panic!("a model is prepared")
    };
    assert_eq!(args.scaling.size, "100mm".parse().ok());
    let split = "equipoise m.stl --size 100 mm".split_whitespace();
    let error = Cli::read(split.map(Into::into).collect()).unwrap_err();
    assert!(error.to_string().ends_with("--size 100mm"), "{error}");
}

#[test]
fn the_short_helps_fit_on_a_screen_and_show_three_examples() {
    let mut program = Cli::program().term_width(80);
    program.build();
    let prepare = program.find_subcommand("prepare").unwrap().clone();
    for mut command in [program.clone(), prepare] {
        let help = command.render_help().to_string();
        assert!(help.lines().count() <= 24, "{help}");
        let (_, examples) = help.split_once("Examples:").unwrap();
        assert_eq!(examples.matches("  equipoise ").count(), 3, "{help}");
        let mut widths = help.lines().map(|line| line.chars().count());
        assert!(widths.all(|width| width <= 80), "{help}");
    }
}

#[test]
fn the_long_help_has_every_option_and_begins_with_what_is_needed() {
    let mut prepare = Cli::program().find_subcommand("prepare").unwrap().clone();
    let help = prepare.render_long_help().to_string();
    let options = prepare.get_arguments().filter_map(clap::Arg::get_long);
    for argument in options {
        assert!(help.contains(&format!("--{argument}")), "{argument}");
    }
    let at = |option: &str| help.find(&format!("      --{option} ")).unwrap();
    assert!(at("goal") < at("printer") && at("printer") < at("size"));
    assert!(at("size") < at("material") && at("size") < at("contact"));
}
