/** Remaps the channels and samples of a take to other DOFs. */

import { RADIANS_PER_DEGREE } from '../../math/degrees.ts';
import { rootDofs } from '../../model/skeleton/dofs.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import type { DofUnit, Skeleton } from '../../model/skeleton/skeleton.ts';
import { withMotions } from '../../model/takes/layers.ts';
import { columnOf, type Samples } from '../../model/takes/samples.ts';
import { type Channel, followingSamples, restChannel, type Take, type Tangents } from '../../model/takes/take.ts';
import { type DofSource, valueAfter } from './dof-sources.ts';
import type { JointMap } from './joint-map.ts';
import { timesSign } from './same-dof.ts';

/** A channel made from an old one, or a new one. */
interface ChannelSource extends Omit<DofSource, 'like'> {
  readonly like?: DofSource['like'];
}

/**
 * A take with the channels of the changed skeleton, and its layers with theirs.
 * @param pose of the old character: values of DOFs for which the take has no channel
 */
export function remapTake(take: Take, map: JointMap, pose: readonly number[]): Take {
  return take.layers ? withMotions(take, (each) => remapped(each, map, pose)) : remapped(take, map, pose);
}

function remapped(take: Take, map: JointMap, pose: readonly number[]): Take {
  const sources = channelSources(take, map);
  const channels = sources.map((source) => {
    const { from, start, like } = source;
    if (from >= 0) return moved(take.channels[from] ?? restChannel(pose[from] ?? start), source);
    const model = like && take.channels[like.dof];
    return restChannel(like && model?.kind === 'rest' ? model.value * like.sign : start);
  });
  const { samples, ...rest } = take;
  const stand = channels.map((channel) => (channel.kind === 'rest' ? channel.value : 0));
  const sampled = samples && remapSamples(samples, sources, stand, map.after);
  return { ...rest, channels: followingSamples(channels, sampled), ...(sampled && { samples: sampled }) };
}

/**
 * Keeps driving what was driven: all DOFs if all were, plus any channels beyond them; if only the first ones were, up
 * to the last of those that remain. New ones in between rest in the pose.
 */
function channelSources({ channels }: Take, { dofs, dofsBefore }: JointMap): readonly ChannelSource[] {
  const count = channels.length;
  const drivesAll = count >= dofsBefore;
  const last = dofs.findLastIndex(({ from }) => from >= 0 && from < count);
  const driven = drivesAll ? dofs : dofs.slice(0, last + 1);
  // Morphs, and channels that drive nothing.
  const beyond = Array.from({ length: Math.max(0, count - dofsBefore) }, (_, i) => ({
    from: dofsBefore + i,
    sign: 1 as const,
    plus: 0,
    start: 0,
  }));
  return [...driven, ...beyond];
}

/** With all values converted; the same channel if nothing changes. */
function moved(channel: Channel, source: ChannelSource): Channel {
  const { sign, plus } = source;
  if (sign > 0 && plus === 0) return channel;
  if (channel.kind === 'samples') return channel;
  if (channel.kind === 'rest') return { ...channel, value: valueAfter(source, channel.value) + 0 };
  const values = channel.values.map((value) => valueAfter(source, value));
  if (sign > 0) return { ...channel, values };
  const mirrored = ({ kinds, slopes }: Tangents): Tangents => ({ kinds, slopes: slopes.map((slope) => 0 - slope) });
  const [tangentsIn, tangentsOut] = [mirrored(channel.tangentsIn), mirrored(channel.tangentsOut)];
  return { ...channel, values, tangentsIn, tangentsOut };
}

/**
 * Columns are contiguous, so a channel between sampled ones gets a constant column; and so do new DOFs after the last,
 * so that a motion capture take remains sampled in all channels.
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
  const drivers = sources.slice(first, end);
  const isSame = first === samples.firstChannel && width === widthBefore && own.every((column, c) => column === c);
  /** Columns whose values change. */
  const changed = drivers.flatMap(({ sign, plus }, c) => (own[c] >= 0 && (sign < 0 || plus !== 0) ? [c] : []));
  if (isSame && changed.length === 0) return samples;
  const units = unitsOf(after);
  const scales = Float64Array.from(own, (column, c) => {
    if (column >= 0) return scalesBefore[column];
    return units[first + c] === 'angle' ? RADIANS_PER_DEGREE : 1;
  });
  const values = isSame
    ? before.slice()
    : rearranged(before, widthBefore, own, frameCount, (c) => stand[first + c] / scales[c]);
  // One pass over the rows, since moved columns are usually adjacent.
  const signs = changed.map((c) => drivers[c].sign);
  // In the column's own unit.
  const plus = Float64Array.from(changed, (c) => drivers[c].plus / scales[c]);
  for (let row = 0; row < values.length; row += width) {
    for (let i = 0; i < changed.length; i++) {
      const at = row + changed[i];
      values[at] = timesSign(values[at], signs[i]) + plus[i];
    }
  }
  return { ...samples, firstChannel: first, values, scales };
}

/** @param own for each column the old one; -1 for a constant one, with its value in `standing` */
function rearranged(
  before: Float64Array,
  widthBefore: number,
  own: readonly number[],
  frameCount: number,
  standing: (column: number) => number,
): Float64Array {
  const width = own.length;
  const values = new Float64Array(frameCount * width);
  for (let c = 0; c < width; c++) {
    if (own[c] >= 0) continue;
    const value = standing(c);
    if (value !== 0) for (let at = c; at < values.length; at += width) values[at] = value;
  }
  for (let frame = 0; frame < frameCount; frame++) {
    const [from, to] = [frame * widthBefore, frame * width];
    for (let c = 0; c < width; c++) if (own[c] >= 0) values[to + c] = before[from + own[c]];
  }
  return values;
}

/** The unit of each DOF, by index. */
function unitsOf(skeleton: Skeleton): readonly DofUnit[] {
  return [...rootDofs(skeleton), ...skeleton.joints.flatMap(({ motion }) => dofsOf(motion))].map(({ unit }) => unit);
}
