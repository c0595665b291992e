/** Whether numbers of joints are those of a pose: of our examples, with joints of all types, limits and links. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { Character } from '../../../src/model/document.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import { diagonalOf } from '../../../src/teaching/compare/errors.ts';
import type { FrameTarget } from '../../../src/teaching/compare/targets.ts';
import { dumpedPose } from '../../../src/teaching/ik/dumped-pose.ts';
import { SolverStart } from '../../../src/teaching/ik/start.ts';
import { hasShared } from '../../helpers/shared.ts';
import { characterFrom, characterOf, OWN, SHARED } from '../lesson-files.ts';

const LINKED = `balljoint root { rotxlimit -2 2
  hingejoint knee { offset 0 1 0 axis 1 0 0 rotxlimit -0.5 1
    hingejoint ankle { offset 0 1 0.1 axis 1 0 0 couple r knee.r -0.5 0.1
      balljoint toe { offset 0 0.3 0.4 } } }
  universaljoint arm { offset 1 0 0 balljoint hand { offset 0 1 0 balljoint finger { offset 0.2 0.5 0 } } } }
`;

const FILES: Readonly<Record<string, () => Character>> = {
  linked: () => characterFrom('linked.skel', LINKED),
  walker: () => characterOf(...OWN.walker),
  crawler: () => characterOf(...OWN.crawler),
  ...(hasShared && {
    wasp: () => characterOf(...SHARED.wasp),
    dragon: () => characterOf(...SHARED.dragon),
    human: () => characterOf(...SHARED.human),
    hexapod: () => characterOf(...SHARED.hexapod),
    poser: () => characterOf(...SHARED.poser),
  }),
};

describe.each(Object.keys(FILES))('numbers of %s', (name) => {
  const character = FILES[name]();
  const { skeleton } = character;
  if (!skeleton) throw new Error(`${name} has no skeleton.`);
  const start = new SolverStart(character, skeleton, undefined);
  const count = skeleton.joints.length;
  const size = diagonalOf(start.matrices(start.pose), 16, 12);
  const isOne = (numbers: Partial<FrameTarget>) =>
    dumpedPose(start, { time: undefined, ...numbers }, size, 1e-4 * size) !== undefined;
  const dumpOf = (step: readonly number[]) => {
    const world = start.matrices(start.after(step)).slice();
    const positions = Float64Array.from({ length: 3 * count }, (_, i) => world[16 * Math.floor(i / 3) + 12 + (i % 3)]);
    return { world, positions };
  };
  const turns = fc.infiniteStream(fc.integer({ min: -100, max: 100 })).map((stream) => {
    const units = skeleton.joints.flatMap(({ motion }) => dofsOf(motion).map(({ unit }) => unit));
    const first = start.compiled.firstDof[0];
    return start.variables.map((dof) => (units[dof - first] === 'angle' ? Number(stream.next().value) / 100 : 0));
  });

  it('are of a pose wherever it is', () => {
    fc.assert(
      fc.property(turns, (step) => {
        const { world, positions } = dumpOf(step);
        expect(isOne({ world })).toBe(true);
        expect(isOne({ positions })).toBe(true);
      }),
      { numRuns: 5 },
    );
  });

  it('are of none where a joint is somewhere else', () => {
    const leaf = count - 1;
    fc.assert(
      fc.property(turns, (step) => {
        const { world, positions } = dumpOf(step);
        const above = 3 * skeleton.joints[leaf].parent;
        // No bone is as long as the character.
        for (let k = 0; k < 3; k++) {
          positions[3 * leaf + k] = positions[above + k] + size;
          world[16 * leaf + 12 + k] = positions[3 * leaf + k];
        }
        expect(isOne({ world })).toBe(false);
        expect(isOne({ positions })).toBe(false);
      }),
      { numRuns: 2 },
    );
  });
});
