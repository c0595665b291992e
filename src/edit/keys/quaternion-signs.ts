/**
 * q and −q are the same rotation, but interpolation between keys takes the short way only if they point the same way: a
 * key of a quaternion joint takes the sign nearer to the previous key.
 */

import type { Character } from '../../model/document.ts';
import { firstDofs } from '../../model/skeleton/dofs.ts';
import { quaternionDofs } from '../../model/skeleton/joint-types.ts';
import { type Channel, keysOf } from '../../model/takes/take.ts';
import type { Place } from './cycle.ts';
import { sameTime } from './same-time.ts';

/**
 * The values with the signs that keys at that time should have; the same map if none changes. Quaternions that are not
 * keyed in all four components are skipped: a single component can't change its sign.
 *
 * @param values by DOF
 * @param placeOf where a DOF's key will be put
 */
export function withNearerSigns(
  { skeleton }: Pick<Character, 'skeleton'>,
  values: ReadonlyMap<number, number>,
  placeOf: (dof: number) => Pick<Place, 'channel' | 'time'>,
): ReadonlyMap<number, number> {
  if (!skeleton?.joints.some(({ motion }) => quaternionDofs(motion).length)) return values;
  const first = firstDofs(skeleton);
  const signed = new Map(values);
  let changed = false;
  skeleton.joints.forEach(({ motion }, joint) => {
    const parts = quaternionDofs(motion).map((d) => first[joint] + d);
    if (!parts.length || !parts.every((dof) => values.has(dof))) return;
    const places = parts.map((dof) => placeOf(dof));
    if (!places.some(({ channel, time }) => keyBefore(keysOf(channel).times, time) >= 0)) return;
    const along = parts.reduce((sum, dof, i) => {
      const { channel, time } = places[i];
      return sum + (values.get(dof) ?? 0) * valueBefore(channel, time);
    }, 0);
    if (!(along < 0)) return;
    changed = true;
    for (const dof of parts) signed.set(dof, 0 - (values.get(dof) ?? 0));
  });
  return changed ? signed : values;
}

/** Index of the last key before a time, not counting one at that time, which will be replaced. */
function keyBefore(times: Float64Array, time: number): number {
  let k = times.length - 1;
  while (k >= 0 && (times[k] > time || sameTime(times[k], time))) k--;
  return k;
}

/** Its value; for a channel without keys the rest value. */
function valueBefore(channel: Channel, time: number): number {
  if (channel.kind === 'keys') return channel.values[Math.max(0, keyBefore(channel.times, time))];
  return channel.kind === 'rest' ? channel.value : 0;
}
