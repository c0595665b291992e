import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import {
  addAttachment,
  changeAttachment,
  putDown,
  removeAttachment,
} from '../../../src/edit/commands/beside/attach.ts';
import { placeCharacter, removeCharacter } from '../../../src/edit/commands/characters.ts';
import { setDofs } from '../../../src/edit/commands/pose.ts';
import { Store } from '../../../src/edit/store.ts';
import { steppedCharacter } from '../../../src/evaluate/stepped-take.ts';
import { writeRotationPart } from '../../../src/math/mat3.ts';
import { type Character, DEFAULT_PLACEMENT, type Document, findCharacter } from '../../../src/model/document.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import { restChannel, type Take } from '../../../src/model/takes/take.ts';
import { character, documentOf, joint } from '../../helpers/builders.ts';
import { expectEdit } from '../../helpers/expect-edit.ts';
import { channelOf } from '../keys/channels.ts';
import { dice, differenceOf, isRegular, randomLeader, randomProp, sceneOf } from './attached.ts';

const TINY = 1e-9;

function get(document: Document, id: string): Character {
  const found = findCharacter(document, id);
  if (!found) throw new Error(`no ${id}`);
  return found;
}

/** How far a root is from a joint with an offset, in place and rotation. */
function offBy(leader: Character, prop: Character, time: number): number {
  const at = time + prop.timeOffsetSeconds;
  const one = prop.takes[prop.shownTake].attached?.list.find(({ span }) => span[0] <= at && at < span[1]);
  if (!one) throw new Error('not attached');
  const joint = sceneOf(leader, one.joint, time);
  const root = sceneOf(prop, 0, time);
  const [x, y, z] = one.offset.position;
  // Some joints scale by thousands.
  const size = Math.max(1, ...[...joint, ...root].map(Math.abs));
  const [turn, own] = [new Float64Array(9), new Float64Array(9)];
  writeRotationPart(joint, 0, turn, 0, 3);
  writeRotationPart(root, 0, own, 0, 3);
  const [a, b, c] = one.offset.rotation;
  const [sx, cx, sy, cy, sz, cz] = [Math.sin(a), Math.cos(a), Math.sin(b), Math.cos(b), Math.sin(c), Math.cos(c)];
  // Rz·Ry·Rx, by rows.
  const offset = [
    [cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx],
    [sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx],
    [-sy, cy * sx, cy * cx],
  ];
  let worst = 0;
  for (let k = 0; k < 3; k++) {
    const place = joint[k] * x + joint[4 + k] * y + joint[8 + k] * z + joint[12 + k];
    worst = Math.max(worst, Math.abs(place - root[12 + k]));
    for (let col = 0; col < 3; col++) {
      const meant = turn[k] * offset[0][col] + turn[3 + k] * offset[1][col] + turn[6 + k] * offset[2][col];
      worst = Math.max(worst, Math.abs(meant - own[3 * col + k]));
    }
  }
  return worst / size;
}

/** Of two matrices, in proportion to their numbers. */
function difference(a: Float64Array, b: Float64Array): number {
  return differenceOf(a, b) / Math.max(1, ...a.map(Math.abs));
}

const pairs = dice.map((d) => {
  const leader = randomLeader(d, 'c1');
  const prop = randomProp(d, 'c2');
  return {
    leader,
    prop,
    // A follower may come before its leader.
    document: d.is(0.5) ? documentOf(leader, prop) : documentOf(prop, leader),
    joint: d.below(leader.skeleton?.joints.length ?? 1),
    start: 2 * d.number(),
    length: 0.5 + d.number(),
    times: [d.number(), d.number(), d.number()],
  };
});

