/**
 * What the timeline below the transport shows, shared by its two tabs: the curve editor and the dope sheet look at the
 * same stretch of time, the same channels and the same selected keys. The document knows nothing of it; the session
 * that is kept in the browser does, so it is plain data.
 */
import { type Observable, observable } from '../observable.ts';
import type { TimeWindow } from '../time-window.ts';

export const TIMELINE_TABS = ['curves', 'dope'] as const;
export type TimelineTabName = (typeof TIMELINE_TABS)[number];

/** Which channels are listed: the selected joint's (its root translation with the root), all, or those pinned. */
export const CHANNEL_LISTS = ['selected', 'all', 'pinned'] as const;
export type ChannelList = (typeof CHANNEL_LISTS)[number];

/** What dragging one handle does to the other side: follows where both slopes are equal; never; always. */
export const HANDLE_MODES = ['auto', 'alone', 'together'] as const;
export type HandleMode = (typeof HANDLE_MODES)[number];

export interface TimelineView {
  readonly tab: TimelineTabName;
  /** Seconds of the transport. */
  readonly window: TimeWindow;
  readonly list: ChannelList;
  /** Channels of the clip that is shown. */
  readonly pinned: readonly number[];
  /** Listed, but not drawn. */
  readonly hidden: readonly number[];
  /** Only these are drawn; absent: all that are listed and not hidden. */
  readonly isolated?: readonly number[];
  /** Part of a channel's name. */
  readonly filter: string;
  /** Every curve between −1 and 1, by its own smallest and largest key. */
  readonly normalised: boolean;
  readonly snapsToFrames: boolean;
  readonly snapsToValues: boolean;
  /** What a key does where another is already. */
  readonly onCollision: 'replace' | 'step';
  readonly handles: HandleMode;
  /** Joints whose rows are folded out in the dope sheet. */
  readonly unfolded: readonly number[];
}

export const DEFAULT_TIMELINE_VIEW: TimelineView = {
  tab: 'curves',
  window: { from: -0.1, to: 2.1 },
  list: 'selected',
  pinned: [],
  hidden: [],
  filter: '',
  normalised: false,
  snapsToFrames: true,
  snapsToValues: false,
  onCollision: 'replace',
  handles: 'auto',
  unfolded: [],
};

/** A tab as the panel around it sees it. */
export interface TimelineTab {
  readonly element: HTMLElement;
  /** Told when it comes into view or leaves it: what can't be seen draws nothing. */
  setVisible(visible: boolean): void;
  fitAll(): void;
  fitSelected(): void;
  /** Another theme: colours are read anew. */
  recolour(): void;
}

export class Timeline {
  readonly view: Observable<TimelineView> = observable(DEFAULT_TIMELINE_VIEW);
  /** Keys follow every DOF that is changed by hand. Not remembered: found on by surprise, it would be a trap. */
  readonly autoKey: Observable<boolean> = observable(false);
  /** The tab in view; none while the panel is folded. */
  tab: TimelineTab | undefined;

  change(change: Partial<TimelineView>): void {
    this.view.update((now) => ({ ...now, ...change }));
  }

  isolate(channels: readonly number[] | undefined): void {
    const { isolated: _before, ...rest } = this.view.get();
    this.view.set(channels ? { ...rest, isolated: channels } : rest);
  }
}
