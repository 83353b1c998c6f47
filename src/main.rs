//! The program `ltl-rover`: hands over to the command line.

fn main() -> std::process::ExitCode {
    ltl_rover::cli::main()
}
