/**
 * What the timeline shows, shared by its tabs: curve editor, dope sheet and takes share the time window, the first two
 * also channels and selected keys. Not part of the document, but saved with the session, so it is plain data.
 */
import type { CopiedKeys } from '../../edit/keys/clipboard.ts';
import type { OutsideCycle } from '../../edit/keys/cycle.ts';
import type { ChannelKeys, Selection } from '../../model/session.ts';
import { type Observable, observable } from '../widgets/observable.ts';
import { fitWindow, type TimeWindow } from '../widgets/time/time-window.ts';
import type { CycleQuestion, Easing, KeyedMoment } from './cycle-question.ts';
import { ReviewState } from './review.ts';
import type { SourcePlace } from './source.ts';
import { Takes } from './takes.ts';
import type { TweenKind } from './tween-ways.ts';

export const TIMELINE_TABS = [
  'curves',
  'dope',
  'takes',
  'review',
  'poses',
  'measure',
  'steps',
  'source',
  'compare',
] as const;
export type TimelineTabName = (typeof TIMELINE_TABS)[number];

/** Tabs that can be seen together, above each other. */
const TOGETHER: readonly TimelineTabName[] = ['dope', 'curves'];

/** The tabs that are seen while the timeline is open, from the top. */
export function shownTabs({ tab, together }: Pick<TimelineView, 'tab' | 'together'>): readonly TimelineTabName[] {
  return together && TOGETHER.includes(tab) ? TOGETHER : [tab];
}

/** What a press on a tab's button changes; undefined: it was the last one that was seen, so the timeline folds. */
export function afterPress(
  view: Pick<TimelineView, 'tab' | 'together'>,
  isOpen: boolean,
  name: TimelineTabName,
): Pick<TimelineView, 'tab' | 'together'> | undefined {
  const shown = isOpen ? shownTabs(view) : [];
  const others = shown.filter((tab) => tab !== name);
  if (shown.includes(name)) return others.length ? { tab: others[0], together: false } : undefined;
  return { tab: name, together: TOGETHER.includes(name) && others.some((tab) => TOGETHER.includes(tab)) };
}

/** Which channels are listed: the selected joint's (with the root translation for the root), all, or pinned ones. */
export const CHANNEL_LISTS = ['selected', 'all', 'pinned'] as const;
export type ChannelListKind = (typeof CHANNEL_LISTS)[number];

/** What dragging one handle does to the opposite one: moves it if both slopes are equal; never; always. */
export const HANDLE_MODES = ['auto', 'alone', 'together'] as const;
export type HandleMode = (typeof HANDLE_MODES)[number];

/** Pinned, hidden and isolated channels of one character. Channel numbers mean nothing for another character. */
export interface ChannelView {
  /** Channels of the shown take. */
  readonly pinned: readonly number[];
  /** Listed, but not drawn. */
  readonly hidden: readonly number[];
  /** Only these are drawn; absent: all that are listed and not hidden. */
  readonly isolated?: readonly number[];
  /**
   * Expanded groups of the dope sheet: joints by index, −1 for the root translation, −2 for the morphs, −3 for channels
   * beyond the character's DOFs.
   */
  readonly unfolded: readonly number[];
}

/** Including pinned, hidden and isolated channels of the shown character. */
export interface TimelineView extends ChannelView {
  /** The one that keys and actions are for; see `shownTabs`. */
  readonly tab: TimelineTabName;
  /** Whether curve editor and dope sheet are seen together. */
  readonly together: boolean;
  /** The character of those channels; absent until one is shown. */
  readonly characterId?: string;
  /** The same for characters shown earlier, by id. */
  readonly others: Readonly<Record<string, ChannelView>>;
  /** Seconds of the transport. */
  readonly window: TimeWindow;
  readonly list: ChannelListKind;
  /** Part of a channel's name. */
  readonly filter: string;
  /** Scales every curve to −1 … 1, by its own smallest and largest key. */
  readonly normalised: boolean;
  readonly snapsToFrames: boolean;
  readonly snapsToValues: boolean;
  /** What a key does when moved onto another. */
  readonly onCollision: 'replace' | 'step';
  readonly handles: HandleMode;
  /** A box around the selected keys, whose edges scale them. */
  readonly scaleFrame: boolean;
  /** Beside the curves: where slopes and values come from. */
  readonly showsWhy: boolean;
  /** The dope sheet also lists rows without keys. */
  readonly allRows: boolean;
  /** Keys dragged in the dope sheet move all later keys of their channels too. */
  readonly ripples: boolean;
}

export const NOTHING_PICKED: ChannelView = { pinned: [], hidden: [], unfolded: [] };

export const DEFAULT_TIMELINE_VIEW: TimelineView = {
  ...NOTHING_PICKED,
  tab: 'curves',
  together: false,
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
  showsWhy: false,
  allRows: false,
  ripples: false,
};

