import { describe, expect, it } from 'vitest';
import { setDofs } from '../../../../src/edit/commands/pose.ts';
import { timeEntries } from '../../../../src/ui/editors/timeline/time-menu.ts';
import type { MenuEntry } from '../../../../src/ui/widgets/menu.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../../builders.ts';

const bones = skeleton(['hips', -1]);
const walking = character({
  skeleton: bones,
  takes: [take([0, 2], ...Array.from({ length: 6 }, () => channel(0, 1)))],
});
const page = () => workbench(documentOf(walking), { timeSeconds: 0.5, range: [0, 2], framesPerSecond: 10 }).wb;

const labels = (entries: readonly MenuEntry[]) =>
  entries.flatMap((entry) => (entry.kind === 'item' || entry.kind === 'menu' ? [entry.label] : []));

function choose(entries: readonly MenuEntry[], label: string): void {
  const item = entries.find((entry) => entry.kind === 'item' && entry.label === label);
  expect(item, label).toBeDefined();
  if (item?.kind === 'item') item.run();
}

describe('the menu of a ruler', () => {
  it('the menu of a ruler sets either end of the range there, and the other end is never before it', () => {
    const wb = page();
    choose(timeEntries(wb, 1.5), 'Set range start here');
    expect(wb.transport.get().range).toEqual([1.5, 2]);
    choose(timeEntries(wb, 1), 'Set range end here');
    expect(wb.transport.get().range).toEqual([1, 1]);
    choose(timeEntries(wb, 3), 'Set range start here');
    expect(wb.transport.get().range).toEqual([3, 3]);
    expect(wb.transport.get().timeSeconds).toBe(0.5);
  });

  it('the menu of a ruler goes there and pauses', () => {
    const wb = page();
    wb.transport.update((p) => ({ ...p, playing: true }));
    choose(timeEntries(wb, 1.5), 'Go here');
    expect(wb.transport.get()).toMatchObject({ timeSeconds: 1.5, playing: false });
  });

  it('the menu of a ruler keys the whole pose there, in one step', () => {
    const wb = page();
    choose(timeEntries(wb, 1.5), 'Key whole pose here');
    const [first] = wb.store.document.characters[0].takes[0].channels;
    expect(first.kind === 'keys' && [...first.times]).toEqual([0, 1, 1.5]);
    expect(wb.store.undoLabel).toBe('Key pose of wasp');
    wb.store.undo();
    expect(wb.store.document.characters[0]).toEqual(walking);
  });

  it('the menu of a ruler keys nothing at another time while there are unkeyed changes, which going there would discard', () => {
    const wb = page();
    wb.store.apply(setDofs, {
      characterId: walking.id,
      timeSeconds: 0.5,
      dofs: [{ index: 0, value: 3 }],
    });
    const here = timeEntries(wb, 1.5).find((entry) => entry.kind === 'item' && entry.label === 'Key whole pose here');
    expect(here).toMatchObject({ enabled: false, detail: 'Key or undo the unkeyed changes first' });
  });

  it('the menu at the current time has the actions of the current time, with their shortcuts', () => {
    const wb = page();
    const entries = timeEntries(wb, 0.5);
    expect(labels(entries)).toEqual(expect.arrayContaining(['Key whole pose', 'Delete keys at current time']));
    expect(labels(entries)).not.toContain('Go here');
    expect(entries).toContainEqual(expect.objectContaining({ label: 'Key whole pose', shortcut: 'Shift+K' }));
  });

  it('the menu of a ruler is named by its time, as the ruler shows it, and is short', () => {
    const wb = page();
    expect(timeEntries(wb, 1.5)[0]).toEqual({ kind: 'note', text: '1.5 s' });
    wb.settings.update((s) => ({ ...s, timeDisplay: 'frames' }));
    expect(timeEntries(wb, 1.5)[0]).toEqual({ kind: 'note', text: 'frame 15' });
    expect(labels(timeEntries(wb, 1.5)).length).toBeLessThanOrEqual(13);
  });
});
