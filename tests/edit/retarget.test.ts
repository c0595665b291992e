import { describe, expect, it } from 'vitest';
import { placeCharacter, removeCharacter, showClip } from '../../src/edit/commands/characters.ts';
import { setClipRange } from '../../src/edit/commands/clips.ts';
import { setDofs } from '../../src/edit/commands/pose.ts';
import { bakeRetarget, changeRetarget, clearRetarget, setRetarget } from '../../src/edit/commands/retarget.ts';
import { CommandError, Store } from '../../src/edit/store.ts';
import { dofCountOf, poseAt } from '../../src/evaluate/pose.ts';
import { type Character, DEFAULT_PLACEMENT, findCharacter, rangeOfClips, shownClip } from '../../src/model/document.ts';
import { jointDofCount } from '../../src/model/dofs.ts';
import { PARTS, person, take } from '../evaluate/retarget/people.ts';
import { character, clip, documentOf, morph } from '../helpers/builders.ts';

const SOURCE = person();
/** Nods, turns and goes up and down. */
const ROWS = Array.from({ length: 12 }, (_, f) => {
  const row = new Array<number>(jointDofCount(SOURCE)).fill(0);
  row[1] = 0.9;
  return row.map((v, d) => (d > 5 ? 0.3 * Math.sin(f / 2 + d) : v));
});

function store(): Store {
  const source = character({ id: 's', name: 'dancer', skeleton: SOURCE, clips: [take(SOURCE, ROWS)], shownClip: 0 });
  const own = person({ size: 0.6, droop: 0.6, motion: () => ({ kind: 'ball', order: 'xyz' }) });
  const target = character({
    id: 't',
    name: 'walker',
    skeleton: own,
    morphs: [morph('smile')],
    clips: [clip('own', [...Array<number>(3 + 3 * PARTS.length).fill(0.1), 0.7])],
    shownClip: 0,
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

  it('follows the take as it is edited, in the same step', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    s.apply(setClipRange, { characterId: 's', range: [0, 0.5] });
    expect(of(s, 't').driver?.source.clip).toBe(shownClip(of(s, 's')));
    s.undo();
    expect(of(s, 't').driver?.source.clip.range).toEqual(shownClip(of(s, 's'))?.range);
    expect(of(s, 't').driver?.source.clip.range[1]).toBeCloseTo(1.1, 12);
  });

  it('does so while one drags, too', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    const drag = s.begin('Range');
    drag.preview(setClipRange.run(drag.base, { characterId: 's', range: [0, 0.4] }));
    expect(of(s, 't').driver?.source.clip.range).toEqual([0, 0.4]);
    drag.cancel();
    expect(of(s, 't').driver?.source.clip.range[1]).toBeCloseTo(1.1, 12);
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
    s.apply(showClip, { characterId: 't', clip: 0 });
    expect(of(s, 't').driver).toBeUndefined();
  });

  it('is posed over for a moment where it moves, and for good where it doesn’t', () => {
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

  it('goes on when the other character is removed', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    const before = poseOf(of(s, 't'), 0.3);
    s.apply(removeCharacter, { characterId: 's' });
    expect(poseOf(of(s, 't'), 0.3)).toEqual(before);
    expect(rangeOfClips(s.document)?.[1]).toBeCloseTo(1.1, 12);
  });

  it('changes pairs and options, and keeps what is not said', () => {
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
      /one joint only/,
    ],
    ['a scale of nothing', { ...ONTO, options: { scale: 0 } }, /above 0/],
  ])('refuses %s', (_, args, message) => {
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
});

describe('baking', () => {
  it('gives a take of its own with what was seen on every frame, in one step', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    const live = ROWS.map((_, f) => poseOf(of(s, 't'), f * 0.1));
    s.apply(bakeRetarget, { characterId: 't' });
    const baked = of(s, 't');
    expect(baked.driver).toBeUndefined();
    expect(shownClip(baked)).toMatchObject({ name: 'take', samples: { frameCount: ROWS.length } });
    expect(baked.clips).toHaveLength(2);
    // Angles may be other forms of the same rotation: they are compared by what they do, which for small ones is all.
    live.forEach((pose, f) => {
      const now = poseOf(baked, f * 0.1);
      expect(Math.max(...now.map((v, d) => Math.abs(Math.sin(v - pose[d]))))).toBeLessThan(1e-9);
    });
    s.undo();
    expect(of(s, 't').driver).toBeDefined();
    expect(of(s, 't').clips).toHaveLength(1);
  });

  it('takes another rate', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    s.apply(bakeRetarget, { characterId: 't', framesPerSecond: 20, name: 'dance' });
    expect(shownClip(of(s, 't'))).toMatchObject({ name: 'dance', samples: { frameCount: 23 } });
  });

  it('gives a take that can be posed over like any other', () => {
    const s = store();
    s.apply(setRetarget, ONTO);
    s.apply(bakeRetarget, { characterId: 't' });
    s.apply(setDofs, { characterId: 't', dofs: [{ index: 5, value: 0.25 }], timeSeconds: 0.2 });
    expect(poseOf(of(s, 't'), 0.2)[5]).toBe(0.25);
  });
});
