//! Sealing altered kits: a forger makes the hashes anew.

use equipoise::base::digest::sha256_hex;
use equipoise::base::watch::Watch;
use equipoise::cut::CutOrder;
use equipoise::io::stl;
use equipoise::press::Layout;
use equipoise::sheet::Checklist;
use equipoise::verify::{Body, Fingerprint, read_kit, sums};
use serde_json::json;

use super::kits::{Kit, Room};

/// The pages of a kit, which bear the hash of its checklist.
const PAGES: [&str; 2] = ["job.html", "certificate.html"];

/// Renews the hashes and the fingerprints that the checklist has of the parts and of other files.
pub fn renew_checklist(kit: &mut Kit) {
    let mut sheet = kit.sheet();
    for part in sheet["parts"].as_array_mut().unwrap() {
        let bytes = &kit.files[part["file"].as_str().unwrap()];
        part["sha256"] = json!(sha256_hex(&[bytes]));
        if let Ok(mesh) = stl::decode(bytes) {
            part["fingerprint"] = json!(Fingerprint::of(&mesh));
        }
    }
    for (file, sha256) in sheet["files"].as_object_mut().unwrap() {
        *sha256 = json!(sha256_hex(&[&kit.files[file]]));
    }
    kit.set_sheet(&sheet);
    renew_list(kit);
}

/// Renews the hash of the checklist on the pages, and the list of all hashes.
pub fn renew_list(kit: &mut Kit) {
    let list = String::from_utf8(kit.files["SHA256SUMS"].clone()).unwrap();
    let old = list
        .lines()
        .find_map(|line| line.strip_suffix("  checklist.json"));
    let (old, new) = (old.unwrap(), sha256_hex(&[&kit.files["checklist.json"]]));
    for page in PAGES {
        let text = String::from_utf8(kit.files[page].clone()).unwrap();
        let text = text.replace(old, &new);
        kit.files.insert(page.to_owned(), text.into_bytes());
    }
    list_all(kit);
}

fn list_all(kit: &mut Kit) {
    kit.files.remove("SHA256SUMS");
    let files = kit.files.iter();
    let list = sums(files.map(|(file, bytes)| (file.as_str(), bytes.as_slice())));
    kit.files.insert("SHA256SUMS".to_owned(), list.into_bytes());
}

/// Prints the pictures and pages of a kit anew, as a forger who has the program does. Returns
/// nothing if they cannot be printed.
pub fn print_anew(kit: &mut Kit, room: &mut Room) -> Option<()> {
    room.lay_out(kit);
    let mut sheet: Checklist = serde_json::from_slice(&kit.files["checklist.json"]).ok()?;
    let evidence = read_kit(&room.path()).ok()?;
    let order = String::from_utf8(kit.files["cuts.toml"].clone()).ok()?;
    let order = CutOrder::from_toml("cuts.toml", &order).ok()?;
    let (body, watch) = (Body::of(&evidence.hollowed), Watch::silent());
    let layout = Layout {
        evidence: &evidence,
        body: &body,
        cuts: &order.cuts,
        partings: &order.partings().ok()?,
        uncut: &order.uncut,
    };
    let mut drawings = layout.draw_parts(&watch).ok()?;
    layout.draw_figures(&sheet, &mut drawings, &watch).ok()?;
    for picture in &drawings.pictures {
        let bytes = picture.bytes();
        sheet
            .files
            .insert(picture.file.clone(), sha256_hex(&[&bytes]));
        kit.files.insert(picture.file.clone(), bytes);
    }
    let json = sheet.to_json().ok()?.into_bytes();
    for (file, page) in drawings.print(&sheet, &sha256_hex(&[&json])) {
        kit.files.insert(file.to_owned(), page.into_bytes());
    }
    kit.files.insert("checklist.json".to_owned(), json);
    list_all(kit);
    Some(())
}
