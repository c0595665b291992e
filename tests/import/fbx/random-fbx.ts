/** Random FBX files: chains of nodes with all that may come between a curve and where a node is. */
import fc from 'fast-check';
import { type Connection, curve, type Fbx, type Key, type Obj, prop, rec, ticks, weights } from './write-fbx.ts';

const LAST = 2;

const angle = fc.integer({ min: -180, max: 180 });
const some = fc.integer({ min: -3, max: 3 });
const scale = fc.constantFrom(0.5, 0.8, 1, 1, 1, 1.5, 2);
const vector = (of: fc.Arbitrary<number>) => fc.tuple(of, of, of);
const rarely = <T>(of: fc.Arbitrary<T>, otherwise: T) =>
  fc.oneof({ weight: 2, arbitrary: fc.constant(otherwise) }, { weight: 1, arbitrary: of });

const CUBIC = 8;
/** Constant, next, linear, user, broken, automatic of several kinds, TCB, weighted. */
const FLAGS = [
  0x2,
  0x102,
  0x4,
  CUBIC | 0x400,
  CUBIC | 0xc00,
  CUBIC | 0x100,
  CUBIC | 0x2100,
  CUBIC | 0x6100,
  CUBIC | 0x1100,
  CUBIC | 0x200,
  CUBIC | 0x3000400,
];

/** @param spread of the values */
function keysOf(spread: number, around: number): fc.Arbitrary<Key[]> {
  return fc.uniqueArray(fc.integer({ min: 0, max: 12 }), { minLength: 1, maxLength: 4 }).chain((at) =>
    fc.tuple(
      ...at
        .sort((a, b) => a - b)
        .map((time) =>
          fc
            .record({
              value: fc.integer({ min: -10, max: 10 }),
              flags: fc.constantFrom(...FLAGS),
              slopes: fc.tuple(some, some),
              weight: fc.tuple(fc.constantFrom(0.1, 0.3333, 0.7), fc.constantFrom(0.1, 0.3333, 0.7)),
            })
            .map(({ value, flags, slopes, weight }) => ({
              time: (time * LAST) / 12,
              value: around + (value * spread) / 10,
              flags,
              // Tension, continuity and bias are small.
              data:
                (flags & 0x200) !== 0
                  ? ([slopes[0] / 4, slopes[1] / 4, 0.1, 0] as const)
                  : ([slopes[0] * spread, slopes[1] * spread, weights(...weight), 0] as const),
            })),
        ),
    ),
  );
}

interface Axis {
  readonly keys: readonly Key[];
  readonly before: string;
  readonly after: string;
}

const beyond = fc.constantFrom('C', 'C', 'C', 'R', 'A', 'M', 'K');

function axesOf(spread: number, around: number): fc.Arbitrary<(Axis | undefined)[]> {
  const axis = fc.record({ keys: keysOf(spread, around), before: beyond, after: beyond });
  return fc.array(fc.option(axis, { nil: undefined }), { minLength: 3, maxLength: 3 });
}

const node = fc.record({
  up: fc.nat(),
  order: fc.integer({ min: 0, max: 5 }),
  inherit: fc.constantFrom(0, 1, 1, 2, 2),
  translation: vector(some),
  rotation: vector(angle),
  scale: rarely(vector(scale), [1, 1, 1]),
  before: rarely(vector(angle), [0, 0, 0]),
  after: rarely(vector(angle), [0, 0, 0]),
  pivots: rarely(fc.tuple(vector(some), vector(some), vector(some), vector(some)), undefined),
  moves: fc.record({
    T: fc.option(axesOf(3, 0), { nil: undefined }),
    R: fc.option(axesOf(120, 0), { nil: undefined }),
    S: rarely(fc.option(axesOf(0.4, 1), { nil: undefined }), undefined),
  }),
  additive: rarely(fc.option(axesOf(90, 0), { nil: undefined }), undefined),
});

const PROPERTIES = { T: 'Lcl Translation', R: 'Lcl Rotation', S: 'Lcl Scaling' } as const;

