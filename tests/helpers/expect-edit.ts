/**
 * Tests one edit with everything that edits guarantee (like ProseMirror's `test/trans.ts`), so that a command's own
 * tests only cover what is special about it.
 */

import { expect } from 'vitest';
import type { Change } from '../../src/edit/change.ts';
import type { Command } from '../../src/edit/command.ts';
import { applyDelta, deltaTo, sameValue } from '../../src/edit/delta.ts';
import { poseByNames } from '../../src/edit/pose/by-names.ts';
import { Store } from '../../src/edit/store.ts';
import { type Character, type Document, findCharacter, isBvh } from '../../src/model/document.ts';
import type { FileContent } from '../../src/model/files.ts';
import { limbsByName } from '../../src/model/limbs.ts';
import { NOTHING_SELECTED, type Selection } from '../../src/model/session.ts';
import { setsByName } from '../../src/model/sets-by-name.ts';
import type { Channel, Goal, GoalCurve } from '../../src/model/takes/take.ts';
import { read } from '../formats/read-in-pieces.ts';
import { asRead } from './as-read.ts';
import { checkDocument, checkSelection } from './invariants.ts';
import { writeFile } from './write-file.ts';

/**
 * Applies a command, and expects that
 * - it changes something, or gives the very same document and makes no step,
 * - neither the document nor the arguments were written to, and copies of both give the same again,
 * - what is equal before and after is one object, part by part,
 * - undo gives the very document and selection, redo the same result, and their differences lead to either,
 * - the result is sound (`invariants.ts`) and plain data,
 * - what changed is the same after it was written to its format and read.
 *
 * @param selection before it
 * @returns the document after it
 */
