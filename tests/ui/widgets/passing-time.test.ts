import { beforeEach, describe, expect, it } from 'vitest';
import { type Clock, PassingTime } from '../../../src/ui/widgets/passing-time.ts';

/** A clock that advances on request. */
class Hands implements Clock {
  private at = 0;
  private waiting: { readonly due: number; readonly run: () => void }[] = [];

  now(): number {
    return this.at;
  }

  after(ms: number, run: () => void): () => void {
    const one = { due: this.at + ms, run };
    this.waiting.push(one);
    return () => {
      this.waiting = this.waiting.filter((other) => other !== one);
    };
  }

  goOn(ms: number): void {
    this.at += ms;
    const due = this.waiting.filter((one) => one.due <= this.at);
    this.waiting = this.waiting.filter((one) => one.due > this.at);
    for (const { run } of due) run();
  }
}

let clock: Hands;
let time: PassingTime;
let overs: number;

beforeEach(() => {
  clock = new Hands();
  overs = 0;
  time = new PassingTime(100, () => overs++, clock);
});

describe('PassingTime', () => {
  it('PassingTime is over once, after its time', () => {
    time.begin();
    clock.goOn(99);
    expect(overs).toBe(0);
    clock.goOn(1);
    clock.goOn(1000);
    expect(overs).toBe(1);
  });

  it('PassingTime begins again with another message', () => {
    time.begin();
    clock.goOn(60);
    time.begin();
    clock.goOn(60);
    expect(overs).toBe(0);
    clock.goOn(40);
    expect(overs).toBe(1);
  });

  it('stands still while it is held, and goes on with what is left', () => {
    time.begin();
    clock.goOn(60);
    time.hold(true);
    clock.goOn(1000);
    time.hold(false);
    clock.goOn(39);
    expect(overs).toBe(0);
    clock.goOn(1);
    expect(overs).toBe(1);
  });

  it('waits where another message comes while it is held', () => {
    time.begin();
    time.hold(true);
    time.begin();
    clock.goOn(1000);
    expect(overs).toBe(0);
    time.hold(false);
    clock.goOn(100);
    expect(overs).toBe(1);
  });

  it('PassingTime is never over once it has ended, and is not held by one that has gone from under the pointer', () => {
    time.begin();
    time.hold(true);
    time.end();
    time.hold(false);
    clock.goOn(1000);
    expect(overs).toBe(0);
    time.begin();
    clock.goOn(100);
    expect(overs).toBe(1);
  });
});
