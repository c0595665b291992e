import { InstancedMesh, Matrix4, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import type { Character } from '../../../src/model/document.ts';
import { DEFAULT_DISPLAY, type Display } from '../../../src/model/session.ts';
import { GhostTimes, ghostStepSeconds } from '../../../src/view/motion/ghost-times.ts';
import { Ghosts } from '../../../src/view/motion/ghosts.ts';
import { channelOf } from '../../edit/keys/channels.ts';
import { character, takeOfValues } from '../../helpers/builders.ts';
import { captured, personSkeleton, takeOfRoots } from '../../helpers/mocap.ts';

const ON: Display = { ...DEFAULT_DISPLAY, ghosts: true, ghostsBefore: 2, ghostsAfter: 2, ghostStep: 0.1 };

/** Positions of node 0's ball, ghost by ghost. */
function roots(ghosts: Ghosts, nodes: number): number[][] {
  const [balls] = ghosts.object.children.filter((m) => m instanceof InstancedMesh).slice(-1);
  const matrix = new Matrix4();
  return Array.from({ length: balls.count / nodes }, (_, g) => {
    balls.getMatrixAt(g * nodes, matrix);
    return new Vector3().setFromMatrixPosition(matrix).toArray();
  });
}

describe('how far apart ghosts are', () => {
  it('ghosts are seconds apart, or frames of the take, or of the transport if the take has none', () => {
    const mocap = captured(personSkeleton(), takeOfRoots(personSkeleton(), [[0, 85, 0]]));
    const keyed = character({ takes: [takeOfValues('walk', [0])], shownTake: 0 });
    const frames: Display = { ...ON, ghostStepIn: 'frames', ghostStep: 3 };
    expect(ghostStepSeconds(mocap, ON, 24)).toBe(0.1);
    expect(ghostStepSeconds(mocap, frames, 24)).toBeCloseTo(0.3, 12);
    expect(ghostStepSeconds(keyed, frames, 24)).toBeCloseTo(0.125, 12);
  });
});

/** How far each ghost is from the current time, as its number and in seconds. */
function ghostsAt(of: Character, display: Display, timeSeconds: number, range: readonly [number, number]) {
  const found = new GhostTimes();
  found.fill(of, display, timeSeconds, range, 30);
  return [...found.steps.subarray(0, found.count)].map((step, g) => [step, found.times[g]]);
}

describe('which ghosts there are', () => {
  const walker = character({ takes: [takeOfValues('walk', [0])], shownTake: 0 });
  const stepsAt = (...[display, ...rest]: [Display, number, readonly [number, number]]) =>
    ghostsAt(walker, display, ...rest).map(([step]) => step);

  it('ghosts are before and after, and never now', () => {
    expect(stepsAt(ON, 5, [0, 10])).toEqual([-2, -1, 1, 2]);
  });

  it('ghosts are inside the playback range, ends included', () => {
    expect(stepsAt(ON, 0.1, [0, 10])).toEqual([-1, 1, 2]);
    expect(stepsAt(ON, 10, [0, 10])).toEqual([-2, -1]);
    expect(stepsAt({ ...ON, ghostStep: 0 }, 0, [0, 10])).toEqual([]);
  });

  it('at keys they are at those of any channel, each once, wherever they are', () => {
    const channels = [
      [0, 1, 4],
      [1, 2.5],
    ].map((times) => channelOf(times.map((time) => [time, 0])));
    const keyed = character({
      takes: [{ ...takeOfValues('walk', []), range: [0, 4], channels }],
      shownTake: 0,
      timeOffsetSeconds: 1,
    });
    const atKeys: Display = { ...ON, ghostStepIn: 'keys' };
    expect(ghostsAt(keyed, atKeys, 0.5, [-5, 5])).toEqual([
      [-2, -1],
      [-1, 0],
      [1, 1.5],
      [2, 3],
    ]);
    // The key that is shown is none of them.
    expect(ghostsAt(keyed, atKeys, 1.5, [0, 5])).toEqual([
      [-1, 0],
      [1, 3],
    ]);
    expect(ghostsAt(keyed, atKeys, 9, [0, 9])).toEqual([
      [-2, 1.5],
      [-1, 3],
    ]);
  });

  it('at keys they are at frames of a capture', () => {
    const mocap = captured(
      personSkeleton(),
      takeOfRoots(personSkeleton(), [
        [0, 85, 0],
        [1, 85, 0],
        [2, 85, 0],
      ]),
    );
    const [[, before], [, after]] = ghostsAt(
      mocap,
      { ...ON, ghostStepIn: 'keys', ghostsBefore: 1, ghostsAfter: 1 },
      0.1,
      [0, 1],
    );
    expect(after - before).toBeCloseTo(2 * (mocap.takes[0].samples?.frameSeconds ?? 0), 12);
  });
});

describe('ghosts', () => {
  const skeleton = personSkeleton();
  const rows = Array.from({ length: 11 }, (_, i) => [10 * i, 85, 5 * i] as const);
  const walking: Character = captured(skeleton, takeOfRoots(skeleton, rows), {
    space: { up: 'y', unit: 'centimetres', lift: 0.25 },
  });

  it('ghosts are at past and future poses, in the character’s space', () => {
    const ghosts = new Ghosts();
    ghosts.fill(walking, ON, 0.5, [0, 1], 30);
    expect(ghosts.object.visible).toBe(true);
    const found = roots(ghosts, 9);
    expect(found.map(([x]) => x)).toEqual([0.3, 0.4, 0.6, 0.7].map((x) => expect.closeTo(x, 5)));
    for (const [, y] of found) expect(y).toBeCloseTo(1.1, 5);
  });

  it('ghosts of thousands of joints have a tenth of the triangles each, and stay in their places', () => {
    const ghosts = new Ghosts();
    const meshes = ghosts.object.children.filter((m) => m instanceof InstancedMesh);
    const triangles = () => meshes.map(({ geometry }) => (geometry.index?.count ?? 0) / 3).reduce((a, b) => a + b);
    ghosts.fill(walking, ON, 0.5, [0, 1], 30);
    const [few, before] = [triangles(), roots(ghosts, 9)];
    const crowd = { ...walking, placements: Array.from({ length: 120 }, () => walking.placements[0]) };
    ghosts.fill(crowd, ON, 0.5, [0, 1], 30);
    expect(triangles()).toBeLessThan(0.15 * few);
    expect(meshes.every(({ geometry, count }) => geometry.getAttribute('tint').count >= count)).toBe(true);
    ghosts.fill(walking, ON, 0.5, [0, 1], 30);
    expect(triangles()).toBe(few);
    expect(roots(ghosts, 9)).toEqual(before);
  });

  it('ghosts stay on the spot in place', () => {
    const ghosts = new Ghosts();
    ghosts.fill(walking, { ...ON, inPlace: true }, 0.5, [0, 1], 30);
    for (const [x, y, z] of roots(ghosts, 9)) {
      expect(x).toBeCloseTo(0, 6);
      expect(y).toBeCloseTo(1.1, 5);
      expect(z).toBeCloseTo(0, 6);
    }
  });

  it('ghosts are removed without a character, and take two draw calls for any number', () => {
    const ghosts = new Ghosts();
    ghosts.fill(walking, { ...ON, ghostsBefore: 20, ghostsAfter: 20, ghostStep: 0.01 }, 0.5, [0, 1], 30);
    expect(ghosts.object.children).toHaveLength(2);
    expect(roots(ghosts, 9)).toHaveLength(40);
    ghosts.fill(undefined, ON, 0.5, [0, 1], 30);
    expect(ghosts.object.visible).toBe(false);
  });

  it('ghosts ignore unkeyed changes of the current time', () => {
    const ghosts = new Ghosts();
    ghosts.fill({ ...walking, unkeyed: { timeSeconds: 0.5, dofs: [0], values: [999] } }, ON, 0.5, [0, 1], 30);
    expect(roots(ghosts, 9)[0][0]).toBeCloseTo(0.3, 5);
  });
});
