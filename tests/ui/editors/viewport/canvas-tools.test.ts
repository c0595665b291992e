import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import {
  type CanvasDrag,
  type CanvasTool,
  CLICK_PIXELS,
  LONG_PRESS_MS,
  listenToCanvas,
  PINCH_MS,
} from '../../../../src/ui/editors/viewport/canvas-tools.ts';

/** The part of a canvas that the router uses. */
class FakeCanvas extends EventTarget {
  readonly style = { cursor: '' };
  readonly captured = new Set<number>();
  focused = 0;
  focus() {
    this.focused++;
  }
  setPointerCapture(id: number) {
    this.captured.add(id);
  }
  hasPointerCapture(id: number) {
    return this.captured.has(id);
  }
  releasePointerCapture(id: number) {
    this.captured.delete(id);
  }
}

/** The fields of the browser's class that are handed on. */
class FakePointerEvent extends Event {
  readonly pointerId: number;
  readonly clientX: number;
  constructor(type: string, { pointerId, clientX }: { readonly pointerId: number; readonly clientX: number }) {
    super(type);
    this.pointerId = pointerId;
    this.clientX = clientX;
  }
}

/** Of each page. */
let stops: AbortController[];
beforeEach(() => {
  vi.stubGlobal('window', new EventTarget());
  vi.stubGlobal('PointerEvent', FakePointerEvent);
  stops = [];
});
afterEach(() => {
  for (const stop of stops) stop.abort();
  vi.unstubAllGlobals();
});

function page(tool: CanvasTool | undefined) {
  const stop = new AbortController();
  stops.push(stop);
  const canvas = new FakeCanvas();
  const picked: number[][] = [];
  const claims: boolean[] = [];
  const menus: number[][] = [];
  const handedOver: number[][] = [];
  canvas.addEventListener('pointerdown', (event) => {
    if (event instanceof FakePointerEvent) handedOver.push([event.pointerId, event.clientX]);
  });
  // Replaces the browser's canvas.
  const asCanvas = canvas as unknown as HTMLCanvasElement;
  listenToCanvas(
    asCanvas,
    () => tool,
    {
      pick: ({ clientX, clientY }) => void picked.push([clientX, clientY]),
      claim: (isTools) => void claims.push(isTools),
      menu: ({ clientX, clientY }) => void menus.push([clientX, clientY]),
    },
    stop.signal,
  );
  /** As in the browser: first the window, capturing, then the canvas, unless stopped. */
  const pointer = (type: string, x: number, y: number, more: object = {}) => {
    const event = new Event(type, { cancelable: true });
    const seen = { stopped: false };
    const given = { clientX: x, clientY: y, button: 0, buttons: 0, isPrimary: true, pointerId: 1, ...more };
    Object.defineProperties(event, {
      ...Object.fromEntries(Object.entries(given).map(([name, value]) => [name, { value }])),
      target: { value: canvas },
      stopPropagation: { value: () => (seen.stopped = true) },
    });
    if (type === 'pointerdown') window.dispatchEvent(event);
    else canvas.dispatchEvent(event);
    return { reachesCamera: !seen.stopped };
  };
  const key = (name: string) => {
    const event = Object.assign(new Event('keydown', { cancelable: true }), { key: name });
    window.dispatchEvent(event);
    return event.defaultPrevented;
  };
  return { canvas, picked, claims, menus, handedOver, pointer, key };
}

/** Takes every press left of 100, and logs the calls. Its drags begin beyond 2 pixels. */
function leftTool() {
  const said: string[] = [];
  const drag = (from: number): CanvasDrag => {
    let hasBegun = false;
    return {
      get hasBegun() {
        return hasBegun;
      },
      move({ clientX }) {
        hasBegun ||= Math.abs(clientX - from) > 2;
        said.push(`move ${clientX}`);
      },
      end: ({ clientX }) => void said.push(`end ${clientX}`),
      cancel: () => void said.push('cancel'),
    };
  };
  const tool: CanvasTool = {
    press: ({ clientX }) => (clientX >= 100 ? undefined : drag(clientX)),
    hover: (at) => (at && at.clientX < 100 ? 'grab' : undefined),
  };
  return { tool, said };
}

it('claims the pointer over a handle and during a drag, so that nothing else is highlighted', () => {
  const { tool } = leftTool();
  const { pointer, claims } = page(tool);
  pointer('pointermove', 300, 10);
  pointer('pointermove', 10, 10);
  pointer('pointerdown', 10, 10);
  pointer('pointermove', 300, 10, { buttons: 1 });
  pointer('pointerup', 300, 10);
  expect(claims).toEqual([false, true, true, false]);
});

