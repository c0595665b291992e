/**
 * Creating and editing skeletons: adding, reparenting, removing and mirroring joints. Everything that refers to joints
 * and DOFs is updated (`rig/remap.ts`), and the skin stays or follows as requested (`rig/rigging.ts`).
 */

import type { Document } from '../../model/document.ts';
import { EMPTY_DOCUMENT } from '../../model/document.ts';
import { newCharacter } from '../../model/new-character.ts';
import { AXIS_LETTERS } from '../../model/skeleton/dof-axis.ts';
import { jointName } from '../../model/skeleton/joint-name.ts';
import { indexIn } from '../arguments.ts';
import type { Edit } from '../change.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { cutName, SHORT_NAME } from '../cut-name.ts';
import { placeBeside } from '../place-beside.ts';
import { boundAnew, calledIn, findJoint, rigged } from '../rig/apply.ts';
import { withTakenUp } from '../rig/bind.ts';
import { changedTree } from '../rig/joint-map.ts';
import { mirrored } from '../rig/mirror.ts';
import { childName, freeName } from '../rig/names.ts';
import { continued, endedAt, newChild, newRoot } from '../rig/new-joint.ts';
import { type Kept, keepPlaces } from '../rig/places.ts';
import { SKIN_MODES } from '../rig/rigging.ts';
import { type Branch, branchesOf } from '../rig/tree.ts';
import { filledText, index, number, oneOf, optional, text } from '../schema/shape.ts';
import { JOINT, RIGGING, vector } from '../schema/shared-shapes.ts';
import { characterIn } from '../step-names.ts';
import { withSkeleton } from '../with-skeleton.ts';
import { clearLimit, setLimit } from './limits.ts';

/** A new character of one joint; or the first joint of a character that has a skin or a take but no skeleton yet. */
export const createRig = command({
  id: 'rig.create',
  args: {
    /** Name of the character; default `character`. */
    name: optional(filledText),
    /** A character without a skeleton; default: a new one. */
    characterId: optional(text),
    /** `stays`: its skin is bound to the root in place; `follows`: as its file says. Default `follows`. */
    skin: optional(oneOf(SKIN_MODES)),
  },
  makesCharacter: true,
  label: (document, { characterId, name }) =>
    characterId === undefined
      ? `New skeleton ${cutName(newName(document, name))}`
      : `Create skeleton of ${characterIn(document, characterId)}`,
  run(document, { name, characterId, skin = 'follows' }) {
    const stays = skin === 'stays';
    if (characterId !== undefined) return begun(document, characterId, stays);
    const base = withoutExample(document);
    const { charactersMade } = base;
    const id = `c${charactersMade + 1}`;
    const own = newName(document, name);
    const made = withSkeleton(newCharacter(id, own), { name: own, joints: [newRoot('root')] });
    const placed = { ...made, placements: [placeBeside(base.characters, made)] };
    const next = { ...base, characters: [...base.characters, placed], charactersMade: charactersMade + 1 };
    return { document: next, keys: [], selected: { characterId: id, joint: 0 } };
  },
});

/** The document that a new character is added to: it replaces the unchanged opening example, as opening files does. */
function withoutExample(document: Document): Document {
  const { unused, charactersMade } = document;
  return document.isOpeningSample === true ? { ...EMPTY_DOCUMENT, unused, charactersMade } : document;
}

function newName(document: Document, name: string | undefined): string {
  return name ?? freeName(namesIn(withoutExample(document)), 'character', '');
}

/** Names of its characters and of their skeletons, which files are named after. */
function namesIn({ characters }: Document): ReadonlySet<string> {
  return new Set(characters.flatMap(({ name, skeleton }) => (skeleton ? [name, skeleton.name] : [name])));
}

function begun(document: Document, characterId: string, stays: boolean): Edit {
  const { skeleton, name } = requireCharacter(document, characterId);
  if (skeleton) throw new CommandError(`${name} already has a skeleton. Add joints to it.`);
  const next = changeCharacter(document, characterId, (c) => {
    const made = withSkeleton(c, { name: c.name, joints: [newRoot('root')] });
    return stays ? withTakenUp(made, 0, 0) : made;
  });
  return { document: next, keys: [], selected: { characterId, joint: 0 } };
}

/**
 * Appends a child to the parent. The first child of a joint that ends in an End Site replaces that, and in the
 * axis-angle form it starts at its parent's tip.
 */
export const addJoint = command({
  id: 'rig.addJoint',
  args: {
    ...RIGGING,
    parent: index,
    /** May be empty; default: the parent's with the next number, or `joint3` and the like. */
    name: optional(text),
    /** In the parent's space; default: continues the parent's bone. */
    offset: optional(vector),
  },
  label: (document, { characterId, parent }) => `Add joint under ${calledIn(document, characterId, parent)}`,
  run(document, args) {
    const { characterId, parent, offset } = args;
    const { character, skeleton } = findJoint(document, characterId, parent);
    const isNameless = skeleton.form === 'axis-angle';
    const name = args.name ?? (isNameless ? '' : childName(skeleton, parent));
    const joint = newChild(character, skeleton, parent, name, offset);
    const branches = branchesOf(skeleton);
    const above = branches[parent];
    const made: Branch = { origin: -1, joint, children: [] };
    if (above.children.length === 0) above.joint = continued(above.joint);
    above.children.push(made);
    const map = changedTree(skeleton, branches[0]);
    return rigged(document, args, map, map.origins.indexOf(-1));
  },
});

/**
 * Moves a joint with its descendants to another parent or another place among its siblings. Its pivot stays in place in
 * the displayed pose, and so does its rotation, if its DOFs can represent that exactly within their limits and nothing
 * drives them (keys, samples, retargeting, a link); otherwise it rotates with its new parent. It keeps its channels.
 */
