/** Which of a character's channels rotate one joint together, and the Euler filter for all of them. */
import { turnedDofs, turningDofs } from '../../evaluate/rotations/euler-dofs.ts';
import type { Character } from '../../model/document.ts';
import { couplesOf } from '../../model/skeleton/couples.ts';
import { characterDofs, firstDofs } from '../../model/skeleton/dofs.ts';
import { jointName } from '../../model/skeleton/joint-name.ts';
import type { Channel, KeyedChannel } from '../../model/takes/take.ts';
import { filterRotations, keyedTogether, keysChanged, type Triple, unrollAngle } from './euler-filter.ts';

/** Channels after the Euler filter. */
export interface Filtered {
  /** All of the take's channels; unchanged ones keep their identity. */
  readonly channels: readonly Channel[];
  readonly keysChanged: number;
  /** Sentences on what was not done, and why. */
  readonly notes: readonly string[];
}

/** Filters the given channels of a character. If its limits are enforced, no key leaves them. */
export function filterCharacter(
  { skeleton, morphs, clampsToLimits, name }: Character,
  channels: readonly Channel[],
  given: readonly number[],
): Filtered {
  const dofs = characterDofs(skeleton, morphs);
  const starts = skeleton ? firstDofs(skeleton) : [];
  const couples = skeleton ? couplesOf(skeleton).ordered : [];
  const followed = new Set(couples.map((couple) => couple.follows));
  const following = new Set(couples.map((couple) => couple.dof));
  const filtered = [...channels];
  const notes: string[] = [];
  const done = new Set<number>();
  /** Joints that already have a note. */
  const noted = new Set<number>();
  for (const index of given) {
    const dof = dofs[index];
    if (done.has(index)) continue;
    const joint = dof && skeleton?.joints[dof.joint];
    if (dof?.unit !== 'angle' || !joint) {
      notes.push(`${dof ? dof.name : `Channel ${index}`} is not an angle; left unchanged.`);
      continue;
    }
    const first = starts[dof.joint];
    if (followed.has(index) || !turningDofs(joint.motion)[index - first]) {
      const why = followed.has(index) ? 'another DOF is linked to it' : 'a full turn of it is a different pose';
      notes.push(`${dof.name} of ${jointName(skeleton, dof.joint)}: ${why}; left unchanged.`);
      done.add(index);
      continue;
    }
    const angles = turnedDofs(joint.motion);
    if (angles) {
      const together = [first + angles.x, first + angles.y, first + angles.z];
      const limits = together.map((i) => dofs[i].limit);
      const isCoupled = together.some((i) => followed.has(i) || following.has(i));
      const rotation = isCoupled ? 'its angles are linked' : rotationOf(filtered, given, together);
      if (typeof rotation !== 'string') {
        const made = filterRotations(rotation, angles.order, clampsToLimits ? limits : []);
        made.forEach((channel, i) => {
          filtered[together[i]] = channel;
          done.add(together[i]);
        });
        continue;
      }
      if (!noted.has(dof.joint)) {
        notes.push(`${joint.name || `Joint ${dof.joint}`} of ${name}: ${rotation}; only full turns were removed.`);
      }
      noted.add(dof.joint);
    }
    done.add(index);
    const angle = filtered[index];
    if (angle.kind === 'keys') filtered[index] = unrollAngle(angle, clampsToLimits ? dof.limit : undefined);
  }
  return { channels: filtered, keysChanged: keysChanged(channels, filtered), notes };
}

/** Three angles that form a rotation, or why they don't. */
function rotationOf(
  channels: readonly Channel[],
  given: readonly number[],
  together: readonly number[],
): Triple<KeyedChannel> | string {
  if (together.some((i) => !given.includes(i))) return 'not all three of its angles are selected';
  const [x, y, z] = together.map((i) => channels[i]);
  if (x?.kind !== 'keys' || y?.kind !== 'keys' || z?.kind !== 'keys') return 'not all three of its angles have keys';
  return keyedTogether([x, y, z]) ? [x, y, z] : 'its angles have keys at different times';
}
