import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { documentIn } from '../../src/edit/change.ts';
import { keyPose } from '../../src/edit/commands/keying.ts';
import { setDofs } from '../../src/edit/commands/pose.ts';
import { Store } from '../../src/edit/store.ts';
import { compileTake } from '../../src/evaluate/compiled-take.ts';
import { evaluateTake } from '../../src/evaluate/curves.ts';
import { dofCountOf, isDriven, poseAt } from '../../src/evaluate/pose.ts';
import { readAnim } from '../../src/formats/anim/read.ts';
import { writeAnim } from '../../src/formats/anim/write.ts';
import { type Character, type Document, shownTake } from '../../src/model/document.ts';
import { type Channel, keysOf, restChannel } from '../../src/model/takes/take.ts';
import { FLAT, LINEAR, SMOOTH } from '../../src/model/takes/tangent-kinds.ts';
import { character, documentOf, joint, morph, takeOfValues } from '../helpers/builders.ts';

const hip = joint(-1, { name: 'hip', limits: [0, 1, 2].map(() => ({ min: -1, max: 1 })) });
/** 3 of the root, 3 of the hip, 3 of the leg, a morph. */
const bare = character({
  name: 'Wasp the first',
  skeleton: { name: 'wasp', joints: [hip, joint(0, { name: 'leg' })] },
  morphs: [morph('smile')],
  pose: [0, 5, 0, 0.1, 0.2, 0.3, 2, -2, 0, 0.5],
});

const posed = (c: Character, time: number) => {
  const out = new Float64Array(dofCountOf(c));
  poseAt(c, time, out);
  return [...out];
};
const only = (document: Document) => document.characters[0];
const key = (c: Character, timeSeconds: number, more: Partial<Parameters<typeof keyPose.run>[1]> = {}) =>
  keyPose.run(documentOf(c), { characterId: 'c1', timeSeconds, ...more });
const onlyTake = (c: Character) => {
  const shown = shownTake(c);
  if (!shown) throw new Error('no take is shown');
  return shown;
};
const points = (channel: Channel) => [...keysOf(channel).times].map((time, k) => [time, keysOf(channel).values[k]]);

describe('pose.key on a character without animation', () => {
  it('creates a take that finds its skeleton again by its name', () => {
    const made = onlyTake(only(key(bare, 0).document));
    expect(made.name).toBe('wasp_anim');
    expect(made.channels).toHaveLength(10);
    expect(made.channels.map(points)).toEqual(bare.pose.map((value) => [[0, value]]));
  });

  it('extends constantly from smooth keys, or has the tangents that are wanted', () => {
    for (const [tangents, kind] of [
      [undefined, SMOOTH],
      ['linear', LINEAR],
      ['flat', FLAT],
    ] as const) {
      const [channel] = onlyTake(only(key(bare, 0, { tangents }).document)).channels;
      expect([channel.extrapolateIn, channel.extrapolateOut]).toEqual(['constant', 'constant']);
      expect([keysOf(channel).tangentsIn.kinds[0], keysOf(channel).tangentsOut.kinds[0]]).toEqual([kind, kind]);
    }
  });

  it('keys only the requested DOFs; all others keep their values at every time', () => {
    const { document, keys } = key(bare, 0.5, { dofs: [4, 3] });
    const keyed = only(document);
    expect(keys).toEqual([
      { channel: 3, indices: [0] },
      { channel: 4, indices: [0] },
    ]);
    expect(onlyTake(keyed).channels.map((c) => keysOf(c).times.length)).toEqual([0, 0, 0, 1, 1, 0, 0, 0, 0, 0]);
    for (const time of [-1, 0.5, 7]) expect(posed(keyed, time)).toEqual(posed(bare, 0));
    expect([3, 5].map((dof) => isDriven(keyed, dof))).toEqual([true, false]);
  });

  it('plays what the transport plays, or up to the key and at least a second', () => {
    const range = (timeSeconds: number, playedRange?: readonly [number, number], offset = 0) =>
      onlyTake(only(key({ ...bare, timeOffsetSeconds: offset }, timeSeconds, { playedRange }).document)).range;
    expect(range(1, [0, 4])).toEqual([0, 4]);
    expect(range(1, [2, 2])).toEqual([0, 1]);
    expect(range(3)).toEqual([0, 3]);
    expect(range(-3)).toEqual([-3, 1]);
    // The transport's seconds are not the take's.
    expect(range(1, [0, 4], 10)).toEqual([10, 14]);
  });

  it('refuses without a skeleton, whose DOFs channels correspond to', () => {
    const { skeleton: _none, ...skinless } = bare;
    expect(() => key(skinless, 0)).toThrow('no skeleton');
  });
});