describe('a press in the viewport', () => {
  it('a press used by a tool is its drag, and not the camera’s', () => {
    const { tool, said } = leftTool();
    const { pointer, canvas, picked } = page(tool);
    expect(pointer('pointerdown', 10, 10).reachesCamera).toBe(false);
    expect(canvas.captured.has(1)).toBe(true);
    pointer('pointermove', 20, 10, { buttons: 1 });
    pointer('pointermove', 300, 10, { buttons: 1 });
    pointer('pointerup', 300, 10);
    expect(said).toEqual(['move 20', 'move 300', 'end 300']);
    expect(canvas.captured.size).toBe(0);
    expect(picked).toEqual([]);
  });

  it('a press not used by a tool is the camera’s, and picks if it does not move', () => {
    const { pointer, picked, canvas } = page(leftTool().tool);
    expect(pointer('pointerdown', 200, 10).reachesCamera).toBe(true);
    pointer('pointerup', 200 + CLICK_PIXELS, 10);
    expect(picked).toEqual([[200 + CLICK_PIXELS, 10]]);
    pointer('pointerdown', 200, 10);
    pointer('pointerup', 201 + CLICK_PIXELS, 10);
    expect(picked).toHaveLength(1);
    expect(canvas.focused).toBe(2);
  });

  it('a press in the viewport is the tool’s click if the tool uses it', () => {
    const { pointer, picked } = page({ press: () => undefined, click: ({ clientX }) => clientX === 7 });
    for (const x of [7, 8]) {
      pointer('pointerdown', x, 0);
      pointer('pointerup', x, 0);
    }
    expect(picked).toEqual([[8, 0]]);
  });

  it('a press in the viewport with the right button never picks', () => {
    const { pointer, picked } = page(undefined);
    pointer('pointerdown', 10, 10, { button: 2 });
    pointer('pointerup', 10, 10, { button: 2 });
    expect(picked).toEqual([]);
  });
});

describe('the menu of the viewport', () => {
  afterEach(() => {
    vi.useRealTimers();
  });

  it('the right button opens the viewport’s menu where it is released, unless it was dragged', () => {
    const { pointer, menus, picked } = page(leftTool().tool);
    const right = { button: 2, buttons: 2 };
    pointer('pointerdown', 200, 10, right);
    expect(menus).toEqual([]);
    pointer('pointerup', 200 + CLICK_PIXELS, 10, right);
    expect(menus).toEqual([[200 + CLICK_PIXELS, 10]]);
    // A drag stays one, even if it ends where it began.
    pointer('pointerdown', 200, 10, right);
    pointer('pointermove', 250, 10, right);
    pointer('pointermove', 200, 10, right);
    pointer('pointerup', 200, 10, right);
    expect(menus).toHaveLength(1);
    expect(picked).toEqual([]);
  });

  it('the right button opens the viewport’s menu over something that it could drag, after the tool’s own end', () => {
    const { tool, said } = leftTool();
    const { pointer, menus } = page(tool);
    const right = { button: 2, buttons: 2 };
    pointer('pointerdown', 10, 10, right);
    pointer('pointerup', 10, 10, right);
    expect([said, menus]).toEqual([['end 10'], [[10, 10]]]);
    pointer('pointerdown', 10, 10, right);
    pointer('pointermove', 50, 10, right);
    pointer('pointerup', 50, 10, right);
    expect([said, menus.length]).toEqual([['end 10', 'move 50', 'end 50'], 1]);
  });

  it('a finger held still opens the viewport’s menu and picks nothing', () => {
    vi.useFakeTimers();
    const { pointer, menus, picked } = page(leftTool().tool);
    const finger = { pointerType: 'touch', buttons: 1 };
    pointer('pointerdown', 200, 10, finger);
    vi.advanceTimersByTime(LONG_PRESS_MS);
    pointer('pointerup', 200, 10, finger);
    expect([menus, picked]).toEqual([[[200, 10]], []]);
  });

  it.each([
    ['that moves', (pointer: ReturnType<typeof page>['pointer']) => pointer('pointermove', 240, 10, { buttons: 1 })],
    [
      'with a second one',
      (pointer: ReturnType<typeof page>['pointer']) =>
        pointer('pointerdown', 250, 10, { pointerType: 'touch', isPrimary: false, pointerId: 2 }),
    ],
    ['that is lifted', (pointer: ReturnType<typeof page>['pointer']) => pointer('pointerup', 200, 10)],
    ['that the browser takes', (pointer: ReturnType<typeof page>['pointer']) => pointer('pointercancel', 200, 10)],
  ])('a finger %s opens no menu in the viewport', (_how, what) => {
    vi.useFakeTimers();
    const { pointer, menus } = page(leftTool().tool);
    pointer('pointerdown', 200, 10, { pointerType: 'touch' });
    what(pointer);
    vi.advanceTimersByTime(2 * LONG_PRESS_MS);
    expect(menus).toEqual([]);
  });

  it('a finger held still on something that the tool drags cancels the drag and opens the menu', () => {
    vi.useFakeTimers();
    const { tool, said } = leftTool();
    const { pointer, menus, picked } = page(tool);
    pointer('pointerdown', 10, 10, { pointerType: 'touch' });
    vi.advanceTimersByTime(LONG_PRESS_MS);
    pointer('pointermove', 60, 10, { buttons: 1 });
    pointer('pointerup', 60, 10);
    expect([said, menus, picked]).toEqual([['cancel'], [[10, 10]], []]);
  });

  it('a finger that drags, or whose drag has a meaning of its own for staying, opens no menu', () => {
    vi.useFakeTimers();
    const { tool, said } = leftTool();
    const { pointer, menus } = page(tool);
    pointer('pointerdown', 10, 10, { pointerType: 'touch' });
    pointer('pointermove', 60, 10, { buttons: 1 });
    vi.advanceTimersByTime(2 * LONG_PRESS_MS);
    pointer('pointerup', 60, 10);
    expect([said, menus]).toEqual([['move 60', 'end 60'], []]);
    said.length = 0;
    // Slow and fine: no further than a click.
    pointer('pointerdown', 10, 10, { pointerType: 'touch' });
    vi.advanceTimersByTime(LONG_PRESS_MS - 10);
    pointer('pointermove', 13, 10, { buttons: 1 });
    vi.advanceTimersByTime(LONG_PRESS_MS);
    pointer('pointerup', 13, 10);
    expect([said, menus]).toEqual([['move 13', 'end 13'], []]);
    const owning = page({
      press: (at) => {
        const drag = tool.press(at);
        return drag && Object.assign(drag, { ownsLongPress: true });
      },
    });
    owning.pointer('pointerdown', 10, 10, { pointerType: 'touch' });
    vi.advanceTimersByTime(2 * LONG_PRESS_MS);
    expect(owning.menus).toEqual([]);
  });
});

