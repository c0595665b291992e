/**
 * The FK tool. What a press grabs, in this order:
 *
 *     a handle of the gizmo       its DOF, which becomes active
 *     a bone, or skin around it   its joint, which is selected, or becomes the active one of those selected; dragged up
 *                                 and down: the active DOF
 *     the ball within the rings   rotates the selected joint freely
 *     anything else               the camera
 */
import type { HandleId } from '../../../evaluate/handles/joint-handles.ts';
import { findCharacter } from '../../../model/document.ts';
import type { Selection } from '../../../model/session.ts';
import type { Hit } from '../../../view/picking/picking.ts';
import { activateJoint, addsToSelection, reselect, selectHit } from '../../state/joints/select-joints.ts';
import { type ResolvedJoint, resolvedJoint, selectedJoint } from '../../state/joints/selected-joint.ts';
import type { Workbench } from '../../state/workbench.ts';
import { activeDof, chooseDof } from '../posing/active-dof.ts';
import { type CanvasDrag, type CanvasPointer, CLICK_PIXELS } from '../viewport/canvas-tools.ts';
import type { ModeTool } from '../viewport/mode-tool.ts';
import { dofButtons } from './dof-buttons.ts';
import { grabOf, type UnderPointer } from './grab.ts';
import type { DraggedJoint } from './hand-drag.ts';
import { boneMover, type FkGrip, handleMover, type Mover } from './movers.ts';
import { SelectedGizmo } from './selected-gizmo.ts';

export function fkTool(wb: Workbench): ModeTool {
  return new FkTool(wb);
}

class FkTool implements ModeTool {
  private readonly gizmo: SelectedGizmo;
  private listening: AbortController | undefined;
  /** Where the pointer was last seen. */
  private over: CanvasPointer | undefined;

  constructor(private readonly wb: Workbench) {
    const active = (): HandleId | undefined => {
      const dof = activeDof(wb);
      return dof === undefined ? undefined : { kind: 'dof', dof };
    };
    this.gizmo = new SelectedGizmo(wb, { active });
  }

  enter(): void {
    const { wb } = this;
    this.gizmo.enter();
    this.listening = new AbortController();
    const { signal } = this.listening;
    const stops = [
      wb.viewport.pointing.onHover(() => {
        if (this.over && !this.gizmo.isDragged) wb.viewport.canvas.style.cursor = this.light() ?? '';
      }),
      wb.posing.chosenDof.subscribe(() => wb.viewport.requestRender()),
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
    this.gizmo.leave();
    this.listening = this.over = undefined;
  }

  press(at: CanvasPointer): CanvasDrag | undefined {
    const { wb } = this;
    if (at.button !== 0 || at.altKey) return undefined;
    const selected = selectedJoint(wb);
    const handle = this.gizmo.at(at);
    let hit: Hit | undefined;
    const under = () => {
      hit = wb.viewport.pointing.pick(at.clientX, at.clientY);
      return this.whose(hit);
    };
    const grab = grabOf(handle, under, at);
    if (grab === 'bone' && hit) return this.dragBone(hit, at);
    if (!handle || !selected || !grab) return undefined;
    return grab === 'ball' ? this.dragBall(hit, selected, at) : this.dragHandle(handle.id, selected, at);
  }

  /** Handles are the selected joint's. */
  menu(at: CanvasPointer): boolean {
    const grab = grabOf(
      this.gizmo.at(at),
      () => this.whose(this.wb.viewport.pointing.pick(at.clientX, at.clientY)),
      at,
    );
    return grab === 'handle' || grab === 'ball';
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

  private dragHandle(id: HandleId, selected: ResolvedJoint, at: CanvasPointer): CanvasDrag {
    const { chosenDof } = this.wb.posing;
    const before = chosenDof.get();
    if (id.kind === 'dof') chooseDof(this.wb, id.dof);
    return this.gizmo.dragHandle(id, selected, at, (now) => {
      if (!now) chosenDof.set(before);
    });
  }

  /** Selects the joint that was hit when the drag begins. */
  private dragBone(hit: Hit, at: CanvasPointer): CanvasDrag | undefined {
    const { wb } = this;
    const { characterId, placement, joint } = hit;
    if (joint === undefined) return undefined;
    const make = (grip: FkGrip) => boneMover(activeDof(wb), grip);
    return this.drag({ characterId, placement, joint }, at, make, hit);
  }

  private dragBall(hit: Hit | undefined, { character, joint }: ResolvedJoint, at: CanvasPointer): CanvasDrag {
    const make = (grip: FkGrip) => handleMover({ kind: 'ball' }, grip);
    return this.drag({ characterId: character.id, joint }, at, make, hit ?? 'nothing');
  }

  /**
   * @param joint the one to drag, at the placement that was hit
   * @param under what a click there would have picked, in case the press turns out to be one
   */
  private drag(
    joint: DraggedJoint & { readonly placement?: number },
    at: CanvasPointer,
    make: (grip: FkGrip) => Mover | undefined,
    under: Hit | 'nothing',
  ): CanvasDrag {
    /** The selection that the drag has replaced. */
    let before: Selection | undefined;
    return this.gizmo.drag({
      joint,
      at,
      threshold: CLICK_PIXELS,
      begin: () => {
        before = this.selectDragged(joint);
      },
      make,
      ended: (now, isUnmoved) => {
        if (!now && before) reselect(this.wb, before);
        if (now && isUnmoved)
          selectHit(this.wb, under === 'nothing' ? undefined : under, addsToSelection(this.wb, now));
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
      activateJoint(this.wb, { characterId, joint, ...(placement !== undefined && { placement }) });
      return selection;
    }
    const character = findCharacter(store.document, characterId);
    const isOther = character && placement !== undefined && placement !== viewport.pickedCopy(character);
    if (!isOther) return undefined;
    store.select({ ...selection, placement });
    return selection;
  }

  /**
   * Lights up the handle that a press would grab, and returns the cursor. Joints are lit by the viewport, so it is
   * called again when that has found another one.
   */
  private light(): string | undefined {
    const { wb, over } = this;
    const handle = over && this.gizmo.at(over);
    const grab = over && grabOf(handle, () => this.whose(wb.viewport.pointing.hovered), over);
    const id = grab === 'handle' || grab === 'ball' ? handle?.id : undefined;
    this.gizmo.light(id, over);
    // "grab" claims the pointer: a handle that yields must leave the viewport looking for joints.
    if (id) return handle?.yields ? 'move' : 'grab';
    return grab === 'bone' ? 'pointer' : undefined;
  }
}
