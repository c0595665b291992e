/** Keys that a character's takes lose with DOFs that a joint no longer has. */

import type { Character } from '../../model/document.ts';
import { firstDofs } from '../../model/skeleton/dofs.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import { keysOf } from '../../model/takes/take.ts';
import type { JointMap } from './joint-map.ts';

/** `3 keys of r`, `7 keys and the samples of ry and rz`; undefined if nothing is lost. */
export function lostKeys(
  { takes }: Pick<Character, 'takes'>,
  { before, dofs }: JointMap,
  joint: number,
): string | undefined {
  const kept = new Set(dofs.map(({ from }) => from));
  const first = firstDofs(before)[joint];
  const names: string[] = [];
  let keys = 0;
  let hasSamples = false;
  dofsOf(before.joints[joint].motion).forEach(({ name }, d) => {
    const dof = first + d;
    if (kept.has(dof)) return;
    const own = takes.reduce((sum, { channels }) => sum + keysOf(channels[dof]).times.length, 0);
    const sampled = takes.some(({ channels }) => channels[dof]?.kind === 'samples');
    keys += own;
    hasSamples ||= sampled;
    if (own > 0 || sampled) names.push(name);
  });
  if (names.length === 0) return undefined;
  const counted = keys > 0 ? [keys === 1 ? '1 key' : `${keys} keys`] : [];
  const what = [...counted, ...(hasSamples ? ['samples'] : [])].join(' and ');
  const last = names.pop();
  return `${what} of ${names.length ? `${names.join(', ')} and ${last}` : last}`;
}
