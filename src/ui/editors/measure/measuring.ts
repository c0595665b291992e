/**
 * Keeps the tracks of the shown characters up to date, a few milliseconds at a time. A change during a measurement
 * waits for it, so that a drag always has a recent result.
 */
import { trackJoints } from '../../../evaluate/measure/tracks.ts';
import { runInSlices } from '../../../view/slices.ts';
import type { Uses } from '../../state/workbench.ts';
import { type Observable, observable } from '../../widgets/observable.ts';
import { isTooLong, MAX_OVERLAID, type Measured, type Source, sourcesOf } from './series.ts';

export interface MeasuredAll {
  readonly sources: readonly Source[];
  /** Of the first `MAX_OVERLAID` sources, but those that are too long. */
  readonly all: readonly Measured[];
}

const NEVER = new AbortController().signal;

export class Measuring {
  readonly result: Observable<MeasuredAll | undefined> = observable<MeasuredAll | undefined>(undefined);
  private visible = false;
  private isRunning = false;
  private asked: readonly Source[] = [];

  constructor(private readonly wb: Uses<'store' | 'transport' | 'timeline'>) {
    wb.store.subscribe((now, before) => {
      if (now.document !== before.document || now.selection !== before.selection) this.refresh();
    });
    wb.timeline.takes.comparison.subscribe(() => this.refresh());
    wb.transport.subscribe((now, before) => {
      if (now.framesPerSecond !== before.framesPerSecond) this.refresh();
    });
  }

  /** Measures only while visible. */
  setVisible(visible: boolean): void {
    this.visible = visible;
    this.refresh();
  }

  private refresh(): void {
    if (!this.visible) return;
    this.asked = sourcesOf(this.wb);
    void this.run();
  }

  private async run(): Promise<void> {
    if (this.isRunning) return;
    this.isRunning = true;
    try {
      while (!isSame(this.asked, this.result.get()?.sources)) {
        const sources = this.asked;
        const known = this.result.get()?.all ?? [];
        const all: Measured[] = [];
        for (const source of sources.slice(0, MAX_OVERLAID)) {
          if (isTooLong(source)) continue;
          const before = known.find((one) => isAlike(one.source, source));
          const { character, frames, joints } = source;
          const tracks = before?.tracks ?? (await runInSlices(trackJoints(character, frames, joints), NEVER));
          if (tracks) all.push({ source, tracks });
        }
        this.result.set({ sources, all });
      }
    } finally {
      this.isRunning = false;
    }
  }
}

function isSame(a: readonly Source[], b: readonly Source[] | undefined): boolean {
  return a.length === b?.length && a.every((source, i) => isAlike(source, b[i]));
}

function isAlike(a: Source, b: Source): boolean {
  return (
    a.character === b.character &&
    a.frames.frameSeconds === b.frames.frameSeconds &&
    a.frames.frameCount === b.frames.frameCount &&
    a.joints.length === b.joints.length &&
    a.joints.every((joint, i) => joint === b.joints[i])
  );
}
