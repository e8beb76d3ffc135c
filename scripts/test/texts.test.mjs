// All that the page says stands in www/src/texts, so that another language can be added.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import ts from "typescript-oldest";
import { inRoot } from "../paths.mjs";

const SOURCES = inRoot("www", "src");
const PAGES = ["index.html", "experiments.html", "deforming.html"];

/** What has words and is read by no one: by file, and what it is. */
const CODE = [
  [
    /^scene\/(cap|material)\.ts$/,
    /opaque_fragment|float |across < |vec3\(|^ gl_|^, 1\.0|^, pow|projectionMatrix/,
  ],
  [/^export\/report\/style\.ts$/, /./],
  [/^export\/report\/report\.ts$/, /^<!doctype html>\n$/],
  [/^examples\/(bracket|faces)\.ts$/, /./],
  [/^files\/formats\.ts$/, /^\.step|^Rhino 3DM$|^FreeCAD$|^[A-Z]+$/],
  [/^worker\/map\/csv\.ts$/, /^side,face/],
  [/./, /^\((prefers|min-width)|^\[|^input\[|px system-ui|^http:\/\/www\.w3\.org/],
  [/./, /^\.{1,2}\/|^three\/addons|^@bitbybit-dev|^rhino3dm\/|^[\w-]*\.(csv|json|html)$/],
  [/^(state\/workplace|files\/kept)\.ts$/, /^(nurbs-hausdorff|file) $/],
  [/^scene\/picking\/tree\.ts$/, /^tree of a model$/],
  // Classes of elements, a style of letters, and errors of the page's own code.
  [/./, /^(pick-mark|hatch|italic) $|^annotation editor$/],
  [/./, /^the page has no |^there is no (pair|method) $/],
  // Events that say that something is dragged.
  [/^common\/drop\.ts$/, /^Files$/],
  // Units are the same in all languages.
  [/./, /^ (s|ms|m)$/],
];

/** Whether a text has two words, a capital word, or a word before a mark: names in code have none of these. */
const isSaid = (text) =>
  /[A-Za-z]{2,}[^A-Za-z]* [^ ]*[A-Za-z]/.test(text) ||
  /^[^A-Za-z]*[A-Z][a-z]+/.test(text) ||
  /[a-z]{2,}[….:,;!?]/.test(text) ||
  / [a-z]+|[a-z]{2,} /.test(text);

/** What an element shows or is called by: one word is said there too. */
const SHOWN =
  /^(textContent|innerText|title|placeholder|ariaLabel|aria-label|aria-description|alt)$/;

const isText = (node) =>
  ts.isStringLiteralLike(node) ||
  ts.isTemplateHead(node) ||
  ts.isTemplateMiddle(node) ||
  ts.isTemplateTail(node);

/** Whether a text is compared with, a key, or a type. */
function isName(node) {
  const { parent } = node;
  const isCompared =
    ts.isBinaryExpression(parent) && /^[=!]==?$/.test(parent.operatorToken.getText());
  const isKey = ts.isPropertyAssignment(parent) && parent.name === node;
  return isCompared || isKey || ts.isCaseClause(parent) || ts.isLiteralTypeNode(parent);
}

/** Whether a node is assigned to what an element shows, or is its attribute. */
function isShown(node) {
  if (ts.isBinaryExpression(node)) {
    const { left, operatorToken } = node;
    return (
      operatorToken.kind === ts.SyntaxKind.EqualsToken &&
      ts.isPropertyAccessExpression(left) &&
      SHOWN.test(left.name.text)
    );
  }
  if (ts.isPropertyAssignment(node)) return SHOWN.test(node.name.getText().replaceAll('"', ""));
  return (
    ts.isCallExpression(node) &&
    /\.setAttribute$/.test(node.expression.getText()) &&
    SHOWN.test(node.arguments[0]?.text ?? "")
  );
}

/** The texts of a module that someone reads. */
function saidIn(name, source) {
  const file = ts.createSourceFile(name, source, ts.ScriptTarget.Latest, true);
  const found = [];
  const visit = (node, shown) => {
    if (ts.isImportDeclaration(node) || ts.isExportDeclaration(node) || ts.isTypeNode(node)) return;
    if (isText(node) && !isName(node)) {
      const isWord = shown && /[A-Za-z]{2,}/.test(node.text) && !SHOWN.test(node.text);
      const isCode = CODE.some(([where, what]) => where.test(name) && what.test(node.text));
      if ((isWord || isSaid(node.text)) && !isCode) {
        const { line } = file.getLineAndCharacterOfPosition(node.getStart());
        found.push(`${name}:${line + 1}: ${node.text}`);
      }
    }
    // What is called with a text says something else.
    const inside = (shown && !ts.isCallExpression(node)) || isShown(node);
    ts.forEachChild(node, (child) => visit(child, inside));
  };
  visit(file, false);
  return found;
}

const modules = readdirSync(SOURCES, { recursive: true })
  .filter((name) => name.endsWith(".ts") && !name.endsWith(".d.ts"))
  .map((name) => [name, readFileSync(`${SOURCES}/${name}`, "utf8")]);

test("no module says anything but the texts", () => {
  const others = modules.filter(([name]) => !name.startsWith("texts/"));
  assert.ok(others.length > 200, `${others.length}`);
  assert.deepEqual(
    others.flatMap(([name, source]) => saidIn(name, source)),
    [],
  );
});

test("what says something is found, wherever it stands", () => {
  for (const source of [
    'export const a = "Open two files";',
    `export const a = (n) => \`\${n} files of\`;`,
    'node.textContent = isOpen ? "open" : "";',
    'node.setAttribute("aria-label", "close");',
    'make("button", [], { title: "close" });',
    'throw new Error("Nothing is there.");',
  ]) {
    assert.equal(saidIn("a.ts", source).length, 1, source);
  }
  for (const source of [
    'import { a } from "./some file.ts";',
    'if (key === "Escape") end();',
    'element("canvas").dataset.state = "done";',
    'type Kind = "two words";',
  ]) {
    assert.deepEqual(saidIn("a.ts", source), [], source);
  }
});

/** What a page says outside of names in braces. */
function saidOnPage(html) {
  const body = html.replace(/<svg id="icons"[\s\S]*?<\/svg>\n/, "").replace(/<!--[\s\S]*?-->/g, "");
  const attributes = [...body.matchAll(/\b(title|aria-label|placeholder|data-tip|alt)="([^"]*)"/g)];
  const between = body.replace(/<script[\s\S]*?<\/script>/g, "").split(/<[^>]+>/);
  return [...attributes.map(([, , value]) => value), ...between]
    .map((text) => text.replace(/\{\{[\w.]+\}\}/g, "").trim())
    .filter((text) => /[A-Za-z]{2,}/.test(text));
}

test("no page says anything but the texts that it names, and every text is said", () => {
  const pages = PAGES.map((name) => readFileSync(inRoot("www", name), "utf8"));
  for (const [index, page] of pages.entries()) assert.deepEqual(saidOnPage(page), [], PAGES[index]);
  assert.equal(saidOnPage('<p title="close">Open <b>two</b></p>').length, 3);
  const all = pages.join("\n");
  const code = modules
    .filter(([name]) => !name.startsWith("texts/"))
    .map(([, source]) => source)
    .join("\n");
  for (const [name, source] of modules) {
    if (!/^texts\/en\/(page\/)?\w+\.ts$/.test(name) || name.endsWith("index.ts")) continue;
    for (const [, key] of source.matchAll(/^ {2}(\w+):/gm)) {
      const page = /page\/(\w+)\.ts$/.exec(name)?.[1];
      const isSaidSomewhere =
        page === undefined
          ? new RegExp(`\\.${key}\\b`).test(code)
          : all.includes(`{{${page}.${key}}}`);
      assert.ok(isSaidSomewhere, `${name}: ${key}`);
    }
  }
});
