/** The bar below the viewport: buttons, loop, speed, time, range, and the scrubber. */

import { FRAME_RATES, LOOP_MODES } from '../../../edit/playback.ts';
import { actionsOf, findAction, tryAction, tryById } from '../../state/actions/action.ts';
import { itemOf } from '../../state/actions/menu-entries.ts';
import { keyNameOf, setActionTooltip } from '../../state/actions/tooltips.ts';
import { isPanelOpen, NARROW } from '../../state/panels/panels.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, keepsFocusElsewhere, setAttribute } from '../../widgets/dom.ts';
import { toolbar } from '../../widgets/focus/roving.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { type IconName, icon } from '../../widgets/icons.ts';
import { type MenuEntry, menuButton } from '../../widgets/menu.ts';
import { NumberField } from '../../widgets/numbers/number-field.ts';
import { aligned, shown } from '../../widgets/numbers/number-text.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { LOOP_LABELS, RATES, rateText } from './actions.ts';
import { typeRange } from './range-edits.ts';
import type { Scrubber } from './scrubber.ts';

export function transport(
  wb: Uses<'store' | 'actions' | 'transport' | 'timeline' | 'settings' | 'messages'>,
  scrubber: Scrubber,
  /** What opens the collapsed timeline. */
  openers: HTMLElement,
): HTMLElement {
  return element(
    'section',
    { class: 'transport', 'aria-label': 'Transport', 'data-panel': 'transport' },
    element(
      'div',
      { class: 'transport-row' },
      buttons(wb),
      loopModes(wb),
      rate(wb),
      keying(wb),
      timelineButton(wb),
      ...times(wb),
      openers,
      ...range(wb),
    ),
    scrubber.element,
  );
}

function buttons(wb: Uses<'actions' | 'transport' | 'settings'>): HTMLElement {
  const make = (id: string, label: string, name: IconName, extra = '') => {
    const made = keepsFocusElsewhere(button(label, { class: `tool ${extra}` }, icon(name), () => tryRun(wb, id)));
    setActionTooltip(wb, made, id, () => made.getAttribute('aria-label') ?? label);
    return made;
  };
  const play = make('play.toggle', 'Play', 'play', 'play-button');
  const showPlaying = (playing: boolean) => {
    play.replaceChildren(icon(playing ? 'pause' : 'play'));
    setAttribute(play, 'aria-label', playing ? 'Pause' : 'Play');
    play.classList.toggle('is-playing', playing);
  };
  wb.transport.subscribe((now, before) => {
    if (now.playing !== before.playing) showPlaying(now.playing);
  });
  showPlaying(wb.transport.get().playing);
  return toolbar(
    element(
      'div',
      { class: 'tools playback', 'aria-label': 'Playback' },
      make('play.toStart', 'Go to range start', 'start'),
      make('play.previousKey', 'Go to previous key', 'previousKey'),
      make('play.stepBack', 'Step back one frame', 'back'),
      play,
      make('play.stepForward', 'Step forward one frame', 'forward'),
      make('play.nextKey', 'Go to next key', 'nextKey'),
      make('play.toEnd', 'Go to range end', 'end'),
    ),
  );
}

/** Runs an action that may be impossible now, such as jumping to a key. */
function tryRun(wb: Uses<'actions'>, id: string): void {
  const action = findAction(wb, id);
  if (action) tryAction(wb, action, 'button');
}

