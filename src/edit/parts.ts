/**
 * Identifies parts after a change; the only place where parts are numbered. Commands replace content without knowing
 * about parts; code that adds parts from files (`files/open`) gives their files, as marks parallel to the character's
 * lists.
 *
 * Marks are part of the document, so undo restores a revision together with its content.
 */

import { type Character, type Document, findCharacter, isBvh } from '../model/document.ts';
import {
  isCaptureKind,
  mapMarks,
  NO_MARKS,
  ownRevision,
  type PartMark,
  type PartMarks,
  SINGLE_PARTS,
  UNMARKED,
} from '../model/part.ts';
import { characterDofs } from '../model/skeleton/dofs.ts';
import { arePoints } from '../model/skeleton/joint-types.ts';
import { layerCode } from '../model/takes/layer-code.ts';
import type { Take } from '../model/takes/take.ts';
import { sameValue } from './delta.ts';
import { haveSameNames } from './pose/same-joints.ts';

/** Returns a number that was never returned before. */
export type Count = () => number;

/** The document with every part marked; the same object if all are. The opening example is changed if a part of it is. */
export function withParts(before: Document, after: Document, next: Count): Document {
  if (before === after) return after;
  let changed = false;
  let isNew = false;
  const count = () => {
    isNew = true;
    return next();
  };
  const characters = after.characters.map((now) => {
    const was = findCharacter(before, now.id);
    if (was === now) return now;
    const parts = marksOf(was, now, count);
    // The file of a skeleton holds the pose.
    if (was && !sameValue(was.pose, now.pose)) isNew = true;
    if (parts === now.parts) return now;
    changed = true;
    return { ...now, parts };
  });
  const marked = changed ? { ...after, characters } : after;
  const isChanged = isNew && before.isOpeningSample === true && after.isOpeningSample === true;
  return isChanged ? { ...marked, isOpeningSample: 'changed' } : marked;
}

/** A document from another page, without that page's numbers, to be renumbered. */
export function withoutNumbers(document: Document): Document {
  const bare = ({ file }: PartMark): PartMark => (file ? { ...UNMARKED, file } : UNMARKED);
  const characters = document.characters.map((c) => ({ ...c, parts: mapMarks(c.parts ?? NO_MARKS, bare) }));
  return { ...document, characters };
}

function marksOf(was: Character | undefined, now: Character, count: Count): PartMarks {
  const before = was?.parts ?? NO_MARKS;
  const said = now.parts ?? NO_MARKS;
  // Marks that were not given explicitly follow from the character before the command.
  const isSaid = now.parts !== undefined && now.parts !== was?.parts;
  const numbered = (mark: PartMark): PartMark =>
    mark.id && mark.revision ? mark : { ...mark, id: mark.id || count(), revision: mark.revision || count() };
  const changed = (mark: PartMark): PartMark => ({ ...mark, revision: count() });
  const list = <T extends Named>(key: 'skins' | 'morphs' | 'takes', a: readonly T[], b: readonly T[]) => {
    const marks = isSaid ? b.map((_, i) => said[key][i] ?? UNMARKED) : followed(a, before[key], b);
    return sameItems(marks.map(numbered), said[key]);
  };
  const single = SINGLE_PARTS.flatMap((key) => {
    const [old, own] = [was?.[key], now[key]];
    if (!own) return [];
    const mark = said[key] ?? UNMARKED;
    const isNew = old && old !== own && mark === before[key];
    const known = numbered(isNew ? { ...mark, revision: 0 } : mark);
    const isSame = !was || known !== before[key] || isWrittenAlike(key, was, now);
    return [[key, isSame ? known : changed(known)] as const];
  });

  const skins = list('skins', was?.skins ?? [], now.skins);
  const morphs = list('morphs', was?.morphs ?? [], now.morphs);
  let takes = list('takes', was?.takes ?? [], now.takes);
  if (was && was.skeleton !== now.skeleton && (isBvh(now) || arePoints(now.skeleton))) {
    // A `.bvh` contains the skeleton with each of its takes.
    takes = takes.map((mark) => (before.takes.includes(mark) && mark.file?.kind !== 'anim' ? changed(mark) : mark));
  }

  const parts: PartMarks = { ...Object.fromEntries(single), ...{ skins, morphs, takes } };
  const isSame =
    skins === said.skins &&
    morphs === said.morphs &&
    takes === said.takes &&
    SINGLE_PARTS.every((key) => parts[key] === said[key]);
  return isSame && now.parts ? now.parts : parts;

  /** Unchanged content keeps its mark; other content in its place is a new revision of the part. */
  function followed<T extends Named>(a: readonly T[], marks: readonly PartMark[], b: readonly T[]): PartMark[] {
    if (a === b) return [...marks];
    const places = new Map(a.map((content, i) => [content, i]));
    const left = new Set(a.keys());
    const kept = b.map((content) => {
      const place = places.get(content);
      return place !== undefined && left.delete(place) ? place : -1;
    });
    return b.map((content, i) => {
      if (kept[i] >= 0) return marks[kept[i]] ?? UNMARKED;
      const named = [...left].find((place) => a[place].name === content.name);
      const place = named ?? (a.length === b.length && left.has(i) ? i : undefined);
      if (place === undefined) return UNMARKED;
      left.delete(place);
      const { withoutMarkers: _own, ...mark } = marks[place] ?? UNMARKED;
      if (isCaptureKind(mark.file?.kind) ? !holdsTheSame(a[place], content) : !areTheSame(a[place], content))
        return { ...mark, revision: 0 };
      if (haveSameMarkers(a[place], content)) return marks[place] ?? UNMARKED;
      return mark.id === 0 ? mark : { ...mark, revision: 0, withoutMarkers: ownRevision(marks[place]) };
    });
  }
}

