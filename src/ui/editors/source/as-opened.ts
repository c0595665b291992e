/**
 * What is in the page beside what its files gave. Lines are those of the model as it was opened, so a selection is
 * first translated to that model, and what a line holds is translated back. What was added since has no lines; the
 * lines of what was removed select nothing.
 *
 * Joints correspond by their name and their parent's, DOFs by their joint and name, keys by time and value, vertices by
 * index as long as the mesh has the same size.
 */

import { type Character, type Document, shownSkin, shownTake } from '../../../model/document.ts';
import type { SourceFile } from '../../../model/files.ts';
import type { PartMark } from '../../../model/part.ts';
import type { ChannelKeys, Selection } from '../../../model/session.ts';
import { characterDofs } from '../../../model/skeleton/dofs.ts';
import { withJoints } from '../../../model/skeleton/joint-selection.ts';
import { jointsIn } from '../../../model/skeleton/selected-joints.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import type { SourceTarget } from '../../../model/source-map.ts';
import { keysOf } from '../../../model/takes/take.ts';
import type { AsOpened } from '../../state/source.ts';
import { type ChosenDof, type FileParts, frameAt, type Picked, partsFrom, pickOf, targetsOf } from './places.ts';

/** A character's parts from a file, now and as the file gave them. */
export interface Origin {
  readonly now: FileParts;
  readonly file: FileParts;
}

/** `edited`: some parts have changed since. `other`: the text is not the one that the parts were read from. */
export type TextState = 'same' | 'edited' | 'other';

export interface Origins {
  readonly state: TextState;
  /** None if the text is another one. */
  readonly origins: readonly Origin[];
}

/** What is known about the file of a path. */
export interface Known {
  opened(source: SourceFile): AsOpened | undefined;
  given(path: string): Blob | undefined;
  /** Whether a character's part from the path differs from its file. */
  isUnsaved(characterId: string, path: string): boolean;
}

/** The parts that a document has from a file. */
export function originsIn(document: Document, path: string, known: Known): Origins {
  const origins: Origin[] = [];
  let state: TextState = 'same';
  const lists = new Map<readonly Character[], ReadonlyMap<string, FileParts>>();
  for (const now of partsFrom(document, path)) {
    const { character } = now;
    const source = marksFrom(character, path)[0]?.file?.source;
    const opened = source && known.opened(source);
    if (!opened) {
      // A restored session knows only whether its parts are those of their files.
      if (known.isUnsaved(character.id, path)) state = 'edited';
      else origins.push({ now, file: now });
      continue;
    }
    if (opened.given !== known.given(path)) return { state: 'other', origins: [] };
    // Listed once: a file of thousands of characters would be looked through for each.
    const list = lists.get(opened.characters) ?? partsById(opened, path);
    lists.set(opened.characters, list);
    const then = list.get(character.id);
    // A pose is no part, but is saved with its skeleton.
    if (isEdited(character, then?.character, path) || known.isUnsaved(character.id, path)) state = 'edited';
    const file = then && partsThen(now, then, path);
    if (file) origins.push({ now, file });
  }
  return { state, origins };
}

/** The parts of a selection that the file holds, the one to be shown first. */
export function targetsThen(origin: Origin, selection: Selection, chosen: ChosenDof | undefined): SourceTarget[] {
  const { now, file } = origin;
  if (selection.characterId !== now.character.id) return [];
  const translated = selectionThen(origin, selection);
  // Of keys that the file doesn't hold, their channels would be too much.
  const isWithoutKeys = selection.keys !== undefined && translated.keys === undefined;
  const dof = chosen?.characterId === now.character.id ? dofsThen(origin)[chosen.dof] : undefined;
  const dofThen = chosen && dof !== undefined && dof >= 0 ? { ...chosen, dof } : undefined;
  return targetsOf(isWithoutKeys ? { ...file, hasTake: false } : file, translated, dofThen);
}

