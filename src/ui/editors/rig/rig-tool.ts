/**
 * The rig tool: joints are handles. A click selects one, a drag moves it; arrows move it along axes, handles on its
 * box's faces resize that. While adding joints, a click on the ground, or on the skin inside it, adds a child to the
 * selected joint and selects it, so that the next click continues the chain; a click on a joint starts a branch.
 */
import { addJoint } from '../../../edit/commands/rig.ts';
import type { Vec3 } from '../../../math/vec3.ts';
import type { Character } from '../../../model/document.ts';
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
  const { store, viewport } = wb;
  const state = wb.posing.rig;
  let overlay: RigOverlay | undefined;
  let stops: (() => void)[] = [];
  let pointer: CanvasPointer | undefined;
  let controls: HTMLElement | undefined;
  let isDragging = false;

  const show = () => {
    const character = currentCharacter(wb);
    const skeleton = character?.isHidden ? undefined : character?.skeleton;
    overlay?.show(
      skeleton &&
        character && {
          skeleton,
          world: () => viewport.character(character.id)?.worlds,
          placement: () => viewport.placementOf(character.id, viewport.pickedCopy(character)),
          selected: selectedJoint(wb)?.joint,
          others: selectedJoints(wb)?.joints.slice(0, -1) ?? [],
          axes: state.axes.get(),
          withArrows: !state.adding.get(),
        },
    );
    showGhost();
    viewport.requestRender();
  };

  const partUnder = (at: CanvasPointer): RigPart | undefined => {
    const screen = overlay?.screen;
    if (!screen) return undefined;
    const { left, top } = viewport.canvas.getBoundingClientRect();
    const hand = { byTouch: at.pointerType === 'touch', isAdding: state.adding.get() };
    return partAt(screen, at.clientX - left, at.clientY - top, hand);
  };

  /**
   * Preview of the joint that a click would add; none over a joint, which it would select, and of a skin too large to be
   * looked through as the pointer moves.
   */
  const showGhost = () => {
    const parent = selectedJoint(wb)?.joint;
    const rigged = pointer && parent !== undefined && wantsJoint(pointer) ? riggedNow(wb) : undefined;
    const place =
      pointer &&
      rigged &&
      parent !== undefined &&
      partUnder(pointer)?.kind !== 'joint' &&
      isInsideQuick(viewport, rigged.character.id)
        ? placeForChild(wb, rigged, parent, pointer)
        : undefined;
    overlay?.showGhost(place && parent !== undefined ? { from: parent, at: place.scene } : undefined);
  };
  const wantsJoint = (at: CanvasPointer) => state.adding.get() || at.ctrlKey || at.metaKey;

  /** @param copy index of the instance; default: the one with the handles */
  const pickOf = (joint: number, copy?: number) => {
    const character = currentCharacter(wb);
    return character && { characterId: character.id, placement: copy ?? viewport.pickedCopy(character), joint };
  };
  /** A click. */
  const select = (at: CanvasPointer, joint: number, copy?: number) => {
    const pick = pickOf(joint, copy);
    // The right button's menu selects itself.
    if (pick && at.button !== 2) selectHit(wb, pick, addsToSelection(wb, at));
  };
  /** Before a drag. */
  const activate = (joint: number, copy?: number) => {
    const pick = pickOf(joint, copy);
    const character = currentCharacter(wb);
    if (!pick || !character) return;
    if (selectedJoint(wb)?.joint === joint && pick.placement === viewport.pickedCopy(character)) return;
    activateJoint(wb, pick);
  };

  const addAt = (at: CanvasPointer): void => {
    const parent = selectedJoint(wb)?.joint;
    pausePlayback(wb);
    const rigged = riggedNow(wb);
    const refuse = (why: string) => wb.messages.note(why, 'warning');
    if (!rigged && currentCharacter(wb)?.skeleton) refuse('The character is hidden. Show it first.');
    else if (!rigged) startSkeletonAt(wb, at);
    else if (parent === undefined) wb.messages.note('Select the parent of the new joint first.');
    else {
      const place = placeForChild(wb, rigged, parent, at);
      if (!place) refuse('That joint is scaled to zero, so nothing can be placed under it.');
      else addTo(rigged.character, parent, place.offset);
    }
  };
  const addTo = (character: Character, parent: number, offset: Vec3) => {
    attempt(wb.messages, () => store.apply(addJoint, { ...rigging(wb, character), parent, offset }));
  };

  /** Nothing happens until the pointer moves: until then it is a click. */
  const onceMoved = (
    at: CanvasPointer,
    take: () => void,
    start: () => BegunDrag | undefined,
    clicked: (at: CanvasPointer) => void,
  ): CanvasDrag => {
    let drag: BegunDrag | undefined;
    let given = false;
    /** Once the drag has begun. */
    let before: Selection | undefined;
    isDragging = true;
    return {
      get hasBegun() {
        return given;
      },
      move(now) {
        if (!given && Math.hypot(now.clientX - at.clientX, now.clientY - at.clientY) <= CLICK_PIXELS) return;
        if (!given) {
          given = true;
          pausePlayback(wb);
          before = store.selection;
          take();
          drag = start();
        }
        drag?.move(now);
      },
      end(now) {
        isDragging = false;
        if (given) drag?.end(now);
        else clicked(now);
      },
      cancel() {
        isDragging = false;
        drag?.cancel();
        if (before) reselect(wb, before);
      },
    };
  };

  /** Escape ends adding; a running drag handles its own Escape first. */
  const onKey = (event: KeyboardEvent) => {
    if (event.key === 'Control' || event.key === 'Meta' || event.key === 'Shift') followKeys(event);
    if (event.type !== 'keydown' || event.key !== 'Escape' || !state.adding.get() || isDragging) return;
    const target = event.target instanceof Element ? event.target : document.body;
    if (isTextField(target) || target.closest('[role=menu],dialog') || wb.dialog.get()) return;
    event.preventDefault();
    event.stopPropagation();
    state.adding.set(false);
  };
  /** With Ctrl a click would add, with Shift off the grid: show the preview before the pointer moves. */
  const followKeys = ({ ctrlKey, metaKey, shiftKey }: KeyboardEvent) => {
    if (!pointer) return;
    const { clientX, clientY, button, altKey, pointerType } = pointer;
    pointer = { clientX, clientY, button, altKey, shiftKey, pointerType, ctrlKey, metaKey };
    showGhost();
    viewport.requestRender();
  };

  return {
    press(at) {
      if (at.button !== 0 && at.button !== 2) return undefined;
      const part = partUnder(at);
      const byRight = at.button === 2;
      const selected = selectedJoint(wb)?.joint;
      const character = currentCharacter(wb);
      // While adding joints, presses mean positions, whatever is near.
      const other = part || !character || wantsJoint(at) ? undefined : jointOfOtherCopy(wb, character, at);
      const dragNow = (start: (rigged: Rigged) => BegunDrag) => {
        const rigged = riggedNow(wb);
        return rigged && start(rigged);
      };
      if (other) {
        return onceMoved(
          at,
          () => activate(other.joint, other.placement),
          () => dragNow((rigged) => dragFreely(wb, rigged, other.joint, at)),
          (now) => select(now, other.joint, other.placement),
        );
      }
      if (!part || (byRight && part.kind !== 'joint')) return undefined;
      const drag = (joint: number, start: (rigged: Rigged) => BegunDrag) =>
        onceMoved(
          at,
          () => activate(joint),
          () => dragNow(start),
          // Arrows and faces react to drags only: clicks pass through.
          (now) => {
            if (part.kind === 'joint') select(now, joint);
            else if (wantsJoint(now)) addAt(now);
          },
        );
      switch (part.kind) {
        case 'joint':
          return drag(part.joint, (rigged) => dragFreely(wb, rigged, part.joint, at));
        case 'arrow':
          return selected === undefined
            ? undefined
            : drag(selected, (rigged) => dragAlong(wb, rigged, selected, part.axis, at));
        case 'face':
          return selected === undefined
            ? undefined
            : drag(selected, (rigged) => dragFace(wb, rigged, selected, part, at));
        case 'bone':
          return undefined;
      }
    },
    click(at) {
      if (wantsJoint(at)) {
        addAt(at);
        return true;
      }
      const part = partUnder(at);
      if (part?.kind === 'bone') {
        select(at, part.joint);
        return true;
      }
      const hit = viewport.pick(at.clientX, at.clientY);
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
    },
    menu(at) {
      const part = partUnder(at);
      if (part?.kind === 'joint' || part?.kind === 'bone') activate(part.joint);
      // Arrows and faces are the selected joint's.
      return part !== undefined;
    },
    hover(at) {
      pointer = at;
      const part = at && partUnder(at);
      const isLit = overlay?.light(part) ?? false;
      const character = currentCharacter(wb);
      const adds = at !== undefined && wantsJoint(at);
      if (isLit && character) {
        const joint = part?.kind === 'joint' || part?.kind === 'bone' ? part.joint : undefined;
        viewport.hover(
          joint === undefined
            ? undefined
            : { characterId: character.id, placement: viewport.pickedCopy(character), joint },
        );
      }
      showGhost();
      if (isLit || state.adding.get() || adds) viewport.requestRender();
      if (part) return part.kind === 'bone' ? 'pointer' : 'move';
      return adds ? 'crosshair' : undefined;
    },
    enter() {
      overlay = new RigOverlay();
      stops = [
        viewport.addOverlay(overlay),
        store.subscribe((now, before) => {
          if (now !== before) show();
        }),
        state.adding.subscribe(show),
        state.axes.subscribe(show),
      ];
      window.addEventListener('keydown', onKey, true);
      window.addEventListener('keyup', onKey, true);
      controls ??= rigControls(wb);
      wb.posing.controls.set(controls);
      show();
    },
    leave() {
      for (const stop of stops) stop();
      stops = [];
      overlay = undefined;
      pointer = undefined;
      isDragging = false;
      window.removeEventListener('keydown', onKey, true);
      window.removeEventListener('keyup', onKey, true);
      // The rig tool may be entered again, as on startup.
      if (wb.posing.mode.get() !== 'rig') state.adding.set(false);
      state.readout.set('');
      wb.posing.controls.set(undefined);
    },
  };
}
