/** Random glTF files: trees, skins, meshes and animations with whatever the format allows and hand-made files leave out. */
import fc from 'fast-check';
import { GltfMaker, type Made } from './make-gltf.ts';

// Some of them 0, none so small that the whole file is.
const unit = fc.integer({ min: -40, max: 40 }).map((n) => Math.fround(n / 40));
const list = <T>(of: fc.Arbitrary<T>, length: number) => fc.array(of, { minLength: length, maxLength: length });
const maybe = <T>(of: fc.Arbitrary<T>) => fc.option(of, { nil: undefined });
const vector = list(unit, 3);
const quaternion = list(unit, 4).map((q) => {
  const length = Math.hypot(...q);
  return length > 0.1 ? q.map((c) => c / length) : [0, 0, 0, 1];
});
const scale = fc.constantFrom([1, 1, 1], [2, 2, 2], [-1, 1, 1], [0.5, 1, 1.5], [-0.7, -0.7, -0.7]);

const placed = fc.record({ translation: maybe(vector), rotation: maybe(quaternion), scale: maybe(scale) });

const node = fc.record({
  name: fc.constantFrom('hip', 'hip', 'left arm', 'a{b}', '', undefined, '日本', '1'),
  /** Below which node; −1 and what is no earlier node: a root. */
  above: fc.integer({ min: -1, max: 5 }),
  rest: placed,
  isMatrix: fc.boolean(),
  mesh: fc.option(fc.nat(1), { nil: undefined, freq: 2 }),
});

const skin = fc.record({
  joints: fc.uniqueArray(fc.nat(5), { minLength: 1, maxLength: 5 }),
  /** Of inverse bind matrices. */
  binds: maybe(list(fc.record({ translation: vector, rotation: quaternion, scale }), 5)),
});

const primitive = fc.record({
  positions: list(unit, 18),
  kind: fc.constantFrom('float', 'float', 'quantised', 'interleaved', 'sparse'),
  hasNormals: fc.boolean(),
  sets: fc.integer({ min: 0, max: 3 }),
  joints: list(fc.nat(99), 72),
  weights: list(fc.oneof(fc.constant(0), fc.integer({ min: 1, max: 255 })), 72),
  weightKind: fc.constantFrom('float', 'u8', 'u16'),
  indices: maybe(list(fc.nat(5), 9)),
  mode: fc.constantFrom(4, 4, 5, 6),
});

const target = fc.record({
  positions: list(unit, 18),
  kind: fc.constantFrom('float', 'sparse', 'sparse on a view', 'zeros'),
  vertices: fc.uniqueArray(fc.nat(5), { minLength: 1, maxLength: 4 }),
});

const mesh = fc.record({
  /** On all nodes: three.js has one kind of mesh for all. */
  skin: maybe(fc.nat(1)),
  primitives: fc.array(primitive, { minLength: 1, maxLength: 2 }),
  targets: fc.array(target, { maxLength: 4 }),
  weights: maybe(list(unit, 4)),
});

const channel = fc.record({
  node: fc.nat(5),
  path: fc.constantFrom('translation', 'rotation', 'rotation', 'scale', 'weights'),
  interpolation: fc.constantFrom('LINEAR', 'STEP', 'CUBICSPLINE', undefined),
  times: fc.uniqueArray(fc.integer({ min: 1, max: 30 }), { minLength: 1, maxLength: 5 }),
  values: list(unit, 60),
  turns: list(quaternion, 5),
  isNormalized: fc.boolean(),
});

