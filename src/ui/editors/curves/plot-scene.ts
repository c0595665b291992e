/**
 * The current scene, from document, selection and settings. Unchanged parts keep their identity, by which the picture
 * knows what to redraw.
 */

import { compileTake } from '../../../evaluate/compiled-take.ts';
import type { Character } from '../../../model/document.ts';
import type { Selection } from '../../../model/session.ts';
import type { Take } from '../../../model/takes/take.ts';
import type { TimelineView } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { drawnChannels, isOfRootOnly, type ListedChannel, selectedChannels } from '../timeline/channels.ts';
import { selectedKeysInView } from '../timeline/current-take.ts';
import { listedOfAll, viewOfAll } from '../timeline/listed-of-all.ts';
import {
  activePart,
  channelsOfPart,
  type TimelinePart,
  type TimelineTake,
  timelineTake,
} from '../timeline/timeline-take.ts';
import { restCurves } from './scene/rest-curves.ts';
import { type CurveLine, type CurveScene, NO_CHANNELS, sceneLines } from './scene/scene.ts';
import { type CurveSpace, DEFAULT_AXES } from './scene/space.ts';
import { type TheirChannel, type TheirChannels, theirChannels } from './scene/their-channels.ts';

/** Without a take there is still a ruler to scrub in. */
const NO_TAKE: Take = { name: '', range: [0, 0], channels: [] };
/** With more lines, those of the selection are in front of the others. */
const MAX_LINES_ALIKE = 12;
const NO_LINES: readonly CurveLine[] = [];
const NONE: ReadonlySet<number> = new Set();

export class PlotScene {
  /** Value ranges; the time window is the timeline's. */
  axes: CurveSpace['axes'] = DEFAULT_AXES;
  width = 0;
  height = 0;
  /**
   * While keys are dragged nothing is rescaled: a normalised curve keeps its scale even if its largest key is being
   * moved.
   */
  frozen = false;
  private listed: readonly ListedChannel[] = [];
  private drawn: readonly number[] = NO_CHANNELS;
  private lines: readonly CurveLine[] = [];
  private emphasised: ReadonlySet<number> | undefined;
  private made: CurveScene | undefined;
  private stale = true;
  private rest: CurveScene['rest'];
  private linesOf: readonly unknown[] = [];
  private linesDrawn: readonly number[] | undefined;
  private byChannel: ReadonlyMap<number, CurveLine> = new Map();

  constructor(private readonly wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'comparing'>) {}

  /** Something that the scene depends on has changed. */
  invalidate(): void {
    this.stale = true;
  }

  get channels(): readonly ListedChannel[] {
    this.update();
    return this.listed;
  }

  /** Without a take it has no lines. */
  get scene(): CurveScene {
    return this.update();
  }

  private update(): CurveScene {
    if (this.made && !this.stale) return this.made;
    this.stale = false;
    const { wb } = this;
    const current = timelineTake(wb);
    const view = wb.timeline.view.get();
    this.listed = listedOfAll(wb);
    const drawn = current ? drawnChannels(this.listed, viewOfAll(wb)) : NO_CHANNELS;
    if (!sameNumbers(drawn, this.drawn)) this.drawn = drawn;
    if (current) this.updateLines(current, view.normalised);
    else {
      this.lines = NO_LINES;
      this.linesOf = NO_LINES;
      this.byChannel = new Map();
    }
    this.updateEmphasis(current, view);
    const { framesPerSecond } = wb.transport.get();
    const settings = wb.settings.get();
    const take = current?.take ?? NO_TAKE;
    const offsetSeconds = current?.character.timeOffsetSeconds ?? 0;
    const theirs = current && this.theirsOf(current.character);
    const rest = current && this.restOf(activePart(current));
    const made: CurveScene = {
      take,
      curves: compileTake(take),
      offsetSeconds,
      lines: this.lines,
      ...(rest && { rest }),
      ...(theirs && { theirs }),
      selected: selectedKeysInView(wb),
      ...(this.emphasised && { emphasised: this.emphasised }),
      space: { width: this.width, height: this.height, window: view.window, axes: this.axes },
      range: wb.transport.get().range,
      framesPerSecond,
      inFrames: settings.timeDisplay === 'frames',
      degrees: settings.angles === 'degrees',
    };
    this.made = made;
    return made;
  }

