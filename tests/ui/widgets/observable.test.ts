import { expect, it } from 'vitest';
import { observable } from '../../../src/ui/widgets/observable.ts';

it('tells listeners the new and the old value', () => {
  const value = observable(1);
  const heard: string[] = [];
  value.subscribe((now, before) => heard.push(`${before} to ${now}`));
  value.set(2);
  value.update((v) => v + 1);
  expect(heard).toEqual(['1 to 2', '2 to 3']);
});

it('notifies nobody of the same value', () => {
  const value = observable(Number.NaN);
  let times = 0;
  value.subscribe(() => times++);
  value.set(Number.NaN);
  expect(times).toBe(0);
});

it('lets a listener unsubscribe', () => {
  const value = observable(1);
  let times = 0;
  const leave = value.subscribe(() => times++);
  leave();
  value.set(2);
  expect(times).toBe(0);
});

it('never notifies of a value that another listener has replaced meanwhile', () => {
  const value = observable(0);
  const heard: number[] = [];
  value.subscribe((now) => {
    if (now === 1) value.set(2);
  });
  value.subscribe((now) => heard.push(now));
  value.set(1);
  expect(heard).toEqual([2]);
});
