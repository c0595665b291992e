/**
 * The FK tool. What a press grabs, in this order:
 *
 *     a handle of the gizmo       its DOF, which becomes active
 *     a bone, or skin around it   its joint, which is selected; dragged up and down: the active DOF
 *     the ball within the rings   rotates the selected joint freely
 *     anything else               the camera
 */
import { type HandleId, type JointHandles, sameHandle } from '../../../evaluate/handles/joint-handles.ts';
import { findCharacter } from '../../../model/document.ts';
import { characterDofs } from '../../../model/dofs.ts';
import type { Selection } from '../../../model/session.ts';
import type { DraggedHandle } from '../../../view/gizmo/gizmo-look.ts';
import type { HandleHit } from '../../../view/gizmo/handle-at.ts';
import { JointGizmo } from '../../../view/gizmo/joint-gizmo.ts';
import type { Hit } from '../../../view/viewport.ts';
import { Readout } from '../../kit/readout.ts';
import { type ResolvedJoint, resolvedJoint, selectedJoint } from '../../state/selected-joint.ts';
import type { Workbench } from '../../state/workbench.ts';
import { activeDof, chooseDof, shownDofs } from '../posing/active-dof.ts';
import { type CanvasDrag, type CanvasPointer, CLICK_PIXELS } from '../viewport/canvas-tools.ts';
import type { ModeTool } from '../viewport/mode-tool.ts';
import { dofButtons } from './dof-buttons.ts';
import { grabOf, type UnderPointer } from './grab.ts';
import { type DraggedJoint, handDrag } from './hand-drag.ts';
import { KnownHandles } from './known-handles.ts';
import { boneMover, type DragResult, type FkGrip, handleMover, handlesOf, type Mover } from './movers.ts';
import { dofValueText, limitNote } from './readout-text.ts';

/** Extra hit tolerance for touch; CSS pixels. */
const FINGER = 10;
/** On a handle a drag starts sooner than elsewhere, where a click may be meant to pick. */
const HANDLE_THRESHOLD = 2;

export function fkTool(wb: Workbench): ModeTool {
  return new FkTool(wb);
}

class FkTool implements ModeTool {
  private gizmo: JointGizmo | undefined;
  private readonly known = new KnownHandles();
  private removeGizmo: (() => void) | undefined;
  private readout: Readout | undefined;
  private listening: AbortController | undefined;
  private hovered: HandleId | undefined;
  /** Where the pointer was last seen. */
  private over: CanvasPointer | undefined;
  private dragged: DraggedHandle | undefined;

  constructor(private readonly wb: Workbench) {}

  enter(): void {
    const { wb } = this;
    this.gizmo = new JointGizmo(wb.viewportElement, {
      handles: () => this.handles(),
      state: () => this.state(),
      scale: () => wb.settings.get().gizmoScale,
    });
    this.removeGizmo = wb.viewport.addOverlay(this.gizmo);
    this.readout = new Readout(wb.viewportElement);
    this.listening = new AbortController();
    const { signal } = this.listening;
    const stops = [
      wb.viewport.onHover(() => {
        if (this.over && !this.dragged) wb.viewport.canvas.style.cursor = this.light() ?? '';
      }),
      wb.posing.chosenDof.subscribe(() => wb.viewport.requestRender()),
      wb.settings.subscribe((now, before) => {
        if (now.gizmoScale !== before.gizmoScale) wb.viewport.requestRender();
      }),
      wb.store.subscribe((now, before) => {
        if (now.selection === before.selection) return;
        this.over = undefined;
        this.light();
      }),
    ];
    signal.addEventListener('abort', () => {
      for (const stop of stops) stop();
    });
    const { element, dispose } = dofButtons(wb);
    signal.addEventListener('abort', dispose);
    wb.posing.controls.set(element);
    // The DOF of the focused slider becomes active.
    document.addEventListener(
      'focusin',
      ({ target }) => {
        const row = target instanceof Element ? target.closest<HTMLElement>('[data-dof]') : null;
        if (row?.dataset.dof !== undefined) chooseDof(wb, Number(row.dataset.dof));
      },
      { signal },
    );
  }

  leave(): void {
    this.listening?.abort();
    this.wb.posing.controls.set(undefined);
    this.removeGizmo?.();
    this.readout?.remove();
    this.gizmo = this.removeGizmo = this.readout = this.listening = undefined;
    this.hovered = this.dragged = this.over = undefined;
  }

