/**
 * Which joint follows which in retargeting, from a file: a line for each joint of the target, with the source joint
 * that it follows.
 *
 *     target,source              a header, which may be left out
 *     Hips,mixamorig:Hips
 *     LeftUpLeg,mixamorig:LeftUpLeg
 */
import { CommandError } from '../edit/command-error.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import type { JointPair } from '../model/takes/retarget.ts';

/** Names of joints: the target's, and the source's that it follows. */
export type JointMap = readonly (readonly [target: string, source: string])[];

/**
 * Reads which joint follows which from a text.
 * @throws CommandError, in a sentence, naming the line
 */
export function readJointMap(text: string, file: string): JointMap {
  const map = new Map<string, string>();
  text
    .replace(/^\ufeff/, '')
    .split(/\r\n|\n|\r/)
    .forEach((row, i) => {
      const [target, source, ...more] = row.split(/[,;\t]/).map((cell) => cell.trim());
      if (target === '' && source === undefined) return;
      if (!target || !source || more.length > 0) {
        throw new CommandError(`${file}:${i + 1}: Expected two names, "target,source", found "${row}".`);
      }
      if (map.size === 0 && target.toLowerCase() === 'target' && source.toLowerCase() === 'source') return;
      if (map.has(target)) throw new CommandError(`${file}:${i + 1}: ${target} can only follow one joint.`);
      map.set(target, source);
    });
  if (map.size === 0) throw new CommandError(`${file}: Expected lines "target,source", found none.`);
  return [...map];
}

/** In the order of the target's joints. @throws CommandError if a joint is in neither skeleton, or twice in one */
export function pairsOf(map: JointMap, target: Skeleton, source: Skeleton): readonly JointPair[] {
  return map
    .map(([to, from]) => ({ target: jointNamed(target, to, 'target'), source: jointNamed(source, from, 'take') }))
    .sort((a, b) => a.target - b.target);
}

function jointNamed({ joints }: Skeleton, name: string, whose: string): number {
  const at = joints.findIndex((joint) => joint.name === name);
  if (at < 0) throw new CommandError(`The map names ${name}, which is not a joint of the ${whose}.`);
  if (joints.findLastIndex((joint) => joint.name === name) !== at) {
    throw new CommandError(`The map names ${name}, but several joints of the ${whose} have that name.`);
  }
  return at;
}
