/** The transport. */

import { LOOP_MODES, type LoopMode, type Playback, pause, play, stepFrames } from '../../../edit/playback.ts';
import { clipsRange, nextKey, previousKey, shownKeys } from '../../../evaluate/plot/shown-keys.ts';
import { playingCharacters } from '../../../model/document.ts';
import { shown } from '../../kit/number-text.ts';
import { needs } from '../../state/needs.ts';
import { stopsOnFrame } from '../../state/pause-playback.ts';
import type { Action, Uses } from '../../state/workbench.ts';
import { switchKinematics } from '../posing/actions.ts';
import { sayRange } from './range-edits.ts';

export const LOOP_LABELS: Readonly<Record<LoopMode, string>> = {
  once: 'Once',
  loop: 'Loop',
  pingpong: 'Ping-pong',
  continue: 'Continue past range',
};

export const RATES = [-4, -2, -1, -0.5, -0.25, 0.25, 0.5, 1, 2, 4] as const;

const hasKeys = needs(
  'There are no keys to step to.',
  (wb: Uses<'store'>) => shownKeys(wb.store.document, wb.store.selection).length > 0,
);

/** As in Maya, the playback range belongs to the page. */
const ONLY_PLAYED = 'Of playback; the take is saved with its own range';

export const PLAY_ACTIONS: readonly Action[] = [
  {
    id: 'play.toggle',
    name: 'Play or pause',
    label(wb) {
      if (switchesInstead(wb)) return wb.posing.mode.get() === 'fk' ? 'Switch to IK' : 'Switch to FK';
      return wb.transport.get().playing ? 'Pause' : 'Play';
    },
    group: 'Play',
    menu: 'Play',
    shortcuts: ['Space'],
    also: 'play or pause start stop playback',
    icon: 'play',
    run(wb, how) {
      if (how !== 'button' && switchesInstead(wb)) return switchKinematics(wb);
      wb.transport.update((p) => (p.playing ? pause(p, stopsOnFrame(wb)) : play(p)));
    },
  },
  at('play.stepBack', 'Step back one frame', ['Left'], 1, 'back', (p) => stepFrames(p, -1)),
  at('play.stepForward', 'Step forward one frame', ['Right'], 1, 'forward', (p) => stepFrames(p, 1)),
  {
    id: 'play.previousKey',
    unchanged: 'There is no key before the current time.',
    label: 'Go to previous key',
    group: 'Play',
    menu: 'Play',
    section: 1,
    shortcuts: [','],
    icon: 'previousKey',
    repeats: true,
    enabled: hasKeys,
    run: (wb) => toKey(wb, previousKey),
  },
  {
    id: 'play.nextKey',
    unchanged: 'There is no key after the current time.',
    label: 'Go to next key',
    group: 'Play',
    menu: 'Play',
    section: 1,
    shortcuts: ['.'],
    icon: 'nextKey',
    repeats: true,
    enabled: hasKeys,
    run: (wb) => toKey(wb, nextKey),
  },
  at('play.toStart', 'Go to range start', ['Home'], 1, 'start', (p) => ({ ...p, timeSeconds: p.range[0] })),
  at('play.toEnd', 'Go to range end', ['End'], 1, 'end', (p) => ({ ...p, timeSeconds: p.range[1], playing: false })),
  rangeEnd('play.setIn', 'Set range start', 'I', ({ timeSeconds, range }) => [
    timeSeconds,
    Math.max(timeSeconds, range[1]),
  ]),
  rangeEnd('play.setOut', 'Set range end', 'O', ({ timeSeconds, range }) => [
    Math.min(timeSeconds, range[0]),
    timeSeconds,
  ]),
  {
    id: 'play.wholeRange',
    label: 'Fit range to takes',
    group: 'Play',
    menu: 'Play',
    section: 2,
    shortcuts: ['Shift+I'],
    enabled: needs('There is no take whose range could play.', (wb) => clipsRange(wb.store.document) !== undefined),
    run(wb) {
      const range = clipsRange(wb.store.document);
      if (!range) return;
      wb.transport.update((p) => ({ ...p, range }));
      sayRange(wb);
    },
  },
  {
    id: 'play.nextLoop',
    label: 'Next loop mode',
    group: 'Play',
    shortcuts: ['L'],
    run: (wb) =>
      wb.transport.update((p) => ({
        ...p,
        loop: LOOP_MODES[(LOOP_MODES.indexOf(p.loop) + 1) % LOOP_MODES.length],
      })),
  },
  ...LOOP_MODES.map(
    (loop): Action => ({
      id: `play.loop.${loop}`,
      label: LOOP_LABELS[loop],
      group: 'Play',
      menu: 'Play/Loop',
      section: 3,
      icon: loop,
      radio: true,
      checked: (wb) => wb.transport.get().loop === loop,
      run: (wb) => wb.transport.update((p) => ({ ...p, loop })),
    }),
  ),
  ...RATES.map(
    (rate): Action => ({
      id: `play.rate.${rate}`,
      label: rateText(rate),
      group: 'Play',
      menu: 'Play/Speed',
      section: 3,
      radio: true,
      checked: (wb) => wb.transport.get().rate === rate,
      run: (wb) => wb.transport.update((p) => ({ ...p, rate })),
    }),
  ),
];

/** With nothing to play, Space switches between FK and IK. The transport's own button still plays: time passes. */
function switchesInstead(wb: Uses<'store' | 'transport'>): boolean {
  const { document } = wb.store;
  return !wb.transport.get().playing && document.characters.length > 0 && playingCharacters(document).length === 0;
}

/** `−½×`. */
export function rateText(rate: number): string {
  const size = Math.abs(rate);
  const text = size === 0.5 ? '½' : size === 0.25 ? '¼' : shown(size, 2);
  return `${rate < 0 ? '−' : ''}${text}×`;
}

function at(
  id: string,
  label: string,
  shortcuts: readonly string[],
  section: number,
  icon: Action['icon'],
  change: (playback: Playback) => Playback,
): Action {
  const run = (wb: Uses<'transport'>) => wb.transport.update(change);
  const repeats = id.startsWith('play.step');
  return {
    id,
    label,
    group: 'Play',
    menu: 'Play',
    section,
    shortcuts,
    repeats,
    run,
    ...(icon && { icon }),
  };
}

function rangeEnd(
  id: string,
  label: string,
  shortcut: string,
  rangeOf: (playback: Playback) => Playback['range'],
): Action {
  return {
    id,
    label,
    group: 'Play',
    menu: 'Play',
    section: 2,
    shortcuts: [shortcut],
    detail: ONLY_PLAYED,
    run(wb) {
      wb.transport.update((p) => ({ ...p, range: rangeOf(p) }));
      sayRange(wb);
    },
  };
}

function toKey(wb: Uses<'store' | 'transport'>, find: typeof nextKey): void {
  const keys = shownKeys(wb.store.document, wb.store.selection);
  wb.transport.update((p) => {
    const timeSeconds = find(keys, p.timeSeconds);
    return timeSeconds === undefined ? p : { ...p, timeSeconds, playing: false };
  });
}
