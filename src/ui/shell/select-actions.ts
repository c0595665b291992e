/** Actions that select joints from those selected. */

import { sameNumbers } from '../../math/same-numbers.ts';
import { NOTHING_SELECTED } from '../../model/session.ts';
import { withJoints } from '../../model/skeleton/joint-selection.ts';
import { partOf, selectionOf } from '../../model/skeleton/selected-joints.ts';
import type { Joint, Skeleton } from '../../model/skeleton/skeleton.ts';
import { selectedCharacters } from '../state/actions/action.ts';
import { needs, needsCharacter, needsJoint, needsSkeleton } from '../state/actions/needs.ts';
import { selectedJointsOf } from '../state/joints/selected-joint.ts';
import type { Action, Uses } from '../state/workbench.ts';

export const SELECT_ACTIONS: readonly Action[] = [
  {
    id: 'select.parent',
    unchanged: 'The selected joint has no parent.',
    label: 'Select parent',
    group: 'Select',
    menu: 'Edit/Select',
    shortcuts: ['Up'],
    repeats: true,
    refuses: needsCharacter,
    run: (wb) => walk(wb, (joints, joint) => joints[joint].parent),
  },
  {
    id: 'select.child',
    unchanged: 'The selected joint has no child.',
    label: 'Select first child',
    group: 'Select',
    menu: 'Edit/Select',
    shortcuts: ['Down'],
    repeats: true,
    refuses: needsCharacter,
    // Pre-order: a first child directly follows its parent.
    run: (wb) => walk(wb, (joints, joint) => (joints[joint + 1]?.parent === joint ? joint + 1 : -1)),
  },
  {
    id: 'select.previousSibling',
    unchanged: 'The selected joint has no sibling.',
    label: 'Select previous sibling',
    group: 'Select',
    menu: 'Edit/Select',
    shortcuts: ['Shift+Left'],
    repeats: true,
    refuses: needsCharacter,
    run: (wb) => walk(wb, (joints, joint) => sibling(joints, joint, -1)),
  },
  {
    id: 'select.nextSibling',
    unchanged: 'The selected joint has no sibling.',
    label: 'Select next sibling',
    group: 'Select',
    menu: 'Edit/Select',
    shortcuts: ['Shift+Right'],
    repeats: true,
    refuses: needsCharacter,
    run: (wb) => walk(wb, (joints, joint) => sibling(joints, joint, 1)),
  },
  {
    id: 'select.hierarchy',
    unchanged: 'All descendants of the selected joints are already selected.',
    label: 'Select hierarchy',
    detail: 'The selected joints and all their descendants',
    group: 'Select',
    menu: 'Edit/Select',
    section: 1,
    refuses: needsJoint,
    run: selectHierarchy,
  },
  {
    id: 'select.mirrored',
    unchanged: 'The selected joints have no counterparts on the other side.',
    label: 'Select mirrored joints',
    detail: 'Select those on the other side instead',
    group: 'Select',
    menu: 'Edit/Select',
    section: 1,
    refuses: needsJoint,
    run: selectMirrored,
  },
  {
    id: 'select.allJoints',
    unchanged: 'All joints are already selected.',
    label: 'Select all joints',
    group: 'Select',
    menu: 'Edit/Select',
    section: 1,
    shortcuts: ['Ctrl+A'],
    panel: 'outliner',
    refuses: needsSkeleton,
    run: selectAll,
  },
  {
    id: 'select.nothing',
    label: 'Deselect all',
    group: 'Select',
    menu: 'Edit/Select',
    section: 2,
    refuses: needs('Nothing is selected.', (wb) => wb.store.selection.characterId !== undefined),
    run: (wb) => wb.store.select(NOTHING_SELECTED),
  },
];

/**
 * Selects other joints from each of the selected ones; the root first. A joint from which a step gives −1 or undefined
 * is left out, unless all are: then nothing changes.
 */
function walk(wb: Uses<'store'>, step: (joints: readonly Joint[], joint: number) => number): void {
  const isOne = selectedCharacters(wb).length === 1;
  selectOfEach(wb, ({ joints }, from) => {
    const to = from.length === 0 && isOne ? [0] : from.map((joint) => step(joints, joint));
    return to.filter((joint) => joint >= 0 && joint < joints.length);
  });
}

/** The previous or next sibling, cyclically. */
function sibling(joints: readonly Joint[], joint: number, step: 1 | -1): number {
  const parent = joints[joint].parent;
  const siblings: number[] = [];
  for (let j = Math.max(0, parent); j < joints.length; j++) if (joints[j].parent === parent) siblings.push(j);
  return siblings[(siblings.indexOf(joint) + step + siblings.length) % siblings.length];
}

/** Adds the descendants; the active joint stays active. */
function selectHierarchy(wb: Uses<'store'>): void {
  selectOfEach(wb, (skeleton, joints) => {
    const isInside = new Set(joints);
    skeleton.joints.forEach(({ parent }, joint) => {
      if (isInside.has(parent)) isInside.add(joint);
    });
    return isInside.size > joints.length ? [...isInside, ...joints.slice(-1)] : joints;
  });
}

async function selectMirrored(wb: Uses<'store'>): Promise<void> {
  const { counterpartOf } = await import('../../edit/pose/mirror.ts');
  selectOfEach(wb, (skeleton, joints) => joints.flatMap((joint) => counterpartOf(skeleton, joint) ?? []));
}

function selectAll(wb: Uses<'store'>): void {
  selectOfEach(wb, ({ joints: all }, joints) =>
    joints.length === all.length ? joints : [...all.keys(), ...joints.slice(-1)],
  );
}

/**
 * Selects other joints of each selected character; the same selection if these are selected already, in this order.
 * @param next the active one last; none: those that are selected stay
 */
function selectOfEach(
  { store }: Uses<'store'>,
  next: (skeleton: Skeleton, selected: readonly number[]) => readonly number[],
): void {
  let isSame = true;
  const parts = selectedCharacters({ store }).map(({ id, skeleton }) => {
    const before = selectedJointsOf({ store }, id);
    const joints = skeleton?.joints.length ? next(skeleton, before) : before;
    if (joints.length === 0 || sameNumbers(joints, before)) return partOf(store.selection, id) ?? { characterId: id };
    isSame = false;
    return withJoints({ characterId: id }, joints);
  });
  if (!isSame) store.select(selectionOf(parts));
}
