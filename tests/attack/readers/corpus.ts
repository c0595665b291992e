/** Small files of every kind that is read, which the attack on the readers mutates: made ones, and real ones if present. */
import { readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import fc from 'fast-check';
import { zipSync } from 'fflate';
import { lineOf } from '../../../src/cli/export/records.ts';
import type { ListedTake } from '../../../src/review/list.ts';
import { listAsCsv, listAsJson } from '../../../src/review/write-list.ts';
import { c3dOf } from '../../helpers/c3d.ts';
import { type MadeArray, npyOf, npzOf } from '../../helpers/numpy.ts';
import { hasShared, sharedBytes, sharedPath } from '../../helpers/shared.ts';
import { randomFbx } from '../../import/fbx/random-fbx.ts';
import { fbxBytes, fbxText } from '../../import/fbx/write-fbx.ts';
import { glbOf } from '../../import/make-gltf.ts';
import { randomGltf } from '../../import/random-gltf.ts';
import { MADE_TEXTS } from './made-texts.ts';
import { isSubject, type Subject } from './subjects.ts';

/** A file to mutate. */
export interface Seed {
  readonly subject: Subject;
  readonly bytes: Uint8Array;
}

/** Larger files are left out: their inputs would take the time of thousands. */
const LARGEST = 170_000;
const SAMPLES = fileURLToPath(new URL('../../../public/samples/', import.meta.url));
const RANDOM_FILES = 24;

const text = (content: string) => new TextEncoder().encode(content);

/** The same in every run. */
export function corpus(): readonly Seed[] {
  return [
    ...madeTexts(),
    ...samples(),
    ...random(),
    ...lists(),
    ...zips(),
    ...arrays(),
    ...points(),
    ...images(),
    ...real(),
  ].filter(({ bytes }) => bytes.length <= LARGEST);
}

function madeTexts(): Seed[] {
  return MADE_TEXTS.map(([subject, content]) => ({ subject, bytes: text(content) }));
}

function samples(): Seed[] {
  return readdirSync(SAMPLES).flatMap((name) => seedOf(name, readFileSync(`${SAMPLES}${name}`)));
}

function seedOf(path: string, bytes: Uint8Array): Seed[] {
  const subject = path.slice(path.lastIndexOf('.') + 1);
  return isSubject(subject) ? [{ subject, bytes: new Uint8Array(bytes) }] : [];
}

function random(): Seed[] {
  const gltf = fc.sample(randomGltf, { seed: 169, numRuns: RANDOM_FILES });
  const fbx = fc.sample(randomFbx, { seed: 169, numRuns: RANDOM_FILES });
  return [
    ...gltf.map((made): Seed => ({ subject: 'glb', bytes: glbOf(made) })),
    ...gltf.map(({ json, buffers: [bytes] }): Seed => {
      const uri = `data:application/octet-stream;base64,${Buffer.from(bytes).toString('base64')}`;
      const buffers = [{ byteLength: bytes.length, uri }];
      return { subject: 'gltf', bytes: text(JSON.stringify({ ...json, buffers })) };
    }),
    ...fbx.map((made, i): Seed => ({ subject: 'fbx', bytes: i % 2 ? fbxBytes(made) : text(fbxText(made)) })),
  ];
}

const TAKES: readonly ListedTake[] = [
  { path: 'a/walk.bvh', verdict: 'good', stars: 3, tags: ['left foot', 'x'], notes: 'says "no",\nthen yes; =1+1' },
  { path: 'b/run, fast.fbx', verdict: 'bad', stars: 0, tags: [], notes: '', frames: 12, fps: 29.97, joints: 31 },
  { path: 'ü 骨.bvh', verdict: '', stars: 5, tags: [], notes: "'-1", flags: ['spike 1.233 LeftHand', 'still'] },
];

function lists(): Seed[] {
  const hash = 'ab'.repeat(32);
  const written = { input: 'a.bvh', hash, output: 'a.npz', bytes: 100, frames: 3, fps: 30, joints: 2, key: 'k' };
  const manifest = [written, { input: 'b.bvh', error: 'It is empty.' }].map(lineOf).join('');
  return [
    { subject: 'review.csv', bytes: text(listAsCsv(TAKES)) },
    { subject: 'review.csv', bytes: text('path;stars;tags\r\na.bvh;2,0;x;y\r\n"b ""1"".bvh";;\r\n') },
    { subject: 'review.csv', bytes: text('a/walk.bvh\nb/run.bvh\n\n') },
    { subject: 'review.json', bytes: text(listAsJson(TAKES)) },
    { subject: 'review.json', bytes: text('["a.bvh", {"path": "b.bvh", "stars": "2"}, 3]') },
    { subject: 'manifest.ndjson', bytes: text(manifest) },
  ];
}

function zips(): Seed[] {
  const files = Object.fromEntries(
    MADE_TEXTS.slice(0, 6).map(([subject, content], i) => [`folder/${i}.${subject}`, text(content)]),
  );
  return [
    { subject: 'zip', bytes: zipSync(files) },
    { subject: 'zip', bytes: zipSync({ ...files, 'ü.txt': text('readme') }, { level: 0 }) },
  ];
}

/** Each kind of arrays that is read, in each layout. */
function arrays(): Seed[] {
  const wave = (...shape: readonly number[]): MadeArray => {
    const count = shape.reduce((product, n) => product * n, 1);
    return [shape, Float32Array.from({ length: count }, (_, i) => Math.sin(i))];
  };
  const own = {
    ...{ names: [[3], ['a', 'b', 'ü']], parents: [[3], Float64Array.of(-1, 0, 1)], offsets: wave(3, 3) },
    ...{
      local_quat: wave(4, 3, 4),
      world_quat: wave(4, 3, 4),
      positions: wave(4, 3, 3),
      fps: [[], Float64Array.of(30)],
    },
    ...{ end_names: [[1], ['b_end']], end_positions: wave(4, 1, 3), meta: [[], ['{"raw": true}']] },
  } satisfies Record<string, MadeArray>;
  const parts = { root_orient: wave(3, 3), pose_body: wave(3, 63), pose_hand: wave(3, 90), trans: wave(3, 3) };
  const zipped: readonly Readonly<Record<string, MadeArray>>[] = [
    own,
    { poses: wave(3, 72), J: wave(24, 3) },
    parts,
    { poses: wave(2, 165), joints: wave(2, 55, 3) },
  ];
  return [
    ...zipped.map((files, i): Seed => ({ subject: 'npz', bytes: npzOf(files, i % 2 ? 0 : 6) })),
    ...[22, 17, 25, 33].map((count): Seed => ({ subject: 'npy', bytes: npyOf(wave(3, count, 3)) })),
    { subject: 'npy', bytes: npyOf(wave(3, 263)) },
    { subject: 'npz', bytes: npzOf({ keypoints: wave(3, 4, 4), parents: [[4], Float64Array.of(-1, 0, 1, 0)] }) },
  ];
}

/** C3D of each processor, in whole numbers and floats. */
function points(): Seed[] {
  const labels = ['LASI', 'b c', '', 'LASI'];
  const frames = [0, 1, 2].map((f) =>
    labels.map((_, p): [number, number, number] | null => (p === f ? null : [f + p, 1000 - p, p / 2])),
  );
  const processors = ['intel', 'dec', 'mips'] as const;
  return processors.flatMap((processor) =>
    [undefined, 0.5].map((scale): Seed => {
      const form = { processor, analog: 2, first: 7, isLong: processor === 'mips', ...(scale && { scale }) };
      return { subject: 'c3d', bytes: c3dOf({ labels, frames, ...form }) };
    }),
  );
}

/** Headers, as far as readers look; that of a PNG is among the samples. */
function images(): Seed[] {
  const of = (subject: Subject, hex: string): Seed => ({ subject, bytes: new Uint8Array(Buffer.from(hex, 'hex')) });
  return [
    of('bmp', '424d46000000000000003600000028000000020000000200000001001800000000001000000000000000000000000000'),
    of('png', '89504e470d0a1a0a0000000d49484452000000010000000108060000001f15c489'),
    of('jpg', 'ffd8ffe000104a46494600010100000100010000ffc0001108000200020301220002110103110'),
    of('webp', '524946461a000000574542505650384c0d0000002f0000001007101111888808'),
  ];
}

function real(): Seed[] {
  if (!hasShared) return [];
  const names = readdirSync(sharedPath('data'), { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => `${entry.parentPath}/${entry.name}`.slice(sharedPath('').length))
    .sort();
  return names.flatMap((path) => seedOf(path, sharedBytes(path)));
}
