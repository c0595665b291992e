/**
 * The moment that the last step has keyed, as a band on the ruler: it rises where the pose is eased in and falls where
 * it is eased out. Dragging an end, or arrow keys on it, key the moment anew with that easing, in place of the last
 * step. A click on an end is one on the ruler.
 */
import { keyForMoment } from '../../../edit/commands/moment.ts';
import type { Gesture } from '../../../edit/store.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { isLastMoment, keepMoment, wholeFrames } from '../../state/add-keys.ts';
import type { Easing, KeyedMoment } from '../../state/cycle-question.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, setAttribute, setText, write } from '../../widgets/dom.ts';
import { followPointer } from '../../widgets/drag.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import { secondsPerPixel, snapTime, timeAt, timeX } from '../../widgets/time/time-window.ts';
import { scrubFrames } from '../timeline/scrub-frames.ts';

type Parts = Uses<'store' | 'transport' | 'timeline' | 'messages'>;
type Side = keyof Easing;

/** Which end of the band it is, and its direction in time. */
const SIDES: readonly (readonly [side: Side, label: string, way: 1 | -1])[] = [
  ['easeIn', 'Ease in', -1],
  ['easeOut', 'Ease out', 1],
];
/** Frames of an arrow key, and with Shift. */
const FRAMES = 1;
const MORE_FRAMES = 10;
/** A press that moves less is a click. */
const TREMBLE_PIXELS = 3;

interface End {
  readonly side: Side;
  readonly way: 1 | -1;
  readonly handle: HTMLElement;
  readonly text: HTMLElement;
}

/** Stays for as long as the page. @param ruler whose times it shares, and after which it is put */
export function momentBand(wb: Parts, ruler: HTMLElement): void {
  new MomentBand(wb, ruler).follow();
}

class MomentBand {
  private readonly ends = SIDES.map(endOf);
  private readonly rise = element('div', { class: 'moment-tent' });
  private readonly band = element(
    'div',
    { class: 'moment-band', role: 'group', 'aria-label': 'Easing of the last moment', hidden: true },
    this.rise,
    ...this.ends.map(({ handle }) => handle),
  );
  private edit: MomentEdit | undefined;

  constructor(
    private readonly wb: Parts,
    private readonly ruler: HTMLElement,
  ) {
    ruler.after(this.band);
    for (const end of this.ends) {
      end.handle.addEventListener('pointerdown', (event) => this.drag(end, event));
      end.handle.addEventListener('keydown', (event) => this.onKey(end, event));
    }
  }

  follow(): void {
    const { timeline, store } = this.wb;
    const show = () => this.show();
    const showSoon = oncePerFrame(show);
    timeline.moment.subscribe(show);
    timeline.view.subscribe((is, was) => {
      if (is.window !== was.window) showSoon();
    });
    store.subscribe((is, was) => {
      if (is.document !== was.document) showSoon();
    });
    new ResizeObserver(showSoon).observe(this.ruler);
    show();
  }

  /** While it is dragged, as it would be. */
  private now(): KeyedMoment['args'] | undefined {
    const { edit, wb } = this;
    if (edit && !edit.isOver) return edit.args;
    const moment = wb.timeline.moment.get();
    return moment && isLastMoment(wb, moment) ? moment.args : undefined;
  }

  private strip() {
    return { window: this.wb.timeline.view.get().window, width: Math.max(1, this.ruler.clientWidth) };
  }

  private show(): void {
    const { band, rise, ruler, ends } = this;
    const args = this.now();
    write(band, 'hidden', args === undefined);
    if (!args) return;
    const x = (seconds: number) => timeX(this.strip(), seconds);
    const [from, at, to] = [args.timeSeconds - args.easeIn, args.timeSeconds, args.timeSeconds + args.easeOut].map(x);
    band.style.left = `${ruler.offsetLeft}px`;
    band.style.width = `${ruler.clientWidth}px`;
    rise.style.left = `${from}px`;
    rise.style.width = `${to - from}px`;
    rise.style.setProperty('--peak', `${at - from}px`);
    for (const { side, handle, text } of ends) {
      handle.style.left = `${side === 'easeIn' ? from : to}px`;
      setText(text, `${shown(args[side])} s`);
      setAttribute(handle, 'aria-valuenow', String(args[side]));
      setAttribute(handle, 'aria-valuetext', `${shown(args[side])} seconds`);
    }
  }

