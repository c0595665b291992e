/**
 * The comparison of a character with dumps: numbers of another program, given by a drop. It is no part of the document:
 * it has no undo step, and nothing of it is saved.
 *
 *     Workbench.comparing      undefined until dumps are there
 *       .state                 dumps, progress, and the last `result`: theirs, ours, errors and causes
 *       .shown                 the frame of the result at the time shown; undefined if none was compared near it
 *
 * `onShown` (`shown-comparison.ts`) follows both. A view draws `shown.theirs` against `shown.frame.ours`:
 *
 *     theirs.world       16 per joint, column-major        frame.jointErrors    frame.own, frame.inherited
 *     theirs.positions   x y z per joint
 *     theirs.vertices    x y z per vertex                  frame.vertexErrors
 *     theirs.normals     x y z per vertex                  frame.normalErrors
 *     result.targets.channels                              result.comparison.ourChannels
 *
 * All are in the character's own space, before its placement. An error times `frame.size` is a length, where it is one
 * of lengths. It is wrong if it isn't `<= tolerance`: NaN is wrong too. Times of frames and samples are those of the
 * character's take: `transportTimeOf` (`dump-times.ts`) converts them.
 *
 * Edits of the character start the comparison again, in the worker. Until then the last result stays, unless its arrays
 * no longer fit.
 */

import type { Playback } from '../../edit/playback.ts';
import type { Store } from '../../edit/store.ts';
import { type Diagnostic, hasErrors } from '../../model/diagnostic.ts';
import { type Character, type Document, findCharacter, isMoved } from '../../model/document.ts';
import { sentenceOf } from '../../model/failure.ts';
import type { Comparison, FrameComparison } from '../../teaching/compare/compare.ts';
import { DEFAULT_TOLERANCE } from '../../teaching/compare/errors.ts';
import type { FrameTarget, Targets } from '../../teaching/compare/targets.ts';
import type { NamedDump } from '../../teaching/dump/fit-dump.ts';
import { type Observable, observable } from '../widgets/observable.ts';
import { fits, isSameFor, lean } from './compared-character.ts';
import { frameShown, statedTimes, statesTime, takeTimeShown, transportTimeOf } from './dump-times.ts';

/** Of the worker's `compare` job. */
export interface CompareInput {
  readonly character: Character;
  readonly dumps: readonly NamedDump[];
  /** Names of dumps that may also be of the file pose instead of their assumed time. */
  readonly undecided: readonly string[];
  readonly tolerance: number;
}

export interface CompareOutput {
  /** Absent, like `targets`, if the dumps don't fit the character. */
  readonly comparison?: Comparison;
  readonly targets?: Targets;
  /** Names of undecided dumps that are. */
  readonly inFilePose: readonly string[];
  readonly diagnostics: readonly Diagnostic[];
}

/**
 * Compares, off the page. Rejects with the signal's reason if it is aborted.
 *
 * @param onProgress how much is done, from 0 to 1
 */
export type RunCompare = (
  input: CompareInput,
  signal: AbortSignal,
  onProgress: (share: number) => void,
) => Promise<CompareOutput>;

/** What was found. Its arrays fit the character. */
export interface ComparedResult {
  readonly comparison: Comparison;
  /** Theirs. `targets.frames[i]` was compared as `comparison.frames[i]`. */
  readonly targets: Targets;
  /** That was compared: the character may have been edited since. */
  readonly character: Character;
  readonly tolerance: number;
}

export type ComparePhase =
  | { readonly kind: 'working'; readonly share: number }
  /** With the problems of dumps that were left out, since they don't fit. */
  | { readonly kind: 'done'; readonly problems?: readonly Diagnostic[] }
  /** Cancelled by the user: the last result, if any, is of an earlier state. */
  | { readonly kind: 'cancelled' }
  /** The dumps don't fit the character. */
  | { readonly kind: 'misfit'; readonly diagnostics: readonly Diagnostic[] }
  | { readonly kind: 'failed'; readonly message: string };

export interface CompareState {
  /** In the order in which they were given. Those without a time have an assumed one, of the take. */
  readonly dumps: readonly NamedDump[];
  /** Names of those that were given last: the banner is about them. */
  readonly newest: readonly string[];
  /** Names of those that the newest took the place of, being of the same times; absent rather than empty. */
  readonly replaced?: readonly string[];
  readonly tolerance: number;
  readonly phase: ComparePhase;
  readonly result?: ComparedResult;
}

/** What was compared at the time shown. The same object while it stays the same. */
export interface ShownComparison {
  readonly result: ComparedResult;
  /** Into the frames. */
  readonly index: number;
  readonly theirs: FrameTarget;
  readonly frame: FrameComparison;
}

/** Of the workbench. */
interface Parts {
  readonly store: Store;
  readonly transport: Observable<Playback>;
}

