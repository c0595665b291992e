/**
 * What the timeline below the transport shows, shared by its tabs: curve editor, dope sheet and takes look at the
 * same stretch of time, the first two at the same channels and the same selected keys. The document knows nothing of it; the session
 * that is kept in the browser does, so it is plain data.
 */
import type { CopiedKeys } from '../../edit/keys/clipboard.ts';
import type { Character } from '../../model/document.ts';
import type { ChannelKeys, Selection } from '../../model/session.ts';
import { type Observable, observable } from '../kit/observable.ts';
import type { TimeWindow } from '../kit/time-window.ts';
import { Takes } from './takes.ts';

export const TIMELINE_TABS = ['curves', 'dope', 'takes', 'poses'] as const;
export type TimelineTabName = (typeof TIMELINE_TABS)[number];

/** Which channels are listed: the selected joint's (its root translation with the root), all, or those pinned. */
export const CHANNEL_LISTS = ['selected', 'all', 'pinned'] as const;
export type ChannelListKind = (typeof CHANNEL_LISTS)[number];

/** What dragging one handle does to the other side: follows where both slopes are equal; never; always. */
export const HANDLE_MODES = ['auto', 'alone', 'together'] as const;
export type HandleMode = (typeof HANDLE_MODES)[number];

/** What is picked out among one character's channels. Numbers of its DOFs: they mean nothing for another character. */
export interface ChannelView {
  /** Channels of the clip that is shown. */
  readonly pinned: readonly number[];
  /** Listed, but not drawn. */
  readonly hidden: readonly number[];
  /** Only these are drawn; absent: all that are listed and not hidden. */
  readonly isolated?: readonly number[];
  /**
   * What is folded out in the dope sheet: joints by their index, −1 for the root's translation, −2 for the morphs, −3
   * for channels past the character's DOFs.
   */
  readonly unfolded: readonly number[];
}

/** With what is picked out among the channels of the character that is shown. */
export interface TimelineView extends ChannelView {
  readonly tab: TimelineTabName;
  /** The character whose channels those are; absent until one is shown. */
  readonly characterId?: string;
  /** What was picked out of the other characters that were shown, by their ids. */
  readonly others: Readonly<Record<string, ChannelView>>;
  /** Seconds of the transport. */
  readonly window: TimeWindow;
  readonly list: ChannelListKind;
  /** Part of a channel's name. */
  readonly filter: string;
  /** Every curve between −1 and 1, by its own smallest and largest key. */
  readonly normalised: boolean;
  readonly snapsToFrames: boolean;
  readonly snapsToValues: boolean;
  /** What a key does where another is already. */
  readonly onCollision: 'replace' | 'step';
  readonly handles: HandleMode;
  /** A frame around the selected keys, whose edges scale them. */
  readonly scaleFrame: boolean;
  /** The dope sheet lists what has no key too. */
  readonly allRows: boolean;
  /** Keys dragged in the dope sheet take all later keys of their channels along. */
  readonly ripples: boolean;
}

const NOTHING_PICKED: ChannelView = { pinned: [], hidden: [], unfolded: [] };

export const DEFAULT_TIMELINE_VIEW: TimelineView = {
  ...NOTHING_PICKED,
  tab: 'curves',
  others: {},
  window: { from: -0.1, to: 2.1 },
  list: 'selected',
  filter: '',
  normalised: false,
  snapsToFrames: true,
  snapsToValues: false,
  onCollision: 'replace',
  handles: 'auto',
  scaleFrame: false,
  allRows: false,
  ripples: false,
};

/** A tab as the panel around it sees it. */
export interface TimelineTab {
  readonly element: HTMLElement;
  /** Its buttons, for the row of the tabs. */
  readonly tools?: HTMLElement;
  /** Told when it comes into view or leaves it: what can't be seen draws nothing. */
  setVisible(visible: boolean): void;
  fitAll(): void;
  fitSelected(): void;
  /** Zooms about the middle of what is selected or the playhead; factors above 1 show more. */
  zoom?(timeFactor: number, valueFactor: number): void;
  /** Moves on by parts of what is shown: to later times, to larger values. */
  pan?(timePart: number, valuePart: number): void;
  /**
   * Where on the page a point of a channel's curve is drawn, in CSS pixels; undefined where the channel is not.
   * @param timeSeconds of the transport
   */
  placeOf?(channel: number, timeSeconds: number, value: number): { readonly x: number; readonly y: number } | undefined;
  /** Another theme: colours are read anew. */
  recolour(): void;
}

/** Channels in view, and what they follow from. */
export interface ChannelsInView {
  readonly character: Character;
  readonly selection: Selection;
  readonly view: TimelineView;
  readonly channels: readonly number[];
}

export class Timeline {
  readonly view: Observable<TimelineView> = observable(DEFAULT_TIMELINE_VIEW);
  /** Keys follow every DOF that is changed by hand. Not remembered: found on by surprise, it would be a trap. */
  readonly autoKey: Observable<boolean> = observable(false);
  /** Counts how often someone asked to rename the take: the field for it is in the inspector. */
  readonly takeRenameAsked: Observable<number> = observable(0);
  /** The next drag in the curve editor scales the selected keys: while its key is held, or once if it was asked for. */
  readonly scaling: Observable<boolean> = observable(false);
  /** The list of takes, and the two of them that are compared. */
  readonly takes: Takes = new Takes();
  /** Keys that were copied or cut, until others are. */
  copied: CopiedKeys | undefined;
  /** The tab in view; none while the panel is folded. */
  tab: TimelineTab | undefined;
  /** What `editors/timeline/in-hand.ts` found last: every row and menu entry asks for the same. */
  readonly last: { keys?: readonly ChannelKeys[]; inView?: ChannelsInView } = {};

  change(change: Partial<TimelineView>): void {
    this.view.update((now) => ({ ...now, ...change }));
  }

  /**
   * Another character is shown: what was picked out of its channels comes back, and what is of the one before is kept
   * for it. The first one takes over what there is.
   */
  showChannelsOf(characterId: string): void {
    const now = this.view.get();
    if (now.characterId === characterId) return;
    if (now.characterId === undefined) {
      this.change({ characterId });
      return;
    }
    const { pinned, hidden, unfolded, isolated, characterId: before, others, ...rest } = now;
    const { [characterId]: own = NOTHING_PICKED, ...further } = others;
    const left: ChannelView = { pinned, hidden, unfolded, ...(isolated && { isolated }) };
    this.view.set({ ...rest, ...own, characterId, others: { ...further, [before]: left } });
  }

  /** A character has other DOFs than it had: numbers of channels mean something else from now on. */
  forgetChannelsOf(characterId: string): void {
    const { isolated, ...now } = this.view.get();
    const { [characterId]: gone, ...others } = now.others;
    if (now.characterId === characterId) this.view.set({ ...now, ...NOTHING_PICKED });
    else if (gone) this.change({ others });
  }

  isolate(channels: readonly number[] | undefined): void {
    const { isolated: _before, ...rest } = this.view.get();
    this.view.set(channels ? { ...rest, isolated: channels } : rest);
  }
}
