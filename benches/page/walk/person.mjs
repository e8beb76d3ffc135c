// A person at the page: finds controls by what is written on them, where they are seen, and takes
// the time of the keystroke-level model (Card, Moran, Newell: The Keystroke-Level Model for User
// Performance Time with Interactive Systems, CACM 23(7), 1980), with searching added, which that
// model of practised users does not have.

/** Milliseconds for a key by a typist of 40 words a minute, to point, to press a button, to move a hand between devices, and to decide on an act. */
const KEY = 280;
const POINT = 1100;
const PRESS = 200;
const HAND = 400;
const DECIDE = 1350;
/** Milliseconds in which a newcomer finds a control on the screen; in which a turn of the wheel is looked at. */
const SEARCH = 1500;
const TURN = 600;
/** Milliseconds to read a word: 240 a minute. */
const WORD = 250;
/** Pixels of a turn of the wheel, three notches; turns after which a control is not there. */
const WHEEL = 300;
const MAX_TURNS = 12;

export class Person {
  #page;
  /** Turns of the wheel since they were asked for last. */
  turns = 0;
  /** Milliseconds that the person took since they were asked for last. */
  spent = 0;

  constructor(page) {
    this.#page = page;
  }

  wait(time) {
    this.spent += time;
    return this.#page.waitForTimeout(time);
  }

  /** Finds what an element says, reads it, and returns it. */
  async read(locator) {
    await this.find(locator);
    return this.glance(locator);
  }

  /** Reads what stands beside what was read last. */
  async glance(locator) {
    const text = await locator.innerText();
    await this.wait(WORD * text.split(/\s+/).filter(Boolean).length);
    return text;
  }

  /** Scrolls the panel until the middle of a control is on the screen with nothing above it; fails if it never is. */
  async find(locator) {
    await this.wait(DECIDE + SEARCH);
    for (let turn = 0; turn < MAX_TURNS; turn++) {
      const place = await this.#seen(locator);
      if (place !== undefined) return place;
      const box = await locator.boundingBox();
      if (box === null) break;
      const { height, width } = this.#page.viewportSize();
      await this.#page.mouse.move(width - 40, height / 2);
      await this.#page.mouse.wheel(0, box.y > height / 2 ? WHEEL : -WHEEL);
      this.turns += 1;
      await this.wait(TURN);
    }
    throw new Error(`a newcomer does not see ${locator}`);
  }

  async #seen(locator) {
    const box = await locator.boundingBox();
    if (box === null) return undefined;
    const at = [box.x + box.width / 2, box.y + box.height / 2];
    const isSeen = await locator.evaluate((node, [x, y]) => {
      const top = document.elementFromPoint(x, y);
      // An input may cover all of its label.
      const target = top?.closest("label") ?? top;
      return target !== null && (node.contains(target) || target.contains(node));
    }, at);
    return isSeen ? at : undefined;
  }

  async click(locator) {
    const [x, y] = await this.find(locator);
    await this.wait(POINT + PRESS);
    await this.#page.mouse.click(x, y);
  }

  /** Clicks a field and replaces what is in it. */
  async type(locator, text) {
    await this.click(locator);
    await this.wait(HAND);
    await this.#page.keyboard.press("Control+a");
    await this.wait(2 * KEY);
    for (const key of text) {
      await this.#page.keyboard.press(key);
      await this.wait(KEY);
    }
    await this.wait(HAND);
  }

  /** Drags files from a folder beside the browser, and drops them on what says so. */
  async drop(locator, files) {
    const [x, y] = await this.find(locator);
    // Both are marked in the folder, taken, and carried here.
    await this.wait(2 * (POINT + PRESS) + PRESS + POINT);
    const data = await this.#page.evaluateHandle((all) => {
      const transfer = new DataTransfer();
      for (const { name, base64 } of all) {
        const bytes = Uint8Array.from(atob(base64), (one) => one.charCodeAt(0));
        transfer.items.add(new File([bytes], name));
      }
      return transfer;
    }, files);
    for (const type of ["dragenter", "dragover", "drop"]) {
      await locator.dispatchEvent(type, { dataTransfer: data, clientX: x, clientY: y });
    }
  }
}
