/**
 * The rig tool: joints are handles. A click selects one, a drag moves it; arrows move it along axes, handles on its
 * box's faces resize that. While adding joints, a click on the ground, or on the skin inside it, adds a child to the
 * selected joint and selects it, so that the next click continues the chain; a click on a joint starts a branch.
 */
import { addJoint } from '../../../edit/commands/rig.ts';
import type { Selection } from '../../../model/session.ts';
import { isInsideQuick } from '../../../view/picking/inside-skin.ts';
import { RigOverlay } from '../../../view/rig/rig-overlay.ts';
import type { RigPart } from '../../../view/rig/rig-screen.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { activateJoint, addsToSelection, reselect, selectHit } from '../../state/joints/select-joints.ts';
import { selectedJoint, selectedJoints } from '../../state/joints/selected-joint.ts';
import { pausePlayback } from '../../state/pause-playback.ts';
import type { Workbench } from '../../state/workbench.ts';
import { isTextField } from '../../widgets/focus/focus.ts';
import { type BegunDrag, type CanvasDrag, type CanvasPointer, CLICK_PIXELS } from '../viewport/canvas-tools.ts';
import type { ModeTool } from '../viewport/mode-tool.ts';
import { rigControls } from './bar-controls.ts';
import { dragFace } from './box-drag.ts';
import { placeForChild } from './clicked-places.ts';
import { partAt } from './hits.ts';
import { dragAlong, dragFreely } from './joint-drags.ts';
import { jointOfOtherCopy } from './other-copies.ts';
import { startSkeletonAt } from './rig-edits.ts';
import { type Rigged, riggedNow } from './rigged.ts';
import { rigging } from './rigging-args.ts';

export function rigTool(wb: Workbench): ModeTool {
  return new RigTool(wb);
}

class RigTool implements ModeTool {
  private overlay: RigOverlay | undefined;
  private listening: AbortController | undefined;
  /** Where the pointer was last seen. */
  private pointer: CanvasPointer | undefined;
  private controls: HTMLElement | undefined;
  private isDragging = false;

  constructor(private readonly wb: Workbench) {}

  enter(): void {
    const { wb } = this;
    const { store, viewport } = wb;
    const { rig, controls } = wb.posing;
    this.overlay = new RigOverlay();
    const show = () => this.show();
    const stops = [
      viewport.addOverlay(this.overlay),
      store.subscribe((now, before) => {
        if (now !== before) show();
      }),
      rig.adding.subscribe(show),
      rig.axes.subscribe(show),
    ];
    this.listening = new AbortController();
    const { signal } = this.listening;
    signal.addEventListener('abort', () => {
      for (const stop of stops) stop();
    });
    for (const type of ['keydown', 'keyup'] as const) {
      window.addEventListener(type, (event) => this.key(event), { capture: true, signal });
    }
    this.controls ??= rigControls(wb);
    controls.set(this.controls);
    show();
  }

  leave(): void {
    const { mode, rig, controls } = this.wb.posing;
    this.listening?.abort();
    this.listening = this.overlay = this.pointer = undefined;
    this.isDragging = false;
    // The rig tool may be entered again, as on startup.
    if (mode.get() !== 'rig') rig.adding.set(false);
    rig.readout.set('');
    controls.set(undefined);
  }

  press(at: CanvasPointer): CanvasDrag | undefined {
    if (at.button !== 0 && at.button !== 2) return undefined;
    const { wb } = this;
    const part = this.partUnder(at);
    const byRight = at.button === 2;
    const character = currentCharacter(wb);
    // While adding joints, presses mean positions, whatever is near.
    const other = part || !character || this.wantsJoint(at) ? undefined : jointOfOtherCopy(wb, character, at);
    if (other) {
      const { joint, placement } = other;
      return this.onceMoved(at, {
        take: () => this.activate(joint, placement),
        start: (rigged) => dragFreely(wb, rigged, joint, at),
        clicked: (now) => this.select(now, joint, placement),
      });
    }
    if (!part || (byRight && part.kind !== 'joint')) return undefined;
    const joint = part.kind === 'joint' ? part.joint : selectedJoint(wb)?.joint;
    if (joint === undefined || part.kind === 'bone') return undefined;
    return this.onceMoved(at, {
      take: () => this.activate(joint),
      start: (rigged) => {
        if (part.kind === 'joint') return dragFreely(wb, rigged, joint, at);
        if (part.kind === 'arrow') return dragAlong(wb, rigged, joint, part.axis, at);
        return dragFace(wb, rigged, joint, part, at);
      },
      // Arrows and faces react to drags only: clicks pass through.
      clicked: (now) => {
        if (part.kind === 'joint') this.select(now, joint);
        else if (this.wantsJoint(now)) this.addAt(now);
      },
    });
  }

