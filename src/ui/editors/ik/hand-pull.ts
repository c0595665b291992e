/**
 * A hand that drags a point of a character, from where it began to the release: one undo step, whoever moves the hand
 * (the mouse, arrow keys). Places are the world's; the character's own space is as it was placed at the beginning.
 */
import { type SetDofs, setDofs } from '../../../edit/commands/pose.ts';
import type { Command, Edit } from '../../../edit/store.ts';
import type { Hindrance } from '../../../evaluate/ik/drag/hindrance.ts';
import { type Gap, Pull } from '../../../evaluate/ik/drag/pull.ts';
import { type DragTarget, ikOf, type PinTarget, pointAt } from '../../../evaluate/ik/set-up.ts';
import { isDriven } from '../../../evaluate/pose.ts';
import { invertAffine, isSingular } from '../../../math/mat4.ts';
import { subtract, type Vec3 } from '../../../math/vec3.ts';
import { coupleOf } from '../../../model/couples.ts';
import { type Character, type Document, findCharacter } from '../../../model/document.ts';
import { jointDofCount, rootDofCount } from '../../../model/dofs.ts';
import { jointName } from '../../../model/joint-name.ts';
import { HandEdit } from '../../state/hand-edit.ts';
import { standStill } from '../../state/stand-still.ts';
import type { Uses, Workbench } from '../../state/workbench.ts';
import { autoKey } from '../posing/pose-edits.ts';
import { tellFollows } from '../posing/tell-follows.ts';

/** What is taken hold of. */
export interface IkGrip {
  readonly characterId: string;
  readonly placement: number;
  readonly joint: number;
  /** In the joint's space. */
  readonly point: Vec3;
  /** The id of the pin that it is; absent for a point that nothing holds otherwise. */
  readonly pin?: number;
}

/** What is to be seen of a pull: gaps are in the character's own space. */
export interface PullState {
  readonly grip: IkGrip;
  readonly gaps: readonly Gap[];
  readonly hindrance: Hindrance;
}

export class HandPull {
  /** Where the point was when it was taken hold of, in the world. */
  readonly anchor: Vec3;
  private last: Vec3 | undefined;
  private readonly edit: HandEdit;
  private readonly pull: Pull;
  /** What has stood still in the picture for the drag goes on. */
  private readonly rest: () => void;
  private readonly start: Float64Array;
  private readonly toOwn = new Float64Array(16);
  private readonly targets: ReadonlyMap<number, PinTarget>;
  private readonly command: Command<SetDofs, Document | Edit>;
  /** DOFs that may be written: none that follows another, no morph. */
  private readonly written: readonly number[];

  private constructor(
    private readonly wb: Workbench,
    readonly grip: IkGrip,
    private readonly character: Character,
    parts: NonNullable<ReturnType<typeof partsOf>>,
  ) {
    const { skeleton, dofs, world, placement } = parts;
    const { targets } = wb.posing.ik;
    this.start = dofs.slice();
    invertAffine(placement, 0, this.toOwn, 0);
    const own = pointAt(world, grip.joint, grip.point);
    this.anchor = pointAt(placement, 0, own);
    const held = targets.targetsOf(character.id, ikOf(character), dofs, world);
    // Where it is, not where an earlier drag wanted it: it is there that the hand has taken it.
    const before = grip.pin === undefined ? undefined : held.get(grip.pin);
    if (before && grip.pin !== undefined) held.set(grip.pin, { ...before, position: own });
    this.targets = held;
    const { joint, point } = grip;
    const dragged: DragTarget = grip.pin === undefined ? { joint, point, target: own } : { pin: grip.pin };
    this.pull = new Pull(character, skeleton, dofs, held, dragged);
    const ends = rootDofCount(skeleton) + jointDofCount(skeleton);
    this.written = Array.from({ length: Math.min(ends, dofs.length) }, (_, dof) => dof).filter(
      (dof) => coupleOf(skeleton, dof) === undefined,
    );
    this.edit = new HandEdit(wb.store, wb.messages, () => this.holdsStill);
    this.rest = wb.viewport.holdTravel(character.id);
    wb.posing.ik.wantsRoot.set(false);
    this.command = { ...setDofs, label: () => `Drag ${jointName(character.skeleton, joint)}` };
  }

