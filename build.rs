//! The kernels' text without comments, indentation and most spaces, which the
//! wasm module would carry to every visitor.

use std::path::Path;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=shaders");
    let out = env::var_os("OUT_DIR").ok_or(io::ErrorKind::NotFound)?;
    for entry in fs::read_dir("shaders")? {
        let path = entry?.path();
        let text = fs::read_to_string(&path)?;
        let code = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with("//"));
        let bare = code.fold(String::new(), |text, line| text + &squeezed(line) + "\n");
        if let Some(name) = path.file_name() {
            fs::write(Path::new(&out).join(name), bare)?;
        }
    }
    Ok(())
}

/// Without the spaces that part no two tokens.
fn squeezed(line: &str) -> String {
    let spaced =
        [(", ", ","), (": ", ":"), ("; ", ";"), (" {", "{"), (" * ", "*"), (" + ", "+"), (" && ", "&&")];
    spaced.iter().fold(line.to_owned(), |line, (token, bare)| line.replace(token, bare))
}
