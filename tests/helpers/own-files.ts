/**
 * Small files of the project's own, of every kind that is read and written: examples, and captures that are made here.
 * Tests of all files at hand have them, and those of `../shared` where they are.
 */
import { readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { Capture } from '../../src/model/files.ts';
import type { Skeleton } from '../../src/model/skeleton/skeleton.ts';
import { writeBvh } from './bvh-text.ts';
import { personSkeleton, takeOfRoots } from './mocap.ts';

const EXAMPLES = fileURLToPath(new URL('../../public/samples/', import.meta.url));
/** In bytes. */
const SMALL = 20_000;

/** Two seconds of a walk: hips sway and go forward, legs swing, and the head nods. */
function walk(skeleton: Skeleton, up: 'y' | 'z'): Capture {
  const frames = Array.from({ length: 60 }, (_, f) => f / 30);
  const height = (t: number) => 90 + 2 * Math.cos(4 * Math.PI * t);
  const forward = (t: number) => 100 * t + 3 * Math.sin(4 * Math.PI * t);
  const roots = frames.map((t): [number, number, number] => {
    const sway = 3 * Math.sin(2 * Math.PI * t);
    return up === 'y' ? [sway, height(t), forward(t)] : [sway, -forward(t), height(t)];
  });
  const take = takeOfRoots(skeleton, roots);
  const { samples } = take;
  if (!samples) throw new Error('The take is sampled.');
  const width = samples.scales.length;
  const first = new Map<string, number>();
  let column = 0;
  for (const { name, motion } of skeleton.joints) {
    if (motion.kind !== 'bvh') continue;
    first.set(name, column + motion.channels.indexOf('rx'));
    column += motion.channels.length;
  }
  const swing: Readonly<Record<string, readonly [degrees: number, phase: number]>> = {
    Hips: [4, 0.1],
    Head: [5, 0.3],
    LeftLeg: [28, 0],
    RightLeg: [28, 0.5],
    LeftFoot: [12, 0.2],
    RightFoot: [12, 0.7],
  };
  for (const [name, [degrees, phase]] of Object.entries(swing)) {
    frames.forEach((t, f) => {
      samples.values[f * width + (first.get(name) ?? 0)] = degrees * Math.sin(2 * Math.PI * (t + phase));
    });
  }
  return { skeleton, take: { ...take, samples: { ...samples, frameSeconds: 1 / 30 }, range: [0, 59 / 30] } };
}

function captureText(name: string, up: 'y' | 'z', positionsEverywhere: boolean): string {
  return writeBvh([walk(personSkeleton({ up, positionsEverywhere }), up)], name).text;
}

const text = (content: string) => new TextEncoder().encode(content);

/** By name: `own-walk.bvh`. */
export const OWN_CAPTURES: ReadonlyMap<string, Uint8Array> = new Map([
  ['own-walk.bvh', text(captureText('own-walk.bvh', 'y', false))],
  ['own-walk-z.bvh', text(captureText('own-walk-z.bvh', 'z', true))],
]);

/** By path: `own/cube.skel`. */
export const OWN_FILES: ReadonlyMap<string, Uint8Array> = new Map(
  readdirSync(EXAMPLES)
    .filter((name) => /\.(skel|skin|morph|anim|rig)$/.test(name))
    .map((name): [string, Uint8Array] => [`own/${name}`, new Uint8Array(readFileSync(EXAMPLES + name))])
    .filter(([, bytes]) => bytes.length < SMALL),
);