/** What a click on a part of the file selects now; of a part that has gone, only what it was. */
export function pickNow(
  origins: readonly Origin[],
  target: SourceTarget,
): Picked | { readonly gone: string } | undefined {
  let gone: string | undefined;
  for (const origin of origins) {
    const picked = pickOf([origin.file], target);
    if (!picked) continue;
    const now = pickedNow(origin, picked);
    if (now) return now;
    gone ??= picked.text;
  }
  return gone === undefined ? undefined : { gone };
}

/** The frame at a time; undefined without samples or with others than in the file. */
export function frameThen({ now, file }: Origin, timeSeconds: number): SourceTarget | undefined {
  const [a, b] = [shownTake(now.character)?.samples, shownTake(file.character)?.samples];
  if (!a || !b || !file.hasTake) return undefined;
  const isSame =
    a.frameCount === b.frameCount && a.frameSeconds === b.frameSeconds && a.startSeconds === b.startSeconds;
  return isSame ? frameAt(now, timeSeconds) : undefined;
}

/** Changes with what the document has from a file. */
export function contentKey({ characters }: Document, path: string): string {
  const own = characters.flatMap((character) => {
    const marks = marksFrom(character, path);
    const hasSkeleton = character.parts?.skeleton?.file?.source.path === path;
    const key = marks.map(({ id, revision }) => `${id} ${revision}`).join();
    return marks.length > 0 ? [`${character.id} ${key} ${hasSkeleton ? character.pose.join(' ') : ''}`] : [];
  });
  return own.join('\n');
}

function marksFrom({ parts }: Character, path: string): readonly PartMark[] {
  const all = parts ? [parts.skeleton, ...parts.skins, ...parts.morphs, ...parts.takes, parts.poses] : [];
  return all.flatMap((mark) => (mark?.file?.source.path === path ? [mark] : []));
}

/** What the file gave, by the ids of its characters. */
function partsById({ characters }: AsOpened, path: string): ReadonlyMap<string, FileParts> {
  return new Map(partsFrom({ characters }, path).map((parts) => [parts.character.id, parts]));
}

/** A revision identifies a part's content; undo restores it. */
function isEdited(now: Character, before: Character | undefined, path: string): boolean {
  const key = ({ id, revision }: PartMark) => `${id} ${revision}`;
  const known = new Set(before && marksFrom(before, path).map(key));
  const marks = marksFrom(now, path);
  return known.size !== marks.length || marks.some((mark) => !known.has(key(mark)));
}

/** The parts as they were opened, showing the skin and take that are shown now. */
function partsThen(now: FileParts, { character, root }: FileParts, path: string): FileParts | undefined {
  const { parts, timeOffsetSeconds, ...shown } = now.character;
  const at = (marks: readonly PartMark[] | undefined, own: PartMark | undefined) =>
    marks?.findIndex((mark) => mark.id === own?.id) ?? -1;
  const shownSkin = at(character.parts?.skins, parts?.skins[shown.shownSkin]);
  const shownTake = at(character.parts?.takes, parts?.takes[shown.shownTake]);
  const [then] = partsFrom({ characters: [{ ...character, shownSkin, shownTake, timeOffsetSeconds }] }, path);
  if (!then) return undefined;
  // Alone it is the first of its file.
  const { root: _first, ...rest } = then;
  return {
    ...rest,
    ...(now.root !== undefined && root !== undefined && { root }),
    hasSkin: then.hasSkin && now.hasSkin,
    hasMorph: then.hasMorph && now.hasMorph,
    hasTake: then.hasTake && now.hasTake,
  };
}

function selectionThen(origin: Origin, selection: Selection): Selection {
  const { now, file } = origin;
  const joints = jointsThen(origin);
  const own = jointsIn(selection).map((joint) => joints[joint] ?? -1);
  const keys = selection.keys && keysThen(origin, selection.keys);
  return {
    ...withJoints(
      { characterId: file.character.id },
      own.filter((joint) => joint >= 0),
    ),
    ...(selection.vertex !== undefined && hasSameMesh(now.character, file.character) && { vertex: selection.vertex }),
    ...(keys?.length && { keys }),
  };
}

