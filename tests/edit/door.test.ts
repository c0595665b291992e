/** What scripts give to commands, and in which words it is refused. */
import { describe, expect, it } from 'vitest';
import { command } from '../../src/edit/command.ts';
import { ALL_COMMANDS } from '../../src/edit/commands/all.ts';
import { argumentsFrom, finiteOnly } from '../../src/edit/schema/door.ts';
import { presentId } from '../../src/edit/schema/old-names.ts';
import { Store } from '../../src/edit/store.ts';
import type { Character, Document } from '../../src/model/document.ts';
import { character, documentOf, joint, takeOfValues } from '../helpers/builders.ts';

const ARM = character({
  skeleton: { name: 'arm', joints: [joint(-1, { name: 'arm' })] },
  takes: [takeOfValues('wave', [0, 1, 2, 3], [0, 2])],
  shownTake: 0,
});
const DEFAULTS = { timeSeconds: 0.5, playedRange: [0, 2] as const };

function run(id: string, args: unknown, document: Document = documentOf(ARM)): Document {
  const taken = ALL_COMMANDS.get(id);
  if (!taken) throw new Error(`There is no command ${id}.`);
  const store = new Store(document);
  store.apply(
    finiteOnly(taken),
    argumentsFrom(taken, args, DEFAULTS, () => 'c1'),
  );
  return store.document;
}

describe('arguments from scripts', () => {
  it('old ids and the old name of a take give what the present ones give', () => {
    const range = [0.5, 1.5];
    expect(run(presentId('clip.setRange'), { clip: 0, range })).toEqual(run('take.setRange', { take: 0, range }));
    const [old, now] = ['clip', 'take'].map((name) => [{ characterId: 'c1', [name]: 0 }]);
    expect(run('takes.setSpeed', { takes: old, factor: 2 })).toEqual(run('takes.setSpeed', { takes: now, factor: 2 }));
    expect(presentId('character.showClip')).toBe('character.showTake');
    for (const id of ALL_COMMANDS.keys()) expect(presentId(id)).toBe(id);
    expect(() => run('take.rename', { clip: 0, take: 0, name: 'x' })).toThrow('clip');
  });

  it('a list that says it is endless is refused before any of it is looked at', () => {
    const takes = Object.assign([], { length: 2 ** 32 - 1 });
    expect(() => run('takes.setSpeed', { takes, factor: 2 })).toThrow('a list of at most 16,777,216 items');
  });

  it.each(['length', 2 ** 32 - 1, 'map', '__proto__', -1, 0.5, null])('a DOF with the index %j is refused', (index) => {
    const { skeleton } = ARM;
    const document = documentOf(character({ ...(skeleton && { skeleton }) }));
    expect(() => run('pose.setDofs', { dofs: [{ index, value: 2 ** 32 - 1 }] }, document)).toThrow(/index|DOF number/);
    expect(document.characters[0].pose).toHaveLength(6);
  });

  it('arguments from scripts are refused with the command, the argument, what was found and what was expected', () => {
    const refused = (id: string, args: unknown) => (message: string) => expect(() => run(id, args)).toThrow(message);
    refused('pose.setDofs', { dofs: [{ index: 'length', value: 1 }] })(
      'pose.setDofs: "dofs[0].index" must be a whole number from 0, found "length".',
    );
    refused('pose.setDofs', { dofs: [{ index: 1 }] })('"dofs[0].value" must be a finite number, found nothing.');
    refused('pose.setDofs', 7)('pose.setDofs: The arguments must be an object, found 7.');
    refused('rig.setOffset', { joint: 0, offset: [1, 2], children: 'stay' })(
      '"offset" must be a list of 3 finite numbers',
    );
    refused('rig.setOffset', { joint: 0, offest: [1, 2, 3] })('"offest" is not known here; expected characterId');
    refused('character.rename', { characterId: Symbol('c1'), name: 'a' })('found a symbol.');
    refused('takes.endOverlay', {})('Scripts can’t run this');
  });

  it('arguments from scripts that throw when they are read are refused', () => {
    const trap = () => {
      throw new RangeError('A trap.');
    };
    expect(() => run('pose.setDofs', { dofs: new Proxy([], { get: trap }) })).toThrow('reading them failed');
    expect(() => run('pose.setDofs', new Proxy({}, { ownKeys: trap }))).toThrow('reading them failed');
  });

  it('arguments from scripts are copied, so that what a script does to them later changes nothing', () => {
    const position = [1, 2, 3];
    const after = run('character.addCopy', { placement: { position, turn: [0, 0, 0], scale: 1 } });
    position[0] = Number.NaN;
    expect(after.characters[0].placements[1].position).toEqual([1, 2, 3]);
  });

  it('arguments from scripts that are left out are those of the page, but for those whose absence means something', () => {
    const keyed = run('keys.insert', { channels: [1] });
    expect(keyed.characters[0].takes[0].channels[1]).toMatchObject({ times: Float64Array.of(0, 0.5) });
    const keys = [{ channel: 1, indices: [0] }];
    const set = run('keys.set', { keys, value: 7 });
    expect(set.characters[0].takes[0].channels[1]).toMatchObject({
      times: Float64Array.of(0),
      values: Float64Array.of(7),
    });
  });

  it('a result that is not finite is refused, with its place, but for limits', () => {
    const changed = (change: Partial<Character>) =>
      command({
        id: 'test.change',
        args: {},
        label: () => 'Change',
        run: (document) => ({ ...document, characters: [{ ...document.characters[0], ...change }] }),
      });
    const document = documentOf(ARM);
    const result = (change: Partial<Character>) => finiteOnly(changed(change)).run(document, {});
    expect(() => result({ pose: ARM.pose.with(2, Infinity) })).toThrow('characters[0].pose[2] is Infinity');
    expect(() => result({ takes: [{ ...ARM.takes[0], range: [0, Number.NaN] }] })).toThrow('takes[0].range[1] is NaN');
    const free = joint(-1, { limits: Array.from({ length: 3 }, () => ({ min: -Infinity, max: Infinity })) });
    expect(() => result({ skeleton: { name: 'arm', joints: [free] } })).not.toThrow();
  });
});

describe('frames that can not be counted', () => {
  it('frames that can not be counted, of times beyond any frame, are refused', () => {
    const args = { channels: [1], framesPerSecond: 30, tangents: 'linear' };
    expect(() => run('channels.resample', { ...args, from: 1e16, to: 1e16 })).toThrow('too large for frame numbers');
    expect(() => run('channels.resample', { ...args, from: 0, to: 1e308 })).toThrow('too large for frame numbers');
  });
});
