//! The `equipoise` command: parse, run, print, exit.

fn main() {}
