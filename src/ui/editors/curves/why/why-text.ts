/** The sentences of *Why this curve*. Numbers are those of the file: radians, lengths, weights. */

import type { KeyedCurve } from '../../../../model/takes/take.ts';
import type { ChannelWhy, OutsideWhy, SegmentWhy } from '../../../../teaching/explain/channel-why.ts';
import { tangentText, whyTangent } from '../../../../teaching/explain/tangent-why.ts';
import { count, shown } from '../../../widgets/numbers/number-text.ts';

/** `Key 2: 0.25 at 0.75 s`, and where its slopes come from. */
export function keyLines(keys: KeyedCurve, key: number): readonly string[] {
  return [
    `Key ${key}: ${shown(keys.values[key])} at ${shown(keys.times[key])} s`,
    tangentText(keys, whyTangent(keys, key, 'in'), shown),
    tangentText(keys, whyTangent(keys, key, 'out'), shown),
  ];
}

/** How the time leads to a segment or a key. */
export function placeLines(why: ChannelWhy): readonly string[] {
  if (why.kind === 'rest') return ['No keys: the channel keeps one value.'];
  if (why.kind === 'samples') return [samplesText(why)];
  const { outside, segment, at } = why;
  const lines = outside ? outsideLines(outside) : [];
  if (segment) return [...lines, `Between keys ${segment.key} and ${segment.key + 1}, ${shown(segment.h)} s apart.`];
  return outside?.kind === 'constant' || outside?.kind === 'linear'
    ? lines
    : [...lines, `At key ${at}: the key’s own value.`];
}

function samplesText({ interpolation, frame, frameCount }: Extract<ChannelWhy, { kind: 'samples' }>): string {
  const row = Math.floor(frame);
  const part = frame - row;
  if (part === 0) return `Frame ${count(row)} of ${count(frameCount)}, from 0: the sample itself.`;
  const how = { nearest: 'the nearer one', linear: 'linear', cubic: 'a Catmull-Rom cubic' }[interpolation];
  return `Between frames ${count(row)} and ${count(row + 1)}, ${shown(part)} of the way: ${how}.`;
}

function outsideLines(outside: OutsideWhy): readonly string[] {
  const where = outside.side === 'before' ? 'Before the first key' : 'After the last key';
  if (outside.kind === 'constant') return [`${where}, constant: the value of key ${outside.key}.`];
  if (outside.kind === 'linear') {
    const { key, tangent, seconds } = outside;
    const slope = `${shown(tangent.slope)} · ${seconds < 0 ? `(${shown(seconds)})` : shown(seconds)} s`;
    return [`${where}, linear: the value of key ${key} + ${slope}.`];
  }
  const { kind, period, length, folded, isMirrored, change, added } = outside;
  const mirrored = isMirrored ? ', backwards since it is odd' : '';
  const lines = [
    `${where}, ${kind}: period ${shown(period)} of ${shown(length)} s.`,
    `Folded to ${shown(folded)} s${mirrored}.`,
  ];
  return kind === 'cycle_offset' ? [...lines, `Added: ${shown(period)} · ${shown(change)} = ${shown(added)}.`] : lines;
}

/** Where the slopes of a segment come from. */
export function slopeLines(keys: KeyedCurve, { tangents, isDegenerate }: SegmentWhy): readonly string[] {
  const [out, into] = tangents;
  const lines = [`m₀, ${tangentText(keys, out, shown)}`, `m₁, ${tangentText(keys, into, shown)}`];
  return isDegenerate ? [...lines, 'Too steep for a cubic: a straight line, or a step.'] : lines;
}
