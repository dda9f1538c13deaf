//! Runs one study; see `--help`.

use std::io;
use std::process::ExitCode;

use fissure_studies::studies;
use fissure_study::execute;

fn main() -> ExitCode {
    ExitCode::from(execute(
        &studies(),
        std::env::args_os(),
        &mut io::stdout(),
        &mut io::stderr(),
    ))
}
