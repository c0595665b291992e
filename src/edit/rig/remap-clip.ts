/** The channels and samples of a clip in the order of other DOFs. */
import { type Channel, type ChannelClip, isSampled, keylessChannel } from '../../model/clip.ts';
import { rootDofs } from '../../model/dofs.ts';
import { columnOf, RADIANS_PER_DEGREE, type Samples } from '../../model/samples.ts';
import { type DofUnit, dofsOf, type Skeleton } from '../../model/skeleton.ts';
import type { DofSource } from './dof-sources.ts';
import type { JointMap } from './joint-map.ts';

/** A channel that comes of one before, or of none. */
interface ChannelSource extends Omit<DofSource, 'like'> {
  readonly like?: DofSource['like'];
}

/** @param pose of the character before: where DOFs stand that the clip has no channel for */
export function remapClip(clip: ChannelClip, map: JointMap, pose: readonly number[]): ChannelClip {
  const sources = channelSources(clip, map);
  const channels = sources.map(({ from, plus, start, like }) => {
    if (from >= 0) return raised(clip.channels[from] ?? keylessChannel(pose[from] ?? start), plus);
    const model = like && clip.channels[like.dof];
    const stands = like && model && model.times.length === 0 && !isSampled(clip, like.dof);
    return keylessChannel(stands ? (model.rest ?? 0) * like.sign : start);
  });
  const { samples, ...rest } = clip;
  const stand = channels.map(({ rest = 0 }) => rest);
  const moved = samples && remapSamples(samples, sources, stand, map.after);
  return { ...rest, channels, ...(moved && { samples: moved }) };
}

/**
 * As many channels as drive what was driven before: all where all DOFs were, and then what there was beyond them; where
 * only the first ones were, up to the last of those that still are. What has come between those stands as it is posed.
 */
function channelSources({ channels }: ChannelClip, { dofs, dofsBefore }: JointMap): readonly ChannelSource[] {
  const count = channels.length;
  const drivesAll = count >= dofsBefore;
  const last = dofs.findLastIndex(({ from }) => from >= 0 && from < count);
  const driven = drivesAll ? dofs : dofs.slice(0, last + 1);
  // Morphs, and channels that drive nothing.
  const beyond = Array.from({ length: Math.max(0, count - dofsBefore) }, (_, i) => ({
    from: dofsBefore + i,
    plus: 0,
    start: 0,
  }));
  return [...driven, ...beyond];
}

/** With another value throughout: the same channel where nothing is added. */
function raised(channel: Channel, plus: number): Channel {
  if (plus === 0) return channel;
  const { rest = 0, ...others } = channel;
  if (channel.times.length === 0) return { ...others, ...(rest + plus !== 0 && { rest: rest + plus }) };
  return { ...channel, values: channel.values.map((value) => value + plus) };
}

/**
 * Columns stand in a row, so a channel between sampled ones has one too, in which it stands still; and so have new DOFs
 * behind the last of them, that a take of motion capture remains one in all its channels.
 */
function remapSamples(
  samples: Samples,
  sources: readonly ChannelSource[],
  stand: readonly number[],
  after: Skeleton,
): Samples | undefined {
  const columns = sources.map(({ from }) => (from < 0 ? -1 : columnOf(samples, from)));
  const first = columns.findIndex((column) => column >= 0);
  if (first < 0) return undefined;
  let end = columns.findLastIndex((column) => column >= 0) + 1;
  while (sources[end]?.from === -1) end++;
  const width = end - first;
  const own = columns.slice(first, end);
  const { frameCount, scales: scalesBefore, values: before } = samples;
  const widthBefore = scalesBefore.length;
  const plus = sources.slice(first, end).map((source) => source.plus);
  const isSame = first === samples.firstChannel && width === widthBefore && own.every((column, c) => column === c);
  if (isSame && plus.every((p) => p === 0)) return samples;
  const units = unitsOf(after);
  const scales = Float64Array.from(own, (column, c) => {
    if (column >= 0) return scalesBefore[column];
    return units[first + c] === 'angle' ? RADIANS_PER_DEGREE : 1;
  });
  // In the column's own unit: what is added, or what a new one is throughout.
  const added = Float64Array.from(own, (column, c) => {
    return (column >= 0 ? plus[c] : stand[first + c]) / scales[c];
  });
  const values = new Float64Array(frameCount * width);
  for (let frame = 0; frame < frameCount; frame++) {
    const to = frame * width;
    const from = frame * widthBefore;
    for (let c = 0; c < width; c++) {
      if (own[c] < 0) values[to + c] = added[c];
      // Adding 0 would turn −0 into 0.
      else values[to + c] = added[c] === 0 ? before[from + own[c]] : before[from + own[c]] + added[c];
    }
  }
  return { ...samples, firstChannel: first, values, scales };
}

/** What each DOF measures, by its index. */
function unitsOf(skeleton: Skeleton): readonly DofUnit[] {
  return [...rootDofs(skeleton), ...skeleton.joints.flatMap(({ motion }) => dofsOf(motion))].map(({ unit }) => unit);
}
