/** Drags as commands: a joint by IK, and a key of a motion path. */
import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { documentIn, isChange } from '../../src/edit/change.ts';
import { setLocked } from '../../src/edit/commands/beside/sets.ts';
import { moveByIk, movePathKey } from '../../src/edit/commands/drags/drags.ts';
import { Store } from '../../src/edit/store.ts';
import { dofsOnPath, timesOnPath } from '../../src/evaluate/ik/path-dofs.ts';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../src/evaluate/pose.ts';
import { openFiles } from '../../src/files/open/open-files.ts';
import type { Vec3 } from '../../src/math/vec3.ts';
import { type Document, EMPTY_DOCUMENT } from '../../src/model/document.ts';
import type { Skeleton } from '../../src/model/skeleton/skeleton.ts';
import { motionOf, withActive } from '../../src/model/takes/layers.ts';
import { keysOf, restChannel } from '../../src/model/takes/take.ts';
import { parse } from '../../src/worker/parse.ts';
import { character, documentOf, joint, takeOfValues } from '../helpers/builders.ts';
import { expectEdit } from '../helpers/expect-edit.ts';
import { channelOf } from './keys/channels.ts';
import { layeredTake, layerOf } from './layers/layered.ts';
import { documentWith, swing, WIDTH } from './samples/made.ts';

/** Hips with two legs of two bones and feet. */
const JOINTS = [
  joint(-1, { name: 'hips', offset: [0, 2, 0] }),
  joint(0, { name: 'thigh_l', offset: [0.2, 0, 0] }),
  joint(1, { name: 'shin_l', offset: [0, -1, 0.05] }),
  joint(2, { name: 'foot_l', offset: [0, -1, 0] }),
  joint(0, { name: 'thigh_r', offset: [-0.2, 0, 0] }),
  joint(4, { name: 'shin_r', offset: [0, -1, 0.05] }),
  joint(5, { name: 'foot_r', offset: [0, -1, 0] }),
];
const DOFS = 24;
const FOOT = 3;
const still = character({ skeleton: { name: 'hero', joints: JOINTS }, pose: Array<number>(DOFS).fill(0) });
const wave = (at: number) =>
  channelOf([
    [0, 0],
    [1, 0.1 * (at % 3)],
    [2, 0],
  ]);
const walking = character({
  ...still,
  takes: [{ ...takeOfValues('walk', []), range: [0, 2], channels: Array.from({ length: DOFS }, (_, d) => wave(d)) }],
  shownTake: 0,
});

function skeletonIn({ characters: [{ skeleton }] }: Document): Skeleton {
  if (!skeleton) throw new Error('It has a skeleton.');
  return skeleton;
}

function pivotOf(document: Document, of: number, timeSeconds: number): Vec3 {
  const [first] = document.characters;
  const skeleton = skeletonIn(document);
  const dofs = new Float64Array(dofCountOf(first));
  poseAt(first, timeSeconds, dofs);
  const world = new Float64Array(16 * skeleton.joints.length);
  worldMatrices(compileSkeleton(skeleton), dofs, world);
  return [world[16 * of + 12], world[16 * of + 13], world[16 * of + 14]];
}

const off = (a: Vec3, b: Vec3) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

describe('a drag by IK', () => {
  it('brings the joint where it is asked for by its limb alone, in one step', () => {
    const to: Vec3 = [0.2, 0.6, 0.5];
    const after = documentIn(
      expectEdit(documentOf(still), moveByIk, { characterId: 'c1', timeSeconds: 0, joint: FOOT, to }),
    );
    expect(off(pivotOf(after, FOOT, 0), to)).toBeLessThan(2e-3);
    const changed = after.characters[0].pose.flatMap((value, d) => (value !== 0 ? [d] : []));
    expect(changed.length).toBeGreaterThan(0);
    // Thigh, shin and foot of that leg.
    for (const d of changed) expect(d).toBeGreaterThanOrEqual(6);
    for (const d of changed) expect(d).toBeLessThan(15);
  });

  it('moves the body while planted feet hold', () => {
    const to: Vec3 = [0, 1.8, 0];
    const after = documentIn(
      expectEdit(documentOf(still), moveByIk, { characterId: 'c1', timeSeconds: 0, joint: 0, to, reach: 'body' }),
    );
    expect(off(pivotOf(after, 0, 0), to)).toBeLessThan(2e-3);
    for (const foot of [3, 6])
      expect(off(pivotOf(after, foot, 0), pivotOf(documentOf(still), foot, 0))).toBeLessThan(2e-3);
  });
});

