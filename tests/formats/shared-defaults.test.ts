/** Files whose joints say little, and many joints or roots: what joints have in common is held once. */
import { expect, it } from 'vitest';
import { readBvh } from '../../src/formats/bvh/read.ts';
import type { Joint } from '../../src/model/skeleton/skeleton.ts';
import { bytesOf, read, readInPieces } from './read-in-pieces.ts';

function jointsOf(text: string, name: string): readonly Joint[] {
  const { value } = read(name, text);
  if (value?.kind === 'skel') return value.skeletons[0].joints;
  return value?.kind === 'bvh' ? value.captures[0].skeleton.joints : [];
}

const MANY = 20_000;

it('joints of a .skel that say nothing share their limits, pose, box and offset', () => {
  const [, first, ...others] = jointsOf(`balljoint{${'balljoint{}'.repeat(MANY)}}`, 'x.skel');
  expect(others).toHaveLength(MANY - 1);
  const isShared = (of: keyof Joint) => others.every((joint) => joint[of] === first[of]);
  expect((['limits', 'pose', 'box', 'offset'] as const).map(isShared)).toEqual([true, true, true, true]);
  const [own] = jointsOf('balljoint a { rotxlimit -1 1 boxmin 0 0 0 }', 'x.skel');
  expect(own).toMatchObject({
    limits: [{ min: -1, max: 1 }, { max: 1e5 }, {}],
    box: { min: [0, 0, 0], max: [0.1, 0.1, 0.1] },
  });
});

it('joints of a .bvh with the same channels share their motion and limits', () => {
  const joint = 'JOINT a\n{ OFFSET 1 2 3 CHANNELS 3 Zrotation Xrotation Yrotation }';
  const text = `HIERARCHY ROOT a\n{ OFFSET 0 0 0 CHANNELS 0 ${joint.repeat(MANY)} } MOTION Frames: 0 Frame Time: 1`;
  const [, first, ...others] = jointsOf(text, 'x.bvh');
  expect(others).toHaveLength(MANY - 1);
  const isShared = (of: keyof Joint) => others.every((other) => other[of] === first[of]);
  expect((['motion', 'limits', 'pose', 'box'] as const).map(isShared)).toEqual([true, true, true, true]);
});

it('ten thousand roots of one name have names of their own', () => {
  const roots = 'ROOT a\n{ OFFSET 0 0 0 CHANNELS 1 Xrotation }\n'.repeat(10_000);
  const { value } = readBvh(`HIERARCHY ${roots} MOTION Frames: 1 Frame Time: 1\n${'0 '.repeat(10_000)}`, 'x.bvh');
  const names = new Set(value?.map(({ skeleton }) => skeleton.name));
  expect(names.size).toBe(10_000);
  expect([names.has('x a'), names.has('x a 2'), names.has('x a 10000')]).toEqual([true, true, true]);
});

it.each([
  ['x.skel', `${'balljoint{'.repeat(MANY)}${'}'.repeat(MANY)}`],
  ['x.bvh', `HIERARCHY ROOT{${'JOINT{'.repeat(MANY - 1)}${'}'.repeat(MANY)} MOTION Frames: 0 Frame Time: 1`],
  ['x.axskel', `${'1 0 0 1 0 1\n'.repeat(MANY - 1)}1 0 0 1 0 0`],
])('a chain of twenty thousand joints in %s is read and written', (name, text) => {
  expect(jointsOf(text, name.replace('.ax', '.'))).toHaveLength(MANY);
});

it('joints of the axis-angle form with equal values share them, and −0 stays −0', () => {
  const [, first, second, third] = jointsOf('1 0 0 1 5 1\n1 0 0 1 5 1\n1 0 0 1 5 1\n1 0 -0 1 -0 0\n', 'x.skel');
  const isShared = (of: keyof Joint) => first[of] === second[of];
  expect((['offset', 'motion', 'limits', 'pose', 'box'] as const).map(isShared)).toEqual([
    true,
    true,
    true,
    true,
    true,
  ]);
  expect(third).toMatchObject({ motion: { axis: [0, -0, 1] }, pose: [-0] });
});

it('a joint that links a DOF keeps the place of the link, after the joints in it and beside it are closed', () => {
  const text = `balljoint a {\n balljoint b { couple rx nobody.rx 1 0 balljoint c { pose 0 0 0 } }\n ${'balljoint{}'.repeat(50)}\n}`;
  for (const cut of [[], [30], [60, 90]]) {
    const { diagnostics } = readInPieces('x.skel', bytesOf(text), cut);
    expect(diagnostics).toMatchObject([{ severity: 'error', line: 2, column: 26 }]);
  }
});
