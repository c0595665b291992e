import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { shownTake } from '../../../../src/model/document.ts';
import { keysOf } from '../../../../src/model/takes/take.ts';
import { type PlotHost, PlotInput } from '../../../../src/ui/editors/curves/plot-input.ts';
import { PlotScene } from '../../../../src/ui/editors/curves/plot-scene.ts';
import { type CurveSpace, yOf } from '../../../../src/ui/editors/curves/scene/space.ts';
import { selectKeys } from '../../../../src/ui/editors/timeline/current-take.ts';
import { runAction } from '../../../../src/ui/state/actions/action.ts';
import type { Workbench } from '../../../../src/ui/state/workbench.ts';
import { timeX } from '../../../../src/ui/widgets/time/time-window.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../../builders.ts';

/** The part of a page that the input listens to: events on the plot pass the window first. */
class FakeElement extends EventTarget {
  readonly style = { cursor: '' };
  focus(): void {}
  setPointerCapture(): void {}
  hasPointerCapture(): boolean {
    return false;
  }
  getBoundingClientRect() {
    return { left: 0, top: 0 };
  }
}

/** Node's own version ignores `true` for capture when removing. */
class FakeWindow extends EventTarget {
  override removeEventListener(type: string, listener: EventListener, capture = false): void {
    super.removeEventListener(type, listener, { capture });
  }
}

let wb: Workbench;
let scene: PlotScene;
let page: EventTarget;
let element: FakeElement;
let input: PlotInput;
let looks: CurveSpace[];

const times = () => [...(keysOf(shownTake(wb.store.document.characters[0])?.channels[0]).times ?? [])];

function host(): PlotHost {
  return {
    wb,
    // The other members of an element aren't used.
    element: element as unknown as HTMLElement,
    scene: () => scene.scene,
    look: (space) => void looks.push(space),
    showBox: () => {},
    say: () => {},
    freeze: () => {},
    drawSoon: () => {},
    afterDrag: () => {},
  };
}

beforeEach(() => {
  looks = [];
  page = new FakeWindow();
  vi.stubGlobal('window', page);
  vi.stubGlobal('document', { activeElement: null });
  vi.stubGlobal('HTMLInputElement', class {});
  vi.stubGlobal('HTMLButtonElement', class {});
  vi.stubGlobal('requestAnimationFrame', (work: () => void) => work());
  const walker = character({ skeleton: skeleton(['hips', -1]), takes: [take([0, 2], channel(0, 1, 2))] });
  ({ wb } = workbench(documentOf(walker), { range: [0, 2], framesPerSecond: 10 }));
  wb.timeline.change({ window: { from: 0, to: 2 }, snapsToFrames: false });
  scene = new PlotScene(wb);
  scene.width = 200;
  scene.height = 200;
  wb.store.subscribe(() => scene.invalidate());
  wb.timeline.view.subscribe(() => scene.invalidate());
  element = new FakeElement();
  input = new PlotInput(host());
});

afterEach(() => {
  vi.unstubAllGlobals();
});

const HELD = { shiftKey: false, ctrlKey: false, metaKey: false, altKey: false };

function send(type: string, more: object): Event {
  const event = Object.assign(new Event(type, { cancelable: true }), HELD, more);
  element.dispatchEvent(event);
  return event;
}

/** @returns whether the plot and the page behind it receive it */
function press(key: string, code: string, more: object = {}): boolean {
  const make = (type: string) => Object.assign(new Event(type, { cancelable: true }), { ...HELD, key, code, ...more });
  const atPage = make('keydown');
  const stop = vi.spyOn(atPage, 'stopPropagation');
  page.dispatchEvent(atPage);
  if (stop.mock.calls.length) return false;
  element.dispatchEvent(make('keydown'));
  return true;
}

function pointAt(key: number) {
  const [line] = scene.scene.lines;
  return { clientX: timeX(scene.scene.space, times()[key]), clientY: yOf(scene.scene.space, line, 0) };
}

const pointer = (more: object) => ({ button: 0, pointerId: 1, pointerType: 'mouse', ...more });

function release(more: object): void {
  send('pointerup', pointer(more));
  send('lostpointercapture', pointer(more));
}

function beginDrag(): void {
  const from = pointAt(1);
  send('pointerdown', pointer(from));
  send('pointermove', pointer({ ...from, clientX: from.clientX + 25 }));
}

describe('the keyboard while keys are dragged', () => {
  it.each([
    ['Delete', 'Delete', {}],
    ['z', 'KeyZ', { ctrlKey: true }],
    ['ArrowRight', 'ArrowRight', {}],
    ['Enter', 'Enter', {}],
    ['s', 'KeyS', {}],
  ])('the keyboard while keys are dragged waits with %s', (key, code, more) => {
    expect(press(key, code, more)).toBe(true);
    beginDrag();
    expect(press(key, code, more)).toBe(false);
    release(pointAt(1));
    expect(press(key, code, more)).toBe(true);
  });

  it('shortcuts are blocked from the press on while keys are dragged', () => {
    send('pointerdown', pointer(pointAt(1)));
    expect(press('Delete', 'Delete')).toBe(false);
  });

  it('shortcuts are not blocked while panning or zooming', () => {
    send('pointerdown', pointer({ ...pointAt(1), button: 1 }));
    expect(input.dragging).toBe(true);
    expect(press('f', 'KeyF')).toBe(true);
  });

  it('Escape cancels the drag for good', () => {
    beginDrag();
    expect(times()[1]).toBeCloseTo(1.25, 9);
    expect(press('Escape', 'Escape')).toBe(false);
    expect(times()).toEqual([0, 1, 2]);
    send('pointermove', pointer({ clientX: 180, clientY: 100 }));
    release({ clientX: 180, clientY: 100 });
    expect(times()).toEqual([0, 1, 2]);
    expect(wb.store.undoLabel).toBeUndefined();
  });

  it('modifiers change the drag at once', () => {
    beginDrag();
    wb.timeline.change({ snapsToFrames: true });
    expect(press('Control', 'ControlLeft', { ctrlKey: true })).toBe(true);
    expect(times()[1]).toBeCloseTo(1.25, 9);
    press('Shift', 'ShiftLeft');
    expect(times()[1]).toBeCloseTo(1.3, 9);
  });
});

