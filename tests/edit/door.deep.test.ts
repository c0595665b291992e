/**
 * The door for scripts: whatever is given to whichever command, it is refused in a sentence that names the command, and
 * nothing has changed; or it is one sound step that undo takes back.
 */
import { env } from 'node:process';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { AnyCommand } from '../../src/edit/command.ts';
import { CommandError } from '../../src/edit/command-error.ts';
import { ALL_COMMANDS, commandList } from '../../src/edit/commands/all.ts';
import { argumentsFrom, finiteOnly } from '../../src/edit/schema/door.ts';
import { Store } from '../../src/edit/store.ts';
import type { Document } from '../../src/model/document.ts';
import { expectSame } from '../helpers/expect-edit.ts';
import { checkDocument } from '../helpers/invariants.ts';
import { argumentsFor } from './any-command.ts';
import { Dice, thrown } from './dice.ts';
import { CASES } from './every-command.ts';
import { extreme, extremely, oddly } from './odd-arguments.ts';
import { randomDocument, seeds } from './rig/random-rig.ts';

/** Tries for each command; more by MARROW_TRIES. */
const TRIES = Number(env.MARROW_TRIES ?? 6);

const DEFAULTS = { timeSeconds: 0, playedRange: [0, 2] as const };

/** With what commands of their kind have in common left out where they don't take it. */
const ALL = [...ALL_COMMANDS].flatMap(([id, command]) => {
  if (!CASES[id]) return [];
  const { document, args } = CASES[id];
  const known = Object.entries(args).filter(([name]) => name !== 'characterId' || Object.hasOwn(command.args, name));
  return [{ id, command, given: { document, args: Object.fromEntries(known) } }];
});
const TAKEN = ALL.filter(({ id }) => id !== 'takes.endOverlay');

/** Runs it as a script does; false if it is refused. */
function run(store: Store, command: AnyCommand, args: unknown): boolean {
  const find = (ref: string | number | undefined) => {
    const { characters } = store.document;
    const found =
      ref === undefined ? characters[0] : (characters.find(({ id }) => id === ref) ?? characters.at(Number(ref)));
    if (!found) throw new CommandError('There is no such character.');
    return found.id;
  };
  try {
    store.apply(finiteOnly(command), argumentsFrom(command, args, DEFAULTS, find));
    return true;
  } catch (error) {
    if (!(error instanceof CommandError)) throw error;
    expect(error.message).toMatch(/^\S.*[.:?]$/s);
    expect(error.message.length).toBeLessThan(2500);
    return false;
  }
}

function expectHeld(document: Document, command: AnyCommand, args: unknown): void {
  const was = structuredClone(document);
  const store = new Store(document);
  const isDone = run(store, command, args);
  if (isDone) {
    // As it was before, but for what only making it through the store adds.
    if (store.document !== document) checkDocument(store.document);
    if (store.undoLabel !== undefined) expect(store.undo()).toBe(true);
  }
  expect(store.document).toBe(document);
  expectSame(document, was, 'the document after it');
}

describe('the door for scripts', () => {
  it.each(TAKEN)('$id takes its arguments as they are meant', ({ command, given }) => {
    const store = new Store(given.document);
    expect(run(store, command, given.args)).toBe(true);
    const direct = new Store(given.document);
    // The same arguments, as the page gives them.
    direct.apply(command, given.args as never);
    expectSame(store.document, direct.document);
  });

  it('the door for scripts says what each command takes', () => {
    const found = commandList().find(({ id }) => id === 'pose.setDofs');
    expect(found?.arguments).toMatchObject({
      characterId: expect.any(String),
      dofs: expect.stringContaining('index: a whole number from 0'),
    });
    for (const info of commandList()) expect(Object.values(info.arguments).every((what) => what.length > 3)).toBe(true);
  });

  it.each(ALL)('$id holds under odd arguments', ({ command, given }) => {
    fc.assert(
      fc.property(thrown, (numbers) => expectHeld(given.document, command, oddly(given.args, new Dice(numbers)))),
      { numRuns: TRIES },
    );
  });

  it.each(ALL)('$id holds under extreme numbers', ({ command, given }) => {
    fc.assert(
      fc.property(thrown, fc.array(extreme, { minLength: 1, maxLength: 3 }), (throws, numbers) =>
        expectHeld(given.document, command, extremely(given.args, new Dice(throws), numbers)),
      ),
      { numRuns: TRIES },
    );
  });

  it('the door for scripts holds for random documents and commands with something odd in them', () => {
    const ids = fc.constantFrom(...ALL_COMMANDS.keys());
    fc.assert(
      fc.property(seeds, ids, thrown, thrown, (seed, id, throws, odd) => {
        const document = randomDocument(seed);
        const command = ALL_COMMANDS.get(id);
        const args = argumentsFor(id, new Store(document), new Dice(throws));
        if (command && args) expectHeld(document, command, oddly(args, new Dice(odd)));
      }),
      { numRuns: 10 * TRIES },
    );
  });
});
