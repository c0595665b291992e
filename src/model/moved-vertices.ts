/** Counts the vertices that each joint moves: those attached to it with a weight other than 0. */
import { perObject } from './per-object.ts';
import { bindingCount, type Skin, vertexCount } from './skin.ts';

const counted = perObject(count);

/** One pass over the attachments per skin. A vertex that lists a joint twice counts once. */
export function movedVertices(skin: Skin, joint: number): number {
  return counted(skin)[joint] ?? 0;
}

function count(skin: Skin): Uint32Array {
  const { attachments } = skin;
  const vertices = vertexCount(skin);
  // Without weights the whole skin follows the root.
  if (!attachments) return Uint32Array.of(vertices);
  const { start, joints, weights } = attachments;
  let size = bindingCount(skin);
  for (const joint of joints) if (joint >= size) size = joint + 1;
  const counts = new Uint32Array(size);
  const lastVertex = new Int32Array(size).fill(-1);
  for (let v = 0; v < vertices; v++) {
    for (let a = start[v]; a < start[v + 1]; a++) {
      const joint = joints[a];
      if (weights[a] === 0 || lastVertex[joint] === v) continue;
      lastVertex[joint] = v;
      counts[joint]++;
    }
  }
  return counts;
}
