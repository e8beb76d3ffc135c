//! The table of commands and options that the package's command line in Node reads, so
//! that both command lines have one definition: [`Arguments`].

use crate::arguments::Arguments;
use crate::arguments::motion::{Rotation, Translation};
use clap::{Arg, ArgAction, Command, CommandFactory};
use serde_json::{Map, Value, json};
use std::any::TypeId;
use std::path::PathBuf;

/// The committed table.
const TABLE: &str = include_str!("../../../js/cli/options.json");
/// Its file, and the variable of the environment that has it written anew.
const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src/js/cli/options.json");
const UPDATE: &str = "UPDATE_OPTIONS_TABLE";

fn text(text: Option<&clap::builder::StyledStr>) -> Value {
    text.map_or(Value::Null, |text| json!(text.to_string()))
}

/// The type of an argument's value, by which the other command line parses it.
fn kind(argument: &Arg) -> &'static str {
    let id = argument.get_value_parser().type_id();
    let numbers = [
        (TypeId::of::<f64>(), "number"),
        (TypeId::of::<usize>(), "integer"),
        (TypeId::of::<u32>(), "integer"),
        (TypeId::of::<PathBuf>(), "path"),
        (TypeId::of::<String>(), "text"),
        (TypeId::of::<Translation>(), "translation"),
        (TypeId::of::<Rotation>(), "rotation"),
    ];
    if matches!(argument.get_action(), ArgAction::SetTrue) {
        return "flag";
    }
    numbers.iter().find(|(known, _)| id == *known).map_or("choice", |(_, name)| name)
}

fn argument(argument: &Arg) -> Value {
    let mut entry = Map::new();
    entry.insert("name".into(), json!(argument.get_long().unwrap_or(argument.get_id().as_str())));
    entry.insert("type".into(), json!(kind(argument)));
    entry.insert("help".into(), text(argument.get_help()));
    if argument.is_required_set() {
        entry.insert("required".into(), json!(true));
    }
    if kind(argument) != "flag" {
        let name = argument.get_value_names().and_then(<[_]>::first);
        entry.insert("value".into(), json!(name.map_or_else(String::new, ToString::to_string)));
    }
    let choices: Vec<String> =
        argument.get_possible_values().iter().map(|value| value.get_name().to_owned()).collect();
    if kind(argument) == "choice" {
        entry.insert("choices".into(), json!(choices));
    }
    let defaults = argument.get_default_values();
    if let Some(default) = defaults.first().filter(|_| kind(argument) != "flag") {
        entry.insert("default".into(), json!(default.to_string_lossy()));
    }
    entry.into()
}

fn command(command: &Command) -> Value {
    let (positional, options): (Vec<&Arg>, Vec<&Arg>) = command
        .get_arguments()
        .filter(|argument| !matches!(argument.get_id().as_str(), "help" | "version"))
        .partition(|argument| argument.is_positional());
    json!({
        "name": command.get_name(),
        "about": text(command.get_about()),
        "longAbout": text(command.get_long_about()),
        "arguments": positional.into_iter().map(argument).collect::<Vec<_>>(),
        "options": options.into_iter().map(argument).collect::<Vec<_>>(),
    })
}

#[test]
fn the_table_of_options_is_that_of_the_arguments() {
    let mut arguments = Arguments::command();
    arguments.build();
    let commands: Vec<Value> =
        arguments.get_subcommands().filter(|one| one.get_name() != "help").map(command).collect();
    let table = json!({ "about": text(arguments.get_about()), "commands": commands });
    if std::env::var_os(UPDATE).is_some() {
        let written = serde_json::to_string_pretty(&table).map(|text| std::fs::write(FILE, text + "\n"));
        assert!(matches!(written, Ok(Ok(()))), "{FILE} cannot be written");
        return;
    }
    let committed: Result<Value, _> = serde_json::from_str(TABLE);
    assert_eq!(committed.ok(), Some(table), "run the test with {UPDATE}=1 to write the table anew");
}
