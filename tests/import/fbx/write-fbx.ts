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
  // The first of a name counts.
  return [
    ...before,
    rec('FBXHeaderExtension', [], [rec('FBXHeaderVersion', [{ int: 1003 }]), rec('FBXVersion', [{ int: version }])]),
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

export function fbxBytes(fbx: Fbx, isLittle = true): Uint8Array<ArrayBuffer> {
  return recordBytes(fbx.version ?? 7400, recordsOf(fbx, false), isLittle);
}

/** A binary file of any records. */
export function recordBytes(version: number, records: readonly Rec[], isLittle = true): Uint8Array<ArrayBuffer> {
  const header = Buffer.alloc(27);
  header.write('Kaydara FBX Binary  \0\x1a', 'latin1');
  header.writeUInt8(isLittle ? 0 : 1, 22);
  viewOf(header).setUint32(23, version, isLittle);
  const parts: Buffer[] = [header];
  let at = header.length;
  const isWide = version >= 7500;
  for (const record of records) {
    const bytes = recordPart(record, at, isWide, isLittle);
    parts.push(bytes);
    at += bytes.length;
  }
  parts.push(Buffer.alloc(isWide ? 25 : 13), Buffer.from('footer'));
  return new Uint8Array(Buffer.concat(parts));
}

function viewOf(bytes: Uint8Array): DataView {
  return new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
}

function recordPart({ name, values, children }: Rec, at: number, isWide: boolean, isLittle: boolean): Buffer {
  const headerBytes = isWide ? 25 : 13;
  const own = Buffer.concat(values.map((value) => valueBytes(value, isLittle)));
  const parts: Buffer[] = [];
  let inside = at + headerBytes + name.length + own.length;
  for (const child of children) {
    const bytes = recordPart(child, inside, isWide, isLittle);
    parts.push(bytes);
    inside += bytes.length;
  }
  if (children.length > 0) parts.push(Buffer.alloc(headerBytes));
  const body = Buffer.concat([Buffer.from(name, 'latin1'), own, ...parts]);
  const header = Buffer.alloc(headerBytes);
  for (const [i, size] of [at + headerBytes + body.length, values.length, own.length].entries()) {
    if (isWide) viewOf(header).setBigUint64(8 * i, BigInt(size), isLittle);
    else viewOf(header).setUint32(4 * i, size, isLittle);
  }
  header.writeUInt8(name.length, headerBytes - 1);
  return Buffer.concat([header, body]);
}

function valueBytes(value: Value, isLittle: boolean): Buffer {
  const with1 = (type: string, size: number, write: (view: DataView) => void) => {
    const buffer = Buffer.alloc(1 + size);
    buffer.write(type, 'latin1');
    write(viewOf(buffer));
    return buffer;
  };
  if (typeof value === 'number') return with1('D', 8, (view) => view.setFloat64(1, value, isLittle));
  if (typeof value === 'bigint') return with1('L', 8, (view) => view.setBigInt64(1, value, isLittle));
  if (typeof value === 'string' || value instanceof Uint8Array) {
    const bytes = Buffer.from(value);
    const type = typeof value === 'string' ? 'S' : 'R';
    return Buffer.concat([with1(type, 4, (view) => view.setUint32(1, bytes.length, isLittle)), bytes]);
  }
  if ('int' in value) return with1('I', 4, (view) => view.setInt32(1, value.int, isLittle));
  const type =
    value instanceof Float64Array ? 'd' : value instanceof Float32Array ? 'f' : value instanceof Int32Array ? 'i' : 'l';
  const raw = new Uint8Array(value.buffer, value.byteOffset, value.byteLength).slice();
  const width = value.BYTES_PER_ELEMENT;
  if (!isLittle) for (let at = 0; at < raw.length; at += width) raw.subarray(at, at + width).reverse();
  // Long arrays are packed, as exporters do.
  const packed = raw.length > 128 ? zlibSync(raw) : undefined;
  const header = with1(type, 12, (view) => {
    view.setUint32(1, value.length, isLittle);
    view.setUint32(5, packed ? 1 : 0, isLittle);
    view.setUint32(9, (packed ?? raw).length, isLittle);
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
