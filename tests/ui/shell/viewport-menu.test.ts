import { describe, expect, it } from 'vitest';
import { pinPoint } from '../../../src/edit/commands/ik.ts';
import { selectForMenu, subjectOf, viewportEntries } from '../../../src/ui/shell/viewport-menu.ts';
import type { PosingMode } from '../../../src/ui/state/posing.ts';
import type { MenuEntry, MenuItem } from '../../../src/ui/widgets/menu.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../builders.ts';

const bones = skeleton(['hips', -1], ['leg_l', 0], ['foot_l', 1], ['leg_r', 0]);
const walking = character({
  skeleton: bones,
  takes: [take([0, 2], ...Array.from({ length: 15 }, () => channel(0, 1)))],
});

function page(mode: PosingMode, joint?: number) {
  const { wb } = workbench(documentOf(walking));
  wb.posing.mode.set(mode);
  if (joint !== undefined) wb.store.select({ characterId: 'c1', joint });
  return wb;
}

const itemsIn = (entries: readonly MenuEntry[]): MenuItem[] =>
  entries.flatMap((entry) => (entry.kind === 'item' ? [entry] : entry.kind === 'menu' ? itemsIn(entry.entries()) : []));
const labels = (entries: readonly MenuEntry[]) =>
  entries.flatMap((entry) => (entry.kind === 'item' || entry.kind === 'menu' ? [entry.label] : []));
function choose(entries: readonly MenuEntry[], label: string): void {
  const item = itemsIn(entries).find((one) => one.label === label);
  expect(item?.enabled, label).toBe(true);
  item?.run();
}

describe('what the viewport’s menu is about', () => {
  it('the viewport’s menu selects what was hit', () => {
    const wb = page('fk', 1);
    expect(selectForMenu(wb, { characterId: 'c1', placement: 0, joint: 2 })).toBe('joint');
    expect(wb.store.selection).toMatchObject({ characterId: 'c1', joint: 2 });
    expect(selectForMenu(wb, { characterId: 'c1', placement: 0 })).toBe('character');
  });

  it('the viewport’s menu leaves what is selected already, with its keys, and on the background everything', () => {
    const wb = page('fk');
    wb.store.select({ characterId: 'c1', joint: 1, keys: [{ channel: 6, indices: [0] }] });
    const { selection } = wb.store;
    expect(selectForMenu(wb, { characterId: 'c1', placement: 0, joint: 1, vertex: 4 })).toBe('joint');
    expect(wb.store.selection).toBe(selection);
    expect(selectForMenu(wb, undefined)).toBe('background');
    expect(wb.store.selection).toBe(selection);
  });

  it('the viewport’s menu adds a joint to what was selected before, and removes it', () => {
    const wb = page('fk', 1);
    const before = wb.store.selection;
    expect(labels(viewportEntries(wb, 'joint', before))).not.toContain('Add to selection');
    selectForMenu(wb, { characterId: 'c1', placement: 0, joint: 3 });
    choose(viewportEntries(wb, 'joint', before), 'Add to selection');
    expect(wb.store.selection).toMatchObject({ joint: 3, others: [1] });
    choose(viewportEntries(wb, 'joint', wb.store.selection), 'Remove from selection');
    expect(wb.store.selection).toMatchObject({ joint: 1 });
    expect(wb.store.selection.others).toBeUndefined();
  });

  it('by keyboard the viewport’s menu is about the selection', () => {
    const wb = page('fk');
    expect(subjectOf(wb)).toBe('background');
    wb.store.select({ characterId: 'c1' });
    expect(subjectOf(wb)).toBe('character');
    wb.store.select({ characterId: 'c1', joint: 0 });
    expect(subjectOf(wb)).toBe('joint');
  });
});

it('the viewport’s menu on one of several selected joints keeps them, and resets them all', async () => {
  const { wb } = workbench(documentOf({ ...walking, shownTake: -1, pose: walking.pose.with(6, 1).with(9, 1) }));
  wb.store.select({ characterId: 'c1', joint: 2, others: [1] });
  selectForMenu(wb, { characterId: 'c1', placement: 0, joint: 1 });
  expect(wb.store.selection).toMatchObject({ joint: 1, others: [2] });
  const entries = viewportEntries(wb, 'joint');
  expect(entries[0]).toEqual({ kind: 'note', text: '2 joints' });
  choose(entries, 'Reset 2 joints to file pose');
  await expect.poll(() => wb.store.document.characters[0].pose.every((value) => value === 0)).toBe(true);
  expect(wb.store.undoLabel).toBe('Reset 2 joints to file pose');
});

