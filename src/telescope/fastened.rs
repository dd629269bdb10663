//! The ends of a telescope that other bodies hold.

/// The ends of a telescope that are fastened to other bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Fastened {
    /// The root lies in a socket: its cap has a flat, so that it fits one way.
    pub root: bool,
    /// The last mouth holds a peg: its bore has a key.
    pub tip: bool,
}