  click(at: CanvasPointer): boolean {
    const { wb } = this;
    const { store } = wb;
    if (this.wantsJoint(at)) {
      this.addAt(at);
      return true;
    }
    const part = this.partUnder(at);
    if (part?.kind === 'bone') {
      this.select(at, part.joint);
      return true;
    }
    const hit = wb.viewport.pointing.pick(at.clientX, at.clientY);
    const current = currentCharacter(wb);
    const adds = addsToSelection(wb, at);
    if (hit?.joint !== undefined) {
      const { characterId, placement, joint } = hit;
      selectHit(wb, { characterId, placement, joint }, adds);
    }
    // Under its name.
    else if (hit && !adds) store.select({ characterId: hit.characterId, placement: hit.placement });
    // Keeps the character selected.
    else if (current && !adds) store.select({ characterId: current.id });
    return true;
  }

  menu(at: CanvasPointer): boolean {
    const part = this.partUnder(at);
    if (part?.kind === 'joint' || part?.kind === 'bone') this.activate(part.joint);
    // Arrows and faces are the selected joint's.
    return part !== undefined;
  }

  hover(at: CanvasPointer | undefined): string | undefined {
    const { wb } = this;
    this.pointer = at;
    const part = at && this.partUnder(at);
    const isLit = this.overlay?.light(part) ?? false;
    const adds = at !== undefined && this.wantsJoint(at);
    if (isLit && currentCharacter(wb)) {
      const joint = part?.kind === 'joint' || part?.kind === 'bone' ? part.joint : undefined;
      wb.viewport.pointing.hover(joint === undefined ? undefined : this.pickOf(joint));
    }
    this.showGhost();
    if (isLit || wb.posing.rig.adding.get() || adds) wb.viewport.requestRender();
    if (part) return part.kind === 'bone' ? 'pointer' : 'move';
    return adds ? 'crosshair' : undefined;
  }

  private show(): void {
    const { wb } = this;
    const { viewport } = wb;
    const { axes, adding } = wb.posing.rig;
    const character = currentCharacter(wb);
    const skeleton = character?.isHidden ? undefined : character?.skeleton;
    this.overlay?.show(
      skeleton &&
        character && {
          skeleton,
          world: () => viewport.character(character.id)?.worlds,
          dofs: () => viewport.character(character.id)?.dofs,
          placement: () => viewport.placementOf(character.id, viewport.pickedCopy(character)),
          selected: selectedJoint(wb)?.joint,
          others: selectedJoints(wb)?.joints.slice(0, -1) ?? [],
          axes: axes.get(),
          withArrows: !adding.get(),
        },
    );
    this.showGhost();
    viewport.requestRender();
  }

  private partUnder(at: CanvasPointer): RigPart | undefined {
    const screen = this.overlay?.screen;
    if (!screen) return undefined;
    const { left, top } = this.wb.viewport.canvas.getBoundingClientRect();
    const hand = { byTouch: at.pointerType === 'touch', isAdding: this.wb.posing.rig.adding.get() };
    return partAt(screen, at.clientX - left, at.clientY - top, hand);
  }

  /**
   * Preview of the joint that a click would add; none over a joint, which it would select, and of a skin too large to
   * be looked through as the pointer moves.
   */
  private showGhost(): void {
    const { wb, pointer } = this;
    const from = selectedJoint(wb)?.joint;
    const rigged = pointer && from !== undefined && this.wantsJoint(pointer) ? riggedNow(wb) : undefined;
    const place =
      pointer &&
      rigged &&
      from !== undefined &&
      this.partUnder(pointer)?.kind !== 'joint' &&
      isInsideQuick(wb.viewport, rigged.character.id)
        ? placeForChild(wb, rigged, from, pointer)
        : undefined;
    this.overlay?.showGhost(place && from !== undefined ? { from, at: place.scene } : undefined);
  }

