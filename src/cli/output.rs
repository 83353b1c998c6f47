//! Standard output, whose reader may leave early: `ltl-rover run … | head` ends without a word.

use std::fmt::Arguments;
use std::io::{ErrorKind, Write, stdout};
use std::process::exit;

/// Writes to standard output. If its reader is gone the process ends with 0; if it cannot be written, with 1 and the reason.
pub fn write(text: Arguments<'_>) {
    if let Err(error) = stdout().lock().write_fmt(text) {
        if error.kind() == ErrorKind::BrokenPipe {
            exit(0);
        }
        eprintln!("standard output: {error}");
        exit(1);
    }
}

/// `print!` for [`write()`].
macro_rules! out {
    ($($text:tt)*) => { $crate::cli::output::write(format_args!($($text)*)) };
}

/// `println!` for [`write()`].
macro_rules! outln {
    ($($text:tt)*) => { $crate::cli::output::write(format_args!("{}\n", format_args!($($text)*))) };
}

pub(crate) use {out, outln};