  /** What the active layer lies over, of all channels that are listed and not hidden. */
  private restOf({ character, take, count }: TimelinePart): CurveScene['rest'] {
    const { hidden, isolated } = viewOfAll(this.wb);
    const curves = restCurves(take, character.skeleton);
    const lines = this.listed.flatMap(({ channel }) => {
      const isOwn = channel < count;
      const isShown = isOwn && (isolated ? isolated.includes(channel) : !hidden.includes(channel));
      return (isShown && this.byChannel.get(channel)) || [];
    });
    const { rest } = this;
    const isSame = rest?.lines.length === lines.length && rest.lines.every((line, i) => line === lines[i]);
    if (!curves) this.rest = undefined;
    else if (rest?.curves !== curves || !isSame) this.rest = { curves, lines };
    return this.rest;
  }

  /** What is compared with the take; undefined if no channels are. */
  private theirsOf({ id }: Character): TheirChannels | undefined {
    const comparing = this.wb.comparing.get();
    const result = comparing?.characterId === id ? comparing.state.get().result : undefined;
    return result && theirChannels(result);
  }

  /** In a thicket of all channels the selected joint's are in front. Those of a root that nobody has selected are faint. */
  private updateEmphasis(current: TimelineTake | undefined, { list }: TimelineView): void {
    const { selection } = this.wb.store;
    const { isolated } = viewOfAll(this.wb);
    const { parts = [] } = current ?? {};
    const isOfRoots = parts.length > 0 && parts.every(({ character }) => isOfRootOnly(character, selection));
    if (list === 'selected' && !isolated && isOfRoots) {
      this.emphasised = NONE;
      return;
    }
    const isThicket = list === 'all' && !isolated && this.lines.length > MAX_LINES_ALIKE;
    const front = isThicket ? parts.flatMap((part) => selectedOf(part, selection)) : NO_CHANNELS;
    const drawn = front.filter((channel) => this.lines.some((line) => line.channel === channel));
    if (this.emphasised !== NONE && sameNumbers(drawn, [...(this.emphasised ?? NO_CHANNELS)])) return;
    this.emphasised = drawn.length ? new Set(drawn) : undefined;
  }

  private updateLines({ take, parts }: TimelineTake, normalised: boolean): void {
    // Only normalised lines depend on keys and samples.
    const keys = normalised ? (this.frozen ? this.linesOf[4] : take.channels) : undefined;
    const samples = normalised ? (this.frozen ? this.linesOf[5] : take.samples) : undefined;
    const count = take.channels.length;
    const of = parts.flatMap(({ character: { id, name, skeleton, morphs } }) => [id, name, skeleton, morphs]);
    const from = [this.listedNumbers(), normalised, count, of.length, keys, samples, ...of];
    const same = from.every((part, i) => part === this.linesOf[i]);
    if (same && this.drawn === this.linesDrawn) return;
    // From all listed channels, so that a curve keeps its colour when another is hidden.
    if (!same) {
      const lines = parts.flatMap((part, i) => linesOf(part, this.listedNumbers(), normalised, parts.length > 1, i));
      this.byChannel = new Map(lines.map((line) => [line.channel, line]));
    }
    this.linesOf = from;
    this.linesDrawn = this.drawn;
    this.lines = this.drawn.flatMap((c) => this.byChannel.get(c) ?? []);
  }

  /** The line of a listed channel of the take, drawn or not. */
  line(channel: number): CurveLine | undefined {
    this.update();
    return this.byChannel.get(channel);
  }

  theirs(channel: number): TheirChannel | undefined {
    return this.update().theirs?.get(channel);
  }

  private numbers: readonly number[] = NO_CHANNELS;

  private listedNumbers(): readonly number[] {
    const now = this.listed.map((l) => l.channel);
    if (!sameNumbers(now, this.numbers)) this.numbers = now;
    return this.numbers;
  }
}

/** The channels of a part's selected joints, in the numbers of all. */
function selectedOf({ character, first }: TimelinePart, selection: Selection): readonly number[] {
  return (selectedChannels(character, selection) ?? []).map((channel) => first + channel);
}

/** The lines of a part, named with its character if there are several. @param place among the parts */
function linesOf(
  part: TimelinePart,
  listed: readonly number[],
  normalised: boolean,
  isNamed: boolean,
  place: number,
): readonly CurveLine[] {
  const { character, first } = part;
  const lines = sceneLines(character, channelsOfPart(part, listed), normalised, [], place);
  if (!isNamed) return lines;
  return lines.map((line) => ({ ...line, channel: first + line.channel, name: `${character.name} ${line.name}` }));
}

export function sameNumbers(a: readonly number[], b: readonly number[]): boolean {
  return a.length === b.length && a.every((n, i) => n === b[i]);
}
