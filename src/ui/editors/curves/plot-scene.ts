/**
 * The current scene, from document, selection and settings. Unchanged parts keep their identity, by which the picture
 * knows what to redraw.
 */

import { compileTake } from '../../../evaluate/compiled-take.ts';
import type { Character } from '../../../model/document.ts';
import type { Take } from '../../../model/takes/take.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import type { TimelineView } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import {
  drawnChannels,
  isOfRootOnly,
  type ListedChannel,
  listedChannels,
  selectedChannels,
} from '../timeline/channels.ts';
import { type CurrentTake, currentTake, selectedKeysInView } from '../timeline/current-take.ts';
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
    const current = currentTake(wb);
    const view = wb.timeline.view.get();
    const character = currentCharacter(wb);
    this.listed = character ? listedChannels(character, wb.store.selection, view) : [];
    const drawn = current ? drawnChannels(this.listed, view) : NO_CHANNELS;
    if (!sameNumbers(drawn, this.drawn)) this.drawn = drawn;
    if (current) this.updateLines(current.character, current.take, view.normalised);
    else {
      this.lines = NO_LINES;
      this.linesOf = NO_LINES;
      this.byChannel = new Map();
    }
    this.updateEmphasis(current?.character, view);
    const { framesPerSecond } = wb.transport.get();
    const settings = wb.settings.get();
    const take = current?.take ?? NO_TAKE;
    const offsetSeconds = current?.character.timeOffsetSeconds ?? 0;
    const theirs = current && this.theirsOf(current.character);
    const rest = current && this.restOf(current, view);
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
  private restOf({ character, take }: CurrentTake, { hidden, isolated }: TimelineView): CurveScene['rest'] {
    const curves = restCurves(take, character.skeleton);
    const lines = this.listed.flatMap(({ channel }) => {
      const isShown = isolated ? isolated.includes(channel) : !hidden.includes(channel);
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
  private updateEmphasis(character: Character | undefined, { list, isolated }: TimelineView): void {
    const { selection } = this.wb.store;
    if (list === 'selected' && !isolated && character && isOfRootOnly(character, selection)) {
      this.emphasised = NONE;
      return;
    }
    const isThicket = list === 'all' && !isolated && this.lines.length > MAX_LINES_ALIKE;
    const front = isThicket && character ? selectedChannels(character, this.wb.store.selection) : undefined;
    const drawn = front?.filter((channel) => this.lines.some((line) => line.channel === channel)) ?? NO_CHANNELS;
    if (this.emphasised !== NONE && sameNumbers(drawn, [...(this.emphasised ?? NO_CHANNELS)])) return;
    this.emphasised = drawn.length ? new Set(drawn) : undefined;
  }

  private updateLines(character: Character, take: Take, normalised: boolean): void {
    // Only normalised lines depend on keys and samples.
    const keys = normalised ? (this.frozen ? this.linesOf[4] : take.channels) : undefined;
    const samples = normalised ? (this.frozen ? this.linesOf[5] : take.samples) : undefined;
    const count = take.channels.length;
    const from = [
      character.id,
      character.skeleton,
      character.morphs,
      this.listedNumbers(),
      keys,
      samples,
      normalised,
      count,
    ];
    const same = from.every((part, i) => part === this.linesOf[i]);
    if (same && this.drawn === this.linesDrawn) return;
    // From all listed channels, so that a curve keeps its colour when another is hidden.
    if (!same)
      this.byChannel = new Map(sceneLines(character, this.listedNumbers(), normalised).map((l) => [l.channel, l]));
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

export function sameNumbers(a: readonly number[], b: readonly number[]): boolean {
  return a.length === b.length && a.every((n, i) => n === b[i]);
}
