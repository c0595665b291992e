import { beforeEach, describe, expect, it } from 'vitest';
import { CommandError } from '../../../src/edit/command-error.ts';
import { removeCharacter, renameCharacter } from '../../../src/edit/commands/characters.ts';
import { leaveRefusalsBehind } from '../../../src/ui/shell/stale-messages.ts';
import { findAction, tryAction } from '../../../src/ui/state/actions/action.ts';
import type { Workbench } from '../../../src/ui/state/workbench.ts';
import { character, documentOf, skeleton, workbench } from '../builders.ts';

let wb: Workbench;
const unread = () => wb.messages.list.get().flatMap((m) => (m.unread ? [m.text] : []));
const named = (name: string) => ({ characterId: 'c1', name });

beforeEach(() => {
  ({ wb } = workbench(documentOf(character())));
  leaveRefusalsBehind(wb);
});

it('what was undone is said until it is there again', () => {
  wb.store.replace('Open sword.skel', documentOf(character(), character({ id: 'c2', name: 'sword' })));
  const run = (id: string) => {
    const action = findAction(wb, id);
    if (action) tryAction(wb, action);
  };
  run('edit.undo');
  expect(wb.messages.passing.get()).toBe('Undone: Open sword.skel. Redo restores it.');
  wb.store.replace('Open sword.skel', documentOf(character(), character({ id: 'c3', name: 'sword' })));
  expect(wb.messages.passing.get()).toBeUndefined();
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

describe('what is over', () => {
  it('why an action was not possible leaves as soon as it is', () => {
    const { wb: page } = workbench(documentOf(character({ skeleton: skeleton(['hips', -1], ['leg', 0]) })));
    leaveRefusalsBehind(page);
    const action = findAction(page, 'select.hierarchy');
    if (action) tryAction(page, action);
    expect(page.messages.passing.get()).toBe('Select a joint first.');
    page.store.select({ characterId: 'c1' });
    expect(page.messages.passing.get()).toBe('Select a joint first.');
    page.store.select({ characterId: 'c1', joint: 0 });
    expect(page.messages.passing.get()).toBeUndefined();
  });

  it('that nothing was changed leaves when something else is selected, or with another mode', () => {
    const { wb: page } = workbench(documentOf(character({ skeleton: skeleton(['hips', -1], ['leg', 0]) })));
    leaveRefusalsBehind(page);
    const parent = findAction(page, 'select.parent');
    const changes = [() => page.store.select({ characterId: 'c1', joint: 1 }), () => page.posing.mode.set('ik')];
    for (const change of changes) {
      page.store.select({ characterId: 'c1', joint: 0 });
      if (parent) tryAction(page, parent);
      expect(page.messages.passing.get()).toBe('The selected joint has no parent.');
      change();
      expect(page.messages.passing.get()).toBeUndefined();
    }
  });

  it('a command that is refused leaves with what it was about, and is no fault', () => {
    const refuses = {
      id: 'test',
      label: 'Try',
      group: 'Edit',
      run() {
        throw new CommandError('Not so.');
      },
    } as const;
    tryAction(wb, refuses);
    expect(wb.messages.list.get()).toMatchObject([{ text: 'Try: Not so.', severity: 'warning', unread: true }]);
    wb.store.select({ characterId: 'c1' });
    expect(unread()).toEqual([]);
  });

  it('what has a button for a step leaves with undo', () => {
    wb.store.apply(renameCharacter, named('bee'));
    const { document } = wb.store;
    wb.messages.confirm('Renamed.', { label: 'Undo', run: () => {} }, () => wb.store.document !== document);
    wb.store.select({ characterId: 'c1' });
    expect(wb.messages.passing.get()).toBe('Renamed.');
    wb.store.undo();
    expect(wb.messages.passing.get()).toBeUndefined();
  });

  it('problems of the files of a removed character leave the line, and those of others stay', () => {
    const from = (id: string, name: string) => character({ id, sources: [{ name, path: `dir/${name}`, bytes: 1 }] });
    const { wb: page } = workbench(documentOf(from('a', 'a.skel'), from('b', 'b.skel')));
    leaveRefusalsBehind(page);
    const odd = { line: 1, column: 1, code: 'odd', severity: 'warning', message: 'Odd.' } as const;
    page.messages.report([
      { ...odd, file: 'a.skel' },
      { ...odd, file: 'dir/b.skel' },
    ]);
    const texts = () => page.messages.list.get().flatMap((m) => (m.unread ? [m.text] : []));
    page.store.apply(removeCharacter, { characterId: 'a' });
    expect(texts()).toEqual(['dir/b.skel:1: Odd.']);
    page.store.apply(removeCharacter, { characterId: 'b' });
    expect(texts()).toEqual([]);
    expect(page.messages.list.get()).toHaveLength(2);
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
