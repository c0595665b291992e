/** What a follower contains of its leader, and what counts of that in takes. */
import { describe, expect, it } from 'vitest';
import { addAttachment, putDown } from '../../../src/edit/commands/beside/attach.ts';
import { switchLimb } from '../../../src/edit/commands/beside/limbs.ts';
import { setDofs } from '../../../src/edit/commands/pose.ts';
import { setRetarget } from '../../../src/edit/commands/retarget.ts';
import { takeAlone } from '../../../src/edit/samples/take-alone.ts';
import { Store } from '../../../src/edit/store.ts';
import { bakeTake, framesOf } from '../../../src/evaluate/bake.ts';
import { measuredFrames, trackJoints } from '../../../src/evaluate/measure/tracks.ts';
import { dofCountOf, poseAt, poseSource } from '../../../src/evaluate/pose.ts';
import { steppedCharacter } from '../../../src/evaluate/stepped-take.ts';
import { runToEnd } from '../../../src/evaluate/steps.ts';
import type { Character, Document } from '../../../src/model/document.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import { firstGoalChannel } from '../../../src/model/takes/goals.ts';
import { restChannel, type Take } from '../../../src/model/takes/take.ts';
import { displayedFrames } from '../../../src/review/frames.ts';
import { character, joint, morph } from '../../helpers/builders.ts';
import { heroOf, LEG, run, walking, withLegs } from '../limbs/walker.ts';
import { differenceOf, sceneOf } from './attached.ts';

const BONE = { name: 'ball', joints: [joint(-1, { name: 'ball' })] };
const prop = (id: string): Character => character({ id, name: id, skeleton: BONE, pose: filePose(BONE, 0) });
const FOOT = { characterId: 'c2', leaderId: 'c1', joint: LEG[2], span: [0, 1] as [number, number] };
const SECONDS = 0.4;

function withProps({ characters, ...rest }: Document, ...ids: readonly string[]): Document {
  return { ...rest, characters: [...characters, ...ids.map(prop)] };
}

describe('an unkeyed change of a leader', () => {
  it('moves its follower by goals, too, whatever morphs the leader has', () => {
    const lifted = (document: Document) => {
      const held = run(withLegs(document), switchLimb, { characterId: 'c1', timeSeconds: SECONDS, limb: 0, to: 'ik' });
      const store = new Store(run(withProps(held, 'c2'), addAttachment, FOOT));
      const before = sceneOf(store.document.characters[1], 0, SECONDS);
      const first = firstGoalChannel(dofCountOf(heroOf(held)), 0);
      const dofs = [2, 3].map((k) => ({ index: first + k, value: 0.3 }));
      const weight = heroOf(held).morphs.length > 0 ? [{ index: first - 1, value: 1 }] : [];
      store.apply(setDofs, { characterId: 'c1', dofs: [...weight, ...dofs], timeSeconds: SECONDS });
      const after = sceneOf(store.document.characters[1], 0, SECONDS);
      expect(differenceOf(before, after)).toBeGreaterThan(0.01);
      return after;
    };
    const walker = walking();
    const [hero] = walker.characters;
    const smiling = { ...hero, morphs: [morph('smile'), morph('frown')], pose: [...hero.pose, 0, 0] };
    expect(lifted({ ...walker, characters: [smiling] })).toEqual(lifted(walker));
  });

  it('is no part of what files, measures and other steps have of a follower, nor of one that follows that', () => {
    const one = run(withProps(walking(), 'c2', 'c3'), addAttachment, FOOT);
    const document = run(one, addAttachment, { ...FOOT, characterId: 'c3', leaderId: 'c2', joint: 0 });
    const store = new Store(document);
    store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 2, value: 5 }], timeSeconds: SECONDS });
    const seen = sceneOf(store.document.characters[2], 0, SECONDS);
    expect(differenceOf(seen, sceneOf(document.characters[2], 0, SECONDS))).toBeGreaterThan(1);
    for (const index of [1, 2]) {
      const [plain, shown] = [document.characters[index], store.document.characters[index]];
      const at = { characterId: plain.id, timeSeconds: SECONDS };
      const frames = framesOf([0, 1], 10);
      expect(bakeTake(shown, frames)).toEqual(bakeTake(plain, frames));
      expect(sceneOf(takeAlone(shown, shown.takes[0]), 0, SECONDS)).toEqual(
        sceneOf(takeAlone(plain, plain.takes[0]), 0, SECONDS),
      );
      const tracks = (of: Character) => runToEnd(trackJoints(of, measuredFrames(of, 10) ?? frames, [0])).positions;
      expect(tracks(shown)).toEqual(tracks(plain));
      const frame = (of: Character) => {
        const found = displayedFrames(of);
        const dofs = new Float64Array(found?.dofCount ?? 0);
        found?.write(Math.round(SECONDS * 30), dofs, new Float64Array(300));
        return dofs;
      };
      expect(frame(shown)).toEqual(frame(plain));
      expect(putDown.run(store.document, at).characters[index].takes).toEqual(
        putDown.run(document, at).characters[index].takes,
      );
      const again = { ...FOOT, characterId: plain.id, joint: 0, span: [SECONDS, 1] as [number, number] };
      const offsets = (of: Document) => addAttachment.run(of, again).characters[index].takes[0].attached;
      expect(offsets(store.document)).toEqual(offsets(document));
    }
  });
});