  press(at: CanvasPointer): CanvasDrag | undefined {
    const { wb } = this;
    if (at.button !== 0 || at.altKey) return undefined;
    const selected = selectedJoint(wb);
    const handle = selected && this.handleAt(at);
    let hit: Hit | undefined;
    const under = () => {
      hit = wb.viewport.pick(at.clientX, at.clientY);
      return this.whose(hit);
    };
    const grab = grabOf(handle, under, at);
    if (grab === 'bone' && hit) return this.dragBone(hit, at);
    if (!handle || !selected || !grab) return undefined;
    return grab === 'ball' ? this.dragBall(hit, selected, at) : this.dragHandle(handle.id, selected, at);
  }

  hover(at: CanvasPointer | undefined): string | undefined {
    this.over = at;
    return this.light();
  }

  /** Whose joint was hit. */
  private whose(hit: Pick<Hit, 'characterId' | 'joint'> | undefined): UnderPointer {
    const joint = hit && resolvedJoint(this.wb, hit.characterId, hit.joint);
    if (!joint) return undefined;
    const selected = selectedJoint(this.wb);
    return joint.joint === selected?.joint && joint.character === selected.character ? 'selected' : 'other';
  }

  private dragHandle(id: HandleId, { character, joint }: ResolvedJoint, at: CanvasPointer): CanvasDrag {
    if (id.kind === 'dof') chooseDof(this.wb, id.dof);
    return this.drag({ characterId: character.id, joint }, at, HANDLE_THRESHOLD, (grip) => handleMover(id, grip));
  }

  /** Selects the joint that was hit when the drag begins. */
  private dragBone(hit: Hit, at: CanvasPointer): CanvasDrag | undefined {
    const { wb } = this;
    const { characterId, placement, joint } = hit;
    if (joint === undefined) return undefined;
    const make = (grip: FkGrip) => boneMover(activeDof(wb), grip);
    return this.drag({ characterId, placement, joint }, at, CLICK_PIXELS, make, hit);
  }

  private dragBall(hit: Hit | undefined, { character, joint }: ResolvedJoint, at: CanvasPointer): CanvasDrag {
    const make = (grip: FkGrip) => handleMover({ kind: 'ball' }, grip);
    return this.drag({ characterId: character.id, joint }, at, CLICK_PIXELS, make, hit ?? 'nothing');
  }

  /**
   * @param joint the one to drag, at the placement that was hit
   * @param under what a click there would have picked, in case the press turns out to be one
   */
  private drag(
    joint: DraggedJoint & { readonly placement?: number },
    at: CanvasPointer,
    threshold: number,
    make: (grip: FkGrip) => Mover | undefined,
    under?: Hit | 'nothing',
  ): CanvasDrag {
    const { wb } = this;
    const { characterId } = joint;
    /** The selection that the drag has replaced. */
    let before: Selection | undefined;
    wb.viewport.canvas.style.cursor = 'grabbing';
    return handDrag(wb, joint, at, threshold, {
      begin: () => {
        before = this.selectDragged(joint);
        const grip = this.gripAt(at);
        return grip && make(grip);
      },
      moved: (moved, now) => this.show(moved, now),
      ended: (now, wentNowhere) => {
        this.dragged = undefined;
        this.readout?.hide();
        wb.viewport.canvas.style.cursor = '';
        wb.viewport.requestRender();
        if (!now && before) this.reselect(before);
        if (now && wentNowhere && under) wb.store.select(under === 'nothing' ? { characterId } : under);
      },
    });
  }

  /** Selects the joint and the placement that are dragged; returns the selection before if that was another. */
  private selectDragged({
    characterId,
    placement,
    joint,
  }: DraggedJoint & { readonly placement?: number }): Selection | undefined {
    const { store, viewport } = this.wb;
    const { selection } = store;
    if (selection.characterId !== characterId || selection.joint !== joint) {
      store.select({ characterId, joint, ...(placement !== undefined && { placement }) });
      return selection;
    }
    const character = findCharacter(store.document, characterId);
    const isOther = character && placement !== undefined && placement !== viewport.pickedCopy(character);
    if (!isOther) return undefined;
    store.select({ ...selection, placement });
    return selection;
  }

  /** Restores a selection, as far as it still exists. */
  private reselect(before: Selection): void {
    const { store } = this.wb;
    const { characterId } = before;
    if (characterId === undefined || findCharacter(store.document, characterId)) store.select(before);
  }