interface CompareOptions {
  readonly isTrial?: boolean;
  readonly later?: (work: () => void, milliseconds: number) => () => void;
}

/** After the last of several edits, as a drag makes them. */
const QUIET_MS = 200;

export class DumpComparison {
  readonly state: Observable<CompareState>;
  readonly shown: Observable<ShownComparison | undefined> = observable<ShownComparison | undefined>(undefined);
  private readonly stops: (() => void)[];
  private running: AbortController | undefined;
  private waiting: (() => void) | undefined;
  private hasEnded = false;
  private isTrial: boolean;
  /** Dumps that were given since the last result. */
  private fresh: readonly NamedDump[];

  /**
   * Starts to compare.
   *
   * @param options.isTrial what is found first doesn't change the time shown; `reveal` does
   * @param options.later runs work after some milliseconds, and returns a function that prevents it
   */
  constructor(
    private readonly wb: Parts,
    readonly characterId: string,
    dumps: readonly NamedDump[],
    private readonly run: RunCompare,
    private readonly options: CompareOptions = {},
  ) {
    this.isTrial = options.isTrial ?? false;
    this.fresh = this.timed(dumps);
    this.state = observable<CompareState>({
      dumps: this.fresh,
      newest: dumps.map(({ fileName }) => fileName),
      tolerance: DEFAULT_TOLERANCE,
      phase: { kind: 'working', share: 0 },
    });
    this.stops = [
      this.state.subscribe(() => this.showFrame()),
      wb.transport.subscribe(() => this.showFrame()),
      wb.store.subscribe((now, before) => {
        if (now.document !== before.document) this.follow(now.document, before.document);
      }),
    ];
    void this.start();
  }

  /** Undefined while it is removed. */
  get character(): Character | undefined {
    return findCharacter(this.wb.store.document, this.characterId);
  }

  /** Adds dumps, in place of those of the same names, or of all if they are of the same times. */
  add(dumps: readonly NamedDump[]): Promise<void> {
    const names = new Set(dumps.map(({ fileName }) => fileName));
    const others = this.state.get().dumps.filter(({ fileName }) => !names.has(fileName));
    this.fresh = this.timed(dumps);
    this.forgetReplaced();
    this.change({ dumps: [...others, ...this.fresh], newest: [...names] });
    return this.start();
  }

  private forgetReplaced(): void {
    this.state.update(({ replaced: _before, ...rest }) => rest);
  }

  /** Removes one of several dumps. */
  remove(fileName: string): void {
    const dumps = this.state.get().dumps.filter((dump) => dump.fileName !== fileName);
    if (dumps.length === 0) return;
    this.change({ dumps });
    void this.start();
  }

  /** @param tolerance above 0 */
  setTolerance(tolerance: number): void {
    if (tolerance === this.state.get().tolerance) return;
    this.change({ tolerance });
    void this.start();
  }

  /** Of a dump that states none. @param time of the character's take; undefined: the file pose */
  setTime(fileName: string, time: number | undefined): void {
    const { dumps } = this.state.get();
    this.change({ dumps: dumps.map((dump) => (dump.fileName === fileName ? { ...dump, assumed: { time } } : dump)) });
    void this.start();
  }

  /** Stops the running comparison; `anew` starts it again. */
  cancel(): void {
    this.stopRunning();
    if (this.state.get().phase.kind === 'working') this.change({ phase: { kind: 'cancelled' } });
  }

  again(): void {
    void this.start();
  }

  /** Pauses, and shows the time of a frame; does nothing for the file pose of a character with a take. */
  goTo(index: number): void {
    const { character } = this;
    const frame = this.state.get().result?.comparison.frames[index];
    if (!character || !frame) return;
    const { time = isMoved(character) ? undefined : 0 } = frame;
    if (time !== undefined) this.goToTime(time);
  }

  /** @param time of the character's take */
  goToTime(time: number): void {
    const { character } = this;
    if (!character) return;
    const timeSeconds = transportTimeOf(character, time);
    this.wb.transport.update((now) => ({ ...now, timeSeconds, playing: false }));
  }

  /** Cancels it and stops following. */
  end(): void {
    this.hasEnded = true;
    this.stopRunning();
    for (const stop of this.stops) stop();
    this.shown.set(undefined);
  }

  private change(change: Partial<CompareState>): void {
    if (!this.hasEnded) this.state.update((now) => ({ ...now, ...change }));
  }

  private follow(now: Document, before: Document): void {
    const [is, was] = [findCharacter(now, this.characterId), findCharacter(before, this.characterId)];
    if (is === was) return;
    const { result } = this.state.get();
    if (result && !(is && fits(result.character, is))) this.state.update(({ result: _, ...rest }) => rest);
    this.showFrame();
    if (!is) this.stopRunning();
    else if (!was || !isSameFor(is, was)) {
      this.stopRunning();
      this.change({ phase: { kind: 'working', share: 0 } });
      const { later = afterTimeout } = this.options;
      this.waiting = later(() => void this.start(), QUIET_MS);
    }
  }