describe('a key of a motion path', () => {
  it('moves by its limb, and only the keys at that time change', () => {
    const before = documentOf(walking);
    const [x, y, z] = pivotOf(before, FOOT, 1);
    const to: Vec3 = [x, y + 0.3, z + 0.1];
    const after = documentIn(expectEdit(before, movePathKey, { characterId: 'c1', timeSeconds: 1, joint: FOOT, to }));
    expect(off(pivotOf(after, FOOT, 1), to)).toBeLessThan(2e-3);
    after.characters[0].takes[0].channels.forEach((channel, d) => {
      const [was, now] = [keysOf(walking.takes[0].channels[d]), keysOf(channel)];
      expect([...now.times]).toEqual([0, 1, 2]);
      expect([now.values[0], now.values[2]]).toEqual([was.values[0], was.values[2]]);
      if (d < 6 || d >= 15) expect(now.values[1]).toBe(was.values[1]);
    });
  });

  it('of the root changes its translation', () => {
    const before = documentOf(walking);
    const after = documentIn(
      expectEdit(before, movePathKey, { characterId: 'c1', timeSeconds: 1, joint: 0, to: [1, 2, 3] }),
    );
    expect(off(pivotOf(after, 0, 1), [1, 2, 3])).toBeLessThan(1e-9);
    after.characters[0].takes[0].channels.forEach((channel, d) => {
      if (d >= 3) expect(channel).toBe(walking.takes[0].channels[d]);
    });
  });

  it('of a limb that reaches to the root turns joints, and leaves the translation', () => {
    const { takes, ...rope } = walking;
    const chain = { name: 'rope', joints: [0, 1, 2].map((j) => joint(j - 1, { name: `part${j}` })) };
    const before = documentOf({
      ...rope,
      skeleton: chain,
      takes: [{ ...takes[0], channels: takes[0].channels.slice(0, 12) }],
    });
    expect(dofsOnPath(chain, 2)).toEqual([3, 4, 5, 6, 7, 8, 9, 10, 11]);
    const args = { characterId: 'c1', timeSeconds: 1, joint: 2, to: [0.5, 1.9, 0.5] as const };
    const after = documentIn(movePathKey.run(before, args)).characters[0].takes[0].channels;
    for (const d of [0, 1, 2]) expect(after[d]).toBe(takes[0].channels[d]);
    expect(after.slice(3)).not.toEqual(takes[0].channels.slice(3, 12));
  });

  it('DOFs without a key there, and locked ones, stay; where there is none, it says so', () => {
    const [take] = walking.takes;
    const only = { ...take, channels: take.channels.map((channel, d) => (d === 7 ? restChannel() : channel)) };
    const { document: before } = new Store(documentOf({ ...walking, takes: [only] }));
    const locked = setLocked.run(before, { characterId: 'c1', dofs: [6], locked: true });
    const [x, y, z] = pivotOf(locked, FOOT, 1);
    const args = { characterId: 'c1', timeSeconds: 1, joint: FOOT, to: [x, y + 0.2, z] as const };
    const change = movePathKey.run(locked, args);
    expect(isChange(change) && change.locked).toBe(1);
    const after = documentIn(change).characters[0].takes[0].channels;
    for (const d of [6, 7]) expect(after[d]).toBe(only.channels[d]);
    expect(() => movePathKey.run(locked, { ...args, timeSeconds: 0.5 })).toThrow('no key at 0.5 s');
    const all = setLocked.run(before, { characterId: 'c1', dofs: [6, 8, 9, 10, 11, 12, 13, 14], locked: true });
    expect(() => movePathKey.run(all, args)).toThrow('All 8 DOFs are locked');
  });

  it('goes into the active layer, or that says why not', () => {
    const channels = walking.takes[0].channels;
    const layer = layerOf([...channels], { name: 'arm', weight: 0.5 });
    const layered = (list = [layer], active = 0) =>
      documentOf({ ...walking, takes: [withActive(layeredTake(channels, list), active)] });
    const before = layered();
    const [x, y, z] = pivotOf(before, FOOT, 1);
    const to: Vec3 = [x, y + 0.2, z];
    const args = { characterId: 'c1', timeSeconds: 1, joint: FOOT, to };
    const after = documentIn(movePathKey.run(before, args));
    expect(off(pivotOf(after, FOOT, 1), to)).toBeLessThan(2e-3);
    const [take] = after.characters[0].takes;
    expect(motionOf(take, -1)).toBe(motionOf(before.characters[0].takes[0], -1));
    expect(motionOf(take, 0).channels).not.toEqual(channels);
    expect(() => movePathKey.run(layered([{ ...layer, mute: true }]), args)).toThrow(
      'The layer "arm" is muted: keys there would not show.',
    );
  });

  it('of a capture is the frame there, and no other number of the file changes', () => {
    const before = documentWith();
    const { frameSeconds } = swing.samples ?? { frameSeconds: 1 };
    for (const [what, frame, joint] of [
      ['its limb', 40, 2],
      ['the root', 41, 0],
    ] as const) {
      const timeSeconds = frame * frameSeconds;
      const [x, y, z] = pivotOf(before, joint, timeSeconds);
      const to: Vec3 = [x + 0.1, y - 0.2, z + 0.2];
      const after = documentIn(expectEdit(before, movePathKey, { characterId: 'c1', timeSeconds, joint, to }));
      if (joint === 0) expect(off(pivotOf(after, joint, timeSeconds), to), what).toBeLessThan(1e-9);
      const [was, now] = [before, after].map((d) => d.characters[0].takes[0].samples?.values ?? []);
      const changed = [...was.keys()].filter((i) => was[i] !== now[i]);
      expect(changed.length).toBeGreaterThan(0);
      expect(new Set(changed.map((i) => Math.floor(i / WIDTH)))).toEqual(new Set([frame]));
      expect(changed.every((i) => i % WIDTH < 3 === (joint === 0))).toBe(true);
    }
    const between = { characterId: 'c1', timeSeconds: 40.5 * frameSeconds, joint: 2, to: [0, 0, 0] as const };
    expect(() => movePathKey.run(before, between)).toThrow('has no key at');
  });
});