describe('the viewport’s menu of a joint', () => {
  it.each([
    ['fk', ['Key all DOFs of leg_l', 'Reset leg_l to file pose', 'Pose', 'Enforce limits', 'Frame selection']],
    ['ik', ['Pin leg_l', 'Lock leg_l', 'Stiffness', 'Pins', 'Frame selection']],
    ['rig', ['Add child', 'Rename joint', 'Type', 'Mirror hierarchy', 'Frame selection']],
  ] as const)('the viewport’s menu in %s has the actions of that mode, and names the joint', (mode, expected) => {
    const entries = viewportEntries(page(mode, 1), 'joint');
    expect(entries[0]).toEqual({ kind: 'note', text: 'leg_l' });
    expect(labels(entries)).toEqual(expect.arrayContaining([...expected]));
    expect(labels(entries)).toContain('Mode');
    expect(labels(entries).length).toBeLessThanOrEqual(12);
  });

  it.each(['fk', 'ik', 'rig', 'select'] as const)(
    'every menu of the viewport in %s is short and without doubles',
    (mode) => {
      const wb = page(mode, 1);
      for (const subject of ['joint', 'character', 'background'] as const) {
        const own = labels(viewportEntries(wb, subject));
        expect(own.length, subject).toBeLessThanOrEqual(12);
        expect(new Set(own).size, subject).toBe(own.length);
        const lines = viewportEntries(wb, subject).map(({ kind }) => kind);
        expect(lines.join(' '), subject).not.toMatch(/line line|line$/);
      }
    },
  );

  it('the viewport’s menu shows the shortcuts of its actions', () => {
    const item = itemsIn(viewportEntries(page('fk', 1), 'joint')).find(({ label }) => label === 'Frame selection');
    expect(item?.shortcut).toBe('F');
  });

  it('the viewport’s menu resets one joint to its file pose, in a step that is named so', async () => {
    const { wb } = workbench(documentOf({ ...walking, shownTake: -1, pose: walking.pose.with(6, 1).with(9, 1) }));
    wb.store.select({ characterId: 'c1', joint: 1 });
    choose(viewportEntries(wb, 'joint'), 'Reset leg_l to file pose');
    await expect.poll(() => wb.store.document.characters[0].pose[6]).toBe(0);
    expect(wb.store.document.characters[0].pose[9]).toBe(1);
    expect(wb.store.undoLabel).toBe('Reset leg_l to file pose');
  });

  it('the viewport’s menu sets weight and orientation of the joint’s pin', () => {
    const wb = page('ik', 2);
    expect(labels(viewportEntries(wb, 'joint'))).not.toContain('Relative weight');
    wb.store.apply(pinPoint, { characterId: 'c1', joint: 2, point: [0, 0, 0] });
    choose(viewportEntries(wb, 'joint'), 'Pin orientation');
    choose(viewportEntries(wb, 'joint'), '4');
    expect(wb.store.document.characters[0].ik?.pins[0]).toMatchObject({ holdsOrientation: true, weight: 4 });
    expect(itemsIn(viewportEntries(wb, 'joint')).find(({ label }) => label === 'Pin orientation')?.checked).toBe(true);
  });

  it('the viewport’s menu stiffens the joint', () => {
    const wb = page('ik', 2);
    choose(viewportEntries(wb, 'joint'), '8');
    expect(wb.store.document.characters[0].ik?.stiff).toEqual([{ joint: 2, stiffness: 8 }]);
    choose(viewportEntries(wb, 'joint'), 'Default');
    expect(wb.store.document.characters[0].ik?.stiff ?? []).toEqual([]);
  });

  it('the viewport’s menu gives the joint another type', async () => {
    const wb = page('rig', 2);
    choose(viewportEntries(wb, 'joint'), 'Hinge');
    await expect.poll(() => wb.store.document.characters[0].skeleton?.joints[2].motion.kind).toBe('hinge');
    expect(wb.store.undoLabel).toMatch(/^Set type of foot_l/);
  });
});

it('the viewport’s menu of the background opens files and frames all, on an empty stage too', () => {
  const { wb } = workbench();
  const own = labels(viewportEntries(wb, 'background'));
  expect(own).toEqual(
    expect.arrayContaining(['Open files…', 'Examples', 'Frame all', 'Camera', 'Skin', 'Grid', 'Theme']),
  );
});
