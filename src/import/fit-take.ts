/** Makes the channels of a take whose rotations are tracks of quaternions. */
import type { Channel, Take } from '../model/takes/take.ts';
import { type TrackedRotation, type TrackedTake, withTracks } from '../model/takes/tracked-take.ts';
import { fitRotation, SpareKeys } from './fit-rotation.ts';

/** A take whose channels are fitted when something first asks for them. */
export function takeOfTracks(take: TrackedTake): Take {
  return withTracks(take, fitChannels);
}

function fitChannels({ tracked, spareKeys }: TrackedTake): readonly Channel[] {
  const spare = new SpareKeys(spareKeys);
  const fitted = new Map<TrackedRotation, readonly Channel[]>();
  return tracked.map((channel): Channel => {
    if (channel.kind !== 'tracked') return channel;
    const { rotation, index } = channel;
    let dofs = fitted.get(rotation);
    if (!dofs) {
      dofs = fitRotation(rotation, spare);
      fitted.set(rotation, dofs);
    }
    return dofs[index];
  });
}
