/**
 * Converts pointer motion to DOF values: one mover for each kind of handle, created for the pose when a drag begins.
 */
import { matchingDofs, sameChange } from '../../../edit/pose/same-change.ts';
import { DraggedValue, type HandWants } from '../../../evaluate/handles/dragged-value.ts';
import { freeTurn, Turning } from '../../../evaluate/handles/free-turn.ts';
import {
  type Handle,
  type HandleId,
  type JointHandles,
  jointHandles,
  sameHandle,
} from '../../../evaluate/handles/joint-handles.ts';
import { compileSkeleton, worldMatrices } from '../../../evaluate/kinematics.ts';
import { type CharacterDof, characterDofs, type DofValue } from '../../../model/skeleton/dofs.ts';
import type { DraggedHandle } from '../../../view/gizmo/gizmo-look.ts';
import {
  diagonalMeasure,
  lineOfSight,
  type Measure,
  rollMeasure,
  type Sight,
  slideMeasure,
  turnMeasure,
  upMeasure,
  viewTurnMeasure,
} from '../../../view/gizmo/pointer-measures.ts';
import { BALL_PART, shearPart } from '../../../view/gizmo/shapes.ts';
import type { ResolvedJoint } from '../../state/joints/selected-joint.ts';
import { SNAP_ANGLE, snapStep } from '../posing/active-dof.ts';
import type { CanvasPointer } from '../viewport/canvas-tools.ts';

/** The result of a drag so far. */
export interface DragResult {
  /** What it does to the joint, for the name of its undo step. */
  readonly verb: 'Rotate' | 'Move' | 'Scale' | 'Shear';
  /** DOFs of the active joint. */
  readonly dofs: readonly DofValue[];
  /** Of the other selected joints. */
  readonly others: readonly DofValue[];
  /** For the gizmo. */
  readonly handle: DraggedHandle;
  /** DOFs at their limits, or beyond them. */
  readonly stops: readonly { readonly dof: number; readonly limit: number }[];
  /** Radians since the press, if the readout shows that. */
  readonly turned?: number;
}

export type Mover = (at: CanvasPointer) => DragResult;

/** Where a drag begins. */
export interface FkGrip {
  /** The active joint. */
  readonly selected: ResolvedJoint;
  /** Joints selected with it, which change by the same amounts. */
  readonly others: readonly number[];
  /** The pose at that time. */
  readonly dofs: Float64Array;
  /** 16 numbers, from the character's space to the world. */
  readonly placement: Float64Array;
  readonly sight: Sight;
  /** Radius of the rings, CSS pixels. */
  readonly radius: number;
  readonly at: CanvasPointer;
}

/** Radians per pixel that the bone is dragged up. */
const BONE_TURN = Math.PI / 360;
const BONE_FACTOR = 0.01;
const VERBS: Readonly<Record<Handle['kind'], DragResult['verb']>> = {
  turn: 'Rotate',
  slide: 'Move',
  stretch: 'Scale',
  grow: 'Scale',
  shear: 'Shear',
};

/** What the keys held with the pointer ask for. */
export const wantsOf = ({ shiftKey, ctrlKey, metaKey }: CanvasPointer): HandWants => ({
  fine: shiftKey,
  snap: ctrlKey || metaKey,
});

/** For a handle; undefined if the joint doesn't have it. */
export function handleMover(id: HandleId, grip: FkGrip): Mover | undefined {
  const joint = handlesOf(grip);
  const handle = joint.handles.find((h) => sameHandle(h.id, id));
  if (id.kind === 'dof') return handle && dofMover(handle, id.dof, grip, handleMeasure(handle, grip), true);
  if (!joint.freeTurn) return undefined;
  if (id.kind === 'ball') return rollMover(joint, grip);
  const { sight, at } = grip;
  if (id.kind === 'view') {
    const axis = lineOfSight(sight, joint.pivot);
    return freeMover(id, axis, viewTurnMeasure(sight, joint.pivot, at.clientX, at.clientY), joint, grip);
  }
  return handle && freeMover(id, handle.axis, handleMeasure(handle, grip), joint, grip);
}

/** For the bone itself, dragged up and down: changes the DOF; a joint without a DOF to change is rotated freely. */
export function boneMover(dof: number | undefined, grip: FkGrip): Mover | undefined {
  const joint = handlesOf(grip);
  if (dof === undefined) return joint.freeTurn && rollMover(joint, grip);
  const handle = joint.handles.find(({ id }) => id.kind === 'dof' && id.dof === dof);
  return handle && dofMover(handle, dof, grip, boneMeasure(handle, grip), false);
}

/** The handles in the pose of the grip. */
export function handlesOf({
  selected: { skeleton, joint },
  dofs,
  placement,
}: Pick<FkGrip, 'selected' | 'dofs' | 'placement'>): JointHandles {
  const world = worldOf(skeleton, dofs);
  return jointHandles(skeleton, joint, dofs, world, placement);
}

function worldOf(skeleton: ResolvedJoint['skeleton'], dofs: Float64Array): Float64Array {
  const world = new Float64Array(16 * skeleton.joints.length);
  worldMatrices(compileSkeleton(skeleton), dofs, world);
  return world;
}

