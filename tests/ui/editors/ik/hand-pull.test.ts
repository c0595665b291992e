import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { unpin } from '../../../../src/edit/commands/ik.ts';
import { setDofs } from '../../../../src/edit/commands/pose.ts';
import { setHidden } from '../../../../src/edit/commands/spaces.ts';
import type { Vec3 } from '../../../../src/math/vec3.ts';
import { shownTake } from '../../../../src/model/document.ts';
import type { Joint } from '../../../../src/model/skeleton/skeleton.ts';
import { HandPull } from '../../../../src/ui/editors/ik/hand-pull.ts';
import { documentOf, take } from '../../builders.ts';
import { apart, BODY, BODY_JOINT, body, FORE_L, FORE_R, HAND_L, HAND_R, ikPage, pin } from './ik-page.ts';

/** Of a body that is 6 wide. */
const THERE = 2e-3;
const BODY_GRIP = { characterId: 'c1', placement: 0, joint: BODY_JOINT, point: [0, 0, 0] } as const;
const LEFT_GRIP = { characterId: 'c1', placement: 0, joint: HAND_L, point: [0, 0, 0], pin: 1 } as const;

let page: ReturnType<typeof ikPage>;
/** Where the point was when the last hand took hold of it. */
let anchor: Vec3;
beforeEach(() => {
  page = ikPage();
});
afterEach(() => page.stop());

function begin(grip: Parameters<typeof HandPull.begin>[1] = BODY_GRIP): HandPull {
  const hand = HandPull.begin(page.wb, grip);
  if (!hand) throw new Error('There is something to be dragged.');
  anchor = hand.hand;
  return hand;
}

function wholeBody(): void {
  page.wb.settings.update((now) => ({ ...now, ikReach: 'body' }));
}

/** As a hand goes there. */
function go(hand: HandPull, by: Vec3): void {
  const [x, y, z] = anchor;
  for (let i = 1; i <= 10; i++) hand.to([x + 0.1 * i * by[0], y + 0.1 * i * by[1], z + 0.1 * i * by[2]]);
}

