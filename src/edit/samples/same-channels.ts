/**
 * Another character's frames in the order of one's own channels: takes of the same skeleton, by names. Joints may be in
 * another order; each must have the same DOFs, or its numbers would mean something else.
 */
import { isSameSkeleton, matchJoints } from '../../evaluate/compare/joint-match.ts';
import { metresPerUnit } from '../../evaluate/space/metres.ts';
import type { Character } from '../../model/document.ts';
import { characterDofs, firstDofs, rootDofCount } from '../../model/skeleton/dofs.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { DEFAULT_SPACE } from '../../model/space.ts';
import type { Samples } from '../../model/takes/samples.ts';
import { CommandError } from '../command-error.ts';
import { sameValue } from '../delta.ts';

/**
 * Samples in the channels of the target; the same object if these agree already. Refuses other skeletons, units and up
 * axes.
 */
export function inChannelsOf(target: Character, source: Character, samples: Samples): Samples {
  if (target === source) return samples;
  const [own, theirs] = [target.skeleton, source.skeleton];
  if (!own || !theirs) throw new CommandError('Only takes of characters with a skeleton can be joined.');
  refuseOtherSpace(target, source);
  const from = sourcesOf(target, own, source, theirs);
  if (from.every((c, k) => c === k) && from.length === samples.scales.length) return samples;
  const width = from.length;
  const { frameCount, scales } = samples;
  const values = new Float64Array(frameCount * width);
  for (let f = 0; f < frameCount; f++) {
    for (let k = 0; k < width; k++)
      values[f * width + k] = from[k] < 0 ? 0 : samples.values[f * scales.length + from[k]];
  }
  return { ...samples, values, scales: Float64Array.from(from, (c) => (c < 0 ? 1 : scales[c])) };
}

function refuseOtherSpace(target: Character, source: Character): void {
  const [a, b] = [target.space ?? DEFAULT_SPACE, source.space ?? DEFAULT_SPACE];
  const [own, theirs] = [metresPerUnit(a), metresPerUnit(b)];
  if (a.up === b.up && Math.abs(own - theirs) <= 1e-9 * own) return;
  throw new CommandError(
    `${target.name} and ${source.name} have different units or up axes. Set the same for both in the Character section, or retarget one to the other and bake it.`,
  );
}

/** The source's channel for each of the target's; −1 for a morph that it doesn't have. */
function sourcesOf(target: Character, own: Skeleton, source: Character, theirs: Skeleton): number[] {
  const match = matchJoints(own, theirs);
  const other = `${source.name} and ${target.name} have different joints. Retarget one to the other and bake it first.`;
  if (!isSameSkeleton(match) || rootDofCount(own) !== rootDofCount(theirs)) throw new CommandError(other);
  const [first, second] = [firstDofs(own), firstDofs(theirs)];
  const from = Array.from({ length: characterDofs(own, target.morphs).length }, (_, c) => c);
  match.first.forEach((j, i) => {
    const k = match.second[i];
    const { motion, name } = own.joints[j];
    if (!sameValue(motion, theirs.joints[k].motion)) {
      throw new CommandError(
        `${name} has different DOFs in ${source.name} and ${target.name}. Retarget one to the other and bake it first.`,
      );
    }
    dofsOf(motion).forEach((_, d) => {
      from[first[j] + d] = second[k] + d;
    });
  });
  const joints = characterDofs(own, []).length;
  target.morphs.forEach(({ name }, m) => {
    const found = source.morphs.findIndex((morph) => morph.name === name);
    from[joints + m] = found < 0 ? -1 : joints + found;
  });
  return from;
}
