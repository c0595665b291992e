/** What is in an FBX file, number by number. */
import { describe, expect, it } from 'vitest';
import { childOf, numbersOf } from '../../../src/import/fbx/records/record.ts';
import type { Character } from '../../../src/model/document.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import { EULER_ORDERS, type Joint, type Motion, UNLIMITED } from '../../../src/model/skeleton/skeleton.ts';
import { type KeyedChannel, restChannel, SAMPLED, type Take } from '../../../src/model/takes/take.ts';
import { FIXED_TANGENT } from '../../../src/model/takes/tangent-kinds.ts';
import { character, joint, morph, paintedSkin, skin } from '../../helpers/builders.ts';
import { curvesIn, documentIn, fbxOf, objectIn, placesOf, seenByUs } from '../../helpers/fbx.ts';

const DEGREES = 180 / Math.PI;
const CUBIC = 0x8 | 0x400 | 0x800;
const [HOLD, LINE] = [2, 4];

/** A joint of a motion, at rest, without limits. */
function moving(parent: number, name: string, motion: Motion, more: Partial<Joint> = {}): Joint {
  const dofs = dofsOf(motion);
  return joint(parent, {
    name,
    motion,
    limits: dofs.map(() => UNLIMITED),
    pose: dofs.map(({ rest }) => rest),
    ...more,
  });
}

type Key = readonly [time: number, value: number, slopeIn?: number, slopeOut?: number];

function keyed(keys: readonly Key[], more: Partial<KeyedChannel> = {}): KeyedChannel {
  const column = (of: (key: Key) => number) => Float64Array.from(keys, of);
  const kinds = new Uint8Array(keys.length).fill(FIXED_TANGENT);
  return {
    kind: 'keys',
    times: column(([time]) => time),
    values: column(([, value]) => value),
    tangentsIn: { kinds, slopes: column(([, , slope = 0]) => slope) },
    tangentsOut: { kinds, slopes: column(([, , into = 0, slope = into]) => slope) },
    extrapolateIn: 'constant',
    extrapolateOut: 'constant',
    ...more,
  };
}

/** A character of one hinge about z below a root that has three DOFs of its own, with a take of the hinge. */
function hinged(channel: KeyedChannel, range: Take['range'] = [0, 2], more: Partial<Joint> = {}): Character {
  const joints = [
    joint(-1, { name: 'root', motion: { kind: 'fixed' }, limits: [], pose: [] }),
    moving(0, 'hinge', { kind: 'hinge', axis: [0, 0, 1] }, more),
  ];
  const skeleton = { name: 'x', joints };
  const take = { name: 'turn', range, channels: [restChannel(), restChannel(), restChannel(), channel] };
  return character({ skeleton, takes: [take], shownTake: 0 });
}

const hingeCurve = (own: Character) => curvesIn(documentIn(fbxOf(own)), 'hinge', 'Lcl Rotation').get('d|Z');

