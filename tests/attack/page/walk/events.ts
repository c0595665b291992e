/**
 * What a random walk does: mouse, keys, text and touch, as plain data, so that a walk that found something can be kept
 * and repeated. They are sent to the browser without waiting for each.
 */
import type { CDPSession } from 'playwright-core';
import { keyOf } from './keys.ts';

/** CSS pixels of the page. */
export type Point = readonly [x: number, y: number];
export type MouseButton = 'left' | 'right' | 'middle';

export type WalkEvent = HandEvent | { readonly kind: 'drop' /** Of the list of given files. */; readonly drop: number };

export type HandEvent =
  | { readonly kind: 'key'; readonly key: string; readonly modifiers: number }
  | { readonly kind: 'text'; readonly text: string }
  | { readonly kind: 'move'; readonly to: Point }
  | {
      readonly kind: 'click';
      readonly at: Point;
      readonly button: MouseButton;
      readonly count: 1 | 2;
      modifiers: number;
    }
  /** Pressed at the first point and released at the last. */
  | { readonly kind: 'drag'; readonly path: readonly Point[]; readonly button: MouseButton; modifiers: number }
  /** Pressed, and released by a later event. */
  | { readonly kind: 'down' | 'up'; readonly at: Point; readonly button: MouseButton }
  | { readonly kind: 'wheel'; readonly at: Point; readonly by: Point; readonly modifiers: number }
  /** A path for each finger, of equal lengths. */
  | { readonly kind: 'touch'; readonly fingers: readonly (readonly Point[])[] };

/** Of `Input` events of the browser's protocol. */
export const ALT = 1;
export const CTRL = 2;
export const SHIFT = 8;

const BIT: Readonly<Record<MouseButton, number>> = { left: 1, right: 2, middle: 4 };

/** Sends events of one page. */
export class Hand {
  private pressed = 0;
  private at: Point = [0, 0];
  /** Messages to the browser. */
  inputs = 0;

  constructor(private readonly session: CDPSession) {}

  /** What is draggable is dropped at once: the browser's own drag would wait for a person. */
  async prepare(): Promise<void> {
    await this.session.send('Input.setInterceptDrags', { enabled: true });
    this.session.on('Input.dragIntercepted', ({ data }) => {
      const [x, y] = this.at;
      for (const type of ['dragEnter', 'dragOver', 'drop'] as const) {
        // A page that is closed meanwhile has nothing to drop on.
        this.session.send('Input.dispatchDragEvent', { type, x, y, data }).catch(() => undefined);
      }
    });
  }

  /** Resolves when the page has taken it. */
  async do(event: HandEvent): Promise<void> {
    await Promise.all(this.send(event));
  }

  /** Nothing is pressed any more. */
  async release(): Promise<void> {
    const [x, y] = this.at;
    for (const button of ['left', 'right', 'middle'] as const) {
      if (this.pressed & BIT[button]) await Promise.all(this.send({ kind: 'up', at: [x, y], button }));
    }
  }

  private send(event: HandEvent): Promise<unknown>[] {
    switch (event.kind) {
      case 'key':
        return this.key(event.key, event.modifiers);
      case 'text':
        return [this.input(this.session.send('Input.insertText', { text: event.text }))];
      case 'move':
        return [this.mouse('mouseMoved', event.to, 'none', 0)];
      case 'click': {
        const { at, button, count, modifiers } = event;
        const clicks = Array.from({ length: count }, (_, i) => [
          this.mouse('mousePressed', at, button, modifiers, i + 1),
          this.mouse('mouseReleased', at, button, modifiers, i + 1),
        ]);
        return [this.mouse('mouseMoved', at, 'none', modifiers), ...clicks.flat()];
      }
      case 'drag': {
        const { path, button, modifiers } = event;
        return [
          this.mouse('mouseMoved', path[0], 'none', modifiers),
          this.mouse('mousePressed', path[0], button, modifiers, 1),
          ...path.slice(1).map((to) => this.mouse('mouseMoved', to, button, modifiers)),
          this.mouse('mouseReleased', path[path.length - 1], button, modifiers, 1),
        ];
      }
      case 'down':
        return [this.mouse('mousePressed', event.at, event.button, 0, 1)];
      case 'up':
        return [this.mouse('mouseReleased', event.at, event.button, 0, 1)];
      case 'wheel': {
        const [x, y] = event.at;
        const [deltaX, deltaY] = event.by;
        const { modifiers } = event;
        this.at = event.at;
        const wheel = { type: 'mouseWheel', x, y, deltaX, deltaY, modifiers } as const;
        return [this.input(this.session.send('Input.dispatchMouseEvent', wheel))];
      }
      case 'touch':
        return this.touch(event.fingers);
    }
  }

  private key(name: string, modifiers: number): Promise<unknown>[] {
    const { key, code, windowsVirtualKeyCode, text } = keyOf(name, (modifiers & SHIFT) !== 0);
    const typed = modifiers & (ALT | CTRL) ? undefined : text;
    const common = { key, code, windowsVirtualKeyCode, modifiers };
    const down =
      typed === undefined
        ? ({ ...common, type: 'rawKeyDown' } as const)
        : ({ ...common, type: 'keyDown', text: typed } as const);
    return [
      this.input(this.session.send('Input.dispatchKeyEvent', down)),
      this.input(this.session.send('Input.dispatchKeyEvent', { ...common, type: 'keyUp' })),
    ];
  }

  private mouse(
    type: 'mouseMoved' | 'mousePressed' | 'mouseReleased',
    at: Point,
    button: MouseButton | 'none',
    modifiers: number,
    clickCount = 0,
  ): Promise<unknown> {
    if (button !== 'none' && type === 'mousePressed') this.pressed |= BIT[button];
    if (button !== 'none' && type === 'mouseReleased') this.pressed &= ~BIT[button];
    this.at = at;
    const [x, y] = at;
    const buttons = this.pressed;
    return this.input(
      this.session.send('Input.dispatchMouseEvent', { type, x, y, button, buttons, modifiers, clickCount }),
    );
  }

  private touch(fingers: readonly (readonly Point[])[]): Promise<unknown>[] {
    const at = (step: number) => fingers.map((path, id) => ({ id, x: path[step][0], y: path[step][1] }));
    const moves = fingers[0].slice(1).map((_, i) => ['touchMove', at(i + 1)] as const);
    const all = [['touchStart', at(0)] as const, ...moves, ['touchEnd', []] as const];
    return all.map(([type, touchPoints]) =>
      this.input(this.session.send('Input.dispatchTouchEvent', { type, touchPoints: [...touchPoints] })),
    );
  }

  private input(sent: Promise<unknown>): Promise<unknown> {
    this.inputs++;
    return sent;
  }
}
