/**
 * The roots of one motion capture file as one character: another program prints all of its joints together. Here each
 * root is a character of its own, so none of them has as many joints as the dump.
 */

import { type Character, isBvh, shownTake } from '../../model/document.ts';
import { rootDofCount } from '../../model/skeleton/dofs.ts';
import type { Joint, Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Samples } from '../../model/takes/samples.ts';
import { restChannel, SAMPLED, type Take } from '../../model/takes/take.ts';

/** For each file with several roots, all of them as one. */
export function joinedCharacters(characters: readonly Character[]): readonly Character[] {
  const byFile = new Map<string, Character[]>();
  for (const character of characters) {
    if (!isBvh(character)) continue;
    const file = character.sources.map(({ path }) => path).join('\n');
    byFile.set(file, [...(byFile.get(file) ?? []), character]);
  }
  return [...byFile.values()].filter((roots) => roots.length > 1).map(joined);
}

function joined(roots: readonly Character[]): Character {
  const joints: Joint[] = [];
  for (const { skeleton } of roots) {
    const first = joints.length;
    joints.push(
      ...(skeleton?.joints ?? []).map((joint) => ({
        ...joint,
        parent: joint.parent < 0 ? joint.parent : joint.parent + first,
      })),
    );
  }
  const skeleton: Skeleton = { name: roots[0].skeleton?.name ?? '', joints };
  const take = joinedTake(skeleton, roots);
  const ofJoints = roots.flatMap((root) => root.pose.slice(rootDofCount(root.skeleton)));
  const pose = [...new Array<number>(rootDofCount(skeleton)).fill(0), ...ofJoints];
  return { ...roots[0], skeleton, pose, takes: take ? [take] : [], shownTake: take ? 0 : -1 };
}

/** The columns of all roots side by side, as in the file; undefined if there are no frames. */
function joinedTake(skeleton: Skeleton, roots: readonly Character[]): Take | undefined {
  const takes = roots.flatMap((root) => shownTake(root) ?? []);
  const all = takes.flatMap(({ samples }) => samples ?? []);
  const [first] = all;
  if (!first || all.some(({ frameCount }) => frameCount !== first.frameCount)) return undefined;
  const width = all.reduce((sum, { scales }) => sum + scales.length, 0);
  const values = new Float64Array(first.frameCount * width);
  let from = 0;
  for (const { values: own, scales } of all) {
    const { length } = scales;
    for (let f = 0; f < first.frameCount; f++) {
      values.set(own.subarray(f * length, (f + 1) * length), f * width + from);
    }
    from += length;
  }
  const firstChannel = rootDofCount(skeleton);
  const scales = Float64Array.from(all.flatMap((samples) => [...samples.scales]));
  const samples: Samples = { ...first, firstChannel, values, scales };
  const channels = Array.from({ length: firstChannel + width }, (_, c) => (c < firstChannel ? restChannel() : SAMPLED));
  return { ...takes[0], channels, samples };
}
