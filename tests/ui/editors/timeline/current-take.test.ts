import { beforeEach, describe, expect, it } from 'vitest';
import { shownTake } from '../../../../src/model/document.ts';
import {
  channelsInView,
  selectedKeys,
  selectedKeysInView,
  selectKeys,
} from '../../../../src/ui/editors/timeline/current-take.ts';
import { ACTIONS } from '../../../../src/ui/shell/actions.ts';
import { runAction } from '../../../../src/ui/state/actions/action.ts';
import type { Workbench } from '../../../../src/ui/state/workbench.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../../builders.ts';

let wb: Workbench;
const SHOWN = { channel: 0, indices: [1] };
const HIDDEN = { channel: 1, indices: [0, 1] };
const held = (index: number) => shownTake(wb.store.document.characters[0])?.channels[index];

beforeEach(() => {
  const walker = character({
    skeleton: skeleton(['hips', -1]),
    takes: [take([0, 2], channel(0, 1, 2), channel(0, 2), channel(0.5, 1.5))],
  });
  ({ wb } = workbench(documentOf(walker), { range: [0, 2], framesPerSecond: 10 }));
  selectKeys(wb, [SHOWN, HIDDEN]);
});

const WAYS: readonly (readonly [string, () => void])[] = [
  ['hidden', () => wb.timeline.change({ hidden: [1] })],
  ['not isolated', () => wb.timeline.isolate([0, 2])],
  ['filtered out', () => wb.timeline.change({ filter: 'tx' })],
  ['not listed', () => wb.timeline.change({ list: 'pinned', pinned: [0] })],
];

describe.each(WAYS)('keys of a curve that is %s', (how, hide) => {
  beforeEach(() => hide());

  it(`keys of a curve that is ${how} are not in hand, until they are in view again`, () => {
    expect(selectedKeysInView(wb)).toEqual([SHOWN]);
    wb.timeline.isolate(undefined);
    wb.timeline.change({ hidden: [], filter: '', list: 'all' });
    expect(selectedKeysInView(wb)).toEqual([SHOWN, HIDDEN]);
  });

  it.each([
    'timeline.later',
    'timeline.up',
    'timeline.delete',
    'timeline.snapToFrames',
    'timeline.tangents.flat',
    'timeline.tangents.in.linear',
    'timeline.unify',
    'timeline.break',
    'dope.rippleLater',
    'timeline.euler',
  ])(`keys of a curve that is ${how} are not touched by %s, and stay selected`, (id) => {
    const before = held(1);
    runAction(wb, id);
    expect(held(1)).toBe(before);
    expect(wb.store.selection.keys).toContainEqual(HIDDEN);
  });

  it(`keys of a curve that is ${how} are not copied`, () => {
    runAction(wb, 'timeline.copy');
    expect(wb.timeline.copied?.channels.map((c) => c.channel)).toEqual([0]);
  });

  it(`keys of a curve that is ${how} go with the rest when something else is selected`, () => {
    selectKeys(wb, [{ channel: 0, indices: [2] }]);
    expect(selectedKeys(wb)).toEqual([{ channel: 0, indices: [2] }]);
  });
});

it('edits no keys if all selected ones are out of view', () => {
  selectKeys(wb, [HIDDEN]);
  wb.timeline.change({ hidden: [1] });
  const refuses = ACTIONS.find((a) => a.id === 'timeline.delete')?.refuses;
  expect(refuses?.(wb)).toBe('Select keys first.');
});

it('edits all selected keys in the dope sheet, which draws all keys', () => {
  wb.timeline.change({ hidden: [1], tab: 'dope' });
  expect(selectedKeysInView(wb)).toEqual([SHOWN, HIDDEN]);
});

it('returns the same arrays while nothing has changed', () => {
  wb.timeline.change({ hidden: [1] });
  const keys = selectedKeysInView(wb);
  const channels = channelsInView(wb);
  expect(channelsInView(wb)).toBe(channels);
  wb.timeline.change({ snapsToFrames: false });
  expect(selectedKeysInView(wb)).toBe(keys);
});
