import { describe, expect, it } from 'vitest';
import { saveCharacter } from '../../../src/files/save/saving.ts';
import { shownTake } from '../../../src/model/document.ts';
import type { ParsedFile } from '../../../src/model/files.ts';
import { keysOf, type Take } from '../../../src/model/takes/take.ts';
import { read } from '../../formats/read-in-pieces.ts';
import { animFile, file, skeleton, skelFile, takeOfValues } from '../../helpers/builders.ts';
import { bvhJoint, captureOf } from '../../helpers/bvh.ts';
import { only, open } from './opening.ts';

describe('a take goes to the only character', () => {
  const wave = animFile('wave.anim', takeOfValues('wave', [0, 0, 0, 1, 0, 0, 0, 0, 0]));
  const fox = (path: string) =>
    file(path, {
      kind: 'character',
      characters: [{ skeleton: skeleton(2, 'fox'), skins: [], morphs: [], takes: [], textures: [] }],
    });
  const captured = captureOf({ name: 'cap', joints: [bvhJoint(-1, ['tx', 'ty', 'tz', 'rz', 'rx', 'ry'])] }, [
    [0, 0, 0, 0, 0, 0],
  ]);
  const capture = file('cap.bvh', { kind: 'bvh', captures: [captured] });
  const turn = animFile('turn.anim', takeOfValues('turn', [1, 2, 3, 0.1, 0.2, 0.3]));

  it.each([
    ['a whole character', [fox('fox.glb'), wave]],
    ['the same, after it', [wave, fox('fox.glb')]],
    ['one in another folder', [fox('a/fox.glb'), wave]],
    ['motion capture', [capture, turn]],
  ] as const)('a take goes to the only character there: %s', (_, files) => {
    const together = only(open([...files]).document);
    expect(together.takes.map(({ name }) => name)).toContain(files.includes(wave) ? 'wave' : 'turn');
    const one = open([files[0]]).document;
    const later = only(open([files[1]], one).document);
    expect(later.takes.map(({ name }) => name).toSorted()).toEqual(together.takes.map(({ name }) => name).toSorted());
  });

  it('takes that were opened before their skeleton go to it, several too', () => {
    const takes = open([wave, animFile('run.anim', takeOfValues('run', [0, 0, 0, 2, 0, 0, 0, 0, 0]))]).document;
    expect(takes.characters).toHaveLength(2);
    const { document } = open([fox('fox.glb')], takes);
    expect(
      only(document)
        .takes.map(({ name }) => name)
        .toSorted(),
    ).toEqual(['run', 'wave']);
    expect(only(document).parts?.takes.every(({ file: from }) => from?.kind === 'anim')).toBe(true);
  });

  it('a take of a .skel drives motion capture by the names of its DOFs, and is saved as it was', () => {
    const character = only(open([capture, turn]).document);
    const at = character.takes.findIndex(({ name }) => name === 'turn');
    const values = character.takes[at].channels.map((channel) => keysOf(channel).values[0]);
    // In the file x y z before rx ry rz; in the capture rz rx ry.
    expect(values).toEqual([1, 2, 3, 0.3, 0.1, 0.2]);
    const saved = saveCharacter(character, 'anim').find(({ name }) => name === 'turn.anim');
    const again = read('turn.anim', saved?.text ?? '').value;
    expect(again?.kind === 'anim' && again.take.channels.map((c) => keysOf(c).values[0])).toEqual([
      1, 2, 3, 0.1, 0.2, 0.3,
    ]);
  });

  it('of several, a skeleton that is made for takes has it, or the one that it is named after', () => {
    const takesOf = (...files: ParsedFile[]) =>
      open(files).document.characters.map(({ name, takes }) => [name, takes.length]);
    expect(takesOf(fox('fox.glb'), skelFile('hero.skel', skeleton()), wave)).toEqual([
      ['fox', 0],
      ['hero', 1],
    ]);
    const named = animFile('b_wave.anim', takeOfValues('b_wave', [0, 0, 0, 1, 0, 0, 0, 0, 0]));
    const other = { ...fox('b.glb') };
    expect(takesOf(fox('a.glb'), other, named)).toEqual([
      ['a', 0],
      ['b', 1],
    ]);
  });
});

describe('the take that is shown first', () => {
  const still = takeOfValues('T-Pose', [0, 0, 0, 1, 0, 0]);
  const { channels } = still;
  const moving: Take = {
    ...still,
    name: 'walk',
    channels: channels.map((channel, c) => {
      if (c !== 3 || channel.kind !== 'keys') return channel;
      const flat = { kinds: Uint8Array.of(0, 0), slopes: Float64Array.of(0, 0) };
      return {
        ...channel,
        times: Float64Array.of(0, 1),
        values: Float64Array.of(0, 1),
        tangentsIn: flat,
        tangentsOut: flat,
      };
    }),
  };
  const scene = (...takes: Take[]) =>
    file('fox.glb', {
      kind: 'character',
      characters: [{ skeleton: skeleton(1), skins: [], morphs: [], takes, textures: [] }],
    });
  const shown = (...files: ParsedFile[]) => shownTake(only(open(files).document))?.name;

  it('the first take that moves is shown, of a scene or of several files', () => {
    const empty = { ...still, name: 'Take 001', channels: [] };
    expect(shown(scene(empty, still, moving))).toBe('walk');
    expect(shown(scene(still, empty))).toBe('T-Pose');
    const hero = skelFile('hero.skel', skeleton(1));
    expect(shown(hero, animFile('hero_a.anim', still), animFile('hero_b.anim', moving))).toBe('walk');
  });
});
