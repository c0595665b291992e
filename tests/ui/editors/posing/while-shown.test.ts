import { expect, it } from 'vitest';
import { whileShown } from '../../../../src/ui/editors/posing/while-shown.ts';
import { Posing } from '../../../../src/ui/state/posing.ts';

it('listens while shown, and not in between', () => {
  const posing = new Posing();
  // Only their identity matters.
  const [own, other] = [{}, {}] as HTMLElement[];
  const log: string[] = [];
  whileShown(posing, own, () => {
    log.push('listens');
    return [() => void log.push('a'), () => void log.push('b')];
  });
  posing.controls.set(other);
  expect(log).toEqual([]);
  posing.controls.set(own);
  expect(log).toEqual(['listens']);
  posing.controls.set(other);
  posing.controls.set(undefined);
  expect(log).toEqual(['listens', 'a', 'b']);
  posing.controls.set(own);
  posing.controls.set(undefined);
  expect(log).toEqual(['listens', 'a', 'b', 'listens', 'a', 'b']);
});