interface Named {
  readonly name: string;
}

/** Keeps the known list of marks if it is equal. */
function sameItems(list: readonly PartMark[], known: readonly PartMark[]): readonly PartMark[] {
  return list.length === known.length && list.every((mark, i) => mark === known[i]) ? known : list;
}

/**
 * Whether two takes are the same to a `.bvh` or `.amc`, which stores neither playback range nor interpolation, and the
 * files beside it.
 */
function holdsTheSame(a: Named & Partial<Take>, b: Named & Partial<Take>): boolean {
  if (a.goals !== b.goals || a.attached !== b.attached) return false;
  if (a.layers && b.layers) return layerCode(a).haveSameFiles(a, { ...b, range: a.range });
  if (a.layers || b.layers) return false;
  if (!a.samples || !b.samples || a.name !== b.name || a.channels !== b.channels) return false;
  const { interpolation: _a, ...before } = a.samples;
  const { interpolation: _b, ...after } = b.samples;
  // TypeScript types keys as strings.
  const keys = Object.keys({ ...before, ...after }) as (keyof typeof before)[];
  return keys.every((key) => before[key] === after[key]);
}

/** Whether only their markers differ, if anything does. */
function areTheSame(a: Named & Partial<Take>, b: Named & Partial<Take>): boolean {
  const { markers: _a, ...before } = a;
  const { markers: _b, ...after } = b;
  // Which of its layers is active is no part of a take's files.
  const hasSameGoals = a.goals === b.goals && a.attached === b.attached;
  if (a.layers && b.layers && hasSameGoals && layerCode(a).haveSameFiles(a, b)) return true;
  const keys = Object.keys({ ...before, ...after }) as (keyof typeof before)[];
  return keys.every((key) => before[key] === after[key]);
}

function haveSameMarkers(a: Partial<Take>, b: Partial<Take>): boolean {
  return sameValue(a.markers ?? [], b.markers ?? []);
}

/** Whether a part that is the same in both is written the same: those of joints name them. */
function isWrittenAlike(key: (typeof SINGLE_PARTS)[number], was: Character, now: Character): boolean {
  return key === 'skeleton' || (key === 'poses' ? arePosedAlike : areNamedAlike)(was, now);
}

/** Whether joints of both are written the same in files beside the skeleton. */
function areNamedAlike({ skeleton: a }: Character, { skeleton: b }: Character): boolean {
  return a === b || haveSameNames(a?.joints ?? [], b?.joints ?? []);
}

/** Whether poses of both are written the same: their joints, DOFs and morphs have the same names. */
function arePosedAlike(a: Character, b: Character): boolean {
  if (a.skeleton === b.skeleton && a.morphs === b.morphs) return true;
  return (
    haveSameNames(a.skeleton?.joints ?? [], b.skeleton?.joints ?? []) &&
    haveSameNames(characterDofs(a.skeleton, a.morphs), characterDofs(b.skeleton, b.morphs))
  );
}
