/**
 * The section of the selected joints in rig mode: name, parent, type with its parameters, offset, bone, limits, box,
 * links, and file pose. Of several joints, type, limits and file pose are set for all, the rest for the active one.
 * Every change is one undo step, and every number can be typed. Rows are rebuilt if their set
 * changes; numbers are only updated, also while dragging.
 */

import type { GUI } from 'lil-gui';
import type { Change } from '../../../edit/change.ts';
import type { Command } from '../../../edit/command.ts';
import { reparentJoint } from '../../../edit/commands/rig.ts';
import { renameJoint, setBox, setFilePose, setLength, setMotion, setOffset } from '../../../edit/commands/rig-joint.ts';
import { inTurn } from '../../../edit/in-turn.ts';
import { possibleParents } from '../../../edit/rig/parents.ts';
import { type Character, type Document, findCharacter } from '../../../model/document.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { dofsOf, isSameType, motionOfKind, takesLimits } from '../../../model/skeleton/joint-types.ts';
import { lengthStep } from '../../../model/skeleton/reach.ts';
import type { Joint, Motion, Skeleton } from '../../../model/skeleton/skeleton.ts';
import { attempt } from '../../state/actions/attempt.ts';
import type { HandEdit } from '../../state/actions/hand-edit.ts';
import { jointsText } from '../../state/joints/selected-joint.ts';
import { pausePlayback } from '../../state/pause-playback.ts';
import type { Uses, Workbench } from '../../state/workbench.ts';
import { button, element, write } from '../../widgets/dom.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { removeControllers } from '../../widgets/numbers/slider.ts';
import { contentOf } from '../../widgets/section.ts';
import { whyNoCorner } from './box-order.ts';
import { addCoupleRow, coupleRow } from './couple-rows.ts';
import { nameNote } from './joint-names.ts';
import { limitRow } from './limit-rows.ts';
import { motionRows, motionShape } from './motion-rows.ts';
import { changeMotions } from './rig-edits.ts';
import { rigging } from './rigging-args.ts';
import {
  choiceRow,
  heading,
  numberRow,
  type SectionContext,
  type SectionRow,
  textRow,
  vectorRow,
} from './section-rows.ts';

type Joints = Skeleton['joints'];

export class RigSection {
  private readonly context: SectionContext;
  private rows: SectionRow[] = [];
  private lines: HTMLElement[] = [];
  private made = '';
  private of: { readonly characterId: string; readonly joint: number } | undefined;
  /** Selected joints besides. */
  private others: readonly number[] = [];

  constructor(
    private readonly wb: Workbench,
    private readonly edit: HandEdit,
    private readonly section: GUI,
  ) {
    this.context = { wb, edit, section };
    write(contentOf(section).dataset, 'empty', 'Select a joint in the viewport or outliner to edit it.');
  }

  /** Call after an edit or a change of selection. @param joints the active one last */
  show(character: Character | undefined, joints: readonly number[]): void {
    const made = character && joints.length > 0 ? shapeOf(this.wb, character, joints) : '';
    if (made !== this.made) this.rebuild(character, joints, made);
    for (const row of this.rows) row.update();
  }

  private rebuild(character: Character | undefined, joints: readonly number[], made: string): void {
    const joint = joints.at(-1);
    this.made = made;
    this.others = joints.slice(0, -1);
    removeControllers(this.section);
    for (const line of this.lines) line.remove();
    this.rows = [];
    this.lines = [];
    this.of = undefined;
    const own = joint === undefined ? undefined : character?.skeleton?.joints[joint];
    this.section.title(own ? `Rig: ${jointsText(character?.skeleton, joints)}` : 'Rig');
    this.section.domElement.classList.toggle('is-selected', own !== undefined);
    if (!character?.skeleton || !own || joint === undefined) return;
    this.of = { characterId: character.id, joint };
    if (this.others.length === 0) {
      this.addPlace(character, own, joint);
      this.addMotion(own);
      this.addLimits(character, own, joint);
    } else {
      this.addMotion(own);
      this.addLimits(character, own, joint);
      this.addPose(joint);
      this.append(heading(`Only ${jointName(character.skeleton, joint)}`));
      this.addPlace(character, own, joint);
    }
    this.addBone(character, own);
    this.addCouples(character, own, joint);
    if (this.others.length === 0) this.addPose(joint);
  }

