/** Characters by the dozen, each with a take that moves all of it: real files, and skeletons with takes made by chance. */
import { readdirSync, statSync } from 'node:fs';
import fc from 'fast-check';
import { loadFiles } from '../../../src/cli/load.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { type Character, EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import { rootDofCount } from '../../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { EXTRAPOLATIONS, type KeyedChannel, restChannel, type Take } from '../../../src/model/takes/take.ts';
import { FIXED_TANGENT, SMOOTH } from '../../../src/model/takes/tangent-kinds.ts';
import { skeleton as anySkeleton } from '../../formats/arbitraries.ts';
import { character, skin } from '../../helpers/builders.ts';
import { hasShared, sharedPath } from '../../helpers/shared.ts';

export interface Named {
  readonly name: string;
  readonly character: Character;
}

/** Numbers from 0 to 1, the same each time (mulberry32). */
function chance(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

export interface TakeStyle {
  /** Radians that angles reach. */
  readonly angle: number;
  readonly seconds: number;
  readonly keysPerSecond: number;
  /** Whether keys may be steps and repeat beyond their ends. */
  readonly isWild?: boolean;
}

/** A take with keys of every DOF. */
export function randomTake(skeleton: Skeleton, seed: number, size: number, style: TakeStyle): Take {
  const random = chance(seed);
  const between = (low: number, high: number) => low + (high - low) * random();
  const { angle, seconds, keysPerSecond, isWild = false } = style;
  const channel = (rest: number, reach: number): KeyedChannel => {
    const count = 2 + Math.floor(random() * 2 * seconds * keysPerSecond);
    const frames = new Set(
      Array.from({ length: count }, () => Math.round(10 * between(isWild ? 0.2 * seconds : 0, seconds))),
    );
    const times = [...frames].sort((a, b) => a - b).map((frame) => frame / 10);
    if (isWild && times.length > 3) times[2] = times[1];
    const tangents = () => ({
      kinds: Uint8Array.from(times, () => (isWild ? Math.floor(random() * 4) : SMOOTH)),
      slopes: new Float64Array(times.length),
    });
    const fixed = (made: ReturnType<typeof tangents>) => {
      made.kinds.forEach((kind, k) => {
        if (kind === FIXED_TANGENT) made.slopes[k] = between(-2, 2) * reach;
      });
      return made;
    };
    const extrapolation = () => (isWild ? EXTRAPOLATIONS[Math.floor(random() * EXTRAPOLATIONS.length)] : 'constant');
    return {
      kind: 'keys',
      extrapolateIn: extrapolation(),
      extrapolateOut: extrapolation(),
      times: Float64Array.from(times),
      values: Float64Array.from(times, () => rest + between(-reach, reach)),
      tangentsIn: fixed(tangents()),
      tangentsOut: fixed(tangents()),
    };
  };
  const root = Array.from({ length: rootDofCount(skeleton) }, () => channel(0, 0.3 * size));
  const own = skeleton.joints.flatMap(({ motion }) =>
    dofsOf(motion).map(({ unit, rest }) =>
      channel(rest, unit === 'angle' ? angle : unit === 'length' ? 0.1 * size : rest === 1 ? 0.4 : 0.3),
    ),
  );
  return { name: 'random', range: [0, seconds], channels: [...root, ...own] };
}

const STYLES: readonly (readonly [string, TakeStyle])[] = [
  ['calm', { angle: 0.5, seconds: 2, keysPerSecond: 1 }],
  ['wide', { angle: 2.5, seconds: 2, keysPerSecond: 1 }],
  ['fast', { angle: 1.5, seconds: 2, keysPerSecond: 4 }],
  ['wild', { angle: 1.5, seconds: 2, keysPerSecond: 1, isWild: true }],
];

/** The character with a take of its own made by chance. */
function moved(name: string, own: Character, seed: number, size: number, styles = STYLES): Named[] {
  const { skeleton, morphs } = own;
  if (!skeleton) return [];
  return styles.map(([style, of]) => {
    const played = randomTake(skeleton, seed + STYLES.findIndex(([each]) => each === style), size, of);
    const take = { ...played, channels: [...played.channels, ...morphs.map(() => restChannel())] };
    return { name: `${name} ${style}`, character: { ...own, takes: [take], shownTake: 0 } };
  });
}

/**
 * With the last third of each take, where channels begin and end, and less of large skins, which are fitted by several
 * options: more of it takes longer, and shows nothing else.
 */
export function lastPart(all: readonly Named[]): readonly Named[] {
  return all.map(({ name, character }) => {
    const part = /^(six|nine|random 1) /.test(name) ? 0.2 : 0.35;
    const takes = character.takes.map((take) => {
      const [, end] = take.range;
      return { ...take, range: [(1 - part) * end, end] as const };
    });
    return { name, character: { ...character, takes } };
  });
}

function opened(paths: readonly string[]): readonly Character[] {
  const { files } = loadFiles(paths.map(sharedPath), '/');
  return openFiles(EMPTY_DOCUMENT, files).document.characters.filter(({ skeleton }) => skeleton);
}

/** Longer takes take minutes, and show nothing else. */
const MAX_BYTES = 300_000;

function filesIn(folder: string, ...ends: readonly string[]): string[] {
  if (!hasShared) return [];
  return readdirSync(sharedPath(folder))
    .map((name) => `${folder}/${name}`)
    .filter((path) => ends.some((end) => path.endsWith(end)) && statSync(sharedPath(path)).size < MAX_BYTES);
}

const TOGETHER: readonly (readonly string[])[] = [
  ['data/cse169/wasp.skel', 'data/cse169/wasp.skin', 'data/cse169/wasp_walk.anim'],
  ['data/lab/01.asf', 'data/lab/01_01.amc'],
  ['data/lab/07-walk.asf', 'data/lab/07_05-walk.amc'],
  ['data/lab/made.asf', 'data/lab/made_one.amc'],
];
const TAKELESS: readonly (readonly [string, number, ...(readonly string[])])[] = [
  ['dragon', 10, 'data/cse169/dragon.skel'],
  ['tube', 10, 'data/cse169/tube.skel', 'data/cse169/tube_smooth.skin'],
  ['tube rough', 10, 'data/cse169/tube.skel', 'data/cse169/tube.skin'],
  ['wasp', 10, 'data/cse169/wasp.skel', 'data/cse169/wasp.skin'],
  ['six', 3, 'data/synthetic/six.skel', 'data/synthetic/six.skin'],
  ['nine', 3, 'data/synthetic/nine.skel', 'data/synthetic/nine.skin'],
];

/** Real files with their own takes. */
export function realCharacters(): readonly Named[] {
  if (!hasShared) return [];
  const single = [
    ...filesIn('data/bvh', '.bvh'),
    ...filesIn('data/fbx', '.fbx'),
    ...filesIn('data/gltf', '.glb'),
    'data/gltf/cs-rotate/01_cs_rotate.gltf',
    'data/gltf/parent-inverse/06_parent-inverse-anim.gltf',
    'data/gltf/skinned-cylinder/03_skinned_cylinder.gltf',
    ...filesIn('data/lab', '.c3d', '.trc', '.npz', '.npy'),
  ].map((path) => [path]);
  return [...TOGETHER, ...single].flatMap((paths) =>
    opened(paths).flatMap((own) =>
      own.takes.length ? [{ name: `${paths[0].slice(5)} ${own.name}`, character: { ...own, shownTake: 0 } }] : [],
    ),
  );
}

/** Real skeletons with takes made by chance; only those of some names, if asked for. */
export function movedCharacters(isWanted: (name: string) => boolean = () => true): readonly Named[] {
  if (!hasShared) return [];
  const axis = filesIn('data/axis-skel', '.axskel').map((path) => [path.slice(15), 3, path] as const);
  return [...axis, ...TAKELESS].flatMap(([name, size, ...paths], i) => {
    const styles = STYLES.filter(([style]) => isWanted(`${name} ${style}`));
    return styles.length ? opened(paths).flatMap((own) => moved(name, own, 100 * i, size, styles)) : [];
  });
}

const VERTICES = 40;

/** A skin around the joints of a skeleton by chance, whose vertices follow up to seven joints. */
function randomSkin({ joints }: Skeleton, seed: number) {
  const random = chance(seed);
  const start = [0];
  const owners: number[] = [];
  const weights: number[] = [];
  for (let v = 0; v < VERTICES; v++) {
    const own = new Set(
      Array.from({ length: 1 + Math.floor(random() * 7) }, () => Math.floor(random() * joints.length)),
    );
    const parts = [...own].map(() => random() + 0.01);
    const sum = parts.reduce((a, b) => a + b, 0);
    [...own].forEach((joint, a) => {
      owners.push(joint);
      weights.push(parts[a] / sum);
    });
    start.push(owners.length);
  }
  return skin('random', joints.length - 1, {
    positions: Float64Array.from({ length: 3 * VERTICES }, () => 4 * random() - 2),
    normals: Float64Array.from({ length: 3 * VERTICES }, (_, i) => (i % 3 === 2 ? 1 : 0)),
    attachments: {
      start: Uint32Array.from(start),
      joints: Uint32Array.from(owners),
      weights: Float64Array.from(weights),
    },
  });
}

/** Skeletons made by chance of joints of all types, with ordinary lengths, half of them with a skin. */
export function randomCharacters(count: number, seed = 1): readonly Named[] {
  return fc.sample(anySkeleton, { numRuns: count, seed }).flatMap((made, i) => {
    const random = chance(seed + i);
    const joints = made.joints.map(({ couples: _, ...joint }) => ({
      ...joint,
      offset: [0, 1, 2].map(() => 2 * random() - 1) as unknown as readonly [number, number, number],
      motion: joint.motion.kind === 'screw' ? { ...joint.motion, pitch: random() } : joint.motion,
      limits: joint.limits.map(() => ({ min: -Infinity, max: Infinity })),
      pose: dofsOf(joint.motion).map(({ rest }) => rest),
      ...(joint.length !== undefined && { length: random() }),
    }));
    const skeleton = { name: 'x', joints };
    const own = character({ name: `random ${i}`, skeleton, ...(i % 2 && { skins: [randomSkin(skeleton, seed + i)] }) });
    return moved(`random ${i}`, own, 1000 * seed + 10 * i, 3, [STYLES[i % STYLES.length]]);
  });
}