/** A tab's interface for the panel around it. */
export interface TimelineTab {
  readonly element: HTMLElement;
  /** Its controls, for the row above the ruler. */
  readonly tools?: HTMLElement;
  /** What heads its column of names, at the left of that row. */
  readonly names?: HTMLElement;
  /** Called when it is shown or hidden: a hidden tab draws nothing. */
  setVisible(visible: boolean): void;
  fitAll(): void;
  fitSelected(): void;
  /** Zooms about the centre of the selection or about the playhead; factors above 1 zoom out. */
  zoom?(timeFactor: number, valueFactor: number): void;
  /** Pans by fractions of the view: to later times, to larger values. */
  pan?(timePart: number, valuePart: number): void;
  /**
   * Page position, in CSS pixels, of a point on a channel's curve; undefined if the channel isn't drawn.
   *
   * @param timeSeconds of the transport
   */
  placeOf?(channel: number, timeSeconds: number, value: number): { readonly x: number; readonly y: number } | undefined;
  /** The theme has changed: reread colours. */
  recolour(): void;
}

/** Channels in view, with what they depend on. */
export interface ChannelsInView {
  /** The takes that are shown (`TimelineTake`). */
  readonly current: object;
  readonly selection: Selection;
  readonly view: TimelineView;
  readonly channels: readonly number[];
}

export class Timeline {
  readonly view: Observable<TimelineView> = observable(DEFAULT_TIMELINE_VIEW);
  /** Auto-key: every DOF changed by hand is keyed. Not remembered: finding it on would be a surprise. */
  readonly autoKey: Observable<boolean> = observable(false);
  /**
   * What becomes of keys outside the cycle of a channel that repeats. Not remembered either: it was meant for the
   * motion that one works on.
   */
  readonly outsideCycle: Observable<OutsideCycle | 'ask'> = observable<OutsideCycle | 'ask'>('ask');
  /** Of the last pose that was keyed for a moment. */
  readonly easing: Observable<Easing> = observable<Easing>({ easeIn: 0.3, easeOut: 0.3 });
  /** Keys that wait until it has been said where they go (`add-keys.ts`). */
  readonly cycleQuestion: Observable<CycleQuestion | undefined> = observable<CycleQuestion | undefined>(undefined);
  /** The last one that was answered so. */
  readonly moment: Observable<KeyedMoment | undefined> = observable<KeyedMoment | undefined>(undefined);
  /** What the bar under the scrubber does; undefined: it is closed. Not remembered: it would take room. */
  readonly tween: Observable<TweenKind | undefined> = observable<TweenKind | undefined>(undefined);
  /** Counts requests to rename the take: its field is in the inspector. */
  readonly takeRenameAsked: Observable<number> = observable(0);
  /**
   * The next drag in the curve editor scales the selected keys: while its key is held, or once if chosen from a menu.
   */
  readonly scaling: Observable<boolean> = observable(false);
  /** The last place that was asked to be shown in the tab *Source*. */
  readonly sourceAsked: Observable<SourcePlace | undefined> = observable<SourcePlace | undefined>(undefined);
  /** Whether *Steps* shows the file pose rather than the displayed one. Not remembered: finding it would be a surprise. */
  readonly stepsOfFile: Observable<boolean> = observable(false);
  /** The list of takes, and the comparison. */
  readonly takes: Takes = new Takes();
  readonly review: ReviewState = new ReviewState();
  /** Keys that were copied or cut last. */
  copied: CopiedKeys | undefined;
  /** The tab that keys and actions are for; undefined while the panel is collapsed. */
  tab: TimelineTab | undefined;
  /** Last results of `editors/timeline/current-take.ts`: every row and menu entry asks for the same. */
  readonly last: { keys?: readonly ChannelKeys[]; inView?: ChannelsInView } = {};

  /** CSS pixels of the ruler and of all plots over its time. */
  private width = 0;
  /** The times that the window was fitted to; undefined once it was zoomed or panned. */
  fitted: readonly [number, number] | undefined;

  change(change: Partial<TimelineView>): void {
    if (change.window) this.fitted = undefined;
    this.view.update((now) => ({ ...now, ...change }));
  }

  /** Shows a range of times, and keeps it fitted as the page is resized; seconds of the transport. */
  fit(range: readonly [number, number]): void {
    this.change({ window: fitWindow(range, this.width) });
    this.fitted = range;
  }

  /** @param width of the ruler, CSS pixels */
  resize(width: number): void {
    if (width === this.width) return;
    this.width = width;
    if (this.fitted) this.fit(this.fitted);
  }

  /**
   * Another character is shown: restores its pinned, hidden and isolated channels and saves those of the previous one.
   * The first character takes over the current ones.
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

  /** A character's DOFs have changed, so channel numbers no longer mean the same. */
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
