/** Writes FBX files, as texts and as bytes, for tests: odd ones, that no public file is like. */
import { zlibSync } from 'fflate';

/** Whole numbers are written as 32-bit integers where `int` says so, else as doubles; bigints have 64 bits. */
export type Value =
  | number
  | bigint
  | string
  | { readonly int: number }
  | Uint8Array
  | Float64Array
  | Float32Array
  | Int32Array
  | BigInt64Array;

export interface Rec {
  readonly name: string;
  readonly values: readonly Value[];
  readonly children: readonly Rec[];
}

export function rec(name: string, values: readonly Value[] = [], children: readonly Rec[] = []): Rec {
  return { name, values, children };
}

/** A property of a `Properties70`. */
export function prop(name: string, ...values: readonly Value[]): Rec {
  return rec('P', [name, '', '', 'A', ...values]);
}

export interface Obj {
  readonly id: number;
  readonly kind: string;
  readonly name: string;
  readonly type?: string;
  readonly props?: readonly Rec[];
  readonly children?: readonly Rec[];
}

/** Part, owner, and the owner's property, if it is connected to one. */
export type Connection = readonly [part: number, owner: number, property?: string];

export interface Fbx {
  readonly version?: number;
  readonly settings?: readonly Rec[];
  readonly objects: readonly Obj[];
  readonly connections: readonly Connection[];
  readonly before?: readonly Rec[];
}

function recordsOf({ version = 7400, settings = [], objects, connections, before = [] }: Fbx, isText: boolean): Rec[] {
  const called = ({ name, kind }: Obj) => (isText ? `${kind}::${name}` : `${name}\0\x01${kind}`);
  return [
    rec('FBXHeaderExtension', [], [rec('FBXHeaderVersion', [{ int: 1003 }]), rec('FBXVersion', [{ int: version }])]),
    ...before,
    rec('GlobalSettings', [], [rec('Properties70', [], settings)]),
    rec(
      'Objects',
      [],
      objects.map((own) =>
        rec(
          own.kind,
          [BigInt(own.id), called(own), own.type ?? ''],
          [rec('Properties70', [], own.props), ...(own.children ?? [])],
        ),
      ),
    ),
    rec(
      'Connections',
      [],
      connections.map(([part, owner, property]) =>
        rec('C', [
          property === undefined ? 'OO' : 'OP',
          BigInt(part),
          BigInt(owner),
          ...(property === undefined ? [] : [property]),
        ]),
      ),
    ),
  ];
}

export function fbxText(fbx: Fbx): string {
  const lines = [`; FBX ${(fbx.version ?? 7400) / 1000}.0 project file`.replace(/(\d)\.(\d)\d*\.0/, '$1.$2.0'), ''];
  for (const record of recordsOf(fbx, true)) writeText(record, '', lines);
  return `${lines.join('\n')}\n`;
}

function writeText({ name, values, children }: Rec, indent: string, lines: string[]): void {
  const texts = values.map((value) => {
    if (typeof value === 'string') return `"${value.replaceAll('"', '&quot;')}"`;
    if (typeof value === 'number' || typeof value === 'bigint') return String(value);
    if ('int' in value) return String(value.int);
    if (value instanceof Uint8Array) return `"${Buffer.from(value).toString('base64')}"`;
    // From 7.2 on, the bits of these floats.
    const own = name === 'KeyAttrDataFloat' && value instanceof Float32Array ? new Int32Array(value.buffer) : value;
    return `*${own.length} {\n${indent}\ta: ${own.join(',')}\n${indent}}`;
  });
  const isOpen = children.length > 0 || name === 'Properties70';
  lines.push(`${indent}${name}: ${texts.join(', ')}${isOpen ? ' {' : ''}`);
  for (const child of children) writeText(child, `${indent}\t`, lines);
  if (isOpen) lines.push(`${indent}}`);
}

export function fbxBytes(fbx: Fbx): Uint8Array<ArrayBuffer> {
  return recordBytes(fbx.version ?? 7400, recordsOf(fbx, false));
}

/** A binary file of any records. */
export function recordBytes(version: number, records: readonly Rec[]): Uint8Array<ArrayBuffer> {
  const header = Buffer.alloc(27);
  header.write('Kaydara FBX Binary  \0\x1a\0', 'latin1');
  header.writeUInt32LE(version, 23);
  const parts: Buffer[] = [header];
  let at = header.length;
  const isWide = version >= 7500;
  for (const record of records) {
    const bytes = recordPart(record, at, isWide);
    parts.push(bytes);
    at += bytes.length;
  }
  parts.push(Buffer.alloc(isWide ? 25 : 13), Buffer.from('footer'));
  return new Uint8Array(Buffer.concat(parts));
}

