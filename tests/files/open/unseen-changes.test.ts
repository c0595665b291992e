import { describe, expect, it } from 'vitest';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { unseenChanges } from '../../../src/files/open/unseen-changes.ts';
import { EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import type { ParsedFile } from '../../../src/model/files.ts';
import { waitingBuffer } from '../../../src/worker/parse-imports.ts';
import {
  animFile,
  character,
  documentOf,
  file,
  morph,
  morphFile,
  skeleton,
  skelFile,
  skin,
  skinFile,
  takeOfValues,
} from '../../helpers/builders.ts';

const walk = takeOfValues('walk', [0, 1, 0, 0, 0, 0, 0, 0, 0]);
const hero = character({ name: 'hero', skeleton: skeleton(), skins: [skin('hero')], shownSkin: 0 });

/** What opening files over a document says. */
function told(files: readonly ParsedFile[], before = documentOf(hero)): string | undefined {
  return unseenChanges(before, openFiles(before, files, [], before.characters[0]?.id).document, files);
}

const DUMP = {
  kind: 'dump' as const,
  dump: {
    name: 'mine',
    blocks: [{ values: Float64Array.of(1), starts: Uint32Array.of(0, 1), lines: Uint32Array.of(1) }],
  },
  source: { name: 'mine.txt', path: 'mine.txt', bytes: 1 },
};

describe('numbers of another program', () => {
  it('change no document, and are given to the caller, who says what became of them', () => {
    const { document, dumps, opened } = openFiles(EMPTY_DOCUMENT, [DUMP]);
    expect([document, dumps, opened]).toEqual([EMPTY_DOCUMENT, [DUMP], []]);
    expect(unseenChanges(EMPTY_DOCUMENT, document, [DUMP])).toBeUndefined();
  });
});

describe('opening files', () => {
  it('says nothing of a character that is new, or that gets its first skin or take', () => {
    expect(told([skelFile('a.skel', skeleton()), animFile('a.anim', walk)], EMPTY_DOCUMENT)).toBeUndefined();
    const bare = documentOf(character({ name: 'hero', skeleton: skeleton() }));
    expect(told([skinFile('hero.skin', skin('hero'))], bare)).toBeUndefined();
    expect(told([animFile('hero.anim', walk)])).toBeUndefined();
  });

  it('names the skin that a lone skin takes the place of in the picture', () => {
    expect(told([skinFile('hero_red.skin', skin('hero_red'))])).toBe(
      'hero now shows the skin hero_red; hero stays in the outliner.',
    );
    expect(told([skinFile('hero.skin', skin('hero'))])).toBe('The skin hero of hero was replaced.');
  });

  it('says where a morph, which changes nothing at weight 0, can be set', () => {
    expect(told([morphFile('hero_smile.morph', morph('hero_smile'))])).toBe(
      'hero has the new morph hero_smile; set its weight in the inspector.',
    );
    const two = ['hero_a', 'hero_b'].map((name) => morphFile(`${name}.morph`, morph(name)));
    expect(told(two)).toBe('hero has 2 new morphs; set their weights in the inspector.');
  });

  it('names the take that a lone animation plays instead of', () => {
    const before = documentOf({ ...hero, takes: [walk], shownTake: 0 });
    expect(told([animFile('run.anim', { ...walk, name: 'run' })], before)).toBe(
      'hero now plays the take run; walk stays in Takes.',
    );
    expect(told([animFile('walk.anim', takeOfValues('walk', [1]))], before)).toBe(
      'The take walk of hero was replaced.',
    );
  });

  it('says what a file waits for', () => {
    const picture = file('wood.png', {
      kind: 'texture',
      texture: { name: 'wood.png', mime: 'image/png', bytes: new Uint8Array(1) },
    });
    expect(told([picture])).toBe('wood.png is kept for a matching file. No open skin uses it as a texture.');
  });

  it('counts what does not fit into two sentences', () => {
    const before = documentOf({ ...hero, takes: [walk], shownTake: 0 });
    const files = [
      skinFile('hero_red.skin', skin('hero_red')),
      morphFile('hero_smile.morph', morph('hero_smile')),
      animFile('hero_run.anim', { ...walk, name: 'hero_run' }),
    ];
    expect(told(files, before)).toBe(
      'hero now shows the skin hero_red; hero stays in the outliner. ' +
        'hero has the new morph hero_smile; set its weight in the inspector. 1 more change.',
    );
  });

  it('says that nothing has changed where nothing has', () => {
    const before = documentOf(hero);
    expect(unseenChanges(before, before, [morphFile('a.morph', morph('a'))])).toBe('Nothing has changed.');
    expect(unseenChanges(before, before, [])).toBeUndefined();
  });
});

it('a buffer that no glTF file names yet is said to be kept, though it is no file of the document', () => {
  const waiting = waitingBuffer({ name: 'tri.bin', path: 'tri.bin', bytes: 8 });
  expect(unseenChanges(EMPTY_DOCUMENT, EMPTY_DOCUMENT, [], [waiting])).toBe(
    'tri.bin is kept for a matching file. No open .gltf file uses it as a buffer. Drop that file too.',
  );
});
