import { beforeEach, describe, expect, it } from 'vitest';
import { renameCharacter } from '../../../src/edit/commands/characters.ts';
import { leaveRefusalsBehind } from '../../../src/ui/shell/stale-messages.ts';
import type { Workbench } from '../../../src/ui/state/workbench.ts';
import { character, documentOf, workbench } from '../builders.ts';

let wb: Workbench;
const unread = () => wb.messages.list.get().flatMap((m) => (m.unread ? [m.text] : []));
const named = (name: string) => ({ characterId: 'c1', name });

beforeEach(() => {
  ({ wb } = workbench(documentOf(character())));
  leaveRefusalsBehind(wb);
});

describe('a refusal', () => {
  it('a refusal leaves the line on the next step, and stays in the list', () => {
    wb.messages.note('No.', 'warning');
    wb.store.select({ characterId: 'c1' });
    expect(unread()).toEqual(['No.']);
    wb.store.apply(renameCharacter, named('bee'));
    expect(unread()).toEqual([]);
    expect(wb.messages.list.get()).toMatchObject([{ text: 'No.' }]);
  });

  it('a refusal stays if nothing changes', () => {
    wb.messages.note('No.', 'warning');
    wb.store.apply(renameCharacter, named('wasp'));
    expect(unread()).toEqual(['No.']);
  });

  it('a refusal during a drag stays at its end, and leaves with the next one', () => {
    wb.messages.note('Before.', 'warning');
    const drag = wb.store.begin('Drag');
    drag.preview(renameCharacter.run(drag.base, named('be')));
    wb.messages.note('Amid.', 'warning');
    drag.preview(renameCharacter.run(drag.base, named('bee')));
    drag.commit();
    expect(unread()).toEqual(['Amid.']);
    wb.store.apply(renameCharacter, named('ant'));
    expect(unread()).toEqual([]);
  });

  it('a refusal is not kept by a cancelled drag, nor by another document', () => {
    const drag = wb.store.begin('Drag');
    drag.preview(renameCharacter.run(drag.base, named('be')));
    wb.messages.note('Amid.', 'warning');
    drag.cancel();
    expect(unread()).toEqual(['Amid.']);
    wb.store.apply(renameCharacter, named('ant'));
    expect(unread()).toEqual([]);
    wb.store.replace('Open', documentOf(character()));
    wb.messages.note('After.', 'warning');
    wb.store.apply(renameCharacter, named('fly'));
    expect(unread()).toEqual([]);
  });
});

describe('what a step leaves as it is', () => {
  it('steps keep errors, warnings to be read, and problems of files in the line', () => {
    wb.messages.note('Broken.', 'error');
    wb.messages.note('Full.', 'warning', 'until read');
    const place = { file: 'a.skel', line: 1, column: 1, code: 'odd', severity: 'warning', message: 'Odd.' } as const;
    wb.messages.report([place]);
    wb.messages.note('Full.', 'warning', 'until read');
    wb.store.apply(renameCharacter, named('bee'));
    expect(unread()).toEqual(['a.skel:1: Odd.', 'Full.']);
  });
});

describe('what is said in passing', () => {
  it('a confirmation disappears with the next step, unless it is about that', () => {
    wb.messages.note('Copied.');
    wb.store.apply(renameCharacter, named('bee'));
    expect(wb.messages.passing.get()).toBeUndefined();
    wb.store.subscribe(() => wb.messages.note('Said of it.'));
    wb.store.apply(renameCharacter, named('ant'));
    expect(wb.messages.passing.get()).toBe('Said of it.');
  });
});
