/** Made C3D files, of any processor and form. */
import type { Processor } from '../../src/import/points/c3d-parameters.ts';

/** Points of a frame, x y z each; null where one is missing. */
export type PointFrame = readonly (readonly [number, number, number] | null)[];

export interface MadeC3d {
  readonly labels: readonly string[];
  readonly frames: readonly PointFrame[];
  readonly rate?: number;
  readonly unit?: string;
  readonly processor?: Processor;
  /** Of whole numbers; absent: floats. */
  readonly scale?: number;
  /** Number of the first frame. */
  readonly first?: number;
  /** Analog samples a frame. */
  readonly analog?: number;
  /** Parameters that are left out: `POINT:RATE`. */
  readonly without?: readonly string[];
  /** As a take that is longer than the head can say. */
  readonly isLong?: boolean;
}

const BLOCK = 512;
const NUMBERS: Readonly<Record<Processor, number>> = { intel: 84, dec: 85, mips: 86 };

/** Bytes in the order of a processor. */
class Writer {
  readonly bytes: number[] = [];

  constructor(readonly processor: Processor) {}

  byte(...values: readonly number[]): void {
    this.bytes.push(...values.map((value) => value & 255));
  }

  text(text: string): void {
    this.byte(...Buffer.from(text, 'latin1'));
  }

  int16(value: number): void {
    const [low, high] = [value & 255, (value >> 8) & 255];
    this.byte(...(this.processor === 'mips' ? [high, low] : [low, high]));
  }

  float(value: number): void {
    const view = new DataView(new ArrayBuffer(4));
    view.setFloat32(0, this.processor === 'dec' ? 4 * value : value);
    const [a, b, c, d] = [0, 1, 2, 3].map((i) => view.getUint8(i));
    if (this.processor === 'mips') this.byte(a, b, c, d);
    else if (this.processor === 'intel') this.byte(d, c, b, a);
    else this.byte(b, a, d, c);
  }

  fillBlock(): void {
    while (this.bytes.length % BLOCK !== 0) this.bytes.push(0);
  }
}

type Value = readonly number[] | readonly string[];

/** The bytes of a C3D. */
export function c3dOf(made: MadeC3d): Uint8Array<ArrayBuffer> {
  const { labels, frames, rate = 100, unit = 'mm', processor = 'intel', scale, first = 1, analog = 0 } = made;
  const { without = [], isLong = false } = made;
  const last = isLong ? 65_535 : first + frames.length - 1;
  const writer = new Writer(processor);
  const groups = new Map([
    ['POINT', 1],
    ['TRIAL', 2],
  ]);
  const lists = Array.from({ length: Math.max(1, Math.ceil(labels.length / 255)) }, (_, i) =>
    labels.slice(255 * i, 255 * (i + 1)),
  );
  const end = first + frames.length - 1;
  const parameters: readonly (readonly [string, 'int' | 'float' | 'text', Value])[] = [
    ['POINT:USED', 'int', [labels.length]],
    ['POINT:SCALE', 'float', [scale ?? -1]],
    ['POINT:RATE', 'float', [rate]],
    ['POINT:UNITS', 'text', [unit]],
    ['POINT:FRAMES', 'int', [Math.min(65_535, frames.length)]],
    ...lists.map((list, i) => [`POINT:LABELS${i === 0 ? '' : i + 1}`, 'text', list] as const),
    ...(isLong
      ? ([
          ['TRIAL:ACTUAL_START_FIELD', 'int', [first & 65_535, first >> 16]],
          ['TRIAL:ACTUAL_END_FIELD', 'int', [end & 65_535, end >> 16]],
        ] as const)
      : []),
  ];
  const section = new Writer(processor);
  for (const [name, number] of groups) record(section, -number, name, [0]);
  const kept = parameters.filter(([name]) => !without.includes(name));
  // Where frames are is known only then.
  const place = kept.length;
  for (const [name, type, value] of kept) parameter(section, groups, name, type, value);
  const length = section.bytes.length + (without.includes('POINT:DATA_START') ? 0 : 24) + 8;
  const blocks = Math.ceil(length / BLOCK);
  const data = 2 + blocks;
  if (place >= 0 && !without.includes('POINT:DATA_START')) {
    parameter(section, groups, 'POINT:DATA_START', 'int', [data]);
  }
  writer.byte(2, 0x50);
  for (const value of [labels.length, analog, first, last, 0]) writer.int16(value);
  writer.float(scale ?? -1);
  writer.int16(data);
  writer.int16(analog > 0 ? 1 : 0);
  writer.float(rate);
  writer.fillBlock();
  writer.byte(1, 0x50, blocks, NUMBERS[processor], ...section.bytes, 0, 0);
  writer.fillBlock();
  for (const frame of frames) writeFrame(writer, frame, scale, analog);
  writer.fillBlock();
  return new Uint8Array(writer.bytes);
}

function record(writer: Writer, group: number, name: string, content: readonly number[]): void {
  writer.byte(name.length, group);
  writer.text(name);
  writer.int16(2 + content.length);
  writer.byte(...content);
}

function parameter(
  writer: Writer,
  groups: ReadonlyMap<string, number>,
  name: string,
  type: 'int' | 'float' | 'text',
  value: Value,
): void {
  const [group, own] = name.split(':');
  const content = new Writer(writer.processor);
  if (type === 'text') {
    const longest = Math.max(1, ...value.map((text) => String(text).length));
    content.byte(-1, 2, longest, value.length);
    for (const text of value) content.text(String(text).padEnd(longest));
  } else {
    content.byte(type === 'int' ? 2 : 4, value.length > 1 ? 1 : 0, ...(value.length > 1 ? [value.length] : []));
    for (const number of value) type === 'int' ? content.int16(Number(number)) : content.float(Number(number));
  }
  content.byte(0);
  record(writer, groups.get(group) ?? 1, own, content.bytes);
}

function writeFrame(writer: Writer, frame: PointFrame, scale: number | undefined, analog: number): void {
  for (const point of frame) {
    const [x, y, z] = point ?? [0, 0, 0];
    for (const v of [x, y, z]) scale === undefined ? writer.float(v) : writer.int16(Math.round(v / scale));
    scale === undefined ? writer.float(point ? 0 : -1) : writer.int16(point ? 0 : -1);
  }
  for (let i = 0; i < analog; i++) scale === undefined ? writer.float(i) : writer.int16(i);
}
