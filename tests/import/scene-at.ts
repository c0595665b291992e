/** Where the nodes and vertices of a scene are at a time of a take: an evaluator of its own, as plain as it can be. */
import { type CompiledTake, compileChannels } from '../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../src/evaluate/curves.ts';
import type { AxisCurves, Scene, SceneTake } from '../../src/import/scene.ts';
import type { EulerOrder } from '../../src/model/skeleton/skeleton.ts';
import type { Channel } from '../../src/model/takes/take.ts';

/** 16 numbers, column-major. */
export type Matrix = number[];

const compiled = new WeakMap<Channel, CompiledTake>();

function channelAt(channel: Channel | undefined, time: number, rest: number): number {
  if (!channel) return rest;
  const take = compiled.get(channel) ?? compileChannels([channel]);
  compiled.set(channel, take);
  return evaluateChannel(take, 0, time);
}

function valuesOf(curves: AxisCurves | undefined, time: number, rest: readonly number[]): number[] {
  return rest.map((value, k) => channelAt(curves?.[k], time, value));
}

export function multiply(a: Matrix, b: Matrix): Matrix {
  return a.map((_, i) => {
    const [c, r] = [Math.floor(i / 4), i % 4];
    return [0, 1, 2, 3].reduce((sum, k) => sum + a[4 * k + r] * b[4 * c + k], 0);
  });
}

function turn(axis: number, angle: number): Matrix {
  const m = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
  m[5 * u] = m[5 * v] = Math.cos(angle);
  m[4 * u + v] = Math.sin(angle);
  m[4 * v + u] = -Math.sin(angle);
  return m;
}

function eulerMatrix(order: EulerOrder, angles: readonly number[]): Matrix {
  return [...order].reduce(
    (m, letter) => {
      const axis = 'xyz'.indexOf(letter);
      return multiply(turn(axis, angles[axis]), m);
    },
    turn(0, 0),
  );
}

function quaternionMatrix([x, y, z, w]: readonly number[]): Matrix {
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0],
    [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0],
    [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0],
    [0, 0, 0, 1],
  ].flat();
}

/** A world matrix per node. */
export function worldsAt(scene: Scene, take: SceneTake | undefined, time: number): Matrix[] {
  const worlds: Matrix[] = [];
  for (const [i, node] of scene.nodes.entries()) {
    const move = take?.moves.find((own) => own.node === i);
    const t = valuesOf(move?.translation, time, node.translation);
    const s = valuesOf(move?.scale, time, node.scale);
    let r = quaternionMatrix(node.rotation);
    if (move?.rotation?.kind === 'turns') throw new Error('no quaternion curves here');
    if (move?.rotation && node.euler)
      r = eulerMatrix(node.euler.order, valuesOf(move.rotation.angles, time, node.euler.angles));
    const local = r.map((value, k) => (k < 12 ? value * s[Math.floor(k / 4)] : value));
    for (let k = 0; k < 3; k++) local[12 + k] = t[k];
    worlds.push(node.parent < 0 ? local : multiply(worlds[node.parent], local));
  }
  return worlds;
}

/** x y z per vertex, of all meshes one after the other. */
export function verticesAt(scene: Scene, take: SceneTake | undefined, time: number): Float64Array[] {
  const worlds = worldsAt(scene, take, time);
  return scene.meshes.map((mesh, m) => {
    const positions = mesh.positions.slice();
    for (const [t, target] of mesh.targets.entries()) {
      const curve = take?.weights.find((own) => own.mesh === m && own.target === t)?.curve;
      const weight = channelAt(curve, time, target.weight);
      for (const [row, vertex] of target.positions.indices.entries()) {
        for (let k = 0; k < 3; k++) {
          positions[3 * vertex + k] += weight * (target.positions.values[3 * row + k] - mesh.positions[3 * vertex + k]);
        }
      }
    }
    const out = new Float64Array(positions.length);
    const binds = mesh.skinned?.skin.joints.map((node, j) =>
      multiply(worlds[node], Array.from(mesh.skinned?.skin.inverseBinds.subarray(16 * j, 16 * j + 16) ?? [])),
    );
    for (let v = 0; v < positions.length / 3; v++) {
      const { start, joints, weights } = mesh.skinned?.attachments ?? { start: [], joints: [], weights: [] };
      const add = (m4: Matrix, weight: number) => {
        for (let k = 0; k < 3; k++) {
          out[3 * v + k] +=
            weight *
            (m4[k] * positions[3 * v] +
              m4[4 + k] * positions[3 * v + 1] +
              m4[8 + k] * positions[3 * v + 2] +
              m4[12 + k]);
        }
      };
      if (!binds) add(worlds[mesh.node], 1);
      else for (let a = start[v]; a < start[v + 1]; a++) add(binds[joints[a]], weights[a]);
    }
    return out;
  });
}