describe('a drag of a tool', () => {
  afterEach(() => {
    vi.useRealTimers();
  });

  it('Escape cancels a drag of a tool, and later events are ignored', () => {
    const { tool, said } = leftTool();
    const { pointer, key, picked } = page(tool);
    pointer('pointerdown', 10, 10);
    pointer('pointermove', 20, 10, { buttons: 1 });
    expect(key('Escape')).toBe(true);
    pointer('pointermove', 30, 10, { buttons: 1 });
    pointer('pointerup', 30, 10);
    expect(said).toEqual(['move 20', 'cancel']);
    expect(picked).toEqual([]);
    expect(key('Escape')).toBe(false);
  });

  it('a drag of a tool blocks the keyboard', () => {
    const { pointer, key } = page(leftTool().tool);
    expect(key('z')).toBe(false);
    pointer('pointerdown', 10, 10);
    expect(key('z')).toBe(true);
    pointer('pointerup', 10, 10);
    expect(key('z')).toBe(false);
  });

  it('a drag of a tool ignores other buttons and fingers', () => {
    const { tool, said } = leftTool();
    const { pointer } = page(tool);
    pointer('pointerdown', 10, 10);
    expect(pointer('pointerdown', 200, 10, { pointerId: 2, isPrimary: false }).reachesCamera).toBe(false);
    pointer('pointermove', 200, 10, { pointerId: 2, buttons: 1 });
    pointer('pointerup', 200, 10, { pointerId: 2 });
    pointer('pointerup', 15, 10);
    expect(said).toEqual(['end 15']);
  });

  it('a drag of a tool gets the number of fingers', () => {
    vi.useFakeTimers();
    const counts: number[] = [];
    const { tool } = leftTool();
    const { pointer } = page({
      press: (at) => {
        const drag = tool.press(at);
        return drag && Object.assign(drag, { fingers: (count: number) => void counts.push(count) });
      },
    });
    const other = { pointerId: 2, isPrimary: false, pointerType: 'touch' };
    pointer('pointerdown', 10, 10, { pointerType: 'touch' });
    pointer('pointermove', 20, 10);
    vi.advanceTimersByTime(PINCH_MS);
    expect(pointer('pointerdown', 200, 10, other).reachesCamera).toBe(false);
    pointer('pointerup', 200, 10, other);
    pointer('pointerdown', 200, 10, { ...other, pointerId: 3 });
    pointer('pointercancel', 200, 10, { ...other, pointerId: 3 });
    expect(counts).toEqual([2, 1, 2, 1]);
  });

  it('a drag ends if the browser cancels the pointer', () => {
    const { tool, said } = leftTool();
    const { pointer } = page(tool);
    pointer('pointerdown', 10, 10);
    pointer('pointercancel', 10, 10);
    expect(said).toEqual(['cancel']);
  });
});