describe('an attached root', () => {
  it('is at joint times offset at any time of its span, whatever both are, and jumps nowhere', () => {
    fc.assert(
      fc.property(pairs, ({ document, prop, joint, start, length, times }) => {
        const span: [number, number] = [start, start + length];
        const store = new Store(document);
        store.apply(addAttachment, { characterId: 'c2', leaderId: 'c1', joint, span });
        const [leader, now] = [get(store.document, 'c1'), get(store.document, 'c2')];
        const at = start - prop.timeOffsetSeconds;
        const seen = [0, ...times, 1].map((part) => sceneOf(leader, joint, at + part * length));
        fc.pre(seen.every(isRegular));
        for (const part of times) expect(offBy(leader, now, at + part * length)).toBeLessThan(TINY);
        // Or what the stepped preview shows.
        const [held, follower] = [steppedCharacter(leader), steppedCharacter(now)];
        for (const part of times) {
          const time = at + part * length;
          if (isRegular(sceneOf(held, joint, time))) expect(offBy(held, follower, time)).toBeLessThan(TINY);
        }
        expect(difference(sceneOf(now, 0, at), sceneOf(prop, 0, at))).toBeLessThan(TINY);
        // Before and after it is what it was.
        expect(difference(sceneOf(now, 0, at - 0.1), sceneOf(prop, 0, at - 0.1))).toBeLessThan(TINY);
        const end = at + length * (1 + 1e-12);
        expect(difference(sceneOf(now, 0, end), sceneOf(prop, 0, end))).toBeLessThan(TINY);
      }),
    );
  });

  it('is put down where it is, and before it was attached it is where it was', () => {
    fc.assert(
      fc.property(pairs, ({ document, prop, joint, start, length, times: [part] }) => {
        const store = new Store(document);
        store.apply(addAttachment, { characterId: 'c2', leaderId: 'c1', joint, span: [start, start + length] });
        const held = get(store.document, 'c2');
        const time = start - prop.timeOffsetSeconds + (0.1 + 0.8 * part) * length;
        fc.pre(
          [start - prop.timeOffsetSeconds, time].every((at) => isRegular(sceneOf(get(document, 'c1'), joint, at))),
        );
        store.apply(putDown, { characterId: 'c2', timeSeconds: time });
        const down = get(store.document, 'c2');
        expect(difference(sceneOf(down, 0, time), sceneOf(held, 0, time))).toBeLessThan(TINY);
        const before = time - 0.01;
        expect(difference(sceneOf(down, 0, before), sceneOf(held, 0, before))).toBeLessThan(TINY);
        const earlier = start - prop.timeOffsetSeconds - part;
        expect(difference(sceneOf(down, 0, earlier), sceneOf(prop, 0, earlier))).toBeLessThan(TINY);
      }),
    );
  });

  it('follows one that follows another, whatever their order', () => {
    fc.assert(
      fc.property(dice, (d) => {
        const [a, b, c] = [randomLeader(d, 'c1'), randomProp(d, 'c2'), randomProp(d, 'c3')];
        const store = new Store(d.is(0.5) ? documentOf(c, b, a) : documentOf(a, c, b));
        store.apply(addAttachment, { characterId: 'c3', leaderId: 'c2', joint: 1, span: [0, 2] });
        store.apply(addAttachment, { characterId: 'c2', leaderId: 'c1', joint: 0, span: [-4, 8] });
        store.apply(placeCharacter, { characterId: 'c1', index: 0, placement: DEFAULT_PLACEMENT });
        const time = d.number() - c.timeOffsetSeconds;
        expect(offBy(get(store.document, 'c2'), get(store.document, 'c3'), time)).toBeLessThan(TINY);
        expect(offBy(get(store.document, 'c1'), get(store.document, 'c2'), time)).toBeLessThan(TINY);
        const ring = { characterId: 'c1', leaderId: 'c3', joint: 0, span: [0, 1] } as const;
        expect(() => store.apply(addAttachment, { ...ring, span: [0, 1] })).toThrow(/follows leader c1 itself/);
      }),
    );
  });
});

const HERO = character({
  name: 'Walker',
  takes: [
    {
      name: 'walk',
      range: [0, 2],
      channels: Array.from({ length: 9 }, (_, dof) =>
        dof === 3
          ? channelOf([
              [0, 0],
              [2, 1],
            ])
          : restChannel(),
      ),
    },
  ],
  shownTake: 0,
});
const SWORD_BONE = { name: 'sword', joints: [joint(-1, { name: 'hilt' })] };
const SWORD = character({ id: 'c2', name: 'Sword', skeleton: SWORD_BONE, pose: filePose(SWORD_BONE, 0) });
const MOVED: Take = {
  name: 'sword_anim',
  range: [0, 2],
  channels: Array.from({ length: 6 }, (_, dof) =>
    dof === 0
      ? channelOf([
          [0, 3],
          [1, 4],
        ])
      : restChannel(),
  ),
};
const SCENE = documentOf(HERO, { ...SWORD, takes: [MOVED], shownTake: 0 });
const GRIP = { characterId: 'c2', leaderId: 'c1', joint: 1, span: [0.5, 1.5] as [number, number] };

