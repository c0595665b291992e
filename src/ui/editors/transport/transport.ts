/** The bar below the viewport: buttons, loop, speed, keying, time, and the tabs of the timeline. */

import { LOOP_MODES } from '../../../edit/playback.ts';
import { actionsOf, findAction, tryAction, tryById } from '../../state/actions/action.ts';
import { itemOf } from '../../state/actions/menu-entries.ts';
import { setActionTooltip } from '../../state/actions/tooltips.ts';
import { followWithNumbers } from '../../state/follow-time.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, keepsFocusElsewhere, setAttribute, setText, write } from '../../widgets/dom.ts';
import { toolbar } from '../../widgets/focus/roving.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { type IconName, icon } from '../../widgets/icons.ts';
import { type MenuEntry, menuButton } from '../../widgets/menu.ts';
import { NumberField } from '../../widgets/numbers/number-field.ts';
import { aligned, shown } from '../../widgets/numbers/number-text.ts';
import { LOOP_LABELS, RATES, rateText } from './actions.ts';

export function transport(
  wb: Uses<'store' | 'actions' | 'transport' | 'timeline' | 'settings' | 'messages'>,
  tabs: HTMLElement,
): HTMLElement {
  return element(
    'section',
    { class: 'transport', 'aria-label': 'Transport', 'data-panel': 'transport' },
    element(
      'div',
      { class: 'transport-row' },
      buttons(wb),
      element('div', { class: 'tools pace' }, loopMode(wb), rate(wb)),
      keying(wb),
      times(wb),
      tabs,
    ),
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

/** Its icon is the mode's. */
function loopMode(wb: Uses<'actions' | 'transport' | 'settings'>): HTMLElement {
  const made = element('button', { type: 'button', class: 'tool loop-mode' });
  const show = () => {
    const { loop } = wb.transport.get();
    made.replaceChildren(icon(loop), icon('fold'));
    setAttribute(made, 'aria-label', `Loop: ${LOOP_LABELS[loop].toLowerCase()}`);
  };
  menuButton(made, 'Loop', (): MenuEntry[] => {
    const actions = actionsOf(wb);
    return LOOP_MODES.flatMap((mode) => actions.filter((a) => a.id === `play.loop.${mode}`).map((a) => itemOf(wb, a)));
  });
  // One shortcut cycles through all of them.
  setActionTooltip(wb, made, 'play.nextLoop', () => `Loop: ${LOOP_LABELS[wb.transport.get().loop].toLowerCase()}`);
  wb.transport.subscribe((now, before) => {
    if (now.loop !== before.loop) show();
  });
  show();
  return keepsFocusElsewhere(made);
}

function rate(wb: Uses<'actions' | 'transport' | 'settings'>): HTMLElement {
  const made = element('button', { type: 'button', class: 'plain rate', tooltip: 'Speed' });
  const show = () => {
    const text = rateText(wb.transport.get().rate);
    made.textContent = text;
    setAttribute(made, 'aria-label', `Speed ${text}`);
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

/** Says that the stepped preview is on, which nothing else in the picture does, and switches it off. */
function steppedSwitch(wb: Uses<'actions' | 'settings'>): HTMLElement {
  const id = 'view.steppedPreview';
  const made = keepsFocusElsewhere(
    button('Stepped preview is on', { class: 'tool plain', 'aria-pressed': 'true' }, 'Stepped', () => tryById(wb, id)),
  );
  setActionTooltip(wb, made, id, 'Stepped preview is on: poses hold up to the next key');
  const show = () => write(made, 'hidden', !wb.settings.get().display.stepped);
  wb.settings.subscribe(show);
  show();
  return made;
}

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
    setAttribute(auto, 'aria-pressed', String(isOn()));
    document.documentElement.toggleAttribute('data-auto-key', isOn());
  };
  wb.timeline.autoKey.subscribe(show);
  show();
  return toolbar(element('div', { class: 'tools', 'aria-label': 'Keying' }, key, auto));
}

function times(wb: Uses<'actions' | 'transport' | 'settings' | 'messages'>): HTMLElement {
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
  const last = element('span', { class: 'faint last-frame' });
  const showTime = () => {
    const { timeSeconds, framesPerSecond } = wb.transport.get();
    time.show(timeSeconds);
    frame.show(noNoise(timeSeconds * framesPerSecond));
  };
  const show = oncePerFrame(() => {
    showTime();
    const { range, framesPerSecond } = wb.transport.get();
    setText(last, `of ${shown(noNoise(range[1] * framesPerSecond), 1)}`);
  });
  const refresh = oncePerFrame(() => {
    time.refresh();
    frame.refresh();
  });
  followWithNumbers(wb.transport, showTime);
  wb.transport.subscribe((now, before) => {
    if (now.range !== before.range || now.framesPerSecond !== before.framesPerSecond) show();
    if (now.playing !== before.playing) refresh();
  });
  show();
  const showUnit = () => {
    const inFrames = wb.settings.get().timeDisplay === 'frames';
    time.element.parentElement?.classList.toggle('secondary', inFrames);
    frame.element.parentElement?.classList.toggle('secondary', !inFrames);
  };
  wb.settings.subscribe(showUnit);
  showUnit();
  return element(
    'div',
    { class: 'times' },
    labelled('Time', time.element, 's'),
    labelled('Frame', frame.element, last),
    // Last, so that nothing moves when it appears.
    steppedSwitch(wb),
  );
}

/** Rounds to the whole frame if equal up to rounding errors. */
function noNoise(value: number): number {
  const rounded = Math.round(value);
  return Math.abs(value - rounded) < 1e-9 * Math.max(1, Math.abs(value)) ? rounded : value;
}

function labelled(label: string, field: HTMLElement, unit: string | HTMLElement): HTMLElement {
  return element(
    'label',
    { class: 'field' },
    element('span', { class: 'faint' }, label),
    field,
    typeof unit === 'string' ? element('span', { class: 'faint' }, unit) : unit,
  );
}
