/** Files at the ends of what formats allow, and beyond: numbers, counts, names, images and archives. */
import { Zip, ZipDeflate, ZipPassThrough, zipSync } from 'fflate';
import type { Attempt } from '../attack.ts';

export interface MadeFile {
  readonly name: string;
  readonly bytes: Uint8Array | string;
}

export interface Extreme {
  readonly name: string;
  files(chance: Pick<Attempt, 'below'>): readonly MadeFile[];
  /** Whether something of it opens; absent: it may be opened or refused. */
  readonly opens?: boolean;
}

/** The ends of doubles, and numbers that a last digit tells apart. */
const NUMBERS = [
  '1e308',
  '-1e308',
  '1.7976931348623157e308',
  '1e-300',
  '5e-324',
  '-1e-300',
  '0',
  '-0',
  '1',
  '1e15',
  '9007199254740993',
  '3.4e38',
  '3.5e38',
  '1e20',
];
/** Times of a clock instead of a take's: µs and ns since 1970. */
const EPOCHS = ['1700000000000000', '1700000000000000000'];

type Draw = () => string;
const drawn =
  (chance: Pick<Attempt, 'below'>, from = NUMBERS): Draw =>
  () =>
    from[chance.below(from.length)];

const repeated = (count: number, text: (i: number) => string) =>
  Array.from({ length: count }, (_, i) => text(i)).join('');

function bvh(joints: string, frameSeconds: string, rows: readonly string[]): string {
  return `HIERARCHY\n${joints}MOTION\nFrames: ${rows.length}\nFrame Time: ${frameSeconds}\n${rows.join('\n')}\n`;
}

const CHANNELS = 'CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation';
const END = 'End Site { OFFSET 0 1 0 } ';

const SKELETON = 'balljoint root { offset 0 1 0 balljoint arm { offset 0 1 0 boxmin 0 0 0 boxmax 1 1 1 } }';

function anim(range: string, channels: readonly (readonly (readonly [string, string])[])[]): string {
  const text = channels.map((keys) => {
    const lines = keys.map(([time, value]) => `${time} ${value} smooth smooth`).join('\n');
    return `channel {\nextrapolate cycle_offset bounce\nkeys ${keys.length} {\n${lines}\n}\n}`;
  });
  return `animation {\nrange ${range}\nnumchannels ${channels.length}\n${text.join('\n')}\n}\n`;
}

/** Nine channels of `SKELETON`, each with these keys. */
const nine = (range: string, keys: readonly (readonly [string, string])[]) => [
  { name: 'odd.skel', bytes: SKELETON },
  { name: 'odd_take.anim', bytes: anim(range, Array(9).fill(keys)) },
];

