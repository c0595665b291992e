import { describe, expect, it } from 'vitest';
import type { Command } from '../../src/edit/command.ts';
import { CommandError } from '../../src/edit/command-error.ts';
import { placeCharacter, removeCharacter, setTimeOffset, showTake } from '../../src/edit/commands/characters.ts';
import { keyPose } from '../../src/edit/commands/keying.ts';
import { insertKeys, moveKeys, removeKeys } from '../../src/edit/commands/keys.ts';
import { setDofs } from '../../src/edit/commands/pose.ts';
import { bakeRetarget, changeRetarget, clearRetarget, setRetarget } from '../../src/edit/commands/retarget.ts';
import { cropSamples, smoothSamples } from '../../src/edit/commands/samples.ts';
import { setTakeRange } from '../../src/edit/commands/take.ts';
import { Store } from '../../src/edit/store.ts';
import { commonFrames } from '../../src/evaluate/compare/distance.ts';
import { channelOf, dofCountOf, isDriven, poseAt } from '../../src/evaluate/pose.ts';
import { retargetPlan } from '../../src/evaluate/retarget/make-plan.ts';
import { type Character, DEFAULT_PLACEMENT, findCharacter, rangeOfTakes, shownTake } from '../../src/model/document.ts';
import { jointDofCount } from '../../src/model/skeleton/dofs.ts';
import { keysOf } from '../../src/model/takes/take.ts';
import { PARTS, person, takeOfRows } from '../evaluate/retarget/people.ts';
import { character, documentOf, morph, takeOfValues } from '../helpers/builders.ts';

const SOURCE = person();
/** Nods, turns and moves up and down. */
const ROWS = Array.from({ length: 12 }, (_, f) => {
  const row = new Array<number>(jointDofCount(SOURCE)).fill(0);
  row[1] = 0.9;
  return row.map((v, d) => (d > 5 ? 0.3 * Math.sin(f / 2 + d) : v));
});

function store(): Store {
  const source = character({
    id: 's',
    name: 'dancer',
    skeleton: SOURCE,
    takes: [takeOfRows(SOURCE, ROWS)],
    shownTake: 0,
  });
  const own = person({ size: 0.6, droop: 0.6, motion: () => ({ kind: 'ball', order: 'xyz' }) });
  const target = character({
    id: 't',
    name: 'walker',
    skeleton: own,
    morphs: [morph('smile')],
    takes: [takeOfValues('own', [...Array<number>(3 + 3 * PARTS.length).fill(0.1), 0.7])],
    shownTake: 0,
  });
  return new Store(documentOf(source, target));
}

const of = (s: Store, id: string): Character => {
  const found = findCharacter(s.document, id);
  if (!found) throw new Error(`no ${id}`);
  return found;
};

function poseOf(c: Character, seconds: number): Float64Array {
  const dofs = new Float64Array(dofCountOf(c));
  poseAt(c, seconds, dofs);
  return dofs;
}

const ONTO = { characterId: 't', sourceId: 's' };