describe('an FBX file', () => {
  it('an FBX file is binary 7.4 and the same bytes each time', () => {
    const own = hinged(
      keyed([
        [0, 0],
        [1, 1],
      ]),
    );
    const { bytes } = fbxOf(own);
    expect(new TextDecoder().decode(bytes.subarray(0, 20))).toBe('Kaydara FBX Binary  ');
    expect(new DataView(bytes.buffer).getUint32(23, true)).toBe(7400);
    expect([...bytes.subarray(-4)]).toEqual([0x75, 0x8f, 0x29, 0x0b]);
    expect(fbxOf(own).bytes).toEqual(bytes);
  });

  it('joints of an FBX file are bones in their hierarchy, by their names, with offsets in the file’s unit', () => {
    const joints = [
      moving(-1, 'hips', { kind: 'free', order: 'xyz' }),
      moving(0, 'leg', { kind: 'ball', order: 'xyz' }, { offset: [3, -4, 5] }),
      moving(0, '', { kind: 'fixed' }),
    ];
    const document = documentIn(fbxOf(character({ skeleton: { name: 'x', joints } })));
    const bones = document.objects.filter(({ type, kind }) => kind === 'Model' && type === 'LimbNode');
    expect(bones.map(({ name }) => name)).toEqual(['hips', 'leg', 'joint2']);
    expect(document.partsOf(0).map(({ object }) => object.name)).toEqual(['hips']);
    expect(
      document
        .partsOf(bones[0].id)
        .filter(({ object }) => object.kind === 'Model')
        .map(({ object }) => object.name),
    ).toEqual(['leg', 'joint2']);
    expect(bones[1].properties.vector('Lcl Translation', [0, 0, 0])).toEqual([3, -4, 5]);
  });

  it.each([
    ['y', [1, 1, 2, 1], 1],
    ['z', [2, 1, 1, -1], 2.54],
  ] as const)('an FBX file states the unit, and %s up', (up, axes, centimetres) => {
    const unit = up === 'y' ? 'centimetres' : 'inches';
    const own = { ...hinged(keyed([[0, 0]])), space: { up, unit, lift: 3 } as const };
    const { settings } = documentIn(fbxOf(own));
    const stated = ['UpAxis', 'UpAxisSign', 'FrontAxis', 'FrontAxisSign'].map((name) => settings.number(name));
    expect(stated).toEqual(axes);
    expect([settings.number('CoordAxis'), settings.number('CoordAxisSign')]).toEqual([0, 1]);
    expect(settings.number('UnitScaleFactor')).toBeCloseTo(centimetres, 12);
  });

  it.each(EULER_ORDERS)('an FBX bone turns in the order of its joint: %s', (order) => {
    const own = character({ skeleton: { name: 'x', joints: [moving(-1, 'ball', { kind: 'ball', order })] } });
    const { properties } = objectIn(documentIn(fbxOf(own)), 'Model', 'LimbNode');
    // eEulerXYZ … eEulerZYX
    expect(properties.number('RotationOrder')).toBe(['xyz', 'xzy', 'yzx', 'yxz', 'zxy', 'zyx'].indexOf(order));
    expect(properties.number('RotationActive')).toBe(1);
  });

  it('a turn about a slanted axis is one about a plain one between equal pre- and post-rotations', () => {
    const axis = [0.36, 0.48, 0.8] as const;
    const own = hinged(
      keyed([
        [0, 0, 1],
        [2, 2, 1],
      ]),
      [0, 2],
      { motion: { kind: 'hinge', axis } },
    );
    const made = fbxOf(own);
    const document = documentIn(made);
    const { properties } = objectIn(document, 'Model', 'LimbNode', 'hinge');
    const before = properties.vector('PreRotation', [0, 0, 0]);
    expect(properties.vector('PostRotation', [9, 9, 9])).toEqual(before);
    expect(Math.hypot(...before)).toBeGreaterThan(1);
    expect([...curvesIn(document, 'hinge', 'Lcl Rotation').keys()]).toHaveLength(1);
  });

  it('keys of a curve keep their times, values and slopes, also where a key has two slopes', () => {
    const curve = hingeCurve(
      hinged(
        keyed([
          [-0.5, 0.2, 0, 0.3],
          [0.75, 1, -2, 4],
          [2, -1, 0.5, 0],
        ]),
      ),
    );
    expect(curve?.seconds.map((t) => Number(t.toFixed(9)))).toEqual([-0.5, 0.75, 2]);
    [0.2, 1, -1].forEach((value, k) => {
      expect(curve?.values[k]).toBeCloseTo(value * DEGREES, 4);
    });
    expect(new Set(curve?.flags)).toEqual(new Set([CUBIC]));
    const slopes = [
      [0.3, -2],
      [4, 0.5],
    ];
    slopes.forEach(([right, left], k) => {
      expect(curve?.data[4 * k]).toBeCloseTo(right * DEGREES, 3);
      expect(curve?.data[4 * k + 1]).toBeCloseTo(left * DEGREES, 3);
    });
  });

  it('a value that is held until a step has its key only; what moves until then has one a little before', () => {
    const held = hingeCurve(
      hinged(
        keyed([
          [0, 1],
          [1, 1],
          [1, 2],
          [2, 2],
        ]),
      ),
    );
    expect(held?.seconds).toEqual([0, 1, 2]);
    expect(held?.flags[0]).toBe(HOLD);
    const moved = hingeCurve(
      hinged(
        keyed([
          [0, 0, 1],
          [1, 1, 1],
          [1, 2, 0],
          [2, 2],
        ]),
      ),
    );
    expect(moved?.seconds).toHaveLength(4);
    expect(1 - (moved?.seconds[1] ?? 0)).toBeCloseTo(1e-5, 9);
    expect(moved?.values[1]).toBeCloseTo((1 - 1e-5) * DEGREES, 4);
  });

  it('a limit cuts a curve where it begins to hold', () => {
    const curve = hingeCurve(
      hinged(
        keyed([
          [0, 0, 1],
          [2, 2, 1],
        ]),
        [0, 2],
        { limits: [{ min: -1, max: 1.5 }] },
      ),
    );
    expect(curve?.seconds.map((t) => Number(t.toFixed(4)))).toEqual([0, 1.5, 2]);
    expect(curve?.values.at(-1)).toBeCloseTo(1.5 * DEGREES, 4);
  });

  it('a linked DOF has the curve of what it follows', () => {
    const joints = [
      moving(-1, 'hinge', { kind: 'hinge', axis: [0, 0, 1] }),
      moving(
        0,
        'linked',
        { kind: 'hinge', axis: [0, 1, 0] },
        {
          couples: [
            {
              dof: dofsOf({ kind: 'hinge', axis: [0, 1, 0] })[0].name,
              joint: 0,
              follows: dofsOf({ kind: 'hinge', axis: [0, 0, 1] })[0].name,
              gain: -0.5,
              offset: 0.25,
            },
          ],
        },
      ),
    ];
    const channels = [
      restChannel(),
      restChannel(),
      restChannel(),
      keyed([
        [0, 0, 1],
        [2, 2, 1],
      ]),
      restChannel(),
    ];
    const own = character({
      skeleton: { name: 'x', joints },
      takes: [{ name: 'a', range: [0, 2], channels }],
      shownTake: 0,
    });
    const curve = curvesIn(documentIn(fbxOf(own)), 'linked', 'Lcl Rotation').get('d|Y');
    expect(curve?.seconds).toEqual([0, 2]);
    expect(curve?.values.map((value) => Number((value / DEGREES).toFixed(5)))).toEqual([0.25, -0.75]);
  });

  it('few repetitions within the range are keys; many are said by the curve itself, and told', () => {
    const cycle = { extrapolateOut: 'cycle', extrapolateIn: 'bounce' } as const;
    const few = hingeCurve(
      hinged(
        keyed(
          [
            [0, 0],
            [1, 1],
            [2, 0],
          ],
          cycle,
        ),
        [0, 6],
      ),
    );
    expect(few?.seconds).toEqual([0, 1, 2, 3, 4, 5, 6]);
    expect(few?.after).toBeUndefined();
    const made = fbxOf(
      hinged(
        keyed(
          [
            [0, 0],
            [1, 1],
            [2, 0],
          ],
          cycle,
        ),
        [0, 600],
      ),
    );
    const many = curvesIn(documentIn(made), 'hinge', 'Lcl Rotation').get('d|Z');
    expect(many?.seconds).toEqual([0, 1, 2]);
    expect([many?.before, many?.after].map((letter) => String.fromCharCode(letter ?? 0))).toEqual(['M', 'R']);
    expect(made.report.losses.map(({ code }) => code)).toContain('curves-repeat');
  });

  it('a capture has a straight key for each frame, and no angle jumps by a turn', () => {
    const motion: Motion = { kind: 'bvh', channels: ['tx', 'ty', 'tz', 'rz', 'rx', 'ry'], positions: 'replace' };
    const skeleton = { name: 'x', joints: [moving(-1, 'hips', motion)] };
    const rows = [
      [0, 9, 0, 170, 0, 0],
      [1, 9, 0, -175, 0, 0],
      [2, 9, 0, -160, 0, 0],
      [3, 9, 0, 179, 0, 0],
    ];
    const samples = {
      frameCount: 4,
      frameSeconds: 1 / 48,
      startSeconds: 0,
      firstChannel: 0,
      values: Float64Array.from(rows.flat()),
      scales: Float64Array.of(1, 1, 1, 1 / DEGREES, 1 / DEGREES, 1 / DEGREES),
      interpolation: 'linear',
    } as const;
    const take: Take = { name: 'walk', range: [0, 3 / 48], channels: rows[0].map(() => SAMPLED), samples };
    const made = fbxOf(character({ skeleton, takes: [take], shownTake: 0 }));
    const document = documentIn(made);
    const curve = curvesIn(document, 'hips', 'Lcl Rotation').get('d|Z');
    expect(curve?.seconds.map((t) => Math.round(t * 48e6) / 1e6)).toEqual([0, 1, 2, 3]);
    expect(curve?.flags).toEqual([LINE]);
    expect(curve?.values.map((value) => Math.round(value))).toEqual([170, 185, 200, 179]);
    expect([...curvesIn(document, 'hips', 'Lcl Translation').keys()]).toEqual(['d|X', 'd|Y', 'd|Z']);
    expect(document.settings.number('TimeMode')).toBe(5);
  });

  it('every take is a stack of one layer, by its name and in its range; only one of them if asked for', () => {
    const own = hinged(
      keyed([
        [0, 0],
        [1, 1],
      ]),
      [-0.25, 1.5],
    );
    const two = {
      ...own,
      takes: [
        { ...own.takes[0], framesPerSecond: 23.5 },
        { ...own.takes[0], name: 'again', range: [1, 2] as const, framesPerSecond: 30 },
      ],
    };
    const document = documentIn(fbxOf(two));
    const stacks = document.objects.filter(({ kind }) => kind === 'AnimationStack');
    expect(stacks.map(({ name }) => name)).toEqual(['turn', 'again']);
    for (const { id } of stacks) expect(document.partsOf(id)).toHaveLength(1);
    const seconds = ['LocalStart', 'LocalStop'].map(
      (name) => (stacks[0].properties.number(name) ?? 0) / document.ticks,
    );
    expect(seconds).toEqual([-0.25, 1.5]);
    expect([document.settings.number('TimeMode'), document.settings.number('CustomFrameRate')]).toEqual([14, 23.5]);
    expect(fbxOf(two).report.losses.map(({ code }) => code)).toContain('rates-differ');
    expect(fbxOf(two, { take: 'again' }).report.takes.map(({ name }) => name)).toEqual(['again']);
    expect(() => fbxOf(two, { take: 'none' })).toThrow('has no take none; its takes are turn, again.');
  });

  it('with a rate, every number that moves has a key for each frame', () => {
    const curve = hingeCurve(
      hinged(
        keyed([
          [0, 0],
          [2, 2],
        ]),
      ),
    );
    expect(curve?.seconds).toHaveLength(2);
    const made = fbxOf(
      hinged(
        keyed([
          [0, 0],
          [2, 2],
        ]),
      ),
      { framesPerSecond: 10 },
    );
    const document = documentIn(made);
    expect(curvesIn(document, 'hinge', 'Lcl Rotation').get('d|Z')?.seconds).toHaveLength(21);
    expect([...curvesIn(document, 'hinge', 'Lcl Rotation').keys()]).toEqual(['d|Z']);
    expect(document.settings.number('CustomFrameRate')).toBe(10);
  });

  it('what shears is a chain of bones, the last of which has the joint’s name', () => {
    const skeleton = {
      name: 'x',
      joints: [
        moving(-1, 'root', { kind: 'fixed' }),
        moving(0, 'bend', { kind: 'shear' }),
        moving(1, 'tip', { kind: 'fixed' }),
      ],
    };
    const made = fbxOf(character({ skeleton }));
    const document = documentIn(made);
    const names = document.objects
      .filter(({ type, kind }) => kind === 'Model' && type === 'LimbNode')
      .map(({ name }) => name);
    expect(names).toEqual(['root', 'bend_part1', 'bend_part2', 'bend_part3', 'bend', 'tip']);
    expect(made.report.losses.map(({ message }) => message).join()).toContain(
      'FBX nodes move, then turn, then scale: bend',
    );
  });

  it('a rotation before a translation is a chain too, so that its curves are kept', () => {
    const skeleton = { name: 'x', joints: [moving(-1, 'arm', { kind: 'compound', dofs: ['rz', 'tx', 'ry'] })] };
    const channels = [
      restChannel(),
      restChannel(),
      restChannel(),
      keyed([
        [0, 0],
        [1, 1],
      ]),
      keyed([
        [0, 0],
        [1, 2],
      ]),
      keyed([
        [0, 0],
        [1, 1],
      ]),
    ];
    const own = character({ skeleton, takes: [{ name: 'a', range: [0, 1], channels }], shownTake: 0 });
    const document = documentIn(fbxOf(own));
    expect(curvesIn(document, 'arm_part1', 'Lcl Rotation').get('d|Z')?.seconds).toEqual([0, 1]);
    expect(curvesIn(document, 'arm', 'Lcl Translation').get('d|X')?.values).toEqual([0, 2]);
    expect(curvesIn(document, 'arm', 'Lcl Rotation').get('d|Y')?.seconds).toEqual([0, 1]);
  });
});

