/** A small reader of Parquet files of flat, required, plain, uncompressed columns; independent of the writer. */

export interface ReadColumn {
  readonly name: string;
  readonly type: 'BOOLEAN' | 'FLOAT' | 'DOUBLE';
  readonly values: readonly number[];
}

export interface ReadTable {
  readonly rowCount: number;
  readonly columns: readonly ReadColumn[];
  readonly metadata: Readonly<Record<string, string>>;
}

/** Thrift's compact protocol: numbers, texts, lists and structs by field number. */
type Thrift = number | string | readonly Thrift[] | { readonly [field: number]: Thrift };

class Cursor {
  constructor(
    private readonly bytes: Uint8Array,
    public at: number,
  ) {}

  private varint(): number {
    let value = 0;
    for (let factor = 1; ; factor *= 128) {
      const byte = this.bytes[this.at++];
      value += (byte & 127) * factor;
      if (byte < 128) return value;
    }
  }

  value(type: number): Thrift {
    if (type === 5 || type === 6) {
      const zigzag = this.varint();
      return zigzag % 2 ? -(zigzag + 1) / 2 : zigzag / 2;
    }
    if (type === 8) {
      const length = this.varint();
      this.at += length;
      return new TextDecoder().decode(this.bytes.subarray(this.at - length, this.at));
    }
    if (type === 9) {
      const head = this.bytes[this.at++];
      const count = head >> 4 === 15 ? this.varint() : head >> 4;
      return Array.from({ length: count }, () => this.value(head & 15));
    }
    if (type !== 12) throw new Error(`There is a value of type ${type} at ${this.at}.`);
    const fields: Record<number, Thrift> = {};
    let field = 0;
    for (;;) {
      const head = this.bytes[this.at++];
      if (head === 0) return fields;
      field += head >> 4;
      fields[field] = this.value(head & 15);
    }
  }
}

/** A member by field numbers; the reader's caller knows what it is. */
function get<T>(value: Thrift, ...path: readonly number[]): T {
  let found: unknown = value;
  for (const field of path) found = (found as Record<number, unknown>)[field];
  return found as T;
}

const TYPES: Readonly<Record<number, ReadColumn['type']>> = { 0: 'BOOLEAN', 4: 'FLOAT', 5: 'DOUBLE' };

export function readParquet(bytes: Uint8Array): ReadTable {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const magic = [bytes.subarray(0, 4), bytes.subarray(-4)].map((b) => String.fromCharCode(...b));
  if (magic.some((text) => text !== 'PAR1')) throw new Error('This is no Parquet file.');
  const length = view.getUint32(bytes.length - 8, true);
  const footer = new Cursor(bytes, bytes.length - 8 - length);
  const file = footer.value(12);
  if (footer.at !== bytes.length - 8) throw new Error('The metadata have another length than stated.');
  const rowCount = get<number>(file, 3);
  const [group] = get<readonly Thrift[]>(file, 4);
  const columns = get<readonly Thrift[]>(group, 1).map((chunk): ReadColumn => {
    const cursor = new Cursor(bytes, get<number>(chunk, 3, 9));
    const start = cursor.at;
    const page = cursor.value(12);
    const type = TYPES[get<number>(chunk, 3, 1)];
    if (get<number>(chunk, 3, 7) !== cursor.at - start + get<number>(page, 3))
      throw new Error('A chunk has another size.');
    const at = cursor.at;
    const values = Array.from({ length: get<number>(page, 5, 1) }, (_, i) => {
      if (type === 'BOOLEAN') return (bytes[at + (i >> 3)] >> (i & 7)) & 1;
      return type === 'FLOAT' ? view.getFloat32(at + 4 * i, true) : view.getFloat64(at + 8 * i, true);
    });
    return { name: get<string>(chunk, 3, 3, 0), type, values };
  });
  const pairs = get<readonly Thrift[]>(file, 5).map((pair) => [get<string>(pair, 1), get<string>(pair, 2)]);
  return { rowCount, columns, metadata: Object.fromEntries(pairs) };
}
