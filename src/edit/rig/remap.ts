/**
 * A character with another skeleton, and all of it that goes by joint or DOF taken along: skins, clips, the pose, what
 * is set by hand, named poses, what inverse kinematics holds on to, and takes of others put onto it. Couples are the
 * skeleton's own (`joint-map.ts`). What did not change keeps its identity.
 */
import type { Character, Document } from '../../model/document.ts';
import type { IkSetup } from '../../model/ik.ts';
import type { JointPair } from '../../model/retarget.ts';
import { changeCharacter } from '../characters.ts';
import { driverSource } from '../drivers.ts';
import { withoutUnkeyed } from '../unkeyed.ts';
import type { JointMap } from './joint-map.ts';
import { remapClip } from './remap-clip.ts';
import { remapSkin } from './remap-skin.ts';

/** The document with that character's skeleton changed, which is the one that `map` comes from. */
export function withSkeletonChanged(document: Document, characterId: string, map: JointMap): Document {
  const next = changeCharacter(document, characterId, (character) => remapped(character, map));
  return map.keepsJoints ? next : withSourcePairs(next, characterId, map);
}

function remapped(character: Character, map: JointMap): Character {
  const { clips, skins } = character;
  const next: Character = {
    ...character,
    skeleton: map.after,
    skins: mapped(skins, (skin) => remapSkin(skin, map)),
  };
  return withJoints(
    map.keepsDofs
      ? next
      : withDofs({ ...next, clips: mapped(clips, (clip) => remapClip(clip, map, character.pose)) }, map),
    map,
  );
}

/** The very list where no item changes. */
function mapped<T>(list: readonly T[], change: (item: T) => T): readonly T[] {
  const next = list.map(change);
  return next.every((item, i) => item === list[i]) ? list : next;
}

function withDofs(character: Character, map: JointMap): Character {
  const { morphs, poses } = character;
  return {
    ...withUnkeyedMoved(character, map),
    pose: values(character.pose, map, morphs.length),
    ...(poses && { poses: poses.map((pose) => ({ ...pose, values: values(pose.values, map, morphs.length) })) }),
  };
}

/** One value for each DOF after, of one for each before; what had none stands where a new one begins. */
function values(before: readonly number[], { dofs, dofsBefore }: JointMap, morphCount: number): readonly number[] {
  const joints = dofs.map(({ from, plus, start, like }) => {
    if (from >= 0) return (before[from] ?? start) + plus;
    return like ? (before[like.dof] ?? start) * like.sign : start;
  });
  return [...joints, ...Array.from({ length: morphCount }, (_, m) => before[dofsBefore + m] ?? 0)];
}

function withUnkeyedMoved(character: Character, { dofs, dofsBefore }: JointMap): Character {
  const { unkeyed } = character;
  if (!unkeyed) return character;
  const kept: (readonly [number, number])[] = [];
  const by = new Map(unkeyed.dofs.map((dof, i) => [dof, unkeyed.values[i]]));
  dofs.forEach(({ from, plus }, dof) => {
    const value = by.get(from);
    if (value !== undefined) kept.push([dof, value + plus]);
  });
  for (const [dof, value] of by) if (dof >= dofsBefore) kept.push([dof - dofsBefore + dofs.length, value]);
  if (kept.length === 0) return withoutUnkeyed(character);
  kept.sort(([a], [b]) => a - b);
  return {
    ...character,
    unkeyed: {
      timeSeconds: unkeyed.timeSeconds,
      dofs: kept.map(([dof]) => dof),
      values: kept.map(([, value]) => value),
    },
  };
}

function withJoints(character: Character, map: JointMap): Character {
  const { ik, driver } = character;
  if (map.keepsJoints) return character;
  return {
    ...character,
    ...(ik && { ik: remapIk(ik, map.to) }),
    ...(driver && { driver: { ...driver, pairs: remapPairs(driver.pairs, 'target', map.to) } }),
  };
}

function remapIk({ pins, stiff, rootIsFree }: IkSetup, to: Int32Array): IkSetup {
  const moved = <T extends { readonly joint: number }>(all: readonly T[]) =>
    all.flatMap((one) => (to[one.joint] >= 0 ? [{ ...one, joint: to[one.joint] }] : []));
  return { pins: moved(pins), stiff: moved(stiff).sort((a, b) => a.joint - b.joint), rootIsFree };
}

function remapPairs(pairs: readonly JointPair[], side: 'target' | 'source', to: Int32Array): readonly JointPair[] {
  const kept = pairs.flatMap((pair) => (to[pair[side]] >= 0 ? [{ ...pair, [side]: to[pair[side]] }] : []));
  return kept.sort((a, b) => a.target - b.target);
}

/**
 * Others that this one's take moves follow joints of its skeleton by index. They have its new skeleton and their new
 * pairs in one; a driver that no longer follows it (`edit/drivers.ts`) keeps both as they were.
 */
function withSourcePairs(document: Document, characterId: string, { before, to }: JointMap): Document {
  const isMoved = ({ driver }: Character) => driver?.sourceId === characterId && driver.source.skeleton === before;
  if (!document.characters.some(isMoved)) return document;
  const changed = document.characters.find((c) => c.id === characterId);
  const source = changed && driverSource(changed);
  if (!source) return document;
  const characters = document.characters.map((c) =>
    c.driver && isMoved(c)
      ? { ...c, driver: { ...c.driver, source, pairs: remapPairs(c.driver.pairs, 'source', to) } }
      : c,
  );
  return { ...document, characters };
}
