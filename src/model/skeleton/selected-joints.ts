/**
 * What is selected: of each character its joints, as an ordered set, whose last one is active; the character whose
 * joint was selected last is active, too. `joint-selection.ts` has the rules of selecting.
 */
import type { SelectedPart, Selection } from '../session.ts';
import type { Skeleton } from './skeleton.ts';

const NONE: readonly number[] = [];

/** The joints of a part, or of the active character, in the order of selection, the active one last. */
export function jointsIn({ joint, others = NONE }: SelectedPart): readonly number[] {
  return joint === undefined ? NONE : [...others, joint];
}

/** The part of a character; undefined if nothing of it is selected. */
export function partOf(selection: Selection, characterId: string | undefined): SelectedPart | undefined {
  return selection.characterId === characterId
    ? selection
    : selection.beside?.find((part) => part.characterId === characterId);
}

/** The parts of all characters, the active one last: at least one, which may be empty. */
export function partsOf({ beside = [], ...active }: Selection): readonly SelectedPart[] {
  return [...beside, active];
}

/** The selection of these parts, the active one last. Those without a character are left out. */
export function selectionOf(parts: readonly SelectedPart[]): Selection {
  const beside = parts.filter((part) => part.characterId !== undefined);
  const active = beside.pop();
  return beside.length ? { ...active, beside } : { ...active };
}

/** A selection whose parts have changed; the same object if none did. */
export function withEachPart(selection: Selection, change: (part: SelectedPart) => SelectedPart): Selection {
  if (!selection.beside) return change(selection);
  const before = partsOf(selection);
  const after = before.map(change);
  return after.every((part, i) => part === before[i]) ? selection : selectionOf(after);
}

/**
 * Those that are the same joints after a change of the skeleton: none if joints were added or removed, which renumbers
 * them, or if one has another name and place.
 */
export function othersKept(others: readonly number[], before: Skeleton, after: Skeleton): readonly number[] {
  if (before === after) return others;
  if (before.joints.length !== after.joints.length) return NONE;
  const isSame = (j: number) => {
    const [was, now] = [before.joints[j], after.joints[j]];
    return was !== undefined && (was.name === now.name || was.offset === now.offset);
  };
  return others.every(isSame) ? others : NONE;
}