/** Motion of a handle in its DOF's unit. */
function handleMeasure(handle: Handle, { sight, radius, at }: FkGrip): Measure {
  const { kind, axis, centre, reach, arm, range } = handle;
  const { clientX, clientY } = at;
  const size = radius * sight.unitsPerPixel(centre);
  const per = (measure: Measure, unit: number): Measure => {
    return (x, y) => measure(x, y) / unit;
  };
  // A scale doubles over one handle length; a large one sooner.
  const factor = Math.max(1, Math.abs(range.value));
  switch (kind) {
    case 'turn':
      return turnMeasure(sight, axis, centre, size, clientX, clientY);
    case 'slide':
      return per(slideMeasure(sight, axis, centre, clientX, clientY), reach);
    case 'stretch':
      return per(slideMeasure(sight, axis, centre, clientX, clientY), size / factor);
    case 'grow':
      return per(diagonalMeasure(clientX, clientY), radius / factor);
    case 'shear': {
      const far = (shearPart(handle) * size) / (Math.hypot(...(arm ?? axis)) || 1);
      return per(slideMeasure(sight, axis, centre, clientX, clientY), far * reach);
    }
  }
}

function boneMeasure({ kind, centre, reach, range }: Handle, { sight, at }: FkGrip): Measure {
  const up = upMeasure(at.clientY);
  const isFactor = kind === 'stretch' || kind === 'grow' || kind === 'shear';
  const perPixel = isFactor
    ? BONE_FACTOR * Math.max(1, Math.abs(range.value))
    : kind === 'slide'
      ? sight.unitsPerPixel(centre) / reach
      : BONE_TURN;
  return (x, y) => perPixel * up(x, y);
}

function dofMover(
  { range, id, kind }: Handle,
  dof: number,
  { selected, others, dofs }: FkGrip,
  measure: Measure,
  sticks: boolean,
): Mover {
  const { character, skeleton } = selected;
  const verb = VERBS[kind];
  const from = dofs[dof];
  const step = snapStep(characterDofs(skeleton, [])[dof], skeleton);
  const limits = { min: range.min, max: range.max, hold: character.clampsToLimits };
  const dragged = new DraggedValue(from, limits, step, sticks);
  const matching = matchingDofs(skeleton, others, dof);
  return (at) => {
    const { value, stop } = dragged.by(measure(at.clientX, at.clientY), wantsOf(at));
    const stops = stop ? [{ dof, limit: range[stop] }] : [];
    const own = { index: dof, value };
    return { verb, dofs: [own], others: sameChange(dofs, own, matching), handle: { id, from, stop }, stops };
  };
}

/** About an axis that stays as it was at the press. */
function freeMover(id: HandleId, axis: Handle['axis'], measure: Measure, joint: JointHandles, grip: FkGrip): Mover {
  const turnings = turningsOf(joint, grip);
  const angle = new DraggedValue(0, { min: 1, max: 0, hold: false }, SNAP_ANGLE, true);
  let turned = 0;
  return (at) => {
    const { value } = angle.by(measure(at.clientX, at.clientY), wantsOf(at));
    for (const turning of turnings) turning.by(axis, value - turned);
    turned = value;
    return { ...freeResult(id, turnings, grip), turned };
  };
}

function rollMover(joint: JointHandles, grip: FkGrip): Mover {
  const { sight, radius, at } = grip;
  const turnings = turningsOf(joint, grip);
  const roll = rollMeasure(sight, joint.pivot, BALL_PART * radius, at.clientX, at.clientY);
  return (next) => {
    const by = roll(next.clientX, next.clientY);
    const angle = by && (wantsOf(next).fine ? 0.1 * by.angle : by.angle);
    if (by && angle !== undefined) for (const turning of turnings) turning.by(by.axis, angle);
    return freeResult({ kind: 'ball' }, turnings, grip);
  };
}

/** That of the active joint first, then those of the others that can turn freely. */
function turningsOf(
  { freeTurn: own }: JointHandles,
  { selected: { skeleton }, others, dofs, placement }: FkGrip,
): readonly Turning[] {
  if (!own) return [];
  const world = worldOf(skeleton, dofs);
  const turns = [own, ...others.flatMap((joint) => freeTurn(skeleton, joint) ?? [])];
  return turns.map((turn) => new Turning(skeleton, turn, dofs, world, placement));
}

function valuesOf({ turn, result }: Turning): DofValue[] {
  return turn.dofs.map((index, i) => ({ index, value: result[i] }));
}

function freeResult(
  id: HandleId,
  [own, ...others]: readonly Turning[],
  { selected: { skeleton } }: FkGrip,
): DragResult {
  const all: readonly CharacterDof[] = characterDofs(skeleton, []);
  const dofs = own ? valuesOf(own) : [];
  const stops = dofs.flatMap(({ index, value }) => {
    const { min, max } = all[index].limit;
    if (min > max || (value > min && value < max)) return [];
    return [{ dof: index, limit: value <= min ? min : max }];
  });
  const handle = { id, from: 0, stop: undefined };
  return { verb: 'Rotate', dofs, others: others.flatMap(valuesOf), handle, stops };
}
