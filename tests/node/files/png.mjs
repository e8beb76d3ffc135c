// A reader of PNG for tests: ISO/IEC 15948 with 8 bits of red, green and blue.
import assert from "node:assert/strict";
import { inflateSync } from "node:zlib";

/** The width, the height and the pixels of a file, three bytes each, the upper row first. */
export function decode(file) {
  assert.equal(file.subarray(0, 8).toString("latin1"), "\x89PNG\r\n\x1a\n");
  const data = [];
  let header;
  for (let at = 8; at < file.length; ) {
    const length = file.readUInt32BE(at);
    const name = file.toString("latin1", at + 4, at + 8);
    const content = file.subarray(at + 8, at + 8 + length);
    if (name === "IHDR") header = content;
    if (name === "IDAT") data.push(content);
    at += 12 + length;
  }
  assert.deepEqual([...header.subarray(8)], [8, 2, 0, 0, 0]);
  const [width, height] = [header.readUInt32BE(0), header.readUInt32BE(4)];
  const raw = inflateSync(Buffer.concat(data));
  const stride = 3 * width;
  assert.equal(raw.length, (stride + 1) * height);
  const pixels = Buffer.alloc(stride * height);
  for (let row = 0; row < height; row++) {
    const filter = raw[row * (stride + 1)];
    for (let column = 0; column < stride; column++) {
      const at = row * stride + column;
      const left = column < 3 ? 0 : pixels[at - 3];
      const above = row === 0 ? 0 : pixels[at - stride];
      const corner = column < 3 || row === 0 ? 0 : pixels[at - stride - 3];
      const estimate = left + above - corner;
      const [nearest] = [left, above, corner].sort(
        (one, other) => Math.abs(estimate - one) - Math.abs(estimate - other),
      );
      const predicted = [0, left, above, (left + above) >> 1, nearest][filter];
      pixels[at] = raw[row * (stride + 1) + 1 + column] + predicted;
    }
  }
  return { width, height, pixels };
}

/** The pictures of a page with their alternative texts. */
export const picturesOf = (html) =>
  [...html.matchAll(/<img ([^>]*)>/g)].map(([, attributes]) => {
    const [, base64] = /src="data:image\/png;base64,([^"]*)"/.exec(attributes);
    const [, alt] = /alt="([^"]*)"/.exec(attributes);
    return { alt, ...decode(Buffer.from(base64, "base64")) };
  });
