/**
 * The viewport's tool for inverse kinematics.
 *
 *     click          pins the visible point there, or unpins it
 *     Shift+click    selects the joint, and the pin
 *     Ctrl+click     adds the joint to the selection, or removes it
 *     drag           a pin or any other point; other pins hold
 *     Alt, right     in depth; the right button only on a pin, as it pans elsewhere
 *     long press     on touch: as Shift+click; a second finger drags in depth
 *     a ring         of the selected joint: rotates it while the pins hold
 *     a handle       of the selected pin, in place of the rings: moves it along an axis or in a plane, or turns it
 */
import type { HandleId, JointHandles } from '../../../evaluate/handles/joint-handles.ts';
import { defaultPinPoint } from '../../../evaluate/ik/pin-points.ts';
import { ikOf } from '../../../evaluate/ik/set-up.ts';
import { type Character, findCharacter, shownSkin } from '../../../model/document.ts';
import { perObject } from '../../../model/per-object.ts';
import type { HandleHit } from '../../../view/gizmo/handle-at.ts';
import { addsToSelection, selectHit } from '../../state/joints/select-joints.ts';
import { type ResolvedJoint, selectedJoint } from '../../state/joints/selected-joint.ts';
import type { Workbench } from '../../state/workbench.ts';
import { SelectedGizmo } from '../fk/selected-gizmo.ts';
import type { CanvasDrag, CanvasPointer } from '../viewport/canvas-tools.ts';
import type { ModeTool } from '../viewport/mode-tool.ts';
import { ikControls } from './ik-controls.ts';
import { isOnGoal, pressGoal } from './limb-goals.ts';
import { pinAt, selectPin, unpinByHand } from './pin-edits.ts';
import { PinGizmo } from './pin-gizmo.ts';
import { PinNudge } from './pin-nudge.ts';
import { heldPoint, pinUnder, pointUnder, type SeenPoint } from './pins-on-screen.ts';
import { PointHand } from './point-hand.ts';
import { whatMoves } from './reach.ts';
import { selectedPin } from './selected-pin.ts';

export function ikTool(wb: Workbench): ModeTool {
  return new IkTool(wb);
}

class IkTool implements ModeTool {
  private readonly nudge: PinNudge;
  private readonly rings: SelectedGizmo;
  private readonly hand: PointHand;
  private readonly axes: PinGizmo;
  private controls: HTMLElement | undefined;
  private listening: AbortController | undefined;

  constructor(private readonly wb: Workbench) {
    this.nudge = new PinNudge(wb);
    this.rings = new SelectedGizmo(wb, { only: (handles) => (selectedPin(wb) ? undefined : ringsOnly(handles)) });
    this.hand = new PointHand(wb, {
      pointAt: (at) => pointUnder(wb, at),
      pins: true,
      whatMoves: (id, joint) => whatMoves(wb, id, joint),
      pull: () => this.nudge.state,
    });
    this.axes = new PinGizmo(wb, this.hand);
  }

  enter(): void {
    const { wb } = this;
    this.rings.enter();
    this.hand.enter();
    this.axes.enter();
    this.controls ??= ikControls(wb);
    wb.posing.controls.set(this.controls);
    this.listening = new AbortController();
    const { signal } = this.listening;
    const { canvas } = wb.viewport;
    canvas.addEventListener('keydown', (event) => this.nudge.key(event), { signal });
    canvas.addEventListener('blur', () => this.nudge.finish(), { signal });
  }

  leave(): void {
    this.nudge.finish();
    this.hover(undefined);
    this.listening?.abort();
    this.axes.leave();
    this.hand.leave();
    this.rings.leave();
    this.wb.posing.controls.set(undefined);
  }