export function expectEdit<Args>(
  document: Document,
  command: Command<Args, Document | Change>,
  args: Args,
  selection: Selection = NOTHING_SELECTED,
): Document {
  const untouched = structuredClone({ document, args });
  freeze(document);
  freeze(args);
  const store = new Store(document);
  store.select(selection);
  store.apply(command, args);
  const { document: after, selection: selectedAfter } = store;
  expectSame({ document, args }, untouched, `what ${command.id} was given`);

  if (after === document) {
    expect(store.undoLabel, `${command.id} made a step`).toBeUndefined();
    return after;
  }
  expectStep(document, after, selectedAfter);
  expectShared(document, after, 'the document');
  expect(store.undoLabel).toBe(command.label(document, args));
  expect(store.undoLabel).toMatch(/^\S.*\S$/);
  expect(store.undoLabel).not.toMatch(/undefined|NaN|\[object/);

  const again = new Store(document);
  again.apply(command, structuredClone(args));
  expectSame(again.document, after, `${command.id} a second time`);
  expectSame(structuredClone(after), after, `the result of ${command.id} as plain data`);
  expectSame(applyDelta(after, deltaTo(document, after)), document, `${command.id} undone by its difference`);
  expectSame(applyDelta(document, deltaTo(after, document)), after, `${command.id} redone by its difference`);

  expect(store.undo()).toBe(true);
  expect(store.document, 'undone').toBe(document);
  expect(store.selection, 'selected after undo').toBe(selection);
  expect(store.undo()).toBe(false);
  expect(store.redo()).toBe(true);
  expect(store.document, 'redone').toBe(after);
  expect(store.selection, 'selected after redo').toEqual(selectedAfter);

  for (const character of after.characters) expectReadsBack(character, findCharacter(document, character.id));
  return after;
}

/** Expects a change with a sound result. */
export function expectStep(before: Document, after: Document, selected: Selection): void {
  expect(sameValue(before, after), 'a step that changes nothing').toBe(false);
  checkDocument(after);
  checkSelection(after, selected);
}

/** Equal to the last bit, −0 too; `toEqual` takes seconds for a million numbers. */
export function expectSame(found: unknown, meant: unknown, what?: string): void {
  if (sameValue(found, meant)) return;
  expect(found, what).toEqual(meant);
  expect(deltaTo(found, meant), `${what ?? 'what is the same'} to toEqual`).toBeUndefined();
}

/** Freezes, so that writing throws. Elements of typed arrays can't be frozen. */
function freeze(value: unknown): void {
  if (typeof value !== 'object' || value === null || ArrayBuffer.isView(value) || Object.isFrozen(value)) return;
  Object.freeze(value);
  Object.values(value).forEach(freeze);
}

/**
 * Properties that hold parts of the document: what is inside others (a joint's box, a channel's columns) belongs to
 * those parts.
 */
const HOLDS_PARTS: readonly string[] = [
  ...['characters', 'unused', 'skeleton', 'joints', 'skins', 'morphs', 'textures', 'takes', 'channels', 'samples'],
  ...['layers', 'list', 'motion', 'base'],
  ...['unkeyed', 'placements', 'space', 'ik', 'poses', 'sets', 'limbs', 'goals', 'attached', 'leaders', 'sources'],
];

/** The view compares by identity: an unchanged part must be the same object. Lists may be new. */
function expectShared(before: unknown, after: unknown, where: string): void {
  if (before === after || !isRecord(before) || !isRecord(after)) return;
  if (sameValue(after, before)) throw new Error(`${where} was made anew, and nothing in it is different`);
  for (const key of HOLDS_PARTS) {
    // For another skeleton, a take's channels belong to other DOFs.
    if (key === 'takes' && before.skeleton !== after.skeleton) continue;
    // They belong to the active layer.
    if (key === 'channels' && activeIn(before) !== activeIn(after)) continue;
    // Of another layer in its place.
    if (key === 'motion' && before.name !== after.name) continue;
    const [was, is] = [before[key], after[key]];
    if (!Array.isArray(was) || !Array.isArray(is)) expectShared(was, is, `${where}.${key}`);
    else {
      is.forEach((item, i) => {
        const same = was.length === is.length ? was[i] : was.find((other) => nameOf(other) === nameOf(item));
        expectShared(same, item, `${where}.${key}[${i}]`);
      });
    }
  }
}

function isRecord(value: unknown): value is Readonly<Record<string, unknown>> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

/** Identifies an item across lists; by itself if it has no id or name. */
/** The index of a take's active layer. */
function activeIn(take: Readonly<Record<string, unknown>>): unknown {
  return isRecord(take.layers) ? take.layers.active : undefined;
}

function nameOf(item: unknown): unknown {
  return isRecord(item) ? (item.id ?? item.name ?? item) : item;
}

/** Changed parts, written to their formats. */
function expectReadsBack(character: Character, before: Character | undefined): void {
  const { skeleton, skins, morphs, takes, poses, sets, limbs } = character;
  const isNew = (part: object, of: readonly object[] | undefined) => !of?.includes(part);
  if (skeleton && skeleton !== before?.skeleton && !isBvh(character)) {
    // No `.skel` has End Sites or BVH's joints, and its names are single words.
    const isExact = skeleton.joints.every((j) => !j.endSites && j.motion.kind !== 'bvh' && /^\w*$/.test(j.name));
    expectRoundTrip({ kind: 'skel', skeletons: [{ ...skeleton, name: 'x' }] }, isExact);
  }
  for (const skin of skins.filter((part) => isNew(part, before?.skins))) {
    expectRoundTrip({ kind: 'skin', skin: { ...skin, name: 'x' } });
  }
  for (const morph of morphs.filter((part) => isNew(part, before?.morphs))) {
    expectRoundTrip({ kind: 'morph', morph: { ...morph, name: 'x' } });
  }
  for (const { markers: _besideIt, layers: _too, goals: _goals, attached: _attached, ...take } of takes.filter((part) =>
    isNew(part, before?.takes),
  )) {
    // A `.bvh` has no keys; an `.anim` has no samples, and no resting channel without a key.
    const isCapture = skeleton !== undefined && isBvh(character) && take.channels.every(({ kind }) => kind !== 'keys');
    if (isCapture && take.samples) expectRoundTrip({ kind: 'bvh', captures: [{ skeleton, take }] }, false);
    const isExact =
      !take.samples && take.channels.every((c) => c.kind === 'keys' || (c.kind === 'rest' && c.value === 0));
    expectRoundTrip({ kind: 'anim', take: { ...take, name: 'x', channels: take.channels.map(asRead) } }, isExact);
  }
  if (skeleton && sets && sets !== before?.sets) {
    expectRoundTrip({ kind: 'sets', sets: setsByName(sets, skeleton) }, true, 'x.sets.json');
  }
  if (skeleton && limbs && limbs !== before?.limbs) {
    const { list, ...more } = limbs;
    const content = { limbs: limbsByName(list, skeleton), ...more };
    expectRoundTrip({ kind: 'limbs', limbs: content }, true, 'x.limbs.json');
  }
  for (const { goals } of takes.filter((part) => isNew(part, before?.takes))) {
    if (goals) {
      const limbs = { goals: goals.list.map(goalAsRead), base: 'x.base.anim' };
      expectRoundTrip({ kind: 'limbs', limbs }, true, 'x.limbs.json');
    }
  }
  for (const { attached } of takes.filter((part) => isNew(part, before?.takes))) {
    const rows = attached?.list.map(({ leaderId: _id, joint, ...row }) => ({
      character: 'x',
      joint: `#${joint}`,
      ...row,
    }));
    if (rows)
      expectRoundTrip({ kind: 'attach', attach: { base: 'x.base.anim', attached: rows } }, true, 'x.attach.json');
  }
  if (poses && poses !== before?.poses) {
    expectRoundTrip({ kind: 'pose', poses: poses.map((pose) => poseByNames(character, pose)) });
  }
}

function goalAsRead(goal: Goal): Goal {
  const read = ([name, { curve, ...rest }]: [string, GoalCurve]) => {
    return [name, { ...rest, curve: typeof curve === 'number' ? curve : (asRead(curve) satisfies Channel) }];
  };
  return { ...goal, channels: Object.fromEntries(Object.entries(goal.channels).map(read)) };
}

/** Written, read and written again: the same bytes, and the same model if the format can hold all of it. */
function expectRoundTrip(content: FileContent, isExact = true, name = `x.${content.kind}`): void {
  const text = writeFile(content, name)?.text ?? '';
  const found = read(name, text).value;
  if (!found) throw new Error(`${name} was written, and can't be read:\n${text}`);
  if (isExact) expect(found).toEqual(content);
  expect(writeFile(found, name)?.text).toBe(text);
}
