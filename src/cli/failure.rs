//! What a command reports when it cannot go on: a message, its place in the input if it has one, and the exit code.

use miette::{LabeledSpan, MietteDiagnostic, NamedSource, Report};
use std::fmt::Display;
use std::ops::Range;
use std::path::Path;
use std::process::ExitCode;

/// The end of a command without a result.
#[derive(Debug)]
pub struct Failure {
    report: Report,
    code: u8,
}

impl Failure {
    /// Something failed while running: exit code 1.
    pub fn running(message: impl Display) -> Failure {
        Failure { report: Report::new(MietteDiagnostic::new(message.to_string())), code: 1 }
    }

    /// The input is not what it must be: exit code 2.
    pub fn input(message: impl Display) -> Failure {
        Failure { code: 2, ..Failure::running(message) }
    }

    /// The input is not what it must be, at bytes `span` of `text`, read from `name`: exit code 2. The place is drawn with a caret.
    pub fn located(name: &str, text: &str, span: Range<usize>, message: impl Display, help: Option<String>) -> Failure {
        // A place at the end of the text must still lie in it to be drawn.
        let start = span.start.min(text.len());
        let label = LabeledSpan::at(start..span.end.clamp(start, text.len()), "here");
        let mut diagnostic = MietteDiagnostic::new(message.to_string()).with_label(label);
        diagnostic.help = help;
        let source = NamedSource::new(name, text.to_owned());
        Failure { report: Report::new(diagnostic).with_source_code(source), code: 2 }
    }

    /// A file that could not be read or written: exit code 2 for reading what the user named.
    pub fn file(path: &Path, error: impl Display) -> Failure {
        Failure::input(format!("{}: {error}", path.display()))
    }

    /// Adds advice to the message.
    #[must_use]
    pub fn help(self, help: impl Display) -> Failure {
        let message = self.report.to_string();
        let mut diagnostic = MietteDiagnostic::new(message);
        diagnostic.help = Some(help.to_string());
        Failure { report: Report::new(diagnostic), code: self.code }
    }

    /// Prints the report to standard error and gives the exit code.
    pub fn print(self) -> ExitCode {
        eprintln!("{:?}", self.report);
        ExitCode::from(self.code)
    }
}
