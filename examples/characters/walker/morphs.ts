/** The walker's three morphs: what they move, and by how much. */

import { smoothstep } from '../../../src/math/smoothstep.ts';
import { add, scaled, subtract, type Vec3 } from '../../../src/math/vec3.ts';
import type { Morph } from '../../../src/model/morph.ts';
import { roundVec, type Span } from '../shape/mesh.ts';
import { length } from '../shape/vectors.ts';
import { EYE_GRID, MOUTH_GRID, type WalkerMesh } from './body.ts';
import { eyePoint, HEAD_CENTRE, mouthPoint } from './head.ts';

/** In the order of the rig and of their channels. */
export const MORPH_NAMES = ['blink', 'smile', 'breathe'] as const;

export function walkerMorphs({ mesh, spans }: WalkerMesh): Morph[] {
  const rest = mesh.positions;
  const replace = (edit: (put: (vertex: number, p: Vec3) => void) => void): Vec3[] => {
    const moved = [...rest];
    edit((vertex, p) => {
      moved[vertex] = p;
    });
    return moved;
  };
  const eyes = (put: (vertex: number, p: Vec3) => void, closed: number, squint: number) =>
    spans.eyes.forEach((span, i) => {
      eachOfGrid(span, EYE_GRID, EYE_GRID, (vertex, s, t) =>
        put(vertex, eyePoint(i === 0 ? 1 : -1, s, t, closed, squint)),
      );
    });
  const shapes: Record<(typeof MORPH_NAMES)[number], Vec3[]> = {
    blink: replace((put) => eyes(put, 1, 0)),
    smile: replace((put) => {
      eyes(put, 0, 1);
      eachOfGrid(spans.mouth, ...MOUTH_GRID, (vertex, s, t) => put(vertex, mouthPoint(s, t, 1)));
      for (let v = spans.head.from; v < spans.head.to; v++) put(v, raisedCheek(rest[v]));
    }),
    breathe: replace((put) => {
      for (let v = spans.torso.from; v < spans.torso.to; v++) put(v, filledChest(rest[v]));
    }),
  };
  return MORPH_NAMES.map((name) => {
    const moved = shapes[name];
    const normals = mesh.normalsOf(moved);
    const indices = rest.flatMap((p, v) => (length(subtract(moved[v], p)) > 1e-3 ? [v] : []));
    const rows = (values: readonly Vec3[], decimals: number) => ({
      indices: Uint32Array.from(indices),
      values: Float64Array.from(indices.flatMap((v) => roundVec(values[v], decimals))),
    });
    return { name: `walker_${name}`, positions: rows(moved, 3), normals: rows(normals, 2) };
  });
}

function eachOfGrid(span: Span, columns: number, rows: number, visit: (vertex: number, s: number, t: number) => void) {
  for (let r = 0; r <= rows; r++) {
    for (let c = 0; c <= columns; c++) visit(span.from + r * (columns + 1) + c, c / columns, r / rows);
  }
}

/** Cheeks go up and out. */
function raisedCheek(p: Vec3): Vec3 {
  const [x, y, z] = subtract(p, HEAD_CENTRE);
  const near = smoothstep(1, 0, Math.hypot((Math.abs(x) - 0.27) / 0.18, (y + 0.15) / 0.14)) * smoothstep(0, 0.12, z);
  return add(p, scaled([Math.sign(x) * 0.5, 0.75, 0.6], 0.032 * near));
}

/** The chest fills, to the front more than to the back. */
function filledChest(p: Vec3): Vec3 {
  const full = Math.exp(-(((p[1] - 0.86) / 0.13) ** 2));
  return [p[0] * (1 + 0.05 * full), p[1] + 0.008 * full, p[2] * (1 + (p[2] > 0 ? 0.11 : 0.03) * full)];
}
