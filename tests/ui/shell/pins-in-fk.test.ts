import { afterEach, expect, it } from 'vitest';
import { pinPoint, unpin } from '../../../src/edit/commands/ik.ts';
import { paintDimmedPins } from '../../../src/ui/editors/ik/pin-picture.ts';
import { pinsInFk } from '../../../src/ui/shell/pins-in-fk.ts';
import type { MarkLook, PinOverlay } from '../../../src/view/pins/pin-overlay.ts';
import { documentOf } from '../builders.ts';
import { BODY_JOINT, body, HAND_L, ikPage } from '../editors/ik/ik-page.ts';

let stopPage = () => {};
afterEach(() => stopPage());

/** Lets pending promises settle. */
const settled = async () => {
  for (let i = 0; i < 10; i++) await Promise.resolve();
};

/** A page that counts the overlays it shows. */
function page(pins: boolean) {
  const { wb, stop } = ikPage(documentOf(pins ? body() : body({ ik: { pins: [], stiff: [], rootIsFree: true } })));
  wb.posing.mode.set('fk');
  stopPage = stop;
  const counts = { shown: 0, loaded: 0, disposed: 0 };
  const viewport = {
    addOverlay: () => {
      counts.shown++;
      return () => void counts.shown--;
    },
  };
  Object.assign(wb.viewport, viewport);
  const leave = new AbortController();
  pinsInFk(wb, leave.signal, async () => {
    counts.loaded++;
    // All that is used of it.
    return { dispose: () => void counts.disposed++ } as unknown as PinOverlay;
  });
  return { wb, counts, leave };
}

it('pins are drawn in FK mode and left to IK, Pose and rig in theirs', async () => {
  const { wb, counts } = page(true);
  await settled();
  expect(counts.shown).toBe(1);
  for (const mode of ['ik', 'pose', 'rig', 'fk'] as const) {
    wb.posing.mode.set(mode);
    await settled();
    expect(counts.shown).toBe(mode === 'fk' ? 1 : 0);
  }
});

it('nothing is loaded until there is a pin, and nothing drawn after the last one', async () => {
  const { wb, counts } = page(false);
  await settled();
  expect(counts.loaded).toBe(0);
  wb.store.apply(pinPoint, { characterId: 'c1', joint: HAND_L, point: [0, 0, 0] });
  await settled();
  expect(counts).toEqual({ shown: 1, loaded: 1, disposed: 0 });
  wb.store.apply(unpin, { characterId: 'c1', pins: [1] });
  await settled();
  expect(counts.shown).toBe(0);
});

it('pins that load after FK was left are not drawn', async () => {
  const { wb, counts, leave } = page(true);
  wb.posing.mode.set('ik');
  await settled();
  expect(counts).toEqual({ shown: 0, loaded: 1, disposed: 1 });
  leave.abort();
  wb.posing.mode.set('fk');
  await settled();
  expect(counts.loaded).toBe(1);
});

it('dimmed pins are half transparent, and square if they hold the orientation', () => {
  const pins = [HAND_L, BODY_JOINT].map((joint, i) => ({
    id: i + 1,
    joint,
    point: [0, 0, 0] as const,
    weight: 1,
    holdsOrientation: i === 1,
  }));
  const { wb, stop } = ikPage(documentOf(body({ ik: { pins, stiff: [], rootIsFree: true } })));
  stopPage = stop;
  const marks: MarkLook[] = [];
  paintDimmedPins(wb, { mark: (_at, look) => void marks.push(look), line: () => expect.unreachable() });
  expect(marks.map(({ shape, opacity }) => [shape, opacity])).toEqual([
    ['round', 0.5],
    ['square', 0.5],
  ]);
});
