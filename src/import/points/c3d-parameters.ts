/**
 * The parameters of a C3D: groups of named arrays, in records that follow each other.
 *
 *     group      length of its name, −number, name, way to the next record, description
 *     parameter  length of its name,  number of its group, name, way to the next, type, dimensions, values, description
 *
 * The length is negative of what is locked. A way of 0, or a name without letters, ends the list.
 */
import { counted } from '../imported.ts';
import { fail } from './table.ts';

/** How numbers are stored: the processor that wrote them. */
export type Processor = 'intel' | 'dec' | 'mips';

const PROCESSORS: Readonly<Record<number, Processor>> = { 84: 'intel', 85: 'dec', 86: 'mips' };
/** Bytes of the blocks that a C3D consists of. */
export const BLOCK = 512;
/** What a value may take: texts, bytes, whole numbers, floats. */
const SIZES: Readonly<Record<number, number>> = { [-1]: 1, 1: 1, 2: 2, 4: 4 };
/** In the head of the file. */
const KEY = 0x50;

/** Numbers of a file, in the order of its processor. */
export class Numbers {
  private readonly view: DataView;
  private readonly scratch = new DataView(new ArrayBuffer(4));

  constructor(
    readonly bytes: Uint8Array,
    readonly processor: Processor,
  ) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  /** The whole number of two bytes at `at`. */
  int16(at: number): number {
    return this.view.getInt16(at, this.processor !== 'mips');
  }

  /** The whole number of two bytes at `at`, without sign. */
  uint16(at: number): number {
    return this.view.getUint16(at, this.processor !== 'mips');
  }

  /** The float at `at`; those of DEC are converted. */
  float(at: number): number {
    if (this.processor !== 'dec') return this.view.getFloat32(at, this.processor !== 'mips');
    // An F float: its halves are in the other order, and its exponent is larger by 2.
    this.scratch.setUint16(0, this.view.getUint16(at, true));
    this.scratch.setUint16(2, this.view.getUint16(at + 2, true));
    return this.scratch.getFloat32(0) / 4;
  }
}

/** A parameter: where its values are. */
interface Stored {
  readonly type: number;
  readonly sizes: readonly number[];
  /** Of its first value, and what no value may reach. */
  readonly at: number;
  readonly end: number;
}

/** The parameters of a file, by group and name. */
export class Parameters {
  readonly numbers: Numbers;
  private readonly groups = new Map<number, string>();
  private readonly records = new Map<string, Stored>();

  /** @throws ImportError if the records lead back or out of the file */
  constructor(private readonly bytes: Uint8Array) {
    if (bytes.length < BLOCK) fail('c3d-short', `Expected a head of ${BLOCK} bytes, found ${bytes.length} bytes.`);
    if (bytes[1] !== KEY) {
      fail('c3d-key', `Expected a C3D, whose second byte is ${KEY}, found ${bytes[1]}.`);
    }
    const start = (bytes[0] - 1) * BLOCK;
    if (start < BLOCK || start + 4 > bytes.length) {
      fail('c3d-parameters', `Expected parameters at block ${bytes[0]}, found a file of ${blocksIn(bytes)}.`);
    }
    this.numbers = new Numbers(bytes, processorOf(bytes[start + 3]));
    this.read(start + 4);
  }

  private read(from: number): void {
    const { bytes, numbers } = this;
    const inside = (end: number) => {
      if (end > bytes.length) fail('c3d-cut', 'The file ends inside its parameters: copy or export it again.');
    };
    for (let at = from; at + 2 <= bytes.length; ) {
      const length = Math.abs((bytes[at] << 24) >> 24);
      const group = (bytes[at + 1] << 24) >> 24;
      if (length === 0) return;
      inside(at + 2 + length + 2);
      const name = textOf(bytes, at + 2, length).toUpperCase();
      const way = at + 2 + length;
      const next = way + numbers.int16(way);
      const isLast = next === way;
      if (!isLast && next < way + 2) {
        fail('c3d-records', `The parameter ${name} leads back from byte ${way} to ${next}: the file is damaged.`);
      }
      if (next > bytes.length) {
        const end = `the file ends at ${bytes.length}`;
        fail('c3d-records', `The parameter ${name} leads to byte ${next}, and ${end}: copy or export it again.`);
      }
      if (group < 0) this.groups.set(-group, name);
      else this.keep(name, group, way + 2, isLast ? bytes.length : next);
      if (isLast) return;
      at = next;
    }
  }

  private keep(name: string, group: number, at: number, end: number): void {
    const { bytes } = this;
    if (at + 2 > end) return;
    const type = (bytes[at] << 24) >> 24;
    const count = bytes[at + 1];
    const sizes = Array.from(bytes.subarray(at + 2, Math.min(end, at + 2 + count)));
    this.records.set(`${group} ${name}`, { type, sizes, at: at + 2 + count, end });
  }

  private find(group: string, name: string): Stored | undefined {
    for (const [number, own] of this.groups) {
      const found = own === group ? this.records.get(`${number} ${name}`) : undefined;
      if (found) {
        const length = found.sizes.reduce((product, size) => product * size, SIZES[found.type] ?? 1);
        if (found.at + length <= found.end) return found;
        return fail('c3d-records', `The parameter ${group}:${name} has more values than its record holds.`);
      }
    }
    return undefined;
  }

  /** A number of a parameter; undefined if there is no such parameter. Whole ones are without sign. */
  number(group: string, name: string, index = 0): number | undefined {
    const found = this.find(group, name);
    const size = SIZES[found?.type ?? 0] ?? 0;
    const count = found?.sizes.reduce((product, own) => product * own, 1) ?? 0;
    if (!found || found.type < 0 || size === 0 || index >= count) return undefined;
    const at = found.at + index * size;
    if (size === 4) return this.numbers.float(at);
    return size === 2 ? this.numbers.uint16(at) : this.bytes[at];
  }

  /** The texts of a parameter, without blanks around them; none without it. */
  texts(group: string, name: string): readonly string[] {
    const found = this.find(group, name);
    if (found?.type !== -1) return [];
    const [length = 1, ...others] = found.sizes;
    const count = others.reduce((product, size) => product * size, 1);
    return Array.from({ length: count }, (_, i) => textOf(this.bytes, found.at + i * length, length));
  }
}

function processorOf(byte: number): Processor {
  return (
    PROCESSORS[byte] ??
    fail('c3d-processor', `Expected the processor 84 (Intel), 85 (DEC) or 86 (MIPS), found ${byte}.`)
  );
}

/** Without blanks and zeros around it. */
function textOf(bytes: Uint8Array, at: number, length: number): string {
  return UTF8.decode(bytes.subarray(at, at + length)).replace(/^[\s\0]+|[\s\0]+$/g, '');
}

const UTF8 = new TextDecoder('utf-8');

/** `2 blocks`: how long a file is. */
export function blocksIn(bytes: Uint8Array): string {
  return counted(Math.ceil(bytes.length / BLOCK), 'block');
}
