//! The kernels' text as short as it can be without another meaning, since the
//! wasm module carries it to every visitor: without comments and needless
//! spaces, and with one letter for every parameter and variable of a function.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=shaders");
    let out = env::var_os("OUT_DIR").ok_or(io::ErrorKind::NotFound)?;
    for entry in fs::read_dir("shaders")? {
        let path = entry?.path();
        let text = fs::read_to_string(&path)?;
        if let Some(name) = path.file_name() {
            fs::write(Path::new(&out).join(name), shortened(&text))?;
        }
    }
    Ok(())
}

fn shortened(text: &str) -> String {
    let code: Vec<&str> = text.lines().filter(|line| !line.trim_start().starts_with("//")).collect();
    let mut tokens = tokens(&code.join("\n"));
    let mut from = 0;
    while let Some(start) = tokens[from..].iter().position(|token| token == "fn") {
        let start = from + start;
        from = function_end(&tokens, start);
        rename(&mut tokens[start..from]);
    }
    joined(&tokens)
}

/// Words with their digits, and all other characters one by one; a space only
/// between two of the latter.
fn tokens(text: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let mut parted = true;
    for c in text.chars() {
        if c.is_whitespace() {
            parted = true;
            continue;
        }
        match tokens.last_mut() {
            Some(last) if !parted && is_word(last) && in_word(c) => last.push(c),
            Some(last) if !parted && !is_word(last) && !in_word(c) && is_operator(last) => last.push(c),
            _ => tokens.push(c.to_string()),
        }
        parted = false;
    }
    tokens
}

fn in_word(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

fn is_word(token: &str) -> bool {
    token.ends_with(in_word)
}

fn is_operator(token: &str) -> bool {
    !token.ends_with(['(', ')', '{', '}', '[', ']', ',', ';', ':', '.', '@'])
}

fn joined(tokens: &[String]) -> String {
    let mut text = String::new();
    for token in tokens {
        let both_words = is_word(&text) && is_word(token);
        let both_operators = !text.is_empty()
            && !is_word(&text)
            && is_operator(&text)
            && !is_word(token)
            && is_operator(token);
        if both_words || both_operators {
            text.push(' ');
        }
        text.push_str(token);
    }
    text + "\n"
}

/// Where the function ends that starts there.
fn function_end(tokens: &[String], start: usize) -> usize {
    let mut depth = 0;
    for (index, token) in tokens.iter().enumerate().skip(start) {
        match token.as_str() {
            "{" => depth += 1,
            "}" if depth == 1 => return index + 1,
            "}" => depth -= 1,
            _ => {}
        }
    }
    tokens.len()
}

/// Gives one-letter names to what the function declares, none of which is a
/// word in it already: whatever it uses of other files keeps its meaning.
fn rename(function: &mut [String]) {
    let words: BTreeSet<String> = function.iter().cloned().collect();
    let head = function.iter().position(|token| token == "{").unwrap_or(0);
    let declared = (1..function.len()).filter(|&at| match function[at - 1].as_str() {
        "let" | "var" => true,
        _ => at < head && function.get(at + 1).is_some_and(|next| next == ":"),
    });
    let mut free = ('a'..='z').chain('A'..='Z').map(String::from).filter(|letter| !words.contains(letter));
    let mut names: BTreeMap<String, String> = BTreeMap::new();
    for at in declared.collect::<Vec<_>>() {
        let name = &function[at];
        // A function of the same name may be called before, as `length` is.
        let called = function.windows(2).any(|pair| pair[0] == *name && pair[1] == "(");
        if name.len() > 1 && !called && !names.contains_key(name) {
            names.extend(free.next().map(|letter| (name.clone(), letter)));
        }
    }
    for at in 1..function.len() {
        // Members keep their names.
        if function[at - 1] != "."
            && let Some(name) = names.get(&function[at])
        {
            function[at] = name.clone();
        }
    }
}
