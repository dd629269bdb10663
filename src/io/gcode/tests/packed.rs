//! Packed files: Prusa's binary from an encoder of the test's own, and sliced packages.

use std::io::{Cursor, Write};

use super::*;

const PROGRAM: &str = "\
;LAYER_CHANGE
;HEIGHT:0.2
M83
G1 Z.2 F7200
;TYPE:External perimeter
G1 X10.5 Y-3.25 E.45
G3 X10.5 Y10 I2 J6.625 E1.5
M117 Hello there
T0
G1 X20 E9.875
";

/// Settings as a block holds them.
const SETTINGS: &str =
    "filament used [g]=1.25\nestimated printing time (normal mode)=1h 5s\nfilament_diameter=2.85\n";

/// The ways to pack a block, by their numbers in the format.
const PACKINGS: [u16; 4] = [0, 1, 2, 3];

/// Bits, from the highest of each byte on.
#[derive(Default)]
struct Bits {
    bytes: Vec<u8>,
    count: usize,
}

impl Bits {
    fn push(&mut self, value: usize, count: u32) {
        for bit in (0..count).rev() {
            if self.count.is_multiple_of(8) {
                self.bytes.push(0);
            }
            let last = self.bytes.last_mut().unwrap();
            *last |= ((value >> bit & 1) as u8) << (7 - self.count % 8);
            self.count += 1;
        }
    }
}

/// Packs by Heatshrink: the longest match of up to 16 bytes in the window, else a literal.
fn heatshrink(text: &[u8], window_bits: u32) -> Vec<u8> {
    let mut bits = Bits::default();
    let mut at = 0;
    while at < text.len() {
        let length_of = |distance: &usize| {
            let same = (0..16)
                .take_while(|n| at + n < text.len() && text[at + n] == text[at + n - distance]);
            same.count()
        };
        let distances = 1..=at.min(1 << window_bits);
        let best = distances
            .max_by_key(length_of)
            .filter(|distance| length_of(distance) > 1);
        match best {
            Some(distance) => {
                bits.push(0, 1);
                bits.push(distance - 1, window_bits);
                bits.push(length_of(&distance) - 1, 4);
                at += length_of(&distance);
            }
            None => {
                bits.push(1, 1);
                bits.push(usize::from(text[at]), 8);
                at += 1;
            }
        }
    }
    bits.bytes
}

/// Packs by MeatPack: commands two characters a byte, comments plain.
fn meatpack(text: &str, has_blanks: bool) -> Vec<u8> {
    let mut bytes = vec![0xff, 0xff, if has_blanks { 246 } else { 247 }];
    for line in text.split_inclusive('\n') {
        if line.starts_with(';') {
            bytes.extend([0xff, 0xff, 250]);
            bytes.extend(line.bytes());
            continue;
        }
        bytes.extend([0xff, 0xff, 251]);
        let is_move = line.starts_with('G');
        let line = if has_blanks || !is_move {
            line.to_owned()
        } else {
            line.replace(' ', "")
        };
        let code = |c: u8| match c {
            b'0'..=b'9' => c - b'0',
            b'.' => 10,
            b' ' if has_blanks => 11,
            b'E' if !has_blanks => 11,
            b'\n' => 12,
            b'G' => 13,
            b'X' => 14,
            _ => 15,
        };
        for pair in line.as_bytes().chunks(2) {
            let second = *pair.get(1).unwrap_or(&b'\n');
            let codes = [pair[0], second].map(code);
            bytes.push(codes[0] | codes[1] << 4);
            let whole = [pair[0], second].into_iter().zip(codes);
            bytes.extend(whole.filter(|(_, code)| *code == 15).map(|(c, _)| c));
        }
    }
    bytes
}

/// CRC-32 bit by bit, as its standard defines it.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |sum: u32, byte| {
        (0..8).fold(sum ^ u32::from(*byte), |sum, _| {
            if sum & 1 == 1 {
                sum >> 1 ^ 0xedb8_8320
            } else {
                sum >> 1
            }
        })
    })
}