describe('a hand that drags a point', () => {
  it('moves the point while the pins hold, in one undo step', () => {
    const { wb, placeOf, pose } = page;
    const before = pose();
    const hand = begin();
    go(hand, [0, 0.3, 0.2]);
    hand.finish();
    expect(apart(placeOf(BODY_JOINT), [0, 0.3, 0.2])).toBeLessThan(THERE);
    expect(apart(placeOf(HAND_L), [3, 0, 0])).toBeLessThan(THERE);
    expect(apart(placeOf(HAND_R), [-3, 0, 0])).toBeLessThan(THERE);
    expect(wb.store.undoLabel).toBe('Drag body');
    wb.store.undo();
    expect(pose()).toEqual(before);
    expect(wb.store.undoLabel).toBeUndefined();
  });

  it('moves a pin, while the other one holds', () => {
    const hand = begin(LEFT_GRIP);
    go(hand, [-0.4, 0.4, 0]);
    hand.finish();
    expect(apart(page.placeOf(HAND_L), [2.6, 0.4, 0])).toBeLessThan(THERE);
    expect(apart(page.placeOf(HAND_R), [-3, 0, 0])).toBeLessThan(THERE);
  });

  it('restores everything when cancelled, and does nothing any more', () => {
    const { wb, pose } = page;
    const { document } = wb.store;
    const hand = begin();
    go(hand, [0, 0.3, 0]);
    expect(wb.store.document).not.toBe(document);
    hand.cancel();
    expect(wb.store.document).toBe(document);
    expect(wb.store.undoLabel).toBeUndefined();
    expect(pose()).toBe(document.characters[0].pose);
  });

  it('a hand that drags a point makes no step if nothing has moved', () => {
    const hand = begin();
    hand.to(anchor);
    hand.finish();
    expect(page.wb.store.undoLabel).toBeUndefined();
  });

  it('keys what it moves if auto-key is on', () => {
    page.stop();
    page = ikPage(documentOf(body({ takes: [take([0, 2])] })));
    const { wb } = page;
    wb.timeline.autoKey.set(true);
    wb.transport.update((now) => ({ ...now, timeSeconds: 1 }));
    const hand = begin();
    go(hand, [0, 0.3, 0]);
    hand.finish();
    const [character] = wb.store.document.characters;
    const keyed = shownTake(character)?.channels.filter((one) => 'times' in one && one.times.includes(1));
    expect(keyed?.length).toBeGreaterThan(0);
    expect(apart(page.placeOf(BODY_JOINT), [0, 0.3, 0])).toBeLessThan(THERE);
    wb.store.undo();
    expect(wb.store.undoLabel).toBeUndefined();
  });

  it('ends if its pins are changed meanwhile; its result so far is a step', () => {
    const { wb, pose } = page;
    const hand = begin();
    go(hand, [0, 0.2, 0]);
    wb.store.apply(unpin, { characterId: 'c1', pins: [1] });
    const left = pose();
    expect(hand.isOver).toBe(true);
    go(hand, [0, 0.6, 0]);
    hand.finish();
    expect(pose()).toBe(left);
    expect(apart(page.placeOf(BODY_JOINT), [0, 0.2, 0])).toBeLessThan(THERE);
    expect(wb.store.undoLabel).not.toBe('Drag body');
    wb.store.undo();
    expect(wb.store.undoLabel).toBe('Drag body');
  });

  it('ends if the document is changed by anything else', () => {
    const { wb } = page;
    const hand = begin();
    go(hand, [0, 0.2, 0]);
    wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 4, value: 0.1 }], timeSeconds: 0 });
    expect(hand.isOver).toBe(true);
    hand.finish();
    expect(page.pose()[4]).toBe(0.1);
  });

  it('leaves the pin’s target at the pointer while the pose stays as it left it', () => {
    const { wb, pose } = page;
    const hand = begin(LEFT_GRIP);
    go(hand, [20, 0, 0]);
    expect(hand.state.gaps.map(({ joint }) => joint)).toEqual([HAND_L]);
    hand.finish();
    const { targets } = wb.posing.ik;
    const dofs = Float64Array.from(pose());
    const [{ ik }] = wb.store.document.characters;
    const left = targets.leftOf('c1', dofs);
    const target = ik && targets.leftTarget(left, ik.pins[0])?.position;
    expect(target && apart(target, [23, 0, 0])).toBeLessThan(1e-9);
    wb.store.undo();
    expect(targets.leftOf('c1', Float64Array.from(pose()))).toBeUndefined();
  });

  it('names the pins that hold it back, and not one that could move', () => {
    wholeBody();
    const hand = begin(LEFT_GRIP);
    go(hand, [3, 0, 0]);
    expect(hand.state.hindrance).toMatchObject({ holders: [HAND_R], canMove: true, rootStays: false });
    hand.finish();
  });

  it('names the lock in the way, and no other', () => {
    page.stop();
    // Its right hand doesn't stand on the ground.
    const joints = BODY.joints.map((one, j): Joint => (j === FORE_R ? { ...one, offset: [-1, 1, 0] } : one));
    const kept = body({ skeleton: { ...BODY, joints } });
    const ik = { pins: [pin(1, HAND_L)], stiff: [{ joint: FORE_L }, { joint: FORE_R }], rootIsFree: true };
    page = ikPage(documentOf({ ...kept, ik }));
    const hand = begin();
    go(hand, [-1, 0, 0]);
    expect(hand.state.hindrance.locks).toEqual([FORE_L]);
    hand.cancel();
    page.stop();
    page = ikPage(documentOf({ ...kept, ik: { ...ik, stiff: [{ joint: FORE_R }] } }));
    const free = begin();
    go(free, [-1, 0, 0]);
    expect(free.state.hindrance.locks).toEqual([]);
    free.cancel();
  });

  it('asks for the root if that is fixed and nothing else moves the point, and says so', () => {
    page.stop();
    const kept = body();
    page = ikPage(documentOf({ ...kept, ik: { pins: [], stiff: [], rootIsFree: false } }));
    const { wb } = page;
    const { wantsRoot } = wb.posing.ik;
    const hand = begin();
    go(hand, [0, 0.5, 0]);
    expect(hand.state.hindrance).toMatchObject({ canMove: false, rootStays: true });
    expect(wantsRoot.get()).toBe(true);
    hand.finish();
    expect(wb.messages.passing.get()).toContain('root is fixed. Allow the root to move');
    expect(wb.store.undoLabel).toBeUndefined();
    begin().cancel();
    expect(wantsRoot.get()).toBe(false);
  });

  it('asks for the root only when an arm is fully stretched', () => {
    page.stop();
    const kept = body();
    page = ikPage(documentOf({ ...kept, ik: { pins: [], stiff: [], rootIsFree: false } }));
    wholeBody();
    const { wantsRoot } = page.wb.posing.ik;
    const { characterId, placement, joint, point } = LEFT_GRIP;
    const hand = begin({ characterId, placement, joint, point });
    go(hand, [-0.4, 0.3, 0]);
    expect(wantsRoot.get()).toBe(false);
    go(hand, [2, 0, 0]);
    expect(wantsRoot.get()).toBe(true);
    expect(hand.state.hindrance).toMatchObject({ canMove: true, holders: [] });
    hand.cancel();
    expect(wantsRoot.get()).toBe(false);
  });

  it('pauses in place and follow while it drags', () => {
    const { wb } = page;
    const log: string[] = [];
    wb.viewport.freezeRootMotion = (id) => {
      log.push(`hold ${id}`);
      return () => void log.push('go on');
    };
    const hand = begin();
    go(hand, [0, 0.1, 0]);
    expect(log).toEqual(['hold c1']);
    hand.finish();
    expect(log).toEqual(['hold c1', 'go on']);
    begin().cancel();
    expect(log).toEqual(['hold c1', 'go on', 'hold c1', 'go on']);
  });

  it('a hand that drags a point can’t drag what is hidden or removed', () => {
    const { wb } = page;
    wb.store.apply(setHidden, { ids: ['c1'], hidden: true });
    expect(HandPull.begin(wb, BODY_GRIP)).toBeUndefined();
    expect(HandPull.begin(wb, { ...BODY_GRIP, characterId: 'c9' })).toBeUndefined();
  });
});
