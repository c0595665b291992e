/** What *Why this curve* explains: a channel at a time, and one of its keys. */

import type { ChannelKeys } from '../../../../model/session.ts';
import type { CurveHit } from '../scene/scene.ts';

export interface WhySubject {
  /** Channel of the shown take. */
  readonly channel: number;
  /** Seconds of the take. */
  readonly time: number;
  /** The key whose tangents are explained; absent: none. */
  readonly key?: number;
}

/** What is shown and pointed at; times in seconds of the take. */
export interface WhyPlace {
  readonly hover: CurveHit;
  /** Under the pointer; undefined outside the plot. */
  readonly pointerTime: number | undefined;
  readonly playhead: number;
  /** In view. */
  readonly selected: readonly ChannelKeys[];
  /** In the order in which they are listed. */
  readonly drawn: readonly number[];
  /** Times of the keys of a channel. */
  readonly timesOf: (channel: number) => Float64Array;
}

/**
 * The curve under the pointer, there; else the channel of the last selected key, else the first that is drawn, under
 * the pointer or at the playhead. Undefined if no curve is drawn.
 */
export function whySubject(place: WhyPlace): WhySubject | undefined {
  const { hover, pointerTime, playhead, selected, drawn, timesOf } = place;
  if (hover.kind === 'key' || hover.kind === 'handle') {
    const time = timesOf(hover.channel)[hover.index];
    // A drag may have deleted it.
    if (time !== undefined) return { channel: hover.channel, time, key: hover.index };
  }
  if (hover.kind === 'curve') return withKey({ channel: hover.channel, time: hover.timeSeconds }, selected);
  const channel = selected.at(-1)?.channel ?? drawn[0];
  return channel === undefined ? undefined : withKey({ channel, time: pointerTime ?? playhead }, selected);
}

/** The last selected key of the channel. */
function withKey(subject: WhySubject, selected: readonly ChannelKeys[]): WhySubject {
  const key = selected.find(({ channel }) => channel === subject.channel)?.indices.at(-1);
  return key === undefined ? subject : { ...subject, key };
}
