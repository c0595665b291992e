import { describe, expect, it } from 'vitest';
import { COMMANDS_BY_ID } from '../../src/edit/commands/all.ts';
import { CommandError, Store } from '../../src/edit/store.ts';
import { character, documentOf } from '../helpers/builders.ts';

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
