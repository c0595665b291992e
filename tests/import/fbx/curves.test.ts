/** What FBX files say of animation, read from ones written here. */
import { describe, expect, it } from 'vitest';
import { multiplyQuaternions, writeQuaternion } from '../../../src/evaluate/rotations/euler-orders.ts';
import { writeRotation } from '../../../src/math/quaternion.ts';
import { FIXED_TANGENT, FLAT, LINEAR } from '../../../src/model/takes/tangent-kinds.ts';
import { worldsAt } from '../scene-at.ts';
import { CUBIC_USER, inRadians, read, sceneOf, turning, zCurve } from './small-files.ts';
import { fbxBytes, fbxText, prop, rec, ticks } from './write-fbx.ts';

describe('FBX curves', () => {
  it('keys of one layer keep their times, values and slopes', () => {
    const { times, values, tangentsIn, tangentsOut } = zCurve(
      sceneOf(
        turning([
          { time: 0, value: 90, flags: CUBIC_USER, data: [45, 30, 0, 0] },
          { time: 1.5, value: -90, flags: 0x4 },
          { time: 2, value: 0, flags: 0x4 },
        ]),
      ),
    );
    expect([...times]).toEqual([0, 1.5, 2]);
    expect([...values].map((value) => value / Math.PI)).toEqual([0.5, -0.5, 0]);
    expect(tangentsOut.kinds[0]).toBe(FIXED_TANGENT);
    expect(tangentsOut.slopes[0]).toBeCloseTo(Math.PI / 4, 12);
    expect(tangentsIn.slopes[1]).toBeCloseTo(Math.PI / 6, 12);
    expect([tangentsOut.kinds[1], tangentsIn.kinds[2]]).toEqual([LINEAR, LINEAR]);
  });

  it('a held key becomes a step: two keys at one time', () => {
    const { times, values, tangentsOut } = zCurve(
      sceneOf(
        turning([
          { time: 0, value: 10, flags: 2 },
          { time: 1, value: 20, flags: 2 },
        ]),
      ),
    );
    expect([...times]).toEqual([0, 1, 1]);
    expect([...values].map((value) => Math.round((value * 180) / Math.PI))).toEqual([10, 10, 20]);
    expect(tangentsOut.kinds[0]).toBe(FLAT);
  });

  it('a pre-rotation about the axis turned last keeps the keys, and is added to them', () => {
    const keys = [
      { time: 0, value: 10, flags: 4 },
      { time: 1, value: 20, flags: 4 },
    ];
    const { times, values } = zCurve(sceneOf(turning(keys, prop('PreRotation', 0, 0, 30))));
    expect([...times]).toEqual([0, 1]);
    expect([...values].map((value) => (value * 180) / Math.PI)).toEqual([40, 50].map((v) => expect.closeTo(v, 9)));
  });

  it.each([
    [
      [20, 30, 40],
      [0, 0, 0],
    ],
    [
      [-80, 15, 170],
      [0, 0, 25],
    ],
    [
      [20, 90, 0],
      [0, 0, 0],
    ],
  ])('a node that turns about one axis keeps its keys below any pre-rotation: %j, and %j after', (before, after) => {
    const fbx = turning(
      [
        { time: 0, value: 10, flags: CUBIC_USER, data: [45, 30, 0, 0] },
        { time: 1.5, value: -90, flags: 0x4 },
        { time: 2, value: 0, flags: 0x4 },
      ],
      prop('PreRotation', ...before),
      prop('PostRotation', ...after),
    );
    const { value: scene, diagnostics } = read(fbxBytes(fbx));
    if (!scene) throw new Error('not read');
    expect(diagnostics.map(({ code }) => code)).toEqual(['fbx-space']);
    const { times, tangentsOut, tangentsIn } = zCurve(scene);
    expect([...times]).toEqual([0, 1.5, 2]);
    expect([tangentsOut.kinds[0], tangentsOut.kinds[1], tangentsIn.kinds[2]]).toEqual([FIXED_TANGENT, LINEAR, LINEAR]);
    const expected = new Float64Array(4);
    const part = new Float64Array(4);
    for (const [time, angle] of [
      [0, 10],
      [1.5, -90],
      [1.75, -45],
    ]) {
      writeQuaternion('xyz', inRadians(before), expected);
      writeQuaternion('xyz', inRadians([0, 0, angle]), part);
      multiplyQuaternions(expected, part, expected);
      writeQuaternion('xyz', inRadians(after), part);
      multiplyQuaternions(expected, [-part[0], -part[1], -part[2], part[3]], expected);
      const matrix = new Float64Array(16);
      writeRotation(expected[0], expected[1], expected[2], expected[3], matrix, 0, 4);
      const shown = worldsAt(scene, scene.takes[0], time)[0];
      for (const k of [0, 1, 2, 4, 5, 6, 8, 9, 10]) expect(shown[k]).toBeCloseTo(matrix[k], 9);
    }
  });

  it('other pre- and post-rotations are fitted and said', () => {
    const keys = [
      { time: 0, value: 10, flags: 4 },
      { time: 1, value: 20, flags: 4 },
    ];
    const { diagnostics } = read(
      fbxBytes(turning(keys, prop('PreRotation', 20, 30, 0), prop('PostRotation', 5, 0, 0))),
    );
    expect(diagnostics.map(({ code }) => code)).toContain('curves-fitted');
  });

  it('fitted keys jump at once where a key holds the value of the next', () => {
    const keys = [
      { time: 0, value: 10, flags: 0x102 },
      { time: 1, value: 20, flags: 0x102 },
      { time: 2, value: 80, flags: 0x102 },
    ];
    const scene = sceneOf(turning(keys, prop('PreRotation', 20, 30, 0), prop('PostRotation', 5, 0, 0)));
    const at = (time: number) => worldsAt(scene, scene.takes[0], time)[0].map((v) => expect.closeTo(v, 4));
    expect(worldsAt(scene, scene.takes[0], 0.00003)[0]).toEqual(at(0.6));
    expect(worldsAt(scene, scene.takes[0], 0.99997)[0]).toEqual(at(0.6));
    expect(worldsAt(scene, scene.takes[0], 1.00003)[0]).toEqual(at(1.6));
  });

  it('times that are no finite numbers count as 0', () => {
    const text = fbxText(
      turning([
        { time: 0.5, value: 10, flags: 4 },
        { time: 1, value: 20, flags: 4 },
      ]),
    );
    const { value } = read(text.replace(/(KeyTime: [\s\S]*?a: \d+,)\d+/, '$11e999'));
    expect(value && [...zCurve(value).times]).toEqual([0, 0.5]);
  });

  it('the units of time that newer files choose are followed', () => {
    const fbx = turning([
      { time: 0, value: 0, flags: 4 },
      { time: 1, value: 1, flags: 4 },
    ]);
    const header = rec(
      'FBXHeaderExtension',
      [],
      [rec('FBXHeaderVersion', [{ int: 1004 }]), rec('OtherFlags', [], [rec('TCDefinition', [{ int: 0 }])])],
    );
    // The first header counts.
    const text = fbxText(fbx)
      .replace(/FBXHeaderExtension:[\s\S]*?\n\}/, '')
      .replace(
        'GlobalSettings',
        `FBXHeaderExtension: {\n${header.children.map(({ name, children }) => (children.length > 0 ? `${name}: {\nTCDefinition: 0\n}` : `${name}: 1004`)).join('\n')}\n}\nGlobalSettings`,
      );
    const { value } = read(text.replaceAll(String(ticks(1)), '141120000'));
    expect(value && [...zCurve(value).times]).toEqual([0, 1]);
  });
});
