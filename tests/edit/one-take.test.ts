import { describe, expect, it } from 'vitest';
import { createTake, duplicateTake, removeTake, renameTake, setTakeRange } from '../../src/edit/commands/take.ts';
import { rangeOfKeys } from '../../src/edit/takes.ts';
import { restChannel } from '../../src/model/takes/take.ts';
import { character, documentOf, takeOfValues, takesFrom } from '../helpers/builders.ts';

const walk = takeOfValues('walk', [1, 2], [0, 1]);
const run = takeOfValues('run', [3], [0, 2]);
const unkeyed = { timeSeconds: 0, dofs: [0], values: [1] };
const two = documentOf(character({ takes: [walk, run], shownTake: 0, unkeyed }));
const none = documentOf(character({ pose: [0, 0, 0, 0.5, 0, 0, 0, 0, 0] }));
const only = (document: typeof two) => document.characters[0];
const names = (document: typeof two) => only(document).takes.map((c) => c.name);

describe('take.setRange', () => {
  it('sets the playback range of the shown take, or of another', () => {
    const next = setTakeRange.run(two, { characterId: 'c1', range: [-1, 4] });
    expect(only(next).takes.map((c) => c.range)).toEqual([
      [-1, 4],
      [0, 2],
    ]);
    expect(only(next).takes[0].channels).toBe(walk.channels);
    expect(only(setTakeRange.run(two, { characterId: 'c1', take: 1, range: [1, 1] })).takes[1].range).toEqual([1, 1]);
    expect(setTakeRange.label(two, { characterId: 'c1', range: [0, 1] })).toBe('Set range of walk');
  });

  it('refuses a reversed range, and a take that does not exist', () => {
    expect(() => setTakeRange.run(two, { characterId: 'c1', range: [1, 0] })).toThrow('must start before it ends');
    expect(() => setTakeRange.run(two, { characterId: 'c1', take: 2, range: [0, 1] })).toThrow('no take number 2');
    expect(() => setTakeRange.run(none, { characterId: 'c1', range: [0, 1] })).toThrow('has no current take');
  });

  it('returns the same document if the range does not change', () => {
    expect(setTakeRange.run(two, { characterId: 'c1', range: [0, 1] })).toBe(two);
  });
});

describe('take.create', () => {
  it('creates a take at rest in the pose, and shows it', () => {
    const made = only(createTake.run(none, { characterId: 'c1', range: [0, 3] }));
    expect(made.shownTake).toBe(0);
    expect(made.takes[0]).toMatchObject({ name: 'hero_anim', range: [0, 3] });
    expect(made.takes[0].channels).toEqual(made.pose.map((value) => restChannel(value)));
  });

  it('numbers a name that belongs to the file of a renamed take', () => {
    const [own] = two.characters;
    const document = { ...two, characters: [{ ...own, parts: takesFrom('old.anim') }] };
    const made = createTake.run(document, { characterId: 'c1', range: [0, 1], name: 'old' });
    expect(names(made)).toEqual(['walk', 'run', 'old_2']);
  });

  it('numbers a name that is in use, ignoring case', () => {
    let document = createTake.run(two, { characterId: 'c1', range: [0, 1], name: 'Walk' });
    document = createTake.run(document, { characterId: 'c1', range: [0, 1], name: 'walk' });
    expect(names(document)).toEqual(['walk', 'run', 'Walk_2', 'walk_3']);
    expect('unkeyed' in only(document)).toBe(false);
  });

  it('refuses if there is no skeleton', () => {
    const { skeleton: _none, ...skin } = character();
    expect(() => createTake.run(documentOf(skin), { characterId: 'c1', range: [0, 1] })).toThrow('no skeleton');
  });
});

describe('take.rename', () => {
  it('gives a name that no other take of the character has', () => {
    expect(names(renameTake.run(two, { characterId: 'c1', name: ' stroll ' }))).toEqual(['stroll', 'run']);
    expect(names(renameTake.run(two, { characterId: 'c1', name: 'Walk' }))).toEqual(['Walk', 'run']);
    expect(() => renameTake.run(two, { characterId: 'c1', name: 'RUN' })).toThrow('already has a take "run"');
    expect(() => renameTake.run(two, { characterId: 'c1', name: ' ' })).toThrow('text');
    expect(renameTake.run(two, { characterId: 'c1', name: 'walk' })).toBe(two);
  });

  it('refuses the name of another take’s file, which saving would write over', () => {
    const [own] = two.characters;
    const file = (name: string) => ({ name, path: `in/${name}`, bytes: 1 });
    const rename = (document: typeof two, take: number, name: string) =>
      renameTake.run(document, { characterId: 'c1', take, name });
    const parts = takesFrom('in/walk.anim', 'in/Run.anim');
    const opened = { ...two, characters: [{ ...own, sources: [file('walk.anim'), file('Run.anim')], parts }] };
    const strolling = rename(opened, 0, 'stroll');
    expect(() => rename(strolling, 1, 'Walk')).toThrow('walk.anim belongs to another take');
    // Its own name it can have back, in any case.
    expect(names(rename(strolling, 0, 'walk'))).toEqual(['walk', 'run']);
    expect(names(rename(opened, 1, 'RUN'))).toEqual(['walk', 'RUN']);
    // Beside a take that has no file it is still its own.
    const made = createTake.run(strolling, { characterId: 'c1', range: [0, 1], name: 'new' });
    expect(() => rename(made, 2, 'walk')).toThrow('belongs to another take');
    expect(names(rename(made, 0, 'walk'))).toEqual(['walk', 'run', 'new']);
  });
});

describe('take.duplicate', () => {
  it('shows a copy that shares its channels', () => {
    const copied = only(duplicateTake.run(two, { characterId: 'c1' }));
    expect(copied.takes.map((c) => c.name)).toEqual(['walk', 'run', 'walk_2']);
    expect(copied.shownTake).toBe(2);
    expect(copied.takes[2].channels).toBe(walk.channels);
    expect('unkeyed' in copied).toBe(false);
  });
});

describe('take.remove', () => {
  const shown = (shownTake: number, take?: number) => {
    const document = documentOf({ ...only(two), shownTake });
    const left = only(removeTake.run(document, { characterId: 'c1', take }));
    return [left.takes.map((c) => c.name), left.shownTake, 'unkeyed' in left];
  };

  it('take.remove keeps showing the take that was shown, or its neighbour', () => {
    expect(shown(0)).toEqual([['run'], 0, false]);
    expect(shown(1)).toEqual([['walk'], 0, false]);
    expect(shown(1, 0)).toEqual([['run'], 0, true]);
    expect(shown(0, 1)).toEqual([['walk'], 0, true]);
    expect(shown(-1, 1)).toEqual([['walk'], -1, true]);
  });

  it('shows none if none is left', () => {
    const one = documentOf(character({ takes: [walk], shownTake: 0 }));
    expect(only(removeTake.run(one, { characterId: 'c1' })).shownTake).toBe(-1);
  });
});

describe('rangeOfKeys', () => {
  it('extends from the first key to the last, and is undefined without keys', () => {
    const at = (time: number) => ({ ...walk.channels[0], times: Float64Array.of(time) });
    expect(rangeOfKeys({ ...walk, channels: [at(2), restChannel(1), at(-1)] })).toEqual([-1, 2]);
    expect(rangeOfKeys({ ...walk, channels: [restChannel()] })).toBeUndefined();
  });
});
