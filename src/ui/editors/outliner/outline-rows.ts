/**
 * The outliner's tree as a flat list of rows: characters, and below each its joints, skins, takes and morphs. Joints
 * are in depth-first pre-order, so one pass makes the rows, for any depth and number.
 */
import type { Character, Document } from '../../../model/document.ts';
import { shortJointName } from '../../../model/skeleton/joint-name.ts';
import { arePoints } from '../../../model/skeleton/joint-types.ts';
import type { Joint } from '../../../model/skeleton/skeleton.ts';
import { vertexCount } from '../../../model/skin.ts';
import { duration, plural } from '../../widgets/numbers/number-text.ts';
import { followsText } from '../retarget/moved-text.ts';

export type RowKind = 'character' | 'group' | 'joint' | 'skin' | 'take' | 'morph';

export interface OutlineRow {
  /** Stable across documents. */
  readonly key: string;
  readonly kind: RowKind;
  readonly depth: number;
  /** Empty if the file gives no name. */
  readonly label: string;
  /** The whole name, if the label leaves something out. */
  readonly name?: string;
  readonly detail: string;
  readonly characterId: string;
  /** Into the character's joints, skins, takes or morphs; -1 for the character and groups. */
  readonly index: number;
  readonly expandable: boolean;
  readonly expanded: boolean;
  /** A hidden character. */
  readonly hidden?: boolean;
  /** Of alternatives, the one drawn or played. */
  readonly shown?: boolean;
  /** Listed only because a descendant matches the search. */
  readonly onTheWay: boolean;
}

/** Whether a row is expanded; `otherwise` unless the user has changed it. */
export type IsOpen = (key: string, otherwise: boolean) => boolean;

/** Skeletons up to this size are expanded initially. */
const SMALL_SKELETON = 80;
const OPEN_DEPTH = 3;
/** So are characters, up to this number: of a folder of takes one wants to see the names. */
const FEW_CHARACTERS = 5;

/** Whether there are so few characters that all are expanded initially. */
export const isFew = (characters: readonly Character[]) => characters.length <= FEW_CHARACTERS;

export const characterKey = (id: string) => `${id}`;
export const groupKey = (id: string, group: string) => `${id}/${group}`;
export const jointKey = (id: string, joint: number) => `${id}/joint/${joint}`;

/** @param query rows that contain it, with their ancestors; all rows if empty */
export function outlineRows(document: Document, isOpen: IsOpen, query = ''): OutlineRow[] {
  const rows: OutlineRow[] = [];
  const needle = query.trim().toLowerCase();
  for (const character of document.characters) {
    const key = characterKey(character.id);
    const inside: OutlineRow[] = [];
    const open = needle !== '' || isOpen(key, isFew(document.characters));
    if (open) {
      addJoints(inside, character, isOpen, needle);
      addAlternatives(inside, character, 'skin', 'Skins', isOpen, needle);
      addAlternatives(inside, character, 'take', 'Takes', isOpen, needle);
      addAlternatives(inside, character, 'morph', 'Morphs', isOpen, needle);
    }
    const isMatch = character.name.toLowerCase().includes(needle);
    if (needle && !isMatch && !inside.length) continue;
    rows.push({
      key,
      kind: 'character',
      depth: 0,
      label: character.name,
      detail: characterDetail(character),
      characterId: character.id,
      index: -1,
      expandable: true,
      expanded: open,
      onTheWay: !isMatch,
      ...(character.isHidden && { hidden: true }),
    });
    for (const row of inside) rows.push(row);
  }
  return rows;
}

/** `follows dance`, `×3`. */
function characterDetail(character: Character): string {
  const { length } = character.placements;
  return [followsText(character), length > 1 ? `×${length}` : ''].filter(Boolean).join(' ');
}

function addJoints(rows: OutlineRow[], character: Character, isOpen: IsOpen, needle: string): void {
  const joints = character.skeleton?.joints;
  if (!joints) return;
  const found = needle ? withAncestors(joints, needle) : undefined;
  if (found && !found.any) return;
  const open = needle !== '' || isOpen(groupKey(character.id, 'joint'), true);
  rows.push(group(character, 'joint', arePoints(character.skeleton) ? 'Points' : 'Joints', joints.length, open));
  if (!open) return;
  const depths = new Uint32Array(joints.length);
  let closedDepth = Infinity;
  for (let j = 0; j < joints.length; j++) {
    const { parent, name } = joints[j];
    const depth = parent < 0 ? 0 : depths[parent] + 1;
    depths[j] = depth;
    if (depth > closedDepth) continue;
    closedDepth = Infinity;
    if (found && found.state[j] === 0) continue;
    const key = jointKey(character.id, j);
    const expandable = joints[j + 1]?.parent === j;
    const byDefault = joints.length <= SMALL_SKELETON || depth < OPEN_DEPTH;
    const expanded = expandable && (needle !== '' || isOpen(key, byDefault));
    if (expandable && !expanded) closedDepth = depth;
    const label = name && shortJointName(character.skeleton, j);
    rows.push({
      key,
      kind: 'joint',
      depth: depth + 2,
      label,
      ...(label !== name && { name }),
      detail: String(j),
      characterId: character.id,
      index: j,
      expandable,
      expanded,
      onTheWay: found !== undefined && found.state[j] !== MATCH,
    });
  }
}

