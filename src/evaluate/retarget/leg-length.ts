/** Leg lengths, the basis of the root motion scale. */
import { type Bodies, driven } from './align.ts';
import { distance, type RetargetBody } from './body.ts';
import { LIMB_SIDES } from './roles.ts';

/** Length of the legs, hip joint to ankle, or from hips to head without legs; metres. 0 if neither is known. */
export function legLength(bodies: Bodies, body: RetargetBody, at: (target: number) => number): number {
  const lengths = LIMB_SIDES.flatMap((side) => {
    const chain = (['thigh', 'shin', 'foot'] as const).map((part) => driven(bodies, `${side} ${part}`));
    if (chain.some((j) => j < 0)) return [];
    const [thigh, shin, foot] = chain.map(at);
    return [distance(body, thigh, shin) + distance(body, shin, foot)];
  });
  if (lengths.length) return lengths.reduce((a, b) => a + b) / lengths.length;
  const [hips, head] = [driven(bodies, 'hips'), driven(bodies, 'head')];
  return hips >= 0 && head >= 0 ? distance(body, at(hips), at(head)) : 0;
}

/** The default root motion scale: ratio of the target's legs to the source's, both in metres. */
export function automaticScale(bodies: Bodies, reference: RetargetBody): number {
  const own = legLength(bodies, bodies.rest, (t) => t);
  const other = legLength(bodies, reference, (t) => bodies.sourceOf[t]);
  return own > 0 && other > 0 ? own / other : 1;
}
