/** Which joint of a retargeted character moves over the ground, and joints that slide, scale or stay. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { setRetarget } from '../../../src/edit/commands/retarget.ts';
import { movedDofs } from '../../../src/evaluate/retarget/moved-dofs.ts';
import { carrierOf } from '../../../src/evaluate/travel.ts';
import { type Character, findCharacter } from '../../../src/model/document.ts';
import { filePose, firstDofs, jointDofCount, rootDofCount } from '../../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import { type BvhMotion, type Joint, type Skeleton, UNLIMITED } from '../../../src/model/skeleton/skeleton.ts';
import { character, documentOf } from '../../helpers/builders.ts';
import { Points, pointNames } from './captures.ts';
import { BVH_ROOT, person, takeOfRows } from './people.ts';

/** The person below a root on the ground. */
function rooted(body: Skeleton): Skeleton {
  const root: Joint = { ...body.joints[0], name: 'root', offset: [0, 0, 0], pose: body.joints[0].pose.map(() => 0) };
  return { ...body, joints: [root, ...body.joints.map((j) => ({ ...j, parent: j.parent + 1 }))] };
}

const FRAMES = 8;

/** One that dances: every angle swings; joints below the hips that have positions slide by up to 5 cm. */
function dancer(skeleton: Skeleton, moving: string): Character {
  const first = firstDofs(skeleton);
  const rest = filePose(skeleton, 0);
  const rows = Array.from({ length: FRAMES }, (_, f) => {
    const row = [...rest.slice(rootDofCount(skeleton), rootDofCount(skeleton) + jointDofCount(skeleton))];
    skeleton.joints.forEach((joint, j) => {
      dofsOf(joint.motion).forEach(({ unit, name }, d) => {
        const at = first[j] + d - rootDofCount(skeleton);
        if (joint.name === moving && unit === 'length') row[at] += 0.2 * f * (name === 'ty' ? 0.1 : 1);
        else if (j > 1 && unit === 'length') row[at] += 0.05 * Math.sin(f + at);
        else if (j > 0 && unit === 'angle') row[at] += 0.4 * Math.sin(f / 2 + at);
        else if (unit === 'factor') row[at] *= 1 + 0.2 * Math.sin(f + at);
      });
    });
    return row;
  });
  return {
    ...character({ id: 's', name: 'dancer', skeleton, takes: [takeOfRows(skeleton, rows)], shownTake: 0 }),
    pose: rest,
  };
}

function on(source: Character, skeleton: Skeleton): Character {
  const target = { ...character({ id: 't', name: 'copy', skeleton }), pose: filePose(skeleton, 0) };
  const document = setRetarget.run(documentOf(source, target), { characterId: 't', sourceId: 's' });
  const found = findCharacter(document, 't');
  if (!found) throw new Error('The target is gone.');
  return found;
}

/** The positions of a character's joints at a frame. */
function positions(of: Character, frame: number): Map<string, readonly number[]> {
  const points = new Points(of);
  points.pose(frame * 0.1);
  return new Map(pointNames(of).map((name, i) => [name, [...points.at.slice(3 * i, 3 * i + 3)]]));
}

function expectSame(a: Character, b: Character) {
  for (let f = 0; f < FRAMES; f++) {
    const own = positions(a, f);
    for (const [name, point] of positions(b, f)) {
      point.forEach((v, k) => {
        expect(own.get(name)?.[k], `${name} in frame ${f}`).toBeCloseTo(v, 9);
      });
    }
  }
}

describe('the joint that moves a retargeted character', () => {
  it.each(['hips', 'root'])('is the one that does in the source where the skeleton is the same: %s', (moving) => {
    const skeleton = rooted(person());
    const source = dancer(skeleton, moving);
    const copy = on(source, skeleton);
    expect(carrierOf(copy)).toBe(skeleton.joints.findIndex((j) => j.name === moving));
    expectSame(copy, source);
  });

  it('is the hips below a root that stays, whatever moves the source', () => {
    const source = dancer(person(), 'hips');
    const skeleton = rooted(person({ size: 0.5, names: (part) => `rig:${part}` }));
    const target = on(source, skeleton);
    expect(carrierOf(target)).toBe(1);
    expect([...(movedDofs(target) ?? [])]).not.toContain(0);
    expect(positions(target, 5).get('root')).toEqual([0, 0, 0]);
    expect(positions(target, 5).get('rig:hips')?.[0]).toBeCloseTo(0.5 * 1, 9);
  });

  it('is the root above hips that only rotate', () => {
    const source = dancer(rooted(person()), 'hips');
    const body = rooted(person({ size: 0.5, motion: () => ({ kind: 'ball', order: 'xyz' }) }));
    const skeleton = { ...body, joints: [{ ...body.joints[0], motion: BVH_ROOT }, ...body.joints.slice(1)] };
    const target = on(source, skeleton);
    expect(carrierOf(target)).toBe(0);
    expect(positions(target, 5).get('hips')?.[0]).toBeCloseTo(0.5 * 1, 9);
  });
});

describe('joints that do more than rotate', () => {
  it('slide as the source’s do: a copy whose joints all have positions is the same', () => {
    const skeleton = rooted(person({ motion: () => BVH_ROOT }));
    const joints = skeleton.joints.map((j, i) => (i === 0 ? j : { ...j, pose: [...j.offset, 0, 0, 0] }));
    const all = { ...skeleton, joints };
    const source = dancer(all, 'hips');
    expectSame(on(source, all), source);
  });

  it('scale as the source’s do, and move along their own axis', () => {
    const base = person();
    const odd: Readonly<Record<string, Joint['motion']>> = {
      spine: { kind: 'prismatic', axis: [0, 1, 0] },
      head: { kind: 'scale', mode: 'uniform', axis: [0, 1, 0] },
      'left toe': { kind: 'compound', dofs: ['tx', 'rz'] },
      'right toe': { kind: 'compound', dofs: ['rz', 'tx', 'sy'] },
    };
    const joints = base.joints.map((j): Joint => {
      const motion = odd[j.name];
      if (!motion) return j;
      const dofs = dofsOf(motion);
      return { ...j, motion, limits: dofs.map(() => UNLIMITED), pose: dofs.map(({ rest }) => rest) };
    });
    const skeleton = { ...base, joints };
    const source = dancer(skeleton, 'hips');
    expectSame(on(source, skeleton), source);
  });

  it('are the same on a copy for any channels of motion capture', () => {
    const channels = fc.shuffledSubarray(['tx', 'ty', 'tz', 'rz', 'rx', 'ry'] as const);
    fc.assert(
      fc.property(fc.array(channels, { minLength: 21, maxLength: 21 }), (each) => {
        const base = person();
        const joints = base.joints.map((j, i): Joint => {
          if (i === 0) return j;
          const motion: BvhMotion = { kind: 'bvh', channels: each[i], positions: 'replace' };
          const pose = each[i].map((name) => (name.startsWith('t') ? j.offset['xyz'.indexOf(name[1])] : 0));
          return { ...j, motion, limits: each[i].map(() => UNLIMITED), pose };
        });
        const skeleton = { ...base, joints };
        const source = dancer(skeleton, 'hips');
        expectSame(on(source, skeleton), source);
      }),
      { numRuns: 20 },
    );
  });
});
