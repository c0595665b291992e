/** The meshes of nodes: vertices of all primitives, triangles by material, attachments, morph targets. */
import type { Budget } from '../budget.ts';
import { firstNotFinite } from '../finite.ts';
import { counted, ImportError, type Remarks } from '../imported.ts';
import type { SceneMesh, SceneSkin, SceneSkinned, SceneSurface, SceneTarget } from '../scene.ts';
import type { Accessors, NumberList, Numbers } from './accessors.ts';
import { countOf, type Document, extensionOf, type Json, listOf, numberOf, objectOf, shown, textOf } from './json.ts';
import type { Mapping } from './materials.ts';
import type { Nodes } from './nodes.ts';

/** Numbers for what a mesh of a node and each of its targets take beside those of their vertices. */
const PER_MESH = 500;
const PER_TARGET = 64;

/** Arrays of a compressed primitive: by the names of its attributes. */
export interface Unpacked {
  readonly attributes: ReadonlyMap<string, Numbers>;
  readonly indices: Uint32Array;
}

/** A primitive with its vertices' place in the mesh. */
interface Part {
  readonly attributes: Json;
  readonly targets: readonly Json[];
  readonly unpacked: Unpacked | undefined;
  readonly mapping: Mapping | undefined;
  readonly count: number;
  readonly first: number;
}

/** Reads the meshes of nodes; skins are shared by those that have the same. */
export class Meshes {
  private readonly skins = new Map<number, SceneSkin>();

  constructor(
    private readonly document: Document,
    private readonly accessors: Accessors,
    private readonly mappings: readonly Mapping[],
    /** By the primitive's object. */
    private readonly unpacked: ReadonlyMap<Json, Unpacked>,
    private readonly budget: Budget,
    private readonly remarks: Remarks,
  ) {}

  /** In depth-first order of their nodes. @throws ImportError */
  read({ nodes, sources, indexOf }: Nodes): readonly SceneMesh[] {
    const indexInFile = new Uint32Array(sources.length);
    for (const [index, own] of indexOf) indexInFile[own] = index;
    return sources.flatMap((source, node) => {
      if (extensionOf(source, 'EXT_mesh_gpu_instancing')) this.remarks.leaveOut('instances (EXT_mesh_gpu_instancing)');
      if (source.mesh === undefined) return [];
      this.budget.spend(PER_MESH, 'A mesh on so many nodes');
      const called = `Node ${indexInFile[node]}`;
      const json = this.document.at('meshes', source.mesh, called);
      const skin = source.skin === undefined ? undefined : this.skin(source.skin, called, indexOf);
      const weights = listOf(source.weights ?? json.weights).map((w) => numberOf(w) ?? 0);
      const mesh = this.mesh(json, Number(source.mesh), node, skin, weights);
      return mesh ? [{ ...mesh, name: mesh.name || nodes[node].name }] : [];
    });
  }

  private mesh(
    json: Json,
    index: number,
    node: number,
    skin: SceneSkin | undefined,
    weights: readonly number[],
  ): SceneMesh | undefined {
    const parts: Part[] = [];
    const places = new Map<string, Part>();
    const surfaces: SceneSurface[] = [];
    let total = 0;
    listOf(json.primitives).forEach((item, p) => {
      const primitive = objectOf(item) ?? {};
      const called = `Mesh ${index}, primitive ${p}`;
      const mode = countOf(primitive.mode) ?? 4;
      if (mode < 4) {
        this.remarks.leaveOut(mode === 0 ? 'points' : 'lines');
        return;
      }
      const attributes = objectOf(primitive.attributes) ?? {};
      const unpacked = this.unpacked.get(primitive);
      if (attributes.POSITION === undefined && !unpacked?.attributes.has('POSITION')) {
        this.remarks.leaveOut(`${called}, which has no positions`);
        return;
      }
      const mapping = this.mappings[countOf(primitive.material) ?? -1];
      const targets = listOf(primitive.targets).map((t) => objectOf(t) ?? {});
      const key = unpacked ? `${p}` : JSON.stringify([attributes, targets, mapping]);
      let part = places.get(key);
      if (!part) {
        const { count } = this.attribute({ attributes, unpacked }, 'POSITION', 3, called) ?? { count: 0 };
        part = { attributes, targets, unpacked, mapping, count, first: total };
        total += count;
        // Position, normal and place in the texture.
        this.budget.spend(8 * count, called);
        places.set(key, part);
        parts.push(part);
      }
      const triangles = this.triangles(primitive, mode, part, called);
      if (triangles.length) surfaces.push({ material: this.materialOf(primitive, called), triangles });
    });
    if (total === 0) return undefined;
    const called = `Mesh ${index}`;
    const positions = this.joined(parts, 'POSITION', 3, total, called);
    if (!positions) return undefined;
    const wrong = firstNotFinite(positions);
    if (wrong >= 0) {
      const message = `${called} has a position of vertex ${Math.floor(wrong / 3)} that is not a finite number.`;
      throw new ImportError('number-not-finite', message);
    }
    const normals = this.joined(parts, 'NORMAL', 3, total, called);
    if (normals) clearBroken(normals);
    const texcoords = this.texcoords(parts, total, called);
    this.budget.spend(16 * (skin?.joints.length ?? 0), called);
    const skinned = skin && this.skinned(parts, total, skin, called);
    return {
      name: textOf(json.name) ?? '',
      node,
      positions,
      ...(normals && { normals }),
      ...(texcoords && { texcoords }),
      surfaces,
      ...(skinned && { skinned }),
      targets: this.targets(json, parts, positions, normals, weights, called),
    };
  }