  /** The current pose when a drag begins. */
  private gripAt(at: CanvasPointer): FkGrip | undefined {
    const { wb, gizmo } = this;
    const selected = selectedJoint(wb);
    const placed = selected && this.placementOf(selected);
    if (!selected || !placed || !gizmo) return undefined;
    const dofs = shownDofs(wb, selected.character);
    const placement = placed.slice();
    const radius = gizmo.radiusOf(handlesOf({ selected, dofs, placement }));
    return { selected, dofs, placement, sight: wb.viewport.eye, radius, at };
  }

  private show(moved: DragResult, at: CanvasPointer): void {
    const { wb } = this;
    this.dragged = moved.handle;
    wb.viewport.requestRender();
    const selected = selectedJoint(wb);
    if (!selected) return;
    const { character, skeleton } = selected;
    const { angles } = wb.settings.get();
    const all = characterDofs(skeleton, []);
    const values = shownDofs(wb, character);
    const isQuaternion = moved.dofs.some(({ index }) => all[index].name.startsWith('q'));
    const told = isQuaternion
      ? moved.turned === undefined
        ? []
        : [dofValueText({ name: 'turned', unit: 'angle' }, moved.turned, character, angles)]
      : moved.dofs.map(({ index }) => dofValueText(all[index], values[index], character, angles));
    const held = moved.stops.map(({ dof, limit }) => {
      const note = limitNote(all[dof], limit, character.clampsToLimits, character, angles);
      return moved.dofs.length > 1 ? `${all[dof].name} ${note}` : note;
    });
    if (told.length || held.length) this.readout?.show(at.clientX, at.clientY, told.join('  '), held.join(', '));
  }

  private showValue(dof: number, at: CanvasPointer): void {
    const selected = selectedJoint(this.wb);
    if (!selected) return;
    const { character, skeleton } = selected;
    const value = shownDofs(this.wb, character)[dof];
    const text = dofValueText(characterDofs(skeleton, [])[dof], value, character, this.wb.settings.get().angles);
    this.readout?.show(at.clientX, at.clientY, text);
  }

  private handleAt(at: CanvasPointer): HandleHit | undefined {
    return this.gizmo?.at(at.clientX, at.clientY, at.pointerType === 'touch' ? FINGER : 0);
  }

  /**
   * Lights up the handle that a press would grab, and returns the cursor. Joints are lit by the viewport, so it is
   * called again when that has found another one.
   */
  private light(): string | undefined {
    const { wb, over } = this;
    const handle = over && selectedJoint(wb) ? this.handleAt(over) : undefined;
    const grab = over && grabOf(handle, () => this.whose(wb.viewport.hovered), over);
    const id = grab === 'handle' || grab === 'ball' ? handle?.id : undefined;
    if (over && id?.kind === 'dof') this.showValue(id.dof, over);
    else if (!this.dragged) this.readout?.hide();
    if (!sameHandle(id, this.hovered)) {
      this.hovered = id;
      wb.viewport.requestRender();
    }
    // "grab" claims the pointer: a handle that yields must leave the viewport looking for joints.
    if (id) return handle?.yields ? 'move' : 'grab';
    return grab === 'bone' ? 'pointer' : undefined;
  }

  private state() {
    const dof = activeDof(this.wb);
    const active: HandleId | undefined = dof === undefined ? undefined : { kind: 'dof', dof };
    return { active, hovered: this.hovered, dragged: this.dragged };
  }

  /** As the viewport shows the joint. */
  private handles(): JointHandles | undefined {
    const selected = selectedJoint(this.wb);
    const placement = selected && this.placementOf(selected);
    const facts = selected && this.wb.viewport.character(selected.character.id);
    if (!selected || !placement || !facts) return undefined;
    const { skeleton, joint } = selected;
    const world = facts.worlds;
    // After an edit the pose is updated with the next frame.
    if (world.length < 16 * skeleton.joints.length) return undefined;
    return this.known.of(skeleton, joint, facts.dofs, world, placement);
  }

  /** Overwritten by each frame. */
  private placementOf({ character }: ResolvedJoint): Float64Array | undefined {
    const { viewport } = this.wb;
    const found = viewport.placementOf(character.id, viewport.pickedCopy(character));
    return found?.length === 16 ? found : undefined;
  }
}