/** Up to six nodes, two meshes, two skins and two animations. */
export const randomGltf: fc.Arbitrary<Made> = fc
  .record({
    nodes: fc.array(node, { minLength: 2, maxLength: 6 }),
    /** Whether children come before their parents. */
    isReversed: fc.boolean(),
    skins: list(skin, 2),
    meshes: list(mesh, 2),
    animations: fc.array(fc.array(channel, { minLength: 1, maxLength: 6 }), { maxLength: 2 }),
    scenes: fc.constantFrom('one', 'first by default', 'second'),
  })
  .map(({ nodes, isReversed, skins, meshes, animations, scenes }) => {
    const maker = new GltfMaker();
    const count = nodes.length;
    const at = (n: number) => (isReversed ? count - 1 - n : n);
    const parentOf = (n: number) => (nodes[n].above < n ? nodes[n].above : -1);
    const skinOf = (index: number | undefined) => (index === undefined ? undefined : meshes[index].skin);
    const nodeList: Record<string, unknown>[] = [];
    const moved = new Set(animations.flat().flatMap(({ node: n, path }) => (path === 'weights' ? [] : [n])));
    for (const [n, own] of nodes.entries()) {
      const children = nodes.flatMap((_, c) => (parentOf(c) === n ? [at(c)] : []));
      // Animated nodes have no matrices.
      const isMatrix = own.isMatrix && !moved.has(n);
      const rest = Object.fromEntries(Object.entries(own.rest).filter(([, value]) => value));
      nodeList[at(n)] = {
        // Three.js gives the same name to several nodes without one that have a mesh.
        ...(own.mesh !== undefined && !own.name ? { name: `n${n}` } : own.name !== undefined && { name: own.name }),
        ...(children.length && { children }),
        ...(isMatrix ? { matrix: matrixOf(own.rest) } : rest),
        ...(own.mesh !== undefined && { mesh: own.mesh }),
        ...(skinOf(own.mesh) !== undefined && { skin: skinOf(own.mesh) }),
      };
    }
    const skinList = skins.map(({ joints, binds }) => {
      const own = joints.filter((joint) => joint < count);
      const all = own.length ? own : [0];
      const matrices = binds && Float32Array.from(all.flatMap((_, j) => matrixOf(binds[j])));
      return { joints: all.map(at), ...(matrices && { inverseBindMatrices: maker.add('MAT4', matrices) }) };
    });
    const most = Math.min(...skinList.map(({ joints }) => joints.length));
    const meshList = meshes.map((own) => ({
      primitives: own.primitives.map((one) => primitiveOf(maker, one, own, most)),
      ...(own.targets.length && own.weights && { weights: own.weights.slice(0, own.targets.length) }),
    }));
    const animationList = animations.flatMap((channels) => {
      const samplers: unknown[] = [];
      const list: unknown[] = [];
      const known = new Set<string>();
      for (const { node: n, path, interpolation, times, values, turns, isNormalized } of channels) {
        const key = `${n} ${path}`;
        const own = meshes[nodes[n]?.mesh ?? -1];
        // Three.js finds by names which morph targets move: not those on a joint, nor one of several groups.
        const isJoint = skinList.some(({ joints }) => joints.includes(at(n)));
        const isGroupOfMany =
          own?.primitives.length > 1 && nodes.filter(({ mesh: m }) => meshes[m ?? -1] === own).length > 1;
        const targets = isJoint || isGroupOfMany ? 0 : (own?.targets.length ?? 0);
        if (n >= count || known.has(key) || (path === 'weights' && targets === 0)) continue;
        known.add(key);
        const sorted = [...times].sort((a, b) => a - b);
        const width = path === 'rotation' ? 4 : path === 'weights' ? targets : 3;
        const valuesAt = (k: number) => {
          if (path === 'rotation') return turns[k];
          const own = Array.from({ length: width }, (_, i) => values[(k * width + i) % values.length]);
          return path === 'scale' ? own.map((v) => 1 + 0.4 * v) : own;
        };
        const slope = (k: number, side: number) =>
          Array.from({ length: width }, (_, i) => values[(7 * k + 31 * side + i) % values.length] * 0.5);
        const numbers = sorted.flatMap((_, k) =>
          interpolation === 'CUBICSPLINE' ? [...slope(k, 0), ...valuesAt(k), ...slope(k, 1)] : valuesAt(k),
        );
        const type = path === 'rotation' ? 'VEC4' : path === 'weights' ? 'SCALAR' : 'VEC3';
        // Of values up to 1, which scales and slopes may leave.
        const isInteger =
          isNormalized && (path === 'rotation' || path === 'weights') && interpolation !== 'CUBICSPLINE';
        const output = isInteger
          ? maker.add(
              type,
              Int16Array.from(numbers, (v) => Math.round(v * 32767)),
              { normalized: true },
            )
          : maker.add(type, Float32Array.from(numbers));
        const input = maker.add(
          'SCALAR',
          Float32Array.from(sorted, (t) => t / 8),
        );
        list.push({ sampler: samplers.length, target: { node: at(n), path } });
        samplers.push({ input, output, ...(interpolation && { interpolation }) });
      }
      return list.length ? [{ samplers, channels: list }] : [];
    });
    const roots = nodes.flatMap((_, n) => (parentOf(n) < 0 ? [at(n)] : []));
    const [own, other] = [{ nodes: roots }, { nodes: roots.slice(0, 1) }];
    return maker.made({
      ...(scenes !== 'first by default' && { scene: scenes === 'one' ? 0 : 1 }),
      scenes: scenes === 'one' ? [own] : scenes === 'second' ? [other, own] : [own, other],
      nodes: nodeList,
      meshes: meshList,
      skins: skinList,
      ...(animationList.length && { animations: animationList }),
    });
  });

type Primitive = typeof primitive extends fc.Arbitrary<infer T> ? T : never;
type Mesh = typeof mesh extends fc.Arbitrary<infer T> ? T : never;
type Target = typeof target extends fc.Arbitrary<infer T> ? T : never;

