/**
 * Makes the channels of takes that come without them (`tracked-takes.ts`): in the worker those that are asked for at
 * once.
 */
import { takeOfTracks } from '../import/fit-take.ts';
import type { WholeCharacter } from '../model/files.ts';
import { firstTake } from '../model/takes/moving.ts';
import {
  type TrackedDof,
  type TrackedRotation,
  type TrackedTake,
  type TrackNumbers,
  trackedOf,
} from '../model/takes/tracked-take.ts';
import { type HasTakes, type PostedTake, withTakes } from './tracked-takes.ts';

/** Keys of rotations that are fitted in some 10 ms: the channels of takes with more are made in the worker. */
const MAX_KEYS = 5_000;

/** The character of a message, as it was before. */
export function fromMessage<C extends HasTakes>(character: C): C {
  return withTakes(character, (take: PostedTake) => {
    const { channels, tracked, spareKeys, ...head } = take;
    return tracked && spareKeys !== undefined ? takeOfTracks({ ...head, tracked, spareKeys }) : take;
  });
}

/**
 * A character as the page gets it; the same object if it needs nothing. The worker makes the channels that the page
 * would ask for at once, or that would hold it up later: of the take that is shown first, of those that have no frame
 * rate but that of their keys, which lists of takes show, and of long ones. The tracks of all others are moved into one
 * buffer, since they are parts of the file's.
 */
export function settledTakes(character: WholeCharacter): WholeCharacter {
  const { takes } = character;
  const shown = takes[firstTake(takes)];
  const later = takes.map((take) => {
    const source = take === shown || take.framesPerSecond === undefined ? undefined : trackedOf(take);
    return source && keyCount(source) <= MAX_KEYS ? source : undefined;
  });
  const moved = movedTogether(later.flatMap((source) => source ?? [])).values();
  return withTakes(character, (take, i) => {
    const source = later[i] && moved.next().value;
    if (source) return takeOfTracks(source);
    // A copy is an ordinary take.
    return trackedOf(take) ? { ...take } : take;
  });
}

function keyCount({ tracked }: TrackedTake): number {
  let count = 0;
  for (const channel of tracked) {
    if (channel.kind === 'tracked' && channel.index === 0) count += channel.rotation.track.times.length;
  }
  return count;
}

/** The takes with all numbers of their tracks in one buffer. */
function movedTogether(takes: readonly TrackedTake[]): readonly TrackedTake[] {
  const rotations = new Set<TrackedRotation>();
  for (const { tracked } of takes) {
    for (const channel of tracked) if (channel.kind === 'tracked') rotations.add(channel.rotation);
  }
  const copyOf = copiesOf([...rotations].flatMap(({ track: { times, values } }) => [times, values]));
  const moved = new Map<TrackedRotation, TrackedRotation>();
  for (const rotation of rotations) {
    const { track } = rotation;
    moved.set(rotation, { ...rotation, track: { ...track, times: copyOf(track.times), values: copyOf(track.values) } });
  }
  const movedDof = (dof: TrackedDof): TrackedDof => ({ ...dof, rotation: moved.get(dof.rotation) ?? dof.rotation });
  return takes.map((take) => ({
    ...take,
    tracked: take.tracked.map((channel) => (channel.kind === 'tracked' ? movedDof(channel) : channel)),
  }));
}

/** Copies lists into one buffer, each once. */
function copiesOf(lists: readonly TrackNumbers[]): <A extends TrackNumbers>(list: A) => A {
  const copies = new Map<TrackNumbers, TrackNumbers>();
  const distinct = new Set(lists);
  // Doubles are at multiples of their size.
  const size = ({ byteLength }: TrackNumbers) => Math.ceil(byteLength / 8) * 8;
  const buffer = new ArrayBuffer([...distinct].reduce((sum, list) => sum + size(list), 0));
  let at = 0;
  for (const list of distinct) {
    const Numbers = list instanceof Float32Array ? Float32Array : Float64Array;
    const copy = new Numbers(buffer, at, list.length);
    copy.set(list);
    copies.set(list, copy);
    at += size(list);
  }
  // A copy has the type of its list.
  return <A extends TrackNumbers>(list: A) => copies.get(list) as A;
}
