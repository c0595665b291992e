/**
 * Whatever is done, undoing it gives the document and the selection that were there, to the last bit, and redoing it
 * those that came of it; and every step changes something, and leaves all sound.
 */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { CommandError } from '../../src/edit/command-error.ts';
import { ALL_COMMANDS } from '../../src/edit/commands/all.ts';
import type { State } from '../../src/edit/history.ts';
import { Store, withSelectedKeys } from '../../src/edit/store.ts';
import { RADIANS_PER_DEGREE } from '../../src/math/degrees.ts';
import { type Document, findCharacter, shownTake } from '../../src/model/document.ts';
import type { Samples } from '../../src/model/takes/samples.ts';
import { type Channel, followingSamples, restChannel } from '../../src/model/takes/take.ts';
import { character, documentOf, joint, morph, skin, takeOfValues } from '../helpers/builders.ts';
import { expectSame, expectStep } from '../helpers/expect-edit.ts';
import { anyCommand, argumentsFor, COMMANDS_HERE, someKeys } from './any-command.ts';
import { Dice, thrown } from './dice.ts';
import { sliding } from './hold/sliding.ts';
import { channelOf, channelsOrRest } from './keys/channels.ts';
import { swinging, takeOfColumns } from './samples/made.ts';

/** Like the wasp: a root, a body with limits, wings and legs beside each other. 3 + 15 DOFs and a morph. */
const WASP = {
  name: 'wasp',
  joints: [
    joint(-1, { name: 'thorax', pose: [0.1, 0, 0] }),
    joint(0, {
      name: 'abdomen',
      limits: [
        { min: -1, max: 1 },
        { min: -0.5, max: 0.5 },
        { min: 0, max: 0 },
      ],
    }),
    joint(0, { name: 'wing_l' }),
    joint(0, { name: 'wing_r', pose: [0, 0, -0.3] }),
    joint(0, { name: 'leg_l', offset: [0.3, -0.1, 0] }),
  ],
};
const DOFS = 19;

/** Of motion capture, a fifth of a second. */
const SWING = takeOfColumns((column, seconds) => (column < 3 ? seconds : 30 * Math.sin(2 * seconds + column)), 13);

const NOTHING = 'nothing';

/** A dense one, of which an edit changes little. */
const LONG = channelOf(Array.from({ length: 60 }, (_, k) => [k / 8 - 1, Math.sin(k / 3)] as const));

/** Under the last of the channels, and others that lose their keys. */
const SAMPLES: Samples = {
  frameCount: 17,
  frameSeconds: 1 / 8,
  startSeconds: 0,
  firstChannel: 4,
  values: Float64Array.from({ length: 17 * (DOFS - 4) }, (_, i) => 40 * Math.sin(i / 9)),
  scales: new Float64Array(DOFS - 4).fill(RADIANS_PER_DEGREE),
  interpolation: 'linear',
};

function wasp(animated: readonly Channel[] | undefined): Document {
  const takes = animated && [
    {
      name: 'wasp_walk',
      range: [0, 2] as const,
      channels: followingSamples(
        [...animated, LONG, ...Array<Channel>(DOFS).fill(restChannel(0.5))].slice(0, DOFS),
        SAMPLES,
      ),
      samples: SAMPLES,
    },
  ];
  const made = character({
    id: 'w1',
    name: 'wasp',
    skeleton: WASP,
    skins: [skin('wasp'), skin('armour')],
    morphs: [morph('sting')],
    ...(takes && { takes, shownTake: 0 }),
  });
  const bee = character({ id: 'b1', name: 'bee', takes: [takeOfValues('bee_walk', Array(9).fill(0.3))], shownTake: 0 });
  const others = [
    { ...swinging(SWING), id: 'm1' },
    { ...sliding(0.004), id: 'f1' },
  ];
  return { ...documentOf(made, bee, ...others), charactersMade: 4 };
}

/** The copy of each object, made when it was first seen: what steps share, which is most of a document, is copied once. */
const copies = new WeakMap<object, object>();

/** Of plain data. What is written to after it was copied is no longer the same as its copy. */
function copyOf<T>(value: T): T;
function copyOf(value: unknown): unknown {
  if (typeof value !== 'object' || value === null) return value;
  const known = copies.get(value);
  if (known) return known;
  let copy: object;
  if (ArrayBuffer.isView(value)) copy = structuredClone(value);
  else if (Array.isArray(value)) copy = value.map((item) => copyOf(item));
  else copy = Object.fromEntries(Object.entries(value).map(([key, item]) => [key, copyOf(item)]));
  copies.set(value, copy);
  return copy;
}

/** All that undo has to bring back. */
function stateOf({ document, selection }: Store): State {
  return { document, selection };
}

/** A store, and beside it what each undo and redo has to lead to. */
class Watched {
  readonly store: Store;
  private readonly past: State[] = [];
  private readonly future: State[] = [];

  constructor(document: Document) {
    this.store = new Store(document);
    this.store.select({ characterId: 'w1', joint: 1 });
  }

  /** Anything that is one step, or none. */
  step(act: () => void): void {
    const before = this.store.document;
    const was = copyOf(stateOf(this.store));
    act();
    if (this.store.document === before) return;
    this.past.push(was);
    this.future.length = 0;
    expectStep(before, this.store.document, this.store.selection);
  }

  undo(): void {
    const now = copyOf(stateOf(this.store));
    const meant = this.past.pop();
    expect(this.store.undo()).toBe(meant !== undefined);
    if (meant === undefined) return;
    this.future.push(now);
    expectSame(stateOf(this.store), meant);
  }