describe('putting a take onto another character', () => {
  it('moves its joints, and leaves its morphs to its own take; taken off, all is as before', () => {
    const s = store();
    const before = poseOf(of(s, 't'), 0.3);
    s.apply(setRetarget, ONTO);
    const now = poseOf(of(s, 't'), 0.3);
    expect(now).not.toEqual(before);
    expect(now.at(-1)).toBe(0.7);
    s.apply(clearRetarget, { characterId: 't' });
    expect(of(s, 't').driver).toBeUndefined();
    expect(poseOf(of(s, 't'), 0.3)).toEqual(before);
  });

  it('discards what was posed by hand over it when it ends, and nothing else', () => {
    const s = store();
    s.apply(setRetarget, { ...ONTO, pairs: [{ target: 1, source: 1 }] });
    const before = of(s, 't').pose;
    const smile = dofCountOf(of(s, 't')) - 1;
    const [spine, head] = [3 + 3, 3 + 3 * 4];
    s.apply(keyPose, { characterId: 't', dofs: [smile], timeSeconds: 0 });
    const dofs = [spine, head, smile].map((index) => ({ index, value: 0.5 }));
    s.apply(setDofs, { characterId: 't', timeSeconds: 0, dofs });
    expect(of(s, 't').unkeyed?.dofs).toEqual([spine, smile]);
    s.apply(clearRetarget, { characterId: 't' });
    expect(of(s, 't').unkeyed).toMatchObject({ dofs: [smile], values: [0.5] });
    expect(of(s, 't').pose[spine]).toBe(before[spine]);
    s.undo();
    expect(of(s, 't').unkeyed?.dofs).toEqual([spine, smile]);
  });

  it('follows edits of the take, in the same step', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    s.apply(setTakeRange, { characterId: 's', range: [0, 0.5] });
    expect(of(s, 't').driver?.source.take).toBe(shownTake(of(s, 's')));
    s.undo();
    expect(of(s, 't').driver?.source.take.range).toEqual(shownTake(of(s, 's'))?.range);
    expect(of(s, 't').driver?.source.take.range[1]).toBeCloseTo(1.1, 12);
  });

  it('putting a take onto another character does so while one drags, too', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    const drag = s.begin('Range');
    drag.preview(setTakeRange.run(drag.base, { characterId: 's', range: [0, 0.4] }));
    expect(of(s, 't').driver?.source.take.range).toEqual([0, 0.4]);
    drag.cancel();
    expect(of(s, 't').driver?.source.take.range[1]).toBeCloseTo(1.1, 12);
  });

  it('minds nothing of the other character but what moves', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    const { driver } = of(s, 't');
    s.apply(placeCharacter, { characterId: 's', index: 0, placement: { ...DEFAULT_PLACEMENT, position: [1, 0, 0] } });
    expect(of(s, 't').driver).toBe(driver);
  });

  it('gives way to a take of its own that is shown', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    s.apply(showTake, { characterId: 't', take: 0 });
    expect(of(s, 't').driver).toBeUndefined();
  });

  it('putting a take onto another character is posed over temporarily where it drives joints, and permanently where it doesn’t', () => {
    const s = store();
    s.apply(setRetarget, { ...ONTO, pairs: [{ target: 1, source: 1 }] });
    // The spine's first DOF, and the head's.
    const [spine, head] = [3 + 3, 3 + 3 * 4];
    s.apply(setDofs, {
      characterId: 't',
      dofs: [
        { index: spine, value: 0.5 },
        { index: head, value: 0.4 },
      ],
      timeSeconds: 0.2,
    });
    expect(poseOf(of(s, 't'), 0.2)[spine]).toBe(0.5);
    expect(poseOf(of(s, 't'), 0.3)[spine]).not.toBe(0.5);
    expect(poseOf(of(s, 't'), 0.3)[head]).toBe(0.4);
  });

  it.each([
    ['keying its pose', keyPose, { timeSeconds: 0.2 }],
    ['keying a joint', keyPose, { dofs: [7], timeSeconds: 0.2 }],
    ['auto-key', setDofs, { dofs: [{ index: 7, value: 0.1 }], timeSeconds: 0.2, key: {} }],
    ['inserting a key', insertKeys, { channels: [7], timeSeconds: 0.2 }],
    ['removing keys', removeKeys, { keys: [{ channel: 7, indices: [0] }], timeSeconds: 0 }],
    ['moving keys', moveKeys, { keys: [{ channel: 7, indices: [0] }], seconds: 0.1 }],
    ['smoothing samples', smoothSamples, { sigmaSeconds: 0.1 }],
    ['cropping', cropSamples, { from: 0, to: 0.5 }],
  ] as const)('refuses %s meanwhile, which nobody would see, and says the way out', (_, command, args) => {
    const s = store();
    // A take with keys, and one with samples.
    s.apply(keyPose, { characterId: 't', timeSeconds: 0 });
    if (command.id.startsWith('samples.')) {
      s.apply(setRetarget, ONTO);
      s.apply(bakeRetarget, { characterId: 't' });
    }
    s.apply(setRetarget, ONTO);
    const { document } = s;
    // Each with arguments of its own: the table is of pairs that fit.
    expect(() => s.apply(command as Command<object>, { characterId: 't', ...args })).toThrow(/Bake/);
    expect(s.document).toBe(document);
  });

  it('morphs of a retargeted character are keyed in its own take', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    const smile = dofCountOf(of(s, 't')) - 1;
    s.apply(keyPose, { characterId: 't', dofs: [smile], timeSeconds: 0.2 });
    expect([...(keysOf(channelOf(of(s, 't'), smile)).times ?? [])]).toContain(0.2);
    expect(isDriven(of(s, 't'), smile)).toBe(true);
  });

  it('drives the DOFs that it moves, and no channel of its own take has the say over a joint', () => {
    const s = store();
    s.apply(keyPose, { characterId: 't', timeSeconds: 0 });
    s.apply(setRetarget, { ...ONTO, pairs: [{ target: 1, source: 1 }] });
    const [spine, head] = [3 + 3, 3 + 3 * 4];
    expect([spine, head].map((dof) => isDriven(of(s, 't'), dof))).toEqual([true, false]);
    expect([spine, head].map((dof) => channelOf(of(s, 't'), dof))).toEqual([undefined, undefined]);
    s.apply(clearRetarget, { characterId: 't' });
    expect([spine, head].map((dof) => isDriven(of(s, 't'), dof))).toEqual([true, true]);
  });

  it('continues when the other character is removed', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    const before = poseOf(of(s, 't'), 0.3);
    s.apply(removeCharacter, { characterId: 's' });
    expect(poseOf(of(s, 't'), 0.3)).toEqual(before);
    expect(rangeOfTakes(s.document)?.[1]).toBeCloseTo(1.1, 12);
  });

  it('changes pairs and options, and keeps omitted ones', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    s.apply(changeRetarget, { characterId: 't', options: { scale: 2 } });
    const { driver } = of(s, 't');
    expect(driver?.options).toEqual({ scale: 2, reference: 'automatic', plantsFeet: true });
    expect(driver?.pairs).toHaveLength(PARTS.length);
    s.apply(changeRetarget, { characterId: 't', pairs: [{ target: 4, source: 3 }] });
    expect(of(s, 't').driver?.pairs).toEqual([{ target: 4, source: 3 }]);
    expect(of(s, 't').driver?.options.scale).toBe(2);
  });

  it.each([
    ['itself', { characterId: 't', sourceId: 't' }, /itself/],
    ['one who is not there', { characterId: 't', sourceId: 'x' }, /no character/],
    ['a joint that is not there', { ...ONTO, pairs: [{ target: 0, source: 99 }] }, /number 99/],
    [
      'a joint twice',
      {
        ...ONTO,
        pairs: [
          { target: 1, source: 1 },
          { target: 1, source: 2 },
        ],
      },
      /only follow one joint/,
    ],
    ['a scale of nothing', { ...ONTO, options: { scale: 0 } }, /greater than 0/],
  ])('putting a take onto another character refuses %s', (_, args, message) => {
    const s = store();
    const { document } = s;
    expect(() => s.apply(setRetarget, args)).toThrow(message);
    expect(s.document).toBe(document);
  });

  it('refuses a source that is moved itself', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    expect(() => s.apply(setRetarget, { characterId: 's', sourceId: 't' })).toThrow(CommandError);
  });

  it('plans the way anew for another take of the source, not for its name or offset in time', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    const planOf = () => {
      const t = of(s, 't');
      if (!t.driver || !t.skeleton) throw new Error('no driver');
      return retargetPlan(t.driver, t, t.skeleton);
    };
    const plan = planOf();
    const before = poseOf(of(s, 't'), 0.25);
    s.apply(setTimeOffset, { characterId: 's', seconds: 0.25 });
    expect(planOf()).toBe(plan);
    expect(poseOf(of(s, 't'), 0)).toEqual(before);
    s.apply(setTakeRange, { characterId: 's', range: [0, 0.4] });
    expect(planOf()).not.toBe(plan);
  });

  it('putting a take onto another character is what its character is compared by: over the source’s frames, where they are in time', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    s.apply(setTimeOffset, { characterId: 's', seconds: 0.25 });
    const frames = commonFrames(of(s, 't'), of(s, 's'), 30, 1);
    expect(frames?.frameCount).toBe(ROWS.length);
    expect(frames?.startSeconds).toBeCloseTo(-0.25, 12);
  });
});

