//! What the program depends on: its licences, where it comes from, and what its builds do.
//!
//! The rules stand in `deny.toml`, which cargo-deny reads too.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// What a build script that downloads would name.
const NETWORK: [&str; 7] = [
    "TcpStream",
    "reqwest",
    "ureq",
    "curl",
    "wget",
    "http://",
    "ftp://",
];

/// Returns all packages that a build for this machine takes.
fn packages() -> Vec<Value> {
    let about = Command::new("rustc").arg("-vV").output().unwrap();
    let about = String::from_utf8(about.stdout).unwrap();
    let host = about.lines().find_map(|line| line.strip_prefix("host: "));
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--locked", "--offline", "--all-features"])
        .args(["--format-version", "1", "--filter-platform", host.unwrap()])
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let all: Value = serde_json::from_slice(&output.stdout).unwrap();
    let packages = all["packages"].as_array().unwrap().clone();
    assert!(packages.len() > 100);
    packages
}

fn name(package: &Value) -> String {
    format!(
        "{} {}",
        package["name"].as_str().unwrap(),
        package["version"].as_str().unwrap()
    )
}

/// Returns the licences that `deny.toml` allows.
fn allowed() -> Vec<String> {
    let text = fs::read_to_string("deny.toml").unwrap();
    let rules: toml::Table = text.parse().unwrap();
    let allowed = rules["licenses"]["allow"].as_array().unwrap();
    allowed
        .iter()
        .map(|one| one.as_str().unwrap().to_owned())
        .collect()
}

/// Returns whether an expression of licences can be met with those that are allowed.
fn is_met(expression: &str, allowed: &[String]) -> bool {
    // Some still write a slash for OR. No expression here has brackets within brackets.
    let expression = expression.replace(" / ", " OR ").replace('/', " OR ");
    let mut flat = expression.clone();
    while let (Some(open), Some(close)) = (flat.find('('), flat.find(')')) {
        let is_met = is_met(&flat[open + 1..close], allowed);
        let word = if is_met { &allowed[0] } else { "none" };
        flat.replace_range(open..=close, word);
    }
    let is_one = |name: &str| allowed.iter().any(|one| one == name.trim());
    flat.split(" OR ").any(|all| all.split(" AND ").all(is_one))
}

#[test]
fn every_licence_is_allowed() {
    let allowed = allowed();
    let wrong: Vec<String> = packages()
        .iter()
        .filter(|package| {
            !package["license"]
                .as_str()
                .is_some_and(|said| is_met(said, &allowed))
        })
        .map(|package| format!("{}: {}", name(package), package["license"]))
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn expressions_of_licences_are_understood() {
    let allowed = ["MIT", "Zlib"].map(str::to_owned);
    for met in [
        "MIT",
        "GPL-3.0 OR MIT",
        "MIT/Apache-2.0",
        "MIT AND Zlib",
        "(GPL-3.0 OR MIT) AND Zlib",
    ] {
        assert!(is_met(met, &allowed), "{met}");
    }
    for unmet in [
        "GPL-3.0",
        "MIT AND GPL-3.0",
        "(MIT OR Zlib) AND GPL-3.0",
        "",
    ] {
        assert!(!is_met(unmet, &allowed), "{unmet}");
    }
}

#[test]
fn everything_comes_from_the_registry_but_the_program_itself() {
    let strange = |package: &&Value| match package["source"].as_str() {
        None => package["name"] != "equipoise",
        Some(source) => !source.starts_with("registry+"),
    };
    let packages = packages();
    let wrong: Vec<String> = packages.iter().filter(strange).map(name).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn no_build_script_reaches_for_the_network() {
    let mut scripts = 0;
    for package in packages() {
        for target in package["targets"].as_array().unwrap() {
            let kinds = target["kind"].as_array().unwrap();
            if !kinds.iter().any(|kind| kind == "custom-build") {
                continue;
            }
            let text = fs::read_to_string(Path::new(target["src_path"].as_str().unwrap())).unwrap();
            scripts += 1;
            // Comments name the places where things are explained.
            let lines = text
                .lines()
                .filter(|line| !line.trim_start().starts_with("//"));
            let code: String = lines.collect();
            let found: Vec<&&str> = NETWORK
                .iter()
                .filter(|word| code.contains(**word))
                .collect();
            assert!(found.is_empty(), "{}: {found:?}", name(&package));
        }
    }
    assert!(scripts > 5);
}
