/** What stays in place in the displayed pose: vertices in bind mode, and pivots that a change does not mean to move. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { documentIn } from '../../../src/edit/change.ts';
import { CommandError } from '../../../src/edit/command-error.ts';
import { addJoint, createRig } from '../../../src/edit/commands/rig.ts';
import { setOffset } from '../../../src/edit/commands/rig-joint.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import { blendMorphs, compileSkin, deform } from '../../../src/evaluate/skin/deform.ts';
import { determinant3 } from '../../../src/math/mat4.ts';
import type { Character, Document } from '../../../src/model/document.ts';
import { rootDofCount } from '../../../src/model/skeleton/dofs.ts';
import { type Skeleton, UNLIMITED } from '../../../src/model/skeleton/skeleton.ts';
import { character, documentOf, joint, skin } from '../../helpers/builders.ts';
import {
  diceOf,
  RIG_COMMANDS,
  type RigCommand,
  randomDocument,
  rigArguments,
  rigCommand,
  seeds,
} from './random-rig.ts';

const SECONDS = 1;
/** As a part of the size. */
const STAYS = 1e-9;
/** Of unit vectors, through matrices that stretch. */
const TURNED = 1e-7;

interface Stand {
  readonly world: Float64Array;
  /** x y z of every vertex of every skin. */
  readonly vertices: readonly Float64Array[];
  /** x y z alike. */
  readonly normals: readonly Float64Array[];
}

function standOf(character: Character): Stand {
  const { skeleton, skins, morphs, shownSkin } = character;
  if (!skeleton) throw new Error('no skeleton');
  const dofs = new Float64Array(dofCountOf(character));
  poseAt(character, SECONDS, dofs);
  const world = new Float64Array(16 * skeleton.joints.length);
  worldMatrices(compileSkeleton(skeleton), dofs, world);
  const deformed = skins.map((skin, s) => {
    const compiled = compileSkin(skin);
    const positions = skin.positions.slice();
    const normals = compiled.normals.slice();
    if (s === shownSkin) blendMorphs(compiled, morphs, dofs, dofs.length - morphs.length, positions, normals);
    deform(compiled, world, positions, normals, positions, normals);
    return { positions, normals };
  });
  return {
    world,
    vertices: deformed.map(({ positions }) => positions),
    normals: deformed.map(({ normals }) => normals),
  };
}

function farthest(a: Float64Array, b: Float64Array): number {
  return a.reduce((most, value, i) => Math.max(most, Math.abs(value - b[i])), 0);
}

/** Whether nothing is scaled or sheared so far that digits are lost on the way back. */
function isPlain({ world, vertices }: Stand): boolean {
  for (let o = 0; o < world.length; o += 16) {
    const d = Math.abs(determinant3(world, o));
    const isLong = world.subarray(o, o + 11).some((v) => Math.abs(v) > 10);
    if (isLong || !(d > 0.05 && d < 20)) return false;
  }
  return vertices.every((all) => all.every((v) => Math.abs(v) < 1e3));
}

/** The document after it; the same one if it is refused. */
function done(document: Document, id: RigCommand, args: object): Document {
  try {
    return documentIn(rigCommand(id).run(document, args));
  } catch (error) {
    if (error instanceof CommandError) return document;
    throw error;
  }
}

const sizeOf = (world: Float64Array) =>
  world.reduce((most, v, k) => (k % 16 >= 12 && k % 16 < 15 ? Math.max(most, Math.abs(v)) : most), 1);

describe('bind mode', () => {
  it('bind mode keeps every vertex in place, whatever happens to the joints', () => {
    let moved = 0;
    fc.assert(
      fc.property(seeds, seeds, fc.constantFrom(...RIG_COMMANDS), (seed, thrown, id) => {
        const document = randomDocument(seed);
        const [hero] = document.characters;
        const dice = diceOf(thrown);
        const next = done(document, id, rigArguments(id, hero, dice, { skin: 'stays', timeSeconds: SECONDS }));
        if (next === document) return;
        const [was, is] = [standOf(hero), standOf(next.characters[0])];
        fc.pre(isPlain(was) && isPlain(is));
        if (was.world.length !== is.world.length || farthest(was.world, is.world) > STAYS) moved++;
        const size = was.vertices.reduce(
          (most, all) => all.reduce((m, v) => Math.max(m, Math.abs(v)), most),
          sizeOf(was.world),
        );
        was.vertices.forEach((vertices, s) => {
          expect(farthest(vertices, is.vertices[s])).toBeLessThan(STAYS * size);
          expect(farthest(was.normals[s], is.normals[s])).toBeLessThan(TURNED);
        });
      }),
      { numRuns: 80 },
    );
    expect(moved).toBeGreaterThan(20);
  });

  it('bind mode keeps bindings of joints that did not move', () => {
    const document = randomDocument(7);
    const [hero] = document.characters;
    const args = { characterId: 'c1', joint: 0, name: 'other', skin: 'stays', timeSeconds: 0 };
    const [renamed] = done(document, 'rig.rename', args).characters;
    expect(renamed.skins).toBe(hero.skins);
  });
});

