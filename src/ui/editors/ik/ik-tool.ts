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
 */
import type { HandleId, JointHandles } from '../../../evaluate/handles/joint-handles.ts';
import { defaultPinPoint } from '../../../evaluate/ik/pin-points.ts';
import { ikOf } from '../../../evaluate/ik/set-up.ts';
import { type Character, findCharacter, shownSkin } from '../../../model/document.ts';
import { perObject } from '../../../model/per-object.ts';
import type { HandleHit } from '../../../view/gizmo/handle-at.ts';
import { PinOverlay } from '../../../view/pins/pin-overlay.ts';
import { Readout } from '../../kit/readout.ts';
import { addsToSelection, selectHit } from '../../state/select-joints.ts';
import { type ResolvedJoint, selectedJoint } from '../../state/selected-joint.ts';
import type { Workbench } from '../../state/workbench.ts';
import { SelectedGizmo } from '../fk/selected-gizmo.ts';
import type { CanvasDrag, CanvasPointer } from '../viewport/canvas-tools.ts';
import type { ModeTool } from '../viewport/mode-tool.ts';
import { depthText } from './depth-text.ts';
import type { IkGrip } from './hand-pull.ts';
import { ikControls } from './ik-controls.ts';
import { IkLabels } from './ik-labels.ts';
import { PinDrag } from './pin-drag.ts';
import { pinAt, selectPin, unpinByHand } from './pin-edits.ts';
import { PinNudge } from './pin-nudge.ts';
import { type HandNow, paintPins } from './pin-picture.ts';
import { besidePins } from './pins-beside.ts';
import { pinsInPicture, pinUnder, pointUnder, type SeenPin, type SeenPoint } from './pins-on-screen.ts';
import { whatMoves } from './reach.ts';
import { deselectLostPin } from './selected-pin.ts';

/** With more triangles than this, hover picking would be slow: points are then highlighted on press only. */
const HOVER_TRIANGLES = 300_000;

export function ikTool(wb: Workbench): ModeTool {
  return new IkTool(wb);
}

class IkTool implements ModeTool {
  private drag: PinDrag | undefined;
  private readonly nudge: PinNudge;
  private readonly rings: SelectedGizmo;
  private hoveredPin: SeenPin | undefined;
  private hoveredPoint: SeenPoint | undefined;
  /** Pointer position to be looked up in the next frame. */
  private looking: CanvasPointer | undefined;
  private frame = 0;
  private readonly labels: IkLabels;
  private controls: HTMLElement | undefined;
  private readout: Readout | undefined;
  private stops: (() => void)[] = [];

  constructor(private readonly wb: Workbench) {
    this.nudge = new PinNudge(wb);
    this.rings = new SelectedGizmo(wb, { only: ringsOnly });
    this.labels = new IkLabels(wb);
  }

  enter(): void {
    const { wb, labels } = this;
    const overlay = new PinOverlay((painter) => {
      const shown = paintPins(wb, painter, this.now);
      labels.show(shown, shown.length ? pinsInPicture(wb).places : []);
    });
    const { selected, pointedAt, targets } = wb.posing.ik;
    labels.enter();
    this.rings.enter();
    this.readout = new Readout(wb.viewportElement);
    this.controls ??= ikControls(wb);
    wb.posing.controls.set(this.controls);
    wb.posing.beside = (id, dofs) => besidePins(wb, id, dofs);
    wb.posing.ik.whatMoves = (id, joint) => whatMoves(wb, id, joint);
    // Another joint may have been selected in another mode.
    deselectLostPin(wb, true);
    const redraw = () => wb.viewport.requestRender();
    const listening = new AbortController();
    const { canvas } = wb.viewport;
    canvas.addEventListener('keydown', (event) => this.nudge.key(event), { signal: listening.signal });
    canvas.addEventListener('blur', () => this.nudge.finish(), { signal: listening.signal });
    this.stops = [
      wb.viewport.addOverlay(overlay),
      selected.subscribe(redraw),
      pointedAt.subscribe(redraw),
      wb.store.subscribe((now, before) => {
        const isAnother = now.selection !== before.selection;
        if (now.document.characters === before.document.characters && !isAnother) return;
        deselectLostPin(wb, isAnother);
        targets.keepOnly(new Set(now.document.characters.map(({ id }) => id)));
        this.forgetGone();
      }),
      () => listening.abort(),
    ];
  }

  leave(): void {
    const { wb, labels } = this;
    this.nudge.finish();
    this.hover(undefined);
    for (const stop of this.stops) stop();
    this.stops = [];
    labels.leave();
    this.rings.leave();
    this.readout?.remove();
    this.readout = undefined;
    wb.posing.controls.set(undefined);
    wb.posing.beside = undefined;
    wb.posing.ik.whatMoves = undefined;
  }