  /** The current joint. */
  private readonly now = (): Joint | undefined => {
    const { of } = this;
    return of && findCharacter(this.wb.store.document, of.characterId)?.skeleton?.joints[of.joint];
  };

  private args() {
    const { characterId = '', joint = 0 } = this.of ?? {};
    return { ...rigging(this.wb, { id: characterId }), joint };
  }

  /** One undo step. */
  private apply<Args>(command: Command<Args, Document | Change>, args: Args): void {
    pausePlayback(this.wb);
    attempt(this.wb.messages, () => this.wb.store.apply(command, args));
  }

  /** Part of an undo step: a dragged slider or a number being typed. */
  private preview<Args>(command: Command<Args, Document | Change>, args: Args): void {
    pausePlayback(this.wb);
    this.edit.preview(command, args);
  }

  private put(row: SectionRow): void {
    this.rows.push(row);
    if (row.line) this.append(row.line);
  }

  private append(line: HTMLElement): void {
    this.lines.push(line);
    // lil-gui's own are already there: move them behind the others.
    contentOf(this.section).append(line);
  }

  private addPlace(character: Character, own: Joint, joint: number): void {
    const { joints = [] } = character.skeleton ?? {};
    this.put(
      textRow(
        'Name',
        () => this.now()?.name ?? '',
        (name) => this.apply(renameJoint, { ...this.args(), name: name.trim() }),
        '',
        () => {
          const now = findCharacter(this.wb.store.document, character.id);
          return now ? nameNote(now, joint) : '';
        },
      ),
    );
    const parents = possibleParents(joints, joint).map((p) => [p, joints[p].name || jointName(undefined, p)] as const);
    if (own.parent >= 0) {
      this.put(
        choiceRow(
          'Parent',
          parents,
          () => this.now()?.parent,
          (parent) => this.apply(reparentJoint, { ...this.args(), parent }),
        ),
      );
    }
    const step = lengthStep(character.skeleton);
    this.put(
      vectorRow(
        this.context,
        'Offset',
        step,
        () => this.now()?.offset,
        (offset) => this.preview(setOffset, { ...this.args(), offset, children: this.wb.posing.rig.children.get() }),
      ),
    );
  }

  private addMotion(own: Joint): void {
    const rows = motionRows(this.context, own.motion, () => this.now()?.motion, {
      set: (motion: Motion) => {
        const character = findCharacter(this.wb.store.document, this.args().characterId);
        pausePlayback(this.wb);
        if (!character) return;
        attempt(this.wb.messages, () => changeMotions(this.wb, character, this.motionsWith(motion)));
      },
      preview: (motion: Motion) => {
        const each = this.motionsWith(motion).map((one) => ({ ...this.args(), ...one }));
        this.preview(inTurn(setMotion, `Set type of ${plural(each.length, 'joint')}`), each);
      },
    });
    for (const row of rows) this.put(row);
  }

  /** The active joint with this motion; others get its type, or if they have that already, its parameters. */
  private motionsWith(motion: Motion): readonly { readonly joint: number; readonly motion: Motion }[] {
    const { characterId, joint } = this.args();
    const all = findCharacter(this.wb.store.document, characterId)?.skeleton?.joints ?? [];
    const { kind } = motion;
    const active = all[joint]?.motion;
    const isOtherKind = !active || !isSameType(active, motion);
    const others = this.others.flatMap((other) => {
      const own = all[other]?.motion;
      if (!own) return [];
      if (isSameType(own, motion)) return isOtherKind ? [] : { joint: other, motion };
      return isOtherKind ? { joint: other, motion: motionOfKind(kind, own) } : [];
    });
    return [{ joint, motion }, ...others];
  }

  private addLimits({ id }: Character, { motion }: Joint, joint: number): void {
    const dofs = dofsOf(motion);
    if (!dofs.length || !takesLimits(motion)) return;
    this.append(heading('Limits'));
    dofs.forEach((dof, i) => {
      this.put(limitRow(this.wb, id, joint, i, dof, this.others));
    });
  }