  press(at: CanvasPointer): CanvasDrag | undefined {
    this.nudge.finish();
    const axis = this.axes.press(at) ?? pressGoal(this.wb, at, (grip, click) => this.hand.begin(grip, at, click));
    if (axis) return axis;
    const { viewport } = this.wb;
    const ring = this.ringUnder(at, () => viewport.pointing.pick(at.clientX, at.clientY)?.joint !== undefined);
    const selected = selectedJoint(this.wb);
    if (ring && selected) return this.turn(ring.id, selected, at);
    // Shift selects, and pans.
    if (at.shiftKey) return undefined;
    const pin = pinUnder(this.wb, at);
    if (pin) {
      const { character, placement } = pin;
      const { id, joint, point } = pin.pin;
      return this.hand.begin({ characterId: character.id, placement, joint, point, pin: id }, at, () => {
        if (addsToSelection(this.wb, at)) selectHit(this.wb, { characterId: character.id, placement, joint }, true);
        else if (at.button === 0) unpinByHand(this.wb, { characterId: character.id, pin: id });
      });
    }
    if (at.button !== 0) return undefined;
    const seen = pointUnder(this.wb, at);
    if (!seen) return undefined;
    const { characterId, placement, joint } = seen;
    const grip = { characterId, placement, joint, point: heldPoint(this.wb, seen) };
    return this.hand.begin(grip, at, () => {
      if (addsToSelection(this.wb, at)) selectHit(this.wb, { characterId, placement, joint }, true);
      else this.pin(seen);
    });
  }

  click(at: CanvasPointer): boolean {
    const pin = pinUnder(this.wb, at);
    if (pin && at.shiftKey) {
      selectPin(this.wb, { characterId: pin.character.id, pin: pin.pin.id }, pin.pin.joint, pin.placement);
      return true;
    }
    // On the ground, or with Shift on a joint: pick.
    this.wb.posing.ik.selected.set(undefined);
    return false;
  }

  menu(at: CanvasPointer): boolean {
    const pin = pinUnder(this.wb, at);
    if (pin) selectPin(this.wb, { characterId: pin.character.id, pin: pin.pin.id }, pin.pin.joint, pin.placement);
    return pin !== undefined;
  }

  hover(at: CanvasPointer | undefined): string | undefined {
    const { hand } = this;
    const { point } = hand;
    if (this.axes.hover(at) || (at && isOnGoal(this.wb, at))) {
      hand.show(undefined, undefined);
      return 'grab';
    }
    const pin = at && pinUnder(this.wb, at);
    const ring = at && this.ringUnder(at, () => this.wb.viewport.pointing.hovered?.joint !== undefined);
    this.rings.light(ring?.id, at);
    if (ring) {
      hand.show(undefined, undefined);
      // "grab" claims the pointer: a ring that yields must leave the viewport looking for joints.
      return ring.yields || ring.isAtPivot ? 'move' : 'grab';
    }
    hand.show(pin, pin || !at ? undefined : point);
    if (pin) return 'grab';
    if (at && at.pointerType !== 'touch') hand.lookSoon(at);
    return hand.point ? 'pointer' : undefined;
  }

  /**
   * The ring that a press would grab: pins come first, and joints where the ring is only near, or passes the pivot seen
   * from its edge.
   * @param isOnJoint asked only if needed
   */
  private ringUnder(at: CanvasPointer, isOnJoint: () => boolean): HandleHit | undefined {
    if (at.button > 0 || at.altKey) return undefined;
    const ring = this.rings.at(at);
    if (!ring || pinUnder(this.wb, at)) return undefined;
    return (ring.yields || ring.isAtPivot) && isOnJoint() ? undefined : ring;
  }

  private turn(ring: HandleId, selected: ResolvedJoint, at: CanvasPointer): CanvasDrag {
    this.hand.show(undefined, undefined);
    this.wb.posing.ik.hasDragged.set(true);
    return this.rings.dragHandle(ring, selected, at);
  }

  /** Pins a natural point, the picked vertex, or the joint's default point. */
  private pin({ characterId, joint, natural, vertex, point }: SeenPoint): void {
    const { wb } = this;
    const character = findCharacter(wb.store.document, characterId);
    if (!character?.skeleton) return;
    const meant =
      natural?.point ??
      (vertex === undefined ? defaultPinPoint(character.skeleton, joint, shownSkin(character)).point : point);
    const there = pinnedAt(character, joint, meant);
    if (there === undefined) pinAt(wb, characterId, joint, meant);
    else unpinByHand(wb, { characterId, pin: there });
  }
}

/** IK drags points: of the gizmo only the rings are left, without the ball, which would cover the joint. */
const ringsOnly = perObject((handles: JointHandles): JointHandles => {
  return { ...handles, handles: handles.handles.filter(({ kind }) => kind === 'turn'), freeTurn: undefined };
});

/** The pin at that point, if any. */
function pinnedAt(character: Character, joint: number, point: readonly number[]): number | undefined {
  return ikOf(character).pins.find((pin) => pin.joint === joint && pin.point.every((part, k) => part === point[k]))?.id;
}
