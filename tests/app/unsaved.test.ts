import { describe, expect, it } from 'vitest';
import { titleFor } from '../../src/app/leaving.ts';
import { Unsaved } from '../../src/app/unsaved.ts';
import { renameCharacter } from '../../src/edit/commands/characters.ts';
import { setDofs } from '../../src/edit/commands/pose.ts';
import { keepPose, renamePose } from '../../src/edit/commands/poses.ts';
import { poseByNames } from '../../src/edit/pose/by-names.ts';
import { Store } from '../../src/edit/store.ts';
import { openFiles } from '../../src/files/open/open-files.ts';
import { partsOf } from '../../src/model/character-parts.ts';
import type { Character } from '../../src/model/document.ts';
import type { ParsedFile } from '../../src/model/files.ts';
import { keysOf, type Take } from '../../src/model/takes/take.ts';
import { parse } from '../../src/worker/parse.ts';
import { ODD_AMC, ODD_ASF } from '../helpers/acclaim.ts';
import {
  animFile,
  file,
  morph,
  morphFile,
  skeleton,
  skelFile,
  skin,
  skinFile,
  takeOfValues,
} from '../helpers/builders.ts';

/** A page on which files were opened as the opener does. */
function opened(...files: ParsedFile[]) {
  const store = new Store();
  const unsaved = new Unsaved(store);
  const open = (...more: ParsedFile[]) => {
    const result = openFiles(store.document, more, [], store.selection.characterId);
    store.replace(result.label, result.document);
    return unsaved.opened(more);
  };
  open(...files);
  const names = () => unsaved.current().map(({ name }) => name);
  const change = (edit: (character: Character) => Character, index = 0) =>
    store.replace('Change', {
      document: {
        ...store.document,
        characters: store.document.characters.map((c, i) => (i === index ? edit(c) : c)),
      },
    });
  const setDof = (dof: number, value: number) =>
    store.apply(setDofs, { characterId: 'c1', dofs: [{ index: dof, value }], timeSeconds: 0 });
  return { store, unsaved, open, names, change, setDof };
}

const hero = () => [
  skelFile('hero.skel', skeleton()),
  skinFile('hero.skin', skin()),
  morphFile('hero_smile.morph', morph('hero_smile')),
];
const moved = (own: Take, by = 1): Take => ({
  ...own,
  channels: own.channels.map((c, i) => (i === 0 ? { ...c, values: keysOf(c).values.map((v) => v + by) } : c)),
});
const withTake = (edit: (take: Take) => Take) => (c: Character) => ({ ...c, takes: c.takes.map(edit) });

