/** The transport. */

import { LOOP_MODES, type LoopMode, type Playback, pause, play, stepFrames } from '../../../edit/playback.ts';
import { nextKey, previousKey, shownKeys, takesRange } from '../../../evaluate/plot/shown-keys.ts';
import { playingCharacters, shownTake } from '../../../model/document.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { needs } from '../../state/actions/needs.ts';
import { onDemand } from '../../state/on-demand.ts';
import { isBarShown, openPanel } from '../../state/panels/panels.ts';
import { stopsOnFrame } from '../../state/pause-playback.ts';
import type { Action, Uses } from '../../state/workbench.ts';
import { focusField } from '../../widgets/focus/focus-regions.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import { nextKinematics, switchKinematics } from '../posing/actions.ts';
import { shownMarkers } from '../timeline/markers/shown-markers.ts';
import { TURN } from '../viewport/actions.ts';
import { sayRange } from './range-text.ts';

export const LOOP_LABELS: Readonly<Record<LoopMode, string>> = {
  once: 'Once',
  loop: 'Loop',
  pingpong: 'Ping-pong',
  continue: 'Continue past range',
};

export const RATES = [-4, -2, -1, -0.5, -0.25, 0.25, 0.5, 1, 2, 4] as const;

const needsKeys = needs(
  'There are no keys to go to.',
  (wb: Uses<'store'>) => shownKeys(wb.store.document, wb.store.selection).length > 0,
);

const needsTake = needs('Markers belong to a take. Show one first.', (wb: Uses<'store'>) => {
  const character = currentCharacter(wb);
  return character !== undefined && shownTake(character) !== undefined;
});

/** As in Maya, the playback range belongs to the page. */
const ONLY_PLAYED = 'Playback only; the take keeps its own range';

export const PLAY_ACTIONS: readonly Action[] = [
  {
    id: 'play.toggle',
    name: 'Play or pause',
    label(wb) {
      if (hasNothingToPlay(wb)) return nextKinematics(wb.posing.mode.get()) === 'ik' ? 'Switch to IK' : 'Switch to FK';
      return wb.transport.get().playing ? 'Pause' : 'Play';
    },
    group: 'Play',
    menu: 'Play',
    shortcuts: ['Space'],
    also: 'play or pause start stop playback',
    icon: 'play',
    run(wb, how) {
      if (how !== 'button' && hasNothingToPlay(wb)) return switchKinematics(wb);
      wb.transport.update((p) => (p.playing ? pause(p, stopsOnFrame(wb)) : play(p)));
    },
  },
  step('play.stepBack', 'back', 'Left', -1),
  step('play.stepForward', 'forward', 'Right', 1),
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
    refuses: needsKeys,
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
    refuses: needsKeys,
    run: (wb) => toKey(wb, nextKey),
  },
  at('play.toStart', 'Go to range start', ['Home'], 1, 'start', (p) => ({ ...p, timeSeconds: p.range[0] })),
  at('play.toEnd', 'Go to range end', ['End'], 1, 'end', (p) => ({ ...p, timeSeconds: p.range[1], playing: false })),
  {
    id: 'play.toTime',
    label: 'Go to time…',
    group: 'Play',
    menu: 'Play',
    section: 1,
    also: 'seconds scrub seek type',
    quiet: true,
    run(wb) {
      if (!isBarShown(wb)) openPanel(wb, 'timeline', true);
      focusField('input.time-field');
    },
  },
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
    refuses: needs('There is no take to fit the range to.', (wb) => takesRange(wb.store.document) !== undefined),
    run(wb) {
      const range = takesRange(wb.store.document);
      if (!range) return;
      wb.transport.update((p) => ({ ...p, range }));
      sayRange(wb);
    },
  },
  {
    id: 'marker.add',
    label: 'Add marker',
    group: 'Play',
    menu: 'Play/Markers',
    section: 2,
    shortcuts: ['M'],
    refuses: needsTake,
    run: async (wb) => (await markerEdits(wb))?.addMarkerHere(wb),
  },
  {
    id: 'marker.addSpan',
    label: 'Add span of playback range',
    group: 'Play',
    menu: 'Play/Markers',
    section: 2,
    refuses: needsTake,
    run: async (wb) => (await markerEdits(wb))?.addSpanOfRange(wb),
  },
  {
    id: 'marker.list',
    label: 'Markers…',
    also: 'rename delete move labels spans',
    group: 'Play',
    menu: 'Play/Markers',
    section: 2,
    refuses: needsTake,
    run: (wb) => wb.dialog.set('markers'),
  },
  toMarker('marker.previous', 'Go to previous marker', (times, now) =>
    times.findLast((time) => time < now - SAME_TIME),
  ),
  toMarker('marker.next', 'Go to next marker', (times, now) => times.find((time) => time > now + SAME_TIME)),
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

/**
 * With nothing to play, Space switches between FK and IK, and the arrow keys turn the character, as programs that pose
 * have it. The transport's own buttons still play and step: time passes.
 */
function hasNothingToPlay(wb: Uses<'store' | 'transport' | 'timeline'>): boolean {
  const { document } = wb.store;
  const isPlaying = wb.transport.get().playing || wb.timeline.review.shown.get() !== undefined;
  return !isPlaying && document.characters.length > 0 && playingCharacters(document).length === 0;
}

function step(id: string, icon: 'back' | 'forward', key: 'Left' | 'Right', way: 1 | -1): Action {
  return {
    id,
    name: `Step ${icon} one frame; without a take, turn the character ${key.toLowerCase()}`,
    label: (wb) => (hasNothingToPlay(wb) ? `Turn character ${key.toLowerCase()}` : `Step ${icon} one frame`),
    group: 'Play',
    menu: 'Play',
    section: 1,
    shortcuts: [key],
    icon,
    repeats: true,
    run(wb, how) {
      const character = how === 'button' || !hasNothingToPlay(wb) ? undefined : currentCharacter(wb);
      if (character) wb.viewport.camera.turnCharacter(character.id, way * TURN);
      else wb.transport.update((p) => stepFrames(p, way));
    },
  };
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
  return {
    id,
    label,
    group: 'Play',
    menu: 'Play',
    section,
    shortcuts,
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

const markerEdits = (wb: Uses<'messages'>) =>
  onDemand(wb.messages, 'Markers', () => import('../timeline/markers/marker-edits.ts'));

/** Times closer than this are the same; seconds. */
const SAME_TIME = 1e-6;

function toMarker(
  id: string,
  label: string,
  find: (times: readonly number[], now: number) => number | undefined,
): Action {
  return {
    id,
    label,
    group: 'Play',
    menu: 'Play/Markers',
    section: 3,
    unchanged: 'There is no marker in that direction.',
    refuses: needs('The take has no markers. M adds one.', (wb: Uses<'store'>) => shownMarkers(wb).length > 0),
    run(wb) {
      const times = shownMarkers(wb).map(({ timeSeconds }) => timeSeconds);
      wb.transport.update((p) => {
        const timeSeconds = find(times, p.timeSeconds);
        return timeSeconds === undefined ? p : { ...p, timeSeconds, playing: false };
      });
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