describe('baking', () => {
  it('gives a take of its own with every displayed frame, in one step', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    const live = ROWS.map((_, f) => poseOf(of(s, 't'), f * 0.1));
    s.apply(bakeRetarget, { characterId: 't' });
    const baked = of(s, 't');
    expect(baked.driver).toBeUndefined();
    expect(shownTake(baked)).toMatchObject({ name: 'person_take', samples: { frameCount: ROWS.length } });
    expect(baked.takes).toHaveLength(2);
    // Angles may be other forms of the same rotation: they are compared by what they do, which for small ones is all.
    live.forEach((pose, f) => {
      const now = poseOf(baked, f * 0.1);
      expect(Math.max(...now.map((v, d) => Math.abs(Math.sin(v - pose[d]))))).toBeLessThan(1e-9);
    });
    s.undo();
    expect(of(s, 't').driver).toBeDefined();
    expect(of(s, 't').takes).toHaveLength(1);
  });

  it('gives what was displayed if both characters are offset in time', () => {
    const s = store();
    s.apply(setTimeOffset, { characterId: 's', seconds: 0.25 });
    s.apply(setTimeOffset, { characterId: 't', seconds: -0.1 });
    s.apply(setRetarget, ONTO);
    const times = ROWS.map((_, f) => f * 0.1 - 0.15);
    const live = times.map((seconds) => poseOf(of(s, 't'), seconds));
    s.apply(bakeRetarget, { characterId: 't' });
    live.forEach((pose, f) => {
      const now = poseOf(of(s, 't'), times[f]);
      expect(Math.max(...now.map((v, d) => Math.abs(Math.sin(v - pose[d]))))).toBeLessThan(1e-9);
    });
  });

  it('baking takes another rate', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    s.apply(bakeRetarget, { characterId: 't', framesPerSecond: 20, name: 'dance' });
    expect(shownTake(of(s, 't'))).toMatchObject({ name: 'dance', samples: { frameCount: 23 } });
  });

  it('gives a take that can be posed over like any other', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    s.apply(bakeRetarget, { characterId: 't' });
    s.apply(setDofs, { characterId: 't', dofs: [{ index: 5, value: 0.25 }], timeSeconds: 0.2 });
    expect(poseOf(of(s, 't'), 0.2)[5]).toBe(0.25);
  });
});
