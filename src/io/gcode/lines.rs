//! Reads lines in bounded memory, whatever their length.

use std::io::{BufRead, Read};

use super::error::{GcodeError, Limit, from_io};

/// Bytes of a comment that are kept. Notes for slicers are shorter; settings that hold whole
/// programs of the machine are not needed.
const KEPT_COMMENT: usize = 4096;

/// The lines of a text, one after the other.
pub struct Lines<R> {
    input: R,
    line: Vec<u8>,
    number: u64,
}

impl<R: BufRead> Lines<R> {
    /// Starts before the first line.
    pub fn new(input: R) -> Self {
        Self {
            input,
            line: Vec::new(),
            number: 0,
        }
    }

    /// Reads the next line without its end; `None` at the end of the text.
    ///
    /// A comment is cut at 4096 bytes. A command that is too long is a fault.
    pub fn next_line(&mut self) -> Result<Option<&[u8]>, GcodeError> {
        self.line.clear();
        self.number += 1;
        let mut is_begun = false;
        loop {
            let number = self.number;
            let chunk = match self.input.fill_buf() {
                Err(error) if error.kind() == std::io::ErrorKind::Interrupted => continue,
                chunk => chunk.map_err(|error| from_io(error, number))?,
            };
            if chunk.is_empty() {
                self.number -= u64::from(!is_begun);
                return Ok(is_begun.then_some(&self.line));
            }
            is_begun = true;
            let end = chunk.iter().position(|&byte| byte == b'\n');
            let piece = &chunk[..end.unwrap_or(chunk.len())];
            keep(&mut self.line, piece).map_err(|limit| GcodeError::TooMuch {
                line: number,
                limit,
            })?;
            let used = piece.len() + usize::from(end.is_some());
            self.input.consume(used);
            if end.is_some() {
                return Ok(Some(&self.line));
            }
        }
    }
}

/// Reads a whole line without its end; returns false at the end of the text.
///
/// # Errors
/// The text cannot be read, or the line has more than `most` bytes (`FileTooLarge`).
pub fn read_whole(
    input: &mut impl BufRead,
    line: &mut Vec<u8>,
    most: u64,
) -> std::io::Result<bool> {
    line.clear();
    let read = input.by_ref().take(most + 1).read_until(b'\n', line)?;
    if line.last() == Some(&b'\n') {
        line.pop();
    } else if read as u64 > most {
        return Err(std::io::ErrorKind::FileTooLarge.into());
    }
    Ok(read > 0)
}

/// Adds a piece to a line as far as it is needed.
fn keep(line: &mut Vec<u8>, piece: &[u8]) -> Result<(), Limit> {
    let first = line.iter().chain(piece).find(|byte| **byte != b' ');
    let is_comment = first == Some(&b';');
    let most = if is_comment {
        KEPT_COMMENT
    } else {
        Limit::Line.most() as usize
    };
    let room = most.saturating_sub(line.len());
    if piece.len() > room && !is_comment {
        return Err(Limit::Line);
    }
    line.extend(&piece[..piece.len().min(room)]);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::BufReader;

    fn lines(text: &[u8], buffer: usize) -> Result<Vec<Vec<u8>>, GcodeError> {
        let mut lines = Lines::new(BufReader::with_capacity(buffer, text));
        let mut all = Vec::new();
        while let Some(line) = lines.next_line()? {
            all.push(line.to_vec());
        }
        assert_eq!(lines.number, all.len() as u64);
        Ok(all)
    }

    #[test]
    fn lines_are_the_same_whatever_the_buffer() {
        let text = b"G1 X1\n\n;abc\r\nG1 Y2";
        let want: Vec<&[u8]> = vec![b"G1 X1", b"", b";abc\r", b"G1 Y2"];
        for buffer in [1, 2, 3, 7, 100] {
            assert_eq!(lines(text, buffer).unwrap(), want);
        }
        assert!(lines(b"", 4).unwrap().is_empty());
    }

    #[test]
    fn a_long_comment_is_cut_and_a_long_command_is_a_fault() {
        let comment = [b" ;".as_slice(), &vec![b'x'; 1 << 20], b"\nG1"].concat();
        let read = lines(&comment, 1000).unwrap();
        assert_eq!(
            (read[0].len(), read[1].as_slice()),
            (KEPT_COMMENT, b"G1".as_slice())
        );
        let command = [b"G1\n".as_slice(), &vec![b'1'; 1 << 20]].concat();
        let fault = lines(&command, 1000).unwrap_err().to_string();
        assert!(fault.contains("line 2: the line is longer"), "{fault}");
    }
}