  /** Undefined where there is nothing to be dragged: the character is gone or hidden, or the point is nowhere. */
  static begin(wb: Workbench, grip: IkGrip): HandPull | undefined {
    const character = findCharacter(wb.store.document, grip.characterId);
    if (!character?.skeleton) return undefined;
    // What plays would take the pose back with the next frame. Before anything is measured: it may go to a whole frame.
    const count = rootDofCount(character.skeleton) + jointDofCount(character.skeleton);
    let plays = autoKey(wb) !== undefined;
    for (let dof = 0; dof < count && !plays; dof++) plays = isDriven(character, dof);
    if (plays) standStill(wb);
    const now = findCharacter(wb.store.document, grip.characterId);
    const parts = now && partsOf(wb, now, grip);
    return now && parts && new HandPull(wb, grip, now, parts);
  }

  /** The hand is there now, in the world. */
  to(world: Vec3): void {
    const { pull, wb, start, written } = this;
    if (this.edit.cancelled) return;
    this.last = world;
    const [x, y, z] = pointAt(this.toOwn, 0, world);
    pull.to(x, y, z);
    this.show(written.filter((dof) => pull.dofs[dof] !== start[dof]));
    wb.posing.ik.wantsRoot.set(pull.wantsRoot);
    wb.viewport.requestRender();
  }

  /** So far as a way in the world is in the unit of the character itself. */
  inOwnUnit(from: Vec3, to: Vec3): number {
    const { toOwn } = this;
    return Math.hypot(...subtract(pointAt(toOwn, 0, to), pointAt(toOwn, 0, from)));
  }

  /** Once more to where the hand is, if the pose is still on its way there. Whether it was. */
  goOn(): boolean {
    if (this.edit.cancelled || !this.pull.isOnItsWay || !this.last) return false;
    this.to(this.last);
    return true;
  }

  /** The release: one undo step. */
  finish(): void {
    const { pull, wb, start, written, edit, character } = this;
    if (!edit.cancelled) {
      const before = pull.dofs.slice();
      pull.settle();
      if (pull.dofs.some((value, dof) => value !== before[dof]))
        this.show(written.filter((dof) => pull.dofs[dof] !== start[dof]));
    }
    const wasCancelled = edit.cancelled;
    edit.commit();
    this.rest();
    if (wasCancelled) return;
    if (pull.wantsRoot && !pull.hindrance.canMove) {
      const name = jointName(character.skeleton, this.grip.joint);
      wb.messages.note(`${name} can’t be moved while ${character.name}’s root is fixed. Allow the root to move.`);
    }
    const facts = wb.viewport.character(character.id);
    const now = findCharacter(wb.store.document, character.id);
    if (!facts || !now) return;
    const setup = ikOf(now);
    const index = setup.pins.findIndex(({ id }) => id === this.grip.pin);
    const targets = new Map(this.targets);
    const own = index < 0 ? undefined : targets.get(setup.pins[index].id);
    if (own) targets.set(setup.pins[index].id, { ...own, position: pull.target(index) });
    wb.posing.ik.targets.leave(character.id, setup, facts.dofs, targets, pull.hindrance);
    wb.viewport.requestRender();
  }

  /** Everything as before. */
  cancel(): void {
    this.edit.cancel();
    this.rest();
    this.wb.posing.ik.wantsRoot.set(false);
    this.wb.viewport.requestRender();
  }

  /** After something else has ended it: what the hand does is nothing any more. */
  get isOver(): boolean {
    return this.edit.cancelled;
  }

  /** For the picture. */
  get state(): PullState {
    const { pull, grip } = this;
    return { grip, gaps: pull.gaps(), hindrance: pull.hindrance };
  }

  private show(dofs: readonly number[]): void {
    const { wb, character, pull } = this;
    this.edit.preview(this.command, {
      characterId: character.id,
      dofs: dofs.map((index) => ({ index, value: pull.dofs[index] })),
      timeSeconds: wb.transport.get().timeSeconds,
      key: autoKey(wb),
    });
    // After it has begun: what was said before a step is left behind by it.
    tellFollows(wb, character, dofs);
  }

  private get holdsStill(): boolean {
    const now = findCharacter(this.wb.store.document, this.character.id);
    return now?.skeleton === this.character.skeleton && now?.ik === this.character.ik;
  }
}

/** What a drag begins from, until the next `seek`. */
function partsOf(wb: Uses<'viewport'>, { id, skeleton }: Character, { placement: copy, joint }: IkGrip) {
  const facts = wb.viewport.character(id);
  const placement = wb.viewport.placementOf(id, copy)?.slice();
  if (!facts || !skeleton || !placement || placement.length < 16 || isSingular(placement)) return undefined;
  const world = facts.worlds;
  if (16 * joint + 16 > world.length) return undefined;
  return { skeleton, dofs: facts.dofs, world, placement };
}
