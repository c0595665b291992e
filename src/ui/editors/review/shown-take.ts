/** The take with the focus plays in the viewport, in place of the document's characters, without being opened. */
import { countedAt, DEFAULT_PLAYBACK, pause, play } from '../../../edit/playback.ts';
import { frameRateOf } from '../../../evaluate/samples/frame-rate.ts';
import { rangeOfTakes, shownTake } from '../../../model/document.ts';
import type { Workbench } from '../../state/workbench.ts';

export class ShownTake {
  private path: string | undefined;
  /** Counts what was asked for: an earlier file may come later. */
  private asked = 0;

  constructor(private readonly wb: Workbench) {}

  /** Shows the take of a path, or the document again. */
  async show(path: string | undefined): Promise<void> {
    const { shown, files } = this.wb.timeline.review;
    if (path === this.path && (shown.get() !== undefined) === (path !== undefined)) return;
    this.path = path;
    const asked = ++this.asked;
    const found =
      path === undefined
        ? undefined
        : await files
            .get()
            ?.character(path)
            .catch(() => undefined);
    if (asked !== this.asked) return;
    const { transport, store, viewport } = this.wb;
    const before = shown.get();
    if (!found) {
      if (!before) return;
      shown.set(undefined);
      const range = rangeOfTakes(store.document) ?? DEFAULT_PLAYBACK.range;
      transport.update((now) => pause({ ...now, range, timeSeconds: range[0] }, false));
      if (store.document.characters.length > 0) viewport.camera.frameAll();
      return;
    }
    shown.set(found);
    viewport.camera.frameAll();
    const take = shownTake(found);
    if (!take) return;
    const isStill = window.matchMedia('(prefers-reduced-motion: reduce)').matches;
    const fps = frameRateOf(take);
    transport.update((now) => {
      const next = { ...countedAt(now, fps), range: take.range, timeSeconds: take.range[0] };
      return (before ? now.playing : !isStill) ? play(next) : pause(next, false);
    });
  }

  /** A moment of the take, as soon as it is shown. */
  async seek(path: string, seconds: number): Promise<void> {
    await this.show(path);
    this.wb.transport.update((now) => ({ ...pause(now, false), timeSeconds: seconds }));
  }
}
