/**
 * The tool of Pose mode. What a press takes, in this order:
 *
 *     the dot of the rings         the selected joint, dragged at its pivot
 *     a ring or an arrow           of the selected joint: its DOF
 *     a goal or a pole             of a limb in IK: moves it
 *     a pin                        moves it; a handle of the selected one, along an axis or in a plane
 *     a hand, a foot, a head, or   its limb, with the reach of IK; pins hold, and feet that stand if the whole body
 *     the end of another limb      moves. Alt: in depth; touch: a second finger
 *     anything else                the camera
 *
 * A click selects.
 */
import type { HandleId, JointHandles } from '../../../evaluate/handles/joint-handles.ts';
import { ZERO } from '../../../math/vec3.ts';
import { findCharacter } from '../../../model/document.ts';
import { perObject } from '../../../model/per-object.ts';
import type { HandleHit } from '../../../view/gizmo/handle-at.ts';
import { meantJoint } from '../../state/joints/meant-joint.ts';
import { addsToSelection, selectHit } from '../../state/joints/select-joints.ts';
import { type ResolvedJoint, selectedJoint } from '../../state/joints/selected-joint.ts';
import type { Workbench } from '../../state/workbench.ts';
import { SelectedGizmo } from '../fk/selected-gizmo.ts';
import { ikControls } from '../ik/ik-controls.ts';
import { isOnGoal, pressGoal } from '../ik/limb-goals.ts';
import { selectPin } from '../ik/pin-edits.ts';
import { PinGizmo } from '../ik/pin-gizmo.ts';
import { heldPoint, pinUnder, type SeenPoint } from '../ik/pins-on-screen.ts';
import { PointHand } from '../ik/point-hand.ts';
import { selectedPin } from '../ik/selected-pin.ts';
import { activeDof, chooseDof } from '../posing/active-dof.ts';
import type { CanvasDrag, CanvasPointer } from '../viewport/canvas-tools.ts';
import type { ModeTool } from '../viewport/mode-tool.ts';
import { endUnder, whatEndMoves } from './end-under.ts';

export function poseTool(wb: Workbench): ModeTool {
  return new PoseTool(wb);
}

class PoseTool implements ModeTool {
  private readonly gizmo: SelectedGizmo;
  private readonly hand: PointHand;
  private readonly axes: PinGizmo;
  private controls: HTMLElement | undefined;
  private stop = () => {};

  constructor(private readonly wb: Workbench) {
    const active = (): HandleId | undefined => {
      const dof = activeDof(wb);
      return dof === undefined ? undefined : { kind: 'dof', dof };
    };
    this.gizmo = new SelectedGizmo(wb, {
      only: (handles) => (selectedPin(wb) ? undefined : withoutBall(handles)),
      active,
    });
    this.hand = new PointHand(wb, {
      pointAt: (at) => endUnder(wb, at),
      pins: false,
      whatMoves: (id, joint) => whatEndMoves(wb, id, joint),
    });
    this.axes = new PinGizmo(wb, this.hand);
  }

  enter(): void {
    const { wb } = this;
    this.gizmo.enter();
    this.hand.enter();
    this.axes.enter();
    this.controls ??= ikControls(wb, 'pose');
    wb.posing.controls.set(this.controls);
    this.stop = wb.posing.chosenDof.subscribe(() => wb.viewport.requestRender());
  }

  leave(): void {
    this.hover(undefined);
    this.stop();
    this.axes.leave();
    this.hand.leave();
    this.gizmo.leave();
    this.wb.posing.controls.set(undefined);
  }

  press(at: CanvasPointer): CanvasDrag | undefined {
    const { wb, gizmo, hand } = this;
    if (at.button !== 0) return undefined;
    const axis = this.axes.press(at) ?? pressGoal(wb, at, (grip, click) => hand.begin(grip, at, click));
    if (axis) return axis;
    const selected = selectedJoint(wb);
    if (selected && gizmo.isOnPivot(at)) {
      return this.pull(pivotOf(wb, selected), at);
    }
    const handle = gizmo.at(at);
    if (handle && selected && !handle.yields) return this.turn(handle, selected, at);
    const pin = pinUnder(wb, at);
    if (pin && !at.shiftKey) {
      const { id, joint, point } = pin.pin;
      const characterId = pin.character.id;
      const grip = { characterId, placement: pin.placement, joint, point, pin: id };
      return hand.begin(grip, at, () => selectPin(wb, { characterId, pin: id }, joint, pin.placement));
    }
    // Shift pans, beside handles.
    const end = at.shiftKey ? undefined : endUnder(wb, at);
    if (end) return this.pull(end, at);
    return handle && selected ? this.turn(handle, selected, at) : undefined;
  }