function pickedNow(origin: Origin, picked: Picked): Picked | undefined {
  const { now, file } = origin;
  const { selection, dof, ...rest } = picked;
  const { joint, vertex, keys } = selection;
  const jointNow = joint === undefined ? undefined : jointsThen(origin).indexOf(joint);
  if (jointNow === -1) return undefined;
  if (vertex !== undefined && !hasSameMesh(now.character, file.character)) return undefined;
  const back = { now: origin.file, file: origin.now };
  const keysNow = keys && keysThen(back, keys);
  if (keysNow?.length === 0) return undefined;
  const dofNow = dof && dofsThen(back)[dof.dof];
  if (dofNow === -1) return undefined;
  return {
    ...rest,
    selection: { ...selection, ...(jointNow !== undefined && { joint: jointNow }), ...(keysNow && { keys: keysNow }) },
    ...(dof && dofNow !== undefined && { dof: { ...dof, dof: dofNow } }),
  };
}

/** Of each joint, its index in the file; -1: not there. */
function jointsThen({ now, file }: Origin): readonly number[] {
  const [a, b] = [now.character.skeleton, file.character.skeleton];
  return counterparts(jointKeys(a), jointKeys(b));
}

function jointKeys(skeleton: Skeleton | undefined): readonly string[] {
  const { joints = [] } = skeleton ?? {};
  return joints.map(({ name, parent }) => `${name}\n${joints[parent]?.name ?? ''}`);
}

/** Of each DOF, and so of each channel, its index in the file; -1: not there. */
function dofsThen(origin: Origin): readonly number[] {
  const joints = jointsThen(origin);
  const own = (character: Character) => characterDofs(character.skeleton, character.morphs);
  const now = own(origin.now.character).map(({ joint, name }, i) => {
    const then = joint < 0 ? -1 : joints[joint];
    return joint >= 0 && then === -1 ? `added ${i}` : `${then} ${name}`;
  });
  return counterparts(
    now,
    own(origin.file.character).map(({ joint, name }) => `${joint} ${name}`),
  );
}

function keysThen(origin: Origin, keys: readonly ChannelKeys[]): readonly ChannelKeys[] {
  const [now, then] = [shownTake(origin.now.character), shownTake(origin.file.character)];
  if (!now || !then) return [];
  const dofs = dofsThen(origin);
  return keys.flatMap((of) => {
    // Channels beyond the DOFs drive nothing and are where they were.
    const channel = dofs[of.channel] ?? of.channel;
    const [a, b] = [keysOf(now.channels[of.channel]), keysOf(then.channels[channel])];
    const texts = ({ times, values }: typeof a) => Array.from(times, (time, k) => `${time} ${values[k]}`);
    const indices = a === b ? of.indices : counterparts(texts(a), texts(b)).filter((_, k) => of.indices.includes(k));
    const found = indices.filter((k) => k >= 0);
    return channel >= 0 && found.length > 0 ? [{ channel, indices: found }] : [];
  });
}

function hasSameMesh(now: Character, then: Character): boolean {
  const [a, b] = [shownSkin(now), shownSkin(then)];
  return a === b || (a?.positions.length === b?.positions.length && a?.triangles.length === b?.triangles.length);
}

/** The index of each text in another list; -1 if it occurs more or less often there. Repeated ones are in order. */
function counterparts(now: readonly string[], then: readonly string[]): readonly number[] {
  const [a, b] = [placesOf(now), placesOf(then)];
  return now.map((text, i) => {
    const own = a.get(text) ?? [];
    const others = b.get(text) ?? [];
    return own.length === others.length ? others[own.indexOf(i)] : -1;
  });
}

function placesOf(texts: readonly string[]): ReadonlyMap<string, readonly number[]> {
  const places = new Map<string, number[]>();
  texts.forEach((text, i) => {
    const known = places.get(text);
    if (known) known.push(i);
    else places.set(text, [i]);
  });
  return places;
}
