/** The gizmo of the selected joint, with its readout and the drags of its handles: for FK, and for IK's rings. */
import { type HandleId, type JointHandles, sameHandle } from '../../../evaluate/handles/joint-handles.ts';
import { characterDofs } from '../../../model/skeleton/dofs.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import type { DraggedHandle, GizmoState } from '../../../view/gizmo/gizmo-look.ts';
import type { HandleHit } from '../../../view/gizmo/handle-at.ts';
import { JointGizmo } from '../../../view/gizmo/joint-gizmo.ts';
import { dofValueText, limitNote, limitRange } from '../../state/joints/dof-text.ts';
import { type ResolvedJoint, selectedJoint, selectedJoints } from '../../state/joints/selected-joint.ts';
import type { Workbench } from '../../state/workbench.ts';
import { shownDofs } from '../posing/active-dof.ts';
import type { CanvasDrag, CanvasPointer } from '../viewport/canvas-tools.ts';
import { type ChipText, GizmoChip } from './gizmo-chip.ts';
import { type DraggedJoint, handDrag } from './hand-drag.ts';
import { KnownHandles } from './known-handles.ts';
import { type DragResult, type FkGrip, handleMover, handlesOf, type Mover } from './movers.ts';

/** Extra hit tolerance for touch; CSS pixels. */
export const FINGER = 10;
/** On a handle a drag starts sooner than elsewhere, where a click may be meant to pick. */
const HANDLE_THRESHOLD = 2;

export interface GizmoOptions {
  /** Which of the joint's handles it has, if any; the same object for the same handles. Default: all. */
  readonly only?: (handles: JointHandles) => JointHandles | undefined;
  /** The handle drawn as active. */
  readonly active?: () => HandleId | undefined;
}

export interface GizmoDrag {
  readonly joint: DraggedJoint;
  readonly at: CanvasPointer;
  /** CSS pixels that the pointer moves before the drag begins. */
  readonly threshold: number;
  /** Before the pose is read. */
  readonly begin?: () => void;
  readonly make: (grip: FkGrip) => Mover | undefined;
  /** As for `HandDragEvents`. */
  readonly ended?: (at: CanvasPointer | undefined, isUnmoved: boolean) => void;
}

export class SelectedGizmo {
  private gizmo: JointGizmo | undefined;
  private readonly known = new KnownHandles();
  private chip: GizmoChip | undefined;
  private hovered: HandleId | undefined;
  private dragged: DraggedHandle | undefined;
  private stops: (() => void)[] = [];

  constructor(
    private readonly wb: Workbench,
    private readonly options: GizmoOptions,
  ) {}

  enter(): void {
    const { wb } = this;
    this.gizmo = new JointGizmo(wb.viewportElement, {
      handles: () => this.handles(),
      state: () => this.state(),
      scale: () => wb.settings.get().gizmoScale,
      drawn: (layout, width, height) => this.chip?.place(layout, this.chipText(), width, height),
    });
    this.chip = new GizmoChip(wb.viewportElement);
    this.stops = [
      wb.viewport.addOverlay(this.gizmo),
      wb.settings.subscribe((now, before) => {
        if (now.gizmoScale !== before.gizmoScale) wb.viewport.requestRender();
      }),
    ];
  }

  leave(): void {
    for (const stop of this.stops) stop();
    this.stops = [];
    this.chip?.remove();
    this.gizmo = this.chip = undefined;
    this.hovered = this.dragged = undefined;
  }

  get isDragged(): boolean {
    return this.dragged !== undefined;
  }

  /** The handle under the pointer. */
  at(at: CanvasPointer): HandleHit | undefined {
    if (!selectedJoint(this.wb)) return undefined;
    return this.gizmo?.at(at.clientX, at.clientY, at.pointerType === 'touch' ? FINGER : 0);
  }

  /** Whether the pointer is on the dot in the middle of the rings. */
  isOnPivot(at: CanvasPointer): boolean {
    if (!selectedJoint(this.wb)) return false;
    return this.gizmo?.isOnPivot(at.clientX, at.clientY, at.pointerType === 'touch' ? FINGER : 0) ?? false;
  }

