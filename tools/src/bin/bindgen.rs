//! `bindgen FILE FOLDER NAME` writes a module that cargo compiled, with its JavaScript glue and types
//! for browsers, by this name into a folder.

use anyhow::{Context, bail};
use wasm_bindgen_cli_support::Bindgen;

fn main() -> anyhow::Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [file, folder, name] = &words[..] else { bail!("expected FILE FOLDER NAME, found {words:?}") };
    let mut bindgen = Bindgen::new();
    // Where no source is stated, the module stands beside its glue: bundlers find it by that.
    bindgen.input_path(file).web(true)?.typescript(true).omit_default_module_path(false).out_name(name);
    bindgen.generate(folder).with_context(|| format!("{file} cannot be bound"))
}