describe('what is unsaved', () => {
  it.each([
    ['skeleton first', ['odd.asf', 'odd.amc']],
    ['motion first', ['odd.amc', 'odd.asf']],
  ])('a skeleton of Acclaim and its motion are saved as they are opened: %s', async (_, names) => {
    const given = names.map((path) => ({ path, blob: new Blob([path.endsWith('asf') ? ODD_ASF : ODD_AMC]) }));
    const { files } = await parse({ files: given }, () => undefined);
    const page = opened(...files);
    expect(page.store.document.characters.map(({ takes }) => takes.length)).toEqual([1]);
    expect(page.names()).toEqual([]);
  });

  it('nothing that was just opened is unsaved', () => {
    expect(opened(...hero(), animFile('hero_walk.anim', takeOfValues('hero_walk', [1]))).names()).toEqual([]);
  });

  it('an edited take is unsaved until undone', () => {
    const { store, names, change } = opened(...hero(), animFile('hero_walk.anim', takeOfValues('hero_walk', [1])));
    change(withTake((c) => moved(c)));
    expect(names()).toEqual(['hero_walk.anim']);
    store.undo();
    expect(names()).toEqual([]);
    store.redo();
    expect(names()).toEqual(['hero_walk.anim']);
  });

  it('a take changed back and forth is unsaved until undone', () => {
    const { store, names, change } = opened(...hero(), animFile('hero_walk.anim', takeOfValues('hero_walk', [1])));
    change(withTake((c) => moved(c)));
    change(withTake((c) => moved(c, -1)));
    expect(names()).toEqual(['hero_walk.anim']);
    store.undo();
    store.undo();
    expect(names()).toEqual([]);
  });

  it('nothing is unsaved after undoing to the saved state', () => {
    const { store, unsaved, names, change } = opened(
      ...hero(),
      animFile('hero_walk.anim', takeOfValues('hero_walk', [1])),
    );
    const save = () => {
      for (const part of partsOf(store.document.characters[0])) if (part.kind === 'anim') unsaved.written(part);
    };
    change(withTake((c) => moved(c)));
    save();
    expect(names()).toEqual([]);
    store.undo();
    change(withTake((c) => moved(c, 2)));
    expect(names()).toEqual(['hero_walk.anim']);
  });

  it('a take created here, and a renamed one, are unsaved', () => {
    const { names, change } = opened(...hero(), animFile('hero_walk.anim', takeOfValues('hero_walk', [1])));
    change((c) => ({ ...c, takes: [...c.takes, takeOfValues('new', [0])] }));
    expect(names()).toEqual(['new.anim']);
    change(withTake((c) => ({ ...c, name: `${c.name}2` })));
    expect(names()).toEqual(['hero_walk2.anim', 'new2.anim']);
  });

  it('reports when an unsaved part is replaced by a file of its name', () => {
    const walk = () => animFile('hero_walk.anim', takeOfValues('hero_walk', [1]));
    const { open, names, change } = opened(...hero(), walk());
    expect(open(walk())).toEqual([]);
    change(withTake((c) => moved(c)));
    expect(names()).toEqual(['hero_walk.anim']);
    expect(open(skinFile('hero.skin', skin()))).toEqual([]);
    expect(open(walk())).toEqual(['hero_walk.anim']);
    expect(names()).toEqual([]);
  });

  it('a skeleton is unsaved when its limits or file pose change', () => {
    const { store, names, change, setDof } = opened(...hero());
    setDof(4, 0.5);
    expect(names()).toEqual(['hero.skel']);
    setDof(4, 0);
    expect(names()).toEqual([]);
    const { joints } = skeleton();
    const limited = joints.map((j) => ({ ...j, limits: [{ min: 0, max: 1 }, ...j.limits.slice(1)] }));
    change((c) => ({ ...c, skeleton: { ...skeleton(), joints: limited } }));
    expect(names()).toEqual(['hero.skel']);
    store.undo();
    expect(names()).toEqual([]);
  });

  it('a skeleton is not unsaved for its root position, a morph, or a pose that a take overrides', () => {
    const { names, change, setDof } = opened(...hero());
    setDof(1, 3);
    setDof(9, 1);
    expect(names()).toEqual([]);
    setDof(4, 0.5);
    change((c) => ({ ...c, takes: [takeOfValues('hero_walk', new Array(10).fill(0))], shownTake: 0 }));
    expect(names()).toEqual(['hero_walk.anim']);
  });

  it('nothing is unsaved for a name, a placement, or another take shown', () => {
    const files = [
      ...hero(),
      animFile('hero_a.anim', takeOfValues('hero_a', [1])),
      animFile('hero_b.anim', takeOfValues('hero_b', [2])),
    ];
    const { store, names, change } = opened(...files);
    store.apply(renameCharacter, { characterId: 'c1', name: 'someone' });
    change((c) => ({ ...c, shownTake: 1, timeOffsetSeconds: 2 }));
    expect(names()).toEqual([]);
  });

  it('the pose library is unsaved while it has no file, or differs from it', () => {
    const { store, open, names, change } = opened(...hero());
    store.apply(keepPose, { characterId: 'c1', timeSeconds: 0 });
    expect(names()).toEqual(['hero.pose']);
    store.undo();
    expect(names()).toEqual([]);
    const [sit, stand] = ['sit', 'stand'].map((name, n) =>
      poseByNames(store.document.characters[0], { name, values: [n] }),
    );
    open(file('kept.pose', { kind: 'pose', poses: [sit, stand] }));
    expect(names()).toEqual([]);
    expect(store.document.characters[0].sources.map(({ name }) => name)).toContain('kept.pose');
    store.apply(renamePose, { characterId: 'c1', pose: 0, name: 'squat' });
    expect(names()).toEqual(['kept.pose']);
    store.undo();
    expect(names()).toEqual([]);
    // The file also contains the names of joints, but nothing else of the skeleton.
    change((c) => ({ ...c, skeleton: { ...skeleton(), name: 'other' } }));
    expect(names()).toEqual(['hero.skel']);
    const joints = skeleton().joints.map((one, j) => (j === 1 ? { ...one, name: 'knee' } : one));
    change((c) => ({ ...c, skeleton: { ...skeleton(), joints } }));
    expect(names()).toEqual(['hero.skel', 'kept.pose']);
  });

  it('the pose library is unsaved after a second file of poses was added', () => {
    const { store, open, names } = opened(...hero());
    const poseFile = (path: string, name: string) =>
      file(path, { kind: 'pose', poses: [poseByNames(store.document.characters[0], { name, values: [1] })] });
    open(poseFile('a.pose', 'sit'));
    open(poseFile('b.pose', 'stand'));
    expect(names()).toEqual(['hero.pose']);
  });

  it('the pose library is unsaved even if equal to a file of another character', () => {
    const { store, open, names } = opened(
      skelFile('hero.skel', skeleton()),
      skelFile('twin.skel', skeleton(2, 'twin')),
    );
    store.apply(keepPose, { characterId: 'c2', name: 'sit', timeSeconds: 0 });
    store.select({ characterId: 'c1' });
    const values = store.document.characters[1].poses?.[0].values ?? [];
    open(
      file('sit.pose', {
        kind: 'pose',
        poses: [poseByNames(store.document.characters[0], { name: 'sit', values })],
      }),
    );
    expect(store.document.characters.map(({ poses }) => poses?.length)).toEqual([1, 1]);
    expect(names()).toEqual(['twin.pose']);
  });

  it('unsaved parts have character, kind and index', () => {
    const other = skelFile('b/other.skel', skeleton(2, 'other'));
    const { unsaved, change } = opened(skelFile('a/hero.skel', skeleton()), other);
    change((c) => ({ ...c, takes: [takeOfValues('x', [0])] }), 1);
    expect(unsaved.current()).toEqual([{ characterId: 'c2', kind: 'anim', index: 0, name: 'x.anim' }]);
  });

  it('tells two takes of one name apart', () => {
    const { names, change } = opened(
      skelFile('hero.skel', skeleton()),
      animFile('a/walk.anim', takeOfValues('walk', [1])),
      animFile('b/walk.anim', takeOfValues('walk', [2])),
    );
    expect(names()).toEqual([]);
    change((c) => ({ ...c, takes: [c.takes[0], moved(c.takes[1])] }));
    expect(names()).toEqual(['walk.anim']);
  });

  it('nothing is unsaved of a file that waits for its character', () => {
    const { names, open } = opened(morphFile('hero_smile.morph', morph('hero_smile')));
    open(skelFile('hero.skel', skeleton()), skinFile('hero.skin', skin()));
    expect(names()).toEqual([]);
  });

  it('opening a file decides anew what is unsaved, and so does undoing it', () => {
    const { store, names, change, open } = opened(
      ...hero(),
      animFile('hero_walk.anim', takeOfValues('hero_walk', [1])),
    );
    change(withTake((c) => moved(c)));
    open(animFile('hero_walk.anim', takeOfValues('hero_walk', [7])));
    expect(names()).toEqual([]);
    store.undo();
    expect(names()).toEqual(['hero_walk.anim']);
  });
});