  private attribute(
    { attributes, unpacked }: Pick<Part, 'attributes' | 'unpacked'>,
    name: string,
    width: number,
    called: string,
  ): Numbers | undefined {
    const found = unpacked?.attributes.get(name);
    if (found) return found;
    return attributes[name] === undefined
      ? undefined
      : this.accessors.numbers(attributes[name], width, `${called}, ${name}`);
  }

  private materialOf(primitive: Json, called: string): number {
    if (primitive.material === undefined) return -1;
    this.document.at('materials', primitive.material, called);
    return Number(primitive.material);
  }

  /** An attribute of all parts; NaN for those without it; undefined if none has it. */
  private joined(parts: readonly Part[], name: string, width: number, total: number, called: string) {
    let out: Float64Array | undefined;
    const missing = new Set(parts);
    for (const part of parts) {
      const found = this.attribute(part, name, width, called);
      if (!found) continue;
      if (found.count !== part.count) {
        const message = `${called} has ${counted(part.count, 'position')} and ${found.count} of ${name}.`;
        if (name === 'NORMAL') this.remarks.warn('count-mismatch', message, 'computed');
        else throw new ImportError('count-mismatch', message);
        continue;
      }
      out ??= new Float64Array(width * total);
      out.set(found.values, width * part.first);
      missing.delete(part);
    }
    if (out) for (const { first, count } of missing) out.fill(Number.NaN, width * first, width * (first + count));
    return out;
  }

  private texcoords(parts: readonly Part[], total: number, called: string): Float64Array | undefined {
    let out: Float64Array | undefined;
    for (const part of parts) {
      for (const name of Object.keys(part.attributes)) {
        if (/^TEXCOORD_/.test(name) && name !== `TEXCOORD_${part.mapping?.set ?? 0}`) {
          this.remarks.leaveOut('further texture coordinates');
        }
        if (/^COLOR_/.test(name)) this.remarks.leaveOut('vertex colours');
      }
      const found = this.attribute(part, `TEXCOORD_${part.mapping?.set ?? 0}`, 2, called);
      if (!found || found.count !== part.count || firstNotFinite(found.values) >= 0) continue;
      out ??= new Float64Array(2 * total);
      const [a, b, c, d, e, f] = part.mapping?.transform ?? [1, 0, 0, 0, 1, 0];
      for (let v = 0; v < part.count; v++) {
        const u = found.values[2 * v];
        const w = found.values[2 * v + 1];
        out[2 * (part.first + v)] = a * u + b * w + c;
        out[2 * (part.first + v) + 1] = 1 - (d * u + e * w + f);
      }
    }
    return out;
  }