describe('pose.key over a take', () => {
  const steady = takeOfValues('walk', [0, 0, 0, 0, 0, 0]);
  const walking: Character = { ...bare, takes: [steady], shownTake: 0 };

  it('changes a key that is there, and leaves it its tangents', () => {
    const moved = documentIn(
      setDofs.run(documentOf(walking), { characterId: 'c1', dofs: [{ index: 3, value: 0.5 }], timeSeconds: 0 }),
    );
    const [, , , channel] = onlyTake(only(key(only(moved), 0).document)).channels;
    expect(points(channel)).toEqual([[0, 0.5]]);
    expect(keysOf(channel).tangentsIn.kinds[0]).toBe(FLAT);
  });

  it('finds the key again whose time was computed with an offset', () => {
    const shifted = { ...walking, timeOffsetSeconds: 0.1 };
    const once = only(key(shifted, 0.2, { dofs: [3] }).document);
    const again = only(key(once, 0.3 - 0.1 + Number.EPSILON, { dofs: [3] }).document);
    expect(keysOf(onlyTake(again).channels[3]).times).toHaveLength(2);
  });

  it('pose.key over a take makes what it keys no longer unkeyed, and nothing else', () => {
    const dofs = [3, 4].map((index) => ({ index, value: 0.5 }));
    const byHand = only(documentIn(setDofs.run(documentOf(walking), { characterId: 'c1', dofs, timeSeconds: 2 })));
    expect(only(key(byHand, 2, { dofs: [3] }).document).unkeyed).toEqual({ timeSeconds: 2, dofs: [4], values: [0.5] });
    expect('unkeyed' in only(key(byHand, 2).document)).toBe(false);
  });

  it('adds the channels that are missing, standing at the pose', () => {
    const { channels } = onlyTake(only(key(walking, 1, { dofs: [3] }).document));
    expect(channels.slice(6)).toEqual(bare.pose.slice(6).map((value) => restChannel(value)));
    expect(channels[0]).toBe(steady.channels[0]);
  });

  it('changes nothing where everything is keyed so already', () => {
    const once = key(walking, 0).document;
    const again = keyPose.run(once, { characterId: 'c1', timeSeconds: 0 });
    expect(again.document).toBe(once);
  });

  it('selects the keys, and undo restores the previous selection', () => {
    const store = new Store(documentOf(walking));
    store.select({ characterId: 'c1', joint: 1 });
    store.apply(keyPose, { characterId: 'c1', timeSeconds: 1, dofs: [6, 7] });
    expect(store.selection.keys).toEqual([
      { channel: 6, indices: [0] },
      { channel: 7, indices: [0] },
    ]);
    store.undo();
    expect(store.selection).toEqual({ characterId: 'c1', joint: 1 });
  });

  it('pose.key over a take is named after what it keys', () => {
    const label = (dofs?: number[]) =>
      keyPose.label(documentOf(walking), { characterId: 'c1', timeSeconds: 0, ...(dofs && { dofs }) });
    expect([label(), label([4]), label([6, 7, 8]), label([0, 1, 2, 3, 4, 5]), label([3, 6])]).toEqual([
      'Key pose of Wasp the first',
      'Key ry of hip',
      'Key leg',
      'Key hip',
      'Key 2 joints',
    ]);
  });

  it('refuses DOFs that do not exist, and unknown tangents', () => {
    expect(() => key(walking, 0, { dofs: [10] })).toThrow('no DOF number 10');
    expect(() => key(walking, Number.NaN)).toThrow('finite');
    // As a script may say it.
    expect(() => key(walking, 0, { tangents: 'fixed' as never })).toThrow('"smooth"');
  });
});