  private wantsJoint(at: CanvasPointer): boolean {
    return this.wb.posing.rig.adding.get() || at.ctrlKey || at.metaKey;
  }

  /** @param copy index of the instance; default: the one with the handles */
  private pickOf(joint: number, copy?: number) {
    const character = currentCharacter(this.wb);
    return character && { characterId: character.id, placement: copy ?? this.wb.viewport.pickedCopy(character), joint };
  }

  /** A click. */
  private select(at: CanvasPointer, joint: number, copy?: number): void {
    const pick = this.pickOf(joint, copy);
    // The right button's menu selects itself.
    if (pick && at.button !== 2) selectHit(this.wb, pick, addsToSelection(this.wb, at));
  }

  /** Before a drag. */
  private activate(joint: number, copy?: number): void {
    const pick = this.pickOf(joint, copy);
    if (!pick) return;
    if (selectedJoint(this.wb)?.joint === joint && pick.placement === this.pickOf(joint)?.placement) return;
    activateJoint(this.wb, pick);
  }

  private addAt(at: CanvasPointer): void {
    const { wb } = this;
    const parent = selectedJoint(wb)?.joint;
    pausePlayback(wb);
    const rigged = riggedNow(wb);
    const refuse = (why: string) => wb.messages.note(why, 'warning');
    if (!rigged && currentCharacter(wb)?.skeleton) refuse('The character is hidden. Show it first.');
    else if (!rigged) startSkeletonAt(wb, at);
    else if (parent === undefined) wb.messages.note('Select the parent of the new joint first.');
    else {
      const offset = placeForChild(wb, rigged, parent, at)?.offset;
      if (!offset) refuse('That joint is scaled to zero, so nothing can be placed under it.');
      else attempt(wb.messages, () => wb.store.apply(addJoint, { ...rigging(wb, rigged.character), parent, offset }));
    }
  }

  /** Nothing happens until the pointer moves: until then it is a click. */
  private onceMoved(at: CanvasPointer, { take, start, clicked }: Press): CanvasDrag {
    const { wb } = this;
    let drag: BegunDrag | undefined;
    let given = false;
    /** Once the drag has begun. */
    let before: Selection | undefined;
    this.isDragging = true;
    return {
      get hasBegun() {
        return given;
      },
      move: (now) => {
        if (!given && Math.hypot(now.clientX - at.clientX, now.clientY - at.clientY) <= CLICK_PIXELS) return;
        if (!given) {
          given = true;
          pausePlayback(wb);
          before = wb.store.selection;
          take();
          const rigged = riggedNow(wb);
          drag = rigged && start(rigged);
        }
        drag?.move(now);
      },
      end: (now) => {
        this.isDragging = false;
        if (given) drag?.end(now);
        else clicked(now);
      },
      cancel: () => {
        this.isDragging = false;
        drag?.cancel();
        if (before) reselect(wb, before);
      },
    };
  }

  /** Escape ends adding; a running drag handles its own Escape first. */
  private key(event: KeyboardEvent): void {
    const { adding } = this.wb.posing.rig;
    if (event.key === 'Control' || event.key === 'Meta' || event.key === 'Shift') this.followKeys(event);
    if (event.type !== 'keydown' || event.key !== 'Escape' || !adding.get() || this.isDragging) return;
    const target = event.target instanceof Element ? event.target : document.body;
    if (isTextField(target) || target.closest('[role=menu],dialog') || this.wb.dialog.get()) return;
    event.preventDefault();
    event.stopPropagation();
    adding.set(false);
  }

  /** With Ctrl a click would add, with Shift off the grid: show the preview before the pointer moves. */
  private followKeys({ ctrlKey, metaKey, shiftKey }: KeyboardEvent): void {
    if (!this.pointer) return;
    const { clientX, clientY, button, altKey, pointerType } = this.pointer;
    this.pointer = { clientX, clientY, button, altKey, shiftKey, pointerType, ctrlKey, metaKey };
    this.showGhost();
    this.wb.viewport.requestRender();
  }
}

/** What becomes of a press. */
interface Press {
  /** Before the drag: selects what is dragged. */
  take(): void;
  start(rigged: Rigged): BegunDrag;
  clicked(at: CanvasPointer): void;
}
