/** Real and made files of Acclaim against separately computed positions and rotations. */
import { expect, it } from 'vitest';
import { endSitePositions } from '../../../src/evaluate/end-sites.ts';
import { metresPerUnit } from '../../../src/evaluate/space/metres.ts';
import { readAmcText, readAsfText } from '../../helpers/acclaim.ts';
import { eachWorld, labCases } from '../../helpers/lab.ts';
import { describeShared, sharedBytes } from '../../helpers/shared.ts';

describeShared('files of Acclaim', () => {
  const { cases, malformed } = labCases();
  const acclaim = cases.filter(({ files }) => files.some((file) => file.endsWith('.amc')));

  it.each(acclaim)('the take $name has its joints where the reference has them', async (given) => {
    const [skeletonName, name] = given.files;
    const { value } = await readAmcText(sharedBytes(`data/lab/${name}`), sharedBytes(`data/lab/${skeletonName}`), [
      name,
      skeletonName,
    ]);
    if (!value) throw new Error('It was not read.');
    const { skeleton, take, space } = value;
    expect(skeleton.joints.map((joint) => joint.name)).toEqual(given.joints);
    expect(skeleton.joints.map(({ parent }) => parent)).toEqual(given.parents);
    const { samples } = take;
    if (!samples) throw new Error('It has no samples.');
    expect(samples.frameCount).toBe(given.frames);
    expect(1 / samples.frameSeconds).toBeCloseTo(given.fps, 9);
    if (given.metres && space) expect(metresPerUnit(space.space)).toBeCloseTo(given.metres, 9);

    const off: number[] = [0];
    eachWorld(skeleton, take, (world, dofs, frame) => {
      const wanted = given.at[frame];
      wanted?.positions?.forEach((at, j) => {
        off.push(...at.map((v, k) => Math.abs(v - world[16 * j + 12 + k]) / given.size));
      });
      wanted?.rotations?.forEach((rows, j) => {
        off.push(...rows.map((v, k) => Math.abs(v - world[16 * j + 4 * (k % 3) + Math.floor(k / 3)])));
      });
      const ends = endSitePositions(skeleton, world, dofs);
      given.ends?.[frame]?.forEach((at, e) => {
        off.push(...at.map((v, k) => Math.abs(v - ends[e].position[k]) / given.size));
      });
    });
    expect(off.length).toBeGreaterThan(100);
    expect(Math.max(...off)).toBeLessThan(given.tolerance ?? 1e-6);
  });

  const broken = malformed.filter(({ file }) => /\.a[sm][fc]$/.test(file));

  it.each(broken)(
    'the broken file $file brings an error in words, at its line',
    async ({ file, with: others, word }) => {
      const bytes = sharedBytes(`data/lab/${file}`);
      const [skeleton] = others;
      const { value, diagnostics } = skeleton
        ? await readAmcText(bytes, sharedBytes(`data/lab/${skeleton}`), [file, skeleton])
        : await readAsfText(bytes, file);
      expect(value).toBeUndefined();
      const [error] = diagnostics.filter(({ severity }) => severity === 'error');
      expect(error.message).toContain(word);
      expect(error.line).toBeGreaterThan(0);
      expect(error.column).toBeGreaterThan(0);
    },
  );
});