function loopModes(wb: Uses<'actions' | 'transport' | 'settings'>): HTMLElement {
  const made = LOOP_MODES.map((mode) => ({
    mode,
    button: keepsFocusElsewhere(
      button(LOOP_LABELS[mode], { class: 'tool', role: 'radio' }, icon(mode), () => tryById(wb, `play.loop.${mode}`)),
    ),
  }));
  // One shortcut cycles through all of them.
  for (const { mode, button } of made) setActionTooltip(wb, button, 'play.nextLoop', LOOP_LABELS[mode]);
  const show = () => {
    for (const { mode, button } of made) {
      const chosen = wb.transport.get().loop === mode;
      button.setAttribute('aria-checked', String(chosen));
      button.tabIndex = chosen ? 0 : -1;
    }
  };
  const group = element('div', { class: 'tools segmented loop-modes', role: 'radiogroup', 'aria-label': 'Loop' });
  group.append(...made.map((m) => m.button));
  group.addEventListener('keydown', (event) => {
    const step = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
    if (!step) return;
    event.preventDefault();
    const now = LOOP_MODES.indexOf(wb.transport.get().loop);
    const next = (now + step + LOOP_MODES.length) % LOOP_MODES.length;
    tryById(wb, `play.loop.${LOOP_MODES[next]}`);
    made[next].button.focus();
  });
  wb.transport.subscribe((now, before) => {
    if (now.loop !== before.loop) show();
  });
  show();
  return group;
}

function rate(wb: Uses<'actions' | 'transport' | 'settings'>): HTMLElement {
  const made = element('button', { type: 'button', class: 'plain rate', tooltip: 'Speed' });
  const show = () => {
    const text = rateText(wb.transport.get().rate);
    made.textContent = text;
    made.setAttribute('aria-label', `Speed ${text}`);
  };
  menuButton(made, 'Speed', (): MenuEntry[] => {
    const actions = actionsOf(wb);
    return RATES.flatMap((r) => actions.filter((a) => a.id === `play.rate.${r}`).map((a) => itemOf(wb, a)));
  });
  wb.transport.subscribe((now, before) => {
    if (now.rate !== before.rate) show();
  });
  show();
  return keepsFocusElsewhere(made);
}

const KEY_LABEL = 'Key changes (or the selected joint)';

/** The record switch: red while on, like the frame of the viewport. */
function keying(wb: Uses<'actions' | 'timeline' | 'settings'>): HTMLElement {
  const key = keepsFocusElsewhere(button(KEY_LABEL, { class: 'tool' }, icon('key'), () => tryRun(wb, 'key.changed')));
  setActionTooltip(wb, key, 'key.changed', KEY_LABEL);
  const auto = keepsFocusElsewhere(
    button('Auto-key', { class: 'tool auto-key' }, icon('record'), () => tryById(wb, 'key.auto')),
  );
  const isOn = () => wb.timeline.autoKey.get();
  setActionTooltip(wb, auto, 'key.auto', () =>
    isOn() ? 'Auto-key is on: changes are keyed automatically' : 'Auto-key: key changes automatically',
  );
  const show = () => {
    auto.setAttribute('aria-pressed', String(isOn()));
    document.documentElement.toggleAttribute('data-auto-key', isOn());
  };
  wb.timeline.autoKey.subscribe(show);
  show();
  return toolbar(element('div', { class: 'tools', 'aria-label': 'Keying' }, key, auto));
}

/** Opens and closes the timeline on a narrow page, where it is a drawer. */
function timelineButton(wb: Uses<'actions' | 'settings'>): HTMLElement {
  const label = 'Timeline panel';
  const made = keepsFocusElsewhere(
    button(label, { class: 'tool timeline-button' }, icon('clip'), () => tryById(wb, 'page.timeline')),
  );
  setActionTooltip(wb, made, 'page.timeline', label);
  const show = () => made.setAttribute('aria-pressed', String(isPanelOpen(wb.settings.get(), 'timeline')));
  wb.settings.subscribe(show);
  window.matchMedia(NARROW).addEventListener('change', show);
  show();
  return made;
}

