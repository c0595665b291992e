/** Handles and gizmos as a plain view shows them. */
import type { Handle, JointHandles } from '../../../src/evaluate/handles/joint-handles.ts';
import type { Vec3 } from '../../../src/math/vec3.ts';
import { type Layout, layOut, type Projection } from '../../../src/view/gizmo/shapes.ts';

/** Looks along −z, a hundred pixels a unit, the origin in the middle of 800 × 600. */
export const view: Projection = {
  width: 800,
  height: 600,
  project([x, y, z], out, o) {
    out[o] = 400 + 100 * x;
    out[o + 1] = 300 - 100 * y;
    return z < 10;
  },
  towardsViewer: () => [0, 0, 1],
  unitsPerPixel: () => 0.01,
};
export const FREE = { value: 0, min: -Infinity, max: Infinity };

export function handle(dof: number, kind: Handle['kind'], axis: Vec3, mark: Vec3, more: Partial<Handle> = {}): Handle {
  const id = { kind: 'dof', dof } as const;
  return { id, name: 'rx', kind, axis, centre: [0, 0, 0], reach: 1, hue: 0, mark, range: FREE, ...more };
}

export function joint(handles: readonly Handle[], free = false, size = 1): JointHandles {
  const freeTurn = free ? { joint: 0, dofs: [0, 1, 2], order: 'xyz' as const } : undefined;
  return { pivot: [0, 0, 0], size, handles, freeTurn };
}

export function laid(handles: readonly Handle[], free = false, radius = 90): Layout {
  const layout = layOut(joint(handles, free), view, radius);
  if (!layout) throw new Error('It is in front.');
  return layout;
}

/** Two rings: one faces the viewer, the other is edge-on. */
export const facing = handle(1, 'turn', [0, 0, 1], [1, 0, 0]);
export const onEdge = handle(2, 'turn', [1, 0, 0], [0, 0, 1]);
