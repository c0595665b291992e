import { expect, it, vi } from 'vitest';
import type { Character } from '../../../../src/model/document.ts';
import { compareEntries, compareWith } from '../../../../src/ui/editors/takes/compare-menu.ts';
import { listOfTakes } from '../../../../src/ui/editors/takes/play.ts';
import { takesToCompare, takeToCompare } from '../../../../src/ui/editors/takes/which-takes.ts';
import { findAction, isEnabled, reasonNot, runAction } from '../../../../src/ui/state/actions/action.ts';
import type { MenuEntry } from '../../../../src/ui/widgets/menu.ts';
import { character, documentOf, skeleton, takeOfValues } from '../../../helpers/builders.ts';
import { workbench } from '../../builders.ts';

function take(id: string, more: Partial<Character> = {}): Character {
  return character({ id, name: id, skeleton: skeleton(3), takes: [takeOfValues(id, [0])], shownTake: 0, ...more });
}

const renamed = (name: string) => {
  const { joints, ...rest } = skeleton(2);
  return { ...rest, joints: joints.map((j) => ({ ...j, name: `${name} ${j.name}` })) };
};

const others = [
  take('stranger', { skeleton: renamed('other') }),
  take('cousin', { skeleton: skeleton(2) }),
  take('twin'),
];

const bench = (...characters: Character[]) => workbench(documentOf(...characters)).wb;

function labels(entries: readonly MenuEntry[]): string[] {
  return entries.map((entry) => {
    if (entry.kind === 'item') return [entry.label, entry.detail].filter(Boolean).join(': ');
    return entry.kind === 'note' ? entry.text : entry.kind;
  });
}

const item = (entries: readonly MenuEntry[], label: string) =>
  entries.find((entry) => entry.kind === 'item' && entry.label === label);

it('takes of the same skeleton come first in the menu of takes to compare, then those with joints in common', () => {
  const wb = bench(take('a'), ...others);
  expect(labels(compareEntries(wb, listOfTakes(wb)[0]))).toEqual([
    'Compare a with',
    'twin',
    'line',
    'cousin: 2 joints in common',
    'line',
    'stranger: no joints in common',
  ]);
});

it('a take chosen in the menu is compared with the one it was opened for, whatever is selected', () => {
  const wb = bench(take('a'), ...others);
  const [a] = listOfTakes(wb);
  const chosen = item(compareEntries(wb, a), 'twin');
  if (chosen?.kind === 'item') chosen.run();
  expect(wb.timeline.takes.comparison.get()).toEqual({
    first: { characterId: 'a', take: 0 },
    second: { characterId: 'twin', take: 0 },
  });
});

it('a take without a joint in common says what to do when it is chosen', () => {
  const wb = bench(take('a'), ...others);
  const chosen = item(compareEntries(wb, listOfTakes(wb)[0]), 'stranger');
  if (chosen?.kind === 'item') chosen.refuse?.();
  expect(chosen).toMatchObject({ enabled: false });
  expect(wb.messages.passing.get()).toContain('Edit > Retarget take');
  wb.messages.offers[0]?.run();
  expect(wb.dialog.get()).toBe('retarget');
  expect(wb.timeline.takes.comparison.get()).toBeUndefined();
});

it('a row offers a menu of the other takes to compare with, the only other one by its name, and nothing when alone', () => {
  const many = bench(take('a'), ...others);
  expect(compareWith(many, listOfTakes(many)[0])).toMatchObject([{ kind: 'menu', label: 'Compare with' }]);
  const two = bench(take('a'), take('b'));
  expect(compareWith(two, listOfTakes(two)[1])).toMatchObject([{ kind: 'item', label: 'Compare with a' }]);
  const one = bench(take('a'));
  expect(compareWith(one, listOfTakes(one)[0])).toEqual([]);
});

it('the only two takes are compared without being selected', async () => {
  const wb = bench(take('a'), take('b'));
  runAction(wb, 'take.compare');
  await vi.waitUntil(() => wb.timeline.takes.comparison.get());
  expect(wb.timeline.takes.comparison.get()).toMatchObject({
    first: { characterId: 'a' },
    second: { characterId: 'b' },
  });
});

it('of several takes two must be selected, and the action says how', () => {
  const wb = bench(take('a'), ...others);
  const action = findAction(wb, 'take.compare');
  expect(action && isEnabled(wb, action)).toBe(false);
  expect(action && reasonNot(wb, action)).toMatch(/(Ctrl|Cmd)\+click the second/);
  expect(takesToCompare(wb)).toBeUndefined();
  wb.timeline.takes.change({ chosen: new Set(['a/0', 'twin/0']) });
  expect(takesToCompare(wb)?.map(({ name }) => name)).toEqual(['a', 'twin']);
  expect(action && isEnabled(wb, action)).toBe(true);
});

it('others are compared with the focused one of the selected takes, the current one, or the first', () => {
  const wb = bench(take('a'), ...others);
  expect(takeToCompare(wb)?.name).toBe('a');
  wb.store.select({ characterId: 'cousin' });
  expect(takeToCompare(wb)?.name).toBe('cousin');
  wb.timeline.takes.change({ chosen: new Set(['a/0', 'twin/0', 'cousin/0']), focused: 'twin/0' });
  expect(takeToCompare(wb)?.name).toBe('twin');
});

it('of several takes the only two that play are compared, unless another one is selected', () => {
  const wb = bench(take('a'), take('twin'), take('hidden', { isHidden: true }));
  expect(takesToCompare(wb)?.map(({ name }) => name)).toEqual(['a', 'twin']);
  wb.timeline.takes.change({ chosen: new Set(['twin/0']) });
  expect(takesToCompare(wb)?.map(({ name }) => name)).toEqual(['a', 'twin']);
  wb.timeline.takes.change({ chosen: new Set(['hidden/0']) });
  expect(takesToCompare(wb)).toBeUndefined();
});