const chain = (count: number) =>
  `${repeated(count, (i) => `balljoint j${i} { offset 0 ${i ? 0.01 : 0} 0 `)}${'}'.repeat(count)}`;
const star = (count: number) =>
  `balljoint centre { ${repeated(count, (i) => `balljoint j${i} { offset ${Math.sin(i)} 0 ${Math.cos(i)} } `)}}`;
const bvhChain = (count: number) => {
  const joints = repeated(count, (i) => `${i ? 'JOINT' : 'ROOT'} j${i} { OFFSET 0 0.01 0 CHANNELS 1 Zrotation\n`);
  const row = repeated(count, () => '0.1 ');
  return bvh(`${joints}${END}${'}'.repeat(count)}\n`, '0.03', [row, row, row]);
};
const bvhRoots = (count: number) =>
  bvh(
    repeated(count, (i) => `ROOT r${i} { OFFSET ${i % 100} 0 ${i / 100} CHANNELS 1 Zrotation\n${END}}\n`),
    '0.03',
    [repeated(count, () => '0.1 ')],
  );

const MARKUP = '<img src=x onerror=alert(1)>\u202egnp.\u2066\u200f';
/** Names of files have up to 255 bytes. */
const fileName = (extension: string, i = 0) => {
  const begin = `${i}${MARKUP.replaceAll('/', '∕')}`;
  return `${begin}${'x'.repeat(255 - Buffer.byteLength(begin) - extension.length)}${extension}`;
};

const longNames = (names: number, length: number) =>
  `balljoint root { ${repeated(names, (i) => `balljoint ${String(i).padStart(4, '0')}${'n'.repeat(length)} { offset 0 ${i} 0 } `)}}`;

/** The header of a PNG, without its rows. */
function pngHeader(width: number, height: number): Uint8Array {
  const bytes = Buffer.alloc(33 + 12);
  bytes.set([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
  bytes.writeUInt32BE(13, 8);
  bytes.write('IHDR', 12, 'latin1');
  bytes.writeUInt32BE(width, 16);
  bytes.writeUInt32BE(height, 20);
  bytes.set([1, 0, 0, 0, 0], 24);
  return bytes;
}

function bmpHeader(width: number, height: number): Uint8Array {
  const bytes = Buffer.alloc(54 + 64);
  bytes.write('BM', 0, 'latin1');
  bytes.writeUInt32LE(54, 10);
  bytes.writeUInt32LE(40, 14);
  bytes.writeInt32LE(width, 18);
  bytes.writeInt32LE(height, 22);
  bytes.writeUInt16LE(1, 26);
  bytes.writeUInt16LE(24, 28);
  return bytes;
}

/** A triangle with a texture. */
const skinWith = (texture: string) => `positions 3 { 0 0 0 1 0 0 0 1 0 }
normals 3 { 0 0 1 0 0 1 0 0 1 }
texcoords 3 { 0 0 1 0 0 1 }
skinweights 3 { 1 0 1 1 0 1 1 0 1 }
bindings 1 { matrix { 1 0 0 0 1 0 0 0 1 0 0 0 } }
material m { texture ${texture} }
triangles 1 { 0 1 2 }`;

const textured = (name: string, bytes: Uint8Array) => [
  { name: 'plain.skel', bytes: 'balljoint root { }' },
  { name: 'plain.skin', bytes: skinWith(name) },
  { name, bytes },
];

const encoded = (text: string) => new TextEncoder().encode(text);
const ONE = encoded('balljoint a { boxmin 0 0 0 boxmax 1 1 1 }');

/** With more than 65,535 entries it ends as Zip64. */
function zipOf(count: number, name: (i: number) => string, content: Uint8Array): Uint8Array {
  const pieces: Uint8Array[] = [];
  const zip = new Zip((error, piece) => {
    if (error) throw error;
    pieces.push(piece);
  });
  for (let i = 0; i < count; i++) {
    const entry = new ZipPassThrough(name(i));
    zip.add(entry);
    entry.push(content, true);
  }
  zip.end();
  const whole = Buffer.concat(pieces);
  return count > 0xffff ? withZip64End(whole, count) : whole;
}

/** fflate counts entries modulo 65,536: with the records of APPNOTE 4.3.14 and 4.3.15 before its end. */
function withZip64End(zip: Buffer, count: number): Buffer {
  const end = zip.length - 22;
  const record = Buffer.alloc(56);
  record.writeUInt32LE(0x06064b50, 0);
  record.writeBigUInt64LE(44n, 4);
  for (const at of [12, 14]) record.writeUInt16LE(45, at);
  for (const at of [24, 32]) record.writeBigUInt64LE(BigInt(count), at);
  record.writeBigUInt64LE(BigInt(zip.readUInt32LE(end + 12)), 40);
  record.writeBigUInt64LE(BigInt(zip.readUInt32LE(end + 16)), 48);
  const locator = Buffer.alloc(20);
  locator.writeUInt32LE(0x07064b50, 0);
  locator.writeBigUInt64LE(BigInt(end), 8);
  locator.writeUInt32LE(1, 16);
  const last = Buffer.from(zip.subarray(end));
  for (const at of [8, 10]) last.writeUInt16LE(0xffff, at);
  return Buffer.concat([zip.subarray(0, end), record, locator, last]);
}

/** A skeleton and then blanks: deflated about a thousandfold. */
function bomb(megabytes: number): Uint8Array {
  const pieces: Uint8Array[] = [];
  const zip = new Zip((_error, piece) => void pieces.push(piece));
  const entry = new ZipDeflate('blanks.skel', { level: 9 });
  zip.add(entry);
  entry.push(ONE);
  const blanks = new Uint8Array(2 ** 20).fill(32);
  for (let i = 0; i < megabytes; i++) entry.push(blanks);
  entry.push(new Uint8Array(0), true);
  zip.end();
  return Buffer.concat(pieces);
}

function nested(levels: number): Uint8Array {
  let zip = zipSync({ 'a.skel': ONE });
  for (let i = 0; i < levels; i++) zip = zipSync({ [`${i}.zip`]: zip, [`${i}.skel`]: ONE });
  return zip;
}

/** With the flag for encryption in its headers. */
function encrypted(): Uint8Array {
  const bytes = Buffer.from(zipSync({ 'a.skel': ONE }));
  bytes[6] |= 1;
  bytes[bytes.indexOf(Buffer.from('PK\x01\x02', 'latin1')) + 8] |= 1;
  return bytes;
}

export const EXTREMES: readonly Extreme[] = [
  {
    name: 'numbers of a .skel',
    files: (chance) => {
      const n = drawn(chance);
      const three = () => `${n()} ${n()} ${n()}`;
      const joint = (name: string, inner: string) =>
        `balljoint ${name} { offset ${three()} boxmin ${three()} boxmax ${three()} rotxlimit ${n()} ${n()} pose ${three()} ${inner} }`;
      return [{ name: 'numbers.skel', bytes: joint('root', joint('arm', joint('hand', ''))) }];
    },
  },
  {
    name: 'numbers of a .bvh',
    files: (chance) => {
      const n = drawn(chance);
      const joints = `ROOT a { OFFSET ${n()} ${n()} ${n()} ${CHANNELS} End Site { OFFSET ${n()} ${n()} 0 } }\n`;
      const rows = Array.from({ length: 4 }, () => `${n()} ${n()} ${n()} ${n()} ${n()} ${n()}`);
      return [{ name: 'numbers.bvh', bytes: bvh(joints, n(), rows) }];
    },
  },
  {
    name: 'times and values of an .anim',
    files: (chance) => {
      const n = drawn(chance);
      const times = Array.from({ length: 3 }, n).sort((a, b) => Number(a) - Number(b));
      return nine(
        [n(), n()].sort((a, b) => Number(a) - Number(b)).join(' '),
        [...new Set(times)].map((time) => [time, n()] as const),
      );
    },
  },
  {
    name: 'an epoch as range',
    opens: true,
    files: (chance) => {
      const start = drawn(chance, EPOCHS)();
      const end = String(BigInt(start) + 10_000_000n);
      return nine(`${start} ${end}`, [
        [start, '0'],
        [end, '1'],
      ]);
    },
  },
  {
    name: 'keys a last digit apart',
    opens: true,
    files: () =>
      nine(
        '0 2',
        Array.from({ length: 50 }, (_, i) => [String(1 + i * 2 ** -52), String(i % 2)] as const),
      ),
  },
  {
    name: 'a range from 0 to 1e308',
    files: () =>
      nine('0 1e308', [
        ['0', '0'],
        ['1e308', '1e308'],
      ]),
  },
  {
    name: 'a range of 1e-300',
    files: () =>
      nine('0 1e-300', [
        ['0', '0'],
        ['1e-300', '1e-300'],
      ]),
  },
  {
    name: 'a .bvh of 1e-300 a frame',
    files: () => [
      {
        name: 'fast.bvh',
        bytes: bvh(`ROOT a { OFFSET 0 0 0 ${CHANNELS} ${END}}\n`, '1e-300', Array(100).fill('0 1 0 0 0 0')),
      },
    ],
  },
  {
    name: 'a .bvh of 1e300 a frame',
    files: () => [
      {
        name: 'slow.bvh',
        bytes: bvh(`ROOT a { OFFSET 0 0 0 ${CHANNELS} ${END}}\n`, '1e300', Array(100).fill('0 1 0 0 0 0')),
      },
    ],
  },
  { name: 'a chain of 20,000 joints', files: () => [{ name: 'chain.skel', bytes: chain(20_000) }] },
  { name: 'a .bvh of 20,000 joints in a chain', files: () => [{ name: 'chain.bvh', bytes: bvhChain(20_000) }] },
  { name: 'a star of 20,000 joints', opens: true, files: () => [{ name: 'star.skel', bytes: star(20_000) }] },
  { name: '10,000 roots', opens: true, files: () => [{ name: 'roots.bvh', bytes: bvhRoots(10_000) }] },
  {
    name: '2,000 skeletons in one drop',
    opens: true,
    files: () => Array.from({ length: 2000 }, (_, i) => ({ name: `s${i}.skel`, bytes: SKELETON })),
  },
  {
    name: '2,000 animations of one skeleton',
    opens: true,
    files: () => [
      { name: 'many.skel', bytes: SKELETON },
      ...Array.from({ length: 2000 }, (_, i) => ({
        name: `many_${i}.anim`,
        bytes: anim('0 1', Array(9).fill([['0', '0']])),
      })),
    ],
  },
  {
    name: '2,000 takes',
    files: () =>
      Array.from({ length: 2000 }, (_, i) => ({
        name: `t${i}.bvh`,
        bytes: bvh(`ROOT a { OFFSET 0 0 0 ${CHANNELS} ${END}}\n`, '0.03', ['0 1 0 0 0 0', '0 1 0 9 0 0']),
      })),
  },
  {
    name: '2,000 broken files',
    opens: false,
    files: () => Array.from({ length: 2000 }, (_, i) => ({ name: `b${i}.skel`, bytes: 'balljoint a { offset x }' })),
  },
  {
    name: '2,000 files of no known kind',
    opens: false,
    files: () => Array.from({ length: 2000 }, (_, i) => ({ name: `u${i}.xyz`, bytes: 'x' })),
  },
  {
    name: 'a joint with a name of 1 MB',
    opens: true,
    files: () => [{ name: 'name.skel', bytes: longNames(1, 1_000_000) }],
  },
  {
    name: '100 joints with names of 100 kB',
    opens: true,
    files: () => [{ name: 'names.skel', bytes: longNames(100, 100_000) }],
  },
  {
    name: 'names of files of 255 bytes, with markup and bidirectional controls',
    opens: true,
    files: () => [
      { name: fileName('.skel'), bytes: SKELETON },
      { name: fileName('.skel', 1), bytes: 'balljoint a { offset x }' },
      { name: fileName('.md', 2), bytes: 'x' },
      { name: fileName('.bvh', 3), bytes: bvh(`ROOT a { OFFSET 0 0 0 ${CHANNELS} ${END}}\n`, '0.03', ['0 1 0 0 0 0']) },
    ],
  },
  { name: 'a PNG of 50,000 × 50,000', files: () => textured('huge.png', pngHeader(50_000, 50_000)) },
  { name: 'a BMP of 50,000 × 50,000', files: () => textured('huge.bmp', bmpHeader(50_000, 50_000)) },
  { name: 'a BMP of 16,000 × 6,000 without pixels', files: () => textured('large.bmp', bmpHeader(16_000, 6000)) },
  {
    name: 'a zip of 100,000 entries',
    opens: false,
    files: () => [{ name: 'many.zip', bytes: zipOf(100_000, (i) => `f${i}.xyz`, encoded('x')) }],
  },
  {
    name: 'a zip of 100,000 skeletons',
    opens: false,
    files: () => [{ name: 'skels.zip', bytes: zipOf(100_000, (i) => `f${i}.skel`, ONE) }],
  },
  {
    name: 'a zip of 5,000 skeletons',
    opens: true,
    files: () => [{ name: 'skels.zip', bytes: zipOf(5000, (i) => `f${i}.skel`, ONE) }],
  },
  { name: 'nested zips', files: () => [{ name: 'nested.zip', bytes: nested(50) }] },
  { name: 'a zip that unpacks to 3 GB', opens: false, files: () => [{ name: 'bomb.zip', bytes: bomb(3000) }] },
  { name: 'a zip that unpacks to 400 MB', files: () => [{ name: 'bomb.zip', bytes: bomb(400) }] },
  { name: 'an encrypted zip', opens: false, files: () => [{ name: 'locked.zip', bytes: encrypted() }] },
  {
    name: 'a zip with ways out',
    files: () => [{ name: 'out.zip', bytes: zipSync({ '../../out.skel': ONE, '/etc/abs.skel': ONE }) }],
  },
];