const VERTICES = 6;

/** @param joints how many joints each skin has at least */
function primitiveOf(maker: GltfMaker, own: Primitive, { targets, skin: used }: Mesh, joints: number) {
  const attributes: Record<string, number> = { POSITION: positionsOf(maker, own) };
  if (own.hasNormals) attributes.NORMAL = maker.add('VEC3', Float32Array.from(own.positions));
  for (let s = 0; s < Math.max(own.sets, used === undefined ? 0 : 1); s++) {
    const all = own.joints.slice(24 * s, 24 * s + 24).map((j) => j % joints);
    // Some weight for every vertex; the sum is left to the reader.
    const given = own.weights.slice(24 * s, 24 * s + 24).map((w, i) => (s === 0 && i % 4 === 0 ? Math.max(w, 1) : w));
    attributes[`JOINTS_${s}`] = maker.add('VEC4', s % 2 ? Uint16Array.from(all) : Uint8Array.from(all));
    attributes[`WEIGHTS_${s}`] =
      own.weightKind === 'float'
        ? maker.add(
            'VEC4',
            Float32Array.from(given, (w) => w / 255),
          )
        : maker.add(
            'VEC4',
            own.weightKind === 'u8' ? Uint8Array.from(given) : Uint16Array.from(given, (w) => w * 257),
            {
              normalized: true,
            },
          );
  }
  return {
    attributes,
    mode: own.mode,
    ...(own.indices && { indices: maker.add('SCALAR', Uint8Array.from(own.indices)) }),
    ...(targets.length && { targets: targets.map((one) => targetOf(maker, one, own.hasNormals)) }),
  };
}

function positionsOf(maker: GltfMaker, { positions, kind }: Primitive): number {
  if (kind === 'quantised') {
    return maker.add(
      'VEC3',
      Int16Array.from({ length: 4 * VERTICES }, (_, i) => (i % 4 < 3 ? quantised(positions, i) : 0)),
      {
        normalized: true,
        count: VERTICES,
        stride: 8,
      },
    );
  }
  if (kind === 'interleaved') {
    const values = Float32Array.from({ length: 5 * VERTICES }, (_, i) =>
      i % 5 < 3 ? positions[3 * Math.floor(i / 5) + (i % 5)] : 9,
    );
    return maker.add('VEC3', values, { count: VERTICES, stride: 20 });
  }
  if (kind === 'sparse') {
    const base = Float32Array.from(positions, (v, i) => (i < 3 ? 0 : v));
    return maker.add('VEC3', base, { sparse: sparseOf(maker, [0], positions.slice(0, 3)) });
  }
  return maker.add('VEC3', Float32Array.from(positions));
}

function quantised(positions: readonly number[], i: number): number {
  return Math.round(positions[3 * Math.floor(i / 4) + (i % 4)] * 32767);
}

function targetOf(
  maker: GltfMaker,
  { positions, kind, vertices }: Target,
  hasNormals: boolean,
): Record<string, number> {
  const sorted = [...vertices].sort((a, b) => a - b);
  const moved = () =>
    sparseOf(
      maker,
      sorted,
      sorted.flatMap((v) => positions.slice(3 * v, 3 * v + 3)),
    );
  if (kind === 'zeros') {
    // Three.js takes the mesh itself for positions that a target lacks, where others have some.
    const NORMAL = hasNormals && maker.add('VEC3', Float32Array.from(positions));
    return { POSITION: maker.bare('VEC3', VERTICES), ...(NORMAL !== false && { NORMAL }) };
  }
  if (kind === 'sparse') return { POSITION: maker.bare('VEC3', VERTICES, { sparse: moved() }) };
  const values = Float32Array.from(positions);
  return { POSITION: maker.add('VEC3', values, kind === 'float' ? {} : { sparse: moved() }) };
}

function sparseOf(maker: GltfMaker, indices: readonly number[], values: readonly number[]) {
  return {
    count: indices.length,
    indices: { bufferView: maker.view(Uint8Array.from(indices)), componentType: 5121 },
    values: { bufferView: maker.view(Float32Array.from(values)) },
  };
}

interface Placed {
  readonly translation?: readonly number[];
  readonly rotation?: readonly number[];
  readonly scale?: readonly number[];
}

function matrixOf({
  translation = [0, 0, 0],
  rotation = [0, 0, 0, 1],
  scale: [a, b, c] = [1, 1, 1],
}: Placed): number[] {
  const [x, y, z, w] = rotation;
  return [
    ...[1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)].map((v) => v * a),
    0,
    ...[2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)].map((v) => v * b),
    0,
    ...[2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)].map((v) => v * c),
    0,
    ...translation,
    1,
  ];
}