describe('limits and couples', () => {
  /** A knee that is bent by 1, with a vertex on what hangs on it. */
  const skeleton: Skeleton = {
    name: 'leg',
    joints: [
      joint(-1, { name: 'hip' }),
      joint(0, { name: 'knee', offset: [0, 1, 0], limits: [0, 1, 2].map(() => UNLIMITED) }),
      joint(1, { name: 'foot', offset: [0, 1, 0] }),
    ],
  };
  const bindings = new Float64Array(48);
  for (const [j, y] of [0, 1, 2].entries()) bindings.set([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, y, 0, 1], 16 * j);
  const on = (dofs: number) => [0.25, 0, 0, 0, 0, 0, dofs, 0, 0, 0.125, 0, 0];
  const document = documentOf(
    character({ skeleton, pose: on(1), skins: [skin('leg', 2, { bindings })], takes: [], shownTake: -1 }),
  );
  const limit = { characterId: 'c1', dof: 6, min: -1, max: 0.25 };
  const follows = { joint: 0, dof: 'rx', gain: 1, offset: 0.5 };
  const couple = { characterId: 'c1', joint: 1, dof: 'rx', follows };
  const limited = done(document, 'rig.setLimit', limit);

  it.each([
    ['rig.setLimit', document, limit],
    ['rig.clearLimit', limited, { characterId: 'c1', dof: 6 }],
    ['rig.setCouple', document, couple],
  ] as const)('move a joint, and the skin or not, as is asked: %s', (id, from, args) => {
    const was = standOf(from.characters[0]);
    const moved = (skinMode: string) => {
      const [after] = done(from, id, { ...args, skin: skinMode, timeSeconds: SECONDS }).characters;
      const is = standOf(after);
      expect(farthest(is.world, was.world)).toBeGreaterThan(0.1);
      return { by: farthest(is.vertices[0], was.vertices[0]), skins: after.skins };
    };
    expect(moved('stays').by).toBeLessThan(STAYS);
    expect(moved('follows').by).toBeGreaterThan(0.1);
    expect(moved('follows').skins).toBe(from.characters[0].skins);
  });

  it('leave the skin unchanged if nothing moves', () => {
    const wide = { ...limit, max: 3, skin: 'stays', timeSeconds: SECONDS };
    expect(done(document, 'rig.setLimit', wide).characters[0].skins).toBe(document.characters[0].skins);
    expect(done(limited, 'rig.setLimit', { ...limit, skin: 'stays' })).toBe(limited);
  });
});

describe('pose mode', () => {
  it('pose mode keeps the bindings, and the joints that are bound by them', () => {
    fc.assert(
      fc.property(seeds, seeds, (seed, thrown) => {
        const document = randomDocument(seed);
        const [hero] = document.characters;
        const args = rigArguments('rig.setOffset', hero, diceOf(thrown), { skin: 'follows' });
        const [next] = done(document, 'rig.setOffset', args).characters;
        expect(next.skins).toBe(hero.skins);
      }),
      { numRuns: 30 },
    );
  });
});

/** The pivots of joints that are there in both, by the joints' names, which the characters made up have each once. */
function pivots({ skeleton }: Character, { world }: Stand): ReadonlyMap<string, Float64Array> {
  return new Map(
    (skeleton?.joints ?? []).flatMap(({ name }, j) => (name ? [[name, world.slice(16 * j + 12, 16 * j + 15)]] : [])),
  );
}