  private stopRunning(): void {
    this.waiting?.();
    this.waiting = undefined;
    this.running?.abort();
    this.running = undefined;
  }

  private async start(): Promise<void> {
    this.stopRunning();
    const { character } = this;
    if (!character || this.hasEnded) return;
    const running = new AbortController();
    this.running = running;
    this.change({ phase: { kind: 'working', share: 0 } });
    const { tolerance, dumps: all } = this.state.get();
    // Programs begin with the file pose, and say nothing of a time then.
    const undecided = this.fresh.map(({ fileName }) => fileName);
    const compare = (dumps: readonly NamedDump[]) =>
      this.run({ character: lean(character), dumps, undecided, tolerance }, running.signal, (share) => {
        if (this.running === running) this.change({ phase: { kind: 'working', share } });
      });
    let dumps = all;
    try {
      let output = await compare(dumps);
      const isRepeated = output.diagnostics.some(({ code }) => code === 'dump-repeated');
      let replaced: readonly string[] = [];
      if (isRepeated && this.fresh.length > 0 && this.fresh.length < all.length) {
        dumps = this.fresh;
        replaced = all.filter((dump) => !dumps.includes(dump)).map(({ fileName }) => fileName);
        output = await compare(dumps);
      }
      const rest = withoutMisfits(dumps, output.diagnostics);
      let problems: readonly Diagnostic[] = [];
      if (!output.targets && rest.length > 0 && rest.length < dumps.length) {
        problems = output.diagnostics;
        dumps = rest;
        output = await compare(rest);
      }
      if (this.running !== running) return;
      this.running = undefined;
      if (replaced.length > 0 && output.targets) this.change({ replaced });
      this.finish(character, dumps, { ...output, diagnostics: [...problems, ...output.diagnostics] });
    } catch (error) {
      // Cancelled, or followed by another.
      if (this.running !== running) return;
      this.running = undefined;
      this.change({ phase: { kind: 'failed', message: sentenceOf(error) } });
    }
  }

  private finish(
    character: Character,
    dumps: readonly NamedDump[],
    { comparison, targets, inFilePose, diagnostics }: CompareOutput,
  ): void {
    const isFresh = this.fresh.length > 0;
    this.fresh = [];
    if (comparison && targets) {
      const { tolerance } = this.state.get();
      this.change({
        dumps: dumps.map((dump) =>
          inFilePose.includes(dump.fileName) ? { ...dump, assumed: { time: undefined } } : dump,
        ),
        phase: { kind: 'done', ...(hasErrors(diagnostics) && { problems: diagnostics }) },
        result: { comparison, targets, character, tolerance },
      });
      if (isFresh && !this.isTrial) this.reveal();
      return;
    }
    const { result: _, ...now } = this.state.get();
    this.state.set({
      ...now,
      phase: hasErrors(diagnostics)
        ? { kind: 'misfit', diagnostics }
        : { kind: 'failed', message: 'Nothing could be compared.' },
    });
  }

  /** Those without a time are of the only one that others state, else of the time shown. */
  private timed(dumps: readonly NamedDump[]): readonly NamedDump[] {
    const stated = statedTimes(dumps);
    const time = stated.length === 1 ? stated[0] : takeTimeShown(this.wb, this.character);
    return dumps.map((dump) => (statesTime(dump) ? dump : { ...dump, assumed: { time } }));
  }

  /** Goes to the first time that differs, if none of the compared ones is shown, and nothing is lost by it. */
  reveal(): void {
    this.isTrial = false;
    if (this.shown.get() || this.character?.unkeyed) return;
    const wrong = this.state.get().result?.comparison.frames.findIndex(({ agrees }) => !agrees) ?? -1;
    this.goTo(Math.max(0, wrong));
  }

  private showFrame(): void {
    const { result } = this.state.get();
    const { character } = this;
    const index = result && character ? frameShown(this.wb, character, result.comparison.frames) : -1;
    const before = this.shown.get();
    if (!result || index < 0) this.shown.set(undefined);
    else if (before?.result !== result || before.index !== index) {
      const { comparison, targets } = result;
      this.shown.set({ result, index, theirs: targets.frames[index], frame: comparison.frames[index] });
    }
  }
}

function afterTimeout(work: () => void, milliseconds: number): () => void {
  const timer = setTimeout(work, milliseconds);
  return () => clearTimeout(timer);
}

function withoutMisfits(dumps: readonly NamedDump[], diagnostics: readonly Diagnostic[]): readonly NamedDump[] {
  const misfits = new Set(diagnostics.filter((d) => hasErrors([d])).map(({ file }) => file));
  return dumps.filter(({ fileName }) => !misfits.has(fileName));
}
