/** The nodes of a glTF file in depth-first order, with their rest. */
import { determinant3 } from '../../math/mat4.ts';
import { quaternionOfRotation } from '../../math/quaternion.ts';
import type { Vec3 } from '../../math/vec3.ts';
import { ImportError, type Remarks } from '../imported.ts';
import type { Quaternion, SceneNode } from '../scene.ts';
import { countOf, type Document, type Json, listOf, numbersOf, textOf } from './json.ts';

/** The nodes of the scene. */
export interface Nodes {
  /** Their names, rests and parents. */
  readonly nodes: readonly SceneNode[];
  /** As in the file, in the same order. */
  readonly sources: readonly Json[];
  /** Index in `nodes` of each node of the file that is in the scene. */
  readonly indexOf: ReadonlyMap<number, number>;
}

/**
 * The nodes of the file's scene, and those that skins of its meshes use from elsewhere.
 * @throws ImportError if they are no trees
 */
export function readNodes(document: Document, roles: ReadonlyMap<number, string>, remarks: Remarks): Nodes {
  const all = document.all('nodes');
  const parents = parentsOf(all);
  const nodes: SceneNode[] = [];
  const sources: Json[] = [];
  const indexOf = new Map<number, number>();
  const joints = new Set(document.all('skins').flatMap((skin) => listOf(skin.joints)));
  const add = (root: number, where: string) => {
    const stack: (readonly [node: number, parent: number, where: string])[] = [[root, -1, where]];
    for (let next = stack.pop(); next; next = stack.pop()) {
      const [node, parent, from] = next;
      const json = document.at('nodes', node, from);
      if (indexOf.has(node)) throw twice(node);
      const index = nodes.length;
      indexOf.set(node, index);
      const role = roles.get(node);
      const rest = restOf(json, node, remarks);
      const isBone = json.mesh !== undefined || joints.has(node);
      nodes.push({ name: textOf(json.name) ?? '', parent, ...rest, ...(isBone && { isBone }), ...(role && { role }) });
      sources.push(json);
      const children = listOf(json.children);
      for (let i = children.length - 1; i >= 0; i--) {
        stack.push([countOf(children[i]) ?? -1, index, `node ${node}`]);
      }
    }
  };
  const roots = rootsOf(document, all, parents);
  if (document.count('scenes') > 1) remarks.leaveOut(`${document.count('scenes') - 1} further scenes`);
  for (const root of roots) add(root, 'The scene');
  // Joints may lie outside of the scene, as long as a mesh in it uses them.
  for (let n = 0; n < sources.length; n++) {
    if (sources[n].skin === undefined || sources[n].mesh === undefined) continue;
    const skin = document.at('skins', sources[n].skin, 'A node');
    for (const joint of listOf(skin.joints)) {
      const own = countOf(joint);
      if (own === undefined || own >= all.length || indexOf.has(own)) continue;
      let top = own;
      // Cycles end at the number of nodes.
      for (let steps = 0; parents[top] >= 0 && steps <= all.length; steps++) top = parents[top];
      if (parents[top] >= 0) throw twice(top);
      add(top, 'A skin');
    }
  }
  return { nodes, sources, indexOf };
}

function parentsOf(all: readonly Json[]): number[] {
  const parents = all.map(() => -1);
  all.forEach(({ children }, node) => {
    for (const child of listOf(children)) {
      const index = countOf(child);
      if (index !== undefined && index < all.length) parents[index] = node;
    }
  });
  return parents;
}

function rootsOf(document: Document, all: readonly Json[], parents: readonly number[]): readonly number[] {
  if (document.count('scenes') > 0) {
    const scene = document.at('scenes', document.root.scene ?? 0, 'The file');
    return listOf(scene.nodes).map((node) => countOf(node) ?? -1);
  }
  const roots = all.flatMap((_, node) => (parents[node] < 0 ? [node] : []));
  if (roots.length === 0 && all.length > 0) throw twice(0);
  return roots;
}

function twice(node: number): ImportError {
  const message = `Node ${node} is reached twice: it has two parents, or is below itself. Expected a tree.`;
  return new ImportError('nodes-cyclic', message);
}

type Rest = Pick<SceneNode, 'translation' | 'rotation' | 'scale'>;

function restOf(json: Json, node: number, remarks: Remarks): Rest {
  if (json.matrix !== undefined) {
    const matrix = numbersOf(json.matrix, 16);
    if (matrix) return decomposed(Float64Array.from(matrix));
    remarks.warn('matrix-invalid', `The matrix of node ${node} is not 16 numbers.`, 'the identity');
  }
  const vector = (name: 'translation' | 'scale', otherwise: Vec3): Vec3 => {
    if (json[name] === undefined) return otherwise;
    const found = numbersOf(json[name], 3);
    if (found) return [found[0], found[1], found[2]];
    remarks.warn('transform-invalid', `The ${name} of node ${node} is not 3 numbers.`, otherwise.join(' '));
    return otherwise;
  };
  const turned = json.rotation === undefined ? undefined : numbersOf(json.rotation, 4);
  if (json.rotation !== undefined && !turned) {
    remarks.warn('transform-invalid', `The rotation of node ${node} is not 4 numbers.`, 'none');
  }
  return {
    translation: vector('translation', [0, 0, 0]),
    rotation: turned ? normalized(turned) : [0, 0, 0, 1],
    scale: vector('scale', [1, 1, 1]),
  };
}

function normalized([x, y, z, w]: readonly number[]): Quaternion {
  const length = Math.hypot(x, y, z, w);
  return length > 0 && length < Infinity ? [x / length, y / length, z / length, w / length] : [0, 0, 0, 1];
}

/** T·R·S of a matrix, the mirroring in the scale of x. Shear, which glTF doesn't allow, is lost. */
function decomposed(m: Float64Array): Rest {
  const lengths = [0, 4, 8].map((o) => Math.hypot(m[o], m[o + 1], m[o + 2]));
  const sign = determinant3(m) < 0 ? -1 : 1;
  const scale: Vec3 = [sign * lengths[0], lengths[1], lengths[2]];
  const turn = Float64Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1);
  // A flattened axis has no direction; the rotation then is that of the others.
  for (let c = 0; c < 3; c++) {
    if (lengths[c] > 0) for (let r = 0; r < 3; r++) turn[3 * c + r] = m[4 * c + r] / scale[c];
  }
  const q = new Float64Array(4);
  quaternionOfRotation(turn, 0, q);
  return { translation: [m[12], m[13], m[14]], rotation: normalized([...q]), scale };
}
