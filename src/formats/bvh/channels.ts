/** Names of a joint's DOFs in `.bvh`. */
import type { BvhChannel } from '../../model/skeleton/skeleton.ts';

/** The `.bvh` name of each channel. */
export const CHANNEL_NAMES: Readonly<Record<BvhChannel, string>> = {
  tx: 'Xposition',
  ty: 'Yposition',
  tz: 'Zposition',
  rx: 'Xrotation',
  ry: 'Yrotation',
  rz: 'Zrotation',
};

/** By lower-case name. */
export const CHANNELS_BY_NAME: ReadonlyMap<string, BvhChannel> = new Map(
  // `Object.entries` loses the keys' type.
  Object.entries(CHANNEL_NAMES).map(([channel, name]) => [name.toLowerCase(), channel as BvhChannel]),
);
