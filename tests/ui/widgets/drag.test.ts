import { expect, it } from 'vitest';
import { followPointer, type PointerDrag } from '../../../src/ui/widgets/drag.ts';

/** An event of one pointer, as far as `followPointer` reads it. */
function pointer(type: string, pointerId: number): PointerEvent {
  // A page's PointerEvent is an Event with a pointerId; Node has only Event.
  return Object.assign(new Event(type), { pointerId }) as PointerEvent;
}

/** Presses pointer 1 on an element; the log has what the drag was told. */
function pressed(): { target: EventTarget; log: string[]; end: () => void } {
  const log: string[] = [];
  const target = Object.assign(new EventTarget(), {
    setPointerCapture: (id: number) => log.push(`capture ${id}`),
    hasPointerCapture: () => true,
    releasePointerCapture: (id: number) => log.push(`release ${id}`),
  });
  const drag: PointerDrag = {
    move: (at) => log.push(`move ${at.pointerId}`),
    over: (lost, release) => log.push(`over ${lost.pointerId}, ${release ? 'released' : 'cancelled'}`),
  };
  // Only these members of the element are used.
  const end = followPointer(target as EventTarget as HTMLElement, pointer('pointerdown', 1), drag);
  return { target, log, end };
}

it('a drag follows its pointer to the release', () => {
  const { target, log } = pressed();
  for (const type of ['pointermove', 'pointerup', 'lostpointercapture', 'pointermove']) {
    target.dispatchEvent(pointer(type, 1));
  }
  expect(log).toEqual(['capture 1', 'move 1', 'over 1, released']);
});

it('a drag is cancelled if the browser takes the pointer away', () => {
  const { target, log } = pressed();
  target.dispatchEvent(pointer('lostpointercapture', 1));
  expect(log).toEqual(['capture 1', 'over 1, cancelled']);
});

it('a second finger neither moves nor ends a drag', () => {
  const { target, log } = pressed();
  for (const type of ['pointermove', 'pointerup', 'lostpointercapture']) target.dispatchEvent(pointer(type, 2));
  expect(log).toEqual(['capture 1']);
  target.dispatchEvent(pointer('lostpointercapture', 1));
  expect(log.at(-1)).toBe('over 1, cancelled');
});

it('a drag that is ended early releases the pointer and hears nothing more', () => {
  const { target, log, end } = pressed();
  end();
  for (const type of ['pointermove', 'lostpointercapture']) target.dispatchEvent(pointer(type, 1));
  expect(log).toEqual(['capture 1', 'release 1']);
});
