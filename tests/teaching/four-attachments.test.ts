import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { runToEnd } from '../../src/evaluate/steps.ts';
import { type Character, shownSkin } from '../../src/model/document.ts';
import { oneSurface, type Skin } from '../../src/model/skin.ts';
import { Evaluator } from '../../src/teaching/program/evaluator.ts';
import { FourAttachments, KEPT_FOUR, type KeptFour } from '../../src/teaching/program/four-attachments.ts';
import { RIGHT_PROGRAM } from '../../src/teaching/program/program.ts';
import { conformance, describeShared, sharedPath } from '../helpers/shared.ts';
import { characterOf, OWN, SHARED } from './lesson-files.ts';

function skinOf(character: Character): Skin {
  const skin = shownSkin(character);
  if (!skin) throw new Error('The character has no skin.');
  return skin;
}

const VERTICES = { local: false, vertices: true, normals: false };

/** World matrices and vertices of the file pose, by all attachments and by four. */
function posed(character: Character, kept: KeptFour) {
  const evaluator = new Evaluator(character);
  const skin = { ...RIGHT_PROGRAM.skin, attachments: kept };
  const byFour = evaluator.frame({ ...RIGHT_PROGRAM, skin }, undefined, VERTICES).vertices.slice();
  const { world, vertices } = evaluator.frame(RIGHT_PROGRAM, undefined, VERTICES);
  return { world: world.slice(), vertices: vertices.slice(), byFour };
}

function distances(a: ArrayLike<number>, b: ArrayLike<number>): number[] {
  return Array.from({ length: a.length / 3 }, (_, v) =>
    Math.hypot(a[3 * v] - b[3 * v], a[3 * v + 1] - b[3 * v + 1], a[3 * v + 2] - b[3 * v + 2]),
  );
}

/** Of the file pose; morphs have weight 0. */
function measured(character: Character, kept: KeptFour, world: Float64Array) {
  const four = new FourAttachments(skinOf(character), character.morphs, kept);
  const facts = runToEnd(four.follow(new Float64Array(character.morphs.length), world));
  return { four, ...facts };
}

interface Case {
  readonly files: readonly string[];
  readonly dump: string;
  readonly mistake: string;
}

const ONE_JOINT = Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
/** Joint j is at x = j. */
const inRow = (count: number) =>
  Float64Array.from({ length: 16 * count }, (_, i) => (i % 16 === 12 ? Math.floor(i / 16) : ONE_JOINT[i % 16]));
const bindings = (count: number) => Float64Array.from({ length: 16 * count }, (_, i) => ONE_JOINT[i % 16]);

/** A vertex at the origin with one attachment per weight, to joints 0, 1, … */
function vertexOf(...weights: readonly number[]): Skin {
  return {
    name: 'one',
    positions: new Float64Array(3),
    triangles: new Uint32Array(0),
    surfaces: oneSurface(new Uint32Array(0)),
    bindings: bindings(weights.length),
    attachments: {
      start: Uint32Array.of(0, weights.length),
      joints: Uint32Array.from(weights.keys()),
      weights: Float64Array.from(weights),
    },
  };
}

const displacementOf = (skin: Skin, kept: KeptFour, world = inRow(skin.bindings.length / 16)) => {
  const four = new FourAttachments(skin, [], kept);
  return { four, facts: runToEnd(four.follow(new Float64Array(0), world)) };
};

it.each([
  // All: 0.1·(0 + 1 + 2 + 3) + 0.6·4 = 3. The largest are joint 4 and the first three: (0.1·(0 + 1 + 2) + 2.4) / 0.9 =
  // 3.
  ['largest four normalised', 0],
  ['largest four', 0.3],
  // The first four: 0.6, normalised 1.5.
  ['first four normalised', 1.5],
  ['first four', 2.4],
] as const)('keeping the %s moves a vertex of five attachments by what is left out', (kept, expected) => {
  const { four, facts } = displacementOf(vertexOf(0.1, 0.1, 0.1, 0.1, 0.6), kept);
  expect(facts.largest).toBeCloseTo(expected, 12);
  expect(four.displacements[0]).toBe(facts.largest);
  expect([four.beyondFour, four.mostAttachments]).toEqual([1, 5]);
});

