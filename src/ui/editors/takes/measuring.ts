/**
 * Keeps the distances of the two compared takes up to date: measured a few milliseconds at a time when either take or
 * the alignment changes. A change during a measurement waits for it, so that a drag always has a recent result.
 */
import { type ComparedJoints, comparedJoints } from '../../../evaluate/compare/compared-joints.ts';
import { rootTurn } from '../../../evaluate/compare/compared-roots.ts';
import { commonFrames, type Distances, measureDistances } from '../../../evaluate/compare/distance.ts';
import type { Alignment } from '../../../evaluate/compare/posed-joints.ts';
import { warpTakes } from '../../../evaluate/compare/warped-takes.ts';
import { type Character, shownTake } from '../../../model/document.ts';
import { runInSlices } from '../../../view/slices.ts';
import { type Compared, comparedIn } from '../../state/takes.ts';
import type { Uses } from '../../state/workbench.ts';
import { type Observable, observable } from '../../widgets/observable.ts';

/** A request; whether a result is still valid is decided by identity of its parts. */
interface Asked {
  readonly first: Character;
  readonly second: Character;
  readonly alignment: Alignment;
  readonly framesPerSecond: number;
}

export interface Measured extends Asked {
  readonly match: ComparedJoints;
  /** Absent: the takes don't overlap in time. */
  readonly distances?: Distances;
  /** Mean distance with time warp, over the whole takes. */
  readonly warped?: number;
}

export class Measuring {
  readonly result: Observable<Measured | undefined> = observable<Measured | undefined>(undefined);
  private asked: Asked | undefined;
  private running: Asked | undefined;
  private visible = false;

  constructor(private readonly wb: Uses<'store' | 'transport' | 'timeline'>) {
    const { store, timeline, transport } = wb;
    store.subscribe((now, before) => {
      if (now.document !== before.document) this.refresh();
    });
    timeline.takes.comparison.subscribe(() => this.refresh());
    timeline.takes.distances.subscribe((now, before) => {
      if (now.alignment !== before.alignment) this.refresh();
    });
    transport.subscribe((now, before) => {
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
    const compared = comparedIn(this.wb.store.document, this.wb.timeline.takes.comparison.get());
    this.asked = compared && this.askFor(compared);
    if (!this.asked) this.result.set(undefined);
    void this.run();
  }

  private askFor([{ character: first }, { character: second }]: readonly [Compared, Compared]): Asked {
    const { alignment } = this.wb.timeline.takes.distances.get();
    return { first, second, alignment, framesPerSecond: this.wb.transport.get().framesPerSecond };
  }

  private async run(): Promise<void> {
    if (this.running) return;
    for (;;) {
      const { asked } = this;
      if (!asked || sameMotion(asked, this.result.get())) return;
      this.running = asked;
      try {
        const measured = await measure(asked);
        // The comparison may have ended, or changed.
        if (this.asked && isOf(this.asked, asked)) this.result.set(measured);
      } finally {
        this.running = undefined;
      }
    }
  }
}

async function measure(asked: Asked): Promise<Measured> {
  const { first, second, alignment, framesPerSecond } = asked;
  const match = comparedJoints(first, second);
  const times = match.first.length ? commonFrames(first, second, framesPerSecond, match.first.length) : undefined;
  if (!times) return { ...asked, match };
  const turn = alignment === 'turned' ? rootTurn(first, second, match) : undefined;
  const work = measureDistances(first, second, match, times, alignment, turn);
  const distances = await runInSlices(work, NEVER);
  const warp = await runInSlices(warpTakes(first, second, match, alignment, framesPerSecond, turn), NEVER);
  return { ...asked, match, ...(distances && { distances }), ...(warp && { warped: warp.distance }) };
}

const NEVER = new AbortController().signal;

/** Whether both are about the same characters. */
function isOf(a: Asked, b: Asked): boolean {
  return a.first.id === b.first.id && a.second.id === b.second.id;
}

/** Whether nothing that a distance depends on has changed. */
function sameMotion(a: Asked, b: Asked | undefined): boolean {
  return (
    b !== undefined &&
    a.alignment === b.alignment &&
    a.framesPerSecond === b.framesPerSecond &&
    movesAlike(a.first, b.first) &&
    movesAlike(a.second, b.second)
  );
}

function movesAlike(a: Character, b: Character): boolean {
  return (
    a === b ||
    (a.id === b.id &&
      a.skeleton === b.skeleton &&
      a.driver === b.driver &&
      a.morphs === b.morphs &&
      a.pose === b.pose &&
      a.unkeyed === b.unkeyed &&
      a.clampsToLimits === b.clampsToLimits &&
      a.space === b.space &&
      a.timeOffsetSeconds === b.timeOffsetSeconds &&
      a.placements[0] === b.placements[0] &&
      shownTake(a) === shownTake(b))
  );
}
