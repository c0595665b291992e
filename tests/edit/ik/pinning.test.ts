import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { Command } from '../../../src/edit/command.ts';
import { CommandError } from '../../../src/edit/command-error.ts';
import { clearPins, pinPoint, setPin, setRootFree, setStiffness, unpin } from '../../../src/edit/commands/ik.ts';
import { Store } from '../../../src/edit/store.ts';
import type { Document } from '../../../src/model/document.ts';
import { character, documentOf, skeleton } from '../../helpers/builders.ts';
import { Dice, thrown } from '../dice.ts';

const CHAIN = skeleton(4);
const TIP = { characterId: 'c1', joint: 3, point: [0, 0, 0] } as const;
const of = { characterId: 'c1' };

const fresh = () => new Store(documentOf(character({ skeleton: CHAIN }), character({ id: 'c2' })));
const ik = ({ document }: Store) => document.characters[0].ik;

describe('pinning', () => {
  it('adds pins with ids of their own, one step each', () => {
    const store = fresh();
    store.apply(pinPoint, TIP);
    store.apply(pinPoint, { ...TIP, point: [0, 1, 0], weight: 2, holdsOrientation: true });
    expect(ik(store)?.pins).toEqual([
      { id: 1, joint: 3, point: [0, 0, 0], weight: 1, holdsOrientation: false },
      { id: 2, joint: 3, point: [0, 1, 0], weight: 2, holdsOrientation: true },
    ]);
    expect(store.undoLabel).toBe('Pin joint3');
    store.undo();
    expect(ik(store)?.pins.length).toBe(1);
    store.undo();
    expect(store.document.characters[0]).not.toHaveProperty('ik');
  });

  it('leaves the other characters what they are', () => {
    const store = fresh();
    const other = store.document.characters[1];
    store.apply(pinPoint, TIP);
    expect(store.document.characters[1]).toBe(other);
  });

  it('refuses a point that is pinned already, in metres as in centimetres', () => {
    for (const size of [1e-3, 1, 1e3]) {
      const joints = CHAIN.joints.map((j) => ({ ...j, offset: [0, size, 0] as const }));
      const store = new Store(documentOf(character({ skeleton: { ...CHAIN, joints } })));
      store.apply(pinPoint, TIP);
      expect(() => store.apply(pinPoint, { ...TIP, point: [0, 1e-9 * size, 0] })).toThrow('already pinned');
      store.apply(pinPoint, { ...TIP, joint: 2 });
      store.apply(pinPoint, { ...TIP, point: [0, 0.01 * size, 0] });
      expect(ik(store)?.pins.length).toBe(3);
    }
  });

  it.each([
    { ...TIP, joint: 4 },
    { ...TIP, joint: 1.5 },
    { ...TIP, point: [0, 0] },
    { ...TIP, point: [0, Number.NaN, 0] },
    { ...TIP, weight: 0 },
    { ...TIP, weight: Infinity },
    { ...TIP, holdsOrientation: 1 },
  ])('refuses what is no pin: %j', (args) => {
    const store = fresh();
    // What a person may type into a console is not typed.
    expect(() => store.apply(pinPoint, args as never)).toThrow(CommandError);
  });

  it('pinning is refused for a skin alone', () => {
    const { skeleton: _none, ...loose } = character();
    expect(() => new Store(documentOf(loose)).apply(pinPoint, TIP)).toThrow('no skeleton');
  });
});

describe('letting go', () => {
  it('takes pins by their ids, and the rest keep theirs', () => {
    const store = fresh();
    for (const joint of [1, 2, 3]) store.apply(pinPoint, { ...TIP, joint });
    expect(unpin.label(store.document, { ...of, pins: [2] })).toBe('Unpin joint2');
    expect(unpin.label(store.document, { ...of, pins: [1, 3] })).toBe('Unpin 2 points');
    store.apply(unpin, { ...of, pins: [2] });
    expect(ik(store)?.pins.map(({ id }) => id)).toEqual([1, 3]);
    store.apply(pinPoint, { ...TIP, joint: 0 });
    expect(ik(store)?.pins.map(({ id }) => id)).toEqual([1, 3, 4]);
    expect(() => store.apply(unpin, { ...of, pins: [2] })).toThrow('no pin 2');
  });

  it('leaves nothing behind when the last is removed, and is no step if there is none', () => {
    const store = fresh();
    const before = store.document.characters[0];
    store.apply(clearPins, of);
    expect(store.undoLabel).toBeUndefined();
    store.apply(pinPoint, TIP);
    store.apply(clearPins, of);
    expect(store.undoLabel).toBe('Remove 1 pin of hero');
    expect(store.document.characters[0]).toMatchObject(before);
    expect(store.document.characters[0]).not.toHaveProperty('ik');
  });
});

