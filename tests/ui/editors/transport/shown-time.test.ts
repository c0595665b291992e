import fc from 'fast-check';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { LOOP_MODES } from '../../../../src/edit/playback.ts';
import { startPlayer } from '../../../../src/ui/editors/transport/player.ts';
import { runAction } from '../../../../src/ui/state/actions/action.ts';
import { followWithNumbers } from '../../../../src/ui/state/follow-time.ts';
import { type FramePhase, oncePerFrame } from '../../../../src/ui/widgets/frame.ts';
import { character, documentOf, take, workbench } from '../../builders.ts';

let frames: ((now: number) => void)[] = [];
let stop = new AbortController();
const runFrame = (now: number) => {
  const due = frames;
  frames = [];
  for (const callback of due) callback(now);
};

beforeEach(() => {
  frames = [];
  vi.stubGlobal('requestAnimationFrame', (callback: (now: number) => void) => frames.push(callback));
});
afterEach(() => void vi.unstubAllGlobals());

/** What shows the time, in the order of its requests, which is another one in each page. */
const DISPLAYS = ['scrubber', 'curves', 'dope sheet', 'picture'] as const;
/** Frames of the test go on where those of the test before ended: numbers are shown by the clock. */
let now = 2e6;
/** Frames that numbers may be behind while it plays, and so many milliseconds if they are longer. */
const BEHIND_FRAMES = 10;
const BEHIND_MS = 100;

/** What happens between two frames; a number of milliseconds is one of them. */
const event = fc.oneof(
  fc.constant('play.toggle' as const),
  fc.record({ seek: fc.double({ min: -1, max: 3, noNaN: true }) }),
  fc.record({ loop: fc.constantFrom(...LOOP_MODES) }),
  fc.record({ rate: fc.constantFrom(-4, -1, 0.5, 1, 4) }),
  // A panel that is drawn for another reason, and draws in several frames.
  fc.record({ redraws: fc.constantFrom(...DISPLAYS) }),
  fc.integer({ min: 1, max: 300 }),
);

it('scrubber, curves, dope sheet and picture show one time in every frame, however time changes, and fields soon', () => {
  fc.assert(
    fc
      .property(
        fc.shuffledSubarray([...DISPLAYS], { minLength: DISPLAYS.length }),
        fc.boolean(),
        fc.array(event, { maxLength: 40 }),
        (order, playerIsFirst, events) => {
          const { wb } = workbench(documentOf(character({ takes: [take([0, 2])] })), { range: [0, 2] });
          const shown = new Map<string, number>();
          const requests = new Map<string, () => void>();
          stop = new AbortController();
          if (playerIsFirst) startPlayer(wb, stop.signal);
          for (const name of order) {
            const phase: FramePhase = name === 'picture' ? 'draw' : 'show';
            const request = oncePerFrame(() => void shown.set(name, wb.transport.get().timeSeconds), phase);
            wb.transport.subscribe(request);
            requests.set(name, request);
            request();
          }
          if (!playerIsFirst) startPlayer(wb, stop.signal);
          let field = wb.transport.get().timeSeconds;
          followWithNumbers(wb.transport, () => {
            field = wb.transport.get().timeSeconds;
          });
          let shownMs = now;
          let behind = 0;
          now += 16;
          runFrame(now);
          for (const what of events) {
            if (typeof what === 'number') {
              now += what;
              runFrame(now);
              const { timeSeconds } = wb.transport.get();
              expect([...shown.values()]).toEqual(DISPLAYS.map(() => timeSeconds));
              if (field !== timeSeconds) {
                expect(wb.transport.get().playing).toBe(true);
                expect(++behind < BEHIND_FRAMES || now - shownMs < BEHIND_MS).toBe(true);
              } else {
                behind = 0;
                shownMs = now;
              }
            } else if (what === 'play.toggle') runAction(wb, what, 'button');
            else if ('seek' in what) wb.transport.update((p) => ({ ...p, timeSeconds: what.seek, playing: false }));
            else if ('redraws' in what) requests.get(what.redraws)?.();
            else wb.transport.update((p) => ({ ...p, ...what }));
          }
        },
      )
      .afterEach(() => {
        stop.abort();
        // The frames of all runs are the same.
        while (frames.length) {
          now += 100;
          runFrame(now);
        }
      }),
  );
});
