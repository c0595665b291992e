/** Files of numpy's arrays against separately computed positions and rotations. */
import { expect, it } from 'vitest';
import { eachWorld, labCases } from '../../helpers/lab.ts';
import { characterIn, readArrays } from '../../helpers/numpy.ts';
import { describeShared, sharedBytes } from '../../helpers/shared.ts';

describeShared('files of arrays', () => {
  const { cases, malformed } = labCases();
  const arrays = cases.filter(({ files }) => files.every((file) => /\.np[yz]$/.test(file)));

  it.each(arrays)('$name: joints, frames and rate are those of the file', async ({ files: [file], ...given }) => {
    const { character, take, diagnostics } = await characterIn(file, sharedBytes(`data/lab/${file}`));
    const { joints } = character.skeleton;
    const names = joints.map(({ name }) => name);
    expect([...names].sort()).toEqual([...given.joints].sort());
    const parents = joints.map(({ parent }) => names[parent] ?? '');
    const wanted = new Map(given.joints.map((name, j) => [name, given.joints[given.parents?.[j] ?? -1] ?? '']));
    if (given.parents) expect(parents).toEqual(names.map((name) => wanted.get(name)));
    else expect(names).toEqual(given.joints);
    expect(take.samples?.frameCount).toBe(given.frames);
    expect(1 / (take.samples?.frameSeconds ?? 0)).toBeCloseTo(given.fps, 9);
    if (given.up) expect(character.space?.space.up).toBe(given.up);
    for (const word of given.says ?? []) {
      expect(diagnostics.map(({ message }) => message).join(' ')).toMatch(new RegExp(word));
    }
  });

  it.each(arrays.filter(({ kind }) => kind === 'take'))('$name: joints are where they should be', async (given) => {
    const [file] = given.files;
    const { character, take } = await characterIn(file, sharedBytes(`data/lab/${file}`));
    const at = given.joints.map((name) => character.skeleton.joints.findIndex((joint) => joint.name === name));
    const off: number[] = [];
    eachWorld(character.skeleton, take, (world, _dofs, frame) => {
      const wanted = given.at[frame];
      wanted?.positions?.forEach((position, j) => {
        off.push(...position.map((v, k) => Math.abs(v - world[16 * at[j] + 12 + k]) / given.size));
      });
      wanted?.rotations?.forEach((rows, j) => {
        off.push(...rows.map((v, k) => Math.abs(v - world[16 * at[j] + 4 * (k % 3) + Math.floor(k / 3)])));
      });
    });
    expect(off.length).toBeGreaterThan(100);
    expect(Math.max(...off)).toBeLessThan(given.tolerance ?? 1e-6);
  });

  it.each(arrays.filter(({ kind }) => kind === 'fitted'))(
    '$name: bones fit the positions as well as those of the reference',
    async (given) => {
      const [file] = given.files;
      const { character, take, diagnostics } = await characterIn(file, sharedBytes(`data/lab/${file}`));
      const off: number[] = [];
      eachWorld(character.skeleton, take, (world, _dofs, frame) => {
        given.at[frame]?.positions?.forEach((position, j) => {
          off.push(Math.hypot(...position.map((v, k) => v - world[16 * j + 12 + k])));
        });
      });
      const { mean_error: mean = 0, max_error: largest = 0 } = given;
      // Of all frames; the reference has positions of some.
      const told = diagnostics.find(({ code }) => code === 'bones-fitted')?.message ?? '';
      expect(Number(/are (\S+) off/.exec(told)?.[1])).toBeLessThan(1.25 * mean);
      expect(Math.max(...off)).toBeLessThan(1.5 * largest);
    },
  );

  it.each(malformed.filter(({ file }) => /\.np[yz]$/.test(file)))(
    'the broken file $file brings an error in words',
    async ({ file, word }) => {
      const { value, diagnostics } = await readArrays(file, sharedBytes(`data/lab/${file}`));
      expect(value).toBeUndefined();
      const [error] = diagnostics.filter(({ severity }) => severity === 'error');
      expect(error.message).toMatch(/\.$/);
      expect(error.message).toContain(word);
    },
  );
});