/// Makes a block of a kind, packed in a way, with its parameters in front of the data.
fn block(kind: u16, packing: u16, parameters: &[u16], data: &[u8]) -> Vec<u8> {
    let packed = match packing {
        1 => {
            let level = flate2::Compression::default();
            let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), level);
            encoder.write_all(data).unwrap();
            encoder.finish().unwrap()
        }
        2 => heatshrink(data, 11),
        3 => heatshrink(data, 12),
        _ => data.to_vec(),
    };
    let mut bytes = [kind.to_le_bytes(), packing.to_le_bytes()].concat();
    bytes.extend((data.len() as u32).to_le_bytes());
    if packing != 0 {
        bytes.extend((packed.len() as u32).to_le_bytes());
    }
    bytes.extend(parameters.iter().flat_map(|word| word.to_le_bytes()));
    bytes.extend(packed);
    let sum = crc32(&bytes);
    bytes.extend(sum.to_le_bytes());
    bytes
}

/// Makes a binary file with a picture, settings, and the program in two blocks.
fn binary(packing: u16, encoding: u16) -> Vec<u8> {
    let encode = |text: &str| match encoding {
        0 => text.as_bytes().to_vec(),
        1 => meatpack(text, true),
        _ => meatpack(text, false),
    };
    let half = PROGRAM.find("G3").unwrap();
    let mut file = [b"GCDE".as_slice(), &[1, 0, 0, 0, 1, 0]].concat();
    file.extend(block(0, packing, &[0], b"Producer=PrusaSlicer 2.6.0\n"));
    file.extend(block(5, 0, &[0, 16, 16], b"a picture"));
    file.extend(block(2, packing, &[0], SETTINGS.as_bytes()));
    file.extend(block(1, packing, &[encoding], &encode(&PROGRAM[..half])));
    file.extend(block(1, packing, &[encoding], &encode(&PROGRAM[half..])));
    file
}

fn read_packed(bytes: &[u8]) -> Result<Vec<Plate>, GcodeError> {
    read_plates(Cursor::new(bytes), &Options::default(), &Watch::silent())
}

#[test]
fn a_binary_file_in_every_packing_is_read_as_its_text() {
    let plain = read(format!("; filament_diameter = 2.85\n{PROGRAM}")).unwrap();
    for packing in PACKINGS {
        for encoding in [0, 1, 2] {
            let plates = read_packed(&binary(packing, encoding)).unwrap();
            let found = &plates[0].toolpath;
            assert_eq!(found.objects, plain.objects, "{packing} {encoding}");
            assert_eq!(found.facts.print_time_s, Some(3605.0));
            assert_eq!(found.facts.filament_used_g, [1.25]);
            let generator = found.facts.generator.as_ref().unwrap();
            assert_eq!(generator.version.as_deref(), Some("2.6.0"));
        }
    }
}

#[test]
fn every_altered_byte_of_a_binary_file_is_found_by_its_checksum() {
    let whole = binary(3, 2);
    for at in 10..whole.len() {
        let mut altered = whole.clone();
        altered[at] ^= 0x10;
        let fault = read_packed(&altered).expect_err("a damaged file is refused");
        assert!(
            fault.to_string().starts_with("block "),
            "byte {at}: {fault}"
        );
    }
    for length in 0..whole.len() {
        // A file that ends between two blocks is a shorter file.
        if let Err(fault) = read_packed(&whole[..length]) {
            assert!(fault.to_string().contains("remedy: "), "{fault}");
        }
    }
}

#[test]
fn claims_of_a_binary_file_are_not_believed() {
    let header = [b"GCDE".as_slice(), &[1, 0, 0, 0, 0, 0]].concat();
    let says = |rest: &[u8]| {
        read_packed(&[&header, rest].concat())
            .unwrap_err()
            .to_string()
    };
    let huge = says(&[
        1, 0, 1, 0, 0xff, 0xff, 0xff, 0xff, 9, 0, 0, 0, 0, 0, 1, 2, 3,
    ]);
    assert!(
        huge.contains("block 1: it claims more than 64 MiB"),
        "{huge}"
    );
    let bomb = block(1, 1, &[0], &vec![b'\n'; 1 << 20]);
    let mut bomb = bomb[..bomb.len() - 4].to_vec();
    bomb[4..8].copy_from_slice(&100u32.to_le_bytes());
    assert!(says(&bomb).contains("does not unpack to its stated size"));
    assert!(says(&block(9, 0, &[0], b"x")).contains("kind is not known"));
    assert!(says(&block(1, 7, &[0], b"x")).contains("packing is not known"));
    assert!(says(&block(1, 0, &[8], b"x")).contains("encoding is not known"));
    let newer = read_packed(b"GCDE\x02\0\0\0\x01\0")
        .unwrap_err()
        .to_string();
    assert!(newer.contains("version 1"), "{newer}");
    assert!(says(b"").contains("it is empty"));
}

