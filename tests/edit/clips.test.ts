import { describe, expect, it } from 'vitest';
import { createClip, duplicateClip, removeClip, renameClip, setClipRange } from '../../src/edit/commands/clips.ts';
import { rangeOfKeys } from '../../src/edit/takes.ts';
import { restChannel } from '../../src/model/takes/clip.ts';
import { character, clipsFrom, documentOf, takeOfValues } from '../helpers/builders.ts';

const walk = takeOfValues('walk', [1, 2], [0, 1]);
const run = takeOfValues('run', [3], [0, 2]);
const unkeyed = { timeSeconds: 0, dofs: [0], values: [1] };
const two = documentOf(character({ clips: [walk, run], shownClip: 0, unkeyed }));
const none = documentOf(character({ pose: [0, 0, 0, 0.5, 0, 0, 0, 0, 0] }));
const only = (document: typeof two) => document.characters[0];
const names = (document: typeof two) => only(document).clips.map((c) => c.name);

describe('clip.setRange', () => {
  it('sets the playback range of the shown take, or of another', () => {
    const next = setClipRange.run(two, { characterId: 'c1', range: [-1, 4] });
    expect(only(next).clips.map((c) => c.range)).toEqual([
      [-1, 4],
      [0, 2],
    ]);
    expect(only(next).clips[0].channels).toBe(walk.channels);
    expect(only(setClipRange.run(two, { characterId: 'c1', clip: 1, range: [1, 1] })).clips[1].range).toEqual([1, 1]);
    expect(setClipRange.label(two, { characterId: 'c1', range: [0, 1] })).toBe('Set range of walk');
  });

  it('refuses a reversed range, and a take that does not exist', () => {
    expect(() => setClipRange.run(two, { characterId: 'c1', range: [1, 0] })).toThrow('must start before it ends');
    expect(() => setClipRange.run(two, { characterId: 'c1', clip: 2, range: [0, 1] })).toThrow('no take number 2');
    expect(() => setClipRange.run(none, { characterId: 'c1', range: [0, 1] })).toThrow('has no current take');
  });

  it('returns the same document if the range does not change', () => {
    expect(setClipRange.run(two, { characterId: 'c1', range: [0, 1] })).toBe(two);
  });
});

describe('clip.create', () => {
  it('creates a take at rest in the pose, and shows it', () => {
    const made = only(createClip.run(none, { characterId: 'c1', range: [0, 3] }));
    expect(made.shownClip).toBe(0);
    expect(made.clips[0]).toMatchObject({ name: 'hero_anim', range: [0, 3] });
    expect(made.clips[0].channels).toEqual(made.pose.map((value) => restChannel(value)));
  });

  it('numbers a name that belongs to the file of a renamed take', () => {
    const [own] = two.characters;
    const document = { ...two, characters: [{ ...own, parts: clipsFrom('old.anim') }] };
    const made = createClip.run(document, { characterId: 'c1', range: [0, 1], name: 'old' });
    expect(names(made)).toEqual(['walk', 'run', 'old_2']);
  });

  it('numbers a name that is in use, ignoring case', () => {
    let document = createClip.run(two, { characterId: 'c1', range: [0, 1], name: 'Walk' });
    document = createClip.run(document, { characterId: 'c1', range: [0, 1], name: 'walk' });
    expect(names(document)).toEqual(['walk', 'run', 'Walk_2', 'walk_3']);
    expect('unkeyed' in only(document)).toBe(false);
  });

  it('refuses if there is no skeleton', () => {
    const { skeleton: _none, ...skin } = character();
    expect(() => createClip.run(documentOf(skin), { characterId: 'c1', range: [0, 1] })).toThrow('no skeleton');
  });
});

describe('clip.rename', () => {
  it('gives a name that no other take of the character has', () => {
    expect(names(renameClip.run(two, { characterId: 'c1', name: ' stroll ' }))).toEqual(['stroll', 'run']);
    expect(names(renameClip.run(two, { characterId: 'c1', name: 'Walk' }))).toEqual(['Walk', 'run']);
    expect(() => renameClip.run(two, { characterId: 'c1', name: 'RUN' })).toThrow('already has a take "run"');
    expect(() => renameClip.run(two, { characterId: 'c1', name: ' ' })).toThrow('text');
    expect(renameClip.run(two, { characterId: 'c1', name: 'walk' })).toBe(two);
  });

  it('refuses the name of another take’s file, which saving would write over', () => {
    const [own] = two.characters;
    const file = (name: string) => ({ name, path: `in/${name}`, bytes: 1 });
    const rename = (document: typeof two, clip: number, name: string) =>
      renameClip.run(document, { characterId: 'c1', clip, name });
    const parts = clipsFrom('in/walk.anim', 'in/Run.anim');
    const opened = { ...two, characters: [{ ...own, sources: [file('walk.anim'), file('Run.anim')], parts }] };
    const strolling = rename(opened, 0, 'stroll');
    expect(() => rename(strolling, 1, 'Walk')).toThrow('walk.anim belongs to another take');
    // Its own name it can have back, in any case.
    expect(names(rename(strolling, 0, 'walk'))).toEqual(['walk', 'run']);
    expect(names(rename(opened, 1, 'RUN'))).toEqual(['walk', 'RUN']);
    // Beside a take that has no file it is still its own.
    const made = createClip.run(strolling, { characterId: 'c1', range: [0, 1], name: 'new' });
    expect(() => rename(made, 2, 'walk')).toThrow('belongs to another take');
    expect(names(rename(made, 0, 'walk'))).toEqual(['walk', 'run', 'new']);
  });
});

describe('clip.duplicate', () => {
  it('shows a copy that shares its channels', () => {
    const copied = only(duplicateClip.run(two, { characterId: 'c1' }));
    expect(copied.clips.map((c) => c.name)).toEqual(['walk', 'run', 'walk_2']);
    expect(copied.shownClip).toBe(2);
    expect(copied.clips[2].channels).toBe(walk.channels);
    expect('unkeyed' in copied).toBe(false);
  });
});

describe('clip.remove', () => {
  const shown = (shownClip: number, clip?: number) => {
    const document = documentOf({ ...only(two), shownClip });
    const left = only(removeClip.run(document, { characterId: 'c1', clip }));
    return [left.clips.map((c) => c.name), left.shownClip, 'unkeyed' in left];
  };

  it('clip.remove keeps showing the take that was shown, or its neighbour', () => {
    expect(shown(0)).toEqual([['run'], 0, false]);
    expect(shown(1)).toEqual([['walk'], 0, false]);
    expect(shown(1, 0)).toEqual([['run'], 0, true]);
    expect(shown(0, 1)).toEqual([['walk'], 0, true]);
    expect(shown(-1, 1)).toEqual([['walk'], -1, true]);
  });

  it('shows none if none is left', () => {
    const one = documentOf(character({ clips: [walk], shownClip: 0 }));
    expect(only(removeClip.run(one, { characterId: 'c1' })).shownClip).toBe(-1);
  });
});

describe('rangeOfKeys', () => {
  it('extends from the first key to the last, and is undefined without keys', () => {
    const at = (time: number) => ({ ...walk.channels[0], times: Float64Array.of(time) });
    expect(rangeOfKeys({ ...walk, channels: [at(2), restChannel(1), at(-1)] })).toEqual([-1, 2]);
    expect(rangeOfKeys({ ...walk, channels: [restChannel()] })).toBeUndefined();
  });
});
