/**
 * Gives a character another skeleton and remaps everything that refers to joints or DOFs: skins, takes, pose, unkeyed
 * changes, pose library, IK settings, sets, locks, limbs with their goals and retargeting. Links belong to the skeleton
 * (`joint-map.ts`). Unchanged parts keep their identity.
 */
import type { Character, Document } from '../../model/document.ts';
import { defaultIk } from '../../model/ik.ts';
import { remapLimbs } from '../../model/limbs.ts';
import { remapSets } from '../../model/sets.ts';
import { layerCode } from '../../model/takes/layer-code.ts';
import { changeCharacter } from '../characters.ts';
import { sameValue } from '../delta.ts';
import { withSourcePairs } from '../follow/code.ts';
import { withoutUnkeyed } from '../unkeyed.ts';
import { remapIk, remapPairs, withIk } from './by-joint.ts';
import { valueAfter } from './dof-sources.ts';
import type { JointMap } from './joint-map.ts';
import { remapSkin } from './remap-skin.ts';
import { remapTake } from './remap-take.ts';

/** The document with that character's skeleton changed, from which `map` was made. */
export function withSkeletonChanged(document: Document, characterId: string, map: JointMap): Document {
  const next = changeCharacter(document, characterId, (character) => remapped(character, map));
  if (map.keepsJoints) return next;
  const characters = withSourcePairs(next.characters, characterId, map.before, map.to);
  return characters === next.characters ? next : { ...next, characters };
}

function remapped(character: Character, map: JointMap): Character {
  const { takes, skins } = character;
  const next: Character = {
    ...character,
    skeleton: map.after,
    skins: mapped(skins, (skin) => remapSkin(skin, map)),
  };
  return withJoints(
    withLimbs(
      map.keepsDofs
        ? next
        : withDofs({ ...next, takes: mapped(takes, (take) => remapTake(take, map, character.pose)) }, map),
      map,
    ),
    map,
  );
}

/** Remaps limbs, and the spaces of goals by the names that joints now have. What is no limb any more is not moved. */
function withLimbs(character: Character, { before, after, to }: JointMap): Character {
  const { limbs, takes } = character;
  if (!limbs) return character;
  const moved = mapped(takes, (take) => (take.goals ? layerCode(take).remapGoals(take, before, after, to) : take));
  return { ...character, limbs: remapLimbs(limbs, to), takes: moved };
}

/** The previous object if it is equal. */
function sharing<T>(next: T, before: T | undefined): T {
  return before !== undefined && sameValue(next, before) ? before : next;
}

/** Equal items keep their identity, and so does the list if all are equal. */
function mapped<T>(list: readonly T[], change: (item: T) => T): readonly T[] {
  const next = list.map((item) => sharing(change(item), item));
  return next.every((item, i) => item === list[i]) ? list : next;
}

function withDofs(character: Character, map: JointMap): Character {
  const { morphs, poses } = character;
  return {
    ...withUnkeyedMoved(character, map),
    pose: values(character.pose, map, morphs.length),
    ...(poses && { poses: mapped(poses, (pose) => ({ ...pose, values: values(pose.values, map, morphs.length) })) }),
  };
}

/** Converts a list with a value per old DOF to the new DOFs; new ones get their initial value. */
function values(before: readonly number[], { dofs, dofsBefore }: JointMap, morphCount: number): readonly number[] {
  const joints = dofs.map((source) => {
    const { from, start, like } = source;
    if (from >= 0) return before[from] === undefined ? start : valueAfter(source, before[from]);
    // Adding 0 avoids −0 in files.
    return like ? (before[like.dof] ?? start) * like.sign + 0 : start;
  });
  return [...joints, ...Array.from({ length: morphCount }, (_, m) => before[dofsBefore + m] ?? 0)];
}

function withUnkeyedMoved(character: Character, { dofs, dofsBefore }: JointMap): Character {
  const { unkeyed } = character;
  if (!unkeyed) return character;
  const kept: (readonly [number, number])[] = [];
  const by = new Map(unkeyed.dofs.map((dof, i) => [dof, unkeyed.values[i]]));
  dofs.forEach((source, dof) => {
    const value = by.get(source.from);
    if (value !== undefined) kept.push([dof, valueAfter(source, value)]);
  });
  for (const [dof, value] of by) if (dof >= dofsBefore) kept.push([dof - dofsBefore + dofs.length, value]);
  if (kept.length === 0) return withoutUnkeyed(character);
  kept.sort(([a], [b]) => a - b);
  return {
    ...character,
    unkeyed: sharing({ ...unkeyed, dofs: kept.map(([dof]) => dof), values: kept.map(([, value]) => value) }, unkeyed),
  };
}

/** Remaps what refers to joints. If the axis-angle form is lost, the effective `rootIsFree` is kept. */
function withJoints(character: Character, { keepsJoints, before, to }: JointMap): Character {
  const { ik, driver, sets, skeleton } = character;
  const keepsForm = before.form === skeleton?.form;
  if (keepsJoints && keepsForm) return character;
  const moved = driver && sharing({ ...driver, pairs: remapPairs(driver.pairs, 'target', to) }, driver);
  const next = keepsJoints
    ? character
    : { ...character, ...(moved && { driver: moved }), ...(sets && { sets: remapSets(sets, to) }) };
  return ik || !keepsForm ? withIk(next, sharing(remapIk(ik ?? defaultIk(before), to), ik)) : next;
}