  click(): boolean {
    this.wb.posing.ik.selected.set(undefined);
    return false;
  }

  menu(at: CanvasPointer): boolean {
    const pin = pinUnder(this.wb, at);
    if (pin) selectPin(this.wb, { characterId: pin.character.id, pin: pin.pin.id }, pin.pin.joint, pin.placement);
    return pin !== undefined || this.gizmo.at(at)?.yields === false;
  }

  hover(at: CanvasPointer | undefined): string | undefined {
    const { wb, gizmo, hand } = this;
    const { point } = hand;
    if (this.axes.hover(at) || (at && isOnGoal(wb, at))) {
      hand.show(undefined, undefined);
      return 'grab';
    }
    const isOnPivot = at !== undefined && gizmo.isOnPivot(at);
    const handle = at && !isOnPivot ? gizmo.at(at) : undefined;
    const selected = isOnPivot ? selectedJoint(wb) : undefined;
    if (selected || (handle && !handle.yields)) {
      gizmo.light(handle?.id, at);
      const pivot = selected && pivotOf(wb, selected);
      hand.show(undefined, pivot && isOfJoint(pivot, point) ? point : pivot);
      return 'grab';
    }
    const pin = at && pinUnder(wb, at);
    hand.show(pin, pin || !at ? undefined : point);
    if (!pin && at && at.pointerType !== 'touch') hand.lookSoon(at);
    const isTaken = pin !== undefined || hand.point !== undefined;
    gizmo.light(isTaken ? undefined : handle?.id, at);
    if (pin) return 'grab';
    if (hand.point) return 'pointer';
    // "grab" would claim the pointer: a handle that yields must leave the viewport looking for joints.
    return handle && 'move';
  }

  /** Drags a point by IK; a click there picks as anywhere. */
  private pull(seen: SeenPoint, at: CanvasPointer): CanvasDrag {
    const { wb } = this;
    const { characterId, placement, joint } = seen;
    this.gizmo.light(undefined, undefined);
    return this.hand.begin({ characterId, placement, joint, point: heldPoint(wb, seen) }, at, () => {
      wb.posing.ik.selected.set(undefined);
      const hit = wb.viewport.pointing.pick(at.clientX, at.clientY);
      const skeleton = findCharacter(wb.store.document, characterId)?.skeleton;
      const isOnIt = hit?.characterId === characterId && hit.joint !== undefined && skeleton !== undefined;
      const meant = isOnIt ? { ...hit, joint: meantJoint(skeleton, joint, hit.joint) } : hit;
      selectHit(wb, meant, addsToSelection(wb, at));
    });
  }

  private turn({ id }: HandleHit, selected: ResolvedJoint, at: CanvasPointer): CanvasDrag {
    const { chosenDof } = this.wb.posing;
    const before = chosenDof.get();
    this.hand.show(undefined, undefined);
    if (id.kind === 'dof') chooseDof(this.wb, id.dof);
    return this.gizmo.dragHandle(id, selected, at, (now) => {
      if (!now) chosenDof.set(before);
    });
  }
}

/** The ball within the rings would take what is meant for the camera, and its outer ring what is meant for the ends. */
const withoutBall = perObject((handles: JointHandles): JointHandles => ({ ...handles, freeTurn: undefined }));

/** The selected joint at its pivot. */
function pivotOf({ viewport }: Pick<Workbench, 'viewport'>, { character, joint }: ResolvedJoint): SeenPoint {
  return { characterId: character.id, placement: viewport.pickedCopy(character), joint, point: ZERO };
}

function isOfJoint(a: SeenPoint, b: SeenPoint | undefined): boolean {
  return b !== undefined && a.characterId === b.characterId && a.placement === b.placement && a.joint === b.joint;
}
