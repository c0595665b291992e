/** Thousands of files, captures and parts opened at once. */
import fc from 'fast-check';
import { expect, it } from 'vitest';
import { extentOf, Placing, placeBeside } from '../../../src/edit/place-beside.ts';
import { spreadOfHeights } from '../../../src/edit/same-height.ts';
import { capturedContent } from '../../../src/files/captured.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { type Character, EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import type { ParsedFile } from '../../../src/model/files.ts';
import { character, file, joint, skeleton, skelFile, takeOfValues } from '../../helpers/builders.ts';
import { expectLinearTime } from '../../helpers/growth.ts';
import { personSkeleton, takeOfRoots } from '../../helpers/mocap.ts';

const SKELETON = personSkeleton();
const TAKE = takeOfRoots(SKELETON, [[0, 85, 0]]);
const ONE = capturedContent([{ skeleton: SKELETON, take: TAKE }], 't.bvh').value;

/** Captures, each in a file of its own. */
function captures(count: number): ParsedFile[] {
  return Array.from({ length: count }, (_, i) => file(`t${i}.bvh`, ONE));
}

it('the time to open captures grows with their number, in files of their own and in one', () => {
  expectLinearTime((n) => openFiles(EMPTY_DOCUMENT, captures(n)), 250, 'files');
  expectLinearTime(
    (n) => {
      const captures = Array.from({ length: n }, () => ({ skeleton: SKELETON, take: TAKE }));
      openFiles(EMPTY_DOCUMENT, [file('crowd.bvh', capturedContent(captures, 'crowd.bvh').value)]);
    },
    1000,
    'captures',
  );
});

it('the time to open skeletons with their animations grows with their number, in a folder and named by rigs', () => {
  const own = { kind: 'anim', take: takeOfValues('walk', [0]) } as const;
  expectLinearTime((n) => {
    const files = Array.from({ length: n }, (_, i) => [
      skelFile(`c${i}.skel`, skeleton(1)),
      file(`c${i}_walk.anim`, own),
    ]);
    const { document } = openFiles(EMPTY_DOCUMENT, files.flat());
    expect(document.characters.every(({ takes }) => takes.length === 1)).toBe(true);
  }, 250);
});

it('of several skeletons whose names begin a part the longest name has it, without regard to case', () => {
  const files = ['a.skel', 'AB.skel', 'abc.skel'].map((name) => skelFile(name, skeleton(1, name)));
  const anim = file('Abc1.anim', { kind: 'anim', take: takeOfValues('walk', [0]) });
  const { characters } = openFiles(EMPTY_DOCUMENT, [...files, anim]).document;
  expect(characters.map(({ takes }) => takes.length)).toEqual([0, 0, 1]);
});

it('characters placed one after the other are where each is placed beside all before it', () => {
  const one = fc.record({
    width: fc.double({ min: 0.1, max: 9 }),
    scale: fc.double({ min: 0.1, max: 9 }),
    file: fc.nat(3),
  });
  const sources = [0, 1, 2].map((i) => ({ name: `${i}.bvh`, path: `${i}.bvh`, bytes: 1 }));
  const space = ONE.kind === 'bvh' ? openFiles(EMPTY_DOCUMENT, captures(1)).document.characters[0].space : undefined;
  fc.assert(
    fc.property(fc.array(one, { maxLength: 20 }), (all) => {
      const placing = new Placing([]);
      const placed: Character[] = [];
      for (const [i, { width, scale, file }] of all.entries()) {
        const joints = [joint(-1), joint(0, { offset: [width, 1, 0] })];
        const made = character({
          ...{ id: `c${i}`, skeleton: { ...skeleton(), joints } },
          // Some are captures of one file.
          ...(space && sources[file] && { space, sources: [sources[file]] }),
        });
        const placement = placing.place(made, scale);
        expect(placement).toEqual(placeBeside(placed, made, scale));
        placed.push({ ...made, placements: [placement] });
        placing.add(placed[i]);
      }
    }),
    { numRuns: 30 },
  );
});

it('a character as large as numbers go has a placement of numbers', () => {
  const huge = character({ skeleton: skeletonOf(1e308) });
  for (const others of [[huge], [huge, huge]]) {
    expect(placeBeside(others, huge).position.every(Number.isFinite)).toBe(true);
    const wide = character({
      skeleton: { ...skeleton(), joints: [joint(-1), joint(0, { offset: [1.7e308, 1, 0], length: 1e308 })] },
    });
    expect(Object.values(extentOf(wide)).every((value) => !Number.isNaN(value))).toBe(true);
    expect(extentOf(wide).size).toBeLessThan(Infinity);
  }
});

it('the spread of heights of 200,000 characters is found', () => {
  const post = character({ skeleton: skeletonOf(2) });
  const [least, most] = spreadOfHeights(Array.from({ length: 200_000 }, () => post)) ?? [];
  expect(least).toBeGreaterThan(0);
  expect(most).toBe(least);
});

function skeletonOf(height: number) {
  return { ...skeleton(), joints: [joint(-1), joint(0, { offset: [height, height, 0] })] };
}