  /** Lights up a handle, and shows its value beside the rings. */
  light(id: HandleId | undefined, at: CanvasPointer | undefined): void {
    if (at && id?.kind === 'dof') this.showValue(id.dof);
    else if (!this.dragged) this.chip?.hide();
    if (sameHandle(id, this.hovered)) return;
    this.hovered = id;
    this.wb.viewport.requestRender();
  }

  /** @param ended as for `HandDragEvents` */
  dragHandle(
    id: HandleId,
    { character, joint }: ResolvedJoint,
    at: CanvasPointer,
    ended?: GizmoDrag['ended'],
  ): CanvasDrag {
    return this.drag({
      joint: { characterId: character.id, joint },
      at,
      threshold: HANDLE_THRESHOLD,
      make: (grip) => handleMover(id, grip),
      ...(ended && { ended }),
    });
  }

  drag({ joint, at, threshold, begin, make, ended }: GizmoDrag): CanvasDrag {
    const { wb } = this;
    wb.viewport.canvas.style.cursor = 'grabbing';
    return handDrag(wb, joint, at, threshold, {
      begin: () => {
        begin?.();
        const grip = this.gripAt(at);
        return grip && make(grip);
      },
      moved: (moved) => this.show(moved),
      ended: (now, isUnmoved) => {
        this.dragged = undefined;
        this.chip?.hide();
        wb.viewport.canvas.style.cursor = '';
        wb.viewport.requestRender();
        ended?.(now, isUnmoved);
      },
    });
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
    const others = selectedJoints(wb)?.joints.slice(0, -1) ?? [];
    return { selected, others, dofs, placement, sight: wb.viewport.eye, radius, at };
  }

  private show(moved: DragResult): void {
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
    const others = new Set(moved.others.map(({ index }) => all[index].joint));
    if (others.size > 0) told.push(`${1 + others.size} joints`);
    if (told.length || held.length) this.chip?.show(told.join('  '), held.join(', '));
  }

  private showValue(dof: number): void {
    const selected = selectedJoint(this.wb);
    if (!selected) return;
    const { character, skeleton } = selected;
    const value = shownDofs(this.wb, character)[dof];
    const text = dofValueText(characterDofs(skeleton, [])[dof], value, character, this.wb.settings.get().angles);
    this.chip?.show(text);
    this.wb.viewport.requestRender();
  }

  private chipText(): ChipText | undefined {
    const selected = selectedJoint(this.wb);
    if (!selected) return undefined;
    const { character, skeleton, joint } = selected;
    const name = jointName(skeleton, joint);
    const active = this.options.active?.();
    const facts = this.wb.viewport.character(character.id);
    if (active?.kind !== 'dof' || !facts) return { name, value: '', limits: '' };
    const dof = characterDofs(skeleton, [])[active.dof];
    const { angles } = this.wb.settings.get();
    const value = dofValueText(dof, facts.dofs[active.dof], character, angles);
    return { name, value, limits: limitRange(dof, character, angles) };
  }

  private state(): GizmoState {
    return { active: this.options.active?.(), hovered: this.hovered, dragged: this.dragged };
  }

  /** As the viewport shows the joint. */
  private handles(): JointHandles | undefined {
    const selected = selectedJoint(this.wb);
    const placement = selected && this.placementOf(selected);
    const facts = selected && this.wb.viewport.character(selected.character.id);
    if (!selected || !placement || !facts) return undefined;
    const { character, skeleton, joint } = selected;
    const world = facts.worlds;
    // After an edit the pose is updated with the next frame.
    if (world.length < 16 * skeleton.joints.length) return undefined;
    const handles = this.known.of(skeleton, joint, facts.dofs, world, placement, character.clampsToLimits);
    return this.options.only ? this.options.only(handles) : handles;
  }

  /** Overwritten by each frame. */
  private placementOf({ character }: ResolvedJoint): Float64Array | undefined {
    const { viewport } = this.wb;
    const found = viewport.placementOf(character.id, viewport.pickedCopy(character));
    return found?.length === 16 ? found : undefined;
  }
}