  private addBone(character: Character, own: Joint): void {
    const step = lengthStep(character.skeleton);
    this.append(heading('Bone and box'));
    const has = { bone: own.length !== undefined };
    const row = this.section.add(has, 'bone').name('Bone along y');
    row.domElement.title =
      'Gives the joint a bone along its own y axis, with the length you set. Without it, bones lead to its children.';
    row.onChange((bone: boolean) => this.apply(setLength, { ...this.args(), length: bone ? usualLength(own) : null }));
    if (own.length !== undefined) {
      const bounds = [0, Number.POSITIVE_INFINITY] as const;
      const write = (length: number) => {
        if (length >= 0) this.preview(setLength, { ...this.args(), length });
      };
      this.put(numberRow(this.context, 'Length', step, () => this.now()?.length, write, bounds));
    }
    for (const [label, side] of [
      ['Box from', 'min'],
      ['Box to', 'max'],
    ] as const) {
      this.put(
        vectorRow(
          this.context,
          label,
          step,
          () => this.now()?.box[side],
          (corner) => {
            const box = this.now()?.box;
            if (box) this.preview(setBox, { ...this.args(), box: { ...box, [side]: corner } });
          },
          (corner) => {
            const box = this.now()?.box;
            return box && whyNoCorner(box, side, corner);
          },
        ),
      );
    }
  }

  private addCouples({ id, skeleton }: Character, own: Joint, joint: number): void {
    const dofs = dofsOf(own.motion);
    if (!dofs.length || !skeleton) return;
    this.append(heading('Follows'));
    for (const { dof: name } of own.couples ?? []) {
      const dof = dofs.find((one) => one.name === name);
      if (dof) this.put(coupleRow(this.wb, id, skeleton, joint, dof));
    }
    const add = addCoupleRow(this.wb, id, skeleton, joint);
    if (add) this.append(add);
  }

  private addPose(joint: number): void {
    this.append(heading('File pose'));
    const which = this.others.length ? 'these joints' : 'this joint';
    const take = (label: string, text: string, from: 'shown' | 'rest', of?: number) =>
      button(text, { class: 'plain', tooltip: label }, text, () => {
        const { skin, timeSeconds, characterId } = this.args();
        const joints = of === undefined ? [undefined] : [...this.others, of];
        const each = joints.map((one) => ({ characterId, skin, timeSeconds, from, joint: one }));
        this.apply(inTurn(setFilePose, `Set file pose of ${plural(each.length, 'joint')}`), each);
      });
    this.append(
      element(
        'div',
        { class: 'rig-row rig-buttons' },
        take(`Sets the file pose of ${which} to the current pose`, 'Set to current', 'shown', joint),
        take(`Sets the file pose of ${which} to zero`, 'Set to zero', 'rest', joint),
        take('Sets the file pose of all joints to the current pose', 'Set all to current', 'shown'),
      ),
    );
  }
}

/** Initial bone length: that of the joint's offset. */
function usualLength({ offset }: Joint): number {
  return Number(Math.hypot(...offset).toPrecision(4)) || 1;
}

/** What the rows depend on, apart from numbers. */
function shapeOf(wb: Uses<'settings'>, { id, skeleton }: Character, joints: readonly number[]): string {
  const own = skeleton?.joints[joints[joints.length - 1]];
  if (!skeleton || !own) return '';
  const { motion, couples = [], length } = own;
  return JSON.stringify([
    id,
    joints,
    motionShape(motion),
    couples.map(({ dof, joint: other, follows }) => [dof, other, follows]),
    length !== undefined,
    wb.settings.get().angles,
    jointsShape(skeleton.joints),
  ]);
}

/**
 * Names and hierarchy as a text. Requested for each preview of a drag, which creates a new list with the same names and
 * hierarchy: the previous text is then reused.
 */
function jointsShape(joints: Joints): string {
  if (!known || !hangAlike(known.joints, joints)) {
    const shape = JSON.stringify(joints.map(({ name, parent, motion: { kind } }) => [name, parent, kind]));
    known = { joints, shape };
  } else if (known.joints !== joints) known = { joints, shape: known.shape };
  return known.shape;
}
let known: { readonly joints: Joints; readonly shape: string } | undefined;

function hangAlike(a: Joints, b: Joints): boolean {
  if (a === b) return true;
  if (a.length !== b.length) return false;
  for (let j = 0; j < a.length; j++) {
    const [was, is] = [a[j], b[j]];
    if (was === is) continue;
    if (was.name !== is.name || was.parent !== is.parent || !isSameType(was.motion, is.motion)) return false;
  }
  return true;
}