const ON_THE_WAY = 1;
const MATCH = 2;

/** For each joint whether it or a descendant matches. `#12` and `12` find a joint by its index. */
function withAncestors(joints: readonly Joint[], needle: string) {
  const state = new Uint8Array(joints.length);
  const byIndex = /^#?(\d+)$/.exec(needle)?.[1];
  let any = false;
  for (let j = joints.length - 1; j >= 0; j--) {
    if (joints[j].name.toLowerCase().includes(needle) || String(j) === byIndex) state[j] = MATCH;
    if (state[j] === 0) continue;
    any = true;
    const { parent } = joints[j];
    if (parent >= 0 && state[parent] === 0) state[parent] = ON_THE_WAY;
  }
  return { state, any };
}

function addAlternatives(
  rows: OutlineRow[],
  character: Character,
  kind: 'skin' | 'take' | 'morph',
  title: string,
  isOpen: IsOpen,
  needle: string,
): void {
  const all = alternatives(character, kind);
  const matching = all.filter((a) => a.label.toLowerCase().includes(needle));
  if (!matching.length) return;
  const open = needle !== '' || isOpen(groupKey(character.id, kind), all.length <= 12);
  rows.push(group(character, kind, title, all.length, open));
  if (!open) return;
  for (const { label, detail, index, shown } of matching) {
    const key = `${groupKey(character.id, kind)}/${index}`;
    const base = { key, kind, depth: 2, label, detail, characterId: character.id, index };
    const row = { ...base, expandable: false, expanded: false, onTheWay: false };
    rows.push(shown === undefined ? row : { ...row, shown });
  }
}

interface Alternative {
  readonly label: string;
  readonly detail: string;
  readonly index: number;
  readonly shown?: boolean;
}

function alternatives(character: Character, kind: 'skin' | 'take' | 'morph'): Alternative[] {
  switch (kind) {
    case 'skin':
      return character.skins.map((skin, index) => ({
        label: skin.name,
        detail:
          character.skeleton && !skin.attachments ? 'no weights' : plural(vertexCount(skin), 'vertex', 'vertices'),
        index,
        shown: index === character.shownSkin,
      }));
    case 'take':
      return character.takes.map((take, index) => ({
        label: take.name,
        detail: duration(take.range[1] - take.range[0]),
        index,
        // No take is shown while another character's moves it.
        shown: !character.driver && index === character.shownTake,
      }));
    case 'morph':
      return character.morphs.map((morph, index) => ({ label: morph.name, detail: '', index }));
  }
}

function group(character: Character, kind: string, label: string, size: number, open: boolean): OutlineRow {
  return {
    key: groupKey(character.id, kind),
    kind: 'group',
    depth: 1,
    label,
    detail: String(size),
    characterId: character.id,
    index: -1,
    expandable: true,
    expanded: open,
    onTheWay: true,
  };
}

/** Keys of the rows that have to be expanded to show a joint. */
export function keysAbove(character: Character, joint: number): string[] {
  const keys = [characterKey(character.id), groupKey(character.id, 'joint')];
  const joints = character.skeleton?.joints ?? [];
  for (let j = joints[joint]?.parent ?? -1; j >= 0; j = joints[j].parent) keys.push(jointKey(character.id, j));
  return keys;
}

/** Whether two documents have the same rows: a changed pose doesn't rebuild them. */
export function sameOutline(a: Document, b: Document): boolean {
  if (a === b) return true;
  if (a.characters.length !== b.characters.length) return false;
  return a.characters.every((before, i) => {
    const after = b.characters[i];
    return (
      before === after ||
      (before.id === after.id &&
        before.name === after.name &&
        before.isHidden === after.isHidden &&
        followsText(before) === followsText(after) &&
        before.skeleton === after.skeleton &&
        before.skins === after.skins &&
        before.shownSkin === after.shownSkin &&
        before.takes === after.takes &&
        before.shownTake === after.shownTake &&
        before.morphs === after.morphs &&
        before.placements.length === after.placements.length)
    );
  });
}
