/** Real files as GLB: what three.js shows of them, and what the Khronos validator says. */
import { readdirSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { loadFiles } from '../../../src/cli/load.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { type Character, EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import { complaintsOf, glbOf, inThree } from '../../helpers/glb.ts';
import { offBy } from '../../helpers/glb-off.ts';
import { describeShared, hasShared, sharedPath } from '../../helpers/shared.ts';

function openedFrom(...paths: readonly string[]): readonly Character[] {
  const { files } = loadFiles(paths.map(sharedPath), '/');
  return openFiles(EMPTY_DOCUMENT, files).document.characters;
}

const namesIn = (folder: string, end: string) =>
  hasShared ? readdirSync(sharedPath(folder)).filter((name) => name.endsWith(end)) : [];

const FILES: readonly (readonly string[])[] = [
  ['data/cse169/wasp.skel', 'data/cse169/wasp.skin', 'data/cse169/wasp_walk.anim'],
  ['data/cse169/dragon.skel'],
  ['data/cse169/tube.skel', 'data/cse169/tube_smooth.skin'],
  [
    'data/cse169/head.skel',
    'data/cse169/head_tex.skin',
    'data/cse169/head1.morph',
    'data/cse169/head2.morph',
    'data/cse169/head.bmp',
  ],
  ['data/synthetic/six.skel', 'data/synthetic/six.skin'],
  ['data/synthetic/nine.skel', 'data/synthetic/nine.skin'],
  ...namesIn('data/axis-skel', '.axskel').map((name) => [`data/axis-skel/${name}`]),
  ...namesIn('data/bvh', '.bvh').map((name) => [`data/bvh/${name}`]),
];

/** Seconds of a take: fitting keys to more of it takes longer, and shows nothing else; but one is fitted in several parts. */
const MAX_SECONDS = 0.5;
const IN_PARTS = 'data/bvh/cmu-01_01.bvh';
const SECONDS_OF_PARTS = 12;

function shortened(own: Character, most: number): Character {
  const takes = own.takes.map((take) => {
    const [start, end] = take.range;
    return { ...take, range: [start, Math.min(end, start + most)] as const };
  });
  return { ...own, takes };
}

describeShared('real files as GLB', () => {
  it.each(FILES.map((paths) => [paths.join(' '), paths] as const))(
    '%s is shown as it is here',
    async (_, paths) => {
      const characters = openedFrom(...paths);
      expect(characters.length).toBeGreaterThan(0);
      for (const opened of characters) {
        const own = shortened(opened, paths[0] === IN_PARTS ? SECONDS_OF_PARTS : MAX_SECONDS);
        const made = glbOf(own);
        expect(await complaintsOf(made.bytes)).toEqual([]);
        const { tolerance, takes } = made.report;
        const seconds = takes[0]?.seconds ?? 0;
        const times = Array.from({ length: seconds > 0 ? 25 : 1 }, (__, i) => ((i + 0.37) * seconds) / 25);
        const off = offBy(own, made, await inThree(made), own.shownTake, times);
        expect(off.joints).toBeLessThanOrEqual(tolerance);
        expect(off.vertices).toBeLessThanOrEqual(tolerance);
      }
    },
    120_000,
  );
});

describe('the helper of this test', () => {
  it('a wrong animation is found to be wrong', async () => {
    const [own] = hasShared ? openedFrom(...FILES[0]) : [];
    if (!own) return;
    const made = glbOf({ ...own, takes: own.takes.map((take) => ({ ...take, range: [1, 2] as const })) });
    const off = offBy(own, made, await inThree(made), 0, [0.5]);
    expect(off.joints).toBeGreaterThan(made.report.tolerance);
  });
});