describe('attachments', () => {
  it('leave nothing behind when they are removed, or put down at once', () => {
    const attached = expectEdit(SCENE, addAttachment, GRIP);
    const off = expectEdit(attached, removeAttachment, { characterId: 'c2', index: 0 });
    expect(get(off, 'c2').takes[0]).toEqual(MOVED);
    expect(get(off, 'c2').leaders).toBeUndefined();
    const down = expectEdit(attached, putDown, { characterId: 'c2', timeSeconds: 0.5 });
    expect(get(down, 'c2').takes[0]).toEqual(MOVED);
  });

  it('keep what else their file says when their span changes', () => {
    const attached = expectEdit(SCENE, addAttachment, GRIP);
    const facts = { baseFile: 'sword.anim', ofFlattened: { by: 'x' }, others: { author: 'y' } };
    const { characters, ...rest } = attached;
    const known = characters.map((one): Character => {
      const takes = one.takes.map((take) =>
        take.attached ? { ...take, attached: { ...take.attached, ...facts } } : take,
      );
      return { ...one, takes };
    });
    const moved = expectEdit({ ...rest, characters: known }, changeAttachment, {
      characterId: 'c2',
      index: 0,
      span: [1, 2],
    });
    expect(get(moved, 'c2').takes[0].attached).toMatchObject({ ...facts, list: [{ span: [1, 2] }] });
  });

  it('are put down at their end as they are held there, and never later', () => {
    const attached = expectEdit(SCENE, addAttachment, GRIP);
    const putAt = (timeSeconds: number) => expectEdit(attached, putDown, { characterId: 'c2', timeSeconds });
    const down = get(putAt(1.5), 'c2');
    expect(down.takes[0].attached).toEqual(get(attached, 'c2').takes[0].attached);
    const held = sceneOf(get(attached, 'c2'), 0, 1.5 - 1e-9);
    expect(difference(sceneOf(down, 0, 1.5), held)).toBeLessThan(1e-6);
    const refusal = 'Sword is attached to joint1 of Walker from 0.5 to 1.5 s only. Put it down in between.';
    expect(() => putAt(1.6)).toThrow(refusal);
    const both = expectEdit(attached, addAttachment, { ...GRIP, joint: 0, span: [1.5, 2] });
    const first = { characterId: 'c2', index: 0, timeSeconds: 1.5 };
    expect(() => putDown.run(both, first)).toThrow(refusal);
  });

  it('make a take of a character that has none, as long as that of the leader', () => {
    const after = expectEdit(documentOf(HERO, SWORD), addAttachment, GRIP);
    expect(get(after, 'c2').takes).toMatchObject([{ name: 'sword_anim', range: [0, 2] }]);
  });

  it('put a character at the place of its leader, where it does not move', () => {
    const beside = { ...DEFAULT_PLACEMENT, position: [1.5, 0, 2] as const };
    const away = documentOf(HERO, { ...get(SCENE, 'c2'), placements: [beside] });
    const after = get(expectEdit(away, addAttachment, GRIP), 'c2');
    expect(after.placements).toEqual([DEFAULT_PLACEMENT]);
    for (const time of [0, 0.25, 0.5, 1.5, 2])
      expect(difference(sceneOf(after, 0, time), sceneOf(get(away, 'c2'), 0, time))).toBeLessThan(TINY);
  });

  it('give way to a later one at its start, and refuse one that begins within it', () => {
    const first = expectEdit(SCENE, addAttachment, GRIP);
    const other = { ...GRIP, joint: 0, span: [1, 3] as [number, number] };
    const both = expectEdit(first, addAttachment, other);
    const spans = (document: Document) => get(document, 'c2').takes[0].attached?.list.map(({ span }) => span);
    expect(spans(both)).toEqual([
      [0.5, 1],
      [1, 3],
    ]);
    expect(offBy(get(both, 'c1'), get(both, 'c2'), 1.25)).toBeLessThan(TINY);
    expect(difference(sceneOf(get(both, 'c2'), 0, 1), sceneOf(get(first, 'c2'), 0, 1))).toBeLessThan(TINY);
    expect(() => expectEdit(both, addAttachment, { ...GRIP, span: [0, 0.75] })).toThrow(
      'Sword is attached to joint1 of Walker from 0.5 to 1 s.',
    );
    expect(spans(expectEdit(both, changeAttachment, { characterId: 'c2', index: 1, span: [1.5, 2] }))).toEqual([
      [0.5, 1],
      [1.5, 2],
    ]);
  });

  it('follow their leader in the same step, and keep its last state when it is removed', () => {
    const store = new Store(expectEdit(SCENE, addAttachment, GRIP));
    const before = store.document;
    store.apply(placeCharacter, { characterId: 'c1', index: 0, placement: { ...DEFAULT_PLACEMENT, turn: [0, 1, 0] } });
    expect(offBy(get(store.document, 'c1'), get(store.document, 'c2'), 1)).toBeLessThan(TINY);
    const kept = sceneOf(get(store.document, 'c2'), 0, 1);
    store.apply(removeCharacter, { characterId: 'c1' });
    expect(sceneOf(get(store.document, 'c2'), 0, 1)).toEqual(kept);
    store.undo();
    store.undo();
    expect(store.document).toEqual(before);
    store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 4, value: 0.5 }], timeSeconds: 1 });
    expect(offBy(get(store.document, 'c1'), get(store.document, 'c2'), 1)).toBeLessThan(TINY);
  });

  it('say why they can’t be', () => {
    const refuse = (args: object, message: RegExp, document = SCENE) =>
      expect(() => new Store(document).apply(addAttachment, { ...GRIP, ...args })).toThrow(message);
    refuse({ leaderId: 'c2' }, /can’t be attached to itself/);
    refuse({ joint: 7 }, /joint of Walker/);
    refuse({ span: [1, 1] }, /must begin before it ends, found 1 to 1 s/);
    refuse({ leaderId: 'c3' }, /no character "c3"/);
  });
});
