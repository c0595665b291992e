/**
 * How joints are selected, of one character or of several: the last one is active, and so is its character. A character
 * whose last joint is deselected leaves the selection, unless it is the only one.
 */
import { NOTHING_SELECTED, type SelectedPart, type Selection } from '../session.ts';
import { jointsIn, partOf, partsOf, selectionOf } from './selected-joints.ts';

/** A joint, and the instance at which it was picked. */
export interface JointPick {
  readonly characterId: string;
  readonly placement?: number;
  /** Index. */
  readonly joint: number;
}

/**
 * The selection of several joints of one character.
 * @param joints the last one becomes active; repeated ones count where they come last; none: only the character
 */
export function withJoints(
  { characterId, placement }: Omit<JointPick, 'joint'>,
  joints: readonly number[],
): SelectedPart & { readonly characterId: string } {
  const each = [...new Set([...joints].reverse())].reverse();
  const joint = each.at(-1);
  const others = each.slice(0, -1);
  return {
    characterId,
    ...(placement !== undefined && { placement }),
    ...(joint !== undefined && { joint }),
    ...(others.length > 0 && { others }),
  };
}

/** The selection in which another part is what is selected of its character, which becomes active. */
export function withPart(selection: Selection, part: SelectedPart): Selection {
  return selectionOf([...partsOf(selection).filter((one) => one.characterId !== part.characterId), part]);
}

/**
 * Adds a joint, which becomes active, or removes it; then the one selected before it is active. A character of which
 * only itself is selected is left for a joint of another one.
 */
export function withJointToggled(selection: Selection, pick: JointPick): Selection {
  const { characterId, joint } = pick;
  const part = partOf(selection, characterId);
  const before = part ? jointsIn(part) : [];
  const isIn = before.includes(joint);
  const after = withJoints(pick, isIn ? before.filter((j) => j !== joint) : [...before, joint]);
  if (!isIn) return withPart(withJointsOnly(selection), after);
  const parts = partsOf(selection).map((one) => (one.characterId === characterId ? after : one));
  const left = parts.filter((one) => one !== after || after.joint !== undefined);
  return left.length ? selectionOf(left) : after;
}

/** Without the active character, if nothing but itself is selected of it. */
function withJointsOnly(selection: Selection): Selection {
  return selection.joint === undefined ? selectionOf(selection.beside ?? []) : selection;
}

/** Adds a character, which becomes active, or removes it with its joints. */
export function withCharacterToggled(selection: Selection, characterId: string): Selection {
  return partOf(selection, characterId)
    ? selectionOf(partsOf(selection).filter((part) => part.characterId !== characterId))
    : withPart(selection, { characterId });
}

/** One of the selected joints becomes active, and all stay selected; another one is selected alone. */
export function withJointActive(selection: Selection, pick: JointPick): Selection {
  const { characterId, joint } = pick;
  const part = partOf(selection, characterId);
  const before = part ? jointsIn(part) : [];
  if (!before.includes(joint)) return withJoints(pick, [joint]);
  return withPart(selection, withJoints(pick, [...before, joint]));
}

/** The selection with these joints of any characters, which come last, in this order. */
export function withJointsOfAll(picks: readonly JointPick[], from: Selection = NOTHING_SELECTED): Selection {
  const parts = new Map(partsOf(withJointsOnly(from)).map((part) => [part.characterId, part]));
  for (const { characterId, joint } of picks) {
    const part = parts.get(characterId);
    parts.delete(characterId);
    parts.set(characterId, withJoints({ characterId, ...part }, [...(part ? jointsIn(part) : []), joint]));
  }
  return selectionOf([...parts.values()]);
}