describe('pivots', () => {
  it.each(['rig.reparent', 'rig.remove'] as const)('pivots of the joints moved by %s stay where they are', (id) => {
    fc.assert(
      fc.property(seeds, seeds, (seed, thrown) => {
        const document = randomDocument(seed);
        const [hero] = document.characters;
        const given = rigArguments(id, hero, diceOf(thrown), { timeSeconds: SECONDS, children: 'stay' });
        const next = done(document, id, given);
        if (next === document) return;
        const { joint } = given as { readonly joint: number };
        const [now] = next.characters;
        const [was, is] = [standOf(hero), standOf(now)];
        fc.pre(isPlain(was) && isPlain(is));
        const places = pivots(now, is);
        const before = pivots(hero, was);
        for (const [j, { name, parent }] of (hero.skeleton?.joints ?? []).entries()) {
          const isMoved = id === 'rig.reparent' ? j === joint : parent === joint;
          const [a, b] = [before.get(name), places.get(name)];
          if (!isMoved || !a || !b) continue;
          expect(farthest(a, b)).toBeLessThan(STAYS * sizeOf(was.world));
        }
      }),
      { numRuns: 70 },
    );
  });

  it('pivots of children stay when their joint is moved, if requested', () => {
    fc.assert(
      fc.property(seeds, seeds, (seed, thrown) => {
        const document = randomDocument(seed);
        const [hero] = document.characters;
        const more = { timeSeconds: SECONDS, children: 'stay' };
        const given = rigArguments('rig.setOffset', hero, diceOf(thrown), more);
        const next = done(document, 'rig.setOffset', given);
        const { joint } = given as { readonly joint: number };
        const [now] = next.characters;
        const [was, is] = [standOf(hero), standOf(now)];
        fc.pre(isPlain(was) && isPlain(is));
        for (const [j, { parent }] of (hero.skeleton?.joints ?? []).entries()) {
          if (parent !== joint) continue;
          const at = (s: Stand) => s.world.slice(16 * j + 12, 16 * j + 15);
          expect(farthest(at(was), at(is))).toBeLessThan(STAYS * sizeOf(was.world));
        }
      }),
      { numRuns: 60 },
    );
  });
});

describe('what is shown', () => {
  it('what is shown is the same after a joint is added, renamed, or given a box or a file pose', () => {
    fc.assert(
      fc.property(
        seeds,
        seeds,
        fc.constantFrom(
          'rig.addJoint' as const,
          'rig.rename' as const,
          'rig.setBox' as const,
          'rig.setFilePose' as const,
        ),
        (seed, thrown, id) => {
          const document = randomDocument(seed);
          const [hero] = document.characters;
          const [now] = done(document, id, rigArguments(id, hero, diceOf(thrown))).characters;
          const [was, is] = [standOf(hero), standOf(now)];
          const places = pivots(now, is);
          for (const [name, place] of pivots(hero, was)) {
            const kept = places.get(name);
            if (kept) expect(farthest(place, kept)).toBe(0);
          }
          was.vertices.forEach((vertices, s) => {
            expect(farthest(vertices, is.vertices[s])).toBe(0);
          });
          expect(rootDofCount(now.skeleton)).toBe(rootDofCount(hero.skeleton));
        },
      ),
      { numRuns: 60 },
    );
  });
});

describe('a skeleton built into a skin that waits for one', () => {
  /** Attached to three joints that don't exist yet, bound away from where they will be. */
  const template = skin('hero', 2, {
    positions: Float64Array.of(0, 0, 0, 1, 2, 0, 0, 4, 1, 2, 2, 2),
    normals: Float64Array.of(0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1),
    attachments: {
      start: Uint32Array.of(0, 1, 3, 4, 6),
      joints: Uint32Array.of(0, 0, 1, 2, 1, 2),
      weights: Float64Array.of(1, 0.25, 0.75, 1, 0.5, 0.5),
    },
    bindings: Float64Array.from({ length: 48 }, (_, i) => ((i % 16) % 5 === 0 ? 1 : i % 16 === 13 ? 3 : 0)),
  });
  const waiting = (): Document => {
    const { skeleton: _none, ...alone } = character({ skins: [template], pose: [0, 0, 0] });
    return documentOf(alone);
  };
  const built = (mode: 'stays' | 'follows') => {
    let document = documentIn(createRig.run(waiting(), { characterId: 'c1', skin: mode }));
    const args = { characterId: 'c1', skin: mode };
    document = documentIn(setOffset.run(document, { ...args, joint: 0, offset: [1, 2, 3], children: 'follow' }));
    const stands = [standOf(document.characters[0])];
    for (let parent = 0; parent < 3; parent++) {
      document = documentIn(addJoint.run(document, { ...args, parent, offset: [0.5, -1, 0.25] }));
      stands.push(standOf(document.characters[0]));
    }
    return stands.map(({ vertices }) => farthest(vertices[0], template.positions));
  };

  it('a skeleton built into a skin that waits for one keeps every vertex in place, whichever joints its file refers to, and attaches them to these', () => {
    for (const away of built('stays')) expect(away).toBeLessThan(STAYS);
  });

  it('uses the file’s bindings if the skin is to follow', () => {
    expect(Math.min(...built('follows'))).toBeGreaterThan(0.5);
  });
});