const time = fc.integer({ min: -400, max: 400 }).map((n) => n / 100);
const value = fc.double({ min: -3, max: 3, noNaN: true });
const extrapolation = fc.constantFrom('constant', 'linear', 'cycle', 'cycle_offset', 'bounce' as const);

/** Posing and keying in any order, on a take whose channels extrapolate in any way. */
const session = fc.record({
  extrapolations: fc.array(fc.tuple(extrapolation, extrapolation), { minLength: 10, maxLength: 10 }),
  clamps: fc.boolean(),
  offset: time,
  steps: fc.array(
    fc.record({
      at: time,
      set: fc.uniqueArray(fc.record({ index: fc.nat(9), value }), { maxLength: 4, selector: (d) => d.index }),
      dofs: fc.option(fc.uniqueArray(fc.nat(9), { minLength: 1 }), { nil: undefined }),
      tangents: fc.constantFrom('smooth', 'linear', 'flat' as const),
    }),
    { minLength: 1, maxLength: 12 },
  ),
});

describe('continued keying', () => {
  it('continued keying never changes the pose at the moment that is keyed', () => {
    fc.assert(
      fc.property(session, ({ extrapolations, clamps, offset, steps }) => {
        let document = documentOf({ ...bare, clampsToLimits: clamps, timeOffsetSeconds: offset });
        for (const [i, { at, set, dofs, tangents }] of steps.entries()) {
          document = documentIn(setDofs.run(document, { characterId: 'c1', dofs: set, timeSeconds: at }));
          const shown = posed(only(document), at);
          document = keyPose.run(document, { characterId: 'c1', timeSeconds: at, dofs, tangents }).document;
          const after = posed(only(document), at);
          const moved = [...shown.keys()].filter((d) => !(Math.abs(after[d] - shown[d]) < 5e-10));
          expect(moved).toEqual([]);
          const free = [...(dofs ?? shown.keys())].filter((dof) => !isDriven(only(document), dof));
          expect(free).toEqual([]);
          if (i > 0) continue;
          const made = onlyTake(only(document));
          const channels = made.channels.map((c, d) => ({
            ...c,
            extrapolateIn: extrapolations[d][0],
            extrapolateOut: extrapolations[d][1],
          }));
          document = documentOf({ ...only(document), takes: [{ ...made, channels }] });
        }
      }),
    );
  });

  it('continued keying is in the file what it is on screen, at all times', () => {
    fc.assert(
      fc.property(session, fc.array(time, { minLength: 1 }), ({ steps }, times) => {
        let document = documentOf(bare);
        for (const { at, set, dofs, tangents } of steps) {
          document = documentIn(setDofs.run(document, { characterId: 'c1', dofs: set, timeSeconds: at }));
          document = keyPose.run(document, { characterId: 'c1', timeSeconds: at, dofs, tangents }).document;
        }
        const take = onlyTake(only(document));
        const { value: read, diagnostics } = readAnim(writeAnim(take).text, 'wasp_anim.anim');
        expect(diagnostics).toEqual([]);
        if (!read) throw new Error('was not read');
        const [here, there] = [new Float64Array(10), new Float64Array(10)];
        for (const t of times) {
          evaluateTake(compileTake(take), t, here);
          evaluateTake(compileTake(read), t, there);
          expect([...there]).toEqual([...here]);
        }
      }),
    );
  });
});
