/**
 * Channels in sessions kept by earlier versions. They had no kind: a channel without keys had empty columns, followed
 * the samples if they had a column for it, and else stayed at its `rest`.
 */
import { type Channel, type ChannelClip, followingSamples, NO_KEYS } from '../../model/takes/clip.ts';

/** A decoded object in the present form: the object itself, unless it is a channel or clip of an earlier version. */
export function inPresentForm(value: Readonly<Record<string, unknown>>): object {
  if (isFormerChannel(value)) return channelOf(value);
  if (!isClip(value)) return value;
  const channels = followingSamples(value.channels, value.samples);
  return channels === value.channels ? value : { ...value, channels };
}

/** What earlier versions had at a path into a channel without keys: its empty columns. */
export function formerColumn(value: object, key: string | number): unknown {
  const isWithoutKeys = 'extrapolateIn' in value && 'kind' in value && value.kind !== 'keys';
  // Any other key is a path that earlier versions didn't have either: undefined.
  return isWithoutKeys ? NO_KEYS[key as keyof typeof NO_KEYS] : undefined;
}

type FormerChannel = Pick<Channel, 'extrapolateIn' | 'extrapolateOut'> & typeof NO_KEYS & { readonly rest?: number };

function isFormerChannel(value: object): value is FormerChannel {
  return 'extrapolateIn' in value && 'times' in value && !('kind' in value);
}

function isClip(value: object): value is ChannelClip {
  return 'range' in value && 'samples' in value && value.samples !== undefined;
}

function channelOf({ rest = 0, ...channel }: FormerChannel): Channel {
  if (channel.times.length > 0) return { kind: 'keys', ...channel };
  const { extrapolateIn, extrapolateOut } = channel;
  return { kind: 'rest', value: rest, extrapolateIn, extrapolateOut };
}
