/** What the slider of *Steps* goes through, in the character's own space: frames of a joint, or places of a vertex. */

import type { Vec3 } from '../../../math/vec3.ts';
import { formulaText, subscript } from '../../../teaching/steps/formula.ts';
import { framesOf, type JointSteps } from '../../../teaching/steps/joint-steps.ts';
import type { VertexSteps } from '../../../teaching/steps/vertex-steps.ts';

export type Stages =
  /** One frame per label, column-major; the last is the joint's. */
  | { readonly kind: 'frames'; readonly labels: readonly string[]; readonly frames: readonly Float64Array[] }
  /** One place per label; the last is where the vertex is drawn. */
  | { readonly kind: 'places'; readonly labels: readonly string[]; readonly places: readonly Vec3[] };

export function jointStages(steps: JointSteps): Stages {
  const { parent, factors } = steps;
  const start = parent < 0 ? 'origin' : `W${subscript(parent)}`;
  const labels = [start, ...factors.map(({ symbol }) => `times ${formulaText(symbol)}`)];
  return { kind: 'frames', labels, frames: framesOf(steps) };
}

export function vertexStages({ base, morphs, blended, attachments, position }: VertexSteps): Stages {
  const isMorphed = morphs.length > 0;
  const isMoved = attachments.length > 0;
  const labels = [
    'v₀, in the file',
    ...(isMorphed ? ['v, with morphs'] : []),
    ...attachments.map(({ joint }) => `W${subscript(joint)} · B${subscript(joint)}⁻¹ · v`),
    ...(isMoved ? ['v′, as drawn'] : []),
  ];
  const places = [
    base,
    ...(isMorphed ? [blended] : []),
    ...attachments.map(({ moved }) => moved),
    ...(isMoved ? [position] : []),
  ];
  return { kind: 'places', labels, places };
}
