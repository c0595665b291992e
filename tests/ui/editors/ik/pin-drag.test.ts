import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { PinDrag } from '../../../../src/ui/editors/ik/pin-drag.ts';
import { type CanvasPointer, LONG_PRESS_MS } from '../../../../src/ui/editors/viewport/canvas-tools.ts';
import { channel, documentOf, take } from '../../builders.ts';
import { apart, BODY_JOINT, body, HAND_L, HAND_R, ikPage } from './ik-page.ts';

const KEYS = [{ channel: 0, indices: [0] }];

let page: ReturnType<typeof ikPage>;
beforeEach(() => {
  // Two bodies; the dragged one isn't selected.
  const second = { ...body(), id: 'c2' };
  page = ikPage(documentOf(body(), second));
  vi.stubGlobal('requestAnimationFrame', () => 0);
  vi.stubGlobal('cancelAnimationFrame', () => {});
  page.wb.store.select({ characterId: 'c1', joint: HAND_L });
});
afterEach(() => page.stop());

const at = (clientX: number, clientY: number, more: Partial<CanvasPointer> = {}): CanvasPointer => ({
  ...{ clientX, clientY, button: 0, altKey: false, shiftKey: false, ctrlKey: false, metaKey: false },
  pointerType: 'mouse',
  ...more,
});

/** `wait` collects what is to run later. */
function dragBody(press: CanvasPointer = at(0, 0)) {
  const told: (number | undefined)[] = [];
  let clicks = 0;
  let longPresses = 0;
  const wait: { run?: () => void; ms?: number } = {};
  const grip = { characterId: 'c2', placement: 0, joint: BODY_JOINT, point: [0, 0, 0] } as const;
  const events = {
    click: () => void clicks++,
    longPress: () => void longPresses++,
    began: () => {},
    moved: (depth: number | undefined) => void told.push(depth),
    over: () => {},
  };
  const drag = new PinDrag(page.wb, grip, press, events, undefined, (run, ms) => {
    Object.assign(wait, { run, ms });
    return () => {
      wait.run = undefined;
    };
  });
  return { drag, told, wait, clicks: () => clicks, longPresses: () => longPresses };
}