describe('a pinch', () => {
  const first = { pointerType: 'touch', buttons: 1 };
  const second = { pointerType: 'touch', buttons: 1, isPrimary: false, pointerId: 2 };
  beforeEach(() => {
    vi.useFakeTimers();
  });
  afterEach(() => {
    vi.useRealTimers();
  });

  it.each([
    ['at once', 0, 10],
    ['within moments, while the first already moves', PINCH_MS - 1, 60],
    ['later, before the first has moved', LONG_PRESS_MS - 1, 10],
    ['later, while the first only trembles', LONG_PRESS_MS - 1, 12],
  ])('a second finger %s takes the first from what it would drag, and gives both to the camera', (_when, ms, x) => {
    const { tool, said } = leftTool();
    const { pointer, handedOver, menus, picked, key } = page(tool);
    pointer('pointerdown', 10, 10, first);
    if (x !== 10) pointer('pointermove', x, 10, first);
    vi.advanceTimersByTime(ms);
    expect(pointer('pointerdown', 300, 10, second).reachesCamera).toBe(true);
    expect(handedOver).toEqual([[1, x]]);
    expect(said.filter((call) => call !== 'move 12')).toEqual(['cancel']);
    expect(key('z')).toBe(false);
    for (const [finger, to] of [
      [first, 0],
      [second, 340],
    ] as const)
      expect(pointer('pointermove', to, 10, finger).reachesCamera).toBe(true);
    pointer('pointerup', 340, 10, second);
    pointer('pointerup', 0, 10, first);
    vi.advanceTimersByTime(2 * LONG_PRESS_MS);
    expect([said.at(-1), menus, picked]).toEqual(['cancel', [], []]);
  });

  it('a finger’s drag waits until it can be no pinch, and loses nothing of its way', () => {
    const { tool, said } = leftTool();
    const { pointer } = page(tool);
    pointer('pointerdown', 10, 10, first);
    pointer('pointermove', 40, 10, first);
    expect(said).toEqual([]);
    vi.advanceTimersByTime(PINCH_MS);
    pointer('pointermove', 50, 10, first);
    pointer('pointerup', 50, 10, first);
    expect(said).toEqual(['move 40', 'move 50', 'end 50']);
    said.length = 0;
    // A quick one is over before.
    pointer('pointerdown', 10, 10, first);
    pointer('pointermove', 40, 10, first);
    pointer('pointerup', 40, 10, first);
    vi.advanceTimersByTime(PINCH_MS);
    expect(said).toEqual(['move 40', 'end 40']);
  });

  it('a finger put down during a drag moves no camera, not even once the drag is over', () => {
    const { tool, said } = leftTool();
    const { pointer, handedOver } = page(tool);
    pointer('pointerdown', 10, 10, first);
    pointer('pointermove', 40, 10, first);
    vi.advanceTimersByTime(PINCH_MS);
    expect(pointer('pointerdown', 300, 10, second).reachesCamera).toBe(false);
    expect(pointer('pointermove', 340, 10, second).reachesCamera).toBe(false);
    pointer('pointerup', 40, 10, first);
    expect(pointer('pointermove', 380, 10, second).reachesCamera).toBe(false);
    pointer('pointerup', 380, 10, second);
    expect([said, handedOver]).toEqual([['move 40', 'end 40'], []]);
    expect(pointer('pointerdown', 300, 10, first).reachesCamera).toBe(true);
    expect(pointer('pointermove', 340, 10, second).reachesCamera).toBe(true);
  });
});

it('the cursor shows what can be grabbed', () => {
  const { pointer, canvas } = page(leftTool().tool);
  pointer('pointermove', 10, 10);
  expect(canvas.style.cursor).toBe('grab');
  pointer('pointermove', 200, 10);
  expect(canvas.style.cursor).toBe('');
  pointer('pointermove', 10, 10);
  pointer('pointermove', 200, 10, { buttons: 1 });
  expect(canvas.style.cursor).toBe('grab');
  pointer('pointerleave', 0, 0);
  expect(canvas.style.cursor).toBe('');
});
