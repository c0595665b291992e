import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { followPress } from '../../../src/ui/poses/card-drags.ts';

beforeEach(() => void vi.stubGlobal('window', new EventTarget()));
afterEach(() => void vi.unstubAllGlobals());

const pointer = (type: string, pointerId = 1) => Object.assign(new Event(type), { pointerId }) as PointerEvent;

function press() {
  const released: PointerEvent[] = [];
  const giveUp = followPress(pointer('pointerdown'), (up) => void released.push(up));
  return { released, giveUp, happens: (type: string, id?: number) => void window.dispatchEvent(pointer(type, id)) };
}

describe('a press on a card', () => {
  it('is followed to its release, wherever that is, and no further', () => {
    const { released, happens } = press();
    happens('pointerup');
    happens('pointerup');
    expect(released).toHaveLength(1);
  });

  it('has nothing to do with another finger', () => {
    const { released, happens } = press();
    happens('pointerup', 2);
    expect(released).toEqual([]);
    happens('pointerup');
    expect(released).toHaveLength(1);
  });

  it.each(['the browser', 'another press'])('is over where %s takes it', (who) => {
    const { released, giveUp, happens } = press();
    if (who === 'the browser') happens('pointercancel');
    else giveUp();
    happens('pointerup');
    expect(released).toEqual([]);
  });
});