  redo(): void {
    const now = copyOf(stateOf(this.store));
    const meant = this.future.pop();
    expect(this.store.redo()).toBe(meant !== undefined);
    if (meant === undefined) return;
    this.past.push(now);
    expectSame(stateOf(this.store), meant);
  }

  get undoable(): number {
    return this.past.length;
  }

  get redoable(): number {
    return this.future.length;
  }
}

/** Does one thing, as chosen by the dice. Refusals are fine: they have to leave everything as it was. */
function act(watched: Watched, id: string, dice: Dice): void {
  const { store } = watched;
  if (id === NOTHING) return;
  const command = ALL_COMMANDS.get(id);
  if (!command) throw new Error(`There is no command ${id}.`);
  const before = store.document;
  watched.step(() => {
    try {
      const args = argumentsFor(id, store, dice);
      // By name and with arguments made up: as from the console.
      if (dice.is(0.2)) drag(watched, id, dice);
      else if (args) store.apply(command, args as never);
    } catch (error) {
      if (!(error instanceof CommandError)) throw error;
      expect(store.document).toBe(before);
    }
  });
}

/** Several previews from one base, let go or given up. */
function drag({ store }: Watched, id: string, dice: Dice): void {
  const command = ALL_COMMANDS.get(id);
  const given = Array.from({ length: 1 + dice.below(3) }, () => argumentsFor(id, store, dice));
  const before = copyOf(stateOf(store));
  const gesture = store.begin('Drag');
  try {
    for (const args of given) {
      if (args && command) gesture.preview(command.run(gesture.base, args as never));
    }
    if (dice.is(0.7)) {
      gesture.commit();
      return;
    }
  } catch (error) {
    if (!(error instanceof CommandError)) throw error;
  }
  gesture.cancel();
  expectSame(stateOf(store), before);
}

/** What is no step: selecting. */
function between({ store }: Watched, dice: Dice): void {
  // Keys are of the character that is selected, which may be one that was just made.
  const selected = findCharacter(store.document, store.selection.characterId);
  const take = selected && shownTake(selected);
  if (take && dice.is(0.6)) store.select(withSelectedKeys(store.selection, someKeys(take, dice)));
}

const start = fc.option(fc.array(channelsOrRest({ steps: true, maxLength: 5 }), { maxLength: 6 }), { nil: undefined });
/** A hundred commands, a share of them of some kind. What fast-check leaves out of a failure becomes nothing. */
const hundred = (share: number, ...others: readonly string[]) => {
  const any = fc.oneof(
    { weight: 10 - 10 * share, arbitrary: anyCommand },
    { weight: 10 * share, arbitrary: fc.constantFrom(...others) },
  );
  const step = fc.oneof({ withCrossShrink: true }, fc.constant(NOTHING), { weight: 40, arbitrary: any });
  return fc.array(fc.tuple(step, thrown), { minLength: 100, maxLength: 100 });
};

describe('a hundred commands, whichever', () => {
  it('any hundred commands are undone one by one, document and selection alike, and redone', {
    timeout: 120_000,
  }, () => {
    const done = new Set<string>();
    fc.assert(
      fc.property(start, hundred(0.2, ...COMMANDS_HERE), (animated, all) => {
        const watched = new Watched(wasp(animated));
        for (const [id, numbers] of all) {
          const dice = new Dice(numbers);
          between(watched, dice);
          const { document } = watched.store;
          act(watched, id, dice);
          if (watched.store.document !== document) done.add(id);
        }
        const end = copyOf(stateOf(watched.store));
        const count = watched.undoable;
        while (watched.undoable) watched.undo();
        expect(watched.store.undo()).toBe(false);
        while (watched.redoable) watched.redo();
        expect(watched.store.redo()).toBe(false);
        expect(watched.undoable).toBe(count);
        expectSame(stateOf(watched.store), end);
      }),
      { numRuns: 20 },
    );
    // None of them is here only to be refused. Which ones a seed left out are tried among their own kind.
    for (const id of COMMANDS_HERE.filter((each) => !done.has(each))) {
      const kin = COMMANDS_HERE.filter((each) => each.split('.')[0] === id.split('.')[0]);
      for (const [animated, all] of fc.sample(fc.tuple(start, hundred(0.8, ...kin)), 30)) {
        if (done.has(id)) break;
        const watched = new Watched(wasp(animated));
        for (const [tried, numbers] of all) {
          if (done.has(id)) break;
          const { document } = watched.store;
          act(watched, tried, new Dice(numbers));
          if (watched.store.document !== document) done.add(tried);
        }
      }
    }
    expect(COMMANDS_HERE.filter((id) => !done.has(id))).toEqual([]);
  });

  it('bear being undone, redone and gone on with at random', { timeout: 120_000 }, () => {
    const walk = hundred(0.2, 'undo', 'redo');
    fc.assert(
      fc.property(start, walk, (animated, all) => {
        const watched = new Watched(wasp(animated));
        for (const [id, numbers] of all) {
          const dice = new Dice(numbers);
          if (id === 'undo') for (let i = dice.below(8); i >= 0; i--) watched.undo();
          else if (id === 'redo') for (let i = dice.below(8); i >= 0; i--) watched.redo();
          else act(watched, id, dice);
        }
        while (watched.undoable) watched.undo();
        while (watched.redoable) watched.redo();
        expect(watched.store.redoLabel).toBeUndefined();
      }),
      { numRuns: 12 },
    );
  });
});
