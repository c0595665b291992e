/** What the properties of FBX models say of where these are, whether their own or those of a template. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { worldsAt } from '../scene-at.ts';
import { bone, read, sceneOf, template, turning } from './small-files.ts';
import { type Fbx, fbxBytes, type Obj, prop, type Rec } from './write-fbx.ts';

type Props = Obj['props'] & object;

/** Two joints, of which the lower one shows where the upper one turns it. */
function arm(props: Props, before: readonly Rec[] = []): Fbx {
  return {
    before,
    objects: [bone(10, 'upper', ...props), bone(11, 'lower', prop('Lcl Translation', 1, 2, 3))],
    connections: [
      [10, 0],
      [11, 10],
    ],
  };
}

const ownTemplate = (...props: Props) => template('Model', 'FbxLimbNode', ...props);
const restOf = (fbx: Fbx) => worldsAt(sceneOf(fbx), undefined, 0);

const angle = fc.integer({ min: -180, max: 180 });
const angles = fc.tuple(angle, angle, angle);

describe('FBX nodes', () => {
  it('without an active rotation neither order nor pre- and post-rotation count, whoever says so', () => {
    const inactive = [prop('RotationActive', { int: 0 })];
    const forLimits = [prop('RotationActive', { int: 1 }), prop('RotationSpaceForLimitOnly', { int: 1 })];
    const record = { turn: angles, pre: angles, post: angles, order: fc.integer({ min: 0, max: 6 }) };
    fc.assert(
      fc.property(fc.record(record), fc.constantFrom(inactive, forLimits), ({ turn, pre, post, order }, off) => {
        const plain = [prop('Lcl Translation', 5, 6, 7), prop('Lcl Rotation', ...turn)];
        const space = [
          prop('PreRotation', ...pre),
          prop('PostRotation', ...post),
          prop('RotationOrder', { int: order }),
        ];
        const expected = restOf(arm(plain));
        expect(restOf(arm([...plain, ...space, ...off]))).toEqual(expected);
        expect(restOf(arm([...plain, ...space], [ownTemplate(...off)]))).toEqual(expected);
        // What a node says itself comes first.
        const active = [prop('RotationActive', { int: 1 }), prop('RotationSpaceForLimitOnly', { int: 0 })];
        const turned = restOf(arm([...plain, ...space, ...active], [ownTemplate(...off)]));
        expect(turned).toEqual(restOf(arm([...plain, ...space])));
      }),
      { numRuns: 40 },
    );
  });

  it('a take of a node without an active rotation keeps its keys, in the order x y z', () => {
    const keys = [0, 1].map((time) => ({ time, value: 90 * time, flags: 4 }));
    const space = [prop('PreRotation', 20, 30, 0), prop('RotationOrder', { int: 5 })];
    const off = prop('RotationActive', { int: 0 });
    const scene = sceneOf(turning(keys, ...space, off));
    expect(scene).toEqual(sceneOf(turning(keys)));
  });

  it('any property is that of the template where a node has none', () => {
    const name = fc.constantFrom(
      ...['Lcl Translation', 'Lcl Rotation', 'Lcl Scaling', 'PreRotation', 'PostRotation'],
      ...['RotationOffset', 'RotationPivot', 'ScalingOffset', 'ScalingPivot'],
    );
    const some = fc.array(fc.record({ name, value: fc.tuple(angle, angle, angle) }), { maxLength: 6 });
    fc.assert(
      fc.property(some, (list) => {
        // The lower joint has the template's values, too, so it gets them as its own.
        const props = list.map((own) => prop(own.name, ...own.value.map((v) => v || 1)));
        const own = { ...arm(props), objects: [bone(10, 'upper', ...props), bone(11, 'lower', ...props)] };
        const shared = { ...arm([], [ownTemplate(...props)]), objects: [bone(10, 'upper'), bone(11, 'lower')] };
        expect(restOf(shared)).toEqual(restOf(own));
      }),
      { numRuns: 40 },
    );
  });

  it('the settings have a template, too', () => {
    const fbx = arm([], [template('GlobalSettings', 'FbxGlobalSettings', prop('UnitScaleFactor', 100))]);
    expect(
      read(fbxBytes(fbx))
        .diagnostics.map(({ message }) => message)
        .join(),
    ).toContain('1 m');
  });
});

describe('big-endian FBX files', () => {
  it.each([7400, 7500])('version %i is read as its little-endian twin', (version) => {
    const keys = Array.from({ length: 40 }, (_, k) => ({ time: k / 30, value: k * k, flags: 4 }));
    const fbx = { ...turning(keys), version };
    const [little, big] = [read(fbxBytes(fbx)), read(fbxBytes(fbx, false))];
    expect(big.value).toBeDefined();
    expect(big).toEqual(little);
  });

  it('an old one is told by its version', () => {
    const bytes = fbxBytes({ ...arm([]), version: 6100 }, false);
    expect(
      read(bytes)
        .diagnostics.map(({ message }) => message)
        .join(),
    ).toContain('found version 6.1');
  });
});