function recordPart({ name, values, children }: Rec, at: number, isWide: boolean): Buffer {
  const headerBytes = isWide ? 25 : 13;
  const own = Buffer.concat(values.map(valueBytes));
  const parts: Buffer[] = [];
  let inside = at + headerBytes + name.length + own.length;
  for (const child of children) {
    const bytes = recordPart(child, inside, isWide);
    parts.push(bytes);
    inside += bytes.length;
  }
  if (children.length > 0) parts.push(Buffer.alloc(headerBytes));
  const body = Buffer.concat([Buffer.from(name, 'latin1'), own, ...parts]);
  const header = Buffer.alloc(headerBytes);
  for (const [i, size] of [at + headerBytes + body.length, values.length, own.length].entries()) {
    if (isWide) header.writeBigUInt64LE(BigInt(size), 8 * i);
    else header.writeUInt32LE(size, 4 * i);
  }
  header.writeUInt8(name.length, headerBytes - 1);
  return Buffer.concat([header, body]);
}

function valueBytes(value: Value): Buffer {
  const with1 = (type: string, size: number, write: (buffer: Buffer) => void) => {
    const buffer = Buffer.alloc(1 + size);
    buffer.write(type, 'latin1');
    write(buffer);
    return buffer;
  };
  if (typeof value === 'number') return with1('D', 8, (buffer) => buffer.writeDoubleLE(value, 1));
  if (typeof value === 'bigint') return with1('L', 8, (buffer) => buffer.writeBigInt64LE(value, 1));
  if (typeof value === 'string' || value instanceof Uint8Array) {
    const bytes = Buffer.from(value);
    const isText = typeof value === 'string';
    return Buffer.concat([with1(isText ? 'S' : 'R', 4, (buffer) => buffer.writeUInt32LE(bytes.length, 1)), bytes]);
  }
  if ('int' in value) return with1('I', 4, (buffer) => buffer.writeInt32LE(value.int, 1));
  const type =
    value instanceof Float64Array ? 'd' : value instanceof Float32Array ? 'f' : value instanceof Int32Array ? 'i' : 'l';
  const raw = new Uint8Array(value.buffer, value.byteOffset, value.byteLength);
  // Long arrays are packed, as exporters do.
  const packed = raw.length > 128 ? zlibSync(raw) : undefined;
  const header = with1(type, 12, (buffer) => {
    buffer.writeUInt32LE(value.length, 1);
    buffer.writeUInt32LE(packed ? 1 : 0, 5);
    buffer.writeUInt32LE((packed ?? raw).length, 9);
  });
  return Buffer.concat([header, packed ?? raw]);
}

const TICKS = 46186158000;

/** A key: seconds, value, flags, and the four floats. */
export interface Key {
  readonly time: number;
  readonly value: number;
  readonly flags: number;
  readonly data?: readonly [number, number, number, number];
}

/** The two weights of a key in one float. */
export function weights(right: number, nextLeft: number): number {
  const word = Uint32Array.of((Math.round(nextLeft * 10000) << 16) | Math.round(right * 10000));
  return new Float32Array(word.buffer)[0];
}

export function curve(id: number, keys: readonly Key[], extra: readonly Rec[] = []): Obj {
  return {
    id,
    kind: 'AnimationCurve',
    name: '',
    children: [
      rec('Default', [0]),
      rec('KeyVer', [{ int: 4009 }]),
      rec('KeyTime', [BigInt64Array.from(keys, ({ time }) => BigInt(Math.round(time * TICKS)))]),
      rec('KeyValueFloat', [Float32Array.from(keys, ({ value }) => value)]),
      rec('KeyAttrFlags', [Int32Array.from(keys, ({ flags }) => flags)]),
      rec('KeyAttrDataFloat', [Float32Array.from(keys.flatMap(({ data }) => [...(data ?? [0, 0, 0, 0])]))]),
      rec('KeyAttrRefCount', [new Int32Array(keys.length).fill(1)]),
      ...extra,
    ],
  };
}

export function ticks(seconds: number): bigint {
  return BigInt(Math.round(seconds * TICKS));
}