it('four attachments or fewer are all kept, whatever their order; only weights that don’t sum to 1 are normalised', () => {
  for (const kept of KEPT_FOUR) {
    const { four, facts } = displacementOf(vertexOf(0.1, 0.4, 0.2, 0.3), kept);
    expect(facts.largest).toBeLessThan(1e-15);
    expect([four.beyondFour, four.unevenSums]).toEqual([0, 0]);
  }
  const uneven = displacementOf(vertexOf(0.5, 1), 'largest four normalised');
  expect(uneven.facts.largest).toBeCloseTo(1 - 1 / 1.5, 12);
  expect([uneven.four.beyondFour, uneven.four.unevenSums]).toEqual([0, 1]);
  const given = displacementOf(vertexOf(0.5, 1), 'largest four');
  expect([given.facts.largest, given.facts.vertex, given.four.unevenSums]).toEqual([0, undefined, 0]);
});

it('a skin without attachments, without a skeleton or with vertices that have none is nowhere displaced', () => {
  const { attachments: _, ...loose } = vertexOf(1);
  expect(displacementOf(loose, 'largest four').facts).toEqual({ size: 1, largest: 0, vertex: undefined });
  const five = vertexOf(0.2, 0.2, 0.2, 0.2, 0.2);
  const four = new FourAttachments(five, [], 'first four');
  expect(runToEnd(four.follow(new Float64Array(0), undefined)).largest).toBe(0);
  expect(displacementOf(vertexOf(), 'first four', inRow(1)).facts.largest).toBe(0);
});

it('a morph moves what is displaced', () => {
  const five = vertexOf(0.2, 0.2, 0.2, 0.2, 0.2);
  const rows = { indices: Uint32Array.of(0), values: Float64Array.of(5, 0, 0) };
  const morph = { name: 'far', positions: rows, normals: { indices: new Uint32Array(0), values: new Float64Array(0) } };
  const four = new FourAttachments(five, [morph], 'first four');
  // A fifth of where joint 4 takes it: 0.2 · (5 · weight + 4).
  expect(runToEnd(four.follow(Float64Array.of(0), inRow(5))).largest).toBeCloseTo(0.8, 12);
  expect(runToEnd(four.follow(Float64Array.of(2), inRow(5))).largest).toBeCloseTo(2.8, 12);
});

it('the walker has no vertex with more than four attachments, and none is displaced', () => {
  const walker = characterOf(...OWN.walker);
  const { world } = posed(walker, 'largest four');
  const { four, largest } = measured(walker, 'largest four normalised', world);
  expect(four.beyondFour).toBe(0);
  expect(largest).toBeLessThan(1e-6);
});

describeShared('four attachments', () => {
  it.each(['nine', 'six', 'wasp', 'tube', 'reed'] as const)(
    'the displacements of %s are those between the programs of Compare, by each rule',
    (name) => {
      const character = characterOf(...SHARED[name]);
      for (const kept of KEPT_FOUR) {
        const { world, vertices, byFour } = posed(character, kept);
        const { four, largest, vertex, size } = measured(character, kept, world);
        const expected = distances(vertices, byFour);
        expect(Math.max(...expected.map((d, v) => Math.abs(d - four.displacements[v])))).toBeLessThan(1e-13 * size);
        expect(largest).toBe(Math.max(...four.displacements));
        expect(vertex).toBe(largest > 0 ? four.displacements.indexOf(largest) : undefined);
      }
    },
  );

  it('of nine attachments the reference’s vertices by the first four are as far from ours as is said', () => {
    const cases = conformance<readonly Case[]>('compare/cases.json');
    const dumped = cases.find(({ mistake }) => mistake === 'first-four-attachments');
    if (!dumped) throw new Error('There is no such case.');
    const text = readFileSync(sharedPath(`conformance/compare/${dumped.dump}`), 'utf8');
    const theirs = Float64Array.from((text.match(/-?\d[\d.e+-]*/g) ?? []).map(Number));
    const nine = characterOf(...dumped.files.map((file) => `data/${file}`));
    const { world, vertices } = posed(nine, 'first four');
    const { four, size } = measured(nine, 'first four', world);
    expect(theirs.length).toBe(vertices.length);
    expect(four.beyondFour).toBeGreaterThan(0);
    const expected = distances(vertices, theirs);
    expect(Math.max(...expected.map((d, v) => Math.abs(d - four.displacements[v])))).toBeLessThan(1e-6 * size);
  });
});