it('what moves a follower is compiled once', () => {
  const [, follower] = run(withProps(walking(), 'c2'), addAttachment, FOOT).characters;
  expect(poseSource(follower).over).toBe(poseSource(follower).over);
});

describe('a character that is retargeted from one that follows another', () => {
  const [a, b, c] = ['c1', 'c2', 'c3'];
  const scene = () => {
    const moving: Take = { name: 'roll', range: [0, 1], channels: Array.from({ length: 6 }, () => restChannel(0)) };
    const { characters, ...rest } = withProps(walking(), b, c);
    const [hero, rolling, target] = characters;
    return { ...rest, characters: [hero, { ...rolling, takes: [moving], shownTake: 0 }, target] };
  };
  const retargeted = { characterId: c, sourceId: b };
  const poses = ({ characters }: Document) =>
    characters.slice(1).map((one) => {
      const dofs = new Float64Array(dofCountOf(one));
      poseAt(one, SECONDS, dofs);
      return dofs;
    });
  const expectSame = (document: Document) => {
    const [source, target] = poses(document);
    expect(target).toEqual(source);
  };

  it.each([
    ['attached first', [b, c]],
    ['retargeted first', [c, b]],
  ])('moves as that does, %s, and follows edits of whom that follows', (_what, order) => {
    const store = new Store(scene());
    for (const id of order) id === b ? store.apply(addAttachment, FOOT) : store.apply(setRetarget, retargeted);
    const [first] = poses(store.document);
    expect(Math.abs(first[1])).toBeGreaterThan(0.01);
    expectSame(store.document);
    const before = store.document;
    // Two take the one that it is retargeted from, and whom that follows.
    store.apply(setDofs, { characterId: a, dofs: [{ index: 2, value: 5 }], timeSeconds: SECONDS, key: {} });
    const [moved] = poses(store.document);
    expect(differenceOf(moved, first)).toBeGreaterThan(1);
    expectSame(store.document);
    // As the stepped preview shows them, too.
    expectSame({ ...store.document, characters: store.document.characters.map(steppedCharacter) });
    store.undo();
    expect(store.document).toEqual(before);
    expectSame(store.document);
  });

  it('can’t be what that follows', () => {
    const store = new Store(scene());
    store.apply(setRetarget, retargeted);
    expect(() => store.apply(addAttachment, { ...FOOT, leaderId: c, joint: 0 })).toThrow('which follows c2 itself');
    const other = new Store(scene());
    other.apply(addAttachment, { ...FOOT, leaderId: c, joint: 0 });
    expect(() => other.apply(setRetarget, retargeted)).toThrow('c3 can’t be retargeted from c2, which follows it.');
  });
});
