import type { Argument, Command, Table } from "./table.js";

/** Columns before the texts of the options. */
const INDENT = 10;

/** The help of the program, or of one command. */
export function help(table: Table, command: Command | null): string {
  return command === null ? programHelp(table) : commandHelp(command);
}

function programHelp({ about, commands }: Table): string {
  const width = Math.max(...commands.map(({ name }) => name.length));
  const lines = commands.map(({ name, about }) => `  ${name.padEnd(width)}  ${about ?? ""}`);
  return [about, "", "Usage: nurbs-hausdorff <COMMAND>", "", "Commands:", ...lines, ""].join("\n");
}

function commandHelp({ name, about, longAbout, arguments: positional, options }: Command): string {
  const names = positional.map(({ value }) => `<${value}>`).join(" ");
  return [
    longAbout ?? about ?? "",
    "",
    `Usage: nurbs-hausdorff ${name} [OPTIONS] ${names}`,
    "",
    "Arguments:",
    ...positional.flatMap((argument) => entry(`<${argument.value}>`, argument)),
    "Options:",
    ...options.flatMap((option) => {
      const value = option.type === "flag" ? "" : ` <${option.value}>`;
      return entry(`--${option.name}${value}`, option);
    }),
  ].join("\n");
}

function entry(title: string, argument: Argument): string[] {
  const notes = [
    argument.help ?? "",
    argument.default === undefined ? "" : `[default: ${argument.default}]`,
    argument.choices === undefined ? "" : `[possible values: ${argument.choices.join(", ")}]`,
  ];
  const indent = " ".repeat(INDENT);
  return [`  ${title}`, ...notes.filter(Boolean).map((note) => indent + note), ""];
}