describe('saving', () => {
  it('saving makes the written state the saved one', () => {
    const { store, unsaved, names, change } = opened(
      ...hero(),
      animFile('hero_walk.anim', takeOfValues('hero_walk', [1])),
    );
    change(withTake((c) => moved(c)));
    const [character] = store.document.characters;
    for (const part of partsOf(character)) if (part.kind === 'anim') unsaved.written(part);
    expect(names()).toEqual([]);
    store.undo();
    expect(names()).toEqual(['hero_walk.anim']);
  });

  it('notifies listeners once per change, and not if nothing changes', async () => {
    const { unsaved, change, setDof } = opened(...hero(), animFile('hero_walk.anim', takeOfValues('hero_walk', [1])));
    await Promise.resolve();
    const heard: string[][] = [];
    unsaved.parts.subscribe((parts) => heard.push(parts.map(({ name }) => name)));
    change(withTake((c) => moved(c)));
    change(withTake((c) => moved(c)));
    await Promise.resolve();
    setDof(1, 2);
    await Promise.resolve();
    expect(heard).toEqual([['hero_walk.anim']]);
  });

  it('saving can be taken down and given back', () => {
    const first = opened(...hero(), animFile('hero_walk.anim', takeOfValues('hero_walk', [1])));
    first.change(withTake((c) => moved(c)));
    first.setDof(4, 0.5);
    const store = new Store();
    store.adopt(undefined, { document: structuredClone(first.store.document), selection: {} });
    const again = new Unsaved(store);
    expect(again.current()).toHaveLength(4);
    again.restore(structuredClone(first.unsaved.snapshot(first.store.document)));
    expect(again.current()).toEqual(first.unsaved.current());
    expect(again.current().map(({ name }) => name)).toEqual(['hero.skel', 'hero_walk.anim']);
  });
});

describe('the title', () => {
  it('names one file, and counts several', () => {
    expect(titleFor('Marrow', [])).toBe('Marrow');
    expect(titleFor('Marrow', [{ name: 'wasp_walk.anim' }])).toBe('• wasp_walk.anim – Marrow');
    expect(titleFor('Marrow', [{ name: 'a' }, { name: 'b' }])).toBe('• 2 files – Marrow');
  });
});