  private triangles(primitive: Json, mode: number, part: Part, called: string): Uint32Array {
    const isIndexed = part.unpacked !== undefined || primitive.indices !== undefined;
    const corners = isIndexed
      ? (part.unpacked?.indices ?? this.accessors.numbers(primitive.indices, 1, `${called}, indices`).values)
      : undefined;
    for (let i = 0; corners && i < corners.length; i++) {
      if (corners[i] < part.count) continue;
      const message = `${called} has the index ${corners[i]}, but only ${part.count} vertices.`;
      throw new ImportError('index-out-of-range', message);
    }
    const n = corners ? corners.length : part.count;
    const count = mode === 4 ? Math.floor(n / 3) : Math.max(0, n - 2);
    this.budget.spend(3 * count, called);
    const out = new Uint32Array(3 * count);
    if (mode === 4 && corners) out.set(corners.subarray(0, out.length));
    else if (mode === 4) for (let i = 0; i < out.length; i++) out[i] = i;
    for (let t = 0; mode !== 4 && t < count; t++) {
      // Of a strip every other triangle is turned over; a fan turns about its first vertex.
      const isOdd = mode === 5 && t % 2 === 1;
      const [a, b, c] = [mode === 5 ? t : 0, t + 1, t + 2].map((corner) => corners?.[corner] ?? corner);
      out[3 * t + (isOdd ? 1 : 0)] = a;
      out[3 * t + (isOdd ? 0 : 1)] = b;
      out[3 * t + 2] = c;
    }
    if (part.first > 0) for (let i = 0; i < out.length; i++) out[i] += part.first;
    return out;
  }

  private skin(index: unknown, called: string, indexOf: ReadonlyMap<number, number>): SceneSkin {
    const known = this.skins.get(Number(index));
    if (known) return known;
    const json = this.document.at('skins', index, called);
    const joints = listOf(json.joints).map((joint) => {
      const own = indexOf.get(countOf(joint) ?? -1);
      if (own !== undefined) return own;
      throw new ImportError('index-out-of-range', `Skin ${index} has the joint ${shown(joint)}, which is not a node.`);
    });
    const inverseBinds = new Float64Array(16 * joints.length);
    if (json.inverseBindMatrices === undefined) {
      for (let j = 0; j < joints.length; j++) for (let k = 0; k < 4; k++) inverseBinds[16 * j + 5 * k] = 1;
    } else {
      const { values, count } = this.accessors.numbers(json.inverseBindMatrices, 16, `Skin ${index}`);
      if (count < joints.length || firstNotFinite(values) >= 0) {
        const message = `Skin ${index} has ${counted(joints.length, 'joint')} and ${count} inverse bind matrices, each of which must be finite.`;
        throw new ImportError('count-mismatch', message);
      }
      inverseBinds.set(values.subarray(0, inverseBinds.length));
    }
    const skin = { joints, inverseBinds };
    this.skins.set(Number(index), skin);
    return skin;
  }

  /** Undefined if no vertex says what it is attached to: then the mesh hangs on its node. */
  private skinned(parts: readonly Part[], total: number, skin: SceneSkin, called: string): SceneSkinned | undefined {
    const start = new Uint32Array(total + 1);
    let joints = new Uint32Array(4 * total);
    let weights = new Float64Array(4 * total);
    let used = 0;
    let off = 0;
    let isAttached = false;
    const beyond = (vertex: number, joint: number) => {
      const message = `${called} attaches vertex ${vertex} to joint ${joint} of its skin, which has ${skin.joints.length}.`;
      return new ImportError('index-out-of-range', message);
    };
    for (const part of parts) {
      const sets: { readonly joints: NumberList; readonly weights: NumberList }[] = [];
      for (let s = 0; ; s++) {
        const j = this.attribute(part, `JOINTS_${s}`, 4, called);
        const w = this.attribute(part, `WEIGHTS_${s}`, 4, called);
        if (!j || !w) break;
        if (j.count !== part.count || w.count !== part.count) {
          throw new ImportError(
            'count-mismatch',
            `${called} has ${part.count} positions, but ${j.count} of JOINTS_${s}.`,
          );
        }
        this.budget.spend(8 * part.count, called);
        sets.push({ joints: j.values, weights: w.values });
      }
      if (sets.length) isAttached = true;
      const most = used + 4 * Math.max(1, sets.length) * part.count;
      if (most > joints.length) {
        joints = grown(joints, new Uint32Array(most));
        weights = grown(weights, new Float64Array(most));
      }
      for (let v = 0; v < part.count; v++) {
        const first = used;
        let sum = 0;
        for (let s = 0; s < sets.length; s++) {
          const { joints: itsJoints, weights: itsWeights } = sets[s];
          for (let k = 4 * v; k < 4 * v + 4; k++) {
            const weight = itsWeights[k];
            if (!(weight > 0 && weight < Infinity)) continue;
            sum += weight;
            const joint = itsJoints[k];
            if (!(joint < skin.joints.length)) throw beyond(part.first + v, joint);
            let at = first;
            while (at < used && joints[at] !== joint) at++;
            if (at === used) {
              joints[used] = joint;
              weights[used++] = weight;
            } else weights[at] += weight;
          }
        }
        // As everywhere: a vertex whose weights are all 0 follows the first joint that it names.
        if (sum === 0 && sets.length) {
          const joint = sets[0].joints[4 * v];
          if (!(joint < skin.joints.length)) throw beyond(part.first + v, joint);
          joints[used] = joint;
          weights[used++] = 1;
        }
        if (Math.abs(sum - 1) > 0.01) off++;
        if (sum > 0) for (let a = first; a < used; a++) weights[a] /= sum;
        start[part.first + v + 1] = used;
      }
    }
    if (!isAttached) return undefined;
    if (off) {
      const message = `${called} has ${off} vertices whose weights don't sum to 1.`;
      this.remarks.warn('weights-off', message, 'scaled to 1');
    }
    return { skin, attachments: { start, joints: joints.subarray(0, used), weights: weights.subarray(0, used) } };
  }

