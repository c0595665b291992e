/**
 * The FK tool. What a press grabs, in this order:
 *
 *     a handle of the gizmo            its DOF, which becomes active
 *     the bone of the selected joint   dragged up and down: the active DOF
 *     the ball within the rings        rotates it freely
 *     anything else                    the camera
 */
import { type HandleId, type JointHandles, sameHandle } from '../../../evaluate/handles/joint-handles.ts';
import { characterDofs } from '../../../model/dofs.ts';
import type { DraggedHandle } from '../../../view/gizmo/gizmo-look.ts';
import { JointGizmo } from '../../../view/gizmo/joint-gizmo.ts';
import type { Hit } from '../../../view/viewport.ts';
import { Readout } from '../../kit/readout.ts';
import { type ResolvedJoint, selectedJoint } from '../../state/selected-joint.ts';
import type { Workbench } from '../../state/workbench.ts';
import { activeDof, chooseDof, shownDofs } from '../posing/active-dof.ts';
import { type CanvasDrag, type CanvasPointer, CLICK_PIXELS } from '../viewport/canvas-tools.ts';
import type { ModeTool } from '../viewport/mode-tool.ts';
import { dofButtons } from './dof-buttons.ts';
import { handDrag } from './hand-drag.ts';
import { KnownHandles } from './known-handles.ts';
import { boneMover, type DragResult, type FkGrip, handleMover, type Mover } from './movers.ts';
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
      wb.posing.chosenDof.subscribe(() => wb.viewport.requestRender()),
      wb.settings.subscribe((now, before) => {
        if (now.gizmoScale !== before.gizmoScale) wb.viewport.requestRender();
      }),
      wb.store.subscribe((now, before) => {
        if (now.selection !== before.selection) this.light(undefined);
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
    this.hovered = this.dragged = undefined;
  }

  press(at: CanvasPointer): CanvasDrag | undefined {
    const { wb, gizmo } = this;
    const selected = selectedJoint(wb);
    if (at.button !== 0 || at.altKey || !gizmo || !selected) return undefined;
    const id = this.handleAt(at);
    if (id && id.kind !== 'ball') return this.dragHandle(id, selected, at);
    // Shift pans unless a handle is grabbed: on the bone, it only makes a running drag finer.
    if (at.shiftKey) return undefined;
    const hit = wb.viewport.pick(at.clientX, at.clientY);
    const isOwn = hit?.joint === selected.joint && hit.characterId === selected.character.id;
    if (hit && isOwn) return this.dragBone(hit, selected, at);
    return id && this.dragBall(hit, selected, at);
  }

  hover(at: CanvasPointer | undefined): string | undefined {
    const id = at && this.handleAt(at);
    this.light(id);
    if (!at || !id) return undefined;
    if (id.kind === 'dof') this.showValue(id.dof, at);
    return 'grab';
  }

  private dragHandle(id: HandleId, selected: ResolvedJoint, at: CanvasPointer): CanvasDrag {
    if (id.kind === 'dof') chooseDof(this.wb, id.dof);
    return this.drag(selected, at, HANDLE_THRESHOLD, (grip) => handleMover(id, grip));
  }

  private dragBone(hit: Hit, selected: ResolvedJoint, at: CanvasPointer): CanvasDrag {
    const { store, viewport } = this.wb;
    const { placement } = hit;
    if (placement !== viewport.pickedCopy(selected.character)) store.select({ ...store.selection, placement });
    const dof = activeDof(this.wb);
    return this.drag(selected, at, CLICK_PIXELS, (grip) => boneMover(dof, grip), hit);
  }

  private dragBall(hit: Hit | undefined, selected: ResolvedJoint, at: CanvasPointer): CanvasDrag {
    return this.drag(selected, at, CLICK_PIXELS, (grip) => handleMover({ kind: 'ball' }, grip), hit ?? 'nothing');
  }

  /** @param under what a click there would have picked, in case the press turns out to be one */
  private drag(
    selected: ResolvedJoint,
    at: CanvasPointer,
    threshold: number,
    make: (grip: FkGrip) => Mover | undefined,
    under?: Hit | 'nothing',
  ): CanvasDrag {
    const { wb } = this;
    const { id } = selected.character;
    wb.viewport.canvas.style.cursor = 'grabbing';
    return handDrag(wb, id, at, threshold, {
      begin: () => {
        const grip = this.gripAt(at);
        return grip && make(grip);
      },
      moved: (moved, now) => this.show(moved, now),
      ended: (now, wentNowhere) => {
        this.dragged = undefined;
        this.readout?.hide();
        wb.viewport.canvas.style.cursor = '';
        wb.viewport.requestRender();
        if (!now || !wentNowhere || !under) return;
        wb.store.select(under === 'nothing' ? { characterId: id } : under);
      },
    });
  }

  /** The current pose when a drag begins. */
  private gripAt(at: CanvasPointer): FkGrip | undefined {
    const { wb } = this;
    const selected = selectedJoint(wb);
    const placement = selected && this.placementOf(selected);
    if (!selected || !placement) return undefined;
    const dofs = shownDofs(wb, selected.character);
    return {
      selected,
      dofs,
      placement: placement.slice(),
      sight: wb.viewport.eye,
      radius: this.gizmo?.radius ?? 1,
      at,
    };
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

  private handleAt(at: CanvasPointer): HandleId | undefined {
    return this.gizmo?.at(at.clientX, at.clientY, at.pointerType === 'touch' ? FINGER : 0);
  }

  private light(id: HandleId | undefined): void {
    if (id?.kind !== 'dof' && !this.dragged) this.readout?.hide();
    if (sameHandle(id, this.hovered)) return;
    this.hovered = id;
    this.wb.viewport.requestRender();
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
