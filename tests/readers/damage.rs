//! Damages bytes in ways that files are damaged, and in ways that nobody expects.

/// Pieces that readers stumble over.
const PIECES: [&[u8]; 16] = [
    b"nan",
    b"-inf",
    b"1e999",
    b"-1",
    b"0",
    b"4294967296",
    b"99999999999999999999",
    b"\0",
    b"\xff\xfe",
    b"\r\n",
    b"\"",
    b"[[",
    b"]",
    b"=",
    b"<",
    b"\xe2\x82\xac",
];

/// Returns the bytes with up to five faults; the number decides which.
pub fn damaged(seed: &[u8], number: u64) -> Vec<u8> {
    let mut state = number.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut next = |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state % below.max(1) as u64) as usize
    };
    let mut bytes = seed.to_vec();
    for _ in 0..=next(5) {
        if bytes.is_empty() {
            break;
        }
        let at = next(bytes.len());
        let end = (at + 1 + next(64)).min(bytes.len());
        match next(9) {
            0 => bytes[at] = next(256) as u8,
            1 => bytes[at] ^= 1 << next(8),
            2 => bytes.truncate(at),
            3 => drop(bytes.drain(at..end)),
            4 => {
                let piece = bytes[at..end].to_vec();
                bytes.splice(at..at, piece);
            }
            5 => drop(bytes.splice(at..at, PIECES[next(PIECES.len())].iter().copied())),
            6 => drop(bytes.splice(at..end, PIECES[next(PIECES.len())].iter().copied())),
            7 => bytes[at..end].fill(next(256) as u8),
            _ => {
                let other = next(bytes.len());
                bytes.swap(at, other);
            }
        }
    }
    bytes
}