  private seek(seconds: number, shift: boolean): void {
    const { wb } = this;
    const timeSeconds = snapTime(seconds, secondsPerPixel(this.strip()), scrubFrames(wb, shift));
    wb.transport.update((p) => ({ ...p, timeSeconds, playing: false }));
  }

  private ease(made: MomentEdit, side: Side, seconds: number): void {
    made.show({ ...made.args, [side]: wholeFrames(this.wb, seconds) });
    this.show();
  }

  private drag({ side, way, handle }: End, event: PointerEvent): void {
    const moment = this.wb.timeline.moment.get();
    if (event.button !== 0 || this.edit || !moment || !this.now()) return;
    event.preventDefault();
    handle.focus({ preventScroll: true });
    const { left } = this.ruler.getBoundingClientRect();
    const secondsAt = ({ clientX }: PointerEvent) => timeAt(this.strip(), clientX - left);
    const { args } = moment;
    const beside = secondsAt(event) - args.timeSeconds - way * args[side];
    handle.classList.add('is-dragged');
    followPointer(handle, event, {
      move: (at) => {
        if (!this.edit && Math.abs(at.clientX - event.clientX) < TREMBLE_PIXELS) return;
        this.edit ??= new MomentEdit(this.wb, moment);
        if (!this.edit.isOver) this.ease(this.edit, side, way * (secondsAt(at) - beside - args.timeSeconds));
      },
      key: (key) => {
        if (key.key !== 'Escape') return;
        key.preventDefault();
        key.stopPropagation();
        this.edit?.cancel();
      },
      over: (_, release) => {
        handle.classList.remove('is-dragged');
        if (!this.edit && release) this.seek(secondsAt(release), release.shiftKey);
        else if (release) this.edit?.commit();
        else this.edit?.cancel();
        this.edit = undefined;
        this.show();
      },
    });
  }

  private onKey({ side, way }: End, event: KeyboardEvent): void {
    const { wb } = this;
    const moment = wb.timeline.moment.get();
    const later = { ArrowLeft: -way, ArrowRight: way, ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (later === undefined || this.edit || !moment || !this.now()) return;
    event.preventDefault();
    event.stopPropagation();
    const frames = (event.shiftKey ? MORE_FRAMES : FRAMES) * later;
    const made = new MomentEdit(wb, moment);
    this.ease(made, side, moment.args[side] + frames / wb.transport.get().framesPerSecond);
    made.commit();
    this.show();
  }
}

function endOf([side, label, way]: (typeof SIDES)[number]): End {
  const text = element('span', { class: 'moment-text' });
  const handle = element(
    'div',
    {
      class: 'moment-end',
      role: 'slider',
      tabindex: 0,
      'aria-label': label,
      'aria-valuemin': 0,
      tooltip: `${label}: drag it, or ← →`,
    },
    text,
  );
  return { side, way, handle, text };
}

/** Takes the last step back and makes another in its place. */
class MomentEdit {
  args: KeyedMoment['args'];
  private readonly gesture: Gesture;

  constructor(
    private readonly wb: Parts,
    { args, label = '' }: KeyedMoment,
  ) {
    this.args = args;
    wb.store.undo();
    this.gesture = wb.store.begin(label);
  }

  /** Something else has changed the document, or it was given up. */
  get isOver(): boolean {
    return this.gesture.closed;
  }

  show(args: KeyedMoment['args']): void {
    this.args = args;
    attempt(this.wb.messages, () => this.gesture.preview(keyForMoment.run(this.gesture.base, args)));
  }

  commit(): void {
    if (this.isOver) return;
    const { wb, args } = this;
    this.gesture.commit();
    wb.timeline.easing.set({ easeIn: args.easeIn, easeOut: args.easeOut });
    keepMoment(wb, args);
  }

  /** The last step is there again. */
  cancel(): void {
    if (this.isOver) return;
    const { wb } = this;
    const before = wb.timeline.moment.get();
    this.gesture.cancel();
    wb.store.redo();
    if (before) keepMoment(wb, before.args);
  }
}