describe('a drag of a point', () => {
  it('selects the character and joint that it drags, in one step', () => {
    const { store } = page.wb;
    const { drag } = dragBody();
    drag.move(at(10, -20));
    drag.move(at(15, -30));
    drag.end(at(10, -20));
    expect(store.selection).toEqual({ characterId: 'c2', placement: 0, joint: BODY_JOINT });
    expect(store.undoLabel).toBe('Drag body');
    store.undo();
    expect(store.undoLabel).toBeUndefined();
    expect(store.selection).toEqual({ characterId: 'c1', joint: HAND_L });
    expect(apart(page.placeOf(BODY_JOINT, 'c2'), [0, 0, 0])).toBe(0);
  });

  it('a drag of a point keeps selection, keys and the selected pin if cancelled', () => {
    const { store } = page.wb;
    const { selected } = page.wb.posing.ik;
    const before = { characterId: 'c1', joint: HAND_L, keys: KEYS };
    store.select(before);
    selected.set({ characterId: 'c1', pin: 1 });
    const { document } = store;
    const { drag } = dragBody();
    drag.move(at(10, -20));
    drag.move(at(15, -30));
    expect(store.document).not.toBe(document);
    drag.cancel();
    expect(store.document).toBe(document);
    expect(store.selection).toBe(before);
    expect(selected.get()).toEqual({ characterId: 'c1', pin: 1 });
  });

  it('a drag of a point keeps keys of the same character, and a selection of the dragged joint', () => {
    page.stop();
    page = ikPage(documentOf({ ...body({ takes: [take([0, 2], channel(0))] }), id: 'c2' }));
    vi.stubGlobal('requestAnimationFrame', () => 0);
    vi.stubGlobal('cancelAnimationFrame', () => {});
    const { store } = page.wb;
    store.select({ characterId: 'c2', joint: HAND_L, keys: KEYS });
    const first = dragBody();
    first.drag.move(at(10, -20));
    first.drag.end(at(10, -20));
    const { selection } = store;
    expect(selection).toEqual({ characterId: 'c2', placement: 0, joint: BODY_JOINT, keys: KEYS });
    const second = dragBody();
    second.drag.move(at(10, -20));
    second.drag.end(at(20, -20));
    expect(store.selection).toBe(selection);
    // Of several selected joints the dragged one becomes active.
    store.select({ characterId: 'c2', joint: HAND_L, others: [BODY_JOINT, HAND_R] });
    const third = dragBody();
    third.drag.move(at(10, -20));
    third.drag.end(at(30, -20));
    expect(store.selection).toEqual({ characterId: 'c2', placement: 0, joint: BODY_JOINT, others: [HAND_R, HAND_L] });
  });

  it('a drag of a point keeps the selection if it is a click', () => {
    const { drag, clicks } = dragBody();
    drag.move(at(1, 1));
    drag.end(at(1, 1));
    expect(clicks()).toBe(1);
    expect(page.wb.store.selection).toEqual({ characterId: 'c1', joint: HAND_L });
  });

  it('reports the total depth while dragging in depth, and nothing in the plane', () => {
    const { drag, told } = dragBody();
    const deep = { altKey: true };
    drag.move(at(0, -10));
    drag.move(at(0, -10, deep));
    drag.move(at(0, -30, deep));
    drag.move(at(0, -30));
    drag.move(at(0, -30, deep));
    drag.move(at(0, -20, deep));
    drag.end(at(0, -20, deep));
    const texts = told.map((depth) => depth?.toFixed(3));
    expect(texts).toEqual([undefined, '0.000', '0.200', undefined, '0.200', '0.100']);
    expect(page.placeOf(BODY_JOINT, 'c2')[2]).toBeCloseTo(-0.1, 2);
  });

  it('a drag of a point makes a last step on release, unless it is already there', () => {
    for (const [letGoAt, steps] of [
      [at(0, -10), 1],
      [at(0, -12), 2],
      [at(0, -10, { altKey: true }), 2],
    ] as const) {
      const { drag, told } = dragBody();
      drag.move(at(0, -10));
      drag.end(letGoAt);
      expect(told).toHaveLength(steps);
      page.wb.store.undo();
    }
  });
});

describe('a finger on a point', () => {
  const finger = (x: number, y: number) => at(x, y, { pointerType: 'touch' });

  it('a long press is no click', () => {
    const { drag, wait, clicks, longPresses } = dragBody(finger(0, 0));
    expect(wait.ms).toBe(LONG_PRESS_MS);
    drag.move(finger(2, 1));
    wait.run?.();
    drag.end(finger(2, 1));
    expect([clicks(), longPresses()]).toEqual([0, 1]);
  });

  it('a finger that moves or is lifted is no long press; nor is a mouse', () => {
    const gone = dragBody(finger(0, 0));
    gone.drag.move(finger(20, 0));
    expect(gone.wait.run).toBeUndefined();
    gone.drag.cancel();
    const lifted = dragBody(finger(0, 0));
    lifted.drag.end(finger(0, 0));
    expect([lifted.wait.run, lifted.clicks()]).toEqual([undefined, 1]);
    expect(dragBody().wait.run).toBeUndefined();
  });

  it('drags in depth while a second finger is down', () => {
    const { drag, told } = dragBody(finger(0, 0));
    drag.fingers(2);
    drag.move(finger(0, -10));
    drag.move(finger(0, -40));
    drag.fingers(1);
    drag.move(finger(0, -40));
    drag.cancel();
    expect(told.map((depth) => depth?.toFixed(3))).toEqual(['0.000', '0.300', undefined]);
  });
});
