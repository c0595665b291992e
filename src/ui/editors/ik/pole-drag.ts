/** A drag of a limb's pole in the plane that faces the camera: one undo step, keyed as posing is. */
import { setDofs } from '../../../edit/commands/pose.ts';
import { invertAffine, isSingular } from '../../../math/mat4.ts';
import { transformPoint, type Vec3 } from '../../../math/vec3.ts';
import type { GoalPlace } from '../../../model/limbs.ts';
import { HandEdit } from '../../state/actions/hand-edit.ts';
import { addKeyed } from '../../state/add-keys.ts';
import { pausePlayback } from '../../state/pause-playback.ts';
import type { Workbench } from '../../state/workbench.ts';
import { autoKey } from '../posing/pose-edits.ts';
import { type CanvasDrag, type CanvasPointer, CLICK_PIXELS } from '../viewport/canvas-tools.ts';
import type { SeenSkeleton } from './pins-on-screen.ts';

/** A pole in the picture. */
interface SeenPole {
  readonly seen: SeenSkeleton;
  readonly place: GoalPlace;
}

export class PoleDrag implements CanvasDrag {
  hasBegun = false;
  private readonly edit: HandEdit;
  private readonly from: Vec3;
  private readonly toOwn = new Float64Array(16);
  /** From the pointer to the pole on screen. */
  private readonly beside: readonly [number, number];

  /** @param click the press was one, without motion */
  constructor(
    private readonly wb: Workbench,
    private readonly goal: SeenPole,
    private readonly press: CanvasPointer,
    private readonly click: () => void,
  ) {
    this.edit = new HandEdit(wb.store, wb.messages);
    const { toWorld } = goal.seen;
    // The placement is written anew with each frame.
    this.from = transformPoint(toWorld, goal.place.pole ?? [0, 0, 0]);
    if (!isSingular(toWorld)) invertAffine(toWorld, 0, this.toOwn, 0);
    const { x, y } = wb.viewport.eye.toScreen(this.from);
    this.beside = [x - press.clientX, y - press.clientY];
  }

  move(at: CanvasPointer): void {
    const { wb, press, goal } = this;
    const way = Math.hypot(at.clientX - press.clientX, at.clientY - press.clientY);
    if (!this.hasBegun && way <= CLICK_PIXELS) return;
    if (!this.hasBegun) pausePlayback(wb);
    this.hasBegun = true;
    const [x, y] = this.beside;
    const world = wb.viewport.eye.inPlaneOf(this.from, at.clientX + x, at.clientY + y);
    const dofs = goal.place.poleAt(transformPoint(this.toOwn, world));
    const characterId = goal.seen.character.id;
    const { timeSeconds } = wb.transport.get();
    const command = { ...setDofs, label: () => `Drag pole of ${goal.place.limb.name}` };
    const args = { characterId, dofs, timeSeconds, key: autoKey(wb) };
    this.edit.preview(command, args, () => addKeyed(wb, command, args));
  }

  end(at: CanvasPointer): void {
    if (this.hasBegun) this.move(at);
    else this.click();
    this.edit.commit();
  }

  cancel(): void {
    this.edit.cancel();
  }
}
