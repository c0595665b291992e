/**
 * The moment that the last step has keyed, as a band on the ruler: it rises where the pose is eased in and falls where it
 * is eased out. Dragging an end, or arrow keys on it, key the moment anew with that easing, in place of the last step.
 * A click on an end is one on the ruler.
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
  const { timeline, store, transport } = wb;
  let edit: MomentEdit | undefined;
  const ends = SIDES.map(([side, label, way]): End => {
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
  });
  const rise = element('div', { class: 'moment-tent' });
  const band = element(
    'div',
    { class: 'moment-band', role: 'group', 'aria-label': 'Easing of the last moment', hidden: true },
    rise,
    ...ends.map(({ handle }) => handle),
  );
  ruler.after(band);

  /** While it is dragged, as it would be. */
  const now = () => {
    if (edit && !edit.isOver) return edit.args;
    const moment = timeline.moment.get();
    return moment && isLastMoment(wb, moment) ? moment.args : undefined;
  };
  const strip = () => ({ window: timeline.view.get().window, width: Math.max(1, ruler.clientWidth) });
  const show = () => {
    const args = now();
    write(band, 'hidden', args === undefined);
    if (!args) return;
    const x = (seconds: number) => timeX(strip(), seconds);
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
  };
  const showSoon = oncePerFrame(show);
  const seek = (seconds: number, shift: boolean) => {
    const timeSeconds = snapTime(seconds, secondsPerPixel(strip()), scrubFrames(wb, shift));
    transport.update((p) => ({ ...p, timeSeconds, playing: false }));
  };

  for (const { side, way, handle } of ends) {
    const ease = (made: MomentEdit, seconds: number) => {
      made.show({ ...made.args, [side]: wholeFrames(wb, seconds) });
      show();
    };
    handle.addEventListener('pointerdown', (event) => {
      const moment = timeline.moment.get();
      if (event.button !== 0 || edit || !moment || !now()) return;
      event.preventDefault();
      handle.focus({ preventScroll: true });
      const { left } = ruler.getBoundingClientRect();
      const secondsAt = ({ clientX }: PointerEvent) => timeAt(strip(), clientX - left);
      const { args } = moment;
      const beside = secondsAt(event) - args.timeSeconds - way * args[side];
      handle.classList.add('is-dragged');
      followPointer(handle, event, {
        move: (at) => {
          if (!edit && Math.abs(at.clientX - event.clientX) < TREMBLE_PIXELS) return;
          edit ??= new MomentEdit(wb, moment);
          if (!edit.isOver) ease(edit, way * (secondsAt(at) - beside - args.timeSeconds));
        },
        key: (key) => {
          if (key.key !== 'Escape') return;
          key.preventDefault();
          key.stopPropagation();
          edit?.cancel();
        },
        over: (_, release) => {
          handle.classList.remove('is-dragged');
          if (!edit && release) seek(secondsAt(release), release.shiftKey);
          else if (release) edit?.commit();
          else edit?.cancel();
          edit = undefined;
          show();
        },
      });
    });
    handle.addEventListener('keydown', (event) => {
      const moment = timeline.moment.get();
      const later = { ArrowLeft: -way, ArrowRight: way, ArrowUp: 1, ArrowDown: -1 }[event.key];
      if (later === undefined || edit || !moment || !now()) return;
      event.preventDefault();
      event.stopPropagation();
      const frames = (event.shiftKey ? MORE_FRAMES : FRAMES) * later;
      const made = new MomentEdit(wb, moment);
      ease(made, moment.args[side] + frames / transport.get().framesPerSecond);
      made.commit();
      show();
    });
  }
  timeline.moment.subscribe(show);
  timeline.view.subscribe((is, was) => {
    if (is.window !== was.window) showSoon();
  });
  store.subscribe((is, was) => {
    if (is.document !== was.document) showSoon();
  });
  new ResizeObserver(showSoon).observe(ruler);
  show();
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
