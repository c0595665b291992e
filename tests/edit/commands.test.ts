import { readdirSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { CommandError } from '../../src/edit/command-error.ts';
import { ALL_COMMANDS } from '../../src/edit/commands/all.ts';
import { COMMANDS_AT_HAND, mayBeFetched } from '../../src/edit/commands/first-commands.ts';
import { LABEL_LENGTH } from '../../src/edit/step-names.ts';
import { Store } from '../../src/edit/store.ts';
import type { Document } from '../../src/model/document.ts';
import { character, documentOf } from '../helpers/builders.ts';
import { expectEdit } from '../helpers/expect-edit.ts';
import { COMMANDS_HERE } from './any-command.ts';
import { CASES } from './every-command.ts';

/** Commands that need no more than a character. */
const COMPLETE = ['character.remove', 'ik.clearPins'];

describe('commands called from the console', () => {
  it.each([...ALL_COMMANDS.keys()].filter((id) => !COMPLETE.includes(id)))('%s refuses when nothing is said', (id) => {
    const store = new Store(documentOf(character()));
    const before = store.document;
    const command = ALL_COMMANDS.get(id);
    expect(command).toBeDefined();
    if (!command) return;
    // What a person may type into a console is not typed.
    expect(() => store.apply(command, { characterId: 'c1' } as never)).toThrow(CommandError);
    expect(() => store.apply(command, { characterId: 'c1', index: 0, dofs: 3, name: {}, to: 1 } as never)).toThrow(
      CommandError,
    );
    expect(store.document).toBe(before);
  });
});

const FOLDER = new URL('../../src/edit/commands/', import.meta.url);

/** What the files of commands export that is one. */
async function exportedCommands(): Promise<{ readonly id: string }[]> {
  const names = readdirSync(FOLDER, { recursive: true, encoding: 'utf8' });
  const files = names.filter((file) => file.endsWith('.ts') && file !== 'all.ts' && file !== 'at-hand.ts');
  const modules: object[] = await Promise.all(files.map((file) => import(new URL(file, FOLDER).href)));
  return modules.flatMap((module) => Object.values(module)).filter((made) => typeof made?.run === 'function');
}

describe('the list of commands', () => {
  it('holds every command that a file exports, each under its own id', async () => {
    const exported = await exportedCommands();
    expect([...ALL_COMMANDS.keys()].sort()).toEqual(exported.map(({ id }) => id).sort());
    for (const command of exported) expect(ALL_COMMANDS.get(command.id)).toBe(command);
  });

  it('those that the page loads on demand are told by how their ids begin', () => {
    const fetched = [...ALL_COMMANDS.keys()].filter((id) => !COMMANDS_AT_HAND.has(id));
    expect(fetched.filter((id) => !mayBeFetched(id))).toEqual([]);
    expect(mayBeFetched('view.frameAll')).toBe(false);
  });
});

describe('every command', () => {
  it('every command has a case', () => {
    expect(Object.keys(CASES).sort()).toEqual([...ALL_COMMANDS.keys()].sort());
  });

  it('every command has random arguments', () => {
    expect([...COMMANDS_HERE].sort()).toEqual([...ALL_COMMANDS.keys()].sort());
  });

  const all = [...ALL_COMMANDS].flatMap(([id, command]) => (CASES[id] ? [{ id, command, given: CASES[id] }] : []));

  // Others change what is edited, and nothing that is undone.
  const steps = all.filter(({ command }) => !command.isNoStep);

  it.each(steps)('$id makes one sound step that is undone and redone', ({ command, given }) => {
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

  it.each(all)('$id names its undo step by what it changes', ({ command, given }) => {
    const label = command.label(given.document, given.args as never);
    expect(label).toMatch(/^[A-Z]/);
    expect(label.length).toBeLessThanOrEqual(LABEL_LENGTH);
    const store = new Store(given.document);
    store.apply(command, given.args as never);
    // A count, or a name from the document, the arguments or the result.
    const names = namesIn([given.document, given.args, store.document]);
    const isNamed = /\b\d+ \w/.test(label) || names.some((name) => wordsOf(label).includes(wordsOf(name)));
    expect(isNamed, `"${label}" says on what`).toBe(true);
  });

  it.each(all)('$id cuts long names in its undo step', ({ command, given }) => {
    const { document, args } = longNamed([given.document, given.args]);
    const label = command.label(document, args as never);
    expect(label.length, label).toBeLessThanOrEqual(LABEL_LENGTH);
    expect(label).not.toContain(LONG);
  });
});

const LONG = 'of a character from another program with a very long name';

/** All names of at least two letters, whatever they are of. */
function namesIn(value: unknown): string[] {
  if (typeof value !== 'object' || value === null || ArrayBuffer.isView(value)) return [];
  return Object.entries(value).flatMap(([key, one]) =>
    key === 'name' && typeof one === 'string' && one.length > 1 ? [one] : namesIn(one),
  );
}

/** With a space on either side, so that only whole words are found. */
function wordsOf(text: string): string {
  return ` ${text.replace(/[^\w]+/g, ' ').trim()} `;
}

/** Copies with a long ending on each name, except those of DOFs, which are the program's own. */
function longNamed([document, args]: readonly [Document, object]): {
  readonly document: Document;
  readonly args: object;
} {
  const longer = (value: unknown): unknown => {
    if (typeof value !== 'object' || value === null || ArrayBuffer.isView(value)) return value;
    if (Array.isArray(value)) return value.map(longer);
    return Object.fromEntries(
      Object.entries(value).map(([key, one]) => [
        key,
        key === 'name' && typeof one === 'string' ? `${one} ${LONG}` : longer(one),
      ]),
    );
  };
  // The same shapes, with other names.
  return { document: longer(document) as Document, args: longer(args) as object };
}