function times(wb: Uses<'transport' | 'settings' | 'messages'>): HTMLElement[] {
  const at = (timeSeconds: number) => wb.transport.update((p) => ({ ...p, timeSeconds, playing: false }));
  const refuse = (reason: string) => wb.messages.note(reason, 'warning');
  const time = new NumberField({
    label: 'Time in seconds',
    class: 'time-field',
    text: (value) => (wb.transport.get().playing ? aligned(value) : shown(value)),
    commit: at,
    refuse,
    step: 0.01,
  });
  const frame = new NumberField({
    label: 'Frame',
    class: 'frame-field',
    text: (value) => (wb.transport.get().playing ? aligned(value, 1) : shown(value)),
    commit: (value) => at(value / wb.transport.get().framesPerSecond),
    refuse,
    step: 1,
  });
  const fps = new NumberField({
    label: 'Frames per second',
    class: 'fps-field',
    text: (value) => shown(value),
    commit(framesPerSecond) {
      const [least, most] = FRAME_RATES;
      if (framesPerSecond >= least && framesPerSecond <= most) wb.transport.update((p) => ({ ...p, framesPerSecond }));
      else refuse(`Frames per second must be from ${least} to ${most}; you entered ${framesPerSecond}.`);
    },
    refuse,
    step: 1,
  });
  const show = oncePerFrame(() => {
    const { timeSeconds, framesPerSecond } = wb.transport.get();
    time.show(timeSeconds);
    frame.show(noNoise(timeSeconds * framesPerSecond));
    fps.show(framesPerSecond);
  });
  const refresh = oncePerFrame(() => {
    time.refresh();
    frame.refresh();
  });
  wb.transport.subscribe((now, before) => {
    show();
    if (now.playing !== before.playing) refresh();
  });
  show();
  const showUnit = () => {
    const inFrames = wb.settings.get().timeDisplay === 'frames';
    time.element.parentElement?.classList.toggle('secondary', inFrames);
    frame.element.parentElement?.classList.toggle('secondary', !inFrames);
  };
  const fields = [labelled('Time', time.element, 's'), labelled('Frame', frame.element), labelled('fps', fps.element)];
  wb.settings.subscribe(showUnit);
  showUnit();
  return [element('div', { class: 'fields times' }, ...fields)];
}

function range(wb: Uses<'store' | 'actions' | 'transport' | 'settings' | 'messages'>): HTMLElement[] {
  const inFrames = () => wb.settings.get().timeDisplay === 'frames';
  const perUnit = () => (inFrames() ? wb.transport.get().framesPerSecond : 1);
  const end = (label: string, make: (value: number, now: readonly [number, number]) => readonly [number, number]) =>
    new NumberField({
      label,
      class: 'range-field',
      text: (value) => shown(value),
      commit(value) {
        typeRange(wb, make(value / perUnit(), wb.transport.get().range));
        // Reverts a refused value.
        show();
      },
      refuse: (reason) => wb.messages.note(reason, 'warning'),
    });
  const first = end('Range start', (value, now) => [value, now[1]]);
  const last = end('Range end', (value, now) => [now[0], value]);
  const show = () => {
    const [from, to] = wb.transport.get().range;
    first.show(noNoise(from * perUnit()));
    last.show(noNoise(to * perUnit()));
  };
  const begins = labelled('Range', first.element);
  // The fields' tooltips show exact numbers; shortcuts are in the labels' tooltips.
  setTooltip(begins, () => {
    const keys = [
      ['play.setIn', 'Start here'],
      ['play.setOut', 'End here'],
      ['play.wholeRange', 'Whole take'],
    ].map(([id, text]) => {
      const key = keyNameOf(wb, id);
      return key ? `${text} (${key})` : text;
    });
    return `Playback range, saved with the take. ${keys.join(', ')}`;
  });
  wb.transport.subscribe(show);
  wb.settings.subscribe(show);
  show();
  return [
    element('div', { class: 'fields range-fields' }, begins, element('span', { class: 'faint' }, '–'), last.element),
  ];
}

/** Rounds to the whole frame if equal up to rounding errors. */
function noNoise(value: number): number {
  const rounded = Math.round(value);
  return Math.abs(value - rounded) < 1e-9 * Math.max(1, Math.abs(value)) ? rounded : value;
}

function labelled(label: string, field: HTMLElement, unit?: string): HTMLElement {
  return element(
    'label',
    { class: 'field' },
    element('span', { class: 'faint' }, label),
    field,
    unit && element('span', { class: 'faint' }, unit),
  );
}
