/** Reads little-endian numbers and runs of bytes one after the other. */
export class BinaryReader {
  readonly #view: DataView;
  readonly #damaged: (what: string) => Error;
  #at = 0;

  /** `damaged` makes the format's error for bytes that end early. */
  constructor(view: DataView, damaged: (what: string) => Error) {
    this.#view = view;
    this.#damaged = damaged;
  }

  /** The number of bytes that are left. */
  get left(): number {
    return this.#view.byteLength - this.#at;
  }

  uint8(): number {
    return this.#view.getUint8(this.#take(1));
  }

  uint16(): number {
    return this.#view.getUint16(this.#take(2), true);
  }

  uint32(): number {
    return this.#view.getUint32(this.#take(4), true);
  }

  int32(): number {
    return this.#view.getInt32(this.#take(4), true);
  }

  /** A number of 64 bits; exact up to 2^53. */
  int64(): number {
    return Number(this.#view.getBigInt64(this.#take(8), true));
  }

  float64(): number {
    return this.#view.getFloat64(this.#take(8), true);
  }

  /** A view of the next bytes. */
  part(length: number): DataView {
    return new DataView(this.#view.buffer, this.#view.byteOffset + this.#take(length), length);
  }

  /** The next bytes, which stay those of the buffer. */
  bytes(length: number): Uint8Array {
    const { buffer, byteOffset, byteLength } = this.part(length);
    return new Uint8Array(buffer, byteOffset, byteLength);
  }

  skip(length: number): void {
    this.#take(length);
  }

  #take(length: number): number {
    const start = this.#at;
    if (!(length >= 0 && length <= this.left)) throw this.#damaged("it ends early");
    this.#at = start + length;
    return start;
  }
}
