//! `wasm-pack`, without its installer and its search for newer versions.

use clap::Parser;
use wasm_pack::{Cli, PBAR, command::run_wasm_pack};

fn main() -> anyhow::Result<()> {
    env_logger::init();
    let cli = Cli::parse();
    PBAR.set_log_level(cli.log_level);
    if cli.quiet {
        PBAR.set_quiet(true);
    }
    run_wasm_pack(cli.cmd)
}