export const reparentJoint = command({
  id: 'rig.reparent',
  args: {
    ...JOINT,
    /** The new parent. */
    parent: index,
    /** The child to insert it before; default: as the last. */
    before: optional(index),
  },
  label: (document, { characterId, joint, parent }) =>
    `Parent ${calledIn(document, characterId, joint, SHORT_NAME)} to ${calledIn(document, characterId, parent, SHORT_NAME)}`,
  run(document, args) {
    const { characterId, joint: index, parent, before } = args;
    const { character, skeleton, joint } = findJoint(document, characterId, index);
    const { joints } = skeleton;
    indexIn(parent, 0, joints.length, 'joint');
    if (index === 0) throw new CommandError(`${jointName(skeleton, 0)} is the root, which can’t have a parent.`);
    for (let above = parent; above >= 0; above = joints[above].parent) {
      if (above !== index) continue;
      throw new CommandError(
        `${jointName(skeleton, index)} can’t be parented to its descendant ${jointName(skeleton, parent)}.`,
      );
    }
    if (before !== undefined) {
      indexIn(before, 0, joints.length, 'joint');
      if (joints[before].parent !== parent) {
        throw new CommandError(`${jointName(skeleton, before)} is not a child of ${jointName(skeleton, parent)}.`);
      }
      if (before === index) return document;
    }
    const branches = branchesOf(skeleton);
    const [own, from, to] = [branches[index], branches[joint.parent], branches[parent]];
    from.children = from.children.filter((child) => child !== own);
    const at = before === undefined ? to.children.length : to.children.indexOf(branches[before]);
    to.children.splice(at, 0, own);
    if (from.children.length === 0) from.joint = endedAt(character, from.joint, joint.offset);
    const map = changedTree(skeleton, branches[0]);
    if (parent === joint.parent && map.keepsJoints) return document;
    const now = map.to[index];
    const kept = parent === joint.parent ? [] : [{ joint: now, origin: index }];
    return rigged(document, args, map, now, (next) => keepPlaces(next, character, kept, args.timeSeconds ?? 0));
  },
});

/**
 * Removes a joint, with its descendants, or reparents its children to its parent, in place (`rig.reparent`). Vertices
 * are reassigned to the nearest remaining ancestor.
 */
export const removeJoint = command({
  id: 'rig.remove',
  args: {
    ...JOINT,
    children: oneOf(['too', 'stay']),
  },
  label(document, { characterId, joint, children }) {
    const name = calledIn(document, characterId, joint);
    return children === 'too' ? `Delete ${name} and its descendants` : `Delete ${name}`;
  },
  run(document, args) {
    const { characterId, joint: index } = args;
    const { character, skeleton, joint } = findJoint(document, characterId, index);
    const staying = args.children === 'stay';
    const branches = branchesOf(skeleton);
    const own = branches[index];
    const children = staying ? own.children : [];
    let root = branches[0];
    if (index === 0) {
      if (children.length !== 1) throw new CommandError(rootStays(staying, own.children.length));
      [root] = children;
    } else {
      const above = branches[joint.parent];
      const at = above.children.indexOf(own);
      above.children.splice(at, 1, ...children);
      if (above.children.length === 0) above.joint = endedAt(character, above.joint, joint.offset);
    }
    const map = changedTree(skeleton, root);
    const kept = children.map(({ origin }): Kept => ({ joint: map.to[origin], origin }));
    return rigged(document, args, map, map.heirs[index], (next) =>
      keepPlaces(next, character, kept, args.timeSeconds ?? 0),
    );
  },
});

function rootStays(staying: boolean, children: number): string {
  if (!staying || children === 0) return 'The root can’t be deleted. Remove the character instead.';
  return `The root has ${children} children. It can only be deleted when it has exactly one, which then becomes the root.`;
}

/**
 * Mirrors a joint with its descendants across a plane through the root: creates the other side, or updates it (offset,
 * motion, limits, box, links; its pose and keys are kept). Sides in names are swapped. Weights are not mirrored.
 */
export const mirrorJoint = command({
  id: 'rig.mirror',
  args: {
    ...JOINT,
    /** The axis of the root's space that is mirrored. */
    across: oneOf(AXIS_LETTERS),
  },
  label: (document, { characterId, joint }) => `Mirror ${calledIn(document, characterId, joint)}`,
  run(document, args) {
    const { characterId, joint } = args;
    const { skeleton } = findJoint(document, characterId, joint);
    const across = AXIS_LETTERS.indexOf(args.across);
    const { map, other, couple } = mirrored(skeleton, joint, across);
    const edit = rigged(document, args, map, other, (next) => couple(next, characterId));
    const now = requireCharacter(edit.document, characterId).skeleton;
    return now && sameJoints(now.joints, skeleton.joints) ? document : edit;
  },
});

function sameJoints(a: readonly object[], b: readonly object[]): boolean {
  return a.length === b.length && a.every((joint, j) => joint === b[j]);
}

/** Limits: if they move a joint in the displayed pose, skins may be rebound. */
export const limitRigged = command({
  id: 'rig.setLimit',
  args: { ...RIGGING, dof: index, min: number, max: number },
  label: setLimit.label,
  run: (document, args) => boundAnew(document, args, setLimit.runRead(document, args)),
});

/** Removes the limits of a DOF, and rebinds skins if asked to. */
export const clearLimitRigged = command({
  id: 'rig.clearLimit',
  args: { ...RIGGING, dof: index },
  label: clearLimit.label,
  run: (document, args) => boundAnew(document, args, clearLimit.runRead(document, args)),
});
