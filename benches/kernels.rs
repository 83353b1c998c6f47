//! `cargo bench`: the command `ltl-rover bench` in the bench profile. The WebAssembly build takes part if `LTL_ROVER_WASM` names it.

use clap::Parser;
use ltl_rover::cli::bench::Bench;
use std::process::ExitCode;

#[derive(Parser)]
struct Arguments {
    #[command(flatten)]
    bench: Bench,
}

fn main() -> ExitCode {
    // Cargo adds `--bench` and, after a filter, its text.
    let own = std::env::args().filter(|argument| argument != "--bench");
    let wasm = std::env::var("LTL_ROVER_WASM").map(|file| vec!["--wasm".to_owned(), file]).unwrap_or_default();
    match Arguments::try_parse_from(own.chain(wasm)) {
        Ok(arguments) => arguments.bench.run().unwrap_or_else(|failure| failure.print()),
        Err(error) => error.exit(),
    }
}