describe('the mesh of an FBX file', () => {
  const weights = [0.4, 0.2, 0.1, 0.1, 0.1, 0.05, 0.05];
  const bound = skin('cloth', 6, {
    texcoords: Float64Array.of(0, 0.25, 1, 0, 0, 1),
    attachments: {
      start: Uint32Array.of(0, 7, 8, 8),
      joints: Uint32Array.of(0, 1, 2, 3, 4, 5, 6, 2),
      weights: Float64Array.of(...weights, 1),
    },
  });
  const joints = Array.from({ length: 7 }, (_, j) => moving(j - 1, `j${j}`, { kind: 'ball', order: 'xyz' }));

  it('a mesh has its points in order, unit normals, texture coordinates with v up, and all attachments', () => {
    const document = documentIn(fbxOf(character({ skeleton: { name: 'x', joints }, skins: [bound] })));
    const { record } = objectIn(document, 'Geometry', 'Mesh', 'cloth');
    expect([...numbersOf(childOf(record, 'Vertices'))]).toEqual([...bound.positions]);
    expect([...numbersOf(childOf(record, 'PolygonVertexIndex'))]).toEqual([0, 1, ~2]);
    expect([...numbersOf(childOf(childOf(record, 'LayerElementUV'), 'UV'))]).toEqual([0, 0.25, 1, 0, 0, 1]);
    expect([...numbersOf(childOf(childOf(record, 'LayerElementNormal'), 'Normals'))]).toEqual([
      0, 0, 1, 0, 0, 1, 0, 0, 1,
    ]);
    const clusters = document.objects.filter(({ type }) => type === 'Cluster');
    // A point without attachments hangs on a bone that never moves.
    expect(clusters.map(({ name }) => name)).toEqual([...joints.map(({ name }) => name), 'resting']);
    const sum = clusters.reduce((all, cluster) => {
      const at = [...numbersOf(childOf(cluster.record, 'Indexes'))].indexOf(0);
      return all + (at < 0 ? 0 : numbersOf(childOf(cluster.record, 'Weights'))[at]);
    }, 0);
    expect(sum).toBeCloseTo(1, 6);
    const pose = objectIn(document, 'Pose', 'BindPose');
    expect(pose.record.children.filter(({ name }) => name === 'PoseNode')).toHaveLength(9);
  });

  it('four attachments are kept if asked for, and what that does is told', () => {
    const own = character({ skeleton: { name: 'x', joints }, skins: [bound] });
    const made = fbxOf(own, { influences: 4 });
    const clusters = documentIn(made).objects.filter(({ type }) => type === 'Cluster');
    expect(clusters.map(({ name }) => name)).toEqual(['j0', 'j1', 'j2', 'j3', 'resting']);
    expect(made.report.losses.map(({ code }) => code)).toContain('influences-cut');
  });

  it('each surface has its material, with its colour, and a texture inside the file', () => {
    const png = Uint8Array.of(0x89, 0x50, 0x4e, 0x47, 1, 2, 3);
    const skins = [
      {
        ...paintedSkin('coat', { name: 'red', color: [1, 0.25, 0] }, { name: 'cloth', texture: 'Cloth.PNG' }),
        texcoords: new Float64Array(6),
      },
    ];
    const document = documentIn(
      fbxOf(
        character({
          skins,
          textures: [{ name: 'cloth.png', mime: 'image/png', bytes: png }],
        }),
      ),
    );
    const materials = document.objects.filter(({ kind }) => kind === 'Material');
    expect(materials.map(({ name }) => name)).toEqual(['red', 'cloth']);
    expect(materials[0].properties.vector('DiffuseColor', [9, 9, 9])).toEqual([1, 0.25, 0]);
    const { record } = objectIn(document, 'Geometry', 'Mesh');
    expect([...numbersOf(childOf(childOf(record, 'LayerElementMaterial'), 'Materials'))]).toEqual([0, 1]);
    expect(childOf(objectIn(document, 'Video', 'Clip').record, 'Content')?.values[0]).toEqual(png);
    const texture = document.partsOf(materials[1].id)[0];
    expect([texture.property, texture.object.kind]).toEqual(['DiffuseColor', 'Texture']);
  });

  it('morphs are shapes, whose weights are percents', () => {
    const skeleton = { name: 'x', joints: [moving(-1, 'root', { kind: 'fixed' })] };
    const channels = [
      restChannel(),
      restChannel(),
      restChannel(),
      keyed([
        [0, 0],
        [1, 0.5],
      ]),
    ];
    const own = character({
      skeleton,
      skins: [skin('face')],
      morphs: [morph('smile', 1)],
      takes: [{ name: 'a', range: [0, 1], channels }],
      shownTake: 0,
    });
    const made = fbxOf(own);
    const document = documentIn(made);
    const shape = objectIn(document, 'Geometry', 'Shape', 'smile');
    expect([...numbersOf(childOf(shape.record, 'Indexes'))]).toEqual([1]);
    expect([...numbersOf(childOf(shape.record, 'Vertices'))]).toEqual([-1, 0, 5]);
    expect(curvesIn(document, 'smile', 'DeformPercent').get('d|DeformPercent')?.values).toEqual([0, 50]);
    const { seen } = seenByUs(own, made);
    expect([...seen(0, 1).vertices]).toEqual([...placesOf(own, 0, 1).vertices]);
  });
});
