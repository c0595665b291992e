/** What `.bvh` calls the DOFs of a joint. */
import type { BvhChannel } from '../../model/skeleton.ts';

export const CHANNEL_NAMES: Readonly<Record<BvhChannel, string>> = {
  tx: 'Xposition',
  ty: 'Yposition',
  tz: 'Zposition',
  rx: 'Xrotation',
  ry: 'Yrotation',
  rz: 'Zrotation',
};

/** By the name in lower case. */
export const CHANNELS_BY_NAME: ReadonlyMap<string, BvhChannel> = new Map(
  // `Object.entries` forgets the keys' type.
  Object.entries(CHANNEL_NAMES).map(([channel, name]) => [name.toLowerCase(), channel as BvhChannel]),
);
