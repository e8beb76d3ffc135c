// The labels of annotations on a picture of the view.
import type { DrawnLabel } from "./layer.ts";

/** Pixels of a label: its text, its lines, its padding and its point. */
const FONT = 13;
const LINE = 18;
const PADDING = 8;
const POINT = 4;
const INK = "#16202b";
const PAPER = "#ffffff";
const MARK = "#8a2be2";

/** Returns the picture with its labels: a picture has no other way to show them. */
export function labelled(
  canvas: HTMLCanvasElement,
  labels: readonly DrawnLabel[],
): HTMLCanvasElement {
  if (labels.length === 0) return canvas;
  const picture = document.createElement("canvas");
  Object.assign(picture, { width: canvas.width, height: canvas.height });
  const context = picture.getContext("2d");
  if (context === null) return canvas;
  context.drawImage(canvas, 0, 0);
  const ratio = canvas.width / (canvas.clientWidth || canvas.width);
  context.scale(ratio, ratio);
  for (const label of labels) drawLabel(context, label);
  return picture;
}

function drawLabel(context: CanvasRenderingContext2D, label: DrawnLabel): void {
  const { at, corner, size, number, text } = label;
  const [left, top] = corner;
  context.strokeStyle = MARK;
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(...at);
  context.lineTo(at[0] < left ? left : Math.min(at[0], left + size[0]), top + size[1] / 2);
  context.stroke();
  context.fillStyle = PAPER;
  context.beginPath();
  context.roundRect(left, top, ...size, 6);
  context.fill();
  context.stroke();
  context.beginPath();
  context.arc(...at, POINT, 0, 2 * Math.PI);
  context.fillStyle = MARK;
  context.fill();
  context.font = `600 ${FONT}px system-ui, sans-serif`;
  context.textBaseline = "middle";
  context.fillText(`${number}`, left + PADDING, top + PADDING + LINE / 2);
  const indent = context.measureText(`${number}`).width + PADDING;
  context.font = `${FONT}px system-ui, sans-serif`;
  context.fillStyle = INK;
  const room = size[0] - 2 * PADDING - indent;
  for (const [row, line] of linesOf(context, text, room).entries()) {
    context.fillText(line, left + PADDING + indent, top + PADDING + (row + 0.5) * LINE);
  }
}

/** The text in lines that have room. */
function linesOf(context: CanvasRenderingContext2D, text: string, room: number): string[] {
  return text.split("\n").flatMap((paragraph) => {
    const lines: string[] = [];
    let line = "";
    for (const word of paragraph.split(" ")) {
      const longer = line === "" ? word : `${line} ${word}`;
      if (line !== "" && context.measureText(longer).width > room + 1) {
        lines.push(line);
        line = word;
      } else line = longer;
    }
    return [...lines, line];
  });
}