  press(at: CanvasPointer): CanvasDrag | undefined {
    this.nudge.finish();
    const { viewport } = this.wb;
    const ring = this.ringUnder(at, () => viewport.pick(at.clientX, at.clientY)?.joint !== undefined);
    const selected = selectedJoint(this.wb);
    if (ring && selected) return this.turn(ring.id, selected, at);
    // Shift selects, and pans.
    if (at.shiftKey) return undefined;
    const pin = pinUnder(this.wb, at);
    if (pin) {
      const { character, placement } = pin;
      const { id, joint, point } = pin.pin;
      return this.begin({ characterId: character.id, placement, joint, point, pin: id }, at, () => {
        if (addsToSelection(this.wb, at)) selectHit(this.wb, { characterId: character.id, placement, joint }, true);
        else if (at.button === 0) unpinByHand(this.wb, { characterId: character.id, pin: id });
      });
    }
    if (at.button !== 0) return undefined;
    const seen = pointUnder(this.wb, at);
    if (!seen) return undefined;
    const { characterId, placement, joint, natural } = seen;
    const grip = { characterId, placement, joint, point: natural?.point ?? seen.point };
    return this.begin(grip, at, () => {
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
    this.looking = undefined;
    const pin = at && pinUnder(this.wb, at);
    const ring = at && this.ringUnder(at, () => this.wb.viewport.hovered?.joint !== undefined);
    this.rings.light(ring?.id, at);
    if (ring) {
      this.show(undefined, undefined);
      // "grab" claims the pointer: a ring that yields must leave the viewport looking for joints.
      return ring.yields || ring.isAtPivot ? 'move' : 'grab';
    }
    this.show(pin, pin || !at ? undefined : this.hoveredPoint);
    if (pin) return 'grab';
    if (at && at.pointerType !== 'touch') this.lookSoon(at);
    return this.hoveredPoint ? 'pointer' : undefined;
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
    this.show(undefined, undefined);
    this.looking = undefined;
    this.wb.posing.ik.hasDragged.set(true);
    return this.rings.dragHandle(ring, selected, at);
  }

  private begin(grip: IkGrip, at: CanvasPointer, click: () => void): PinDrag {
    this.show(undefined, undefined);
    this.looking = undefined;
    const drag = new PinDrag(this.wb, grip, at, {
      click,
      longPress: () => {
        const { characterId, placement, joint, pin } = grip;
        if (pin === undefined) this.wb.store.select({ characterId, placement, joint });
        else selectPin(this.wb, { characterId, pin }, joint, placement);
      },
      over: () => {
        this.drag = undefined;
        this.readout?.hide();
        this.labels.say(this.labelOfGap());
        this.wb.viewport.canvas.style.cursor = '';
        this.wb.viewport.requestRender();
      },
      began: () => {
        this.wb.viewport.canvas.style.cursor = 'grabbing';
      },
      moved: (depth, now) => this.showDepth(grip.characterId, depth, now),
    });
    this.drag = drag;
    return drag;
  }

  /** Motion along the line of sight isn't visible: show it as a number. */
  private showDepth(characterId: string, depth: number | undefined, { clientX, clientY }: CanvasPointer): void {
    const character = findCharacter(this.wb.store.document, characterId);
    if (depth === undefined || !character) this.readout?.hide();
    else this.readout?.show(clientX, clientY, depthText(character, depth));
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

  /** Finding what is under the pointer takes a render: at most one per frame. */
  private lookSoon(at: CanvasPointer): void {
    this.looking = at;
    if (this.frame) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      const { looking, wb } = this;
      this.looking = undefined;
      if (!looking || this.drag || wb.viewport.stats().triangles > HOVER_TRIANGLES) return;
      this.show(undefined, pointUnder(wb, looking));
      wb.viewport.canvas.style.cursor = this.hoveredPoint ? 'pointer' : '';
    });
  }

  private show(pin: SeenPin | undefined, point: SeenPoint | undefined): void {
    if (
      pin?.pin === this.hoveredPin?.pin &&
      pin?.placement === this.hoveredPin?.placement &&
      point === this.hoveredPoint
    )
      return;
    this.hoveredPin = pin;
    this.hoveredPoint = point;
    this.wb.viewport.requestRender();
  }

  private forgetGone(): void {
    const { document } = this.wb.store;
    const { hoveredPin, hoveredPoint } = this;
    const isThere = (id: string | undefined) => findCharacter(document, id) !== undefined;
    const pins = hoveredPin && findCharacter(document, hoveredPin.character.id)?.ik?.pins;
    const keepsPin = hoveredPin && pins?.includes(hoveredPin.pin);
    this.show(keepsPin ? hoveredPin : undefined, isThere(hoveredPoint?.characterId) ? hoveredPoint : undefined);
  }

  private labelOfGap(): string {
    const labels: string[] = [];
    paintPins(this.wb, { mark() {}, line() {} }, this.now).forEach(({ kind, text }) => {
      if (kind === 'gap') labels.push(text);
    });
    return labels.join('. ');
  }

  private get now(): HandNow {
    const { hoveredPin, hoveredPoint } = this;
    return { pull: this.drag?.state ?? this.nudge.state, hoveredPin, hoveredPoint };
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