describe('fingers that drag keys', () => {
  const finger = (pointerId: number, more: object) => pointer({ pointerId, pointerType: 'touch', ...more });
  const beginByFinger = () => {
    const from = pointAt(1);
    send('pointerdown', finger(1, from));
    send('pointermove', finger(1, { ...from, clientX: from.clientX + 25 }));
    return from;
  };

  it('a second finger doesn’t move the keys that the first one drags', () => {
    const from = beginByFinger();
    send('pointerdown', finger(2, { clientX: 20, clientY: 180 }));
    send('pointermove', finger(2, { clientX: 190, clientY: 60 }));
    send('pointerup', finger(2, { clientX: 190, clientY: 60 }));
    send('lostpointercapture', finger(2, { clientX: 190, clientY: 60 }));
    expect(times()[1]).toBeCloseTo(1.25, 9);
    expect(input.dragging).toBe(true);
    const to = { ...from, clientX: from.clientX + 30 };
    send('pointerup', finger(1, to));
    send('lostpointercapture', finger(1, to));
    expect(times()[1]).toBeCloseTo(1.3, 9);
    expect(wb.store.undoLabel).toBe('Move key on tx of hips');
  });

  it('keys go back if the browser takes the finger away that drags them', () => {
    beginByFinger();
    send('lostpointercapture', finger(1, { clientX: 0, clientY: 0 }));
    expect(times()).toEqual([0, 1, 2]);
    expect(wb.store.undoLabel).toBeUndefined();
    expect(input.dragging).toBe(false);
    expect(press('Delete', 'Delete')).toBe(true);
  });
});

describe('scaling', () => {
  /** As the page does when the key is pressed in the plot. */
  const pressScaling = () => {
    selectKeys(wb, [{ channel: 0, indices: [0, 1, 2] }]);
    press('x', 'KeyX');
    runAction(wb, 'timeline.scaleDrag');
  };
  const dragFar = () => {
    send('pointerdown', pointer({ clientX: 100, clientY: 40 }));
    send('pointermove', pointer({ clientX: 150, clientY: 40 }));
    release({ clientX: 150, clientY: 40 });
  };

  it('scaling lasts as long as its key is held, whichever key that is', () => {
    pressScaling();
    dragFar();
    expect(times()).toEqual([0, 1.5, 3]);
    expect(wb.timeline.scaling.get()).toBe(true);
    send('keyup', { key: 'y', code: 'KeyY' });
    expect(wb.timeline.scaling.get()).toBe(true);
    send('keyup', { key: 'x', code: 'KeyX' });
    expect(wb.timeline.scaling.get()).toBe(false);
    dragFar();
    expect(times()).toEqual([0, 1.5, 3]);
  });

  it('scaling lasts for one drag if started from a menu', () => {
    selectKeys(wb, [{ channel: 0, indices: [0, 1, 2] }]);
    runAction(wb, 'timeline.scaleDrag');
    dragFar();
    expect(times()).toEqual([0, 1.5, 3]);
    expect(wb.timeline.scaling.get()).toBe(false);
  });

  it('scaling is not started by an unassigned key', () => {
    selectKeys(wb, [{ channel: 0, indices: [0, 1, 2] }]);
    press('s', 'KeyS');
    expect(wb.timeline.scaling.get()).toBe(false);
  });

  it('scaling ends when the focus is lost', () => {
    pressScaling();
    element.dispatchEvent(new Event('blur'));
    expect(wb.timeline.scaling.get()).toBe(false);
  });
});

describe('Ctrl with a click', () => {
  const onEmptyGround = { clientX: 50, clientY: 40, ctrlKey: true };

  it('Ctrl removes keys with a box', () => {
    send('pointerdown', pointer(onEmptyGround));
    expect(input.dragging).toBe(true);
  });

  it('Ctrl+click is a Mac’s right click, and starts nothing', () => {
    element = new FakeElement();
    const onMac = new PlotInput(host(), true);
    send('pointerdown', pointer(onEmptyGround));
    expect(onMac.dragging).toBe(false);
    send('pointerdown', pointer({ ...onEmptyGround, ctrlKey: false, metaKey: true }));
    expect(onMac.dragging).toBe(true);
  });
});

it('the wheel zooms both axes, with Ctrl time only, with Alt values only, and pans in time with Shift', () => {
  const axesOf = ({ axes }: CurveSpace) => Object.values(axes);
  const { space } = scene.scene;
  for (const held of [{}, { ctrlKey: true }, { altKey: true }, { shiftKey: true }]) {
    send('wheel', { clientX: 100, clientY: 120, deltaX: 0, deltaY: 60, deltaMode: 0, ...held });
  }
  const lengths = looks.map(({ window }) => (window.to - window.from) / (space.window.to - space.window.from));
  for (const [i, expected] of [1.15, 1.15, 1, 1].entries()) expect(lengths[i]).toBeCloseTo(expected, 9);
  const isSame = looks.map((look) => JSON.stringify(axesOf(look)) === JSON.stringify(axesOf(space)));
  expect(isSame).toEqual([false, true, false, true]);
  expect(looks[3].window.from).toBeGreaterThan(space.window.from);
});
