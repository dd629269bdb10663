//! `equipoise completions` and `equipoise man`: made from the definition of the arguments.

use std::io::Write;

use clap::CommandFactory;
use clap_complete::Shell;
use clap_mangen::Man;

use super::args::Cli;

/// A reason why no completions or manual page are printed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ManualError {
    /// There is no such command.
    #[error("there is no command {0}; remedy: see equipoise help")]
    Unknown(String),
    /// The standard output is closed.
    #[error("cannot write to the standard output")]
    Output(#[from] std::io::Error),
}

/// Writes the completion script of a shell.
pub fn completions(shell: Shell, out: &mut dyn Write) -> Result<(), ManualError> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "equipoise", &mut script);
    Ok(out.write_all(&script)?)
}

/// Writes the manual page of the program, or of the command of that name, as troff.
pub fn page(command: Option<&str>, out: &mut dyn Write) -> Result<(), ManualError> {
    let mut program = Cli::command();
    program.build();
    let page = match command {
        None => program.clone(),
        Some(name) => program
            .find_subcommand(name)
            .ok_or_else(|| ManualError::Unknown(name.to_owned()))?
            .clone(),
    };
    let mut text = Vec::new();
    Man::new(page).render(&mut text)?;
    Ok(out.write_all(&text)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shell_has_completions_that_know_the_commands() {
        for shell in [
            Shell::Bash,
            Shell::Zsh,
            Shell::Fish,
            Shell::PowerShell,
            Shell::Elvish,
        ] {
            let mut script = Vec::new();
            completions(shell, &mut script).unwrap();
            let script = String::from_utf8(script).unwrap();
            for word in ["prepare", "verify", "spin-point"] {
                assert!(script.contains(word), "{shell}: {word}");
            }
        }
    }

    #[test]
    fn the_program_and_each_of_its_commands_have_a_page() {
        let commands = Cli::command();
        let names = commands
            .get_subcommands()
            .map(|command| Some(command.get_name()));
        for name in names.chain([None]) {
            let mut text = Vec::new();
            page(name, &mut text).unwrap();
            let text = String::from_utf8(text).unwrap();
            assert!(
                text.contains(".TH equipoise") && text.contains(".SH SYNOPSIS"),
                "{name:?}: {text}"
            );
        }
        let error = page(Some("frobnicate"), &mut Vec::new()).unwrap_err();
        assert!(error.to_string().contains("no command frobnicate"));
    }
}
