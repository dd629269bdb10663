//! Packed files: Prusa's binary from an encoder of the test's own, and sliced packages.