#[test]
fn mutated_binary_files_without_checksums_are_read_or_refused() {
    let mut whole = binary(2, 2);
    // Without checksums, the four bytes after each block would be read as a header: leave them out.
    whole.truncate(10);
    whole[8] = 0;
    for (packing, encoding) in [(0, 2), (1, 2), (2, 1), (3, 2)] {
        let bytes = meatpack(PROGRAM, encoding == 1);
        let block = block(1, packing, &[encoding], &bytes);
        let file = [&whole, &block[..block.len() - 4]].concat();
        for number in 0..500_usize {
            let mut altered = file.clone();
            let at = 10 + number * 37 % (file.len() - 10);
            altered[at] = altered[at].wrapping_add((1 + number / 7) as u8);
            let _ = read_packed(&altered);
        }
    }
}

/// Makes a package of these parts.
fn package(parts: &[(&str, &str)]) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in parts {
        let options = zip::write::SimpleFileOptions::default();
        zip.start_file(*name, options).unwrap();
        zip.write_all(text.as_bytes()).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

#[test]
fn a_sliced_package_gives_its_plates_with_the_names_of_objects() {
    let labelled = "; start printing object, unique label id: 15\nM83\n; FEATURE: Outer wall\n; LAYER_HEIGHT: 0.2\nG1 X9 Z.2 E1\n";
    let info = "<config><plate><object identify_id=\"15\" name=\"cube &amp; ball.stl\" skipped=\"false\" /></plate></config>";
    let bytes = package(&[
        ("3D/3dmodel.model", "<model/>"),
        ("Metadata/plate_10.gcode", PROGRAM),
        ("Metadata/plate_2.gcode", labelled),
        ("Metadata/plate_2.gcode.md5", "0123"),
        ("Metadata/slice_info.config", info),
    ]);
    let plates = read_packed(&bytes).unwrap();
    let numbers: Vec<Option<u32>> = plates.iter().map(|plate| plate.number).collect();
    assert_eq!(numbers, [Some(2), Some(10)]);
    assert!(plates[0].toolpath.object("cube & ball.stl").is_some());
    let plain = read(PROGRAM).unwrap();
    assert_eq!(plates[1].toolpath, plain);
}

#[test]
fn packages_that_are_not_sliced_or_are_bombs_are_refused() {
    let fault = read_packed(&package(&[("3D/3dmodel.model", "<model/>")])).unwrap_err();
    assert!(
        fault.to_string().contains("no plate in this 3MF is sliced"),
        "{fault}"
    );
    let bomb = "\n".repeat(48 << 20);
    let fault = read_packed(&package(&[("Metadata/plate_1.gcode", &bomb)])).unwrap_err();
    assert!(
        fault.to_string().contains("unpacks to more than 200 times"),
        "{fault}"
    );
    let damaged = package(&[("Metadata/plate_1.gcode", PROGRAM)]);
    for length in 0..damaged.len() {
        assert!(read_packed(&damaged[..length]).is_err());
    }
}

#[test]
fn a_file_is_opened_by_what_it_holds_and_faults_name_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    let read_file = || read_gcode(&path, &Options::default(), &Watch::silent());
    assert!(
        read_file()
            .unwrap_err()
            .to_string()
            .contains("cannot be opened")
    );
    std::fs::write(&path, binary(1, 2)).unwrap();
    assert_eq!(read_file().unwrap()[0].number, None);
    std::fs::write(&path, "G1 Xnan E1").unwrap();
    let fault = read_file().unwrap_err();
    assert!(
        fault
            .to_string()
            .contains("a.txt: the file holds no usable G-code")
    );
    let source = std::error::Error::source(&fault).unwrap().to_string();
    assert!(source.contains("line 1"), "{source}");
}