describe('any time with a key on a path', () => {
  const examples = (): Promise<Document[]> =>
    Promise.all([exampleOf('walker', 'walk'), exampleOf('crawler', 'walk'), exampleOf('joints', 'each')]);

  it('a drag by nothing changes nothing', async () => {
    for (const { document, joint, timeSeconds } of (await examples()).flatMap(handles)) {
      const to = pivotOf(document, joint, timeSeconds);
      const [{ id: characterId }] = document.characters;
      expect(documentIn(movePathKey.run(document, { characterId, timeSeconds, joint, to }))).toBe(document);
    }
  });

  it('a drag changes keys of its DOFs at that time alone, and undo brings all back', async () => {
    for (const { document, joint, timeSeconds } of (await examples()).flatMap(handles)) {
      const [character] = document.characters;
      const [x, y, z] = pivotOf(document, joint, timeSeconds);
      const to: Vec3 = [x + 0.02, y, z];
      const store = new Store(document);
      store.apply(movePathKey, { characterId: character.id, timeSeconds, joint, to });
      const after = store.document.characters[0].takes[0].channels;
      const dofs = dofsOnPath(skeletonIn(document), joint);
      character.takes[0].channels.forEach((before, d) => {
        if (after[d] === before) return;
        expect(dofs).toContain(d);
        const [was, now] = [keysOf(before), keysOf(after[d])];
        expect([...now.times]).toEqual([...was.times]);
        // On the seam of a loop both ends are one key.
        const ends = [was.times[0], was.times[was.times.length - 1]];
        const isSeam = ends.includes(timeSeconds);
        now.times.forEach((time, k) => {
          if (time !== timeSeconds && !(isSeam && ends.includes(time))) expect(now.values[k]).toBe(was.values[k]);
        });
      });
      if (store.document !== document) store.undo();
      expect(store.document).toBe(document);
    }
  });
});

interface Handle {
  readonly document: Document;
  readonly joint: number;
  readonly timeSeconds: number;
}

/** Some joints, each at some times with keys. */
function handles(document: Document): Handle[] {
  const [character] = document.characters;
  const { joints } = skeletonIn(document);
  const { range } = character.takes[0];
  return [...joints.keys()]
    .filter((j) => j % 4 === 0 || j === joints.length - 1)
    .flatMap((j) => {
      const { keys } = timesOnPath(character, j, range, 1000);
      return [...new Set([keys[0], keys[keys.length >> 1]])].flatMap((timeSeconds) =>
        timeSeconds === undefined ? [] : [{ document, joint: j, timeSeconds }],
      );
    });
}

async function exampleOf(name: string, take: string): Promise<Document> {
  const files = [`${name}.skel`, `${name}_${take}.anim`].map((path) => {
    return { path, blob: new Blob([readFileSync(new URL(`../../public/samples/${path}`, import.meta.url))]) };
  });
  return openFiles(EMPTY_DOCUMENT, (await parse({ files }, () => undefined)).files).document;
}