describe('changing a pin', () => {
  const pinned = () => {
    const store = fresh();
    store.apply(pinPoint, TIP);
    store.apply(pinPoint, { ...TIP, joint: 2 });
    return store;
  };

  it('changing a pin keeps omitted settings, and its id', () => {
    const store = pinned();
    store.apply(setPin, { ...of, pin: 1, weight: 3 });
    store.apply(setPin, { ...of, pin: 1, holdsOrientation: true });
    expect(store.undoLabel).toBe('Pin orientation of joint3');
    store.apply(setPin, { ...of, pin: 1, joint: 1, point: [1, 0, 0] });
    expect(store.undoLabel).toBe('Move pin of joint3');
    expect(ik(store)?.pins[0]).toEqual({ id: 1, joint: 1, point: [1, 0, 0], weight: 3, holdsOrientation: true });
  });

  it('changing a pin is no step if nothing changes, and refused onto another pin', () => {
    const store = pinned();
    const before = store.document;
    store.apply(setPin, { ...of, pin: 1, weight: 1, point: [0, 0, 0] });
    expect(store.document).toBe(before);
    expect(() => store.apply(setPin, { ...of, pin: 1, joint: 2 })).toThrow('already pinned');
    expect(() => store.apply(setPin, { ...of, pin: 9, weight: 2 })).toThrow('There is no pin 9; there are 1, 2.');
  });
});

describe('locking and stiffening joints', () => {
  it('locking and stiffening joints is stored in joint order, and removed when all bend as by default', () => {
    const store = fresh();
    const set = (joints: number[], stiffness: number | 'locked' | 'usual') =>
      store.apply(setStiffness, { ...of, joints, stiffness });
    set([3], 4);
    expect(store.undoLabel).toBe('Stiffen joint3');
    set([1], 'locked');
    expect(store.undoLabel).toBe('Lock joint1');
    expect(ik(store)?.stiff).toEqual([{ joint: 1 }, { joint: 3, stiffness: 4 }]);
    const { document } = store;
    set([1, 1], 'locked');
    expect(store.document).toBe(document);
    set([1, 3], 1);
    expect(store.undoLabel).toBe('Unlock 2 joints');
    expect(store.document.characters[0]).not.toHaveProperty('ik');
  });

  it.each([0.5, 0, -1, Number.NaN, Infinity, 'soft'])('refuses a stiffness of %s', (stiffness) => {
    expect(() => fresh().apply(setStiffness, { ...of, joints: [1], stiffness } as never)).toThrow(CommandError);
  });
});

describe('the root', () => {
  it('the root is freed or fixed, and nothing is stored if that is the default', () => {
    const store = fresh();
    store.apply(setRootFree, { ...of, isFree: false });
    expect(store.undoLabel).toBe('Keep root of hero in place');
    expect(ik(store)?.rootIsFree).toBe(false);
    store.apply(setRootFree, { ...of, isFree: true });
    expect(store.document.characters[0]).not.toHaveProperty('ik');

    const bound = new Store(documentOf(character({ skeleton: { ...CHAIN, form: 'axis-angle' } })));
    const before = bound.document;
    bound.apply(setRootFree, { ...of, isFree: false });
    expect(bound.document).toBe(before);
    bound.apply(setRootFree, { ...of, isFree: true });
    expect(ik(bound)?.rootIsFree).toBe(true);
  });
});

describe('whatever is pinned, locked and let go', () => {
  const any = (store: Store, dice: Dice): void => {
    const ids = ik(store)?.pins.map(({ id }) => id) ?? [];
    const apply = <Args>(command: Command<Args>, args: Args) => store.apply(command, args);
    const joint = dice.below(4);
    const stiffness = dice.pick(['locked', 'usual', 2] as const);
    const acts = [
      () => apply(pinPoint, { ...TIP, joint, point: [0, dice.below(3), 0] }),
      () => apply(unpin, { ...of, pins: dice.some(ids, 0.5) }),
      () => apply(clearPins, of),
      () => apply(setPin, { ...of, pin: ids.length ? dice.pick(ids) : 0, joint, weight: 1 + dice.below(2) }),
      () => apply(setStiffness, { ...of, joints: [joint], stiffness }),
      () => apply(setRootFree, { ...of, isFree: dice.is(0.5) }),
      () => apply(pinPoint, { ...TIP, joint }),
    ];
    dice.pick(acts)();
  };

  it('whatever is pinned, locked and let go comes back to the very document, and is sound all the way', () => {
    fc.assert(
      fc.property(fc.array(thrown, { minLength: 1, maxLength: 40 }), (all) => {
        const store = fresh();
        const seen: Document[] = [store.document];
        for (const numbers of all) {
          const before = store.document;
          try {
            any(store, new Dice(numbers));
          } catch (error) {
            if (!(error instanceof CommandError)) throw error;
          }
          if (store.document !== before) seen.push(store.document);
          const now = ik(store);
          const isDefault = now?.pins.length === 0 && now.stiff.length === 0 && now.rootIsFree;
          expect(isDefault).not.toBe(true);
          expect(new Set(now?.pins.map(({ id }) => id)).size).toBe(now?.pins.length ?? 0);
          expect(now?.stiff.map((s) => s.joint)).toEqual(now?.stiff.map((s) => s.joint).sort((a, b) => a - b));
        }
        for (const document of seen.slice(0, -1).reverse()) {
          store.undo();
          expect(store.document).toEqual(document);
        }
        expect(store.undo()).toBe(false);
      }),
    );
  });
});