/** One to five nodes, one take. */
export const randomFbx: fc.Arbitrary<Fbx> = fc
  .record({
    nodes: fc.array(node, { minLength: 1, maxLength: 5 }),
    axes: fc.constantFrom([1, 1, 2, 1, 0, 1], [2, 1, 1, -1, 0, 1], [0, -1, 2, 1, 1, 1], [1, 1, 2, -1, 0, 1]),
    weight: fc.constantFrom(100, 40),
    mode: fc.constantFrom(0, 0, 1, 2),
    accumulates: fc.constantFrom(0, 1),
  })
  .map(({ nodes, axes, weight, mode, accumulates }) => {
    const objects: Obj[] = [];
    const connections: Connection[] = [];
    let next = 1000;
    const names = ['UpAxis', 'UpAxisSign', 'FrontAxis', 'FrontAxisSign', 'CoordAxis', 'CoordAxisSign'];
    const settings = names.map((name, i) => prop(name, { int: axes[i] }));
    const range = [prop('LocalStart', ticks(-0.5)), prop('LocalStop', ticks(LAST + 0.5))];
    objects.push({ id: 1, kind: 'AnimationStack', name: 'Take', props: range });
    const layered = [
      prop('Weight', weight),
      prop('BlendMode', { int: mode }),
      prop('RotationAccumulationMode', { int: accumulates }),
    ];
    objects.push(
      { id: 2, kind: 'AnimationLayer', name: 'Base' },
      { id: 3, kind: 'AnimationLayer', name: 'Over', props: layered },
    );
    connections.push([2, 1], [3, 1]);
    const drive = (
      id: number,
      layer: number,
      property: string,
      axesOfProperty: readonly (Axis | undefined)[],
      rest: readonly number[],
    ) => {
      const own = next++;
      const props = ['X', 'Y', 'Z'].map((axis, k) => prop(`d|${axis}`, rest[k]));
      objects.push({ id: own, kind: 'AnimationCurveNode', name: property, props });
      connections.push([own, layer], [own, id, property]);
      for (const [k, axis] of axesOfProperty.entries()) {
        if (!axis) continue;
        const extra = [
          rec(
            'Pre-Extrapolation',
            [],
            [rec('Type', [{ int: axis.before.charCodeAt(0) }]), rec('Repetition', [{ int: -1 }])],
          ),
          rec(
            'Post-Extrapolation',
            [],
            [rec('Type', [{ int: axis.after.charCodeAt(0) }]), rec('Repetition', [{ int: -1 }])],
          ),
        ];
        const id = next++;
        objects.push(curve(id, axis.keys, extra));
        connections.push([id, own, `d|${'XYZ'[k]}`]);
      }
    };
    for (const [i, own] of nodes.entries()) {
      const id = 100 + i;
      const [rotationOffset, rotationPivot, scalingOffset, scalingPivot] = own.pivots ?? [];
      const pivots = Object.entries({
        RotationOffset: rotationOffset,
        RotationPivot: rotationPivot,
        ScalingOffset: scalingOffset,
        ScalingPivot: scalingPivot,
      }).flatMap(([name, value]) => (value ? [prop(name, ...value)] : []));
      objects.push({
        id,
        kind: 'Model',
        name: `n${i}`,
        type: 'LimbNode',
        props: [
          prop('Lcl Translation', ...own.translation),
          prop('Lcl Rotation', ...own.rotation),
          prop('Lcl Scaling', ...own.scale),
          prop('RotationOrder', { int: own.order }),
          prop('InheritType', { int: own.inherit }),
          prop('PreRotation', ...own.before),
          prop('PostRotation', ...own.after),
          prop('RotationActive', { int: 1 }),
          ...pivots,
        ],
      });
      connections.push([id, i === 0 || own.up % 7 === 0 ? 0 : 100 + (own.up % i)]);
      for (const [letter, property] of Object.entries(PROPERTIES)) {
        const axesOfProperty = own.moves[letter as keyof typeof PROPERTIES];
        const rest = { T: own.translation, R: own.rotation, S: own.scale }[letter] ?? [0, 0, 0];
        if (axesOfProperty) drive(id, 2, property, axesOfProperty, rest);
      }
      if (own.additive) drive(id, 3, 'Lcl Rotation', own.additive, [0, 0, 0]);
    }
    return { version: 7500, settings, objects, connections };
  });
