/**
 * q and −q turn alike, but the way from one key to the next is the short one only where they point the same way: a key
 * of a quaternion joint takes the sign that is nearer to the key before it.
 */
import { type Channel, keysOf } from '../../model/clip.ts';
import type { Character } from '../../model/document.ts';
import { firstDofs } from '../../model/dofs.ts';
import { quaternionDofs } from '../../model/joint-types.ts';
import type { Place } from './cycle.ts';
import { sameTime } from './same-time.ts';

/**
 * The values with the signs that keys at that time should have; the same map where none changes. A quaternion of which
 * not all four parts are to be keyed is left: a part by itself has no other sign.
 *
 * @param values by DOF
 * @param placeOf where a DOF's key is going to be
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

/** Index of the last key before a time; a key at that time is the one that is about to be put. */
function keyBefore(times: Float64Array, time: number): number {
  let k = times.length - 1;
  while (k >= 0 && (times[k] > time || sameTime(times[k], time))) k--;
  return k;
}

/** Its value; of a channel without keys, what it stands at. */
function valueBefore(channel: Channel, time: number): number {
  if (channel.kind === 'keys') return channel.values[Math.max(0, keyBefore(channel.times, time))];
  return channel.kind === 'rest' ? channel.value : 0;
}
