/** Feet of real takes, held: measured at frames, halfway between them and at times that are neither. */
import { describe, expect, it } from 'vitest';
import { loadFiles } from '../../../src/cli/load.ts';
import { holdSteps } from '../../../src/edit/commands/hold.ts';
import { pinPoint } from '../../../src/edit/commands/ik.ts';
import { Store } from '../../../src/edit/store.ts';
import { defaultPinPoint } from '../../../src/evaluate/ik/pin-points.ts';
import { reachOfSkeleton } from '../../../src/evaluate/ik/set-up.ts';
import { runToEnd } from '../../../src/evaluate/steps.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { type Character, EMPTY_DOCUMENT, shownSkin, shownTake } from '../../../src/model/document.ts';
import { documentOf } from '../../helpers/builders.ts';
import { describeShared, sharedPath } from '../../helpers/shared.ts';
import { characterOf } from '../../teaching/lesson-files.ts';

/** As stated of keys, a part of the reach. Frames of samples are what they are: between them nothing is promised. */
const OF_KEYS = 1e-3;
const OF_SAMPLES = 5e-3;

interface Asked {
  readonly joints: readonly string[];
  readonly range: readonly [number, number];
  readonly tolerance: number;
}

function expectHeld(own: Character, { joints, range, tolerance }: Asked): void {
  const { skeleton } = own;
  if (!skeleton) throw new Error('no skeleton');
  const store = new Store(documentOf(own));
  const { document } = store;
  for (const name of joints) {
    const joint = skeleton.joints.findIndex((j) => j.name === name);
    const { point } = defaultPinPoint(skeleton, joint, shownSkin(own));
    store.apply(pinPoint, { characterId: own.id, joint, point });
  }
  const pins = joints.map((_, p) => p + 1);
  const pinned = store.document;
  const args = { characterId: own.id, pins, range, atSeconds: range[0], framesPerSecond: 30 };
  const { edit, report } = runToEnd(holdSteps(pinned, args));
  const reach = reachOfSkeleton(skeleton);
  const worst = (of: 'slideBefore' | 'slideAfter') => Math.max(...report.pins.map((pin) => pin[of]));
  expect(report.unreached).toBe(0);
  expect(worst('slideBefore')).toBeGreaterThan(0.05 * reach);
  expect(worst('slideAfter')).toBeLessThan(tolerance * reach);
  const [before, after] = [shownTake(own), shownTake(edit.document.characters[0])];
  const changed = after?.channels.flatMap((channel, c) => (channel === before?.channels[c] ? [] : [c])) ?? [];
  expect(report.channels).toEqual(expect.arrayContaining(changed));
  expect(document).not.toBe(pinned);
}

describe('the walker', () => {
  const morphs = ['blink', 'breathe', 'smile'].map((name) => `walker_${name}.morph`);
  const walker = characterOf('walker.skel', 'walker.skin', ...morphs, 'walker_walk.anim');

  it('the walker keeps a foot in place that would move on', () => {
    expectHeld(walker, { joints: ['foot_l'], range: [0.4, 0.9], tolerance: OF_KEYS });
  });

  it('the walker keeps both of its toes in place', () => {
    expectHeld(walker, { joints: ['toe_l', 'toe_r'], range: [0.4, 0.7], tolerance: OF_KEYS });
  });
});

describeShared('takes of others', () => {
  const opened = (...files: string[]): Character => {
    const loaded = loadFiles(
      files.map((file) => sharedPath(`data/${file}`)),
      '/',
    );
    return openFiles(EMPTY_DOCUMENT, loaded.files, loaded.broken).document.characters[0];
  };
  const wasp = () => opened('cse169/wasp.skel', 'cse169/wasp.skin', 'cse169/wasp_walk.anim');
  const feet = ['01', '02', '03'].flatMap((n) => [`knee_${n}_l`, `knee_${n}_r`]);

  it('the wasp stands on one foot, whose end is that of its skin', () => {
    expectHeld(wasp(), { joints: ['knee_01_l'], range: [0.5, 1.5], tolerance: OF_KEYS });
  });

  it('the wasp stands on all six feet', () => {
    expectHeld(wasp(), { joints: feet, range: [0.5, 1], tolerance: OF_KEYS });
  });

  it('needs no key that could be removed and the feet still hold', () => {
    const own = wasp();
    const { skeleton } = own;
    if (!skeleton) throw new Error('no skeleton');
    const store = new Store(documentOf(own));
    for (const name of feet) {
      const joint = skeleton.joints.findIndex((j) => j.name === name);
      store.apply(pinPoint, {
        characterId: own.id,
        joint,
        point: defaultPinPoint(skeleton, joint, shownSkin(own)).point,
      });
    }
    const pins = feet.map((_, p) => p + 1);
    const args = { characterId: own.id, pins, range: [0.2, 0.7], atSeconds: 0.2, framesPerSecond: 30 } as const;
    const { edit } = runToEnd(holdSteps(store.document, args));
    const keyed = edit.keys?.reduce((sum, { indices }) => sum + indices.length, 0);
    // With a key on every frame 3570, and 499 where each curve is thinned by itself.
    expect(keyed).toBeGreaterThan(200);
    expect(keyed).toBeLessThan(400);
  });

  it('a captured walk keeps a foot in place, frame by frame', () => {
    expectHeld(opened('bvh/cmu-01_01.bvh'), { joints: ['LeftFoot'], range: [6.88, 7.88], tolerance: OF_SAMPLES });
  });
});
