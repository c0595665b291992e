import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { keepToOneKindOfPointer } from '../../../src/view/camera/one-kind-of-pointer.ts';

/** The fields of the browser's class that are read. */
class FakePointerEvent extends Event {
  readonly pointerId: number;
  readonly pointerType: string;
  readonly buttons: number;
  constructor(type: string, { pointerId = 1, pointerType = 'mouse', buttons = 0 } = {}) {
    super(type);
    this.pointerId = pointerId;
    this.pointerType = pointerType;
    this.buttons = buttons;
  }
}

let stop: AbortController;
beforeEach(() => {
  vi.stubGlobal('window', new EventTarget());
  vi.stubGlobal('PointerEvent', FakePointerEvent);
  stop = new AbortController();
});
afterEach(() => {
  stop.abort();
  vi.unstubAllGlobals();
});

/** An element with controls that log what they hear of presses. */
function controls() {
  const page = new EventTarget();
  const element = Object.assign(new EventTarget(), { ownerDocument: page });
  // Only these members of an element are used.
  keepToOneKindOfPointer(element as unknown as HTMLElement, stop.signal);
  const heard: string[] = [];
  for (const type of ['pointerdown', 'pointercancel']) element.addEventListener(type, () => heard.push(type));
  page.addEventListener('pointerup', () => heard.push('pointerup'));
  return {
    heard,
    send: (type: string, fields?: ConstructorParameters<typeof FakePointerEvent>[1]) =>
      (type === 'pointerup' ? page : element).dispatchEvent(new FakePointerEvent(type, fields)),
  };
}

it('a mouse let go where the page doesn’t hear of it ends its drag of the camera', () => {
  const { heard, send } = controls();
  send('pointerdown', { buttons: 1 });
  send('lostpointercapture');
  expect(heard).toEqual(['pointerdown', 'pointercancel']);
  send('pointerdown', { pointerId: 2, pointerType: 'touch', buttons: 1 });
  expect(heard).toEqual(['pointerdown', 'pointercancel', 'pointerdown']);
});

it('a mouse that is let go on the page ends its drag of the camera once, and another button doesn’t', () => {
  const { heard, send } = controls();
  send('pointerdown', { buttons: 1 });
  send('lostpointercapture', { buttons: 1 });
  send('pointerup');
  send('lostpointercapture');
  expect(heard).toEqual(['pointerdown', 'pointerup']);
});
