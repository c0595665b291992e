/**
 * A drag's effect on the page: the pose is previewed, the release is one undo step, and pin targets stay where it ends.
 * Owns the store's gesture; pointer motion belongs to `PinDrag` and `PinNudge`, the pose to `Pull`.
 */

import type { Change } from '../../../edit/change.ts';
import type { Command } from '../../../edit/command.ts';
import type { SetDofs } from '../../../edit/commands/pose.ts';
import { jointIn } from '../../../edit/step-names.ts';
import { currentTargets } from '../../../evaluate/ik/drag/current-targets.ts';
import { lockedIn } from '../../../evaluate/ik/drag/drag-reach.ts';
import type { Hindrance } from '../../../evaluate/ik/drag/hindrance.ts';
import { type Gap, type Grip, Pull } from '../../../evaluate/ik/drag/pull.ts';
import { ikOf } from '../../../evaluate/ik/set-up.ts';
import { isSingular } from '../../../math/mat4.ts';
import type { Vec3 } from '../../../math/vec3.ts';
import { type Character, type Document, findCharacter } from '../../../model/document.ts';
import type { Pin } from '../../../model/ik.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { HandEdit } from '../../state/actions/hand-edit.ts';
import { addKeyed } from '../../state/add-keys.ts';
import type { Workbench } from '../../state/workbench.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { autoKey, posingCommand, standStillToPose } from '../posing/pose-edits.ts';
import { tellFollows } from '../posing/tell-follows.ts';
import { reachOfDrag } from './reach.ts';

/** What is dragged. */
export interface IkGrip extends Grip {
  readonly characterId: string;
  readonly placement: number;
}

/** State of a drag for drawing; gaps are in the character's own space. */
export interface PullState {
  readonly grip: IkGrip;
  readonly gaps: readonly Gap[];
  readonly hindrance: Hindrance;
  /** Feet that hold by themselves while it lasts. */
  readonly standing: readonly Pin[];
}

export class HandPull {
  private readonly edit: HandEdit;
  /** Resumes following and *in place*, which the drag has paused. */
  private readonly rest: () => void;
  private readonly command: Command<SetDofs, Document | Change>;

  private constructor(
    private readonly wb: Workbench,
    private readonly grip: IkGrip,
    private readonly character: Character,
    private readonly pull: Pull,
    /** Locked DOFs of what could bend. */
    private readonly locked: number,
  ) {
    this.edit = new HandEdit(wb.store, wb.messages, () => this.holdsStill);
    this.rest = wb.viewport.freezeRootMotion(character.id);
    wb.posing.ik.wantsRoot.set(false);
    this.command = { ...posingCommand(wb), label: () => `Drag ${jointIn(character, grip.joint)}` };
  }

  /** Undefined if nothing can be dragged: the character was removed or hidden, or the point can't be located. */
  static begin(wb: Workbench, grip: IkGrip): HandPull | undefined {
    const before = findCharacter(wb.store.document, grip.characterId);
    if (!before?.skeleton) return undefined;
    // Before anything is measured: it may go to a whole frame.
    standStillToPose(wb, before);
    const character = findCharacter(wb.store.document, grip.characterId);
    const pull = character && pullOf(wb, character, grip);
    return pull && new HandPull(wb, grip, character, pull.pull, pull.locked);
  }

  /** Where the hand is, in the world: at first where the point was. */
  get hand(): Vec3 {
    return this.pull.hand;
  }

  /** Moves the target to a position in the world. */
  to(world: Vec3): void {
    if (this.edit.cancelled) return;
    this.pull.to(world);
    this.show();
  }

  /** Turns a pin that holds its orientation, from how it was at the start, about an axis of the world; radians. */
  turn(axis: Vec3, angle: number): void {
    if (this.edit.cancelled) return;
    this.pull.turn(axis, angle);
    this.show();
  }

  /** The displacement in the character's own unit. */
  inOwnUnit(from: Vec3, to: Vec3): number {
    return this.pull.inOwnUnit(from, to);
  }

  /** One more frame, if the pose is still on its way to where the hand is. Whether it was. */
  goOn(): boolean {
    if (this.edit.cancelled || !this.pull.isOnItsWay) return false;
    this.pull.goOn();
    this.show();
    return true;
  }

  /** The release: one undo step. */
  finish(): void {
    const { pull, wb, edit, character, grip } = this;
    if (!edit.cancelled) {
      const before = pull.dofs.slice();
      pull.settle();
      if (pull.dofs.some((value, dof) => value !== before[dof])) this.preview();
    }
    const wasCancelled = edit.cancelled;
    edit.commit();
    this.rest();
    if (wasCancelled) return;
    if (pull.wantsRoot && !pull.hindrance.canMove) {
      const name = jointName(character.skeleton, grip.joint);
      wb.messages.note(`${name} can’t be moved while ${character.name}’s root is fixed. Allow the root to move.`);
    }
    if (this.locked > 0) wb.messages.note(`${plural(this.locked, 'locked DOF')} left alone.`);
    const facts = wb.viewport.character(character.id);
    const now = findCharacter(wb.store.document, character.id);
    if (!facts || !now) return;
    wb.posing.ik.targets.leave(character.id, ikOf(now), facts.dofs, pull.held, pull.hindrance);
    wb.viewport.requestRender();
  }

  /** Restores everything. */
  cancel(): void {
    this.edit.cancel();
    this.rest();
    this.wb.posing.ik.wantsRoot.set(false);
    this.wb.viewport.requestRender();
  }

  /** Whether something else has ended it; further moves are ignored. */
  get isOver(): boolean {
    return this.edit.cancelled;
  }

  /** For drawing. */
  get state(): PullState {
    const { pull, grip } = this;
    return { grip, gaps: pull.gaps(), hindrance: pull.hindrance, standing: pull.standing };
  }

  private show(): void {
    const { wb, pull } = this;
    this.preview();
    wb.posing.ik.wantsRoot.set(pull.wantsRoot);
    wb.viewport.requestRender();
  }

  private preview(): void {
    const { wb, character, pull, command } = this;
    const { changes } = pull;
    const { timeSeconds } = wb.transport.get();
    const args = { characterId: character.id, dofs: changes, timeSeconds, key: autoKey(wb) };
    this.edit.preview(command, args, () => addKeyed(wb, command, args));
    // After the edit has begun, since messages are cleared by a new step.
    tellFollows(
      wb,
      character,
      changes.map(({ index }) => index),
    );
  }

  private get holdsStill(): boolean {
    const now = findCharacter(this.wb.store.document, this.character.id);
    return now?.skeleton === this.character.skeleton && now?.ik === this.character.ik;
  }
}

/** Of the pose that is shown. */
function pullOf(
  wb: Workbench,
  character: Character,
  grip: IkGrip,
): { readonly pull: Pull; readonly locked: number } | undefined {
  const { viewport, posing } = wb;
  const { id, skeleton } = character;
  const facts = viewport.character(id);
  const placement = viewport.placementOf(id, grip.placement);
  if (!facts || !skeleton || !placement || placement.length < 16 || isSingular(placement)) return undefined;
  const { dofs, worlds: world } = facts;
  if (16 * grip.joint + 16 > world.length) return undefined;
  const held = currentTargets(posing.ik.targets, id, ikOf(character), dofs, world);
  const reach = reachOfDrag(wb, character, skeleton, world, placement, grip.joint);
  const pull = new Pull(character, skeleton, { dofs, world }, held, grip, placement, reach);
  return { pull, locked: lockedIn(character, reach.bending) };
}