  private targets(
    json: Json,
    parts: readonly Part[],
    positions: Float64Array,
    normals: Float64Array | undefined,
    weights: readonly number[],
    called: string,
  ): readonly SceneTarget[] {
    const names = listOf(objectOf(json.extras)?.targetNames);
    const count = parts.reduce((most, part) => Math.max(most, part.targets.length), 0);
    this.budget.spend(PER_TARGET * count, called);
    return Array.from({ length: count }, (_, t) => ({
      name: textOf(names[t]) ?? '',
      positions: this.rows(parts, t, 'POSITION', positions, called),
      normals: normals ? this.rows(parts, t, 'NORMAL', normals, called) : this.rows([], t, '', positions, called),
      weight: weights[t] ?? 0,
    }));
  }

  /** The values that a target gives to the vertices that it moves. */
  private rows(parts: readonly Part[], target: number, name: string, base: Float64Array, called: string) {
    const indices: number[] = [];
    const values: number[] = [];
    for (const part of parts) {
      const accessor = part.targets[target]?.[name];
      if (accessor === undefined) continue;
      const where = `${called}, target ${target}`;
      const sparse = this.accessors.sparse(accessor, 3, where);
      const found = sparse ?? this.accessors.numbers(accessor, 3, where);
      this.budget.spend(2 * found.values.length, where);
      // Of a vertex that is listed twice the last counts.
      const last = sparse && new Map(Array.from(sparse.indices, (v, i) => [v, i]));
      for (let i = 0; i < found.values.length / 3; i++) {
        const v = sparse ? sparse.indices[i] : i;
        if (last && last.get(v) !== i) continue;
        const x = found.values[3 * i];
        const y = found.values[3 * i + 1];
        const z = found.values[3 * i + 2];
        if (v >= part.count || !Number.isFinite(x + y + z)) {
          throw new ImportError(
            'index-out-of-range',
            `${where}, moves vertex ${v} of ${part.count} to ${x} ${y} ${z}.`,
          );
        }
        const vertex = part.first + v;
        if ((x === 0 && y === 0 && z === 0) || Number.isNaN(base[3 * vertex])) continue;
        indices.push(vertex);
        values.push(base[3 * vertex] + x, base[3 * vertex + 1] + y, base[3 * vertex + 2] + z);
      }
    }
    return { indices: Uint32Array.from(indices), values: Float64Array.from(values) };
  }
}

/** Normals that are no finite numbers become NaN: absent. */
function clearBroken(normals: Float64Array): void {
  for (let v = 0; v < normals.length; v += 3) {
    if (!Number.isFinite(normals[v] + normals[v + 1] + normals[v + 2])) normals.fill(Number.NaN, v, v + 3);
  }
}

/** The numbers of an array in a longer one. */
function grown<A extends Uint32Array | Float64Array>(from: A, into: A): A {
  into.set(from);
  return into;
}
