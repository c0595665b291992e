import { readdirSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { COMMANDS_BY_ID } from '../../src/edit/commands/all.ts';
import { COMMANDS_AT_HAND, FETCHED_IDS } from '../../src/edit/commands/at-hand.ts';
import { CommandError, Store } from '../../src/edit/store.ts';
import { character, documentOf } from '../helpers/builders.ts';
import { expectEdit } from '../helpers/expect-edit.ts';
import { COMMANDS_HERE } from './any-command.ts';
import { CASES } from './every-command.ts';

/** Commands that need no more than a character. */
const COMPLETE = ['character.remove', 'ik.clearPins'];

describe('commands called from the console', () => {
  it.each([...COMMANDS_BY_ID.keys()].filter((id) => !COMPLETE.includes(id)))(
    '%s refuses when nothing is said',
    (id) => {
      const store = new Store(documentOf(character()));
      const before = store.document;
      const command = COMMANDS_BY_ID.get(id);
      expect(command).toBeDefined();
      if (!command) return;
      // What a person may type into a console is not typed.
      expect(() => store.apply(command, { characterId: 'c1' } as never)).toThrow(CommandError);
      expect(() => store.apply(command, { characterId: 'c1', index: 0, dofs: 3, name: {}, to: 1 } as never)).toThrow(
        CommandError,
      );
      expect(store.document).toBe(before);
    },
  );
});

const FOLDER = new URL('../../src/edit/commands/', import.meta.url);

/** What the files of commands export that is one. */
async function exportedCommands(): Promise<{ readonly id: string }[]> {
  const files = readdirSync(FOLDER).filter((file) => file !== 'all.ts' && file !== 'at-hand.ts');
  const modules: object[] = await Promise.all(files.map((file) => import(new URL(file, FOLDER).href)));
  return modules.flatMap((module) => Object.values(module)).filter((made) => typeof made?.run === 'function');
}

describe('the list of commands', () => {
  it('holds every command that a file exports, each under its own id', async () => {
    const exported = await exportedCommands();
    expect([...COMMANDS_BY_ID.keys()].sort()).toEqual(exported.map(({ id }) => id).sort());
    for (const command of exported) expect(COMMANDS_BY_ID.get(command.id)).toBe(command);
  });

  it('the list of commands is known to the page, which loads the others on demand, by exactly its ids', () => {
    const fetched = [...COMMANDS_BY_ID.keys()].filter((id) => !COMMANDS_AT_HAND.has(id));
    expect([...FETCHED_IDS].sort()).toEqual(fetched.sort());
  });
});

describe('every command', () => {
  it('every command has a case', () => {
    expect(Object.keys(CASES).sort()).toEqual([...COMMANDS_BY_ID.keys()].sort());
  });

  it('every command has random arguments', () => {
    expect([...COMMANDS_HERE].sort()).toEqual([...COMMANDS_BY_ID.keys()].sort());
  });

  const all = [...COMMANDS_BY_ID].flatMap(([id, command]) => (CASES[id] ? [{ id, command, given: CASES[id] }] : []));

  it.each(all)('$id makes one sound step that is undone and redone', ({ command, given }) => {
    // By its id and as from the console, as above.
    expect(expectEdit(given.document, command, given.args as never)).not.toBe(given.document);
  });

  it.each(all)('$id refuses, or returns the same document, if there is nothing to do', ({ command, given }) => {
    const { document } = given;
    try {
      expect(expectEdit(document, command, given.idle as never)).toBe(document);
    } catch (error) {
      if (!(error instanceof CommandError)) throw error;
      expect(error.message).toMatch(/^\S.*[.:?]$/s);
    }
  });
});
